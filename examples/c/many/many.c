/* A table of the restitution pair over speed and angle, solved by all processors at once; the
 * numbers are the same for any number of threads. A steel ball on rubber. */
#include <math.h>
#include <restitute/restitute.h>
#include <stdio.h>

enum { SPEEDS = 4, ANGLES = 8, ALL = SPEEDS * ANGLES };

int main(void)
{
    const double degree = acos(-1.0) / 180;
    restitute_material *rubber = NULL;
    restitute_scene scenes[ALL];
    restitute_result results[ALL];
    restitute_options options;
    restitute_error error;
    restitute_material_standard_solid(1e6, 3e6, 300.0, 0.5, &rubber, NULL); /* G1, G2 (Pa), eta (Pa s), nu */
    for (int i = 0; i < ALL; i++) {
        const double speed = 0.004 * pow(2, i / ANGLES), angle = 10.0 * (i % ANGLES + 1); /* m/s, from the normal */
        restitute_result_init(&results[i]);
        restitute_scene_init(&scenes[i]);
        scenes[i].material = rubber;
        scenes[i].radius1 = 0.005, scenes[i].mass1 = 0.004, scenes[i].friction = 0.3; /* m, kg */
        scenes[i].normal_speed = speed * cos(angle * degree);
        scenes[i].tangential_speed = speed * sin(angle * degree);
    }
    restitute_options_init(&options);
    options.threads = 0; /* all processors */
    const int status = restitute_solve_scene_many(ALL, scenes, &options, results, NULL, &error);
    restitute_material_destroy(rubber);
    if (status < 0) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("ex by angle   10     20     30     40     50     60     70     80\n");
    for (int i = 0; i < ALL; i++) {
        if (i % ANGLES == 0) printf("%5.3f m/s", 0.004 * pow(2, i / ANGLES));
        printf("%7.3f", results[i].ex);
        if (i % ANGLES == ANGLES - 1) printf("\n");
    }
}
