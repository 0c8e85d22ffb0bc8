/* SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif

enum { least_repeats = 5, most_repeats = 1000 };
static const double full = 1e-3, long_work = 0.01;

/* Of the nominal seconds of `max_work` no method does more in a second. */
static const double work_per_second = 5;

static const struct bench_method methods[] = {
    {.name = "euler", .handle = restitute_method_euler, .takes_time_step = 1},
    {.name = "sync", .handle = restitute_method_sync},
#ifdef RESTITUTE_WITH_CVODE
    {.name = "cvode", .handle = restitute_method_cvode},
#endif
    {.name = "paper-euler", .motion = PAPER_EULER, .takes_time_step = 1},
    {.name = "paper-verlet", .motion = PAPER_VERLET, .takes_time_step = 1},
    {.name = "paper-forward", .motion = PAPER_FORWARD, .takes_time_step = 1},
};

const struct bench_method *bench_method(const char *name)
{
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    return NULL;
}

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_time(void)
{
    return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

double bench_clock(void)
{
    return seconds_of(CLOCK_MONOTONIC);
}

static int by_value(const void *a, const void *b)
{
    return (*(const double *)a > *(const double *)b) - (*(const double *)a < *(const double *)b);
}

double bench_median(double *values, size_t n)
{
    qsort(values, n, sizeof *values, by_value);
    return n % 2 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

static double time_once(void (*work)(void *context), void *context)
{
    const double start = bench_time();
    work(context);
    return bench_time() - start;
}

double bench_time_of(void (*work)(void *context), void *context)
{
    double samples[most_repeats], sum = 0;
    size_t n = 0;
    const double first = time_once(work, context);
    if (first > long_work) return first;
    while (n < least_repeats || (n < most_repeats && sum < full)) {
        samples[n] = time_once(work, context);
        sum += samples[n++];
    }
    return bench_median(samples, n);
}

static void stop(const char *what, const char *why)
{
    fprintf(stderr, "benchmark: %s: %s\n", what, why);
    exit(2);
}

/* One impact by the library or by the paper's algorithm, as bench_time_of() wants it. */
struct solve {
    const struct bench_scene *scene;
    restitute_solver *solver; /* NULL: the paper's algorithm */
    restitute_result result;
    struct paper_settings settings;
    enum paper_end end;
    int status;
};

static void solve(void *context)
{
    struct solve *s = context;
    if (s->solver)
        s->status = restitute_solve(s->solver, &s->scene->impact, &s->result, NULL, NULL, NULL);
    else
        s->end = paper_solve(&s->scene->paper, &s->settings, &s->result.ez, &s->result.ex, &s->result.steps);
}

static restitute_solver *solver_of(const restitute_options *options)
{
    restitute_solver *solver;
    restitute_error error;
    if (restitute_solver_create(options, &solver, &error) < 0) stop("solver", error.message);
    return solver;
}

/* The solid of the line in the units of the paper's algorithm, theta = sqrt(32/15) delta1 (23). */
static void read_solid(char *terms, struct bench_scene *s)
{
    struct paper_problem *p = &s->paper;
    const double theta = sqrt(32.0 / 15) * s->delta1;
    restitute_error error;
    int length;
    if (isnan(s->delta1)) {
        for (; sscanf(terms, "%lf:%lf%n", &p->g[p->n_terms], &p->tau[p->n_terms], &length) == 2; terms += length)
            if (++p->n_terms == PAPER_TERMS) break;
        if (restitute_material_prony(p->g_inf, 0, p->n_terms, p->tau, p->g, 0.5, &s->solid, &error) < 0)
            stop(s->name, error.message);
    } else if (s->gamma == 0) {
        p->eta = theta;
    } else if (theta > 0) {
        p->n_terms = 1;
        p->g[0] = 1 / s->gamma;
        p->tau[0] = s->gamma * theta;
    }
}

int bench_read_scene(FILE *file, struct bench_scene *s)
{
    char line[2048];
    int terms = 0;
    do
        if (!fgets(line, sizeof line, file)) return 0;
    while (strncmp(line, "name,", 5) == 0);
    *s = (struct bench_scene){.radius = 1};
    if (sscanf(line, "%47[^,],%lf,%lf,%lf,%lf,%lf,%n", s->name, &s->paper.chi, &s->paper.psi, &s->delta1, &s->gamma,
               &s->paper.g_inf, &terms) != 6 || terms == 0)
        stop("no scene", line);
    read_solid(line + terms, s);
    restitute_impact_init(&s->impact);
    s->impact.chi = s->paper.chi;
    s->impact.psi = s->paper.psi;
    s->impact.material = s->solid;
    if (!s->solid) s->impact.delta1 = s->delta1, s->impact.gamma = s->gamma;
    restitute_options options;
    restitute_options_init(&options);
    options.method = restitute_method_sync();
    struct solve once = {.scene = s, .solver = solver_of(&options)};
    restitute_result_init(&once.result);
    solve(&once);
    if (once.status < 0) stop(s->name, restitute_status_text(once.status));
    restitute_solver_destroy(once.solver);
    s->radius = once.result.max_contact_radius;
    s->contact_time = once.result.contact_time;
    return 1;
}

void bench_print_head(void)
{
    puts("scene,method,tolerance,elements_asked,steps_asked,seconds,outcome,ez,ex,error_ez,error_ex,elements,steps");
}

static const char *outcome_of(const struct solve *s)
{
    if (!s->solver) return s->end == PAPER_SEPARATED ? "solved" : "unstable";
    if (s->status >= 0) return s->status == RESTITUTE_TOLERANCE_NOT_REACHED ? "not reached" : "solved";
    return s->status == RESTITUTE_ERROR_TOO_MUCH_WORK || s->status == RESTITUTE_ERROR_CONVERGENCE ? "slow" : "refused";
}

double bench_run(const struct bench_scene *scene, const struct bench_method *method, double tolerance, int64_t elements,
                 int64_t steps, double budget)
{
    struct solve s = {.scene = scene};
    restitute_options options;
    restitute_options_init(&options);
    restitute_result_init(&s.result);
    if (method->handle) {
        options.method = method->handle();
        options.tolerance = tolerance;
        options.elements = elements;
        if (steps > 0 && method->takes_time_step) options.time_step = scene->contact_time / (double)steps;
        options.max_work = budget * work_per_second;
        options.time_limit = INFINITY;
        s.solver = solver_of(&options);
    } else { /* told radius and contact time, so that no element is wasted; a coarse run may go deeper */
        s.settings = (struct paper_settings){method->motion, elements + elements / 16 + 1,
                                             scene->radius / (double)elements, scene->contact_time / (double)steps,
                                             20 * steps};
        s.result.elements = elements;
        s.result.error_ez = s.result.error_ex = NAN;
    }
    const double seconds = bench_time_of(solve, &s);
    const char *outcome = outcome_of(&s);
    if (s.end == PAPER_NO_MEMORY) stop(scene->name, "out of memory");
    printf("%s,%s,%g,%lld,%lld,%.4g,%s,", scene->name, method->name, method->handle ? tolerance : NAN,
           (long long)elements, (long long)steps, seconds, outcome);
    if (strcmp(outcome, "solved") == 0 || strcmp(outcome, "not reached") == 0)
        printf("%.12f,%.12f,%.3g,%.3g,%lld,%lld\n", s.result.ez, s.result.ex, s.result.error_ez, s.result.error_ex,
               (long long)s.result.elements, (long long)s.result.steps);
    else
        puts("nan,nan,nan,nan,,");
    restitute_solver_destroy(s.solver);
    return seconds;
}
