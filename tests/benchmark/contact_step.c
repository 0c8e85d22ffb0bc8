/* Time of a contact step, singly and in batches, beside a bare Hertz-Mindlin step, as CSV:
 *
 *     contact_step [CONTACTS]     in memory: default 64 (hot); 1000000: from memory
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/contact.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"

/* What a DEM code does in a step of Hertz and Mindlin: dashpots of constant restitution, one
 * tangential spring with history, turned into the tangential plane, limited by friction. */
static void hertz_mindlin(double modulus, double damping, double step, const restitute_contact_motion *m, double *shear,
                          restitute_contact_force *force)
{
    const double a = sqrt(m->radius * m->overlap), kn = 4.0 / 3 * modulus * a, kt = 8.0 / 3 * modulus * a;
    const double *n = m->normal;
    const double *v = m->velocity, out = shear[0] * n[0] + shear[1] * n[1] + shear[2] * n[2];
    const double approach = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];
    force->normal = kn * m->overlap + damping * sqrt(kn) * approach;
    double f[3], size = 0, before = 0, after = 0;
    for (int i = 0; i < 3; i++)
        before += shear[i] * shear[i];
    for (int i = 0; i < 3; i++)
        shear[i] -= out * n[i], after += shear[i] * shear[i];
    const double scale = after > 0 ? sqrt(before / after) : 0;
    for (int i = 0; i < 3; i++) {
        const double slide = v[i] - approach * n[i];
        shear[i] = shear[i] * scale + step * slide;
        f[i] = -kt * shear[i] - damping * sqrt(kt) * slide;
        size += f[i] * f[i];
    }
    size = sqrt(size);
    const double limit = m->friction * fabs(force->normal), part = size > limit ? limit / size : 1;
    for (int i = 0; i < 3; i++) {
        force->tangential[i] = f[i] * part;
        if (part < 1) shear[i] = -force->tangential[i] / kt;
    }
}

enum { steps = 100 };
static const double h = 3e-6;

/* Impacts at different stages: overlaps follow half a sine, and the bodies slide. */
static void move(size_t n, int step, restitute_contact_motion *motion)
{
    for (size_t i = 0; i < n; i++) {
        const double stage = fmod((double)i * 0.6180339887 + step / (double)steps, 1),
                     x = 3.14159265 * (0.02 + 0.96 * stage);
        motion[i].overlap = 1e-4 * sin(x);
        motion[i].velocity[0] = 2e-6 / h * cos(3 * x);
        motion[i].velocity[1] = 1e-6 / h;
        motion[i].velocity[2] = cos(x);
    }
}

/* Nanoseconds a step: with law == NULL of Hertz-Mindlin. */
static double time_of(const restitute_contact_law *law, int many, size_t n, restitute_contact_motion *motion,
                      double *states, double **state, restitute_contact_force *force)
{
    const size_t size = law ? restitute_contact_law_state_size(law) : 3;
    restitute_contact_rates rates;
    double best[steps], sum = 0; /* of each step: what else the machine does meets few of them */
    long done = 0;
    restitute_contact_rates_init(&rates);
    if (law) restitute_contact_rates_set(law, h, &rates, NULL);
    memset(states, 0, n * size * sizeof *states);
    for (size_t i = 0; i < n; i++)
        state[i] = states + i * size;
    for (int repeat = 0; repeat < 25; repeat++)
        for (int step = 0; step < steps; step++) {
            move(n, step, motion);
            const double start = bench_clock();
            if (many)
                restitute_contact_step_many(law, &rates, n, motion, state, force, NULL, NULL);
            else
                for (size_t i = 0; i < n; i++) {
                    if (law)
                        done += restitute_contact_step(law, &rates, &motion[i], state[i], &force[i], NULL);
                    else
                        hertz_mindlin(1, 0.1, h, &motion[i], state[i], &force[i]);
                }
            const double spent = bench_clock() - start;
            if (repeat == 0 || spent < best[step]) best[step] = spent;
        }
    if (done) fprintf(stderr, "a step was refused\n");
    for (int step = 0; step < steps; step++)
        sum += best[step];
    return 1e9 * sum / ((double)n * steps);
}

int main(int count, char **words)
{
    const size_t n = count > 1 ? (size_t)atof(words[1]) : 64;
    const double tau[] = {1e-4, 1e-5, 1e-3}, g[] = {1, 1, 1};
    restitute_material *material[4];
    const char *name[] = {"elastic", "standard solid", "Kelvin-Voigt", "three terms"};
    restitute_contact_motion *motion = calloc(n, sizeof *motion);
    restitute_contact_force *force = calloc(n, sizeof *force);
    double *states = calloc(n * 96, sizeof *states), **state = calloc(n, sizeof *state);
    restitute_material_elastic(1, 0.5, &material[0], NULL);
    restitute_material_prony(1, 0, 1, tau, g, 0.5, &material[1], NULL);
    restitute_material_kelvin_voigt(1, 1e-5, 0.5, &material[2], NULL);
    restitute_material_prony(1, 0, 3, tau, g, 0.5, &material[3], NULL);
    if (!motion || !force || !states || !state) return 1;
    for (size_t i = 0; i < n; i++) {
        restitute_contact_motion_init(&motion[i]);
        motion[i].radius = 1, motion[i].friction = 0.3;
        motion[i].inverse_mass = 2 / 1.2e-9, motion[i].inverse_tangential_mass = 7 / 1.2e-9;
    }
    const double bare = time_of(NULL, 0, n, motion, states, state, force);
    printf("law,contacts,doubles,hertz_mindlin_ns,single_ns,batch_ns\n");
    for (int i = 0; i < 4; i++) {
        restitute_contact_law *law;
        if (restitute_contact_law_create(material[i], NULL, &law, NULL)) return 1;
        const double one = time_of(law, 0, n, motion, states, state, force);
        const double many = time_of(law, 1, n, motion, states, state, force);
        printf("%s,%zu,%zu,%.4g,%.4g,%.4g\n", name[i], n, restitute_contact_law_state_size(law), bare, one, many);
        restitute_contact_law_destroy(law);
    }
}
