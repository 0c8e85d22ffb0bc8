/* The options of `restitute bench`.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arguments.h"

enum { CODE_QUICK = CODE_HELP + 1, CODE_OMISSIONS, CODE_STABILITY, CODE_RESUME };

/* Largest campaign: its rows are kept in memory. */
static const double most_sets = 100000;

enum {
    TEXT_METHODS,
    TEXT_SETS,
    TEXT_TOLERANCES,
    TEXT_BUDGET,
    TEXT_CAMPAIGN,
    TEXT_GRID,
    TEXT_SEED,
    TEXT_SHARD,
    TEXT_JOIN,
    TEXT_OUTPUT,
    TEXT_FIGURE,
    TEXTS
};

static const char *const names[TEXTS] = {"methods", "sets",  "tolerances", "budget", "bem-campaign", "grid",
                                         "seed",    "shard", "join",       "output", "figure"};

#define ENTRY(name, text, argument, help) OPTION(name, CODE_TEXT + (text), argument, help)

static const struct poptOption table[] = {
    OPTION_FLAG("omissions", CODE_OMISSIONS, "instead: the time saved by what is left out"),
    OPTION_FLAG("stability", CODE_STABILITY, "instead: the map of stability over delta1 and gamma, a quarter of an hour"),
    ENTRY("methods", TEXT_METHODS, "A,B,...", "some of the methods named below; default all"),
    ENTRY("sets", TEXT_SETS, "A,B,...", "some of truth, stiff, prony; default all"),
    ENTRY("tolerances", TEXT_TOLERANCES, "T,T,...", "from large to small, in [1e-8, 0.1]; default 1e-2,1e-3,...,1e-8"),
    ENTRY("budget", TEXT_BUDGET, "S",
          "longest time of one run, or of a cell of the map, s, in [1e-3, 3600]; default 0.4"),
    ENTRY("bem-campaign", TEXT_CAMPAIGN, "N",
          "instead: boundary elements against sync on N impacts drawn at random, 1 to 100000"),
    ENTRY("grid", TEXT_GRID, "CELLS", "with --bem-campaign: cells along a side, even, 16 to 1024; default 128"),
    ENTRY("seed", TEXT_SEED, "S", "with --bem-campaign: another draw, 0 to 4294967295; default 2017"),
    ENTRY("shard", TEXT_SHARD, "I/K", "with --bem-campaign: every K-th impact alone, from the I-th on"),
    ENTRY("join", TEXT_JOIN, "FILE,...", "with --bem-campaign: rows of finished shards, which are not solved again"),
    OPTION_FLAG("quick", CODE_QUICK, "few scenes, coarse: seconds instead of minutes"),
    ENTRY("output", TEXT_OUTPUT, "PREFIX",
          "write PREFIX-runs.csv, PREFIX-summary.csv, PREFIX-speed.csv, or PREFIX-omissions.csv, or "
          "PREFIX-stability.csv, or PREFIX-bem.csv"),
    ENTRY("figure", TEXT_FIGURE, "FILE", "a figure, .svg or .png; needs gnuplot"),
    OPTION_FLAG("resume", CODE_RESUME, "with --stability or --bem-campaign, and --output: go on from the .csv.partial"),
    OPTION_HELP,
    POPT_TABLEEND};

static const char footer[] =
    "\n\nError against run time of the methods over a fixed set of scenes with known pairs, beside the algorithm of "
    "the\n"
    "paper as it was published (paper-euler; paper-verlet moves the sphere by velocity Verlet). Without --output only "
    "the\n"
    "summary is printed. Times depend on the machine: only ratios within one run mean something.\n"
    "\nExamples:\n"
    "  restitute bench --quick\n"
    "  restitute bench --output report --figure report.svg\n"
    "  restitute bench --stability --output report --figure stability.svg\n"
    "  restitute bench --bem-campaign 200 --output report --figure bem.svg\n"
    "\nExit status: 0 done, 2 bad usage or output that cannot be written, 130 interrupted.\n";

/* The first word of a comma-separated list: its length; what comes after it, NULL at the end. */
static size_t next_word(const char *list, const char **after)
{
    const size_t length = strcspn(list, ",");
    *after = list[length] ? list + length + 1 : NULL;
    return length;
}

