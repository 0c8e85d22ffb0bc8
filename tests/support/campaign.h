/* Random impacts of the whole domain and of its corners, by name, for the campaign of the method
 * `sync`, and the command that solves one of them again. Needs open_memstream of POSIX 2008.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_CAMPAIGN_H
#define TEST_CAMPAIGN_H

#include <string.h>

#include "corners.h"
#include "data.h"
#include "domain.h"

/* What impacts are drawn with. */
struct campaign_draw {
    uint64_t random;
    double tolerance;                            /* one of those that are tested */
    restitute_solver *normal;                    /* gives e_z, to draw psi around psi_c */
    double pib_tau[pib_terms], pib_g[pib_terms]; /* s, Pa */
};

enum campaign_kind { ELASTIC, KELVIN_VOIGT, STANDARD, MAXWELL, PRONY, POLYISOBUTYLENE, CAMPAIGN_KINDS };

enum { most_campaign_terms = 6 };

/* Every impact has a solid of its own, or none. */
static inline void free_impact(restitute_impact *impact)
{
    restitute_material_destroy((restitute_material *)impact->material);
    impact->material = NULL;
}

/* The measured solid at an impact time anywhere among its relaxation times; G_r is its modulus at
 * that time. Moduli vary, so that no two solids are alike. */
static inline restitute_material *draw_polyisobutylene(struct campaign_draw *d)
{
    const double time = random_log(&d->random, 1e-11, 1e5);
    double tau[pib_terms], g[pib_terms], modulus = 0;
    for (int k = 0; k < pib_terms; k++) {
        tau[k] = d->pib_tau[k] / time;
        g[k] = d->pib_g[k] * random_log(&d->random, 0.5, 2);
        modulus += g[k] * exp(-1 / tau[k]);
    }
    for (int k = 0; k < pib_terms; k++)
        g[k] /= modulus;
    return solid_of(0, 0, pib_terms, tau, g);
}

/* Terms of any times and moduli. Every fourth solid is a fluid, every second has a dashpot. */
static inline restitute_material *draw_prony(uint64_t *random, int least)
{
    double tau[most_campaign_terms], g[most_campaign_terms];
    const int terms = least + random_below(random, most_campaign_terms + 1 - least);
    const double g_inf = random_below(random, 4) ? 1 : 0;
    const double eta = random_below(random, 2) ? random_log(random, 1e-4, 1e3) : 0;
    for (int k = 0; k < terms; k++) {
        tau[k] = random_log(random, 1e-4, 1e4);
        g[k] = random_log(random, 1e-2, 1e2);
    }
    return solid_of(g_inf, eta, (size_t)terms, tau, g);
}

/* A Maxwell body in units of its own modulus. */
static inline restitute_material *maxwell_of(double tau)
{
    const double g = 1;
    return solid_of(0, 0, 1, &tau, &g);
}

static inline restitute_impact draw_solid(struct campaign_draw *d, enum campaign_kind kind)
{
    restitute_impact impact = impact_of(7.0 / 6, 0, 0, INFINITY);
    if (kind == KELVIN_VOIGT || kind == STANDARD) impact.delta1 = random_log(&d->random, 1e-4, 1e5);
    if (kind == KELVIN_VOIGT) impact.gamma = 0;
    if (kind == STANDARD) impact.gamma = random_log(&d->random, 1e-4, 1e4);
    if (kind == MAXWELL) impact.material = maxwell_of(random_log(&d->random, 0.05, 1e4));
    if (kind == PRONY) impact.material = draw_prony(&d->random, 2);
    if (kind == POLYISOBUTYLENE) impact.material = draw_polyisobutylene(d);
    return impact;
}

static inline restitute_impact draw_any_solid(struct campaign_draw *d)
{
    return draw_solid(d, (enum campaign_kind)random_below(&d->random, CAMPAIGN_KINDS));
}

