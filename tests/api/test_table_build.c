/* Building: the same bits for any number of threads and any division into steps, going on from a journal, refusals.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <string.h>

#include "../support/child.h"
#include "../support/table.h"

static restitute_table_family family_of(const restitute_scene *scene)
{
    restitute_table_family family;
    restitute_table_family_init(&family);
    family.scene = scene;
    family.speed[0] = 1e-2;
    family.speed[1] = 10;
    return family;
}

static restitute_table_options options_of(int threads)
{
    restitute_table_options options;
    restitute_table_options_init(&options);
    options.tolerance = 1e-4;
    options.threads = threads;
    return options;
}

static int same_bits(const restitute_table *a, const restitute_table *b)
{
    restitute_table_data x, y;
    restitute_table_data_init(&x);
    restitute_table_data_init(&y);
    restitute_table_to_data(a, &x, NULL);
    restitute_table_to_data(b, &y, NULL);
    size_t n = (size_t)(x.nodes[0] * x.nodes[1]), m = n * (size_t)(x.nodes[2] * x.nodes[3]);
    return memcmp(x.nodes, y.nodes, sizeof x.nodes) == 0 && memcmp(x.ez, y.ez, n * sizeof(double)) == 0 &&
           memcmp(x.ex, y.ex, m * sizeof(double)) == 0 && x.error_ez == y.error_ez && x.error_ex == y.error_ex &&
           x.impacts == y.impacts && x.checks == y.checks;
}

static void threads_give_the_same_bits(void **state)
{
    restitute_material *material;
    restitute_error error;
    (void)state;
    const restitute_scene scene = ball_on(0.3, &material);
    const restitute_table_family family = family_of(&scene);
    restitute_table *tables[3];
    for (int i = 0; i < 3; i++) {
        const restitute_table_options options = options_of(i + 1);
        CHECK(restitute_table_build(&family, &options, &tables[i], &error) == RESTITUTE_OK, "%s", error.message);
    }
    CHECK(same_bits(tables[0], tables[1]) && same_bits(tables[0], tables[2]), "one, two and three threads");
    for (int i = 0; i < 3; i++)
        restitute_table_destroy(tables[i]);
    restitute_material_destroy(material);
}

struct forked {
    restitute_table_family family;
    restitute_table *table;
};

static int one_thread_gives_the_same(void *of)
{
    const struct forked *known = of;
    const restitute_table_options options = options_of(1);
    restitute_table *table = NULL;
    const int same =
        restitute_table_build(&known->family, &options, &table, NULL) == RESTITUTE_OK && same_bits(table, known->table);
    restitute_table_destroy(table);
    return same;
}

/* As of batches: the threads of a build are not there in a child of the process. */
static void a_child_goes_on_with_one_thread(void **state)
{
    restitute_material *material;
    (void)state;
    const restitute_scene scene = ball_on(0.3, &material);
    const restitute_table_options options = options_of(4);
    struct forked known = {.family = family_of(&scene)};
    CHECK(restitute_table_build(&known.family, &options, &known.table, NULL) == RESTITUTE_OK, "build");
    CHECK(good_in_child(one_thread_gives_the_same, &known), "the child");
    restitute_table_destroy(known.table);
    restitute_material_destroy(material);
}

/* Steps of 7 impacts; stopped half way, and taken up by another builder. */
static void steps_and_journals_give_the_same_bits(void **state)
{
    restitute_material *material;
    restitute_error error;
    restitute_table *whole = NULL, *stepped = NULL;
    restitute_table_builder *first, *second;
    size_t count;
    (void)state;
    const restitute_scene scene = ball_on(0.3, &material);
    const restitute_table_family family = family_of(&scene);
    const restitute_table_options options = options_of(1);
    CHECK(restitute_table_build(&family, &options, &whole, &error) == RESTITUTE_OK, "%s", error.message);
    restitute_table_info info;
    restitute_table_info_init(&info);
    restitute_table_describe(whole, &info, NULL);
    assert_int_equal(restitute_table_builder_create(&family, &options, &first, &error), RESTITUTE_OK);
    while (restitute_table_builder_solved(first) < info.impacts / 2) {
        assert_int_equal(restitute_table_builder_run(first, 7, &stepped, &error), RESTITUTE_OK);
        assert_null(stepped);
        CHECK(restitute_table_builder_expected(first) >= restitute_table_builder_solved(first), "expected");
    }
    const double *journal = restitute_table_builder_journal(first, &count);
    assert_int_equal(count, restitute_table_builder_solved(first));
    assert_int_equal(restitute_table_builder_create(&family, &options, &second, &error), RESTITUTE_OK);
    assert_int_equal(restitute_table_builder_restore(second, journal, count, &error), RESTITUTE_OK);
    assert_int_equal(restitute_table_builder_restore(second, journal, count, &error), RESTITUTE_ERROR_DOMAIN);
    restitute_table_builder_destroy(first);
    while (!stepped)
        assert_int_equal(restitute_table_builder_run(second, 100, &stepped, &error), RESTITUTE_OK);
    CHECK(same_bits(whole, stepped), "in steps and from a journal");
    assert_int_equal(restitute_table_builder_run(second, 100, &stepped, &error), RESTITUTE_ERROR_DOMAIN);
    restitute_table_builder_destroy(second);
    restitute_table_destroy(whole);
    restitute_table_destroy(stepped);
    restitute_material_destroy(material);
}

