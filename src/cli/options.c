/* The command line of pair, history and sweep.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif
#ifdef RESTITUTE_WITH_BEM
#include <restitute/bem.h>
#endif

#include "arguments.h"

enum { CODE_RESUME = CODE_HELP + 1, CODE_BLOCKED, CODE_CONTOURS };

#define GROUP(table, title)                                                                                            \
    {                                                                                                                  \
        NULL, '\0', POPT_ARG_INCLUDE_TABLE, (table), 0, (title), NULL                                                  \
    }

static const char *const text_names[TEXT_COUNT] = {
    [TEXT_MATERIAL] = "material",
    [TEXT_PARTNER] = "partner",
    [TEXT_METHOD] = "method",
    [TEXT_TOLERANCE] = "tolerance",
    [TEXT_ELEMENTS] = "elements",
    [TEXT_TIME_STEP] = "time-step",
    [TEXT_MAX_WORK] = "max-work",
    [TEXT_TIME_LIMIT] = "time-limit",
    [TEXT_FORMAT] = "format",
    [TEXT_INPUT] = "input",
    [TEXT_OUTPUT] = "output",
    [TEXT_GRID] = "grid",
    [TEXT_FIGURE] = "figure",
    [TEXT_SAMPLES] = "samples",
    [TEXT_SPEED_LIMIT] = "speed-limit",
    [TEXT_RADIUS_LIMIT] = "radius-limit",
    [TEXT_DISPLACEMENT_LIMIT] = "displacement-limit",
    [TEXT_DUNDURS_LIMIT] = "dundurs-limit",
    [TEXT_THREADS] = "threads",
    [TEXT_EVENTS] = "events",
    [TEXT_FIELDS] = "fields",
    [TEXT_SHARD] = "shard",
    [TEXT_JOIN] = "join",
    [TEXT_SEED] = "seed",
};

static struct poptOption more_scene_options[] = {
    OPTION("material", CODE_TEXT + TEXT_MATERIAL, "FILE",
          "what deforms: a material file, .json, or .csv with tau_s,G_Pa; this or --modulus1"),
    OPTION(
        "partner", CODE_TEXT + TEXT_PARTNER, "rigid|same|FILE",
        "rigid: one of the two bodies deforms (default); same: both do, and are of the material; FILE: the material of "
        "the partner, if it is another one"),
    OPTION_FLAG("rotation-blocked", CODE_BLOCKED, "the spheres cannot rotate"), POPT_TABLEEND};

static struct poptOption solution_options[] = {
    OPTION("method", CODE_TEXT + TEXT_METHOD, "NAME",
          "euler (default): the foundation of the paper; sync: fast and precise, for tables and tolerances below 1e-3; "
          "cvode, cvode-bdf, cvode-adams: adaptive order and step, with events (component cvode); "
          "bem, bem-paper: boundary elements, an independent check (component bem)"),
    OPTION("tolerance", CODE_TEXT + TEXT_TOLERANCE, "ERROR",
          "absolute error of ez and ex, in [1e-8, 0.1]; default 1e-3"),
    OPTION("elements", CODE_TEXT + TEXT_ELEMENTS, "N",
          "elements over the largest contact radius, 4 to 1000000; default chosen"),
    OPTION("time-step", CODE_TEXT + TEXT_TIME_STEP, "STEP",
          "in T, or in s with a material; > 0; default chosen; not with sync"),
    OPTION("max-work", CODE_TEXT + TEXT_MAX_WORK, "SECONDS",
          "most work an impact may take, in nominal seconds, the same on every machine; default 10"),
    OPTION("time-limit", CODE_TEXT + TEXT_TIME_LIMIT, "SECONDS",
          "processor time an impact may take; 0 (default): 1, no limit with --elements, --time-step or bem"),
    OPTION("speed-limit", CODE_TEXT + TEXT_SPEED_LIMIT, "RATIO",
          "flag FAST above this normal speed over wave speed; default 0.1"),
    OPTION("radius-limit", CODE_TEXT + TEXT_RADIUS_LIMIT, "RATIO",
          "flag LARGE_CONTACT above this contact radius over radius; default 0.1"),
    OPTION("displacement-limit", CODE_TEXT + TEXT_DISPLACEMENT_LIMIT, "RATIO",
          "flag LONG_SLIDE above this slide over contact radius; default 0.3"),
    OPTION("dundurs-limit", CODE_TEXT + TEXT_DUNDURS_LIMIT, "BETA", "flag COUPLED above this constant of Dundurs; default 0.1"),
    POPT_TABLEEND};

static struct poptOption pair_output_options[] = {
    OPTION("format", CODE_TEXT + TEXT_FORMAT, "text|csv|json", "default text for one impact, csv for many"),
    OPTION("input", CODE_TEXT + TEXT_INPUT, "CASES.csv", "one impact a row, columns by name; -: standard input"),
    OPTION("grid", CODE_TEXT + TEXT_GRID, "AXES",
          "one or two axes NAME=FROM:TO:N[:log], NAME of any number above, or material=FILE:FILE:...: all impacts of "
          "the grid, for example speed=0.1:10:9:log,angle=5:85:9"),
    OPTION("output", CODE_TEXT + TEXT_OUTPUT, "FILE", "write here and not to standard output"),
    OPTION("figure", CODE_TEXT + TEXT_FIGURE, "FILE",
          "with --grid, or --input with one or two columns that vary: a figure of it, .svg, .png or .pdf; needs "
          "gnuplot"),
    OPTION_FLAG("contours", CODE_CONTOURS, "with --figure: contours over both axes, the last one to the right"),
    OPTION("threads", CODE_TEXT + TEXT_THREADS, "N",
          "with --input and --grid: number of threads, 1 to 1024; default all processors"),
    OPTION_FLAG("resume", CODE_RESUME, "continue an interrupted run from FILE.partial"),
    OPTION("shard", CODE_TEXT + TEXT_SHARD, "I/K", "solve part I of K of the rows alone, without figure"),
    OPTION("join", CODE_TEXT + TEXT_JOIN, "FILE,...",
          "finished shards in their order; rows that are in them are not solved again"),
    OPTION_HELP,
    POPT_TABLEEND};

static struct poptOption sweep_options[] = {
    OPTION("seed", CODE_TEXT + TEXT_SEED, "N",
          "the impacts drawn for a figure with a name, 0 to 4294967295; default 2017"),
    POPT_TABLEEND};

static struct poptOption history_output_options[] = {
    OPTION("samples", CODE_TEXT + TEXT_SAMPLES, "N",
          "largest number of rows, equally spaced in time, 2 to 1000000; default 500"),
    OPTION("output", CODE_TEXT + TEXT_OUTPUT, "FILE", "write the CSV here and not to standard output"),
    OPTION("events", CODE_TEXT + TEXT_EVENTS, "FILE",
          "write the log of events here, as CSV (.csv, or - for standard output) or HDF5 (.h5, .hdf5); takes the "
          "method cvode"),
    OPTION("figure", CODE_TEXT + TEXT_FIGURE, "FILE", "a figure of it, .svg or .png; needs gnuplot"),
    OPTION("fields", CODE_TEXT + TEXT_FIELDS, "FILE",
          "with --method bem: pressure, traction and stick map at nine times to .h5 or .hdf5, or the middle one to "
          ".svg or .png"),
    OPTION_HELP,
    POPT_TABLEEND};

static const char pair_footer[] =
    "\nOne impact:\n"
    "  restitute pair --chi 1.1667 --psi 2 --delta1 1 --gamma 1\n"
    "  restitute pair --material polyisobutylene.json --radius 0.005 --density 7800 --friction 0.3 --velocity 1 "
    "--angle 30\n"
    "Many, from a file or a grid:\n"
    "  restitute pair --input cases.csv --output results.csv\n"
    "  restitute pair --material polyisobutylene.json --radius 0.005 --density 7800 --friction 0.3 \\\n"
    "      --grid speed=0.1:10:9:log,angle=5:85:9 --output grid.csv --figure grid.svg\n"
    "\nColumns of CASES.csv: chi, psi, delta1, gamma, delta2, or radius1_m, density1_kg_m3, mass1_kg, inertia1_kg_m2,\n"
    "radius2_m, density2_kg_m3, mass2_kg, inertia2_kg_m2, speed_m_s, angle_deg, spin_rad_s, spin2_rad_s, friction,\n"
    "material, partner, rotation_blocked (0 or 1). Options give the values of columns that are absent. A result row "
    "holds\n"
    "the input columns, then ez, ex, contact_time, max_indentation (s and m; T and d0 if dimensionless), error_ez,\n"
    "error_ex, method and status, which is empty or tells why the row failed. Provenance goes into FILE.meta.json.\n"
    "\nez, ex: minus the velocity after over the velocity before, normal and tangential, of the contact point.\n"
    "Exit status: 0 done, 1 some rows failed, 2 bad usage or input, nothing written, 130 interrupted.\n";

static const char sweep_footer[] =
    "\nA figure by its name, into the folder --output (default: here) as NAME.csv, .h5, .svg and .pdf:\n"
    "  restitute sweep fig4 --output figures\n"
    "  restitute sweep all --output figures\n"
    "fig4, fig6: ez; fig5, fig8, fig9: ex over delta1 and psi; fig7: ex without slip; fig10, fig11: psi_c and the\n"
    "error of its formula; maxwell, temperature (takes --material), tangent, friction: beyond the paper.\n"
    "Impacts are drawn at random in SI units; their scatter about the curves of the dimensionless numbers is printed.\n"
    "The method is sync and the tolerance 1e-5, if not said otherwise. Of the options above a figure with a name "
    "takes\n"
    "those of the solution, --output, --threads, --resume, --shard and --join K, the number of shards.\n"
    "\nOr any other, as with restitute pair --grid and --input:\n"
    "  restitute sweep --gamma 0.1 --grid psi=0.1:5:50,delta1=0.01:100:50:log --output g.csv --figure g.svg "
    "--contours\n"
    "\nExit status: 0 done, 1 some rows or checks failed, 2 bad usage or input, 130 interrupted.\n";

static const char history_footer[] =
    "\nExample:\n"
    "  restitute history --material polyisobutylene.json --radius 0.005 --density 7800 --friction 0.3 --velocity 1 \\\n"
    "      --angle 30 --output impact.csv --figure impact.svg\n"
    "\nThe CSV has the columns time_s, indentation_m, contact_radius_m, stick_radius_m, normal_force_N,\n"
    "tangential_force_N, normal_velocity_m_s, tangential_velocity_m_s; for a dimensionless impact their names end in "
    "the\n"
    "scales instead: _T, _d0, _a_el, _F0, _mu_F0, _v0 and _V0 (see the manual page). Exit status: 0 done, 2 failed.\n";

static bool is_dimensionless(enum field field)
{
    return field <= FIELD_LAST_DIMENSIONLESS;
}

static bool is_physical(enum field field)
{
    return field > FIELD_LAST_DIMENSIONLESS;
}

static bool take_option(struct settings *settings, int code, poptContext context, struct reason *why)
{
    if (code == CODE_RESUME)
        settings->resume = true;
    else if (code == CODE_CONTOURS)
        settings->contours = true;
    else if (code == CODE_BLOCKED)
        settings->values.rotation_blocked = 1;
    else if (code >= CODE_TEXT)
        return option_keep(text_names[code - CODE_TEXT], &settings->text[code - CODE_TEXT], poptGetOptArg(context), why);
    else
        return option_keep(field_rules[code - CODE_FIELD].option, &settings->field[code - CODE_FIELD],
                         poptGetOptArg(context), why);
    return true;
}

/* A number of a text option within [low, high]; integers only if so wanted. Not given: left as it
 * is. */