static inline double draw_chi(uint64_t *random)
{
    const int kind = random_below(random, 10);
    if (kind == 0) return random_in(random, 1.0 / 3, 0.5); /* rotation blocked */
    if (kind == 1) return random_in(random, 0.5, 0.52);    /* gross slip hardly changes its velocity */
    if (kind == 2) return random_log(random, 4, 1000);
    if (kind == 3) return random_below(random, 2) ? 7.0 / 6 : 1.0 / 3;
    return fmax(1.0 / 3, random_log(random, 1.0 / 3, 4));
}

/* Off by a tenth to a billionth, to either side. */
static inline double draw_around(uint64_t *random, double value)
{
    const double off = random_log(random, 1e-9, 0.1);
    return random_below(random, 2) ? value * (1 + off) : value * (1 - off);
}

/* Slip to the end gives e_z without tangential motion. */
static inline double critical_psi_of(struct campaign_draw *d, const restitute_impact *impact)
{
    restitute_impact slipping = *impact;
    PREPARED(result, result);
    slipping.psi = 1e12;
    const int status = restitute_solve(d->normal, &slipping, &result, NULL, NULL, NULL);
    return restitute_critical_psi(impact->chi, status < 0 ? 0.5 : fmin(fmax(result.ez, 0), 1));
}

static inline double draw_psi(struct campaign_draw *d, const restitute_impact *impact)
{
    uint64_t *random = &d->random;
    const int kind = random_below(random, 16);
    if (kind == 0) return 0;    /* no slip */
    if (kind == 1) return 1e12; /* as good as frictionless */
    if (kind == 2) return random_log(random, 10, 1e12);
    if (kind == 3) return 1;
    if (kind <= 5) return draw_around(random, 1);
    if (kind <= 7) return draw_around(random, critical_psi_of(d, impact));
    if (kind <= 10) return random_log(random, 1e-9, 10);
    if (kind <= 13) return random_log(random, 1e-2, 10);
    return random_in(random, 0, 10);
}

/* ---- the corners */

static inline restitute_impact any_impact(struct campaign_draw *d)
{
    restitute_impact impact = draw_any_solid(d);
    impact.chi = draw_chi(&d->random);
    impact.psi = draw_psi(d, &impact);
    return impact;
}

/* The domain in which the default error is promised; one case in six on a face of it. */
static inline restitute_impact usual_impact(struct campaign_draw *d)
{
    uint64_t *random = &d->random;
    const int face = random_below(random, 50);
    const double any_chi = random_in(random, 1.0 / 3, 4);
    const double chi = random_below(random, 5) < 2 ? 7.0 / 6 : any_chi, psi = random_log(random, 0.05, 10);
    const double delta1 = random_log(random, 1e-3, 100), gamma = random_log(random, 1e-3, 1e3);
    return impact_of(face == 6 ? 4 : face == 7 ? 1.0 / 3 : chi, face == 8 ? 0.05 : psi, face < 3 ? 0 : delta1,
                     face >= 3 && face < 6 ? 0 : gamma);
}

static inline restitute_impact blocked_corner(struct campaign_draw *d)
{
    return blocked_impact(&d->random);
}

static inline restitute_impact thin_corner(struct campaign_draw *d)
{
    return thin_impact(&d->random, d->tolerance);
}

/* Few terms whose times lie far apart: the force has several maxima and is zero in between. */
static inline restitute_impact ripple_corner(struct campaign_draw *d)
{
    uint64_t *random = &d->random;
    double tau[4], g[4], time = random_log(random, 1e-7, 1e-2);
    const int terms = 2 + random_below(random, 3);
    for (int k = 0; k < terms; k++) {
        tau[k] = time;
        g[k] = random_log(random, 1e-2, 10) / fmin(time, 1); /* fast ones felt as dashpots are */
        time *= random_log(random, 20, 2000);
    }
    const double eta = random_below(random, 3) ? 0 : random_log(random, 1e-3, 10);
    restitute_impact impact = impact_on(solid_of(random_below(random, 3) ? 1 : 0, eta, (size_t)terms, tau, g), 1, 0);
    impact.chi = draw_chi(random);
    impact.psi = draw_psi(d, &impact);
    return impact;
}