/* The family is copied: the material may go before the impacts are solved. */
static void the_material_may_go(void **state)
{
    restitute_material *material;
    restitute_table_builder *builder;
    restitute_table *table = NULL;
    restitute_error error;
    (void)state;
    const restitute_scene scene = ball_on(0, &material);
    const restitute_table_family family = family_of(&scene);
    const restitute_table_options options = options_of(1);
    assert_int_equal(restitute_table_builder_create(&family, &options, &builder, &error), RESTITUTE_OK);
    restitute_material_destroy(material);
    CHECK(restitute_table_builder_run(builder, 1000000, &table, &error) == RESTITUTE_OK, "%s", error.message);
    assert_non_null(table);
    restitute_table_builder_destroy(builder);
    restitute_table_destroy(table);
}

static void data_makes_the_same_table(void **state)
{
    restitute_material *material;
    restitute_table *copy = NULL;
    restitute_table_data data;
    restitute_error error;
    (void)state;
    const restitute_scene scene = ball_on(0.3, &material);
    restitute_table *table = table_of(&scene, 0.01, 1, 1e-3);
    restitute_table_data_init(&data);
    assert_int_equal(restitute_table_to_data(table, &data, &error), RESTITUTE_OK);
    CHECK(restitute_table_from_data(&data, &copy, &error) == RESTITUTE_OK, "%s", error.message);
    for (double psi = 0; psi < 5; psi += 0.1)
        CHECK(look_up(copy, 0.3, psi).ex == look_up(table, 0.3, psi).ex, "psi = %g", psi);
    restitute_table_destroy(copy);
    copy = NULL;
    restitute_table_data bad[6] = {data, data, data, data, data, data};
    bad[0].chi_cells = -1;
    bad[1].stick_cells = -1;
    bad[2].parts[0] = 3;
    bad[3].high[0] = NAN;
    bad[4].slip_cells = 0;
    bad[5].low[0] *= 1.0001;
    for (int i = 0; i < 6; i++)
        CHECK(restitute_table_from_data(&bad[i], &copy, &error) == RESTITUTE_ERROR_DOMAIN && !copy, "bad data %d", i);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

static void refuse(const restitute_table_family *family, const restitute_table_options *options, const char *text)
{
    restitute_table *table = NULL;
    restitute_error error;
    CHECK(restitute_table_build(family, options, &table, &error) == RESTITUTE_ERROR_DOMAIN, "%s: %s", text,
          error.message);
    CHECK(strstr(error.message, text) && !table, "\"%s\" does not say \"%s\"", error.message, text);
}

static void refusals(void **state)
{
    restitute_material *material;
    (void)state;
    restitute_scene scene = ball_on(0, &material);
    const restitute_table_family good = family_of(&scene);
    restitute_table_options options = options_of(1);
    restitute_table_family family = good;
    family.speed[0] = 0;
    refuse(&family, &options, "speed (m/s) = 0");
    family.speed[0] = NAN;
    refuse(&family, &options, "speed (m/s) = nan");
    family.speed[0] = 20;
    refuse(&family, &options, "speed (m/s) = 20 to 10");
    family.scene = NULL;
    family.delta1[0] = -1;
    refuse(&family, &options, "delta1 = -1");
    family = good;
    scene.friction = -0.1;
    refuse(&family, &options, "friction");
    scene.friction = 0.3;
    scene.radius1 = NAN;
    refuse(&family, &options, "radius1");
    scene.radius1 = 0.005;
    options.tolerance = 1e-9;
    refuse(&good, &options, "tolerance");
    options = options_of(-1);
    refuse(&good, &options, "threads");
    options = options_of(1);
    options.max_impacts = 100;
    restitute_table *table = NULL;
    assert_int_equal(restitute_table_build(&good, &options, &table, NULL), RESTITUTE_ERROR_TOO_MUCH_WORK);
    assert_int_equal(restitute_table_build(NULL, &options, &table, NULL), RESTITUTE_ERROR_NULL);
    family.struct_size = 8;
    options = options_of(1);
    assert_int_equal(restitute_table_build(&family, &options, &table, NULL), RESTITUTE_ERROR_STRUCT_SIZE);
    restitute_material_destroy(material);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(threads_give_the_same_bits),
                                       cmocka_unit_test(a_child_goes_on_with_one_thread),
                                       cmocka_unit_test(steps_and_journals_give_the_same_bits),
                                       cmocka_unit_test(the_material_may_go),
                                       cmocka_unit_test(data_makes_the_same_table),
                                       cmocka_unit_test(refusals)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
