/* The strict reading of numbers.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "files/number.h"

#include "../support/check.h"
#include "../support/comma_locale.h"
#include "../support/random.h"

/* The values are those that the compiler reads from the same digits: both round to the nearest
 * double. */
static void numbers(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"0", 0.0},
        {"1", 1.0},
        {"-1", -1.0},
        {"+1", 1.0},
        {"007", 7.0},
        {".5", 0.5},
        {"5.", 5.0},
        {"1e-9", 1e-9},
        {"1E+9", 1e9},
        {"-2.5e3", -2500.0},
        {"0.1", 0.1},
        {"9007199254740993", 9007199254740992.0},
        {"1.7976931348623157e308", DBL_MAX},
        {"2.2250738585072014e-308", DBL_MIN},
        {"4.9406564584124654e-324", DBL_TRUE_MIN}, /* subnormal, yet not 0 */
        {"1e-320", 1e-320},
        {"0e-999", 0.0},
        {"inf", INFINITY},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = -99;
        const int status = rst_number_read(cases[i].text, &value);
        CHECK(status == RESTITUTE_OK && value == cases[i].value, "\"%s\": status %d, %.17g", cases[i].text, status,
              value);
    }
}

static void refused_number(const char *text, int expected)
{
    double value = -99;
    const int status = rst_number_read(text, &value);
    CHECK(status == expected, "\"%s\": status %d, not %d, value %g", text, status, expected, value);
    CHECK(value == -99, "\"%s\": the output was touched: %g", text, value);
}

static void no_numbers(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "",     " ",     " 1",       "1 ",    "\t1",   "1\n", "1.0x", "x1",    "nan",   "NaN", "-nan", "nan(1)",
        "0x10", "0X1p3", "1,5",      "1,000", "1_000", "1e",  "1e+",  "e5",    ".",     "+",   "-",    "--1",
        "+-1",  "1.2.3", "1e5.5",    "1e5e5", "infx",  "in",  "i",    "1inf",  "inf1",  "1/2", "1 2",  "1f",
        "1d3",  "1L",    "\xD9\xA1", "\"1\"", "#1",    "1%",  "-.e1", "1e--1", "1e+-1", "1-1", "inf ", " inf",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        refused_number(texts[i], RESTITUTE_ERROR_FORMAT);
}

/* The header allows inf and no other text. */
static void infinity_is_no_number(void **state)
{
    (void)state;
    refused_number("infinity", RESTITUTE_ERROR_FORMAT);
    refused_number("-Infinity", RESTITUTE_ERROR_FORMAT);
}

static void too_large_or_small(void **state)
{
    (void)state;
    static const char *const texts[] = {"1e309",  "-1e309",  "1e99999999999",  "1.7976931348623159e308",
                                        "1e-400", "-1e-400", "1e-99999999999", "2e-324"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        refused_number(texts[i], RESTITUTE_ERROR_DOMAIN);
}

/* 17 digits name a double exactly, so the comparison needs no tolerance. */
static void every_double(void **state)
{
    (void)state;
    uint64_t seed = 22;
    for (int number = 0; number < 20000; number++) {
        const uint64_t bits = random_bits(&seed);
        double written, read = -99;
        memcpy(&written, &bits, sizeof written);
        if (!isfinite(written)) continue;
        char text[64];
        snprintf(text, sizeof text, "%.17g", written);
        const int status = rst_number_read(text, &read);
        CHECK(status == RESTITUTE_OK && read == written, "case %d: %s read as %.17g", number, text, read);
    }
}

static void comma_locale(void **state)
{
    (void)state;
    set_comma_locale();
    double point = -99, comma = -99;
    const int status_point = rst_number_read("1.5e-3", &point), status_comma = rst_number_read("1,5", &comma);
    const char kept = localeconv()->decimal_point[0];
    setlocale(LC_ALL, "C"); /* before anything can fail */
    CHECK(status_point == RESTITUTE_OK && point == 1.5e-3, "status %d, %g", status_point, point);
    CHECK(status_comma == RESTITUTE_ERROR_FORMAT && comma == -99, "status %d, %g", status_comma, comma);
    CHECK(kept == ',', "the program's locale was changed");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers),
        cmocka_unit_test(no_numbers),
        cmocka_unit_test(infinity_is_no_number),
        cmocka_unit_test(too_large_or_small),
        cmocka_unit_test(every_double),
        cmocka_unit_test(comma_locale),
    };
    return cmocka_run_group_tests_name("files: numbers", tests, NULL, NULL);
}
