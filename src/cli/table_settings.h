/* The command line of `restitute table`.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_TABLE_SETTINGS_H
#define CLI_TABLE_SETTINGS_H

#include <restitute/table_files.h>

#include "arguments.h"
#include "problem.h"

enum table_action { TABLE_BUILD, TABLE_INFO, TABLE_QUERY, TABLE_ACTIONS };

enum table_text {
    TABLE_MATERIAL,
    TABLE_PARTNER,
    TABLE_SPEED,
    TABLE_NORMAL_SPEED,
    TABLE_TANGENTIAL_SPEED,
    TABLE_INPUT,
    TABLE_TOLERANCE,
    TABLE_THREADS,
    TABLE_MAX_IMPACTS,
    TABLE_TIME_LIMIT,
    TABLE_FORMAT,
    TABLE_OUTPUT,
    TABLE_FIGURE,
    TABLE_TEXTS
};

extern const char *const table_text_names[TABLE_TEXTS];

struct table_settings {
    enum table_action action;
    char *text[TABLE_TEXTS];  /* as given; NULL: not given */
    char *field[FIELD_COUNT]; /* of the contact, likewise */
    char *file;               /* the table that is read */
    struct values values;     /* of the contact */
    int argument_count;
    const char *const *arguments;
};

/* Read the options; STOP: help was printed, FAILED: a complaint. To be released in any case. */
enum reading table_options_read(int count, char **arguments, struct table_settings *settings);
void table_options_release(struct table_settings *settings);

/* A number of an option within [low, high]; not given: left as it is. */
bool table_number(const struct table_settings *settings, enum table_text option, double low, double high, double *value,
                  struct reason *why);

/* The actions; each returns the exit status. */
int table_build_run(const struct table_settings *settings);
int table_info_run(const struct table_settings *settings);
int table_query_run(const struct table_settings *settings);

/* Draw e_z(v) and e_x(v, angle) of a table, with what passes the limits of the model shaded. */
bool table_figure(const restitute_table *table, const struct table_settings *settings, const char *path,
                  struct reason *why);

/* How far the model holds, for a message or a listing: text of at most `size` characters. */
void table_limits(const restitute_table_info *info, char *text, size_t size);

#endif
