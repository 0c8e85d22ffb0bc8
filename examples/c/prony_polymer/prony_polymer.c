/* A steel ball on a polymer whose Prony series is in a file: restitution by speed. The argument is
 * the file, as src/materials/polyisobutylene.csv or .json. */
#include <restitute/files.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    const double speeds[] = {1e-4, 1e-3, 0.01, 0.05}; /* m/s */
    restitute_material *polymer = NULL;
    restitute_scene scene;
    restitute_error error;
    double ez, ex;
    if (argc != 2 || restitute_material_read(argv[1], &polymer, NULL, &error) < 0) {
        fprintf(stderr, "%s\n", argc == 2 ? error.message : "usage: prony_polymer FILE");
        return 1;
    }
    restitute_scene_init(&scene);
    scene.material = polymer;
    scene.radius1 = 0.005, scene.mass1 = 0.00408, scene.friction = 0.3; /* m, kg */
    printf("%zu terms\n", restitute_material_terms(polymer));
    for (int k = 0; k < 4; ++k) {
        scene.normal_speed = speeds[k];
        scene.tangential_speed = 0.5 * speeds[k];
        if (restitute_scene_pair(&scene, &ez, &ex, &error) < 0) {
            fprintf(stderr, "%s\n", error.message);
            return 1;
        }
        printf("%6.4f m/s: ez = %6.3f, ex = %6.3f\n", speeds[k], ez, ex);
    }
    restitute_material_destroy(polymer);
}
