/* A DEM in a hundred lines: rubber spheres drop into a box, with the contact law of restitute.
 * Writes soft_sphere.csv: the energies over time.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/contact.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { spheres = 45, walls = 5, doubles = 55 }; /* doubles: of a standard solid, with details */
static const double radius = 0.005, density = 1100, friction = 0.4, gravity = 9.81, width = 0.04, duration = 0.25;
static const double wall[walls][4] = {{0, 0, 1, 0}, {1, 0, 0, 0}, {-1, 0, 0, -1}, {0, 1, 0, 0}, {0, -1, 0, -1}};

struct sphere {
    double x[3], v[3], w[3], force[3], torque[3]; /* place, velocity, spin */
};
static struct sphere sphere[spheres];
static double state[spheres][spheres + walls][doubles]; /* of every possible contact; all zeros: none */
static restitute_contact_details open, closed;          /* of present contacts, of ended ones */

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void add_cross(double factor, const double a[3], const double b[3], double sum[3])
{
    for (int k = 0; k < 3; k++)
        sum[k] += factor * (a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
}

/* The overlap of sphere i with sphere or wall j, and the unit normal into j. */
static double overlap_of(int i, int j, double n[3])
{
    if (j >= spheres) {
        const double *w = wall[j - spheres]; /* points inwards; the last number: its place, in widths of the box */
        for (int k = 0; k < 3; k++)
            n[k] = -w[k];
        return radius - (dot(w, sphere[i].x) - w[3] * width);
    }
    for (int k = 0; k < 3; k++)
        n[k] = sphere[j].x[k] - sphere[i].x[k];
    const double distance = sqrt(dot(n, n));
    for (int k = 0; k < 3; k++)
        n[k] /= distance;
    return 2 * radius - distance;
}

/* One step of one contact. Velocities are those of the middle of the step, as in velocity
 * Verlet. */
static int touch(const restitute_contact_law *law, const restitute_contact_rates *rates, double mass, int i, int j)
{
    struct sphere at_rest = {0}, *one = &sphere[i], *two = j < spheres ? &sphere[j] : &at_rest;
    const double bodies = j < spheres ? 2 : 1; /* 1/m = 1/m1 + 1/m2, 1/R = 1/R1 + 1/R2; a wall has none */
    double *memory = state[i][j], w[3];
    restitute_contact_motion m;
    restitute_contact_force f;
    restitute_contact_details e;
    restitute_error error;
    restitute_contact_motion_init(&m);
    restitute_contact_details_init(&e);
    m.overlap = overlap_of(i, j, m.normal);
    if (m.overlap <= 0 && memory[0] == 0) return 0;
    for (int k = 0; k < 3; k++)
        m.velocity[k] = one->v[k] - two->v[k], w[k] = one->w[k] + two->w[k];
    add_cross(radius, w, m.normal, m.velocity); /* of the surfaces */
    m.spin = dot(w, m.normal) / 2;
    m.inverse_mass = bodies / mass;
    m.inverse_tangential_mass = 3.5 * m.inverse_mass; /* 1 + m R^2/J of a solid sphere */
    m.radius = radius / bodies, m.friction = friction;
    if (restitute_contact_step(law, rates, &m, memory, &f, &error) < 0 ||
        restitute_contact_details_get(law, m.radius, memory, &e, &error) < 0)
        return printf("%d and %d: %s\n", i, j, error.message);
    for (int k = 0; k < 3; k++) {
        one->force[k] += f.tangential[k] - f.normal * m.normal[k];
        two->force[k] -= f.tangential[k] - f.normal * m.normal[k];
    }
    add_cross(radius, m.normal, f.tangential, one->torque);
    add_cross(radius, m.normal, f.tangential, two->torque);
    restitute_contact_details *account = m.overlap > 0 ? &open : &closed;
    account->stored += e.stored, account->friction += e.friction, account->viscous += e.viscous;
    if (m.overlap <= 0) memset(memory, 0, sizeof state[i][j]);
    return 0;
}

/* Half a step of the velocities. */
static void kick(struct sphere *s, double h, double mass, double inertia)
{
    for (int k = 0; k < 3; k++)
        s->v[k] += h / 2 * (s->force[k] / mass - (k == 2 ? gravity : 0)), s->w[k] += h / 2 * s->torque[k] / inertia;
}

int main(void)
{
    const double mass = 4.18879 * radius * radius * radius * density, inertia = 0.4 * mass * radius * radius;
    restitute_material *rubber;
    restitute_contact_law *law;
    restitute_contact_law_options options;
    restitute_contact_rates rates;
    double h, start = 0, off = 0, kinetic = 0;
    restitute_contact_law_options_init(&options);
    restitute_contact_rates_init(&rates);
    options.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    options.details = 1;
    if (restitute_material_standard_solid(2e7, 4e7, 5e3, 0.5, &rubber, NULL) < 0 ||
        restitute_contact_law_create(rubber, &options, &law, NULL) < 0 || restitute_contact_law_state_size(law) != doubles ||
        restitute_contact_time_step_limit(law, mass / 2, radius / 2, 2, &h, NULL) < 0 || /* for up to 2 m/s */
        restitute_contact_rates_set(law, h, &rates, NULL) < 0)
        return 1;
    for (int i = 0; i < spheres; i++) { /* layers of nine, a little out of line */
        sphere[i].x[0] = 0.007 + 0.0115 * (i % 3) + 0.0005 * (i * 7 % 5);
        sphere[i].x[1] = 0.007 + 0.0115 * (i / 3 % 3) + 0.0005 * (i * 3 % 5);
        sphere[i].x[2] = 0.01 + 0.0125 * (i / 9);
    }
    FILE *file = fopen("soft_sphere.csv", "w");
    if (!file) return 1;
    fputs("time_s,kinetic_J,potential_J,stored_J,friction_J,viscous_J\n", file);
    for (long step = 0; step * h <= duration; step++) {
        double potential = 0;
        kinetic = 0;
        open = (restitute_contact_details){0};
        for (int i = 0; i < spheres; i++) {
            kick(&sphere[i], h, mass, inertia);
            memset(sphere[i].force, 0, sizeof sphere[i].force), memset(sphere[i].torque, 0, sizeof sphere[i].torque);
            for (int k = 0; k < 3; k++)
                sphere[i].x[k] += h * sphere[i].v[k];
        }
        for (int i = 0; i < spheres; i++)
            for (int j = i + 1; j < spheres + walls; j++)
                if (touch(law, &rates, mass, i, j)) return 1;
        for (int i = 0; i < spheres; i++) {
            kick(&sphere[i], h, mass, inertia);
            kinetic += mass / 2 * dot(sphere[i].v, sphere[i].v) + inertia / 2 * dot(sphere[i].w, sphere[i].w);
            potential += mass * gravity * sphere[i].x[2];
        }
        const double kept = open.stored + closed.stored, rubbed = open.friction + closed.friction;
        const double damped = open.viscous + closed.viscous, sum = kinetic + potential + kept + rubbed + damped;
        if (step == 0) start = sum;
        off = fmax(off, fabs(sum - start));
        if (step % 100 == 0)
            fprintf(file, "%.6f,%.6g,%.6g,%.6g,%.6g,%.6g\n", step * h, kinetic, potential, kept, rubbed, damped);
    }
    printf("step %.3g s; energy %.3g J, off by at most %.2g of it; %.2g of it still moves\n", h, start, off / start,
           kinetic / start);
    restitute_contact_law_destroy(law);
    restitute_material_destroy(rubber);
    return fclose(file) != 0 || off > 0.01 * start || kinetic > 0.01 * start;
}
