/* Every result tells how far it strains the model; one scene trips each flag.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/solve.h"

static restitute_scene steel_ball_on(const restitute_material *material, double normal_speed, double tangential_speed)
{
    restitute_scene scene;
    restitute_scene_init(&scene);
    scene.material = material;
    scene.radius1 = 0.005;
    scene.mass1 = 7800 * 4.0 / 3.0 * 3.14159265358979323846 * 1.25e-7;
    scene.friction = 0.2;
    scene.normal_speed = normal_speed;
    scene.tangential_speed = tangential_speed;
    return scene;
}

static int flags_of(restitute_scene scene)
{
    return solve_scene(default_options(), &scene).result.flags;
}

static void each_flag_has_a_scene_that_trips_it_alone(void **state)
{
    (void)state;
    restitute_material *steel, *foam, *glass, *pair;
    CHECK(restitute_material_elastic(8e10, 0.5, &steel, NULL) == 0, "incompressible: not coupled with a rigid wall");
    CHECK(restitute_material_elastic(3e10, 0.2, &glass, NULL) == 0, "glass");
    CHECK(restitute_material_elastic(1e7, 0.5, &foam, NULL) == 0, "foam");
    CHECK(restitute_material_effective(steel, glass, &pair, NULL) == 0, "pair");
    CHECK(flags_of(steel_ball_on(steel, 0.1, 0.05)) == 0, "a gentle impact strains nothing");

    restitute_scene heavy = steel_ball_on(foam, 0.5, 0);
    heavy.wave_density = 30; /* a light material: fast waves */
    CHECK(flags_of(heavy) == RESTITUTE_FLAG_LARGE_CONTACT, "%d", flags_of(heavy));
    restitute_scene fast = steel_ball_on(steel, 2, 0);
    fast.wave_density = 5e8; /* what would have a wave speed of 13 m/s */
    CHECK(flags_of(fast) == RESTITUTE_FLAG_FAST, "%d", flags_of(fast));
    restitute_scene grazing = steel_ball_on(steel, 0.1, 20);
    CHECK(flags_of(grazing) == RESTITUTE_FLAG_LONG_SLIDE, "%d", flags_of(grazing));
    restitute_scene unlike = steel_ball_on(pair, 0.1, 0.05);
    restitute_options strict = default_options();
    strict.dundurs_limit = 0.05;
    struct restitute_result r = solve_scene(strict, &unlike).result;
    CHECK(r.flags == RESTITUTE_FLAG_COUPLED && r.dundurs_beta == restitute_material_dundurs(pair), "%d", r.flags);
    restitute_material_destroy(steel);
    restitute_material_destroy(glass);
    restitute_material_destroy(foam);
    restitute_material_destroy(pair);
}

/* beta of (1 - 2 nu)/(2 - 2 nu) with a rigid partner, which is that of a very stiff one; 0 with one
 * of the same material, and without effect where nothing shears the contact. */
static void a_rigid_partner_is_coupled(void **state)
{
    (void)state;
    restitute_material *steel, *rigid, *pair, *rubber;
    CHECK(restitute_material_elastic(8e10, 0.3, &steel, NULL) == 0, "steel");
    CHECK(restitute_material_elastic(8e20, 0.3, &rigid, NULL) == 0, "rigid");
    CHECK(restitute_material_elastic(8e10, 0.45, &rubber, NULL) == 0, "rubber");
    CHECK(restitute_material_effective(steel, rigid, &pair, NULL) == 0, "pair");
    restitute_scene scene = steel_ball_on(steel, 0.1, 0.05), stiff = steel_ball_on(pair, 0.1, 0.05);
    struct restitute_result r = solve_scene(default_options(), &scene).result;
    CHECK_NEAR(r.dundurs_beta, 0.4 / 1.4, 1e-15, "beta");
    CHECK_NEAR(r.dundurs_beta, solve_scene(default_options(), &stiff).result.dundurs_beta, 1e-9, "1e-10 as soft");
    CHECK(r.flags == RESTITUTE_FLAG_COUPLED, "%d", r.flags);
    scene.friction = 0;
    CHECK(flags_of(scene) == 0, "no friction, no coupling");
    scene = steel_ball_on(steel, 0.1, 0.05);
    scene.deformable = RESTITUTE_BOTH_BODIES_DEFORM;
    r = solve_scene(default_options(), &scene).result;
    CHECK(r.flags == 0 && r.dundurs_beta == 0, "%d, %g", r.flags, r.dundurs_beta);
    scene = steel_ball_on(rubber, 0.1, 0.05);
    r = solve_scene(default_options(), &scene).result;
    CHECK(r.flags == 0 && fabs(r.dundurs_beta - 1.0 / 11) < 1e-15, "below the limit: %g", r.dundurs_beta);
    restitute_material_destroy(steel);
    restitute_material_destroy(rigid);
    restitute_material_destroy(pair);
    restitute_material_destroy(rubber);
}

