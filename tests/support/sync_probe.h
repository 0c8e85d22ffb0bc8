/* Procedures of the method `sync` that have no C interface, by unit/sync_probe.f90.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_SYNC_PROBE_H
#define TEST_SYNC_PROBE_H

#include <math.h>
#include <stdint.h>

enum { stages = 6, points = stages + 1 };

void probe_collocation(double x[points], double a[stages][stages]);
void probe_weights(double x, double weight[points]);
void probe_polynomial(const double y[points], int64_t i, double *last, double *start, double slope[stages],
                      double *root);
int64_t probe_solve(double a[stages][stages], const double b[stages], double x[stages]);
int64_t probe_respond(double rate, const double span[stages], double kernel[stages][stages], double decay[stages]);
int64_t probe_normal(double eta, int64_t n, const double *g, const double *rate, double depth, int64_t halvings,
                     double roughness, int64_t counts[2]);
void probe_motion(int64_t p, double x, double motion[6]);
int64_t probe_contact(double chi, double psi, double roughness, double *velocity, int64_t *n_pieces);
void probe_piece(int64_t i, double y, int64_t *panel, double range[2], int64_t *rooted, double motion[3]);
void probe_front(int64_t n, const double *g, const double *rate, double eta, double shear, double loaded, double time,
                 const double *m, double slip, int sense, double out[4]);

/* Of probe_motion. */
enum { ANGLE, RADIUS, TIME, DEPTH, VELOCITY, FORCE };

/* Polynomials may miss that much: no panel is halved for them. */
static const double rough = 1e30;

/* G1 = 1, and delta1, gamma of the paper as arms. */
struct solid {
    double eta, g[2], rate[2];
    int64_t n;
};

static inline struct solid solid_of(double delta1, double gamma)
{
    const double theta = sqrt(32.0 / 15) * delta1;
    if (theta > 0 && gamma > 0) return (struct solid){0, {1, 1 / gamma}, {0, 1 / (gamma * theta)}, 2};
    return (struct solid){theta, {1}, {0}, 1};
}

static inline int64_t normal(struct solid s, double depth, int halvings, int64_t counts[2])
{
    return probe_normal(s.eta, s.n, s.g, s.rate, depth, halvings, rough, counts);
}

#endif