static bool read_bounded(const struct settings *settings, enum text_option option, double low, double high, bool whole,
                         double *value, struct reason *why)
{
    return option_number(text_names[option], settings->text[option], low, high, whole, value, why);
}

static bool read_solver(struct settings *settings, struct reason *why)
{
    restitute_options *solver = &settings->solver;
    double elements = 0, samples = 500, threads = 0;
    double step = 0;
    restitute_options_init(solver);
    if (!read_bounded(settings, TEXT_TOLERANCE, 1e-8, 0.1, false, &solver->tolerance, why) ||
        !read_bounded(settings, TEXT_ELEMENTS, 4, 1e6, true, &elements, why) ||
        !read_bounded(settings, TEXT_TIME_STEP, 1e-300, 1e300, false, &step, why) ||
        !read_bounded(settings, TEXT_MAX_WORK, 1e-9, INFINITY, false, &solver->max_work, why) ||
        !read_bounded(settings, TEXT_TIME_LIMIT, 0, INFINITY, false, &solver->time_limit, why) ||
        !read_bounded(settings, TEXT_SAMPLES, 2, 1e6, true, &samples, why) ||
        !read_bounded(settings, TEXT_THREADS, 1, 1024, true, &threads, why) ||
        !read_bounded(settings, TEXT_SPEED_LIMIT, 0, INFINITY, false, &solver->speed_limit, why) ||
        !read_bounded(settings, TEXT_RADIUS_LIMIT, 0, INFINITY, false, &solver->radius_limit, why) ||
        !read_bounded(settings, TEXT_DISPLACEMENT_LIMIT, 0, INFINITY, false, &solver->displacement_limit, why) ||
        !read_bounded(settings, TEXT_DUNDURS_LIMIT, 0, INFINITY, false, &solver->dundurs_limit, why))
        return false;
    solver->elements = (int64_t)elements;
    solver->time_step = step;
    solver->threads = (int)threads;
    settings->samples = (size_t)samples;
    return true;
}

