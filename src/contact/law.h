/* Inside of a contact law.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTACT_LAW_H
#define RST_CONTACT_LAW_H

#include <restitute/contact.h>
#include <string.h>

#include "contact/kernel.h"

struct restitute_contact_law {
    struct rst_law kernel;
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
 * eta, the number of terms, tau and g of the law and the bound on the relative error of G(t):
 * infinite if G is 0 at `longest`; then no law is set. */
void rst_reduce_series(const struct rst_series *series, int terms, double shortest, double longest, struct rst_law *law,
                       double *error_bound);

/* Sets the nodes of a law with n. */
void rst_law_grid(struct rst_law *law);

void rst_law_rates(const struct rst_law *law, double step, struct rst_rates *rates);

/* To be expected from the speed of first touch. */
double rst_law_largest_overlap(const struct rst_law *law, double mass, double radius, double speed);

/* Over the time scale largest overlap/speed: how long an elastic impact lasts (Hertz). */
#define RST_ELASTIC_CONTACT_TIME 2.9432751843

/* How fast a contact of a batch closes. */
static inline double rst_approach(const struct rst_batch *b, int l)
{
    return b->normal[0][l] * b->velocity[0][l] + b->normal[1][l] * b->velocity[1][l] +
           b->normal[2][l] * b->velocity[2][l];
}

/* A new contact, the first of a batch: its grid, for an impact at this speed, if it approaches, and
 * for the present overlap. 0: it would last less than ten steps; nothing is done then. */
int rst_contact_begin(const struct rst_law *law, double step, const struct rst_batch *batch, double *state);

/* A contact of radius^2 `area` has outgrown its grid: a wider one, and what there is on it. */
void rst_contact_stretch(const struct rst_law *law, double area, double *state);

/* A contact of radius^2 `area` has less than a third of the area of its grid: then slip has too
 * few elements. */
static inline int rst_is_wide(double area, double width)
{
    return 3 * area < width * width;
}

/* ... and is at rest, and relaxed outside the contact: its grid may be narrowed. */
int rst_contact_may_shrink(const struct rst_law *law, double step, const struct rst_batch *batch, int lane);
void rst_contact_shrink(const struct rst_law *law, double area, double *state);

/* The kernel can advance the first n contacts of a batch. */
int rst_all_good(const restitute_contact_law *law, double step, const struct rst_batch *batch, int n);

/* Statuses, in words: the contact of a batch of one can be advanced, or begin, or change its grid;
 * a state is one of the law; a vector is a unit vector. */
int rst_check_contact(const restitute_contact_law *law, double step, const struct rst_batch *batch,
                      restitute_error *error);
int rst_check_state(const restitute_contact_law *law, const double *state, restitute_error *error);
int rst_check_unit(const double *v, const char *name, restitute_error *error);

/* Gives a force if it is finite: within their ranges all motions give a finite one. */
int rst_give_force(double normal, double x, double y, double z, restitute_contact_force *force, restitute_error *error);

/* Of an effective radius, m: far beyond any real one. */
#define RST_LEAST_RADIUS 1e-15
#define RST_LARGEST_RADIUS 1e15

/* The first number of a state is the grid width. Its lowest bits are replaced by bits of the hash
 * of the law, since a width does not need all its digits. */
enum { rst_mark_bits = (1 << 24) - 1 };

static inline uint64_t rst_bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline void rst_mark(const restitute_contact_law *law, double *width)
{
    const uint64_t bits = (rst_bits_of(*width) & ~(uint64_t)rst_mark_bits) | (law->hash & rst_mark_bits);
    memcpy(width, &bits, sizeof bits);
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
    enum { of_motion = offsetof(struct rst_batch, width) / sizeof batch->width, of_state = at_overlap + 1 };
    const double *of = (const double *)((const char *)m + offsetof(restitute_contact_motion, overlap));
    double *row = (double *)batch + lane;
    for (int i = 0; i < of_motion; i++, row += rst_lanes)
        *row = of[i];
    for (int i = 0; i < of_state; i++, row += rst_lanes)
        *row = state[i];
    batch->state[lane] = state;
}

#endif
