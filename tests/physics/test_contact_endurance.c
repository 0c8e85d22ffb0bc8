/* Contacts that last, grow, end and begin again.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/drive.h"

static restitute_material *standard_solid(double tau)
{
    const double times[1] = {tau}, moduli[1] = {2};
    restitute_material *material;
    assert_int_equal(restitute_material_prony(1, 0, 1, times, moduli, 0.5, &material, NULL), 0);
    return material;
}

/* A sphere of unit radius lies under its weight on a solid of G_inf = 1 Pa: in the end F = (8/3)
 * G_inf/(1 - nu) d^(3/2). At first the load is `heavier` times as much, and falls to the weight
 * from a tenth to half of the time. */
static void rest(double eta, size_t n_terms, double heavier, double h, long steps)
{
    const double tau[1] = {1}, g[1] = {2}, mass = 1e-4, weight = 1e-7, nu = 0.5;
    restitute_material *material;
    assert_int_equal(restitute_material_prony(1, eta, n_terms, tau, g, nu, &material, NULL), 0);
    restitute_contact_law *law = law_of(material, 8, 0);
    restitute_error error;
    double v = 0, lowest = 1, highest = 0;
    const double relaxed = pow(weight / (8.0 / 3 / (1 - nu)), 2.0 / 3);
    if (h <= 0) restitute_contact_time_step_limit(law, mass, 1, 1e-3, &h, &error);
    struct drive d = drive_of(law, h, 0.3);
    d.motion.inverse_mass = 1 / mass;
    for (long i = 0; i < steps; i++) {
        const double part = fmin(1, fmax(0, ((double)i / (double)steps - 0.1) / 0.4)), load = weight * pow(heavier, 1 - part);
        const double half = v + h / (2 * mass) * (load - d.force.normal);
        d.motion.overlap += h * half;
        d.motion.velocity[2] = half;
        CHECK(restitute_contact_step(law, &d.rates, &d.motion, d.state, &d.force, &error) == 0, "%s", error.message);
        v = half + h / (2 * mass) * (load - d.force.normal);
        if (i < steps - steps / 10) continue;
        lowest = fmin(lowest, d.motion.overlap);
        highest = fmax(highest, d.motion.overlap);
    }
    CHECK_NEAR(lowest / relaxed, 1, 1e-3, "lowest overlap at the end");
    CHECK_NEAR(highest / relaxed, 1, 1e-3, "highest overlap at the end");
    CHECK_NEAR(d.force.normal / weight, 1, 1e-6, "at rest");
    restitute_contact_law_destroy(law);
    restitute_material_destroy(material);
}

/* From near the indentation of the unrelaxed solid, G = 3 Pa, to that of the relaxed one; and it
 * stays. */
static void weight_creeps_to_the_relaxed_indentation(void **unused)
{
    (void)unused;
    rest(0, 1, 1, 2e-3, 1000000);
}

/* A dashpot has no force at rest, at the longest step that is safe for an impact at 1 mm/s. */
static void weight_rests_on_a_dashpot(void **unused)
{
    (void)unused;
    rest(1, 0, 1, 0, 200000);
    rest(10, 1, 1, 0, 2000000);
}

/* A contact that was 100 times deeper, so that a single element of its grid is left in it. */
static void weight_rests_after_a_heavy_load(void **unused)
{
    (void)unused;
    rest(0, 1, 1000, 2e-3, 1000000);
}

/* Force after a steady approach to `overlap`, of a contact whose grid was made for the overlap
 * `first`. */
static struct drive press(const restitute_material *material, double first, double overlap, int elements)
{
    const double h = 1e-3;
    const int n = 2000;
    restitute_contact_law *law = law_of(material, elements, 0);
    struct drive d = drive_of(law, h, 0.3);
    restitute_error error;
    const double v = overlap / (n * h);
    /* an elastic impact at this speed with this mass would be `first` deep: that is how a law
     * chooses its grid */
    const double modulus = restitute_material_modulus(material, 0.88 * first / v);
    d.motion.inverse_mass = v * v / (32.0 / 15 / 0.5 * modulus * pow(first, 2.5));
    for (int i = 0; i < n; i++) {
        d.motion.overlap += v * h;
        d.motion.velocity[0] = 0.3 * v, d.motion.velocity[2] = v;
        CHECK(restitute_contact_step(law, &d.rates, &d.motion, d.state, &d.force, &error) == 0, "%s", error.message);
    }
    restitute_contact_law_destroy(law);
    return d;
}

/* A contact that grows 16 times deeper, 4 times wider than its grid was made for. */
static void outgrown_grids_keep_the_force(void **unused)
{
    (void)unused;
    for (int i = 0; i < 3; i++) {
        restitute_material *material = standard_solid(i == 0 ? 0.05 : i == 1 ? 1 : 20);
        const double overlap = 1e-4;
        const struct drive fit = press(material, overlap, overlap, 32);
        const struct drive grown = press(material, overlap / 16, overlap, 8);
        CHECK_NEAR(grown.force.normal / fit.force.normal, 1, 0.009, "normal force, tau %d", i);
        CHECK_NEAR(grown.force.tangential[0] / fit.force.tangential[0], 1, 0.02, "tangential force, tau %d", i);
        restitute_material_destroy(material);
    }
}

/* Pressed, lifted and pressed again at once: the surface has not come back, so that the second
 * contact begins deeper and is weaker; after a long rest it is as the first. More elements
 * agree. */
static double second_force(const restitute_material *material, double rest, int elements, double *first)
{
    restitute_contact_law *law = law_of(material, elements, 0);
    struct drive d = drive_of(law, 1e-3, 0.3);
    drive_steps(&d, 1000, 1e-4, 0, 0);
    *first = d.force.normal;
    drive_steps(&d, 100, -1.2e-4, 0, 0);
    assert_true(d.force.normal <= 0);
    drive_steps(&d, (int)(rest / 1e-3), 0, 0, 0);
    drive_steps(&d, 1200, 1.2e-4, 0, 0); /* as fast as the first time */
    restitute_contact_law_destroy(law);
    return d.force.normal;
}

static void surfaces_remember_until_they_have_relaxed(void **unused)
{
    (void)unused;
    double first, few_first;
    restitute_material *material = standard_solid(1);
    const double soon = second_force(material, 0, 32, &first), few = second_force(material, 0, 8, &few_first);
    const double late = second_force(material, 30, 32, &first); /* retarded by tau (1 + 2) = 3 s: 30 s are ten of them */
    CHECK(soon < 0.97 * first, "second force %.4g, first %.4g", soon, first);
    CHECK_NEAR(few / soon, 1, 0.009, "8 elements");
    CHECK_NEAR(late / first, 1, 0.002, "after a long rest");
    restitute_material_destroy(material);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weight_creeps_to_the_relaxed_indentation),
        cmocka_unit_test(weight_rests_on_a_dashpot),
        cmocka_unit_test(weight_rests_after_a_heavy_load),
        cmocka_unit_test(outgrown_grids_keep_the_force),
        cmocka_unit_test(surfaces_remember_until_they_have_relaxed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
