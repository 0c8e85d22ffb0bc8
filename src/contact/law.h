/* Inside of a contact law.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_LAW_H
#define RST_CONTACT_LAW_H

#include <restitute/contact.h>

#include "contact/kernel.h"

struct restitute_contact_law {
    struct rst_law kernel;
    size_t size; /* doubles of a state */
    uint64_t hash;
    int halved; /* both bodies deform */
    double error_bound;
    rst_kernel *step_one, *step_lanes; /* for the vectors of this machine */
};

/* A relaxation modulus. */
struct rst_series {
    double g_inf, eta;
    size_t n_terms;
    const double *tau, *g;
};

/* Fit at most `terms` terms to a longer series, for times from `shortest` to `longest`. Sets g_inf,
 * eta, n_terms, tau and g of the law and the bound on the relative error of G(t): infinite if G is
 * 0 at `longest`; then no law is set. */
void rst_reduce_series(const struct rst_series *series, int terms, double shortest, double longest, struct rst_law *law,
                       double *error_bound);

/* Sets the nodes of a law with n. */
void rst_law_grid(struct rst_law *law);

void rst_law_rates(const struct rst_law *law, double step, struct rst_rates *rates);

/* To be expected from the speed of first touch. */
double rst_law_largest_overlap(const struct rst_law *law, double mass, double radius, double speed);

/* Over the time scale largest overlap/speed: how long an elastic impact lasts (Hertz). */
#define RST_ELASTIC_CONTACT_TIME 2.9432751843

/* A new contact: its grid, for an impact at this speed, if it approaches, and for the present
 * overlap. 0: it would last less than ten steps; nothing is done then. */
int rst_contact_begin(const struct rst_law *law, double step, const restitute_contact_motion *motion, double *state);

/* A contact of radius^2 `area` has outgrown its grid: a wider one, and what there is on it. */
void rst_contact_stretch(const struct rst_law *law, double area, double *state);

/* A contact of radius^2 `area` has less than a third of the area of its grid: then slip has too
 * few elements. */
static inline int rst_is_wide(double area, double width)
{
    return 3 * area < width * width;
}

/* ... and is at rest, and relaxed outside the contact: its grid may be narrowed. */
int rst_contact_may_shrink(const struct rst_law *law, double change, double overlap, double radius,
                           const double *state);
void rst_contact_shrink(const struct rst_law *law, double area, double *state);

/* The kernel can advance the first n contacts of a batch. */
int rst_all_good(const restitute_contact_law *law, double step, const struct rst_batch *batch, int n);

/* Statuses, in words: a motion is in its ranges; the normal has not turned too far; a state is one
 * of the law. */
int rst_check_motion(double step, const restitute_contact_motion *motion, restitute_error *error);
int rst_check_turn(const double normal[3], const double *state, restitute_error *error);
int rst_check_state(const restitute_contact_law *law, const double *state, restitute_error *error);
int rst_check_unit(const double *v, const char *name, restitute_error *error);
int rst_check_radius(double radius, const char *name, restitute_error *error);

/* The first number of a state is the grid width. Its lowest bits are replaced by bits of the hash
 * of the law, since a width does not need all its digits. */
enum { rst_mark_bits = (1 << 24) - 1 };

static inline uint64_t rst_bits_of(double value)
{
    union {
        double value;
        uint64_t bits;
    } const both = {value};
    return both.bits;
}

static inline void rst_mark(const restitute_contact_law *law, double *width)
{
    const union {
        uint64_t bits;
        double value;
    } both = {(rst_bits_of(*width) & ~(uint64_t)rst_mark_bits) | (law->hash & rst_mark_bits)};
    *width = both.value;
}

static inline int rst_is_new(const double *state)
{
    return rst_bits_of(state[0]) == 0;
}

static inline int rst_is_own(const restitute_contact_law *law, const double *state)
{
    return rst_is_new(state) || ((rst_bits_of(state[0]) ^ law->hash) & rst_mark_bits) == 0;
}

/* A contact and its motion as a lane of a batch. */
static inline void rst_put(const restitute_contact_motion *m, double *state, int lane, struct rst_batch *batch)
{
    for (int i = 0; i < 3; i++) {
        batch->normal[i][lane] = m->normal[i];
        batch->velocity[i][lane] = m->velocity[i];
        batch->axis[i][lane] = state[at_axis + i];
    }
    batch->overlap[lane] = m->overlap;
    batch->turn[lane] = m->spin;
    batch->inverse_mass[0][lane] = m->inverse_mass;
    batch->inverse_mass[1][lane] = m->inverse_tangential_mass;
    batch->radius[lane] = m->radius;
    batch->friction[lane] = m->friction;
    batch->width[lane] = state[at_width];
    batch->state[lane] = state;
}

#endif
