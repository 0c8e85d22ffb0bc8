/* What all subcommands share in reading their options with popt. All numbers are read by our own strict reader, so popt
 * sees only text.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_ARGUMENTS_H
#define CLI_ARGUMENTS_H

#include <popt.h>

#include "fields.h"

/* What popt returns for an option: a field, a text of the subcommand, or a flag of its own behind CODE_HELP. */
enum { CODE_FIELD = 100, CODE_TEXT = 200, CODE_HELP = 300 };

/* Entries of tables of options. */
#define OPTION(name, code, argument, help)                                                                             \
    {                                                                                                                  \
        (name), '\0', POPT_ARG_STRING, NULL, (code), (help), (argument)                                                \
    }
#define OPTION_FLAG(name, code, help)                                                                                  \
    {                                                                                                                  \
        (name), '\0', POPT_ARG_NONE, NULL, (code), (help), NULL                                                        \
    }
#define OPTION_HELP OPTION_FLAG("help", CODE_HELP, "show this and stop")

/* The options of the wanted fields (NULL: none), their aliases hidden, then those of `more`; to be freed. */
struct poptOption *field_options(bool (*wanted)(enum field field), const struct poptOption *more);

/* What to do after reading the command line. */
enum reading { READING_GO_ON, READING_STOP, READING_FAILED };

struct arguments {
    poptContext context;
    const char **words;
};

/* Read all but the first `skip` words; `program` stands in their place in the help. */
struct arguments arguments_begin(const char *program, int skip, int count, char **arguments,
                                 const struct poptOption *table);

/* After the last option: its code, if negative, tells of a bad one. What else is there is refused, but for a first
 * argument where `first` takes a copy of it. */
bool arguments_end(poptContext context, int code, char **first, struct reason *why);

/* Prints the help if that is wanted, or complains, and releases the arguments. */
enum reading arguments_close(struct arguments *arguments, bool good, bool help, const char *footer,
                             const struct reason *why);

/* Take over the text of an option; each may be given once. */
bool option_keep(const char *name, char **place, char *text, struct reason *why);

/* A number within [low, high], whole only if so wanted. NULL: left as it is. */
bool option_number(const char *name, const char *text, double low, double high, bool whole, double *value,
                   struct reason *why);

/* "I/K", part I of K; NULL: 1/1. */
bool option_shard(const char *text, size_t *shard, size_t *shards, struct reason *why);

#endif
