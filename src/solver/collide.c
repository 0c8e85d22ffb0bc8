/* One impact of two bodies in space, solved.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/two_bodies.h"

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

static int check_contact(const restitute_contact *c, const restitute_body *a, const restitute_body *b,
                         restitute_error *error)
{
    int status = rst_check_size(c->struct_size, sizeof *c, "restitute_contact", error);
    if (!status) status = rst_check_range(c->touch_gap, 0, 1, "touch_gap", error);
    return status ? status : check_bodies(a, b, error);
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

/* `a` can move. */
static int collide(restitute_solver *solver, const restitute_contact *contact, restitute_body *a, restitute_body *b,
                   restitute_result *result, restitute_error *error)
{
    struct frame f = frame_of(a, b);
    int status = check_approach(&f, contact->touch_gap, error);
    if (status) return status;
    restitute_scene scene = scene_of(contact, a, b, &f);
    status = restitute_solve_scene(solver, &scene, result, NULL, NULL, error);
    if (status >= 0) part_with(result->ez, result->ex, &f, a, b);
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
