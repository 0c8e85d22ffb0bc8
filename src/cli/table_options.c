/* The options of `restitute table`, read with popt.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <popt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/files.h>

#include "output.h"
#include "table_settings.h"

enum { CODE_FIELD = 100, CODE_TEXT = 200, CODE_HELP = 300, CODE_BLOCKED };

const char *const table_text_names[TABLE_TEXTS] = {"material", "partner",   "speed",   "normal-speed", "tangential-speed",
                                                   "input",    "tolerance", "threads", "max-impacts",  "format",
                                                   "output",   "figure"};

static const char *const action_names[TABLE_ACTIONS] = {"build", "info", "query"};

#define ENTRY(name, code, argument, help)                                                                              \
    {                                                                                                                  \
        (name), '\0', POPT_ARG_STRING, NULL, (code), (help), (argument)                                                \
    }
#define FLAG(name, code, help)                                                                                         \
    {                                                                                                                  \
        (name), '\0', POPT_ARG_NONE, NULL, (code), (help), NULL                                                        \
    }
#define TEXT(which, argument, help) ENTRY(NULL, CODE_TEXT + (which), argument, help)
#define HELP FLAG("help", CODE_HELP, "show this and stop"), POPT_TABLEEND

static const struct poptOption build_options[] = {
    TEXT(TABLE_OUTPUT, "FILE", "the table, an HDF5 file; required"),
    TEXT(TABLE_MATERIAL, "FILE", "what deforms, a material file, .json, or .csv with tau_s,G_Pa"),
    TEXT(TABLE_PARTNER, "rigid|same|FILE",
         "one of the two bodies deforms (default), both do, or the partner's material"),
    FLAG("rotation-blocked", CODE_BLOCKED, "the spheres cannot rotate"),
    TEXT(TABLE_SPEED, "FROM:TO", "normal speeds, m/s; default 1e-4:100"),
    TEXT(TABLE_TOLERANCE, "ERROR", "largest error of ez and ex, in [1e-7, 0.1]; default 1e-5"),
    TEXT(TABLE_THREADS, "N", "solve by so many threads, 1 to 1024; default all processors"),
    TEXT(TABLE_MAX_IMPACTS, "N", "refine until so many impacts are solved; default 12000"),
    TEXT(TABLE_FIGURE, "FILE.svg|png|pdf", "draw ez and ex too, shaded where the model's limits are passed; needs gnuplot"),
    HELP};

static const struct poptOption info_options[] = {TEXT(TABLE_FORMAT, "text|json", "default text"), HELP};

static const struct poptOption query_options[] = {
    TEXT(TABLE_NORMAL_SPEED, "V", "normal speed, m/s, >= 0; required"),
    TEXT(TABLE_TANGENTIAL_SPEED, "U", "sliding speed of the contact point, spin included, m/s; default 0"),
    TEXT(TABLE_INPUT, "CASES.csv", "many: columns normal_speed_m_s,tangential_speed_m_s"),
    TEXT(TABLE_FORMAT, "text|csv", "default text; with --input csv"),
    TEXT(TABLE_OUTPUT, "FILE", "write here and not to standard output"),
    HELP};

static const struct poptOption *const options[TABLE_ACTIONS] = {build_options, info_options, query_options};

static const char usage[] =
    "Usage: restitute table build --output FILE [OPTION...]   build a table of restitution pairs (ez, ex)\n"
    "       restitute table info FILE                         what a table is, and its verified error\n"
    "       restitute table query FILE [OPTION...]            look up one pair or many\n"
    "       restitute table build --help, and likewise for the others\n";

static const char *const footers[TABLE_ACTIONS] = {
    ("\n  restitute table build --material polyisobutylene.json --radius 0.005 --density 7800 --friction 0.3 \\\n"
     "      --speed 1e-3:10 --output pib.h5\n"
     "\nThe errors are verified while the table is built. Exit status: 0 done, 1 the tolerance was not reached (the "
     "table is\n"
     "written, with its errors), 2 bad usage, nothing written.\n"),
    "\nExit status: 0 done, 2 no such table, or damaged.\n",
    ("\n  restitute table query pib.h5 --normal-speed 1 --tangential-speed 0.5\n"
     "\nExit status: 0 done, 1 some rows failed, 2 bad usage or input, nothing written.\n")};

/* Fields of a contact: all of the scene but its speeds. */
static bool of_contact(enum field field)
{
    return field > FIELD_LAST_DIMENSIONLESS && field <= FIELD_FRICTION && field != FIELD_SPEED &&
           field != FIELD_ANGLE && field != FIELD_SPIN1 && field != FIELD_SPIN2;
}

