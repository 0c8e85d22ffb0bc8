/* What leaving out saves: the time of a scene that needs everything ("full") and of one like it in
 * which a part can be left out ("lean"), in one run and in turn, as CSV.
 *
 *     omissions METHODS REPEATS
 *
 * The full scene is next to the lean one: a dashpot that is weak but not negligible, psi below and
 * not above 1, a friction that is not zero. An impact that is refused has empty cells.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

enum { long_terms = 30 };

/* What an impact is made of here. */
enum solid { STANDARD, ELASTIC, WEAK_DASHPOT, VOIGT, MAXWELL, FELT_TERMS, SPREAD_TERMS };

struct variant {
    const char *name;
    enum solid solid;
    double psi; /* infinite: no friction */
    int ledger;
    int planned; /* by a plan, which has the normal motion already */
};

/* chosen: elements and step are chosen by the method at the default tolerance, else prescribed. */
static const struct pair {
    const char *left_out;
    struct variant full, lean;
    int chosen;
} pairs[] = {
    {"dashpot states", {"a dashpot that changes the result by 1e-5", WEAK_DASHPOT, 0.7, 0, 0},
     {"elastic", ELASTIC, 0.7, 0, 0}, 0},
    {"tangential states: the normal problem only", {"psi = 0.7", STANDARD, 0.7, 0, 0},
     {"frictionless", STANDARD, INFINITY, 0, 0}, 0},
    {"tangential elements in full slip", {"psi = 0.9", STANDARD, 0.9, 0, 0},
     {"psi = 5, above psi_c", STANDARD, 5, 0, 0}, 0},
    {"tangential elements in gross slip", {"psi = 0.9", STANDARD, 0.9, 0, 0}, {"psi = 1.6", STANDARD, 1.6, 0, 0}, 0},
    {"friction limit", {"psi = 1e-9", STANDARD, 1e-9, 0, 0}, {"psi = 0", STANDARD, 0, 0, 0}, 0},
    {"merged Prony terms", {"30 terms in two decades, none merged", FELT_TERMS, 0.7, 0, 0},
     {"30 terms over 18 decades, merged at 1e-3", SPREAD_TERMS, 0.7, 0, 0}, 0},
    {"energy ledger", {"asked for", STANDARD, 0.7, 1, 0}, {"not asked for", STANDARD, 0.7, 0, 0}, 0},
    {"normal motion of a standard solid", {"a single call", STANDARD, 0.7, 0, 0},
     {"a plan that has it", STANDARD, 0.7, 0, 1}, 0},
    {"normal motion of 30 terms", {"a single call", FELT_TERMS, 0.7, 0, 0},
     {"a plan that has it", FELT_TERMS, 0.7, 0, 1}, 0},
    {"default impact", {"Kelvin-Voigt", VOIGT, 0.7, 0, 0}, {"elastic", ELASTIC, 0.7, 0, 0}, 1},
    {"default impact", {"Maxwell", MAXWELL, 0.7, 0, 0}, {"elastic", ELASTIC, 0.7, 0, 0}, 1},
    {"default impact", {"standard solid", STANDARD, 0.7, 0, 0}, {"elastic", ELASTIC, 0.7, 0, 0}, 1},
    {"default impact", {"30 terms, merged", SPREAD_TERMS, 0.7, 0, 0}, {"elastic", ELASTIC, 0.7, 0, 0}, 1},
};

/* Where resolution is prescribed: as many elements and steps as the default tolerance takes for
 * most impacts. */
static const int64_t elements = 64;
static const double step = 1e-3;

/* Prescribed resolution leaves to the tolerance only what is merged: with the smallest one, nothing
 * that the impact feels. */
static const double keep_all = 1e-8, merge = 1e-3;

static int make_solid(enum solid kind, restitute_material **material, restitute_error *error)
{
    double tau[long_terms], g[long_terms];
    const double theta = 1.4605934866804429; /* delta1 = 1 (23) */
    switch (kind) {
    case ELASTIC:
        return restitute_material_elastic(1, 0.5, material, error);
    case WEAK_DASHPOT: /* felt by 1e-5 */
        return restitute_material_standard_solid(1, 1e-5, 1e-5, 0.5, material, error);
    case VOIGT:
        return restitute_material_kelvin_voigt(1, 0.3, 0.5, material, error);
    case MAXWELL:
        return restitute_material_maxwell(1, 3, 0.5, material, error);
    case FELT_TERMS:   /* two decades about the contact time of 3 T */
    case SPREAD_TERMS: /* eighteen decades */
        for (int k = 0; k < long_terms; k++) {
            tau[k] = kind == FELT_TERMS ? pow(10, -1 + 2.0 * k / (long_terms - 1)) : pow(10, -9 + 0.6 * k);
            g[k] = kind == FELT_TERMS ? 0.1 : tau[k] < 1 ? 0.3 : 0.03;
        }
        return restitute_material_prony(1, 0, long_terms, tau, g, 0.5, material, error);
    default:
        return restitute_material_standard_solid(1, 1, theta, 0.5, material, error);
    }
}

