/* Two bodies in space: from positions, velocities and spins to the plane of the impact and back
 * (theory.md, 10).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/two_bodies.h"

#include <stdio.h>

#include "base/sized.h"
#include "base/status.h"

static const double largest_overlap = 0.1; /* of the radii: more is no first touch of two spheres */

static rst_vector from(const double x[3])
{
    return (rst_vector){{x[0], x[1], x[2]}};
}

static rst_vector combine(double a, rst_vector x, double b, rst_vector y)
{
    return (rst_vector){{a * x.x[0] + b * y.x[0], a * x.x[1] + b * y.x[1], a * x.x[2] + b * y.x[2]}};
}

static double dot(rst_vector a, rst_vector b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static rst_vector cross(rst_vector a, rst_vector b)
{
    return (rst_vector){
        {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

static double length(rst_vector a)
{
    return hypot(hypot(a.x[0], a.x[1]), a.x[2]);
}

/* A member of a body; its name is made only for a message. */
static int check_member(double value, struct rst_range range, double besides, const char *body, const char *name,
                        restitute_error *error)
{
    char place[48];
    if (rst_is_within(value, range, besides)) return RESTITUTE_OK;
    snprintf(place, sizeof place, name[0] == ' ' ? "length of %s.%s" : "%s.%s", body, name + (name[0] == ' '));
    return rst_check_within(value, range, besides, place, error);
}

static int check_vector(const double x[3], struct rst_range range, const char *body, const char *name,
                        restitute_error *error)
{
    char component[24];
    for (int i = 0; i < 3; i++) {
        if (rst_is_within(x[i], range, NAN)) continue;
        snprintf(component, sizeof component, "%s[%d]", name, i);
        return check_member(x[i], range, NAN, body, component, error);
    }
    return RESTITUTE_OK;
}

static int check_body(const restitute_body *b, const char *name, restitute_error *error)
{
    int status = RST_CHECK(body, b, error);
    if (!status) status = check_vector(b->position, rst_positions, name, "position", error);
    if (!status) status = check_vector(b->velocity, rst_speeds, name, "velocity", error);
    if (!status) status = check_member(b->radius, rst_sizes, INFINITY, name, "radius (m)", error);
    if (status) return status;
    if (rst_is_plane(b)) {
        status = check_vector(b->normal, rst_positions, name, "normal", error);
        return status ? status : check_member(length(from(b->normal)), rst_lengths, NAN, name, " normal", error);
    }
    status = check_vector(b->spin, rst_spins, name, "spin", error);
    if (!status) status = check_member(b->mass, rst_sizes, INFINITY, name, "mass (kg)", error);
    if (!status) status = check_member(b->inertia, rst_inertias, 0, name, "inertia (kg m^2)", error);
    return status;
}

int rst_check_bodies(const restitute_body *a, const restitute_body *b, restitute_error *error)
{
    int status = check_body(a, "first", error);
    if (!status) status = check_body(b, "second", error);
    if (status) return status;
    if (rst_is_plane(a) || isinf(a->mass))
        if (rst_is_plane(b) || isinf(b->mass))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                              "first and second cannot move: one must have a finite mass");
    return RESTITUTE_OK;
}

static rst_vector direction(rst_vector a, rst_vector fallback)
{
    double size = length(a);
    return size > 0 ? (rst_vector){{a.x[0] / size, a.x[1] / size, a.x[2] / size}} : fallback;
}

/* Any unit vector across n. */
static rst_vector across(rst_vector n)
{
    rst_vector axis = {{0, 0, 0}};
    const int smaller = fabs(n.x[0]) < fabs(n.x[1]) ? 0 : 1; /* below 0.71 */
    axis.x[smaller] = 1;
    rst_vector c = cross(n, axis);
    return combine(1 / length(c), c, 0, c);
}

struct rst_frame rst_frame_of(const restitute_body *a, const restitute_body *b)
{
    struct rst_frame f;
    rst_vector apart = combine(1, from(b->position), -1, from(a->position));
    if (rst_is_plane(b)) {
        f.n = direction(combine(-1, from(b->normal), 0, apart), apart);
        f.gap = dot(apart, f.n) - a->radius;
        f.reach = a->radius;
    } else {
        f.n = direction(apart, (rst_vector){{1, 0, 0}});
        f.gap = length(apart) - a->radius - b->radius;
        f.reach = a->radius + b->radius;
    }
    rst_vector velocity = combine(1, from(a->velocity), -1, from(b->velocity));
    rst_vector rolling = combine(a->radius, from(a->spin), 0, from(a->spin));
    if (!rst_is_plane(b)) rolling = combine(1, rolling, b->radius, from(b->spin));
    rst_vector point = combine(1, velocity, 1, cross(rolling, f.n));
    f.approach = dot(velocity, f.n);
    rst_vector tangential = combine(1, point, -dot(point, f.n), f.n);
    f.t = direction(tangential, across(f.n));
    f.sliding = dot(point, f.t);
    f.translation = dot(velocity, f.t);
    rst_vector axis = cross(f.n, f.t); /* (w x n).t = w.(n x t) */
    f.spin_a = dot(from(a->spin), axis);
    f.spin_b = rst_is_plane(b) ? 0 : dot(from(b->spin), axis);
    return f;
}

int rst_check_approach(const struct rst_frame *f, double touch_gap, restitute_error *error)
{
    if (f->gap > touch_gap * f->reach)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "gap = %g m: the bodies do not touch, must be <= %g m", f->gap,
                          touch_gap * f->reach);
    if (f->gap < -largest_overlap * f->reach)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "overlap = %g m: must be <= %g m, a tenth of the radii",
                          -f->gap, largest_overlap * f->reach);
    if (!(f->approach > 0))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "approach speed = %g m/s: must be > 0, the bodies are not closing", f->approach);
    return RESTITUTE_OK;
}

static double inertia_of(const restitute_body *body)
{
    return body->inertia > 0 ? body->inertia : 0.4 * body->mass * body->radius * body->radius;
}

double rst_mobility_of(const restitute_body *body)
{
    if (rst_is_plane(body) || isinf(body->mass)) return 0;
    return 1 / body->mass + body->radius * body->radius / inertia_of(body);
}

/* An impulse at the contact point, which lies at side * radius * n from the centre. */
static void strike(restitute_body *body, double side, const struct rst_frame *f, rst_vector impulse)
{
    if (rst_is_plane(body) || isinf(body->mass)) return;
    rst_vector velocity = combine(1, from(body->velocity), 1 / body->mass, impulse);
    rst_vector spin = combine(1, from(body->spin), side * body->radius / inertia_of(body), cross(f->n, impulse));
    for (int i = 0; i < 3; i++) {
        body->velocity[i] = velocity.x[i];
        body->spin[i] = spin.x[i];
    }
}

void rst_part_with(double ez, double ex, const struct rst_frame *f, restitute_body *a, restitute_body *b)
{
    double inverse_mass = 1 / a->mass + (rst_is_plane(b) ? 0 : 1 / b->mass);
    double normal = (1 + ez) * f->approach / inverse_mass;
    double tangential = (1 + ex) * f->sliding / (rst_mobility_of(a) + rst_mobility_of(b));
    rst_vector impulse = combine(-normal, f->n, -tangential, f->t);
    strike(a, 1, f, impulse);
    strike(b, -1, f, combine(-1, impulse, 0, impulse));
}
