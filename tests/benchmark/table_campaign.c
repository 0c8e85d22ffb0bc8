/* Is what a table states true? Each table is compared with impacts at random places.
 *
 *     table_campaign POLYISOBUTYLENE.csv [PLACES [TOLERANCE [SOLID]]]       default 10000 1e-5, all solids
 *     table_campaign random [PLACES [SOLIDS [FIRST]]]                       default 3000 40 0
 *
 * The first form takes sixteen solids over six decades of speed. The second one takes random
 * standard solids with masses near the centre, one to two decades of speed and random tolerances.
 * Prints a line a solid: seconds of one thread, bytes, impacts, nodes, stated errors, largest true
 * ones, status. The exit status is 1 if a true error is above the stated one by more than the
 * estimated error of that impact.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <string.h>
#include <time.h>

#include "../support/table_solids.h"

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint64_t state = 1;

static double random_unit(void)
{
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) * 0x1p-53;
}

struct errors {
    double ez, ex;         /* largest differences */
    double beyond;         /* by how much a difference passes the stated error and that of the impact */
    double at_speed, at_psi; /* of the largest difference in ex */
};

/* Speeds are even in their logarithm, psi in [0, 1.3 psi_c]. */
static void compare(const restitute_table *table, const restitute_scene *contact, long places, double tolerance,
                    struct errors *e)
{
    restitute_table_info info;
    restitute_scene scene = *contact, unit = *contact;
    restitute_numbers numbers;
    restitute_options options;
    restitute_solver *solver = NULL;
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    restitute_numbers_init(&numbers);
    unit.normal_speed = unit.tangential_speed = 1;
    restitute_scene_numbers(&unit, &numbers, NULL);
    restitute_options_init(&options);
    options.method = restitute_method_sync();
    options.tolerance = fmax(1e-8, tolerance / 20);
    options.max_work = 0.003;
    restitute_solver_create(&options, &solver, NULL);
    *e = (struct errors){0};
    for (long i = 0; i < places; i++) {
        const double v = info.speed[0] * pow(info.speed[1] / info.speed[0], random_unit());
        double table_ez, table_ex;
        restitute_result r;
        restitute_table_pair(table, NULL, v, 0, &table_ez, NULL, NULL);
        const double psi = random_unit() * 1.3 * restitute_critical_psi(info.chi, table_ez);
        scene.normal_speed = v;
        scene.tangential_speed = psi * v / numbers.psi;
        restitute_result_init(&r);
        if (restitute_solve_scene(solver, &scene, &r, NULL, NULL, NULL) < 0) continue;
        restitute_table_pair(table, NULL, v, scene.tangential_speed, &table_ez, &table_ex, NULL);
        const double ez = fabs(table_ez - r.ez), ex = fabs(table_ex - r.ex);
        if (ex > e->ex) e->at_speed = v, e->at_psi = psi;
        e->ez = fmax(e->ez, ez);
        e->ex = fmax(e->ex, ex);
        e->beyond = fmax(e->beyond, fmax(ez - r.error_ez - info.error_ez, ex - r.error_ex - info.error_ex));
    }
    restitute_solver_destroy(solver);
}

/* Build a table, compare it and print both. */
static int measure(const char *name, const restitute_scene *scene, const restitute_table_options *options, long places)
{
    restitute_table_info info;
    restitute_table *table = NULL;
    restitute_error error;
    struct errors e;
    const double start = seconds();
    const int status = restitute_table_build(scene, options, &table, &error);
    const double time = seconds() - start;
    if (status < 0) {
        printf("%-26s: %s\n", name, error.message);
        return 1;
    }
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    compare(table, scene, places, options->tolerance, &e);
    printf("%-26s %7.3f s %8zu B %7lld impacts %5lld x (%lld + %lld) stated %.1e %.1e true %.1e %.1e%s%s at %.5g %.4f\n", name,
           time, info.bytes, (long long)info.impacts, (long long)info.speeds, (long long)info.stick_cells,
           (long long)info.slip_cells, info.error_ez, info.error_ex, e.ez, e.ex, status ? " NOT REACHED" : "",
           e.beyond > 0 ? " UNTRUE" : "", e.at_speed, e.at_psi);
    fflush(stdout);
    restitute_table_destroy(table);
    return e.beyond > 0;
}

static int measure_solid(const struct table_solid *solid, const char *pib, long places, double tolerance)
{
    restitute_material *material;
    const restitute_scene scene = table_solid_scene(solid, pib, &material);
    restitute_table_options options;
    char name[64];
    restitute_table_options_init(&options);
    options.tolerance = tolerance;
    snprintf(name, sizeof name, "%-15s %.1f %6.4g", solid->name, solid->nu, solid->gamma);
    const int untrue = measure(name, &scene, &options, places);
    restitute_material_destroy(material);
    return untrue;
}

static double random_between(double low, double high)
{
    return low * pow(high / low, random_unit());
}

/* Random solid k, the same in every run. Narrow folds of e_x are near delta1 = 0.32 gamma^-0.56. */
static int measure_random(long k, long places)
{
    state = (uint64_t)(k + 1) * UINT64_C(0x9e3779b97f4a7c15);
    for (int i = 0; i < 5; i++)
        random_unit();
    const double chi = 1.05 + 2.45 * random_unit(), gamma = random_between(0.03, 0.2), nu = 0.5 * random_unit();
    const double decades = 1 + random_unit(), tolerance = random_between(1e-5, 1e-2);
    const double fold = 0.32 * pow(gamma, -0.56), delta1 = fold * random_between(0.5, 2), middle = 0.3;
    const double turning = chi * (2 - nu) / (1 - nu) - 1; /* m R^2/I */
    restitute_table_options options;
    restitute_scene scene;
    char name[64];
    restitute_material *material = table_solid_standard(&scene, nu, gamma, delta1, middle);
    scene.inertia1 = scene.mass1 * scene.radius1 * scene.radius1 / turning;
    restitute_table_options_init(&options);
    options.speed[0] = middle * pow(10, -0.5 * decades);
    options.speed[1] = middle * pow(10, 0.5 * decades);
    options.tolerance = tolerance;
    snprintf(name, sizeof name, "%3ld %.3f %.4f %.2f %.2f %.1e", k, chi, gamma, nu, delta1, tolerance);
    const int untrue = measure(name, &scene, &options, places);
    restitute_material_destroy(material);
    return untrue;
}

int main(int count, char **arguments)
{
    const int random = count > 1 && strcmp(arguments[1], "random") == 0;
    const long places = count > 2 ? atol(arguments[2]) : random ? 3000 : 10000;
    int untrue = 0;
    if (count < 2) {
        fprintf(stderr, "usage: table_campaign POLYISOBUTYLENE.csv|random [PLACES [TOLERANCE|SOLIDS [SOLID]]]\n");
        return 2;
    }
    if (random) {
        const long first = count > 4 ? atol(arguments[4]) : 0, solids = count > 3 ? atol(arguments[3]) : 40;
        for (long k = first; k < first + solids; k++)
            untrue += measure_random(k, places);
        printf("%d of %ld untrue\n", untrue, solids);
        return untrue > 0;
    }
    const double tolerance = count > 3 ? atof(arguments[3]) : 1e-5;
    for (int i = 0; i < table_solids; i++)
        if (count < 5 || atoi(arguments[4]) == i) untrue |= measure_solid(&table_solid[i], arguments[1], places, tolerance);
    return untrue;
}
