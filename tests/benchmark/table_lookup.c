/* A lookup beside pow, in the same run: medians over repetitions, as CSV.  table_lookup [REPEATS]
 *
 * One table at 1e-5 over six decades of speed. Places are random over all speeds and psi up to
 * beyond psi_c; pow has random arguments as well. A thousand places in
 * turn: a processor comes to foresee on which side of psi = 1 and of psi_c the next one is. A
 * hundred thousand: it does not. "chained": every call needs the result of the one before it, which
 * measures latency.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <restitute/table.h>

#include "../support/random.h"
#include "bench.h"

enum { few = 1000, n = 100000, most_repeats = 1001 };
static int fewest_repeats = 51;

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

static double median_ns(double (*work)(const struct places *), const struct places *p)
{
    static double samples[most_repeats];
    const int repeats = p->count == few && fewest_repeats > 1 ? most_repeats : fewest_repeats;
    for (int i = 0; i < repeats; i++) {
        const double start = bench_time();
        sink = work(p);
        samples[i] = (bench_time() - start) / p->count * 1e9;
    }
    return bench_median(samples, (size_t)repeats);
}

static restitute_table *build(void)
{
    restitute_material *rubber = NULL;
    restitute_table *table = NULL;
    restitute_table_options options;
    restitute_scene scene;
    restitute_scene_init(&scene);
    restitute_table_options_init(&options);
    restitute_material_kelvin_voigt(1e6, 300, 0.5, &rubber, NULL);
    scene.material = rubber;
    scene.radius1 = 0.005, scene.mass1 = 0.004, scene.friction = 0.3;
    options.tolerance = 1e-5;
    const int status = restitute_table_build(&scene, &options, &table, NULL);
    restitute_material_destroy(rubber);
    return status < 0 ? NULL : table;
}

static void report(const char *call, const struct places *p, double ns, double pow_ns)
{
    printf("%s,%d,%.4g,%.4g\n", call, p->count, ns, pow_ns);
}

int main(int count, char **words)
{
    static struct places p = {.count = few};
    uint64_t state = 1;
    restitute_table *table = build();
    if (count > 1) fewest_repeats = atoi(words[1]);
    if (!table || fewest_repeats < 1 || fewest_repeats > most_repeats) return 2;
    for (int i = 0; i < n; i++) {
        p.v[i] = random_log(&state, 1e-4, 100);
        p.u[i] = random_in(&state, 0, 5) * p.v[i] * 0.45; /* psi up to 5 with nu = 1/2, mu = 0.3 */
    }
    p.table = table;
    puts("call,places,ns,pow_ns");
    const double pow_ns = median_ns(pow_free, &p), chained_ns = median_ns(pow_chained, &p);
    for (p.count = few; p.count <= n; p.count *= n / few) {
        report("single", &p, median_ns(table_free, &p), pow_ns);
        report("many", &p, median_ns(table_many, &p), pow_ns);
        report("chained", &p, median_ns(table_chained, &p), chained_ns);
    }
    restitute_table_destroy(table);
}
