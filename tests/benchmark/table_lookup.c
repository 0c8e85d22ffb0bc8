/* A lookup beside pow, in the same run: medians over repetitions, in ns and in calls of pow.
 *
 *     table_lookup
 *
 * One table at 1e-5 over six decades of speed (with the time of its build). Places are random over
 * all speeds and psi up to beyond psi_c; pow has random arguments as well. A thousand places in
 * turn: a processor comes to foresee on which side of psi = 1 and of psi_c the next one is. A
 * hundred thousand: it does not. "chained": every call needs the result of the one before it, which
 * measures latency.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <restitute/table.h>

enum { few = 1000, n = 100000, most_repeats = 1001 };

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double random_unit(void)
{
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) * 0x1p-53;
}

struct places {
    const restitute_table *table;
    int count; /* few: in turn, whose sides of psi = 1 and psi_c a processor comes to foresee; n: it does not */
    double v[n], u[n];
};

static volatile double sink;

static double pow_free(const struct places *p)
{
    double sum = 0;
    for (int i = 0; i < p->count; i++)
        sum += pow(p->v[i], 0.2 + 1e-9 * i);
    return sum;
}

static double pow_chained(const struct places *p)
{
    double x = 1;
    for (int i = 0; i < p->count; i++)
        x = pow(p->v[i] + 1e-300 * x, 0.2);
    return x;
}

static double table_free(const struct places *p)
{
    double sum = 0;
    double ez, ex = 0;
    for (int i = 0; i < p->count; i++) {
        restitute_table_pair(p->table, NULL, p->v[i], p->u[i], &ez, &ex, NULL);
        sum += ex;
    }
    return sum;
}

static double table_chained(const struct places *p)
{
    double ez, ex = 0;
    for (int i = 0; i < p->count; i++)
        restitute_table_pair(p->table, NULL, p->v[i] + 1e-300 * ex, p->u[i], &ez, &ex, NULL);
    return ex;
}

static double table_many(const struct places *p)
{
    static double ez[n], ex[n];
    restitute_table_pair_many(p->table, NULL, (size_t)p->count, p->v, p->u, ez, ex, NULL);
    return ex[p->count - 1];
}

static int by_value(const void *a, const void *b)
{
    return (*(const double *)a > *(const double *)b) - (*(const double *)a < *(const double *)b);
}

static double median_ns(double (*work)(const struct places *), const struct places *p)
{
    static double samples[most_repeats];
    const int repeats = p->count == few ? most_repeats : 51;
    for (int i = 0; i < repeats; i++) {
        const double start = seconds();
        sink = work(p);
        samples[i] = (seconds() - start) / p->count * 1e9;
    }
    qsort(samples, (size_t)repeats, sizeof *samples, by_value);
    return samples[repeats / 2];
}

static void report(const char *name, double ns, double pow_ns)
{
    printf("%-34s %7.1f ns   %5.2f pow\n", name, ns, ns / pow_ns);
}

static restitute_table *build(const restitute_scene *scene, double tolerance, const char *name)
{
    restitute_table *table = NULL;
    restitute_table_options options;
    restitute_table_info info;
    restitute_error error;
    restitute_table_options_init(&options);
    options.tolerance = tolerance;
    const clock_t start = clock(); /* of the processor: one thread */
    if (restitute_table_build(scene, &options, &table, &error) < 0) {
        fprintf(stderr, "%s\n", error.message);
        exit(1);
    }
    const double time = (double)(clock() - start) / CLOCKS_PER_SEC;
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    printf("%-34s %7.3f s for %lld impacts, errors %.1e %.1e, %.2f MB\n", name, time, (long long)info.impacts,
           info.error_ez, info.error_ex, (double)info.bytes / 1e6);
    return table;
}

static void measure_contact(struct places *p, double pow_ns, double chained_ns)
{
    restitute_material *rubber = NULL;
    restitute_scene scene;
    restitute_scene_init(&scene);
    restitute_material_kelvin_voigt(1e6, 300, 0.5, &rubber, NULL);
    scene.material = rubber;
    scene.radius1 = 0.005, scene.mass1 = 0.004, scene.friction = 0.3;
    restitute_table *table = build(&scene, 1e-5, "build, 1e-5");
    p->table = table;
    for (p->count = few; p->count <= n; p->count *= n / few) {
        printf("%d places:\n", p->count);
        report("restitute_table_pair", median_ns(table_free, p), pow_ns);
        report("restitute_table_pair_many", median_ns(table_many, p), pow_ns);
        report("restitute_table_pair, chained", median_ns(table_chained, p), chained_ns);
    }
    restitute_table_destroy(table);
    restitute_material_destroy(rubber);
}

int main(void)
{
    static struct places p = {.count = few};
    for (int i = 0; i < n; i++) {
        p.v[i] = 1e-4 * pow(1e6, random_unit());
        p.u[i] = 5 * random_unit() * p.v[i] * 0.45; /* psi up to 5 with nu = 1/2, mu = 0.3 */
    }
    const double pow_ns = median_ns(pow_free, &p), chained_ns = median_ns(pow_chained, &p);
    report("pow", pow_ns, pow_ns);
    report("pow, chained", chained_ns, chained_ns);
    measure_contact(&p, pow_ns, chained_ns);
    return 0;
}