static bool read_shard(struct settings *settings, struct reason *why)
{
    double seed = 2017;
    if (!read_bounded(settings, TEXT_SEED, 0, 4294967295.0, true, &seed, why)) return false;
    settings->seed = (unsigned)seed;
    return option_shard(settings->text[TEXT_SHARD], &settings->shard, &settings->shards, why);
}

/* The methods of this build, the default first. */
static const restitute_method *(*const methods[])(void) = {
    restitute_method_euler, restitute_method_sync,
#ifdef RESTITUTE_WITH_CVODE
    restitute_method_cvode, restitute_method_cvode_bdf, restitute_method_cvode_adams,
#endif
#ifdef RESTITUTE_WITH_BEM
    restitute_method_bem, restitute_method_bem_paper,
#endif
};
enum { METHODS = sizeof methods / sizeof *methods };

static bool read_method(struct settings *settings, struct reason *why)
{
    const char *text = settings->text[TEXT_METHOD];
    char names[128] = "";
    if (!text) return true;
    for (int i = 0; i < METHODS; i++) {
        const char *name = restitute_method_name(methods[i]());
        if (strcmp(text, name) == 0) {
            settings->solver.method = methods[i]();
            return true;
        }
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "", name);
    }
#ifndef RESTITUTE_WITH_CVODE
    if (strncmp(text, "cvode", strlen("cvode")) == 0)
        return refuse(why,
                      "--method = \"%.64s\": the component cvode is not in this build (SUNDIALS; Debian: "
                      "libsundials-dev); must be among %s",
                      text, names);
