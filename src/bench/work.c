/* Medians of steps, re-initialisations and events.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "work.h"

#include <stdlib.h>
#include <string.h>

#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif

void bench_read_work(const restitute_options *options, const restitute_impact *impact, struct bench_run *run)
{
    run->restarts = run->events = 0;
#ifdef RESTITUTE_WITH_CVODE
    restitute_options recorded = *options;
    restitute_cvode_recorder *recorder;
    restitute_solver *solver;
    restitute_cvode_work work;
    restitute_cvode_work_init(&work);
    if (restitute_cvode_recorder_create(options->method, &recorder, NULL) < 0) return; /* another method */
    recorded.method = restitute_cvode_recorder_method(recorder);
    if (restitute_solver_create(&recorded, &solver, NULL) == RESTITUTE_OK) {
        restitute_solve(solver, impact, NULL, NULL, NULL, NULL);
        restitute_cvode_recorder_work(recorder, &work, NULL);
        restitute_solver_destroy(solver);
    }
    restitute_cvode_recorder_destroy(recorder);
    run->restarts = work.restarts;
    run->events = work.events;
#else
    (void)options, (void)impact;
#endif
}

static int by_value(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

/* Median; sorts the values. */
static int64_t median(int64_t *values, size_t n)
{
    qsort(values, n, sizeof *values, by_value);
    return values[n / 2];
}

/* One line: a method at a tolerance. values: room for three times as many as there are runs. */
static void print_line(const struct bench_runs *runs, int method, double tolerance, int64_t *values, FILE *stream)
{
    size_t n = 0;
    for (size_t i = 0; i < runs->count; i++) {
        const struct bench_run *r = &runs->runs[i];
        if (r->method != method || r->tolerance != tolerance || r->status < 0) continue;
        values[n] = r->steps;
        values[runs->count + n] = r->restarts;
        values[2 * runs->count + n] = r->events;
        n++;
    }
    if (n == 0) return;
    const int64_t steps = median(values, n), restarts = median(values + runs->count, n);
    const int64_t events = median(values + 2 * runs->count, n);
    fprintf(stream, "  %-11s %9.0e %6zu %8lld", bench_methods[method].name, tolerance, n, (long long)steps);
    if (events > 0) fprintf(stream, " %8lld %8lld", (long long)restarts, (long long)events);
    fputc('\n', stream);
}

void bench_print_work(const struct bench_runs *runs, unsigned methods, FILE *stream)
{
    int64_t *values = malloc((3 * runs->count + 1) * sizeof *values);
    if (!values) return;
    fputs("\nMedians of the steps of the last run, and of restarts and events in all runs of a call\n"
          "  method      tolerance scenes    steps restarts   events\n",
          stream);
    for (int m = 0; m < BENCH_METHODS; m++)
        for (size_t i = 0; i < runs->count && (methods & 1u << m) && bench_methods[m].handle; i++) {
            size_t before = 0; /* each tolerance once */
            while (before < i &&
                   !(runs->runs[before].method == m && runs->runs[before].tolerance == runs->runs[i].tolerance))
                before++;
            if (before == i && runs->runs[i].method == m) print_line(runs, m, runs->runs[i].tolerance, values, stream);
        }
    free(values);
}
