/* Every allocation of the component contact fails in turn: ERROR_MEMORY, no law, no leak, and then
 * the same law, bit by bit. A step, and all else that is done with a law, allocates nothing.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/failing_allocator.h"

#include "../support/contact.h"

static restitute_material *solid;
static restitute_contact_law_options options;
static restitute_error error;

/* What a law says and does; no allocation. */
static int use_law(const restitute_contact_law *law, struct given *given)
{
    enum { n = 40, room = 512 };
    double state[n][room] = {{0}}, *states[n], equilibrium, viscosity, tau[8], g[8], bound;
    size_t terms;
    PREPARED(contact_rates, rates);
    PREPARED(contact_details, details);
    restitute_contact_motion motion[n];
    restitute_contact_force force[n];
    const double x[] = {1, 0, 0}, z[] = {0, 0, 1};
    CHECK(restitute_contact_law_state_size(law) <= room, "state size");
    for (int i = 0; i < n; i++) {
        restitute_contact_motion_init(&motion[i]);
        motion[i].overlap = 1e-6 * (i + 1);
        motion[i].velocity[2] = 1e-3;
        motion[i].radius = 0.01;
        motion[i].friction = 0.3;
        states[i] = state[i];
    }
    int status = restitute_contact_law_series(law, &equilibrium, &viscosity, &terms, tau, g, &bound, &error);
    status |= restitute_contact_rates_set(law, 1e-5, &rates, &error);
    for (int k = 0; k < 3; k++)
        status |= restitute_contact_step_many(law, &rates, n, motion, states, force, NULL, &error);
    status |= restitute_contact_step(law, &rates, motion, state[0], force, &error);
    status |= restitute_contact_turn(law, z, x, state[0], &error);
    status |= restitute_contact_peek(law, x, state[0], force, &error);
    status |= restitute_contact_details_get(law, 0.01, state[0], &details, &error);
    give(given, (double)restitute_contact_law_hash(law));
    give(given, bound);
    for (int i = 0; i < n; i++)
        give(given, force[i].normal);
    return status;
}

static void use_and_destroy(restitute_contact_law *law, struct given *given)
{
    int used;
    const long count = allocator.count;
    ARMED(used, use_law(law, given));
    CHECK(used == RESTITUTE_OK && allocator.count == count, "%s; %ld allocations", error.message, allocator.count);
    restitute_contact_law_destroy(law);
}

MAKES(contact_law, law_create, restitute_contact_law_create(solid, &options, &made, &error),
      use_and_destroy(made, given))

static void laws(void **state)
{
    double tau[12], g[12];
    (void)state;
    for (int k = 0; k < 12; k++)
        tau[k] = pow(10, k - 8), g[k] = 1e6;
    restitute_contact_law_options_init(&options);
    options.details = options.slip_cycles = 1;
    options.shortest = 1e-6;
    options.longest = 1;
    for (size_t terms = 3; terms <= 12; terms += 9) {
        solid = solid_of(1e6, 0, terms, tau, g);
        FAIL_EACH({terms == 3 ? "all terms" : "terms are reduced", .call = law_create});
        restitute_material_destroy(solid);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(laws)};
    return IF_CAN_FAIL(cmocka_run_group_tests(tests, NULL, NULL));
}
