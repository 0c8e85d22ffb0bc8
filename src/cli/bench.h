/* restitute bench: the report of error against run time, of what omissions save, and the stability map.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_BENCH_H
#define CLI_BENCH_H

#include <stdbool.h>
#include <stdio.h>

#include "arguments.h"
#include "message.h"
#include "precision.h"

enum bench_mode { MODE_PRECISION, MODE_OMISSIONS, MODE_STABILITY, MODE_BEM };

/* Boundary elements against sync on drawn impacts: those with number shard - 1, shard - 1 + shards, ... */
struct bench_campaign {
    long sets;
    unsigned seed;
    int grid;
    size_t shard, shards;
    char *join; /* files of finished shards, by commas; NULL: none */
};

/* The command line of `restitute bench`. */
struct bench_settings {
    enum bench_mode mode;
    bool quick, resume;
    unsigned sets;
    struct bench_plan plan;
    struct bench_campaign campaign;
    char *output, *figure; /* NULL: not given */
    int argument_count;
    const char *const *arguments;
};

/* Read the options; STOP: help was printed, FAILED: a complaint. To be released in any case. */
enum reading bench_options_read(int count, char **arguments, struct bench_settings *settings);
void bench_options_release(struct bench_settings *settings);

/* The stability map: cells go into PREFIX-stability.csv.partial as they are done. Returns the exit status. */
int bench_map_run(const struct bench_settings *settings);

/* Boundary elements against sync; rows go into PREFIX-bem.csv.partial as they are done. Returns the exit status. */
int bench_bem_campaign(const struct bench_settings *settings);

/* True after a signal that asked to stop. */
bool bench_interrupted(void);

/* A line of progress on a terminal, written over by the next; NULL ends it. */
void bench_progress(const char *text);

/* Write PREFIX-`name`.csv by `write` with its record beside it; nothing without --output. */
bool bench_write_table(const struct bench_settings *settings, const char *name,
                       void (*write)(const void *context, FILE *stream), const void *context, struct reason *why);

/* Read the options behind `restitute bench` and run. Returns the exit status. */
int bench_main(int count, char **arguments);

#endif
