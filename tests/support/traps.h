/* No call with valid input raises a floating-point exception that a program may trap, and all
 * results are finite. All methods run the same sweeps.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_TRAPS_H
#define TEST_TRAPS_H

#ifdef RESTITUTE_HAVE_FEENABLEEXCEPT
#define _GNU_SOURCE
#endif
#include <fenv.h>

#include "data.h"
#include "domain.h"
#include "history.h"
#include "solids.h"

enum { trap_samples = 40 };
#define TRAPPED (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW)

/* A call of anything: its value, with the flags that it raised looked at. `...`: what to say of
 * it. */
#define WITHOUT_TRAPS(status, call, ...)                                                                               \
    do {                                                                                                               \
        feclearexcept(FE_ALL_EXCEPT);                                                                                  \
        (status) = (call);                                                                                             \
        const int raised_ = fetestexcept(TRAPPED);                                                                     \
        if (raised_ && (status) != RESTITUTE_ERROR_DOMAIN) {                                                           \
            print_error("%s%s%sby " #call " (status %d): ", raised_ &FE_INVALID ? "INVALID " : "",                     \
                        raised_ &FE_DIVBYZERO ? "DIVBYZERO " : "", raised_ &FE_OVERFLOW ? "OVERFLOW " : "", status);   \
            CHECK(!raised_, __VA_ARGS__);                                                                              \
        }                                                                                                              \
    } while (0)

static inline int solve_case(restitute_solver *solver, const struct drawn *d, restitute_result *result,
                             restitute_ledger *ledger, restitute_history *history, restitute_error *error)
{
    return d->is_scene ? restitute_solve_scene(solver, &d->scene, result, ledger, history, error)
                       : restitute_solve(solver, &d->impact, result, ledger, history, error);
}

static inline void all_finite(const struct drawn *d, const restitute_result *r, const restitute_ledger *l)
{
    const double value[] = {r->ez,
                            r->ex,
                            r->error_ez,
                            r->error_ex,
                            r->max_indentation,
                            r->max_contact_radius,
                            r->max_normal_force,
                            r->merging_bound,
                            r->time_step,
                            r->element_spacing,
                            l->rebound_z,
                            l->viscous_z,
                            l->left_z,
                            l->residual_z,
                            l->rebound_x,
                            l->friction_x,
                            l->viscous_x,
                            l->left_x,
                            l->residual_x};
    for (size_t i = 0; i < sizeof value / sizeof *value; i++)
        CHECK(isfinite(value[i]), "value %zu = %g: %s", i, value[i], d->text);
    CHECK(!isnan(r->contact_time), "contact time: %s", d->text);
    if (d->is_scene)
        CHECK(!isnan(r->speed_ratio) && isfinite(r->radius_ratio) && isfinite(r->displacement_ratio), "%s", d->text);
}

/* The pair; then the ledger and the history, which repeat it in other ways and may be refused by
 * themselves. */
static inline int sweep_case(restitute_solver *solver, const struct drawn *d)
{
    static double columns[8][trap_samples];
    restitute_result result, again;
    PREPARED(ledger, ledger);
    PREPARED(history, h);
    restitute_error error;
    int status;
    restitute_result_init(&result);
    restitute_result_init(&again);
    set_columns(&h, trap_samples, columns[0], all_columns);
    WITHOUT_TRAPS(status, solve_case(solver, d, &result, NULL, NULL, &error), "%s", d->text);
    if (status < 0) return status;
    all_finite(d, &result, &ledger);
    WITHOUT_TRAPS(status, solve_case(solver, d, &again, &ledger, &h, &error), "%s", d->text);
    if (status < 0) return status;
    all_finite(d, &again, &ledger);
    for (int c = 0; c < 8; c++)
        for (size_t i = 0; i < h.count; i++)
            CHECK(isfinite(columns[c][i]), "column %d, sample %zu: %s", c, i, d->text);
    return status;
}

static inline restitute_solver *solver_of(const restitute_method *method, double tolerance, double max_work)
{
    restitute_options options = to_tolerance(tolerance);
    options.method = method;
    options.max_work = max_work;
    return make_solver(&options);
}

/* Random cases of each reach; some of the extreme ones are refused, and some take more than
 * max_updates. */
