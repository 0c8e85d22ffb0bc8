/* The command line: what it may say, and what it said.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "arguments.h"
#include "problem.h"

/* Options that are not fields. */
enum text_option {
    TEXT_MATERIAL,
    TEXT_PARTNER,
    TEXT_METHOD,
    TEXT_TOLERANCE,
    TEXT_ELEMENTS,
    TEXT_TIME_STEP,
    TEXT_MAX_WORK,
    TEXT_TIME_LIMIT,
    TEXT_FORMAT,
    TEXT_INPUT,
    TEXT_OUTPUT,
    TEXT_GRID,
    TEXT_FIGURE,
    TEXT_SAMPLES,
    TEXT_SPEED_LIMIT,
    TEXT_RADIUS_LIMIT,
    TEXT_DISPLACEMENT_LIMIT,
    TEXT_DUNDURS_LIMIT,
    TEXT_THREADS,
    TEXT_EVENTS,
    TEXT_FIELDS,
    TEXT_SHARD,
    TEXT_JOIN,
    TEXT_SEED,
    TEXT_COUNT
};

enum format { FORMAT_DEFAULT, FORMAT_TEXT, FORMAT_CSV, FORMAT_JSON };

enum subcommand { COMMAND_PAIR, COMMAND_HISTORY, COMMAND_SWEEP };

struct settings {
    enum subcommand command;
    struct values values;
    restitute_options solver;
    enum format format;
    size_t samples;
    bool resume;
    bool contours;
    size_t shard, shards; /* part `shard` of `shards`, from 1; 1/1: all */
    unsigned seed;
    char *sweep;              /* which figure; NULL: none is named */
    char *text[TEXT_COUNT];   /* as given; NULL: not given */
    char *field[FIELD_COUNT]; /* likewise */
    int argument_count;
    const char *const *arguments; /* the whole command line, for the record */
};

/* Read the options behind `restitute pair`, `history` or `sweep`: arguments[1] is the subcommand. STOP: help was
 * printed. */
enum reading options_read(int count, char **arguments, struct settings *settings);

void options_release(struct settings *settings);

#endif
