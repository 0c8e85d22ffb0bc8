/* Numbers of every component that is linked, one a line, in full: to be compared between compilers,
 * their options and machines (compare.py). Within one program all ways to a number give its bits:
 * single calls, batches of any size, any number of threads.
 * CMakeLists.txt includes the headers of components, of which some may lack.
 * SPDX-License-Identifier: BSD-3-Clause */
#define PLAIN_CHECKS
#include <restitute/contact.h>
#include <string.h>

#include "../support/table.h"

enum { impacts = 200 };

static void print(const char *name, int i, double value)
{
    printf("%s %d %.17g\n", name, i, value);
}

static void print_pair(const char *name, int i, double one, double two)
{
    print(name, 2 * i, one);
    print(name, 2 * i + 1, two);
}

static restitute_impact random_impact(int i, const restitute_material *prony)
{
    uint64_t random = (uint64_t)i;
    const double chi = 0.34 + 3 * random_in(&random, 0, 1), psi = pow(10, random_in(&random, -2, 1));
    const double delta1 = pow(10, random_in(&random, -3, 1)), gamma = pow(10, random_in(&random, -2, 2));
    restitute_impact impact = impact_of(chi, psi, delta1, i % 5 ? gamma : 0);
    if (i % 5 == 1) impact.material = prony;
    return impact;
}

/* `n` impacts from number `first` on. */
static void solve(const char *name, const restitute_method *method, int first, int n, double tolerance,
                  const restitute_material *prony)
{
    static restitute_impact list[impacts];
    static restitute_result single[impacts], many[impacts];
    static int status[impacts], statuses[impacts];
    restitute_options options = to_tolerance(tolerance);
    options.method = method;
    restitute_solver *solver = make_solver(&options);
    memset(single, 0, sizeof single), memset(many, 0, sizeof many); /* holes of the structs, too */
    for (int i = 0; i < n; i++) {
        list[i] = random_impact(first + i, prony);
        restitute_result_init(&single[i]);
        status[i] = restitute_solve(solver, &list[i], &single[i], NULL, NULL, NULL);
        CHECK(status[i] == RESTITUTE_OK || status[i] == RESTITUTE_NO_REBOUND, "%s: impact %d: status %d", name,
              first + i, status[i]);
        print_pair(name, i, single[i].ez, single[i].ex);
    }
    restitute_solver_destroy(solver);
    for (int threads = 1; threads <= 3; threads++) {
        const int size = threads == 1 ? n : threads == 2 ? 7 : 1;
        options.threads = threads;
        for (int i = 0; i < n; i++)
            restitute_result_init(&many[i]);
        for (int i = 0; i < n; i += size)
            restitute_solve_many((size_t)(n - i < size ? n - i : size), list + i, &options, many + i, statuses + i,
                                 NULL);
        CHECK(memcmp(single, many, sizeof single) == 0, "%s, %d threads", name, threads);
        CHECK(memcmp(status, statuses, (size_t)n * sizeof *status) == 0, "%s, %d threads", name, threads);
    }
}

/* 37 contacts, alone and in batches of 1 to 37. */
static void contacts(const restitute_material *prony)
{
    enum { n = 37, most = 200 };
    static double alone[n][most], batch[n][most], *states[n];
    restitute_contact_force force[n], forces[n];
    restitute_contact_motion motion[n];
    restitute_contact_law *law;
    PREPARED(contact_rates, rates);
    CHECK(restitute_contact_law_create(prony, NULL, &law, NULL) >= 0, "law");
    CHECK(restitute_contact_law_state_size(law) <= most, "state");
    restitute_contact_rates_set(law, 0.01, &rates, NULL);
    for (int size = 1; size <= n; size += 4) {
        uint64_t random = 1;
        memset(alone, 0, sizeof alone), memset(batch, 0, sizeof batch);
        for (int i = 0; i < n; i++) {
            restitute_contact_motion_init(&motion[i]);
            motion[i].radius = 1, motion[i].friction = 0.3, states[i] = batch[i];
        }
        for (int step = 0; step < 200; step++) {
            for (int i = 0; i < n; i++) {
                motion[i].velocity[2] = 1e-3 * (cos(0.02 * step) + 0.1 * random_in(&random, -1, 1));
                motion[i].velocity[0] = 1e-3 * random_in(&random, -1, 2);
                motion[i].overlap += 0.01 * motion[i].velocity[2];
                restitute_contact_step(law, &rates, &motion[i], alone[i], &force[i], NULL);
            }
            for (int i = 0; i < n; i += size)
                restitute_contact_step_many(law, &rates, (size_t)(n - i < size ? n - i : size), motion + i, states + i,
                                            forces + i, NULL, NULL);
        }
        for (int i = 0; i < n; i++) { /* without the sign of a zero */
            for (int k = 0; k < most; k++)
                alone[i][k] += 0., batch[i][k] += 0.;
            CHECK(memcmp(alone[i], batch[i], sizeof alone[i]) == 0, "contact %d, batches of %d", i, size);
            if (size == 1) print_pair("contact", i, force[i].normal, force[i].tangential[0]);
        }
    }
    restitute_contact_law_destroy(law);
}

