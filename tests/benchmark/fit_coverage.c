/* Do 95 % intervals of fitted constants hold the true ones in 95 % of the cases? Synthetic drop
 * tests of random solids, 20 speeds over three decades, Gaussian noise on ez (absolute) and on the
 * contact time (relative):  fit_coverage DRAWS [SEED] For docs/records/fit.md; a line a model,
 * noise, kind of data and constant.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <restitute/fit.h>

#include "../support/random.h"

enum { POINTS = 20, MOST = 4 };
static const double pi = 3.14159265358979323846, prony_times[] = {3e-5, 3e-3};

static double gauss(uint64_t *state)
{
    const double u = random_in(state, 1e-300, 1), v = random_in(state, 0, 1);
    return sqrt(-2 * log(u)) * cos(2 * pi * v);
}

/* A solid near 1 MPa whose times are near the contact's, some milliseconds; its constants in the
 * order of the fit. */
static restitute_material *draw(int model, uint64_t *state, double *c)
{
    restitute_material *material = NULL;
    const double g1 = random_log(state, 3e5, 3e6), g2 = g1 * random_log(state, 0.3, 10);
    const double tau = random_log(state, 1e-4, 1e-3);
    c[0] = g1, c[1] = g2, c[2] = g2 * tau;
    if (model == RESTITUTE_FIT_MODEL_KELVIN_VOIGT) {
        c[1] = g1 * tau;
        restitute_material_kelvin_voigt(g1, c[1], 0.5, &material, NULL);
    } else if (model == RESTITUTE_FIT_MODEL_MAXWELL) {
        c[1] = g1 * tau * 30; /* below, it hardly rebounds */
        restitute_material_maxwell(g1, c[1], 0.5, &material, NULL);
    } else if (model == RESTITUTE_FIT_MODEL_PRONY) {
        c[1] = g1 * random_log(state, 0.1, 3), c[2] = g1 * random_log(state, 0.1, 3);
        restitute_material_prony(g1, 0, 2, prony_times, c + 1, 0.5, &material, NULL);
    } else
        restitute_material_standard_solid(g1, g2, c[2], 0.5, &material, NULL);
    return material;
}

/* Solids whose e comes within three standard deviations of 0 or 1 are refused: the noise would be
 * cut off there. */
static int measure(const restitute_material *material, double noise, int with_time, restitute_solver *solver,
                   uint64_t *state, restitute_scene *scenes, restitute_fit_point *points)
{
    for (int i = 0; i < POINTS; i++) {
        restitute_fit_point *p = &points[i];
        restitute_scene *scene = &scenes[i];
        restitute_result r;
        restitute_fit_point_init(p);
        restitute_scene_init(scene);
        p->scene = scene;
        restitute_result_init(&r);
        scene->radius1 = 0.005, scene->mass1 = 0.004, scene->material = material;
        scene->normal_speed = 0.01 * pow(1000, i / (POINTS - 1.0));
        restitute_solve_scene(solver, scene, &r, NULL, NULL, NULL);
        scene->material = NULL;
        if (!(r.ez > 3 * noise && r.ez < 1 - 3 * noise)) return 0;
        p->ez = fmin(1, fmax(0, r.ez + noise * gauss(state))); /* one in a thousand */
        if (with_time) p->contact_time = r.contact_time * (1 + noise * gauss(state));
    }
    return 1;
}

static void campaign(int model, double noise, int with_time, int draws, uint64_t seed)
{
    restitute_scene scenes[POINTS];
    restitute_fit_point points[POINTS];
    restitute_options precise;
    restitute_solver *solver;
    int held[MOST] = {0}, open[MOST] = {0}, failed = 0;
    size_t constants = 0;
    char names[MOST][RESTITUTE_FIT_NAME];
    restitute_options_init(&precise);
    precise.method = restitute_method_sync(), precise.tolerance = 1e-7;
    if (restitute_solver_create(&precise, &solver, NULL) < 0) exit(1);
    for (int k = 0; k < draws; k++) {
        double truth[MOST], known[MOST] = {NAN, NAN, NAN, NAN};
        restitute_fit_options options;
        restitute_fit_result result;
        restitute_material *material = draw(model, &seed, truth);
        restitute_fit_options_init(&options);
        restitute_fit_result_init(&result);
        options.model = model;
        if (model == RESTITUTE_FIT_MODEL_PRONY) options.terms = 2, options.relaxation_time = prony_times;
        known[0] = truth[0];
        if (!with_time) options.known = known;
        if (!measure(material, noise, with_time, solver, &seed, scenes, points)) {
            restitute_material_destroy(material);
            k--;
            continue;
        }
        if (restitute_fit(POINTS, points, &options, &result, NULL) < 0) {
            failed++;
            continue;
        }
        constants = result.constants;
        for (size_t i = 0; i < constants; i++) {
            snprintf(names[i], sizeof names[i], "%s", result.name[i]);
            held[i] += result.low[i] <= truth[i] && truth[i] <= result.high[i];
            open[i] += isinf(result.high[i]) && result.low[i] <= 0;
        }
        restitute_material_destroy(result.material);
        restitute_material_destroy(material);
    }
    restitute_solver_destroy(solver);
    for (size_t i = with_time ? 0 : 1; i < constants; i++)
        printf("%d,%g,%s,%s,%.3f,%.3f,%d,%d\n", model, noise, with_time ? "ez and contact time" : "ez; modulus1 known",
               names[i], (double)held[i] / draws, (double)(held[i] - open[i]) / (draws - failed - open[i]), open[i],
               failed);
    fflush(stdout);
}

int main(int count, char **arguments)
{
    static const int models[] = {RESTITUTE_FIT_MODEL_KELVIN_VOIGT, RESTITUTE_FIT_MODEL_STANDARD_SOLID,
                                 RESTITUTE_FIT_MODEL_MAXWELL, RESTITUTE_FIT_MODEL_PRONY};
    static const double levels[] = {0, 0.01, 0.03, 0.05};
    const int draws = count > 1 ? atoi(arguments[1]) : 200;
    const uint64_t seed = count > 2 ? (uint64_t)atoll(arguments[2]) : 2017;
    printf("model,noise,data,constant,coverage,of_determined,not_determined,failed\n");
    for (size_t m = 0; m < 4; m++)
        for (int data = 1; data >= 0; data--)
            for (int noise = 0; noise < 4; noise++)
                campaign(models[m], levels[noise], data, draws, seed);
}
