/* What must hold of a material that was read.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_FUZZ_MATERIALS_H
#define TEST_FUZZ_MATERIALS_H

#include <restitute/files.h>

#include "../support/bytes.h"
#include "fuzz.h"

static inline void check_solid(const restitute_material *material)
{
    double equilibrium, viscosity, window[2];
    const size_t terms = restitute_material_terms(material);
    double *tau = malloc((terms + 1) * sizeof *tau), *g = malloc((terms + 1) * sizeof *g);
    CHECK(tau && g, "out of memory");
    CALL(restitute_material_series, material, &equilibrium, &viscosity, tau, g);
    CALL(restitute_material_window, material, &window[0], &window[1]);
    CHECK(equilibrium >= 0 && equilibrium <= 1e30 && viscosity >= 0 && viscosity <= 1e60, "%g %g", equilibrium,
          viscosity);
    for (size_t k = 0; k < terms; k++)
        CHECK(tau[k] >= 1e-30 && tau[k] <= 1e30 && g[k] >= 1e-30 && g[k] <= 1e30 && (k == 0 || tau[k] > tau[k - 1]),
              "term %zu: %g s, %g Pa", k, tau[k], g[k]);
    CHECK(window[0] >= 0 && window[0] <= window[1], "window %g to %g s", window[0], window[1]); /* rounded */
    const double nu = restitute_material_poisson_ratio(material);
    CHECK(nu >= 0 && nu <= 0.5, "nu = %g", nu);
    for (double t = 1e-12; t < 1e13; t *= 1e3)
        CHECK(isfinite(restitute_material_modulus(material, t)), "G(%g s)", t);
    free(tau);
    free(g);
}

/* What a call made, if its status says so. */
static inline void end_made(int status, restitute_material *const *made)
{
    CHECK((status < 0) == !*made, "status %d", status);
    if (*made) check_solid(*made);
    restitute_material_destroy(*made);
}

static inline void check_at(double celsius, const restitute_material *material, const restitute_material_info *info)
{
    restitute_material *made = NULL;
    const int as_read =
        info->wlf_c1 > 0 && info->wlf_c2 > 0 && info->wlf_reference > -273.15; /* else it may overflow */
    end_made(CALL_IF(as_read, restitute_material_at_temperature, material, info, celsius, &made), &made);
}

static inline void check_info(const restitute_material_info *info)
{
    CHECK(memchr(info->name, 0, sizeof info->name) && memchr(info->source, 0, sizeof info->source) &&
              memchr(info->model, 0, sizeof info->model) && info->name[0] && info->model[0],
          "texts");
    CHECK(isnan(info->density) || (info->density > 0 && isfinite(info->density)), "%g kg/m^3", info->density);
    CHECK(isnan(info->temperature) || info->temperature > -273.15, "%g degrees", info->temperature);
    CHECK(info->window[0] >= 0 && info->window[0] < info->window[1], "window");
}

/* What a call read, if its status says so, and at any temperature from `low` on. */
static inline void end_read(int status, restitute_material *const *read, const restitute_material_info *info,
                            struct bytes *b, double low)
{
    if (status >= 0) {
        check_info(info);
        check_at(signed_number(b, low, 1e3), *read, info);
    }
    end_made(status, read);
}

static inline void check_file(const char *path, struct bytes *b)
{
    restitute_material *material = NULL;
    PREPARED(material_info, info);
    memset((char *)&info + sizeof info.struct_size, 0x5a, sizeof info - sizeof info.struct_size);
    restitute_material_info *given = sized(b, &info);
    const size_t size = given->struct_size;
    const int status = CALL(restitute_material_read, path, &material, given);
    CHECK(size == sizeof info || status < 0, "status %d", status);
    CHECK(status >= 0 || size != sizeof info || memcmp(given, &info, sizeof info) == 0, "info was written");
    end_read(status, &material, given, b, 1e-3);
    free(given);
}

#endif
