/* One impact of two bodies in space, solved.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/sized.h"
#include "base/status.h"
#include "base/two_bodies.h"

RST_DEFAULTS(body, 0)
RST_DEFAULTS(collision, .deformable = RESTITUTE_ONE_BODY_DEFORMS, .touch_gap = 1e-6)

static restitute_scene scene_of(const restitute_collision *c, const restitute_body *a, const restitute_body *b,
                                const struct rst_frame *f)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = c->material;
    scene.deformable = c->deformable;
    scene.friction = c->friction;
    scene.wave_density = c->wave_density;
    scene.radius1 = a->radius;
    scene.mass1 = a->mass;
    scene.inertia1 = a->inertia;
    scene.radius2 = b->radius;
    scene.normal_speed = f->approach;
    scene.tangential_speed = f->translation;
    scene.spin1 = f->spin_a;
    if (rst_is_plane(b)) return scene;
    scene.mass2 = b->mass;
    scene.inertia2 = b->inertia;
    scene.spin2 = f->spin_b;
    return scene;
}

/* `a` can move. */
static int collide(restitute_solver *solver, const restitute_collision *collision, restitute_body *a, restitute_body *b,
                   restitute_result *result, restitute_error *error)
{
    struct rst_frame f = rst_frame_of(a, b);
    int status = rst_check_approach(&f, collision->touch_gap, error);
    if (status) return status;
    restitute_scene scene = scene_of(collision, a, b, &f);
    status = restitute_solve_scene(solver, &scene, result, NULL, NULL, error);
    if (status >= 0) rst_part_with(result->ez, result->ex, &f, a, b);
    return status;
}

/* Bodies are read and written in place: all that is used was there in the first release. */
int restitute_collide(restitute_solver *solver, const restitute_collision *collision, restitute_body *first,
                      restitute_body *second, restitute_result *result, restitute_error *error)
{
    restitute_collision c;
    restitute_result own;
    if (!solver || !collision || !first || !second)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !solver      ? "solver"
                          : !collision ? "collision"
                          : !first     ? "first"
                                       : "second");
    int status = RST_TAKE(collision, &c, collision, error);
    if (status) return status;
    if (!c.material) return rst_report(error, RESTITUTE_ERROR_NULL, "collision.material is NULL");
    status = rst_check_range(c.touch_gap, 0, 1, "touch_gap", error);
    if (!status) status = rst_check_bodies(first, second, error);
    if (!status && result) status = RST_CHECK(result, result, error);
    if (status) return status;
    restitute_result_init(&own);
    int first_moves = !rst_is_plane(first) && !isinf(first->mass);
    status =
        first_moves ? collide(solver, &c, first, second, &own, error) : collide(solver, &c, second, first, &own, error);
    if (status >= 0 && result) RST_GIVE(&own, result);
    return status;
}