static inline void sweep_random(const restitute_method *method, uint64_t seed, const int counts[REACHES],
                                double tolerance, double max_work)
{
    restitute_solver *solver = solver_of(method, tolerance, max_work);
    for (int reach = 0; reach < REACHES; reach++) {
        int done = 0;
        for (int n = 0; n < counts[reach]; n++) {
            struct drawn d = draw_case(&seed, (enum reach)reach, n);
            done += sweep_case(solver, &d) >= 0;
            restitute_material_destroy(d.material);
        }
        CHECK(4 * done >= counts[reach], "reach %d: %d of %d cases solved", reach, done, counts[reach]);
    }
    restitute_solver_destroy(solver);
}

/* Every `every`-th of: the reference values; solids of every kind, rotating or not; the Prony solid
 * of 30 terms, and one that sinks. */
static inline void sweep_known(const restitute_method *method, double tolerance, int every)
{
    restitute_solver *solver = solver_of(method, tolerance, 1);
    struct truth rows[truth_rows];
    struct solid all[solids];
    struct drawn d = {0};
    read_truth(rows);
    for (int i = 0; i < truth_rows; i += every) {
        d.impact = impact_of(rows[i].chi, rows[i].psi, rows[i].delta1, rows[i].gamma);
        snprintf(d.text, sizeof d.text, "row %d", i);
        sweep_case(solver, &d);
    }
    make_solids(all);
    const double chis[] = {0.4, 7.0 / 6}, psis[] = {0, 0.5, 1.4, 6};
    for (int i = 0, k = 0; i < solids; i++)
        for (int c = 0; c < 2; c++)
            for (int p = 0; p < 4; p++, k++) {
                if (k % every) continue;
                d.impact = impact_with(&all[i], chis[c], psis[p]);
                snprintf(d.text, sizeof d.text, "%s, chi %g, psi %g", all[i].name, chis[c], psis[p]);
                sweep_case(solver, &d);
            }
    double tau[pib_terms], g[pib_terms], sinking_time = 0.2, one = 1;
    read_pib(tau, g);
    restitute_material *pib = solid_of(0, 0, pib_terms, tau, g), *sinking = solid_of(0, 0, 1, &sinking_time, &one);
    d.is_scene = 1;
    restitute_scene_init(&d.scene);
    d.scene.radius1 = 0.005, d.scene.mass1 = 0.004;
    const double frictions[] = {0, 0.3, INFINITY};
    for (int i = 0, k = 0; i < 3; i++)
        for (double v = 1e-4; v < 20; v *= 100, k++) {
            if (k % every) continue;
            d.scene.material = pib;
            d.scene.friction = frictions[i], d.scene.normal_speed = v, d.scene.tangential_speed = v;
            snprintf(d.text, sizeof d.text, "polyisobutylene, friction %g, %g m/s", frictions[i], v);
            sweep_case(solver, &d);
            d.is_scene = 0;
            d.impact = impact_on(sinking, 7.0 / 6, i == 0 ? 0 : 0.7 * i);
            snprintf(d.text, sizeof d.text, "a Maxwell body that sinks, psi %g", d.impact.psi);
            sweep_case(solver, &d);
            d.is_scene = 1;
        }
    restitute_material_destroy(pib);
    restitute_material_destroy(sinking);
    free_solids(all);
    restitute_solver_destroy(solver);
}

/* A host that has traps on is not ended: one impact of each mode. */
static inline void host_that_traps(const restitute_method *method)
{
#ifdef RESTITUTE_HAVE_FEENABLEEXCEPT
    const double psis[] = {0, 0.6, 1.5, 6};
    for (int i = 0; i < 4; i++) {
        restitute_solver *solver = solver_of(method, 1e-2, 1);
        restitute_impact impact = impact_of(7.0 / 6, psis[i], 1, 1);
        feenableexcept(TRAPPED);
        const int status = restitute_solve(solver, &impact, NULL, NULL, NULL, NULL);
        fedisableexcept(TRAPPED);
        CHECK(status == RESTITUTE_OK, "%d", status);
        restitute_solver_destroy(solver);
    }
#else
    (void)method;
    print_message("skipped: no feenableexcept in this C library\n");
    skip();
#endif
}

#endif
