/* Is what a table states true? Sixteen solids over six decades of speed, each table compared with impacts at random places.
 *
 *     table_campaign POLYISOBUTYLENE.csv [PLACES [TOLERANCE [SOLID]]]       default 10000 1e-5, all solids
 *
 * Prints a line a solid: seconds of one thread, bytes, impacts, nodes, stated errors, largest true ones, status. The exit status is 1 if a
 * true error is above the stated one by more than the estimated error of that impact.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <time.h>

#include "../support/table_solids.h"

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
    options.max_updates = 3000000;
    restitute_solver_create(&options, &solver, NULL);
    *e = (struct errors){0};
    for (long i = 0; i < places; i++) {
        const double v = info.speed[0] * pow(info.speed[1] / info.speed[0], random_unit());
        restitute_table_value pair;
        restitute_result r;
        restitute_table_pair(table, v, 0, &pair);
        const double psi = random_unit() * 1.3 * restitute_critical_psi(info.chi, pair.ez);
        scene.normal_speed = v;
        scene.tangential_speed = psi * v / numbers.psi;
        restitute_result_init(&r);
        if (restitute_solve_scene(solver, &scene, &r, NULL, NULL, NULL) < 0) continue;
        restitute_table_pair(table, v, scene.tangential_speed, &pair);
        const double ez = fabs(pair.ez - r.ez), ex = fabs(pair.ex - r.ex);
        if (ex > e->ex) e->at_speed = v, e->at_psi = psi;
        e->ez = fmax(e->ez, ez);
        e->ex = fmax(e->ex, ex);
        e->beyond = fmax(e->beyond, fmax(ez - r.error_ez - info.error_ez, ex - r.error_ex - info.error_ex));
    }
    restitute_solver_destroy(solver);
}

static int measure(const struct table_solid *solid, const char *pib, long places, double tolerance)
{
    restitute_material *material;
    restitute_scene scene = table_solid_scene(solid, pib, &material);
    restitute_table_options options;
    restitute_table_info info;
    restitute_table *table = NULL;
    restitute_error error;
    struct errors e;
    restitute_table_options_init(&options);
    options.tolerance = tolerance;
    const double start = seconds();
    const int status = restitute_table_build(&scene, &options, &table, &error);
    const double time = seconds() - start;
    if (status < 0) {
        printf("%-15s %.1f %6.4g: %s\n", solid->name, solid->nu, solid->gamma, error.message);
        restitute_material_destroy(material);
        return 1;
    }
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    compare(table, &scene, places, tolerance, &e);
    printf("%-15s %.1f %6.4g %7.3f s %8zu B %7lld impacts %5lld x (%lld + %lld) stated %.1e %.1e true %.1e %.1e%s%s at %.4g %.3f\n",
           solid->name, solid->nu, solid->gamma, time, info.bytes, (long long)info.impacts, (long long)info.speeds,
           (long long)info.stick_cells, (long long)info.slip_cells, info.error_ez, info.error_ex, e.ez, e.ex,
           status ? " NOT REACHED" : "", e.beyond > 0 ? " UNTRUE" : "", e.at_speed, e.at_psi);
    fflush(stdout);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
    return e.beyond > 0;
}

int main(int count, char **arguments)
{
    const long places = count > 2 ? atol(arguments[2]) : 10000;
    const double tolerance = count > 3 ? atof(arguments[3]) : 1e-5;
    int untrue = 0;
    if (count < 2) {
        fprintf(stderr, "usage: table_campaign POLYISOBUTYLENE.csv [PLACES [TOLERANCE [SOLID]]]\n");
        return 2;
    }
    for (int i = 0; i < table_solids; i++)
        if (count < 5 || atoi(arguments[4]) == i) untrue |= measure(&table_solid[i], arguments[1], places, tolerance);
    return untrue;
}
