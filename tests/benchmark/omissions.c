/* Benchmark: one default impact per class of material, and what is saved by leaving out what a scene does not need.
 *
 *     omissions [REPEATS] > omissions.csv
 *
 * Every omission is timed beside the same impact computed in full, at equal elements and steps, the two in turn; the
 * ratio full/lean is of medians in this one run. Links to the inside of the library, where the full way can be asked for.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "euler.h"

enum { max_terms = 32, max_repeats = 1000 };

struct solid {
    const char *name;
    double g_inf, eta;
    int64_t n_terms;
    double g[max_terms], tau[max_terms];
};

struct timing {
    double low, median, high; /* us */
    struct rst_outcome outcome;
};

static struct rst_workspace workspace;

static double now_us(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e6 + (double)t.tv_nsec * 1e-3;
}

/* One impact by the default method; the solid is copied as the solver would. */
static double time_once(const struct solid *solid, double psi, enum rst_mode mode, int64_t elements, double step,
                        int ledger, struct rst_outcome *outcome)
{
    restitute_error error = {0};
    if (rst_workspace_terms(&workspace, max_terms)) exit(1);
    struct rst_problem problem = {.chi = 7.0 / 6.0,
                                  .psi = psi,
                                  .mode = mode,
                                  .tolerance = elements ? 0.1 : 1e-3,
                                  .elements = elements,
                                  .time_step = step,
                                  .time_unit = 1,
                                  .unit_name = "T",
                                  .max_updates = INT64_MAX / 8,
                                  .solid = {.g_inf = solid->g_inf,
                                            .eta = solid->eta,
                                            .n_terms = solid->n_terms,
                                            .g = workspace.terms,
                                            .tau = workspace.terms + max_terms}};
    memcpy(problem.solid.g, solid->g, sizeof solid->g);
    memcpy(problem.solid.tau, solid->tau, sizeof solid->tau);
    double start = now_us();
    int status = rst_method_euler.solve(&problem, &workspace, ledger, outcome, &error);
    double elapsed = now_us() - start;
    if (status < 0) {
        fprintf(stderr, "omissions: %s: %s\n", solid->name, error.message);
        exit(1);
    }
    return elapsed;
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void summarise(double *samples, int n, struct timing *timing)
{
    qsort(samples, (size_t)n, sizeof *samples, by_value);
    timing->low = samples[0];
    timing->median = samples[n / 2];
    timing->high = samples[n - 1];
}

static void print_row(const char *table, const char *scene, const char *variant, const struct timing *t, double ratio)
{
    printf("%s,%s,%s,%lld,%lld,%.2f,%.2f,%.2f,%.3f\n", table, scene, variant, (long long)t->outcome.elements,
           (long long)t->outcome.steps, t->low, t->median, t->high, ratio);
}

/* Default impacts, tolerance 1e-3; ratio is to the elastic one. */
static void classes(const struct solid *solids, int n, int repeats)
{
    static double samples[max_terms][max_repeats];
    struct timing timing[max_terms];
    for (int r = 0; r < repeats; r++)
        for (int i = 0; i < n; i++)
            samples[i][r] = time_once(&solids[i], 0.7, RST_PARTIAL_SLIP, 0, 0, 0, &timing[i].outcome);
    for (int i = 0; i < n; i++) {
        summarise(samples[i], repeats, &timing[i]);
        print_row("class", solids[i].name, "default", &timing[i], timing[i].median / timing[0].median);
    }
}

struct variant {
    const char *name;
    const struct solid *solid;
    double psi;
    enum rst_mode mode;
    int ledger;
};

/* The same impact in full and lean. */
static void omission(const char *scene, struct variant full, struct variant lean, int repeats)
{
    static double samples[2][max_repeats];
    const struct variant variants[2] = {full, lean};
    struct timing timing[2];
    for (int r = 0; r < repeats; r++)
        for (int v = 0; v < 2; v++)
            samples[v][r] = time_once(variants[v].solid, variants[v].psi, variants[v].mode, 64, 1e-3,
                                      variants[v].ledger, &timing[v].outcome);
    for (int v = 0; v < 2; v++)
        summarise(samples[v], repeats, &timing[v]);
    for (int v = 0; v < 2; v++)
        print_row("omission", scene, variants[v].name, &timing[v], timing[0].median / timing[v].median);
}

/* Thirty terms a third of a decade apart, of which a contact of about 3 T feels a few. */
static struct solid long_prony(void)
{
    struct solid s = {.name = "Prony 30 terms", .g_inf = 1, .n_terms = 30};
    for (int k = 0; k < 30; k++) {
        s.tau[k] = pow(10, -9 + 0.6 * k);
        s.g[k] = s.tau[k] < 1 ? 0.3 : 0.03;
    }
    return s;
}

static struct solid merged(const struct solid *solid)
{
    struct solid s = *solid;
    double slow_rate, fast_bound;
    s.name = "Prony 30 terms merged";
    rst_merge_terms(7.0 / 6.0, 6, 1, 1e-4, &s.g_inf, &s.eta, &s.n_terms, s.g, s.tau, &slow_rate, &fast_bound);
    return s;
}

int main(int argc, char **argv)
{
    int repeats = argc > 1 ? atoi(argv[1]) : 51;
    if (argc > 2 || repeats < 1 || repeats > max_repeats) {
        fprintf(stderr, "usage: omissions [REPEATS, 1 to %d] > FILE.csv\n", max_repeats);
        return 2;
    }
    struct solid prony = long_prony(), prony_merged = merged(&prony);
    struct solid elastic = {.name = "elastic", .g_inf = 1};
    struct solid standard = {.name = "standard solid", .g_inf = 1, .n_terms = 1, .g = {1}, .tau = {1.46}};
    struct solid weak = {.name = "elastic", .g_inf = 1, .n_terms = 1, .g = {1e-12}, .tau = {1}};
    struct solid voigt = {.name = "Kelvin-Voigt", .g_inf = 1, .eta = 0.3};
    struct solid maxwell = {.name = "Maxwell", .n_terms = 1, .g = {1}, .tau = {3}};
    struct solid classes_of[] = {elastic, voigt, maxwell, standard, prony_merged, prony};
    double slip = 5; /* above psi_c of all of these solids: psi_c <= 4 chi - 1 = 3.67 */

    printf("table,scene,variant,elements,steps,us_min,us_median,us_max,ratio\n");
    classes(classes_of, 6, repeats);
    struct variant partial = {"element by element", &standard, 0.7, RST_PARTIAL_SLIP, 0};
    omission("elastic", (struct variant){"with dashpot states", &weak, 0.7, RST_PARTIAL_SLIP, 0},
             (struct variant){"without", &elastic, 0.7, RST_PARTIAL_SLIP, 0}, repeats);
    omission("frictionless", partial, (struct variant){"no tangential states", &standard, 0.7, RST_FRICTIONLESS, 0},
             repeats);
    omission("full slip", (struct variant){"element by element", &standard, slip, RST_PARTIAL_SLIP, 0},
             (struct variant){"closed form", &standard, slip, RST_GROSS_SLIP, 0}, repeats);
    omission("gross slip first", (struct variant){"element by element", &standard, 1.6, RST_PARTIAL_SLIP, 0},
             (struct variant){"phase skipped", &standard, 1.6, RST_GROSS_SLIP, 0}, repeats);
    omission("no slip", (struct variant){"with friction limit", &standard, 1e-9, RST_PARTIAL_SLIP, 0},
             (struct variant){"without", &standard, 1, RST_NO_SLIP, 0}, repeats);
    omission("Prony 30 terms", (struct variant){"all terms", &prony, 0.7, RST_PARTIAL_SLIP, 0},
             (struct variant){"merged", &prony_merged, 0.7, RST_PARTIAL_SLIP, 0}, repeats);
    omission("energy ledger", (struct variant){"kept", &standard, 0.7, RST_PARTIAL_SLIP, 1},
             (struct variant){"not asked for", &standard, 0.7, RST_PARTIAL_SLIP, 0}, repeats);
    rst_workspace_free(&workspace);
    return ferror(stdout) != 0;
}