static struct poptOption *option_table(enum table_action action)
{
    struct poptOption *table = allocate(2 * FIELD_COUNT + TABLE_TEXTS + 8, sizeof *table), *entry = table;
    for (enum field field = 0; action == TABLE_BUILD && field < FIELD_COUNT; field++) {
        if (!of_contact(field)) continue;
        *entry++ = (struct poptOption)ENTRY(field_rules[field].option, CODE_FIELD + (int)field, "NUMBER",
                                            field_rules[field].help);
        if (!field_rules[field].alias) continue;
        *entry = (struct poptOption)ENTRY(field_rules[field].alias, CODE_FIELD + (int)field, "NUMBER", NULL);
        entry++->argInfo |= POPT_ARGFLAG_DOC_HIDDEN;
    }
    for (const struct poptOption *o = options[action];; o++) {
        *entry = *o;
        if (o->val >= CODE_TEXT && o->val < CODE_HELP)
            entry->longName = table_text_names[o->val - CODE_TEXT];
        else if (!o->longName)
            break;
        entry++;
    }
    return table;
}

static bool keep(char **place, const char *name, char *text, struct reason *why)
{
    if (*place) {
        free(text);
        return refuse(why, "--%s is given twice", name);
    }
    *place = text;
    return true;
}

static bool take(poptContext context, int code, struct table_settings *s, struct reason *why)
{
    if (code == CODE_BLOCKED)
        s->values.rotation_blocked = 1;
    else if (code >= CODE_TEXT)
        return keep(&s->text[code - CODE_TEXT], table_text_names[code - CODE_TEXT], poptGetOptArg(context), why);
    else
        return keep(&s->field[code - CODE_FIELD], field_rules[code - CODE_FIELD].option, poptGetOptArg(context), why);
    return true;
}

static bool read_arguments(poptContext context, struct table_settings *s, bool *help, struct reason *why)
{
    int code;
    while ((code = poptGetNextOpt(context)) > 0) {
        if (code == CODE_HELP) return *help = true;
        if (!take(context, code, s, why)) return false;
    }
    if (code < -1) return refuse(why, "%.100s: %s; see --help", poptBadOption(context, 0), poptStrerror(code));
    const char *file = poptGetArg(context);
    if (file && s->action != TABLE_BUILD) {
        s->file = copy_of(file);
        file = poptGetArg(context);
    } else if (s->action != TABLE_BUILD)
        return refuse(why, "a table file is missing: restitute table %s FILE", action_names[s->action]);
    if (file) return refuse(why, "unexpected argument \"%.100s\"; see --help", file);
    if (s->action == TABLE_BUILD && !s->text[TABLE_OUTPUT]) return refuse(why, "--output is missing: the table's file");
    s->values.material = s->text[TABLE_MATERIAL];
    return values_read(s->field, &s->values, why) &&
           (!s->text[TABLE_PARTNER] || partner_read(s->text[TABLE_PARTNER], "--partner", &s->values, why));
}

/* FAILED also without an action. */
static enum table_reading find_action(int count, char **arguments, enum table_action *action)
{
    const char *word = count > 2 ? arguments[2] : "";
    for (int i = 0; i < TABLE_ACTIONS; i++)
        if (strcmp(word, action_names[i]) == 0) {
            *action = (enum table_action)i;
            return TABLE_GO_ON;
        }
    if (strcmp(word, "--help") == 0) {
        fputs(usage, stdout);
        return TABLE_STOP;
    }
    if (*word)
        complain("table: unknown action \"%.64s\": must be build, info or query", word);
    else
        complain("table: an action is missing: build, info or query; see restitute table --help");
    return TABLE_FAILED;
}

enum table_reading table_options_read(int count, char **arguments, struct table_settings *settings)
{
    struct reason why;
    bool help = false;
    char name[64];
    *settings = (struct table_settings){.argument_count = count, .arguments = (const char *const *)arguments};
    settings->values = values_none();
    const enum table_reading found = find_action(count, arguments, &settings->action);
    if (found != TABLE_GO_ON) return found;
    /* popt shows its first word as the name of the program. */
    snprintf(name, sizeof name, "restitute table %s", action_names[settings->action]);
    const char **words = allocate((size_t)count, sizeof *words);
    words[0] = name;
    memcpy(words + 1, arguments + 3, (size_t)(count - 3) * sizeof *words);
    struct poptOption *table = option_table(settings->action);
    poptContext context = poptGetContext("restitute", count - 2, words, table, 0);
    if (settings->action != TABLE_BUILD) poptSetOtherOptionHelp(context, "FILE [OPTION...]");
    const bool good = read_arguments(context, settings, &help, &why);
    if (help) {
        poptPrintHelp(context, stdout, 0);
        fputs(footers[settings->action], stdout);
    }
    if (!good) complain("%s", why.text);
    poptFreeContext(context);
    free(words);
    free(table);
    return help ? TABLE_STOP : good ? TABLE_GO_ON : TABLE_FAILED;
}

void table_options_release(struct table_settings *settings)
{
    for (int i = 0; i < TABLE_TEXTS; i++)
        free(settings->text[i]);
    for (int i = 0; i < FIELD_COUNT; i++)
        free(settings->field[i]);
    free(settings->file);
}

bool table_number(const struct table_settings *settings, enum table_text option, double low, double high, double *value,
                  struct reason *why)
{
    const char *text = settings->text[option];
    double number;
    if (!text) return true;
    if (restitute_number_read(text, &number) != RESTITUTE_OK || !(number >= low && number <= high))
        return refuse(why, "--%s = \"%.64s\": must be a number in [%g, %g]", table_text_names[option], text, low, high);
    *value = number;
    return true;
}
