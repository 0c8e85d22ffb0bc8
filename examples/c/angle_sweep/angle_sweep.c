/* A steel ball on rubber from steep to grazing: ex changes sign where sliding dominates. One solver
 * serves all impacts. */
#include <math.h>
#include <restitute/restitute.h>
#include <stdio.h>

int main(void)
{
    const double degree = acos(-1.0) / 180, speed = 0.03; /* m/s */
    restitute_material *rubber = NULL;
    restitute_solver *solver = NULL;
    restitute_scene scene;
    restitute_result result;
    restitute_error error;
    restitute_material_standard_solid(1e6, 3e6, 300.0, 0.5, &rubber, NULL); /* G1, G2 (Pa), eta (Pa s), nu */
    restitute_solver_create(NULL, &solver, NULL);
    restitute_result_init(&result);
    restitute_scene_init(&scene);
    scene.material = rubber;
    scene.radius1 = 0.005, scene.mass1 = 0.004, scene.friction = 0.3; /* m, kg */
    printf(" angle     ez     ex    contact\n");
    for (int angle = 10; angle <= 80; angle += 10) { /* from the normal */
        scene.normal_speed = speed * cos(angle * degree);
        scene.tangential_speed = speed * sin(angle * degree);
        if (restitute_solve_scene(solver, &scene, &result, NULL, NULL, &error) < 0) {
            fprintf(stderr, "%s\n", error.message);
            return 1;
        }
        printf("%6d%7.3f%7.3f%8.2f ms\n", angle, result.ez, result.ex, result.contact_time * 1e3);
    }
    restitute_solver_destroy(solver);
    restitute_material_destroy(rubber);
}
