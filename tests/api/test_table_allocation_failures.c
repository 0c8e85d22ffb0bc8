/* Every allocation of every call of the component table fails in turn: ERROR_MEMORY, outputs untouched, and the same
 * objects give the right result afterwards, bit by bit, and leave nothing behind. Lookups take no memory at all.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _GNU_SOURCE

#include "../support/cells.h"
#include "../support/failing_allocator.h"
#include "../support/table.h"

static restitute_material *material;
static restitute_scene scene;
static restitute_table *table; /* of the scene */
static restitute_table_family family;
static restitute_table_options options;
static restitute_table_builder *builder;
static restitute_error error;

static char place;
#define UNTOUCHED ((void *)&place)

/* Sums of what a table holds, with weights that tell its places apart, and what it says of itself. */
static void give_table(const restitute_table *of, struct given *given)
{
    restitute_table_data d;
    restitute_table_data_init(&d);
    restitute_table_to_data(of, &d, NULL);
    const int64_t n_ez = d.cells ? 17 * d.rebound_cells : d.nodes[0] * d.nodes[1];
    const int64_t n_ex = d.cells ? d.nodes[0] * d.nodes[1] : d.nodes[0] * d.nodes[1] * d.nodes[2] * d.nodes[3];
    double sum = 0;
    for (int64_t i = 0; i < n_ez; i++)
        sum += d.ez[i] * (double)(i % 89 + 1);
    for (int64_t i = 0; i < n_ex; i++)
        sum += (d.cells ? (double)d.ex_cells[i] : d.ex[i]) * (double)(i % 97 + 1);
    give(given, sum);
    give(given, (double)n_ez);
    give(given, (double)n_ex);
    give(given, d.error_ez);
    give(given, d.error_ex);
    give(given, (double)d.impacts);
    give(given, (double)d.checks);
}

static int give_new_table(int status, restitute_table *made, struct given *given)
{
    CHECK(status >= 0 || made == UNTOUCHED, "table touched");
    if (status < 0) return status;
    give_table(made, given);
    restitute_table_destroy(made);
    return status;
}

/* ----------------------------------------------------------------------------------------------------------- builds */

static int build(struct given *given)
{
    int status;
    restitute_table *made = UNTOUCHED;
    ARMED(status, restitute_table_build(&family, &options, &made, &error));
    return give_new_table(status, made, given);
}

static int create(struct given *given)
{
    int status;
    restitute_table_builder *made = UNTOUCHED;
    ARMED(status, restitute_table_builder_create(&family, &options, &made, &error));
    CHECK(status >= 0 || made == UNTOUCHED, "builder touched");
    if (status < 0) return status;
    give(given, (double)restitute_table_builder_expected(made));
    restitute_table_builder_destroy(made);
    return status;
}

static void destroy_builder(void)
{
    restitute_table_builder_destroy(builder);
    builder = NULL;
}

/* The builder of a call that failed goes on. Its journal tells what it did, which must not depend on that. */
static int run(struct given *given)
{
    int status = RESTITUTE_OK;
    restitute_table *made = UNTOUCHED;
    size_t count;
    if (!builder)
        CHECK(restitute_table_builder_create(&family, &options, &builder, &error) == RESTITUTE_OK, "%s", error.message);
    while (status >= 0 && made == UNTOUCHED)
        ARMED(status, restitute_table_builder_run(builder, 400, &made, &error));
    if (status >= 0) {
        const double *journal = restitute_table_builder_journal(builder, &count);
        double sum = 0;
        for (size_t i = 0; i < 4 * count; i++)
            sum += journal[i] * (double)(i % 89 + 1);
        give(given, sum);
        give(given, (double)count);
        destroy_builder();
    }
    return give_new_table(status, made, given);
}

static int restore(struct given *given)
{
    static const double journal[8] = {0.5, 0.25, 1e-3, 1e-3, 0.75, -0.5, 1e-3, 1e-3};
    int status;
    size_t count;
    if (!builder)
        CHECK(restitute_table_builder_create(&family, &options, &builder, &error) == RESTITUTE_OK, "%s", error.message);
    ARMED(status, restitute_table_builder_restore(builder, journal, 2, &error));
    const double *kept = restitute_table_builder_journal(builder, &count);
    CHECK(count == (status >= 0 ? 2u : 0u), "%zu impacts", count);
    if (status < 0) return status;
    give(given, kept[7]);
    destroy_builder();
    return status;
}

