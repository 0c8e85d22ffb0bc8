/* SPDX-License-Identifier: BSD-3-Clause
 * How a granular gas cools, by what its spheres are made of: five gases by DSMC (gas.h), the
 * impacts from tables, beside the theory where there is one (theory.h).
 *
 *   granular_gas POLYMER [SPHERES [OUTPUT.csv]]     POLYMER: src/materials/polyisobutylene.json; default 100000
 *
 * Prints what it found and by how much it may be off; exit status 1 if something is off by more. */
#include "gas.h"
#include "theory.h"

#include <math.h>
#include <restitute/files.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_RECORDS = 1000 };

static const double RADIUS = 1e-3, DENSITY = 1000; /* m, kg/m^3, of all spheres */
static const double ROUNDING = 1e-10;              /* of energies: 1e8 impacts of 1e-16 each, random sign */

struct experiment {
    const char *name;
    restitute_material *material; /* NULL: constant ez */
    double ez, friction;
    double speed;    /* m/s: a component's rms at the start */
    double end;      /* stop where T/T0 has fallen below it */
    double late[2];  /* T ~ t^-p: range of p over the last decade of time */
    double steepest; /* value that p over a decade must reach before */
};

struct record {
    double time, translational, rotational, theory; /* theory: NaN with friction */
};

struct course {
    struct record record[MOST_RECORDS];
    int count;
    double energy_error; /* relative energy error */
    double spin;         /* median of R times the spin over that of the speed */
};

/* ---- one gas */

static double sphere_mass(void)
{
    return 4.0 / 3 * acos(-1.0) * DENSITY * RADIUS * RADIUS * RADIUS;
}

static int build_table(const struct experiment *e, restitute_table **table, restitute_error *error)
{
    restitute_scene scene;
    restitute_table_options options;
    restitute_scene_init(&scene);
    scene.material = e->material, scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM, scene.friction = e->friction;
    scene.radius1 = scene.radius2 = RADIUS;
    scene.mass1 = scene.mass2 = sphere_mass();
    restitute_table_options_init(&options);
    /* from a tenth of the last speed to ten times the first: few impacts are slower or faster */
    options.speed[0] = 0.1 * e->speed * sqrt(e->end), options.speed[1] = 10 * e->speed;
    return restitute_table_build(&scene, &options, table, error);
}

static struct record take(const struct gas *gas, const struct record *last, int theory)
{
    struct record now = {gas->time, gas_translational(gas), gas_rotational(gas), NAN};
    if (theory && gas->law.table)
        now.theory = theory_frictionless(&gas->law, last->theory, now.time - last->time);
    else if (theory)
        now.theory = theory_haff(gas->law.constant.ez, last->translational, now.time); /* last: the first one */
    return now;
}

/* Cool until e->end; a record whenever the time has grown by a tenth of a decade. It also ends if
 * the energy balance fails, since such a gas might never cool. */
static void cool(const struct experiment *e, struct gas *gas, struct course *course)
{
    const double start = gas_translational(gas), energy = 1.5 * (start + gas_rotational(gas)) * (double)gas->n;
    struct record *record = course->record;
    double next = 0.1 / (4 * sqrt(start / acos(-1.0))); /* a tenth of the mean time between impacts */
    record[0] = (struct record){0, start, gas_rotational(gas), start};
    course->count = 1;
    course->energy_error = 0;
    while (record[course->count - 1].translational > e->end * start && course->energy_error < ROUNDING &&
           course->count < MOST_RECORDS) {
        gas_step(gas);
        if (gas->time < next) continue;
        struct record *now = &record[course->count];
        *now = take(gas, &record[e->material ? course->count - 1 : 0], e->friction == 0);
        ++course->count;
        const double left = 1.5 * (now->translational + now->rotational) * (double)gas->n;
        course->energy_error = fabs(energy - left - gas->cost) / energy;
        while (next <= gas->time)
            next *= pow(10, 0.1);
    }
    course->spin = gas_median_spin(gas);
}

static int run(const struct experiment *e, size_t spheres, struct course *course, restitute_error *error)
{
    restitute_table *table = NULL;
    struct gas gas;
    int status = e->material ? build_table(e, &table, error) : 0;
    if (status < 0) return status;
    const struct gas_law law = {table, {e->ez, -1}, RADIUS, sphere_mass()};
    const double temperature = e->speed * e->speed; /* mass 1; spins that matter start in equipartition */
    if (gas_create(&gas, &law, spheres, temperature, e->friction > 0 ? temperature : 0, 2017)) {
        snprintf(error->message, sizeof error->message, "out of memory");
        status = RESTITUTE_ERROR_MEMORY;
    } else {
        cool(e, &gas, course);
        gas_destroy(&gas);
        status = 0;
    }
    restitute_table_destroy(table);
    return status;
}

/* ---- what came out */

/* p = -d ln T/d ln t between two records. */
static double exponent(const struct record *a, const struct record *b)
{
    return -log(b->translational / a->translational) / log(b->time / a->time);
}

/* The record a decade of time before record i, or the first with a time. */
static int decade_before(const struct course *course, int i)
{
    int j = i;
    while (j > 1 && course->record[j].time > 0.1 * course->record[i].time)
        --j;
    return j;
}

static int say(const char *what, double found, double least, double most, double noise)
{
    const int good = found >= least - noise && found <= most + noise;
    printf("  %-32s %7.3f   in [%.3f, %.3f], noise %.3f   %s\n", what, found, least, most, noise,
           good ? "good" : "OFF");
    return good ? 0 : 1;
}

