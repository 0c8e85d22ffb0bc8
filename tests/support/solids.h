/* Impacts on solids of every kind, for tests that go through all of them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_SOLIDS_H
#define TEST_SOLIDS_H

#include "solve.h"

enum { solids = 8 };

struct solid {
    const char *name;
    double delta1, gamma;         /* if there is no material */
    restitute_material *material; /* freed by free_solids */
};

static inline void make_solids(struct solid all[solids])
{
    static const double maxwell_time[] = {1}, maxwell[] = {1};
    static const double times[] = {0.05, 0.4, 3}, moduli[] = {1, 0.7, 0.5};
    const struct solid made[solids] = {
        {"elastic", 0, 1, NULL},
        {"standard, fast", 0.3, 0.2, NULL},
        {"standard", 1, 1, NULL},
        {"standard, stiff", 10, 0.05, NULL},
        {"Kelvin-Voigt, weak", 0.1, 0, NULL},
        {"Kelvin-Voigt", 0.5, 0, NULL},
        {"Maxwell", 0, 0, solid_of(0, 0, 1, maxwell_time, maxwell)},
        {"Prony with dashpot", 0, 0, solid_of(0.5, 0.1, 3, times, moduli)},
    };
    for (int i = 0; i < solids; i++)
        all[i] = made[i];
}

static inline void free_solids(struct solid all[solids])
{
    for (int i = 0; i < solids; i++)
        restitute_material_destroy(all[i].material);
}

static inline restitute_impact impact_with(const struct solid *solid, double chi, double psi)
{
    return solid->material ? impact_on(solid->material, chi, psi) : impact_of(chi, psi, solid->delta1, solid->gamma);
}

/* The method sync at a number of elements. The tolerance is one that no term is merged for and no
 * iteration stops early. */
static inline restitute_options sync_at(int64_t elements)
{
    restitute_options options = to_tolerance(1e-8);
    options.method = restitute_method_sync();
    options.elements = elements;
    return options;
}

#endif