static void fail_builds(long stride)
{
    const struct subject all[] = {{"builder_create", NULL, create, NULL, stride, 0},
                                  {"builder_restore", NULL, restore, destroy_builder, stride, 0},
                                  {"builder_run", NULL, run, destroy_builder, stride, 0},
                                  {"build", NULL, build, NULL, stride, 0}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        fail_each_allocation(&all[i]);
}

static void builds_of_a_contact(void **state)
{
    (void)state;
    if (!CAN_FAIL) skip();
    restitute_table_family_init(&family);
    restitute_table_options_init(&options);
    family.scene = &scene;
    family.speed[0] = 0.1, family.speed[1] = 1;
    options.tolerance = 1e-2;
    fail_builds(0);
}

static void builds_of_ranges(void **state)
{
    (void)state;
    if (!CAN_FAIL) skip();
    restitute_table_family_init(&family);
    restitute_table_options_init(&options);
    family.delta1[0] = 0.5, family.delta1[1] = 1;
    family.chi[0] = 1, family.chi[1] = 1.2;
    options.tolerance = 1e-2;
    fail_builds(16);
}

static void builds_of_cells(void **state)
{
    (void)state;
    if (!CAN_FAIL) skip();
    restitute_table_family_init(&family);
    restitute_table_options_init(&options);
    family.delta1[0] = 0.9, family.delta1[1] = 1;
    family.gamma[0] = 0.9, family.gamma[1] = 1;
    options.tolerance = 0.1;
    fail_builds(1);
}

/* ------------------------------------------------------------------------------------------------- all other calls */

static restitute_table_data data;

static int from_data(struct given *given)
{
    int status;
    restitute_table *made = UNTOUCHED;
    ARMED(status, restitute_table_from_data(&data, &made, &error));
    return give_new_table(status, made, given);
}

static int contact_of(struct given *given)
{
    int status;
    restitute_table_contact contact;
    restitute_table_contact_init(&contact);
    const restitute_table_contact fresh = contact;
    ARMED(status, restitute_table_contact_of(table, &scene, &contact, &error));
    CHECK(status >= 0 || memcmp(&contact, &fresh, sizeof fresh) == 0, "contact touched");
    give(given, contact.speed_factor);
    give(given, contact.psi_factor);
    return status;
}

static void data_and_contacts(void **state)
{
    (void)state;
    const struct subject whole = {"from_data", NULL, from_data, NULL, 0, 0};
    const struct subject contact = {"contact_of", NULL, contact_of, NULL, 0, 0};
    struct cells cells;
    if (!CAN_FAIL) skip();
    restitute_table_data_init(&data);
    restitute_table_to_data(table, &data, NULL);
    fail_each_allocation(&whole);
    fail_each_allocation(&contact);
    cells_make(1, 7, &cells);
    data = cells.data;
    fail_each_allocation(&whole);
    cells_free(&cells);
}

static void lookups_take_no_memory(void **state)
{
    (void)state;
    double normal[50], tangential[50], ez[50], ex[50], chi[50], psi[50], delta1[50], gamma[50];
    struct cells cells;
    int status;
    if (!CAN_FAIL) skip();
    for (int i = 0; i < 50; i++) {
        normal[i] = 0.02 * (i + 1);
        tangential[i] = 0.05 * i;
        chi[i] = 1 + 0.01 * i, psi[i] = 0.1 * i, delta1[i] = 0.6 + 0.04 * i, gamma[i] = 0.3 + 0.01 * i;
    }
    cells_make(1.5, 7, &cells);
    restitute_table *of_cells = cells_table(&cells);
    allocator.count = 0;
    ARMED(status, restitute_table_pairs(table, NULL, 50, normal, tangential, ez, ex));
    assert_int_equal(status, RESTITUTE_OK);
    ARMED(status, restitute_table_numbers_pairs(of_cells, 50, chi, psi, delta1, gamma, ez, ex));
    assert_int_equal(status, RESTITUTE_OK);
    for (int i = 0; i < 50; i++) {
        restitute_table_value pair;
        restitute_table_slope slope;
        ARMED(status, restitute_table_pair_of(table, NULL, normal[i], tangential[i], &pair, &slope));
        assert_int_equal(status, RESTITUTE_OK);
        ARMED(status, restitute_table_numbers_pair(of_cells, chi[i], psi[i], delta1[i], gamma[i], &pair));
        assert_int_equal(status, RESTITUTE_OK);
    }
    CHECK(allocator.count == 0, "%ld allocations", allocator.count);
    restitute_table_destroy(of_cells);
    cells_free(&cells);
}

static int set_up(void **state)
{
    (void)state;
    scene = ball_on(0.3, &material);
    table = table_of(&scene, 0.1, 1, 1e-2);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    restitute_table_destroy(table);
    restitute_material_destroy(material);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(builds_of_a_contact), cmocka_unit_test(builds_of_ranges),
                                       cmocka_unit_test(builds_of_cells), cmocka_unit_test(data_and_contacts),
                                       cmocka_unit_test(lookups_take_no_memory)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