static void ratios_are_what_they_say(void **state)
{
    (void)state;
    restitute_material *steel;
    CHECK(restitute_material_elastic(8e10, 0.5, &steel, NULL) == 0, "steel");
    restitute_scene scene = steel_ball_on(steel, 2, 1);
    scene.spin1 = 100;
    struct restitute_result r = solve_scene(default_options(), &scene).result;
    CHECK_NEAR(r.speed_ratio, 2 / sqrt(8e10 / 7800), 1e-12, "v/c_s");
    CHECK_NEAR(r.radius_ratio, r.max_contact_radius / 0.005, 1e-15, "a/R");
    CHECK_NEAR(r.displacement_ratio, (1 + 0.5) * r.max_indentation / 2 / r.max_contact_radius, 1e-15, "travel");
    scene.tangential_speed = -1, scene.spin1 = -100; /* the other way */
    CHECK(solve_scene(default_options(), &scene).result.displacement_ratio == r.displacement_ratio, "sign of sliding");
    restitute_options all = default_options();
    all.speed_limit = all.radius_limit = all.displacement_limit = 0;
    CHECK(solve_scene(all, &scene).result.flags == 7, "limits can be set");
    r = solve_pair(default_options(), impact_of(1, 1, 0, 1)).result;
    CHECK(isnan(r.speed_ratio) && isnan(r.radius_ratio) && isnan(r.displacement_ratio) && r.flags == 0,
          "dimensionless");
    restitute_material_destroy(steel);
}

/* Of two spheres the denser one has the slower waves, in any order; the density of a fixed partner
 * is unknown. */
static void wave_speed_is_that_of_the_denser_sphere(void **state)
{
    (void)state;
    restitute_material *steel;
    CHECK(restitute_material_elastic(8e10, 0.3, &steel, NULL) == 0, "steel");
    restitute_scene scene = steel_ball_on(steel, 2, 1);
    scene.radius2 = scene.radius1;
    for (double factor = 0.1; factor < 20; factor *= 100) { /* lighter, then denser than 7800 */
        scene.mass2 = factor * scene.mass1;
        CHECK_NEAR(solve_scene(default_options(), &scene).result.speed_ratio, 2 / sqrt(8e10 / (7800 * fmax(1, factor))),
                   1e-12, "partner %g times as dense", factor);
    }
    scene.mass2 = INFINITY;
    CHECK_NEAR(solve_scene(default_options(), &scene).result.speed_ratio, 2 / sqrt(8e10 / 7800), 1e-12, "held fast");
    restitute_material_destroy(steel);
}

/* Waves do not travel in a mere dashpot, nor in a solid that has forgotten all by the time of the
 * impact. */
static void no_modulus_no_waves(void **state)
{
    (void)state;
    restitute_material *oil, *fluid;
    CHECK(restitute_material_prony(0, 100, 0, NULL, NULL, 0.5, &oil, NULL) == 0, "oil");
    CHECK(restitute_material_maxwell(1e9, 1e-3, 0.5, &fluid, NULL) == 0, "fluid");
    restitute_scene in_oil = steel_ball_on(oil, 2, 1), in_fluid = steel_ball_on(fluid, 2, 1);
    CHECK(isinf(solve_scene(default_options(), &in_oil).result.speed_ratio), "oil");
    CHECK(isinf(solve_scene(default_options(), &in_fluid).result.speed_ratio), "fluid");
    restitute_material_destroy(oil);
    restitute_material_destroy(fluid);
}

/* Only the window that the contact time is in says nothing; of two unlike bodies both count, and
 * shifted times move it. */