static int set_index(const char *name, size_t length)
{
    for (int i = 0; i < BENCH_SETS; i++)
        if (strlen(bench_set_names[i]) == length && memcmp(bench_set_names[i], name, length) == 0) return i;
    return -1;
}

/* Bits of the names in a list. `find` gives the index of a name, -1 for none; `allowed` says which there are. */
static bool read_names(const char *option, const char *list, int (*find)(const char *, size_t), const char *allowed,
                       unsigned *bits, struct reason *why)
{
    *bits = 0;
    for (const char *word = list; word;) {
        const char *after;
        const size_t length = next_word(word, &after);
        const int index = find(word, length);
        if (index < 0)
            return refuse(why, "--%s: \"%.*s\": must be among %s", option, (int)(length < 64 ? length : 64), word,
                          allowed);
        if (*bits & (1u << index))
            return refuse(why, "--%s: \"%.*s\": is there twice", option, (int)(length < 64 ? length : 64), word);
        *bits |= 1u << index;
        word = after;
    }
    return true;
}

static bool read_tolerances(const char *list, struct bench_plan *plan, struct reason *why)
{
    plan->n_tolerances = 0;
    for (const char *word = list; word;) {
        const char *after;
        char text[40];
        const size_t length = next_word(word, &after);
        snprintf(text, sizeof text, "%.*s", (int)(length < sizeof text ? length : sizeof text - 1), word);
        if (plan->n_tolerances == BENCH_SETTINGS)
            return refuse(why, "--tolerances: at most %d are possible", BENCH_SETTINGS);
        double *value = &plan->tolerances[plan->n_tolerances];
        if (!option_number("tolerances", text, 1e-8, 0.1, false, value, why)) return false;
        if (plan->n_tolerances > 0 && !(value[0] < value[-1]))
            return refuse(why, "--tolerances: %s after %g: must go from large to small", text, value[-1]);
        plan->n_tolerances++;
        word = after;
    }
    return true;
}

static bool take_campaign(char **text, struct bench_settings *settings, struct reason *why)
{
    double sets = 0, grid = 128, seed = 2017;
    struct bench_campaign *campaign = &settings->campaign;
#ifndef RESTITUTE_WITH_BEM
    return refuse(why, "--bem-campaign: the component bem is not in this build (it needs FFTW)");
#endif
    if (!option_number("bem-campaign", text[TEXT_CAMPAIGN], 1, most_sets, true, &sets, why) ||
        !option_number("grid", text[TEXT_GRID], 16, 1024, true, &grid, why) ||
        !option_number("seed", text[TEXT_SEED], 0, 4294967295.0, true, &seed, why) ||
        !option_shard(text[TEXT_SHARD], &campaign->shard, &campaign->shards, why))
        return false;
    if ((double)campaign->shard > sets)
        return refuse(why, "--shard = \"%.64s\": is empty, the impacts are %g", text[TEXT_SHARD], sets);
    if ((int)grid % 2) return refuse(why, "--grid = %g: must be even", grid);
    campaign->sets = (long)sets;
    campaign->grid = (int)grid;
    campaign->seed = (unsigned)seed;
    campaign->join = text[TEXT_JOIN];
    text[TEXT_JOIN] = NULL;
    settings->mode = MODE_BEM;
    return true;
}

static bool take_words(char *const *text, struct bench_settings *settings, struct reason *why)
{
    char methods[200] = "", sets[64] = "";
    for (int i = 0; i < BENCH_METHODS; i++)
        snprintf(methods + strlen(methods), sizeof methods - strlen(methods), "%s%s", i ? ", " : "",
                 bench_methods[i].name);
    for (int i = 0; i < BENCH_SETS; i++)
        snprintf(sets + strlen(sets), sizeof sets - strlen(sets), "%s%s", i ? ", " : "", bench_set_names[i]);
    struct bench_plan *plan = &settings->plan;
    return (!text[TEXT_METHODS] ||
            read_names("methods", text[TEXT_METHODS], bench_method_index, methods, &plan->methods, why)) &&
           (!text[TEXT_SETS] || read_names("sets", text[TEXT_SETS], set_index, sets, &settings->sets, why)) &&
           (!text[TEXT_TOLERANCES] || read_tolerances(text[TEXT_TOLERANCES], plan, why)) &&
           option_number("budget", text[TEXT_BUDGET], 1e-3, 3600, false, &plan->budget, why);
}

