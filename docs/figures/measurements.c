/* Curves and tables of docs/records/measurements.md: what the library says to the impacts of
 * tests/data/kharaz_oblique.csv and fem_oblique.csv.
 *
 *     measurements kharaz|fem               the curve, x,y a line, for draw.py
 *     measurements kharaz|fem DATA.csv      the points of the data as rows of a table: x, data, computed, difference
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <restitute/restitute.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* One set: sphere and wall, E in Pa, and how its abscissa and its ordinate are formed. */
struct set {
    const char *name;
    double young_sphere, nu_sphere, young_wall, nu_wall;
    double radius, density, friction, speed;
    int by_angle;    /* abscissa: angle in degrees with `speed` in all; else V_t/(mu V_n) with V_n = speed */
    double from, to; /* the curve, in `samples` points */
};

enum { samples = 240 };

static const struct set sets[] = {
    {"kharaz", 380e9, 0.23, 70e9, 0.25, 2.5e-3, 4000, 0.092, 3.9, 1, 0.5, 89.5},
    {"fem", 210e9, 0.3, 210e15, 0.3, 0.01, 7850, 0.3, 5, 0, 0.01, 19},
};

/* Sphere and wall as one elastic solid; NULL if out of memory. */
static restitute_material *pair_of(const struct set *set)
{
    restitute_material *sphere = NULL, *wall = NULL, *pair = NULL;
    restitute_material_elastic(set->young_sphere / (2 + 2 * set->nu_sphere), set->nu_sphere, &sphere, NULL);
    restitute_material_elastic(set->young_wall / (2 + 2 * set->nu_wall), set->nu_wall, &wall, NULL);
    restitute_material_effective(sphere, wall, &pair, NULL);
    restitute_material_destroy(sphere);
    restitute_material_destroy(wall);
    return pair;
}

static restitute_scene scene_of(const struct set *set, const restitute_material *pair)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = pair;
    scene.radius1 = set->radius;
    scene.mass1 = set->density * 4 / 3 * pi * pow(set->radius, 3);
    scene.friction = set->friction;
    return scene;
}

/* The ordinate at x: by angle the e_t of the centre, else R w'/(mu V_n). NaN if the impact could
 * not be solved. */
static double ordinate(restitute_solver *solver, const struct set *set, restitute_scene scene, double x)
{
    restitute_result result;
    restitute_result_init(&result);
    scene.normal_speed = set->by_angle ? set->speed * cos(x * pi / 180) : set->speed;
    scene.tangential_speed = set->by_angle ? set->speed * sin(x * pi / 180) : x * set->friction * set->speed;
    if (restitute_solve_scene(solver, &scene, &result, NULL, NULL, NULL) < 0) return NAN;
    return set->by_angle ? 1 - (1 + result.ex) * 2 / 7 : -5.0 / 7 * (1 + result.ex) * x;
}

static void print_curve(restitute_solver *solver, const struct set *set, const restitute_scene *scene)
{
    for (int i = 0; i < samples; i++) {
        double x = set->from + (set->to - set->from) * i / (samples - 1);
        printf("%.6g,%.6g\n", x, ordinate(solver, set, *scene, x));
    }
}

static int print_table(restitute_solver *solver, const struct set *set, const restitute_scene *scene, const char *path)
{
    FILE *file = fopen(path, "r");
    char line[512];
    double x, y;
    if (!file) {
        fprintf(stderr, "measurements: cannot read %s\n", path);
        return 1;
    }
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, "%lf,%lf", &x, &y) != 2) continue; /* comment or header */
        double found = ordinate(solver, set, *scene, x);
        printf("| %.2f | %.3f | %.3f | ", x, y, found);
        if (fabs(y) > 0)
            printf("%+.1f %% |\n", 100 * (found / y - 1));
        else
            printf("|\n");
    }
    fclose(file);
    return 0;
}

int main(int argc, char **argv)
{
    const struct set *set = NULL;
    for (size_t i = 0; argc > 1 && i < sizeof sets / sizeof *sets; i++)
        if (strcmp(argv[1], sets[i].name) == 0) set = &sets[i];
    if (!set || argc > 3) {
        fprintf(stderr, "usage: measurements kharaz|fem [DATA.csv]\n");
        return 2;
    }
    restitute_options options;
    restitute_solver *solver = NULL;
    restitute_options_init(&options);
    options.tolerance = 1e-4;
    restitute_material *pair = pair_of(set);
    if (!pair || restitute_solver_create(&options, &solver, NULL) < 0) return 1;
    restitute_scene scene = scene_of(set, pair);
    int failed = 0;
    if (argc == 3)
        failed = print_table(solver, set, &scene, argv[2]);
    else
        print_curve(solver, set, &scene);
    restitute_solver_destroy(solver);
    restitute_material_destroy(pair);
    return failed;
}
