/* The options of `restitute table`.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arguments.h"
#include "output.h"
#include "table_settings.h"

enum { CODE_BLOCKED = CODE_HELP + 1 };

const char *const table_text_names[TABLE_TEXTS] = {
    "material", "partner",     "speed",      "normal-speed", "tangential-speed", "input", "tolerance",
    "threads",  "max-impacts", "time-limit", "format",       "output",           "figure"};

static const char *const action_names[TABLE_ACTIONS] = {"build", "info", "query"};

#define TEXT(which, argument, help) OPTION(NULL, CODE_TEXT + (which), argument, help)
#define HELP OPTION_HELP, POPT_TABLEEND

static const struct poptOption build_options[] = {
    TEXT(TABLE_OUTPUT, "FILE", "the table, an HDF5 file; required"),
    TEXT(TABLE_MATERIAL, "FILE", "what deforms, a material file, .json, or .csv with tau_s,G_Pa"),
    TEXT(TABLE_PARTNER, "rigid|same|FILE",
         "one of the two bodies deforms (default), both do, or the partner's material"),
    OPTION_FLAG("rotation-blocked", CODE_BLOCKED, "the spheres cannot rotate"),
    TEXT(TABLE_SPEED, "FROM:TO", "normal speeds, m/s; default 1e-4:100"),
    TEXT(TABLE_TOLERANCE, "ERROR", "largest error of ez and ex, in [1e-7, 0.1]; default 1e-5"),
    TEXT(TABLE_THREADS, "N", "number of threads, 1 to 1024; default all processors"),
    TEXT(TABLE_MAX_IMPACTS, "N", "limit of impacts for refinement; default 12000"),
    TEXT(TABLE_TIME_LIMIT, "SECONDS", "limit of time for refinement, s; default 20, inf: no limit"),
    TEXT(TABLE_FIGURE, "FILE.svg|png|pdf", "draw ez and ex too, shaded beyond the limits of the model; needs gnuplot"),
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
    struct poptOption *table = field_options(action == TABLE_BUILD ? of_contact : NULL, options[action]);
    for (struct poptOption *entry = table; entry->val; entry++)
        if (entry->val >= CODE_TEXT && entry->val < CODE_HELP)
            entry->longName = table_text_names[entry->val - CODE_TEXT];
    return table;
}

static bool take(poptContext context, int code, struct table_settings *s, struct reason *why)
{
    if (code == CODE_BLOCKED)
        s->values.rotation_blocked = 1;
    else if (code >= CODE_TEXT)
        return option_keep(table_text_names[code - CODE_TEXT], &s->text[code - CODE_TEXT], poptGetOptArg(context), why);
    else
        return option_keep(field_rules[code - CODE_FIELD].option, &s->field[code - CODE_FIELD], poptGetOptArg(context),
                           why);
    return true;
}

static bool read_arguments(poptContext context, struct table_settings *s, bool *help, struct reason *why)
{
    int code;
    while ((code = poptGetNextOpt(context)) > 0) {
        if (code == CODE_HELP) return *help = true;
        if (!take(context, code, s, why)) return false;
    }
    if (!arguments_end(context, code, s->action == TABLE_BUILD ? NULL : &s->file, why)) return false;
    if (s->action != TABLE_BUILD && !s->file)
        return refuse(why, "a table file is missing: restitute table %s FILE", action_names[s->action]);
    if (s->action == TABLE_BUILD && !s->text[TABLE_OUTPUT]) return refuse(why, "--output is missing: the table's file");
    s->values.material = s->text[TABLE_MATERIAL];
    return values_read(s->field, &s->values, why) &&
           (!s->text[TABLE_PARTNER] || partner_read(s->text[TABLE_PARTNER], "--partner", &s->values, why));
}

/* FAILED also without an action. */
static enum reading find_action(int count, char **arguments, enum table_action *action)
{
    const char *word = count > 2 ? arguments[2] : "";
    for (int i = 0; i < TABLE_ACTIONS; i++)
        if (strcmp(word, action_names[i]) == 0) {
            *action = (enum table_action)i;
            return READING_GO_ON;
        }
    if (strcmp(word, "--help") == 0) {
        fputs(usage, stdout);
        return READING_STOP;
    }
    if (*word)
        complain("table: unknown action \"%.64s\": must be build, info or query", word);
    else
        complain("table: an action is missing: build, info or query; see restitute table --help");
    return READING_FAILED;
}

enum reading table_options_read(int count, char **arguments, struct table_settings *settings)
{
    struct reason why;
    bool help = false;
    char name[64];
    *settings = (struct table_settings){.argument_count = count, .arguments = (const char *const *)arguments};
    settings->values = values_none();
    const enum reading found = find_action(count, arguments, &settings->action);
    if (found != READING_GO_ON) return found;
    snprintf(name, sizeof name, "restitute table %s", action_names[settings->action]);
    struct poptOption *table = option_table(settings->action);
    struct arguments read = arguments_begin(name, 3, count, arguments, table);
    if (settings->action != TABLE_BUILD) poptSetOtherOptionHelp(read.context, "FILE [OPTION...]");
    const bool good = read_arguments(read.context, settings, &help, &why);
    const enum reading reading = arguments_close(&read, good, help, footers[settings->action], &why);
    free(table);
    return reading;
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
    return option_number(table_text_names[option], settings->text[option], low, high, false, value, why);
}
