/* Scenes from the reference rows, and the numbers (23) behind them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "methods.h"
#include "reference_rows.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

const char *const bench_set_names[BENCH_SETS] = {"truth", "stiff", "prony"};

static const double solid_sphere = 7.0 / 6.0;
static const double theta_of_delta1 = 1.4605934866804429; /* sqrt(32/15) (23) */

void bench_scene_make(const char *name, enum bench_set set, double chi, double psi, double delta1, double gamma,
                      struct bench_scene *scene)
{
    const double theta = theta_of_delta1 * delta1;
    *scene = (struct bench_scene){
        .set = set, .chi = chi, .psi = psi, .delta1 = delta1, .gamma = gamma, .g_inf = 1, .radius = 1};
    snprintf(scene->name, sizeof scene->name, "%s", name);
    if (gamma == 0) {
        scene->eta = theta;
    } else if (theta > 0) {
        scene->n_terms = 1;
        scene->g[0] = 1 / gamma;
        scene->tau[0] = gamma * theta;
    }
}

static void add_truth(int quick, struct bench_scenes *list)
{
    /* three standard solids, a Kelvin-Voigt and an elastic one */
    static const size_t few[] = {0, 1, 2, 3, 9};
    const size_t n = quick ? COUNT(few) : COUNT(impact_rows);
    for (size_t i = 0; i < n; i++) {
        const size_t number = quick ? few[i] : i;
        const double *row = impact_rows[number];
        struct bench_scene *scene = &list->scenes[list->count++];
        char name[48];
        snprintf(name, sizeof name, "truth-%zu", number + 1);
        bench_scene_make(name, BENCH_TRUTH, row[0], row[1], row[2], row[3], scene);
        scene->has_reference = 1;
        scene->ez = row[4];
        scene->ex = row[5];
        scene->error_ez = row[6];
        scene->error_ex = row[7];
        snprintf(scene->reference, sizeof scene->reference, "impact_truth.csv");
    }
}

static void add_stiff(int quick, struct bench_scenes *list)
{
    static const double delta1[] = {1e-6, 1e-3, 1, 1e3}, psi[] = {0.5, 1.5};
    for (size_t i = 0; i < COUNT(delta1); i++)
        for (size_t k = 0; k < COUNT(psi); k++) {
            char name[48];
            if (quick && delta1[i] != 1) continue;
            snprintf(name, sizeof name, "stiff-%g-%g", delta1[i], psi[k]);
            bench_scene_make(name, BENCH_STIFF, solid_sphere, psi[k], delta1[i], 1e-6, &list->scenes[list->count++]);
        }
}

/* "G:tau;G:tau;..." */
static void read_terms(const char *text, struct bench_scene *scene)
{
    double g, tau;
    int length;
    while (scene->n_terms < BENCH_TERMS && sscanf(text, "%lf:%lf%n", &g, &tau, &length) == 2) {
        scene->g[scene->n_terms] = g;
        scene->tau[scene->n_terms++] = tau;
        text += length;
        if (*text == ';') text++;
    }
}

/* The steel ball on polyisobutylene at 1 m/s of prony_truth.csv, in units of G_r = sum G_k and T. */
static int read_ball(struct bench_scene *scene, restitute_error *error)
{
    restitute_material *material;
    restitute_scene ball;
    restitute_numbers numbers;
    for (size_t k = 0; k < COUNT(pib_rows); k++) {
        scene->tau[k] = pib_rows[k][0];
        scene->g[k] = pib_rows[k][1];
    }
    scene->n_terms = COUNT(pib_rows);
    int status = restitute_material_prony(0, 0, scene->n_terms, scene->tau, scene->g, 0.5, &material, error);
    if (status) return status;
    restitute_scene_init(&ball);
    ball.material = material;
    ball.radius1 = 5e-3;
    ball.mass1 = 7800 * 4.0 / 3.0 * 3.14159265358979323846 * pow(ball.radius1, 3);
    ball.normal_speed = 1;
    restitute_numbers_init(&numbers);
    status = restitute_scene_numbers(&ball, &numbers, error);
    restitute_material_destroy(material);
    for (size_t k = 0; k < scene->n_terms; k++) {
        scene->g[k] /= numbers.modulus;
        scene->tau[k] /= numbers.time;
    }
    return status;
}

