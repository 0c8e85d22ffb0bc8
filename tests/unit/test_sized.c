/* Structs that grow at their end, here one of each age, and methods of other versions.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "base/method.h"
#include "base/sized.h"

#include "../support/check.h"

/* As it was in the first release, as it is, and as it will be. */
struct older {
    size_t struct_size;
    double a;
};

struct ours {
    size_t struct_size;
    double a;
    int64_t b;
};

struct later {
    size_t struct_size;
    double a;
    int64_t b, c;
};

static const struct rst_layout layout = {"restitute_thing", sizeof(struct older), sizeof(struct ours)};
static const struct ours defaults = {.a = 1, .b = 2};

static void init_writes_no_more_than_the_caller_has(void **state)
{
    struct later x = {.struct_size = 99, .a = 99, .b = 99, .c = 99};
    (void)state;
    rst_init(&x, sizeof(size_t) - 1, &defaults, sizeof defaults);
    CHECK(x.struct_size == 99 && x.a == 99, "not even its size: %zu", x.struct_size);
    rst_init(&x, sizeof(struct older), &defaults, sizeof defaults);
    CHECK(x.struct_size == sizeof(struct older) && x.a == 1 && x.b == 99, "older: %zu, %g", x.struct_size, x.a);
    rst_init(&x, sizeof(struct ours), &defaults, sizeof defaults);
    CHECK(x.struct_size == sizeof(struct ours) && x.b == 2 && x.c == 99, "ours: %zu", x.struct_size);
    x.a = x.b = 99;
    rst_init(&x, sizeof x, &defaults, sizeof defaults); /* what is behind our members is unknown: 0 */
    CHECK(x.struct_size == sizeof x && x.a == 1 && x.b == 2 && x.c == 0, "later: %zu, %g", x.struct_size, x.a);
    rst_init(NULL, sizeof x, &defaults, sizeof defaults);
}

/* What he has not keeps its default. */
static void an_older_input_is_completed(void **state)
{
    const struct older theirs = {sizeof theirs, 7};
    struct ours x;
    (void)state;
    rst_init(&x, sizeof x, &defaults, sizeof defaults);
    rst_copy(&x, sizeof x, &theirs);
    CHECK(x.struct_size == sizeof x && x.a == 7 && x.b == 2, "%zu: %g, %d", x.struct_size, x.a, (int)x.b);
}

static void an_older_output_gets_what_it_has_room_for(void **state)
{
    const struct ours x = {sizeof x, 7, 8};
    struct later theirs = {.struct_size = sizeof(struct older), .b = 99, .c = 99};
    (void)state;
    rst_copy(&theirs, sizeof x, &x);
    CHECK(theirs.struct_size == sizeof(struct older) && theirs.a == 7 && theirs.b == 99, "%zu: %g, %d",
          theirs.struct_size, theirs.a, (int)theirs.b);
}

static void arrays_step_by_the_size_that_the_first_names(void **state)
{
    const struct older old[3] = {{sizeof old[0], 0}, {sizeof old[0], 1}, {sizeof old[0], 2}};
    const struct ours now[3] = {{sizeof now[0], 0, 0}, {sizeof now[0], 1, 0}, {sizeof now[0], 2, 0}};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        CHECK(rst_at(old, i) == (const void *)&old[i], "older, %zu", i);
        CHECK(rst_at(now, i) == (const void *)&now[i], "ours, %zu", i);
    }
}

/* Else a write would end behind the array, or in its next struct. */
static void structs_of_an_array_have_one_size(void **state)
{
    struct ours x[3] = {{sizeof x[0], 0, 0}, {sizeof x[0], 1, 0}, {sizeof x[0], 2, 0}};
    restitute_error error;
    (void)state;
    CHECK(rst_check_array(&layout, NULL, 0, "things", &error) == RESTITUTE_OK, "none");
    CHECK(rst_check_array(&layout, x, 3, "things", &error) == RESTITUTE_OK, "one size");
    x[2].struct_size = sizeof(struct older);
    CHECK(rst_check_array(&layout, x, 2, "things", &error) == RESTITUTE_OK, "before it");
    CHECK(rst_check_array(&layout, x, 3, "things", &error) == RESTITUTE_ERROR_STRUCT_SIZE, "two sizes");
    CHECK(strcmp(error.message, "things[2].struct_size = 16: must be 24, as of the first") == 0, "%s", error.message);
    x[0].struct_size = 8;
    CHECK(rst_check_array(&layout, x, 3, "things", &error) == RESTITUTE_ERROR_STRUCT_SIZE, "the first");
}

static void sizes_are_checked_in_words(void **state)
{
    static const char *const unprepared = "must be in [16, 24], a multiple of 8; prepare the struct with "
                                          "restitute_thing_init",
                             *const newer = "must be at most 24; the program was compiled with later headers";
    const struct {
        size_t size;
        const char *words; /* NULL: accepted */
    } cases[] = {{sizeof(struct older), NULL},
                 {sizeof(struct ours), NULL},
                 {0, unprepared},
                 {sizeof(struct older) - 8, unprepared},
                 {sizeof(struct older) + 4, unprepared},
                 {sizeof(struct later), newer},
                 {3 * sizeof(struct ours), newer},
                 {sizeof(struct ours) + 1, unprepared},
                 {(size_t)-1, unprepared},
                 {(size_t)-8, unprepared}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct later x = {.struct_size = cases[i].size};
        restitute_error error = {0};
        const int status = rst_check_layout(&layout, &x, &error);
        CHECK(status == (cases[i].words ? RESTITUTE_ERROR_STRUCT_SIZE : RESTITUTE_OK), "%zu: %d", cases[i].size,
              status);
        if (cases[i].words) CHECK(strstr(error.message, cases[i].words), "%zu: %s", cases[i].size, error.message);
    }
}

/* A method of another component is part of the core's inside: it must be of the core's own
 * version. */
static void a_method_of_another_version_is_refused(void **state)
{
    restitute_options options;
    restitute_solver *solver = NULL;
    restitute_error error;
    (void)state;
    restitute_options_init(&options);
    for (int i = 0; i < 3; i++) {
        struct restitute_method method = *restitute_method_euler();
        if (i == 1) method.struct_size -= sizeof(void *);
        if (i == 2) method.number++;
        options.method = &method;
        const int status = restitute_solver_create(&options, &solver, &error);
        CHECK(status == (i == 0 ? RESTITUTE_OK : RESTITUTE_ERROR_STRUCT_SIZE), "%d: %d", i, status);
        if (i > 0) CHECK(!solver && strstr(error.message, "another version"), "%d: %s", i, error.message);
        restitute_solver_destroy(solver);
        solver = NULL;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(init_writes_no_more_than_the_caller_has),
        cmocka_unit_test(an_older_input_is_completed),
        cmocka_unit_test(an_older_output_gets_what_it_has_room_for),
        cmocka_unit_test(arrays_step_by_the_size_that_the_first_names),
        cmocka_unit_test(structs_of_an_array_have_one_size),
        cmocka_unit_test(sizes_are_checked_in_words),
        cmocka_unit_test(a_method_of_another_version_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