static void tables(void)
{
    enum { n = 1000 };
    static double v[n], u[n], ez[3][n], ex[3][n];
    uint64_t random = 3;
    restitute_material *rubber;
    PREPARED(table_options, options);
    const restitute_scene scene = ball_on(1, &rubber);
    options.tolerance = 1e-4, options.time_limit = INFINITY;
    for (int i = 0; i < n; i++)
        v[i] = pow(10, random_in(&random, -5, 3)), u[i] = v[i] * pow(10, random_in(&random, -3, 1));
    for (options.threads = 1; options.threads <= 3; options.threads++) {
        restitute_table *table = built(&scene, &options);
        const int k = options.threads - 1;
        if (k == 0)
            for (int i = 0; i < n; i++)
                restitute_table_pair(table, NULL, v[i], u[i], &ez[k][i], &ex[k][i], NULL);
        else
            for (int i = 0, size = 1; i < n; i += size, size = 1 + size % 40)
                restitute_table_pair_many(table, NULL, (size_t)(n - i < size ? n - i : size), v + i, u + i, &ez[k][i],
                                          &ex[k][i], NULL);
        restitute_table_destroy(table);
        CHECK(memcmp(ez[0], ez[k], sizeof ez[0]) == 0 && memcmp(ex[0], ex[k], sizeof ex[0]) == 0, "table %d", k);
    }
    for (int i = 0; i < n; i++)
        print_pair("table", i, ez[0][i], ex[0][i]);
    restitute_material_destroy(rubber);
}

#ifdef WITH_FIT
static void fit(void)
{
    enum { n = 12 };
    restitute_material *rubber;
    restitute_fit_point points[n];
    restitute_scene scenes[n];
    const restitute_scene ball = ball_on(0.5, &rubber);
    for (int i = 0; i < n; i++) {
        double ex;
        scenes[i] = ball, scenes[i].normal_speed = pow(10, -2 + 0.25 * i);
        restitute_fit_point_init(&points[i]);
        CHECK(restitute_scene_pair(&scenes[i], &points[i].ez, &ex, NULL) >= 0, "pair %d", i);
        scenes[i].material = NULL, points[i].scene = &scenes[i];
    }
    points[0].contact_time = 0.02;
    PREPARED(fit_result, result);
    CHECK(restitute_fit(n, points, NULL, &result, NULL) >= 0, "fit");
    for (size_t i = 0; i < result.constants; i++)
        print("fit", (int)i, result.value[i]);
    restitute_material_destroy(result.material);
    restitute_material_destroy(rubber);
}
#endif

int main(int argc, char **argv)
{
    const double tau[] = {0.05, 0.4, 3}, g[] = {1, 0.7, 0.5};
    restitute_material *prony = solid_of(0.5, 0, 3, tau, g);
    CHECK(argc == 2, "usage: numbers MATERIAL.json");
    solve("sync", restitute_method_sync(), 0, impacts, 1e-6, prony);
    solve("euler", restitute_method_euler(), 0, 60, 1e-2, prony);
#ifdef WITH_CVODE
    solve("cvode", restitute_method_cvode(), 0, 60, 1e-3, prony);
#endif
#ifdef WITH_BEM
    solve("bem", restitute_method_bem(), 1, 4, 0.1, prony); /* 0 and 5, without springs at once, are refused */
#endif
    contacts(prony);
    tables();
#ifdef WITH_FIT
    fit();
#endif
#ifdef WITH_FILES
    restitute_material *read;
    CHECK(restitute_material_read(argv[1], &read, NULL, NULL) >= 0, "%s", argv[1]);
    for (int i = -8; i < 8; i++)
        print("files", i + 8, restitute_material_modulus(read, pow(10, i)));
    restitute_material_destroy(read);
#endif
    restitute_material_destroy(prony);
    return 0;
}