static int read_prony(const char *row, struct bench_scene *scene, restitute_error *error)
{
    char modulus[16] = "", terms[256] = "";
    int length = 0;
    *scene = (struct bench_scene){.set = BENCH_PRONY, .delta1 = NAN, .gamma = NAN, .radius = 1, .has_reference = 1};
    sscanf(row, "%47[^,],%lf,%lf,%15[^,],%n", scene->name, &scene->chi, &scene->psi, modulus, &length);
    const char *rest = row + length + strcspn(row + length, ",");
    snprintf(terms, sizeof terms, "%.*s", (int)(rest - row) - length, row + length);
    if (length == 0 || sscanf(rest, ",%lf,%lf,%lf", &scene->ez, &scene->ex, &scene->error_ez) != 3) {
        snprintf(error->message, sizeof error->message, "prony_truth.csv: \"%.100s\" is not understood", row);
        return error->status = RESTITUTE_ERROR_FORMAT;
    }
    scene->error_ex = scene->error_ez;
    snprintf(scene->reference, sizeof scene->reference, "prony_truth.csv");
    for (char *c = scene->name; *c; c++)
        if (*c == ' ') *c = '-';
    int status = RESTITUTE_OK;
    if (strcmp(modulus, "pib") == 0) {
        status = read_ball(scene, error);
    } else {
        scene->g_inf = strtod(modulus, NULL);
        read_terms(terms, scene);
    }
    if (status) return status;
    return restitute_material_prony(scene->g_inf, 0, scene->n_terms, scene->tau, scene->g, 0.5, &scene->solid, error);
}

static int add_prony(int quick, struct bench_scenes *list, restitute_error *error)
{
    for (size_t i = 0; i < (quick ? 1 : COUNT(prony_rows)); i++) {
        const int status = read_prony(prony_rows[i], &list->scenes[list->count++], error);
        if (status) return status;
    }
    return RESTITUTE_OK;
}

int bench_scenes_create(unsigned sets, int quick, struct bench_scenes *scenes, restitute_error *error)
{
    const size_t most = COUNT(impact_rows) + COUNT(prony_rows) + 8;
    int status = RESTITUTE_OK;
    *scenes = (struct bench_scenes){.scenes = calloc(most, sizeof *scenes->scenes)};
    if (!scenes->scenes) {
        snprintf(error->message, sizeof error->message, "out of memory for %zu scenes", most);
        return error->status = RESTITUTE_ERROR_MEMORY;
    }
    if (sets & BENCH_TRUTH) add_truth(quick, scenes);
    if (sets & BENCH_STIFF) add_stiff(quick, scenes);
    if (sets & BENCH_PRONY) status = add_prony(quick, scenes, error);
    if (status) bench_scenes_destroy(scenes);
    return status;
}

void bench_scenes_destroy(struct bench_scenes *scenes)
{
    for (size_t i = 0; i < scenes->count; i++)
        restitute_material_destroy(scenes->scenes[i].solid);
    free(scenes->scenes);
    *scenes = (struct bench_scenes){NULL, 0};
}

restitute_impact bench_scene_impact(const struct bench_scene *scene)
{
    restitute_impact impact;
    restitute_impact_init(&impact);
    impact.chi = scene->chi;
    impact.psi = scene->psi;
    if (scene->solid) {
        impact.material = scene->solid;
    } else {
        impact.delta1 = scene->delta1;
        impact.gamma = scene->gamma;
    }
    return impact;
}

struct paper_problem bench_scene_paper(const struct bench_scene *scene)
{
    return (struct paper_problem){scene->chi,     scene->psi, scene->g_inf, scene->eta,
                                  scene->n_terms, scene->g,   scene->tau};
}

static int solve(const struct bench_scene *scene, const restitute_method *method, double tolerance, double max_work,
                 restitute_result *result, restitute_error *error)
{
    restitute_options options;
    restitute_solver *solver;
    restitute_options_init(&options);
    restitute_result_init(result);
    options.method = method;
    options.tolerance = tolerance;
    options.max_work = max_work;
    options.time_limit = INFINITY;
    int status = restitute_solver_create(&options, &solver, error);
    if (status) return status;
    const restitute_impact impact = bench_scene_impact(scene);
    status = restitute_solve(solver, &impact, result, NULL, NULL, error);
    restitute_solver_destroy(solver);
    return status;
}

int bench_scene_complete(struct bench_scene *scene, double tolerance, double max_work, restitute_error *error)
{
    const struct bench_method *method = bench_reference_method();
    restitute_result result;
    if (scene->has_reference) tolerance = 1e-3; /* radius and contact time to about that are good enough */
    const int status = solve(scene, method->handle(), tolerance, max_work, &result, error);
    if (status < 0) return status;
    scene->radius = result.max_contact_radius;
    scene->contact_time = result.contact_time;
    if (scene->has_reference) return status;
    scene->ez = result.ez;
    scene->ex = result.ex;
    scene->error_ez = result.error_ez;
    scene->error_ex = result.error_ex;
    scene->has_reference = 1;
    scene->reference_method = method->name;
    scene->reference_tolerance = tolerance;
    snprintf(scene->reference, sizeof scene->reference, "%s at %g in this run", method->name, tolerance);
    return status;
}

double bench_scene_uncertainty(const struct bench_scene *scene)
{
    return fmax(scene->error_ez, scene->error_ex);
}