/* What is not given. A quick run stops where a full one begins to be interesting. */
static void set_defaults(bool quick, struct bench_settings *settings)
{
    struct bench_plan *plan = &settings->plan;
    plan->methods = (1u << BENCH_METHODS) - 1;
    plan->budget = quick ? 0.1 : 0.4;
    plan->doublings = quick ? 4 : 9;
    plan->n_tolerances = quick ? 3 : 7;
    for (int i = 0; i < plan->n_tolerances; i++) {
        static const double decades[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
        plan->tolerances[i] = decades[i];
    }
    settings->sets = (1u << BENCH_SETS) - 1;
}

/* Options that belong to another mode are refused rather than passed over. */
static bool check_mode(const struct bench_settings *settings, char *const *text, bool omissions, bool stability,
                       struct reason *why)
{
    if (omissions && stability) return refuse(why, "--omissions and --stability exclude each other");
    if ((omissions || stability) && (text[TEXT_SETS] || text[TEXT_TOLERANCES]))
        return refuse(why, "--%s: has scenes and resolutions of its own; without --sets and --tolerances",
                      omissions ? "omissions" : "stability");
    if (omissions && text[TEXT_BUDGET]) return refuse(why, "--budget: not with --omissions");
    if (settings->resume && !((stability || text[TEXT_CAMPAIGN]) && text[TEXT_OUTPUT]))
        return refuse(why, "--resume: only with --stability or --bem-campaign, and --output");
    if (text[TEXT_CAMPAIGN] && (omissions || stability || settings->quick || text[TEXT_METHODS] || text[TEXT_SETS] ||
                                text[TEXT_TOLERANCES] || text[TEXT_BUDGET]))
        return refuse(why,
                      "--bem-campaign: has impacts and methods of its own; it takes --grid, --seed, --shard, --join, "
                      "--resume, --output, --figure");
    for (int i = TEXT_GRID; i <= TEXT_JOIN; i++)
        if (text[i] && !text[TEXT_CAMPAIGN]) return refuse(why, "--%s: only with --bem-campaign", names[i]);
    return true;
}

static bool read_arguments(poptContext context, struct bench_settings *settings, char **text, bool *help,
                           struct reason *why)
{
    int code;
    bool omissions = false, stability = false;
    while ((code = poptGetNextOpt(context)) > 0) {
        if (code == CODE_QUICK) settings->quick = true;
        if (code == CODE_RESUME) settings->resume = true;
        if (code == CODE_OMISSIONS) omissions = true;
        if (code == CODE_STABILITY) stability = true;
        if (code == CODE_HELP) return *help = true;
        if (code < CODE_HELP &&
            !option_keep(names[code - CODE_TEXT], &text[code - CODE_TEXT], poptGetOptArg(context), why))
            return false;
    }
    if (!arguments_end(context, code, NULL, why)) return false;
    settings->mode = omissions ? MODE_OMISSIONS : stability ? MODE_STABILITY : MODE_PRECISION;
    set_defaults(settings->quick, settings);
    if (!check_mode(settings, text, omissions, stability, why)) return false;
    return text[TEXT_CAMPAIGN] ? take_campaign(text, settings, why) : take_words(text, settings, why);
}

enum reading bench_options_read(int count, char **arguments, struct bench_settings *settings)
{
    char *text[TEXTS] = {NULL};
    struct reason why;
    bool help = false;
    *settings = (struct bench_settings){.argument_count = count, .arguments = (const char *const *)arguments};
    struct arguments read = arguments_begin("restitute bench", 2, count, arguments, table);
    const bool good = read_arguments(read.context, settings, text, &help, &why);
    const enum reading reading = arguments_close(&read, good, help, "\nMethods:", &why);
    for (int i = 0; help && i < BENCH_METHODS; i++)
        printf(" %s", bench_methods[i].name);
    if (help) fputs(footer, stdout);
    settings->output = text[TEXT_OUTPUT];
    settings->figure = text[TEXT_FIGURE];
    for (int i = 0; i < TEXT_OUTPUT; i++)
        free(text[i]);
    return reading;
}

void bench_options_release(struct bench_settings *settings)
{
    free(settings->output);
    free(settings->campaign.join);
    free(settings->figure);
}
