/* The normal motion of an impact at the levels of a walk over elements (src/sync/walk.h), by fine
 * steps of Runge and Kutta's method: independent of the library, and good to 1e-9 if no relaxation
 * time is below 0.05.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_WALK_MOTION_H
#define TEST_WALK_MOTION_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sync/kernels.h"

enum { most_terms = 2, most_nodes = 256, most_states = 3 + 2 * most_terms, fine_steps = 16 };

static const double half_pi = 1.57079632679489661923;

struct solid {
    const char *name;
    double g_inf, eta;
    int n;
    double g[most_terms], tau[most_terms];
};

/* memory: n_terms values a level. */
struct motion {
    int n;
    double a_max;
    struct walk_level level[2 * most_nodes + 1];
    double memory[(2 * most_nodes + 1) * most_terms];
};

/* Where the compression was: time and M_k when the edge was at an angle of the fine grid. */
struct trace {
    double time, memory[most_terms];
};

/* State y: s, D, D', P_k = int y_k dX, M_k. Force at the edge radius a. */
static inline double normal_force(const struct solid *s, double a, const double *y)
{
    double force = s->g_inf * (y[1] * a - a * a * a / 3) + s->eta * a * y[2];
    for (int k = 0; k < s->n; k++)
        force += y[3 + k];
    return force;
}

/* dy/ds for an edge at a with the stresses `edge`, which moves with a_rate. */
static inline void time_rates(const struct solid *s, double a, double a_rate, const double *edge, const double *y,
                              double *rate)
{
    rate[0] = 1;
    rate[1] = y[2];
    rate[2] = -15.0 / 8 * normal_force(s, a, y);
    for (int k = 0; k < s->n; k++) {
        rate[3 + k] = a * s->g[k] * y[2] - y[3 + k] / s->tau[k] + edge[k] * a_rate;
        rate[3 + s->n + k] = s->g[k] * y[2] - y[3 + s->n + k] / s->tau[k];
    }
}

/* dy/dsigma, s = sigma^2: the motion is smooth in it at first touch. */
static inline void compression_rates(const struct solid *s, double sigma, const double *y, double *rate)
{
    const double none[most_terms] = {0};
    time_rates(s, sqrt(fmax(y[1], 0)), 0, none, y, rate);
    for (int i = 0; i < most_states; i++)
        rate[i] *= 2 * sigma;
}

static inline void compress(const struct solid *s, double sigma, double h, const double *y, double *to)
{
    double r[4][most_states] = {{0}}, z[most_states];
    compression_rates(s, sigma, y, r[0]);
    for (int p = 1; p < 4; p++) {
        double c = p == 3 ? 1 : 0.5;
        for (int i = 0; i < most_states; i++)
            z[i] = y[i] + c * h * r[p - 1][i];
        compression_rates(s, sigma + c * h, z, r[p]);
    }
    for (int i = 0; i < most_states; i++)
        to[i] = y[i] + h / 6 * (r[0][i] + 2 * r[1][i] + 2 * r[2][i] + r[3][i]);
}

/* dy/dphi of the restitution, a = a_max cos(phi): the condition f(a) = 0 says how the edge moves.
 * At the turning point ds/dphi is `turn`. */
static inline void restitution_rates(const struct solid *s, double a_max, double phi, const struct trace *entry,
                                     const double *y, double turn, double *rate)
{
    double a = a_max * cos(phi), a_rate = -a_max * sin(phi), edge[most_terms] = {0};
    double above = y[2] * s->g_inf - 15.0 / 8 * s->eta * normal_force(s, a, y), below = s->g_inf;
    for (int k = 0; k < s->n; k++) {
        double e = exp(-(y[0] - entry->time) / s->tau[k]);
        edge[k] = y[3 + s->n + k] - e * entry->memory[k];
        above += y[2] * s->g[k] - edge[k] / s->tau[k];
        below += s->g[k] * e;
    }
    double ds = phi > 0 ? 2 * a * a_rate * below / above : turn;
    time_rates(s, a, a_rate / ds, edge, y, rate);
    for (int k = 0; k < s->n && !(ds > 0); k++)
        rate[3 + k] = 0; /* a_rate and edge are 0 there */
    for (int i = 0; i < most_states; i++)
        rate[i] *= ds;
}

/* sigma and y at the largest indentation */
static inline double find_turn(const struct solid *s, double *y)
{
    double h = 5e-4, sigma = 0, z[most_states], low = 0, high = h;
    memset(y, 0, most_states * sizeof *y);
    y[2] = 1;
    for (compress(s, sigma, h, y, z); z[2] > 0; compress(s, sigma, h, y, z)) {
        memcpy(y, z, sizeof z);
        sigma += h;
    }
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2;
        compress(s, sigma, middle, y, z);
        *(z[2] > 0 ? &low : &high) = middle;
    }
    compress(s, sigma, low, y, z);
    memcpy(y, z, sizeof z);
    y[2] = 0;
    return sigma + low;
}

