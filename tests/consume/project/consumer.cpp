// A user's program in C++: the header as it is, handles owned by std::unique_ptr.
// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <memory>

#include <restitute/restitute.h>

struct release {
    void operator()(restitute_material *material) const { restitute_material_destroy(material); }
    void operator()(restitute_solver *solver) const { restitute_solver_destroy(solver); }
    void operator()(restitute_plan *plan) const { restitute_plan_destroy(plan); }
};

// A ball that meets the floor leaves it.
static bool ball_leaves(restitute_solver *solver, const restitute_material *rubber)
{
    restitute_body ball, floor;
    restitute_collision collision;
    restitute_body_init(&ball);
    restitute_body_init(&floor);
    restitute_collision_init(&collision);
    floor.radius = std::numeric_limits<double>::infinity();
    floor.normal[2] = 1;
    ball.radius = 0.01;
    ball.mass = 4e-3;
    ball.position[2] = 0.01;
    ball.velocity[2] = -2;
    collision.material = rubber;
    collision.friction = 0.3;
    return restitute_collide(solver, &collision, &ball, &floor, nullptr, nullptr) == RESTITUTE_OK &&
           ball.velocity[2] > 0;
}

// A ball that slides faster over a rough floor reverses less of its sliding; one plan for both.
static bool sliding_counts(const restitute_material *rubber)
{
    restitute_scene scene;
    restitute_result slow, fast;
    restitute_plan *made = nullptr;
    restitute_scene_init(&scene);
    restitute_result_init(&slow);
    restitute_result_init(&fast);
    scene.material = rubber;
    scene.radius1 = 0.01;
    scene.mass1 = 4e-3;
    scene.friction = 0.3;
    scene.normal_speed = 1;
    if (restitute_plan_create_scene(&scene, nullptr, &made, nullptr) != RESTITUTE_OK) return false;
    const std::unique_ptr<restitute_plan, release> plan(made);
    return restitute_plan_solve(plan.get(), 2, &slow, nullptr, nullptr, nullptr) == RESTITUTE_OK &&
           restitute_plan_solve(plan.get(), 4, &fast, nullptr, nullptr, nullptr) == RESTITUTE_OK && fast.ex < slow.ex;
}

int main()
{
    restitute_material *material = nullptr;
    restitute_solver *solver = nullptr;
    if (restitute_material_standard_solid(1e6, 2e6, 50.0, 0.5, &material, nullptr) != RESTITUTE_OK ||
        restitute_solver_create(nullptr, &solver, nullptr) != RESTITUTE_OK)
        return 1;
    const std::unique_ptr<restitute_material, release> rubber(material);
    const std::unique_ptr<restitute_solver, release> owner(solver);
    return ball_leaves(owner.get(), rubber.get()) && sliding_counts(rubber.get()) ? 0 : 1;
}
