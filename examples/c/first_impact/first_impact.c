/* A steel ball on rubber: the restitution pair of one impact. */
#include <restitute/restitute.h>
#include <stdio.h>

int main(void)
{
    restitute_material *rubber = NULL;
    restitute_scene scene;
    double ez, ex;
    restitute_material_standard_solid(1e6, 3e6, 300.0, 0.5, &rubber, NULL); /* G1, G2 (Pa), eta (Pa s), nu */
    restitute_scene_init(&scene);                                           /* ball on wall; one of them is rigid */
    scene.material = rubber;
    scene.radius1 = 0.005, scene.mass1 = 0.004, scene.friction = 0.3; /* m, kg */
    scene.normal_speed = 0.03, scene.tangential_speed = 0.02;         /* m/s */
    if (restitute_scene_pair(&scene, &ez, &ex, NULL) < 0) return 1;   /* the last argument could say why */
    printf("ez = %.3f, ex = %.3f\n", ez, ex);
    restitute_material_destroy(rubber);
}