/* The noise of ln T has a standard deviation of 0.6/sqrt(N) (measured with 40 seeds); five of it
 * are allowed. The same for p: the noise of a ratio of two, over ln 10, is smaller. Theory: with
 * Haff's law the third Sonine coefficient is left out, which is below 0.5 %. Otherwise the
 * velocities are taken as Maxwell's; the second coefficient is then below 0.1, of which 3/16 goes
 * into the rate and T with its square. */
static int judge(const struct experiment *e, const struct course *course, size_t spheres)
{
    const struct record *last = &course->record[course->count - 1];
    const double noise = 3 / sqrt((double)spheres);
    double worst = 0, steepest = 0;
    for (int i = 1; i < course->count; ++i) {
        const struct record *r = &course->record[i], *before = &course->record[decade_before(course, i)];
        if (r->theory > 0) worst = fmax(worst, fabs(log(r->translational / r->theory)));
        if (r->time > 10 * course->record[1].time) steepest = fmax(steepest, exponent(before, r));
    }
    const double late = exponent(&course->record[decade_before(course, course->count - 1)], last);
    printf("%s\n", e->name);
    int off = say("p over the last decade", late, e->late[0], e->late[1], noise);
    if (e->steepest > 0) off += say("largest p over a decade", steepest, e->steepest, INFINITY, noise);
    if (e->friction == 0) off += say("largest |ln(T/theory)|", worst, 0, e->material ? 0.04 : 0.005, noise);
    if (e->friction > 0) printf("  %-32s %7.3f\n", "median R spin/median speed", course->spin);
    if (course->energy_error < ROUNDING) return off;
    printf("  energy does not add up: %.1e\n", course->energy_error);
    return off + 1;
}

static void write_course(FILE *file, const struct experiment *e, const struct course *course)
{
    const struct record *first = course->record;
    for (int i = 2; i < course->count; ++i) {
        const struct record *r = &course->record[i];
        fprintf(file, "%s,%.6g,%.6g,%.6g,%.6g,%.5g\n", e->name, r->time * e->speed,
                r->translational / first->translational, r->rotational / first->translational,
                r->theory / first->translational, exponent(&course->record[decade_before(course, i)], r));
    }
}

static int run_all(struct experiment *experiments, int count, size_t spheres, FILE *file)
{
    static struct course course;
    restitute_error error = {0};
    int off = 0;
    for (int i = 0; i < count; ++i) {
        if (run(&experiments[i], spheres, &course, &error) < 0) {
            fprintf(stderr, "granular_gas: %s: %s\n", experiments[i].name, error.message);
            return 1;
        }
        off += judge(&experiments[i], &course, spheres);
        fflush(stdout);
        if (file) write_course(file, &experiments[i], &course);
    }
    return off;
}

int main(int argc, char **argv)
{
    restitute_material *kelvin_voigt = NULL, *solid = NULL, *polymer = NULL;
    restitute_error error = {0};
    const double spheres = argc > 2 ? atof(argv[2]) : 1e5;
    FILE *file = NULL;
    if (argc < 2 || argc > 4 || !(spheres >= 100 && spheres <= 1e8)) {
        fprintf(stderr, "usage: granular_gas POLYMER [SPHERES [OUTPUT.csv]], 100 to 1e8 spheres\n");
        return 2;
    }
    if (restitute_material_kelvin_voigt(1e7, 60, 0.5, &kelvin_voigt, &error) < 0 ||  /* G1 (Pa), eta (Pa s), nu */
        restitute_material_standard_solid(1e8, 2e8, 3e4, 0.5, &solid, &error) < 0 || /* G1, G2, eta, nu */
        restitute_material_read(argv[1], &polymer, NULL, &error) < 0) {
        fprintf(stderr, "granular_gas: %s\n", error.message);
        return 1;
    }
    if (argc > 3 && !(file = fopen(argv[3], "w"))) {
        perror(argv[3]);
        return 1;
    }
    if (file)
        fprintf(file, "# restitute %s, %.0f spheres\ngas,time,T,T_rot,T_theory,exponent\n", restitute_version(),
                spheres);
    /* Kelvin-Voigt: losses are proportional to v^(1/5), so p = 5/3; the next power of v makes p
     * larger by 0.28 times what 1 - ez is still. With friction p = 2, less what the viscous losses
     * still are. The standard solid: losses go as v^(-1/5) far above the worst speed, whence p
     * tends to 5/2 before it falls, past 2, to 5/3. The polymer: ez(v) falls, so p < 2. */
    struct experiment experiments[] = {
        {"constant ez = 0.8", NULL, 0.8, 0, 1, 1e-6, {1.99, 2}, 0},
        {"Kelvin-Voigt without friction", kelvin_voigt, 0, 0, 0.1, 1e-12, {1.667, 1.68}, 0},
        {"Kelvin-Voigt with friction 0.3", kelvin_voigt, 0, 0.3, 0.1, 1e-14, {1.96, 2}, 0},
        {"standard solid without friction", solid, 0, 0, 0.1, 1e-18, {1.667, 2}, 2.2},
        {"polyisobutylene with friction 0.3", polymer, 0, 0.3, 0.01, 1e-10, {1.667, 2}, 0},
    };
    int status = run_all(experiments, (int)(sizeof experiments / sizeof *experiments), (size_t)spheres, file) ? 1 : 0;
    if (file && fclose(file)) perror(argv[3]), status = 1;
    restitute_material_destroy(polymer);
    restitute_material_destroy(solid);
    restitute_material_destroy(kelvin_voigt);
    return status;
}
