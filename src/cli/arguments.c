/* Options read with popt.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "arguments.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files/number.h"

struct poptOption *field_options(bool (*wanted)(enum field field), const struct poptOption *more)
{
    size_t others = 0;
    while (more && (more[others].longName || more[others].val))
        others++;
    struct poptOption *table = allocate(2 * FIELD_COUNT + others + 1, sizeof *table), *entry = table;
    for (enum field field = 0; field < FIELD_COUNT; field++) {
        const struct field_rule *rule = &field_rules[field];
        if (!wanted || !wanted(field)) continue;
        *entry++ = (struct poptOption)OPTION(rule->option, CODE_FIELD + (int)field, "NUMBER", rule->help);
        if (!rule->alias) continue;
        *entry = (struct poptOption)OPTION(rule->alias, CODE_FIELD + (int)field, "NUMBER", rule->help);
        entry++->argInfo |= POPT_ARGFLAG_DOC_HIDDEN;
    }
    for (size_t i = 0; i < others; i++)
        *entry++ = more[i];
    return table;
}

struct arguments arguments_begin(const char *program, int skip, int count, char **arguments,
                                 const struct poptOption *table)
{
    const char **words = allocate((size_t)(count - skip + 1), sizeof *words);
    words[0] = program; /* popt shows its first word as the name of the program */
    memcpy(words + 1, arguments + skip, (size_t)(count - skip) * sizeof *words);
    return (struct arguments){poptGetContext("restitute", count - skip + 1, words, table, 0), words};
}

bool arguments_end(poptContext context, int code, char **first, struct reason *why)
{
    if (code < -1) return refuse(why, "%.100s: %s; see --help", poptBadOption(context, 0), poptStrerror(code));
    const char *more = poptGetArg(context);
    if (more && first) {
        *first = copy_of(more);
        more = poptGetArg(context);
    }
    return more ? refuse(why, "unexpected argument \"%.100s\"; see --help", more) : true;
}

enum reading arguments_close(struct arguments *arguments, bool good, bool help, const char *footer,
                             const struct reason *why)
{
    if (help) {
        static char room[1 << 14]; /* one write at the end, whose failure keeps its reason */
        setvbuf(stdout, room, _IOFBF, sizeof room);
        poptPrintHelp(arguments->context, stdout, 0);
        fputs(footer, stdout);
    }
    if (!good) complain("%s", why->text);
    poptFreeContext(arguments->context);
    free(arguments->words);
    return help ? READING_STOP : good ? READING_GO_ON : READING_FAILED;
}

bool option_keep(const char *name, char **place, char *text, struct reason *why)
{
    if (*place) {
        free(text);
        return refuse(why, "--%s is given twice", name);
    }
    *place = text;
    return true;
}

bool option_number(const char *name, const char *text, double low, double high, bool whole, double *value,
                   struct reason *why)
{
    double number;
    if (!text) return true;
    if (rst_number_read(text, &number) != RESTITUTE_OK || !(number >= low && number <= high) ||
        (whole && number != floor(number)))
        return refuse(why, "--%s = \"%.64s\": must be %s in [%g, %g]", name, text,
                      whole ? "a whole number" : "a number", low, high);
    *value = number;
    return true;
}

bool option_shard(const char *text, size_t *shard, size_t *shards, struct reason *why)
{
    const char *slash = text ? strchr(text, '/') : NULL;
    char first[32];
    double part = 1, parts = 1;
    snprintf(first, sizeof first, "%.*s", slash ? (int)(slash - text) : 0, text ? text : "");
    if (text && (rst_number_read(first, &part) != RESTITUTE_OK ||
                 rst_number_read(slash ? slash + 1 : "", &parts) != RESTITUTE_OK ||
                 !(part >= 1 && part <= parts && parts <= 10000) || part != floor(part) || parts != floor(parts)))
        return refuse(why, "--shard = \"%.64s\": must be I/K, 1 <= I <= K <= 10000", text);
    *shard = (size_t)part;
    *shards = (size_t)parts;
    return true;
}
