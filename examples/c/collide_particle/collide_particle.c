/* A hollow rubber ball with topspin hits the floor: velocities and spin after the impact, as a DEM
 * code needs them. Mass and moment of inertia are those of a shell; the thick shell is assumed to
 * deform like a solid ball. */
#include <math.h>
#include <restitute/restitute.h>
#include <stdio.h>

int main(void)
{
    restitute_material *rubber = NULL;
    restitute_solver *solver = NULL;
    restitute_body ball, floor;
    restitute_collision collision;
    restitute_result result;
    restitute_error error;
    restitute_material_standard_solid(1e6, 2e6, 50.0, 0.5, &rubber, NULL); /* G1, G2 (Pa), eta (Pa s), nu */
    restitute_solver_create(NULL, &solver, NULL);
    restitute_body_init(&floor);
    floor.radius = INFINITY, floor.normal[2] = 1; /* a plane */
    restitute_body_init(&ball);
    ball.radius = 0.01, ball.mass = 3e-3;                      /* m, kg */
    ball.inertia = 0.5 * ball.mass * ball.radius * ball.radius; /* between solid, 2/5, and thin shell, 2/3 */
    ball.position[2] = 0.01;
    ball.velocity[0] = 1.0, ball.velocity[1] = 0.5, ball.velocity[2] = -2.0; /* m/s */
    ball.spin[1] = 150.0, ball.spin[2] = 20.0;                               /* rad/s; that about z stays */
    restitute_collision_init(&collision);
    collision.material = rubber, collision.friction = 0.4;
    restitute_result_init(&result);
    if (restitute_collide(solver, &collision, &ball, &floor, &result, &error) < 0) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("ez = %.3f, ex = %.3f\n", result.ez, result.ex);
    printf("velocity%8.3f%8.3f%8.3f\n", ball.velocity[0], ball.velocity[1], ball.velocity[2]);
    printf("spin    %8.2f%8.2f%8.2f\n", ball.spin[0], ball.spin[1], ball.spin[2]);
    for (int flag = 1; flag <= RESTITUTE_FLAG_UNMEASURED; flag *= 2) /* exceeded limits of the model */
        if (result.flags & flag) printf("note: %s\n", restitute_flag_text(flag));
    restitute_solver_destroy(solver);
    restitute_material_destroy(rubber);
}