/* The step in sigma to the depth `target`, by Newton's method within [0, high]; y goes there. */
static inline double compress_to(const struct solid *s, double target, double sigma, double high, double *y)
{
    double z[most_states], low = 0, h = (sqrt(target) - sqrt(y[1])) / sqrt(y[2]);
    for (int i = 0; i < 80; i++) {
        compress(s, sigma, h, y, z);
        *(z[1] < target ? &low : &high) = h;
        double next = h - (z[1] - target) / (2 * (sigma + h) * z[2]);
        if (!(next > low && next < high))
            next = (low + high) / 2;
        if (fabs(next - h) < 1e-15)
            break;
        h = next;
    }
    memcpy(y, z, sizeof z);
    return h;
}

static inline void note_level(const struct solid *s, struct motion *m, int l, double a, double step, const double *y)
{
    double force = l == 2 * m->n ? 0 : normal_force(s, a, y);
    m->level[l] = (struct walk_level){step, a, y[1], y[2], force};
    memcpy(m->memory + l * s->n, y + 3 + s->n, (size_t)s->n * sizeof *y);
}

/* The angles from pi/2 at first touch to 0: node n1 is at phi1, and nodes are even on both sides of
 * it. */
static inline double angle_of(int i, int n, int n1, double phi1)
{
    double j = (double)i / fine_steps;
    return j <= n1 ? half_pi + (phi1 - half_pi) * j / n1 : phi1 * (n - j) / (n - n1);
}

static inline void make_motion(const struct solid *s, int n, int n1, double phi1, struct motion *m)
{
    double turn[most_states], y[most_states] = {0, 0, 1}, w[most_states];
    double sigma = 0, end = find_turn(s, turn), before = 0;
    struct trace *trace = calloc((size_t)(n * fine_steps + 1), sizeof *trace);
    m->n = n;
    m->a_max = sqrt(turn[1]);
    note_level(s, m, 0, 0, 0, y);
    for (int i = 1; i <= n * fine_steps; i++) {
        double a = m->a_max * cos(angle_of(i, n, n1, phi1));
        if (i < n * fine_steps)
            sigma += compress_to(s, a * a, sigma, end - sigma, y);
        else
            memcpy(y, turn, sizeof y);
        y[0] = i < n * fine_steps ? sigma * sigma : end * end;
        trace[i].time = y[0];
        memcpy(trace[i].memory, y + 3 + s->n, (size_t)s->n * sizeof *y);
        if (i % fine_steps == 0) {
            note_level(s, m, i / fine_steps, a, y[0] - before, y);
            before = y[0];
        }
    }
    double first = s->eta > 0 ? 0 : m->a_max * sqrt(2 / (15.0 / 8 * normal_force(s, m->a_max, y)));
    for (int i = n * fine_steps; i > 0; i -= 2) {
        double r[4][most_states] = {{0}}, phi[3];
        for (int p = 0; p < 3; p++)
            phi[p] = angle_of(i - p, n, n1, phi1);
        double h = phi[2] - phi[0];
        restitution_rates(s, m->a_max, phi[0], trace + i, y, first, r[0]);
        for (int p = 1; p < 4; p++) {
            int to = p == 3 ? 2 : 1;
            for (int q = 0; q < most_states; q++)
                w[q] = y[q] + to * h / 2 * r[p - 1][q];
            restitution_rates(s, m->a_max, phi[to], trace + i - to, w, first, r[p]);
        }
        for (int q = 0; q < most_states; q++)
            y[q] += h / 6 * (r[0][q] + 2 * r[1][q] + 2 * r[2][q] + r[3][q]);
        if ((i - 2) % fine_steps == 0) {
            int l = 2 * n - (i - 2) / fine_steps;
            note_level(s, m, l, l == 2 * n ? 0 : m->a_max * cos(phi[2]), y[0] - before, y);
            before = y[0];
        }
    }
    free(trace);
}

/* The angle at which the sphere has the velocity `target`: the inverse polynomial through four
 * levels of one phase. */
static inline double angle_at(const struct solid *s, double target, int *restitution)
{
    static struct motion m;
    int n = most_nodes, l = 0;
    double phi = 0;
    make_motion(s, n, n / 2, half_pi / 2, &m);
    while (m.level[l + 1].velocity > target)
        l++;
    *restitution = l >= n;
    int lowest = *restitution ? n : 0, first = l - 1;
    first = first < lowest ? lowest : first > lowest + n - 3 ? lowest + n - 3 : first;
    for (int i = first; i < first + 4; i++) {
        double part = acos(fmin(m.level[i].radius / m.a_max, 1));
        for (int j = first; j < first + 4; j++)
            if (j != i)
                part *= (target - m.level[j].velocity) / (m.level[i].velocity - m.level[j].velocity);
        phi += part;
    }
    return phi;
}

#endif