static inline restitute_impact nearly_kelvin_voigt_corner(struct campaign_draw *d)
{
    restitute_impact impact = impact_of(7.0 / 6, 0, random_log(&d->random, 10, 1e4), 0);
    impact.gamma = random_log(&d->random, 1e-8, 1e-3);
    impact.chi = draw_chi(&d->random);
    impact.psi = draw_psi(d, &impact);
    return impact;
}

static inline restitute_impact tiny_psi_corner(struct campaign_draw *d)
{
    restitute_impact impact = draw_any_solid(d);
    impact.chi = draw_chi(&d->random);
    impact.psi = random_log(&d->random, 1e-12, 1e-8);
    return impact;
}

/* A Maxwell body between sinking and rebound. Every third one has a weak spring in parallel, G1/G2
 * = gamma: its time over the T of its G2 is gamma^0.6 theta. */
static inline restitute_impact nearly_sinking_corner(struct campaign_draw *d)
{
    const double tau = random_in(&d->random, 0.25, 0.4);
    restitute_impact impact = impact_of(7.0 / 6, 0, random_log(&d->random, 4e4, 1e7), 0);
    impact.gamma = pow(tau / (THETA_OF_DELTA1 * impact.delta1), 1 / 0.6);
    if (random_below(&d->random, 3)) impact.material = maxwell_of(tau);
    impact.chi = draw_chi(&d->random);
    impact.psi = draw_psi(d, &impact);
    return impact;
}

static inline restitute_impact strong_damping_corner(struct campaign_draw *d)
{
    restitute_impact impact = impact_of(7.0 / 6, 0, random_log(&d->random, 4e4, 1e12), 0);
    impact.gamma = random_below(&d->random, 4) ? random_log(&d->random, 1e-12, 1e4) : 0;
    impact.chi = draw_chi(&d->random);
    impact.psi = draw_psi(d, &impact);
    return impact;
}

/* Spheres that lose nearly nothing, so e_z is nearly 1. */
static inline restitute_impact nearly_elastic_corner(struct campaign_draw *d)
{
    restitute_impact impact = impact_of(7.0 / 6, 0, random_log(&d->random, 1e-12, 1e-4), 0);
    if (random_below(&d->random, 3) == 0) impact.gamma = random_log(&d->random, 1e-4, 1e4);
    impact.chi = draw_chi(&d->random);
    impact.psi = draw_psi(d, &impact);
    return impact;
}

/* Fluids in which the sphere sinks, rotation blocked. */
static inline restitute_impact blocked_sinking_corner(struct campaign_draw *d)
{
    uint64_t *random = &d->random;
    double tau[3], g[3];
    const int terms = 1 + random_below(random, 3);
    const double eta = random_below(random, 3) ? 0 : random_log(random, 1e-3, 10);
    for (int k = 0; k < terms; k++) {
        tau[k] = random_log(random, 1e-3, 0.22);
        g[k] = random_log(random, 0.1, 1) / terms;
    }
    restitute_impact impact = impact_on(solid_of(0, eta, (size_t)terms, tau, g), 1, 0);
    impact.chi = random_below(random, 8) ? random_in(random, 1.0 / 3, 0.5) : random_below(random, 2) ? 0.5 : 1.0 / 3;
    impact.psi = draw_psi(d, &impact);
    return impact;
}

/* Where U' swings many times, and most impacts take elements. */
static inline restitute_impact large_chi_corner(struct campaign_draw *d)
{
    restitute_impact impact = draw_any_solid(d);
    impact.chi = random_log(&d->random, 4, 1000);
    impact.psi = draw_psi(d, &impact);
    return impact;
}

/* Solids that the library refuses: no modulus and no viscosity, or delta1 of the dashpot above
 * 1e12. */
static inline int is_accepted(const restitute_material *solid)
{
    double eta;
    return solid && restitute_material_series(solid, NULL, &eta, NULL, NULL, NULL) == RESTITUTE_OK &&
           eta <= THETA_OF_DELTA1 * 1e12;
}