static void a_contact_time_outside_of_the_window_is_named(void **state)
{
    (void)state;
    restitute_material *foam, *steel, *slow, *pair;
    restitute_error error;
    double ez, ex, ends[2];
    char expected[160];
    CHECK(restitute_material_elastic(1e7, 0.5, &foam, NULL) == 0, "foam");
    CHECK(restitute_material_elastic(8e10, 0.5, &steel, NULL) == 0, "steel");
    const restitute_scene scene = steel_ball_on(foam, 0.01, 0);
    const double time = solve_scene(default_options(), &scene).result.contact_time;
    CHECK(flags_of(scene) == 0, "no window, no flag");
    const struct {
        double low, high;
        int flag;
    } windows[] = {{time / 2, 2 * time, 0}, {0, time / 2, 16}, {2 * time, INFINITY, 16}, {0, INFINITY, 0}};
    for (int i = 0; i < 4; i++) {
        CHECK(restitute_material_set_window(foam, windows[i].low, windows[i].high, &error) == 0, "%s", error.message);
        CHECK(flags_of(scene) == windows[i].flag, "window %d: %d", i, flags_of(scene));
        CHECK(restitute_scene_pair(&scene, &ez, &ex, &error) == RESTITUTE_OK, "%s", error.message);
        snprintf(expected, sizeof expected,
                 "contact time %.3g s is outside the window %.3g to %.3g s in which the material was measured", time,
                 windows[i].low, windows[i].high);
        CHECK(strcmp(error.message, windows[i].flag ? expected : "") == 0, "\"%s\"", error.message);
    }
    CHECK(restitute_material_set_window(foam, time / 2, 2 * time, NULL) == 0, "window");
    CHECK(restitute_material_shifted(foam, 10, &slow, NULL) == 0, "shifted");
    CHECK(flags_of(steel_ball_on(slow, 0.01, 0)) == RESTITUTE_FLAG_UNMEASURED, "ten times as slow");
    CHECK(restitute_material_set_window(steel, time, 1, NULL) == 0, "window");
    CHECK(restitute_material_effective(foam, steel, &pair, NULL) == 0, "pair");
    CHECK(restitute_material_window(pair, &ends[0], &ends[1], NULL) == 0 && ends[0] == time && ends[1] == 2 * time,
          "%g %g", ends[0], ends[1]);
    CHECK(restitute_material_set_window(foam, 1, 1, &error) == RESTITUTE_ERROR_DOMAIN, "empty");
    CHECK(restitute_material_set_window(foam, NAN, 1, &error) == RESTITUTE_ERROR_DOMAIN, "NaN");
    CHECK(restitute_material_set_window(NULL, 0, 1, &error) == RESTITUTE_ERROR_NULL, "NULL");
    CHECK(restitute_material_window(NULL, NULL, NULL, &error) == RESTITUTE_ERROR_NULL, "NULL");
    CHECK(restitute_material_shifted(foam, 0, &slow, &error) == RESTITUTE_ERROR_DOMAIN, "time_shift 0");
    CHECK(restitute_material_shifted(foam, 1, NULL, &error) == RESTITUTE_ERROR_NULL, "NULL");
    restitute_material_destroy(foam);
    restitute_material_destroy(steel);
    restitute_material_destroy(slow);
    restitute_material_destroy(pair);
}

static void flags_have_texts(void **state)
{
    (void)state;
    for (int flag = 1; flag <= 16; flag *= 2)
        CHECK(strcmp(restitute_flag_text(flag), "unknown flag") != 0, "flag %d", flag);
    CHECK(strcmp(restitute_flag_text(3), "unknown flag") == 0, "two flags are no flag");
}

/* The message of a successful call names exactly the exceeded limits. */
static void limits_that_are_passed_are_named(void **state)
{
    (void)state;
    const char *names[] = {"v_z0/wave speed", "contact radius/R", "slide/contact radius", "Dundurs' beta"};
    restitute_material *soft, *hard, *other, *pair;
    restitute_error error;
    double ez, ex;
    CHECK(restitute_material_elastic(1e5, 0.5, &soft, NULL) == 0, "soft");
    CHECK(restitute_material_elastic(1e8, 0.5, &hard, NULL) == 0, "hard");
    CHECK(restitute_material_elastic(1e5, 0.3, &other, NULL) == 0, "compressible");
    CHECK(restitute_material_effective(other, hard, &pair, NULL) == 0, "pair");
    const struct {
        const restitute_material *material;
        double normal_speed, tangential_speed;
        int passed; /* bits */
    } cases[] = {
        {hard, 0.01, 0.001, 0}, {soft, 0.1, 0.01, 2}, {hard, 100, 0, 3}, {hard, 0.01, 0.3, 4}, {pair, 100, 500, 15}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const restitute_scene scene =
            steel_ball_on(cases[i].material, cases[i].normal_speed, cases[i].tangential_speed);
        CHECK(restitute_scene_pair(&scene, &ez, &ex, &error) == RESTITUTE_OK && error.status == RESTITUTE_OK, "%s",
              error.message);
        for (int k = 0; k < 4; k++)
            CHECK(!strstr(error.message, names[k]) == !(cases[i].passed & 1 << k), "%zu: %s: \"%s\"", i, names[k],
                  error.message);
        CHECK(!error.message[0] == !cases[i].passed, "%zu: \"%s\"", i, error.message);
    }
    restitute_material_destroy(soft);
    restitute_material_destroy(hard);
    restitute_material_destroy(other);
    restitute_material_destroy(pair);
}

