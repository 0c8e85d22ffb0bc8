/* The event log of one impact: `restitute history --events`, by the component cvode where it is built.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_EVENTS_H
#define CLI_EVENTS_H

#include "options.h"
#include "output.h"
#include "problem.h"

/* Columns of the log. The kind is a word, the others numbers. */
enum event_column {
    EVENT_TIME,
    EVENT_KIND,
    EVENT_POSITION,
    EVENT_INDENTATION,
    EVENT_NORMAL_VELOCITY,
    EVENT_TANGENTIAL_VELOCITY,
    EVENT_ELEMENTS,
    EVENT_COLUMNS
};

/* Events by columns; `kind` points to words that live for ever. */
struct event_table {
    size_t count;
    double *number[EVENT_COLUMNS];
    const char **kind;
};

const char *event_column_name(int column, bool physical);
const char *event_column_unit(int column, bool physical);

/* Refuse --events in a build without the component, with a method that logs none, and a name that ends in nothing
 * known; without --method, take cvode. */
bool events_check(struct settings *settings, struct reason *why);

/* Where events are wanted, `options` get a method that keeps them. NULL: not wanted. */
struct event_keeper;
bool events_begin(const struct settings *settings, restitute_options *options, struct event_keeper **keeper,
                  struct reason *why);
void events_end(struct event_keeper *keeper);

/* Those of the impact that was solved. */
bool events_take(const struct event_keeper *keeper, struct event_table *table, struct reason *why);

/* The table as an output for `path`, not yet finished: HDF5 if it ends in .h5 or .hdf5, else CSV;
 * "-" is standard output. */
bool events_open(const char *path, const struct event_table *table, bool physical, struct output *output,
                 struct reason *why);

void events_release(struct event_table *table);

#endif