/* The ends of all ranges (domain.h), where the default of max_work has to do. */
static inline restitute_impact limit_corner(struct campaign_draw *d)
{
    const enum reach reach = random_below(&d->random, 2) ? WIDE : EXTREME;
    restitute_impact impact;
    draw_impact(&d->random, reach, &impact);
    impact.chi = fmax(impact.chi, 1.0 / 3);
    if (random_below(&d->random, 2)) impact.material = draw_material(&d->random, reach, 1, 1);
    if (!is_accepted(impact.material)) free_impact(&impact);
    return impact;
}

static const struct campaign_corner {
    const char *name;
    restitute_impact (*draw)(struct campaign_draw *d);
} campaign_corners[] = {
    {"domain", any_impact},
    {"usual", usual_impact},
    {"blocked", blocked_corner},
    {"thin-slip", thin_corner},
    {"ripple", ripple_corner},
    {"nearly-kv", nearly_kelvin_voigt_corner},
    {"tiny-psi", tiny_psi_corner},
    {"nearly-sinking", nearly_sinking_corner},
    {"strong-damping", strong_damping_corner},
    {"nearly-elastic", nearly_elastic_corner},
    {"blocked-sinking", blocked_sinking_corner},
    {"limits", limit_corner},
    {"large-chi", large_chi_corner},
};

enum { CAMPAIGN_CORNERS = sizeof campaign_corners / sizeof *campaign_corners };

/* ---- to solve it again */

/* A material file of any solid, on one line. */
static inline void write_solid(const restitute_material *solid, FILE *out)
{
    double tau[64], g[64], g_inf, eta;
    const size_t terms = restitute_material_terms(solid);
    if (terms > 64 || restitute_material_series(solid, &g_inf, &eta, tau, g, NULL) < 0) return;
    fprintf(out, "echo '{\"name\": \"case\", \"poisson_ratio\": 0.5, \"model\": ");
    if (terms == 0 && eta == 0) {
        fprintf(out, "\"elastic\", \"modulus_pa\": %.17g", g_inf);
    } else if (terms == 0) {
        fprintf(out, "\"kelvin_voigt\", \"modulus1_pa\": %.17g, \"viscosity_pa_s\": %.17g", g_inf, eta);
    } else {
        fprintf(out, "\"prony\", \"equilibrium_modulus_pa\": %.17g, \"parallel_viscosity_pa_s\": %.17g, \"terms\": [",
                g_inf, eta);
        for (size_t k = 0; k < terms; k++)
            fprintf(out, "%s{\"tau_s\": %.17g, \"modulus_pa\": %.17g}", k ? ", " : "", tau[k], g[k]);
        fprintf(out, "]");
    }
    fprintf(out, "}' >case.json; ");
}

/* The command that solves it, to be freed; NULL without memory. A solid goes as a scene in which d0
 * and T of G_r = 1 Pa are 1 m and 1 s (24): R = 1 m, nu = 1/2, m = 64/15 kg, 1 m/s, 45 degrees. */
static inline char *command_of(const restitute_impact *impact, const restitute_options *options)
{
    const double mass = 64.0 / 15, friction = impact->psi > 0 ? 2 / (3 * impact->psi) : INFINITY;
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    if (!impact->material) {
        fprintf(out, "restitute pair --chi %.17g --psi %.17g --delta1 %.17g --gamma %.17g", impact->chi, impact->psi,
                impact->delta1, impact->gamma);
    } else {
        write_solid(impact->material, out);
        fprintf(out, "restitute pair --material case.json --radius 1 --mass1 %.17g", mass);
        fprintf(out, " --velocity 1.4142135623730951 --angle 45 --friction %.17g", friction);
        if (3 * impact->chi > 1)
            fprintf(out, " --inertia1 %.17g", mass / (3 * impact->chi - 1));
        else
            fprintf(out, " --rotation-blocked");
    }
    fprintf(out, " --method %s --tolerance %g", restitute_method_name(options->method), options->tolerance);
    fclose(out);
    return text;
}

#endif