/* A variant ready to be timed. */
struct ready {
    restitute_material *solid;
    restitute_solver *solver;
    restitute_plan *plan; /* NULL: none */
    restitute_impact impact;
    int ledger;
    restitute_result result;
};

static int solve(struct ready *r, restitute_error *error)
{
    restitute_ledger ledger;
    restitute_ledger_init(&ledger);
    restitute_ledger *kept = r->ledger ? &ledger : NULL;
    if (r->plan) return restitute_plan_solve(r->plan, r->impact.psi, &r->result, kept, NULL, error);
    return restitute_solve(r->solver, &r->impact, &r->result, kept, NULL, error);
}

static int prepare(const struct bench_method *method, const struct variant *variant, int chosen, struct ready *r,
                   restitute_error *error)
{
    restitute_options options;
    restitute_options_init(&options);
    options.method = method->handle();
    if (!chosen) {
        options.tolerance = variant->solid == SPREAD_TERMS ? merge : keep_all;
        options.elements = elements;
        if (method->takes_time_step) options.time_step = step;
    }
    *r = (struct ready){.ledger = variant->ledger};
    restitute_result_init(&r->result);
    int status = make_solid(variant->solid, &r->solid, error);
    if (status) return status;
    restitute_impact_init(&r->impact);
    r->impact.psi = variant->psi;
    r->impact.material = r->solid;
    status = restitute_solver_create(&options, &r->solver, error);
    if (!status && variant->planned) status = restitute_plan_create(&r->impact, &options, &r->plan, error);
    return status ? status : solve(r, error);
}

static void release(struct ready *r)
{
    restitute_plan_destroy(r->plan);
    restitute_solver_destroy(r->solver);
    restitute_material_destroy(r->solid);
}

static double time_once(struct ready *r)
{
    const double start = bench_time();
    solve(r, NULL);
    return bench_time() - start;
}

/* The two in turn, so that what else the machine does meets both. Contact times differ a little;
 * where the step is prescribed the ratio is therefore that of times of a step. Steps that the
 * method chooses are part of what is saved. `times` has room for both. */
static void measure(struct ready *full, struct ready *lean, int repeats, int prescribed_step, double *times)
{
    for (int i = 0; i < repeats; i++) {
        times[i] = time_once(full);
        times[repeats + i] = time_once(lean);
    }
    const double seconds[] = {bench_median(times, (size_t)repeats), bench_median(times + repeats, (size_t)repeats)};
    const double steps = prescribed_step ? (double)lean->result.steps / (double)full->result.steps : 1;
    printf("%.4g,%.4g,%.4g\n", seconds[0], seconds[1], seconds[0] / seconds[1] * steps);
}

static void compare(const struct bench_method *method, const struct pair *p, int repeats, double *times)
{
    struct ready full = {0}, lean = {0};
    restitute_error error = {0};
    printf("%s,\"%s\",\"%s\",\"%s\",", method->name, p->left_out, p->full.name, p->lean.name);
    int status = prepare(method, &p->full, p->chosen, &full, &error);
    if (status >= 0) status = prepare(method, &p->lean, p->chosen, &lean, &error);
    if (status >= 0)
        measure(&full, &lean, repeats, !p->chosen && method->takes_time_step, times);
    else
        puts(",,");
    if (status < 0) fprintf(stderr, "omissions: %s, %s: %s\n", method->name, p->left_out, error.message);
    release(&full);
    release(&lean);
}

int main(int count, char **words)
{
    const int repeats = count == 3 ? atoi(words[2]) : 0;
    double *times = repeats > 0 ? malloc(2 * (size_t)repeats * sizeof *times) : NULL;
    if (!times) return fprintf(stderr, "usage: omissions METHODS REPEATS\n"), 2;
    puts("method,left_out,full,lean,seconds_full,seconds_lean,ratio");
    for (char *name = strtok(words[1], ","); name; name = strtok(NULL, ",")) {
        const struct bench_method *method = bench_method(name);
        if (!method || !method->handle) return fprintf(stderr, "omissions: no method %s\n", name), 2;
        for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
            compare(method, &pairs[i], repeats, times);
    }
    free(times);
}
