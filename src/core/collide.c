/* Two bodies in space: from positions, velocities and spins to the plane of the impact and back (THEORY 9).
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>

#include "status.h"

typedef struct {
    double x[3];
} vector;

static const double largest_overlap = 0.1; /* of the radii: more is no first touch of two spheres */

void restitute_body_init(restitute_body *body)
{
    if (body) *body = (restitute_body){.struct_size = sizeof *body};
}

void restitute_contact_init(restitute_contact *contact)
{
    if (contact)
        *contact = (restitute_contact){
            .struct_size = sizeof *contact, .deformable = RESTITUTE_BOTH_BODIES_DEFORM, .touch_gap = 1e-6};
}

static vector from(const double x[3])
{
    return (vector){{x[0], x[1], x[2]}};
}

static vector combine(double a, vector x, double b, vector y)
{
    return (vector){{a * x.x[0] + b * y.x[0], a * x.x[1] + b * y.x[1], a * x.x[2] + b * y.x[2]}};
}

static double dot(vector a, vector b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static vector cross(vector a, vector b)
{
    return (vector){
        {a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

static double length(vector a)
{
    return hypot(hypot(a.x[0], a.x[1]), a.x[2]);
}

static int is_plane(const restitute_body *body)
{
    return isinf(body->radius);
}

static int check_vector(const double x[3], struct rst_range range, const char *body, const char *name,
                        restitute_error *error)
{
    char place[32];
    int status = RESTITUTE_OK;
    for (int i = 0; i < 3 && !status; i++) {
        snprintf(place, sizeof place, "%s.%s[%d]", body, name, i);
        status = rst_check_within(x[i], range, NAN, place, error);
    }
    return status;
}

static int check_body(const restitute_body *b, const char *name, restitute_error *error)
{
    char place[32];
    int status = rst_check_size(b->struct_size, sizeof *b, "restitute_body", error);
    if (!status) status = check_vector(b->position, rst_positions, name, "position", error);
    if (!status) status = check_vector(b->velocity, rst_speeds, name, "velocity", error);
    snprintf(place, sizeof place, "%s.radius (m)", name);
    if (!status) status = rst_check_within(b->radius, rst_sizes, INFINITY, place, error);
    if (status) return status;
    if (is_plane(b)) {
        status = check_vector(b->normal, rst_positions, name, "normal", error);
        snprintf(place, sizeof place, "length of %s.normal", name);
        return status ? status : rst_check_within(length(from(b->normal)), rst_lengths, NAN, place, error);
    }
    status = check_vector(b->spin, rst_spins, name, "spin", error);
    snprintf(place, sizeof place, "%s.mass (kg)", name);
    if (!status) status = rst_check_within(b->mass, rst_sizes, INFINITY, place, error);
    snprintf(place, sizeof place, "%s.inertia (kg m^2)", name);
    if (!status) status = rst_check_within(b->inertia, rst_inertias, 0, place, error);
    return status;
}

static int check_contact(const restitute_contact *c, const restitute_body *a, const restitute_body *b,
                         restitute_error *error)
{
    int status = rst_check_size(c->struct_size, sizeof *c, "restitute_contact", error);
    if (!status) status = rst_check_range(c->touch_gap, 0, 1, "touch_gap", error);
    if (!status) status = check_body(a, "first", error);
    if (!status) status = check_body(b, "second", error);
    if (status) return status;
    if (is_plane(a) || isinf(a->mass))
        if (is_plane(b) || isinf(b->mass))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                              "first and second cannot move: one must have a finite mass");
    return RESTITUTE_OK;
}

/* Frame of the impact: n from `a` into `b`, t along the sliding of a's surface on b's. `a` can move. */
struct frame {
    vector n, t;
    double gap, reach;     /* m: distance of the surfaces, and what it is compared with */
    double approach;       /* m/s: normal speed at which they close */
    double sliding;        /* m/s: of the contact point, along t, >= 0 */
    double translation;    /* its part from the centres, along t; the spins have the rest */
    double spin_a, spin_b; /* rad/s: along n x t, with the sign of restitute_scene */
};

static vector direction(vector a, vector fallback)
{
    double size = length(a);
    return size > 0 ? (vector){{a.x[0] / size, a.x[1] / size, a.x[2] / size}} : fallback;
}

/* Any unit vector across n. */
static vector across(vector n)
{
    vector axis = {{0, 0, 0}};
    const int smaller = fabs(n.x[0]) < fabs(n.x[1]) ? 0 : 1; /* below 0.71 */
    axis.x[smaller] = 1;
    vector c = cross(n, axis);
    return combine(1 / length(c), c, 0, c);
}

static struct frame frame_of(const restitute_body *a, const restitute_body *b)
{
    struct frame f;
    vector apart = combine(1, from(b->position), -1, from(a->position));
    if (is_plane(b)) {
        f.n = direction(combine(-1, from(b->normal), 0, apart), apart);
        f.gap = dot(apart, f.n) - a->radius;
        f.reach = a->radius;
    } else {
        f.n = direction(apart, (vector){{1, 0, 0}});
        f.gap = length(apart) - a->radius - b->radius;
        f.reach = a->radius + b->radius;
    }
    vector velocity = combine(1, from(a->velocity), -1, from(b->velocity));
    vector rolling = combine(a->radius, from(a->spin), 0, from(a->spin));
    if (!is_plane(b)) rolling = combine(1, rolling, b->radius, from(b->spin));
    vector point = combine(1, velocity, 1, cross(rolling, f.n));
    f.approach = dot(velocity, f.n);
    vector tangential = combine(1, point, -dot(point, f.n), f.n);
    f.t = direction(tangential, across(f.n));
    f.sliding = dot(point, f.t);
    f.translation = dot(velocity, f.t);
    vector axis = cross(f.n, f.t); /* (w x n).t = w.(n x t) */
    f.spin_a = dot(from(a->spin), axis);
    f.spin_b = is_plane(b) ? 0 : dot(from(b->spin), axis);
    return f;
}

static int check_approach(const struct frame *f, double touch_gap, restitute_error *error)
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

static restitute_scene scene_of(const restitute_contact *c, const restitute_body *a, const restitute_body *b,
                                const struct frame *f)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = c->material;
    scene.deformable = c->deformable;
    scene.friction = c->friction;
    scene.density = c->density;
    scene.radius1 = a->radius;
    scene.mass1 = a->mass;
    scene.inertia1 = a->inertia;
    scene.radius2 = b->radius;
    scene.normal_speed = f->approach;
    scene.tangential_speed = f->translation;
    scene.spin1 = f->spin_a;
    if (is_plane(b)) return scene;
    scene.mass2 = b->mass;
    scene.inertia2 = b->inertia;
    scene.spin2 = f->spin_b;
    return scene;
}

static double inertia_of(const restitute_body *body)
{
    return body->inertia > 0 ? body->inertia : 0.4 * body->mass * body->radius * body->radius;
}

/* Mobility of the contact point along t. */
static double mobility_of(const restitute_body *body)
{
    if (is_plane(body) || isinf(body->mass)) return 0;
    return 1 / body->mass + body->radius * body->radius / inertia_of(body);
}

/* An impulse at the contact point, which lies at side * radius * n from the centre. */
static void strike(restitute_body *body, double side, const struct frame *f, vector impulse)
{
    if (is_plane(body) || isinf(body->mass)) return;
    vector velocity = combine(1, from(body->velocity), 1 / body->mass, impulse);
    vector spin = combine(1, from(body->spin), side * body->radius / inertia_of(body), cross(f->n, impulse));
    for (int i = 0; i < 3; i++) {
        body->velocity[i] = velocity.x[i];
        body->spin[i] = spin.x[i];
    }
}

/* `a` can move. */
static int collide(restitute_solver *solver, const restitute_contact *contact, restitute_body *a, restitute_body *b,
                   restitute_result *result, restitute_error *error)
{
    struct frame f = frame_of(a, b);
    int status = check_approach(&f, contact->touch_gap, error);
    if (status) return status;
    restitute_scene scene = scene_of(contact, a, b, &f);
    status = restitute_solve_scene(solver, &scene, result, NULL, NULL, error);
    if (status < 0) return status;
    double inverse_mass = 1 / a->mass + (is_plane(b) ? 0 : 1 / b->mass);
    double normal = (1 + result->ez) * f.approach / inverse_mass;
    double tangential = (1 + result->ex) * f.sliding / (mobility_of(a) + mobility_of(b));
    vector impulse = combine(-normal, f.n, -tangential, f.t);
    strike(a, 1, &f, impulse);
    strike(b, -1, &f, combine(-1, impulse, 0, impulse));
    return status;
}

int restitute_collide(restitute_solver *solver, const restitute_contact *contact, restitute_body *first,
                      restitute_body *second, restitute_result *result, restitute_error *error)
{
    restitute_result own;
    if (!solver || !contact || !first || !second)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !solver    ? "solver"
                          : !contact ? "contact"
                          : !first   ? "first"
                                     : "second");
    int status = check_contact(contact, first, second, error);
    if (!status && result) status = rst_check_size(result->struct_size, sizeof *result, "restitute_result", error);
    if (status) return status;
    restitute_result_init(&own);
    int first_moves = !is_plane(first) && !isinf(first->mass);
    status = first_moves ? collide(solver, contact, first, second, &own, error)
                         : collide(solver, contact, second, first, &own, error);
    if (status >= 0 && result) *result = own;
    return status;
}
