/* The kernels of the contact law, for one contact and for several, for plain and for wide vectors,
 * give the same bits.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "contact/law.h"

#include "../support/drive.h"
#include "../support/random.h"

static rst_kernel *wide_one, *wide_lanes;

/* Copies of the states after a step of all lanes. */
static void run_lanes(rst_kernel *kernel, struct drive *drives, const double *states, size_t size, double *after)
{
    struct rst_batch batch;
    memcpy(after, states, rst_lanes * size * sizeof *after);
    for (int l = 0; l < rst_lanes; l++)
        rst_put(&drives[l].motion, after + (size_t)l * size, l, &batch);
    kernel(&drives[0].law->kernel, (const struct rst_rates *)drives[0].rates.values, drives[0].rates.step, &batch);
}

static void run_one(rst_kernel *kernel, struct drive *drives, const double *states, size_t size, double *after)
{
    struct rst_batch batch;
    memcpy(after, states, rst_lanes * size * sizeof *after);
    for (int l = 0; l < rst_lanes; l++) {
        rst_put(&drives[l].motion, after + (size_t)l * size, 0, &batch);
        kernel(&drives[0].law->kernel, (const struct rst_rates *)drives[0].rates.values, drives[0].rates.step, &batch);
    }
}

static void compare(restitute_contact_law *law, uint64_t *seed, const char *name)
{
    const size_t size = restitute_contact_law_state_size(law);
    static double states[rst_lanes * most_state], plain[rst_lanes * most_state], other[rst_lanes * most_state];
    struct drive drives[rst_lanes];
    for (int l = 0; l < rst_lanes; l++) {
        drives[l] = drive_of(law, 1e-3, 0.4);
        drive_by(&drives[l], 1.01e-4, 0, 0); /* the deepest */
        drives[l].motion.inverse_mass = random_log(seed, 1, 1e6);
        drives[l].motion.inverse_tangential_mass = 3.5 * drives[l].motion.inverse_mass;
    }
    for (int step = 0; step < 60; step++) {
        for (int l = 0; l < rst_lanes; l++) {
            struct drive *d = &drives[l];
            memcpy(states + (size_t)l * size, d->state, size * sizeof *states);
            const double to = 1e-4 * random_in(seed, -0.1, 1), far = random_below(seed, 4) ? 1e-5 : 1e-9;
            drive_by(d, to - d->motion.overlap, random_in(seed, -far, far), random_in(seed, -far, far));
        }
        run_lanes(rst_step_lanes, drives, states, size, plain);
        for (int l = 0; l < rst_lanes; l++)
            CHECK(!memcmp(plain + (size_t)l * size, drives[l].state, size * sizeof *plain),
                  "%s, step %d: lane %d beside %s", name, step, l, "the library");
        run_one(rst_step_one, drives, states, size, other);
        CHECK(!memcmp(plain, other, rst_lanes * size * sizeof *plain), "%s, step %d: one contact", name, step);
        run_one(wide_one, drives, states, size, other);
        CHECK(!memcmp(plain, other, rst_lanes * size * sizeof *plain), "%s, step %d: one, wide", name, step);
        run_lanes(wide_lanes, drives, states, size, other);
        CHECK(!memcmp(plain, other, rst_lanes * size * sizeof *plain), "%s, step %d: lanes, wide", name, step);
    }
    restitute_contact_law_destroy(law);
}

static void all_kernels_give_the_same_bits(void **unused)
{
    (void)unused;
    static const struct {
        const char *name;
        double g_inf, eta;
        size_t terms;
    } solids[] = {{"elastic", 1, 0, 0},     {"Kelvin-Voigt", 1, 0.01, 0}, {"standard", 1, 0, 1},
                  {"three terms", 1, 0, 3}, {"fluid", 0, 0, 2},           {"dashpot and terms", 1, 0.01, 2}};
    const double tau[] = {1e-2, 1e-4, 1}, g[] = {2, 0.5, 1};
    uint64_t seed = 5;
    rst_choose_kernels(&wide_one, &wide_lanes);
    print_message("the processor has %s\n", wide_one == rst_step_one ? "plain vectors only" : "AVX2");
    for (size_t i = 0; i < sizeof solids / sizeof *solids; i++)
        for (int with = 0; with <= (DETAILS | SLIP_CYCLES); with++) {
            restitute_material *material;
            assert_int_equal(
                restitute_material_prony(solids[i].g_inf, solids[i].eta, solids[i].terms, tau, g, 0.3, &material, NULL),
                0);
            compare(law_of(material, with == DETAILS ? 16 : 8, with), &seed, solids[i].name);
            restitute_material_destroy(material);
        }
}

/* Near the change from series to closed forms, which long numbers know to 1e-13. The first terms
 * left out are z^4/120 of the gain and z^3/30 of the bend. */
static void arms_follow_their_integrals(void **unused)
{
    (void)unused;
    for (double z = 0.002; z < 0.05; z *= 1.2) {
        const struct rst_arm arm = rst_arm_of(3 * z, 3);
        const long double lost = -expm1l(-(long double)z) / z;
        CHECK_NEAR(arm.decay, exp(-z), 1e-16, "z = %g", z);
        CHECK_NEAR(arm.gain, (double)lost, 1e-10, "z = %g", z);
        CHECK_NEAR(arm.bend / (double)(3 * (1 + expl(-(long double)z) - 2 * lost)), 1, 4e-8, "z = %g", z);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_kernels_give_the_same_bits),
                                       cmocka_unit_test(arms_follow_their_integrals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