/* The bounds of docs/soft_contacts.md, 0.18 a/R and 1.3 (a/R)^0.65, where they hold. An elastic
 * solid has e_z = 1, and without friction e_x = -1. */
static void the_cost_of_a_large_contact_is_named(void **state)
{
    (void)state;
    static const struct {
        int elastic;
        double friction, speed;
        const char *words;
    } cases[] = {{1, 0.2, 0.196, " (ex is known to about +-0.6 if it sticks)"}, /* a/R = 0.33 */
                 {0, 0.2, 0.196, " (ez is known to about +-0.05, ex to +-0.6 if it sticks)"},
                 {0, 0, 0.196, " (ez is known to about +-0.05)"},
                 {1, 0, 0.196, ""},
                 {1, 0.2, 1, " (beyond 0.5 no bound of the error is known)"},
                 {0, 0.2, 100, " (more than the sphere: are moduli in Pa, lengths in m, speeds in m/s?)"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        restitute_material *soft;
        restitute_error error;
        double ez, ex;
        char expected[200];
        const int status = cases[i].elastic ? restitute_material_elastic(8e4, 0.5, &soft, &error)
                                            : restitute_material_standard_solid(8e4, 8e4, 100, 0.5, &soft, &error);
        CHECK(status == 0, "%s", error.message);
        restitute_scene large = steel_ball_on(soft, cases[i].speed, 0.01);
        large.friction = cases[i].friction;
        large.wave_density = 1e-3; /* no limit but that of the contact */
        CHECK(restitute_scene_pair(&large, &ez, &ex, &error) == RESTITUTE_OK, "%s", error.message);
        snprintf(expected, sizeof expected, "contact radius/R = %.3g exceeds the limit 0.1%s",
                 solve_scene(default_options(), &large).result.radius_ratio, cases[i].words);
        CHECK(strcmp(error.message, expected) == 0, "\"%s\"", error.message);
        restitute_material_destroy(soft);
    }
}

/* Both remarks in one message. */
static void limits_stand_behind_other_remarks(void **state)
{
    (void)state;
    restitute_material *steel;
    restitute_solver *solver;
    restitute_error error;
    restitute_options options = to_tolerance(1e-6);
    options.max_work = 1e-3;
    options.radius_limit = 1e-3;
    CHECK(restitute_material_elastic(8e10, 0.3, &steel, NULL) == 0, "steel");
    const restitute_scene scene = steel_ball_on(steel, 0.1, 0.03);
    CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
    CHECK(restitute_solve_scene(solver, &scene, NULL, NULL, NULL, &error) == RESTITUTE_TOLERANCE_NOT_REACHED, "%s",
          error.message);
    const char *first = strstr(error.message, "tolerance = 1e-06"),
               *second = strstr(error.message, "; contact radius/R");
    CHECK(first && second && first < second, "%s", error.message);
    restitute_solver_destroy(solver);
    restitute_material_destroy(steel);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_flag_has_a_scene_that_trips_it_alone),
        cmocka_unit_test(a_rigid_partner_is_coupled),
        cmocka_unit_test(ratios_are_what_they_say),
        cmocka_unit_test(wave_speed_is_that_of_the_denser_sphere),
        cmocka_unit_test(no_modulus_no_waves),
        cmocka_unit_test(a_contact_time_outside_of_the_window_is_named),
        cmocka_unit_test(flags_have_texts),
        cmocka_unit_test(limits_that_are_passed_are_named),
        cmocka_unit_test(the_cost_of_a_large_contact_is_named),
        cmocka_unit_test(limits_stand_behind_other_remarks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