#endif
#ifndef RESTITUTE_WITH_BEM
    if (strncmp(text, "bem", strlen("bem")) == 0)
        return refuse(why,
                      "--method = \"%.64s\": the component bem is not in this build (FFTW; Debian: libfftw3-dev); "
                      "must be among %s",
                      text, names);
#endif
    return refuse(why, "--method = \"%.64s\": is not in this build; must be among %s", text, names);
}

static bool read_words(struct settings *settings, struct reason *why)
{
    static const char *const formats[] = {"text", "csv", "json"};
    char *const *text = settings->text;
    if (text[TEXT_PARTNER] && !partner_read(text[TEXT_PARTNER], "--partner", &settings->values, why)) return false;
    settings->values.material = text[TEXT_MATERIAL];
    for (int i = 0; i < 3 && text[TEXT_FORMAT]; i++)
        if (strcmp(text[TEXT_FORMAT], formats[i]) == 0) settings->format = FORMAT_TEXT + i;
    if (text[TEXT_FORMAT] && settings->format == FORMAT_DEFAULT)
        return refuse(why, "--format = \"%.64s\": must be text, csv or json", text[TEXT_FORMAT]);
    return read_method(settings, why);
}

static bool read_arguments(poptContext context, struct settings *settings, bool *help, struct reason *why)
{
    int code;
    while ((code = poptGetNextOpt(context)) > 0) {
        if (code == CODE_HELP) {
            *help = true;
            return true;
        }
        if (!take_option(settings, code, context, why)) return false;
    }
    if (!arguments_end(context, code, settings->command == COMMAND_SWEEP ? &settings->sweep : NULL, why)) return false;
    return read_solver(settings, why) && values_read(settings->field, &settings->values, why) &&
           read_words(settings, why) && read_shard(settings, why);
}

enum reading options_read(int count, char **arguments, struct settings *settings)
{
    static const char *const names[] = {"restitute pair", "restitute history", "restitute sweep"};
    static const char *const footers[] = {pair_footer, history_footer, sweep_footer};
    const bool history = strcmp(arguments[1], "history") == 0, sweep = strcmp(arguments[1], "sweep") == 0;
    struct poptOption *dimensionless = field_options(is_dimensionless, NULL);
    struct poptOption *physical = field_options(is_physical, more_scene_options);
    struct poptOption all[] = {GROUP(dimensionless, "An impact in dimensionless numbers:"),
                               GROUP(physical, "or in SI units, a sphere against a wall or a second sphere:"),
                               GROUP(solution_options, "How it is solved:"),
                               GROUP(history ? history_output_options : pair_output_options, "Input and output:"),
                               GROUP(sweep_options, "Figures with a name:"),
                               POPT_TABLEEND};
    memset(settings, 0, sizeof *settings);
    if (!sweep) all[4] = all[5];
    settings->command = history ? COMMAND_HISTORY : sweep ? COMMAND_SWEEP : COMMAND_PAIR;
    settings->values = values_none();
    settings->argument_count = count;
    settings->arguments = (const char *const *)arguments;
    struct arguments read = arguments_begin(names[settings->command], 2, count, arguments, all);
    if (sweep) poptSetOtherOptionHelp(read.context, "[NAME] [OPTION...]");
    struct reason why;
    bool help = false;
    const bool good = read_arguments(read.context, settings, &help, &why);
    const enum reading reading = arguments_close(&read, good, help, footers[settings->command], &why);
    free(dimensionless);
    free(physical);
    return reading;
}

void options_release(struct settings *settings)
{
    free(settings->sweep);
    for (int i = 0; i < TEXT_COUNT; i++)
        free(settings->text[i]);
    for (int i = 0; i < FIELD_COUNT; i++)
        free(settings->field[i]);
}
