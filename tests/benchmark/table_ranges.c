/* A table of four axes over the whole domain: how long its build takes, with how many impacts, and what it is worth at ten thousand
 * random places; a lookup beside pow, one at a time and many at once.
 *
 *     table_ranges [TOLERANCE [THREADS]]        1e-4, 2
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <restitute/table.h>

#include "../support/random.h"

enum { places = 10000, lookups = 100000, repeats = 15 };

static double seconds(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

struct numbers {
    double chi, psi, delta1, gamma;
};

static struct numbers draw(uint64_t *state)
{
    return (struct numbers){random_in(state, 2.0 / 3, 7.0 / 4), random_in(state, 0, 4), random_log(state, 1e-3, 100),
                            random_log(state, 1e-3, 1000)};
}

static restitute_table *build(double tolerance, int threads)
{
    restitute_table *table = NULL;
    restitute_table_family family;
    restitute_table_options options;
    restitute_table_info info;
    restitute_error error;
    restitute_table_family_init(&family);
    family.chi[0] = 2.0 / 3, family.chi[1] = 7.0 / 4;
    family.gamma[0] = 1e-3, family.gamma[1] = 1000;
    restitute_table_options_init(&options);
    options.tolerance = tolerance;
    options.threads = threads;
    const double wall = seconds(CLOCK_MONOTONIC), processor = seconds(CLOCK_PROCESS_CPUTIME_ID);
    if (restitute_table_build(&family, &options, &table, &error) < 0) {
        fprintf(stderr, "%s\n", error.message);
        exit(1);
    }
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    printf("tolerance %g: %.0f s with %d threads, %.0f s of processor, %lld impacts\n", tolerance,
           seconds(CLOCK_MONOTONIC) - wall, threads, seconds(CLOCK_PROCESS_CPUTIME_ID) - processor,
           (long long)info.impacts);
    printf("verified at %lld places: %.1e (ez), %.1e (ex)\n%lld cells; %.0f MB\n", (long long)info.checks,
           info.error_ez, info.error_ex, (long long)info.nodes[0], (double)info.bytes / 1e6);
    return table;
}

/* Against impacts solved to a tenth of the tolerance. */
static void compare(const restitute_table *table, double tolerance, int threads)
{
    static restitute_impact impacts[places];
    static restitute_result results[places];
    restitute_options options;
    restitute_error error;
    uint64_t state = 9;
    double ez = 0, ex = 0;
    int above = 0;
    for (int i = 0; i < places; i++) {
        const struct numbers at = draw(&state);
        restitute_impact_init(&impacts[i]);
        restitute_result_init(&results[i]);
        impacts[i].chi = at.chi, impacts[i].psi = at.psi, impacts[i].delta1 = at.delta1, impacts[i].gamma = at.gamma;
    }
    restitute_options_init(&options);
    options.method = restitute_method_sync();
    options.tolerance = tolerance / 10;
    if (restitute_solve_many(&options, places, impacts, results, NULL, threads, &error) < 0) {
        fprintf(stderr, "%s\n", error.message);
        exit(1);
    }
    for (int i = 0; i < places; i++) {
        restitute_table_value pair;
        restitute_table_numbers_pair(table, impacts[i].chi, impacts[i].psi, impacts[i].delta1, impacts[i].gamma, &pair);
        const double off_ez = fabs(pair.ez - results[i].ez), off_ex = fabs(pair.ex - results[i].ex);
        above += off_ez > tolerance || off_ex > tolerance;
        ez = fmax(ez, off_ez);
        ex = fmax(ex, off_ex);
    }
    printf("at %d random places: %.1e (ez), %.1e (ex), above the tolerance at %d\n", places, ez, ex, above);
}

static volatile double sink;

/* Of `lookups` places each, in seconds */
struct times {
    double pow, one, many;
};

static struct times time_once(const restitute_table *table, const struct numbers *at, const double *const column[4])
{
    static double ez[lookups], ex[lookups];
    double sum = 0;
    const double start = seconds(CLOCK_MONOTONIC);
    for (int i = 0; i < lookups; i++)
        sum += pow(at[i].delta1, 0.2);
    const double end_pow = seconds(CLOCK_MONOTONIC);
    for (int i = 0; i < lookups; i++) {
        restitute_table_value pair;
        restitute_table_numbers_pair(table, at[i].chi, at[i].psi, at[i].delta1, at[i].gamma, &pair);
        sum += pair.ex;
    }
    const double end_one = seconds(CLOCK_MONOTONIC);
    restitute_table_numbers_pairs(table, lookups, column[0], column[1], column[2], column[3], ez, ex);
    const double end_many = seconds(CLOCK_MONOTONIC);
    sink = sum + ex[lookups - 1];
    return (struct times){end_pow - start, end_one - end_pow, end_many - end_one};
}

static void look_up(const restitute_table *table)
{
    static struct numbers at[lookups];
    static double column[4][lookups];
    const double *const columns[4] = {column[0], column[1], column[2], column[3]};
    struct times best = {INFINITY, INFINITY, INFINITY};
    uint64_t state = 10;
    for (int i = 0; i < lookups; i++) {
        at[i] = draw(&state);
        column[0][i] = at[i].chi, column[1][i] = at[i].psi, column[2][i] = at[i].delta1, column[3][i] = at[i].gamma;
    }
    for (int r = 0; r < repeats; r++) {
        const struct times once = time_once(table, at, columns);
        best = (struct times){fmin(best.pow, once.pow), fmin(best.one, once.one), fmin(best.many, once.many)};
    }
    printf("lookup at random places %.0f ns, many at once %.0f ns, pow %.1f ns: %.1f and %.1f of them\n",
           best.one / lookups * 1e9, best.many / lookups * 1e9, best.pow / lookups * 1e9, best.one / best.pow,
           best.many / best.pow);
}

int main(int count, char **argument)
{
    const double tolerance = count > 1 ? atof(argument[1]) : 1e-4;
    const int threads = count > 2 ? atoi(argument[2]) : 2;
    restitute_table *table = build(tolerance, threads);
    compare(table, tolerance, threads);
    look_up(table);
    restitute_table_destroy(table);
    return 0;
}
