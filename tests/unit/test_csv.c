/* The plain tables behind materials and the command: what is read, what is refused and how, and the
 * strict reading of numbers.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "files/csv_table.h"
#include "files/number.h"

#include "../support/comma_locale.h"
#include "../support/odd_files.h"
#include "../support/random.h"

/* Every test writes this one file in the current directory; the teardown removes it. */
#define TABLE "test_csv_table.csv"

/* Values of outputs before a call that must not change them. */
static char untouched_place;
#define UNTOUCHED ((struct rst_csv *)&untouched_place)

static void write_table(const char *bytes, size_t length)
{
    FILE *file = fopen(TABLE, "wb");
    CHECK(file != NULL, "cannot write %s", TABLE);
    CHECK(fwrite(bytes, 1, length, file) == length, "cannot write %zu bytes", length);
    CHECK(fclose(file) == 0, "cannot close %s", TABLE);
}

static int remove_table(void **state)
{
    (void)state;
    remove(TABLE);
    return 0;
}

static struct rst_csv *read_text(const char *text)
{
    struct rst_csv *csv = NULL;
    restitute_error error = {-99, "old"};
    write_table(text, strlen(text));
    const int status = rst_csv_read(TABLE, RST_BYTES_OF_TABLE, &csv, &error);
    CHECK(status == RESTITUTE_OK, "status %d (%s) for: %s", status, error.message, text);
    CHECK(error.status == RESTITUTE_OK && error.message[0] == '\0', "error keeps %d \"%s\"", error.status,
          error.message);
    return csv;
}

static void check_cell(const struct rst_csv *csv, size_t row, size_t column, const char *expected)
{
    const char *cell = rst_csv_cell(csv, row, column);
    CHECK(cell != NULL, "row %zu column %zu", row, column);
    CHECK(strcmp(cell, expected) == 0, "row %zu column %zu is \"%s\", not \"%s\"", row, column, cell, expected);
}

/* The file as it is now on disk is refused: status, output untouched, a message with all the
 * words. */
static void check_refused(const char *path, int expected, const char *const *words, const char *what)
{
    struct rst_csv *csv = UNTOUCHED;
    restitute_error error = {-99, "old"};
    const int status = rst_csv_read(path, RST_BYTES_OF_TABLE, &csv, &error);
    CHECK(status == expected, "%s: status %d (%s), not %d", what, status, error.message, expected);
    CHECK(error.status == status, "%s: error.status = %d", what, error.status);
    CHECK(csv == UNTOUCHED, "%s: the output was touched", what);
    for (; words && *words; words++)
        CHECK(strstr(error.message, *words) != NULL, "%s: no \"%s\" in \"%s\"", what, *words, error.message);
    csv = UNTOUCHED;
    CHECK(rst_csv_read(path, RST_BYTES_OF_TABLE, &csv, NULL) == expected && csv == UNTOUCHED,
          "%s: without an error struct", what);
}

/* ---- what is read */

static void plain_table(void **state)
{
    (void)state;
    struct rst_csv *csv = read_text("tau_s,G_Pa\n1,2\n3,4e5\n");
    assert_int_equal(rst_csv_columns(csv), 2);
    assert_int_equal(rst_csv_rows(csv), 2);
    assert_string_equal(rst_csv_name(csv, 0), "tau_s");
    assert_string_equal(rst_csv_name(csv, 1), "G_Pa");
    check_cell(csv, 0, 0, "1");
    check_cell(csv, 0, 1, "2");
    check_cell(csv, 1, 0, "3");
    check_cell(csv, 1, 1, "4e5");
    assert_int_equal(rst_csv_line(csv, 0), 2);
    assert_int_equal(rst_csv_line(csv, 1), 3);
    rst_csv_destroy(csv);
}

static void quotes(void **state)
{
    (void)state;
    struct rst_csv *csv =
        read_text("\"a,1\",\"say \"\"b\"\"\"\n\" x \",\"\"\n\"two\nlines\",y\nz,\"first\n# no comment\"\nlast,1");
    assert_int_equal(rst_csv_columns(csv), 2);
    assert_int_equal(rst_csv_rows(csv), 4);
    assert_string_equal(rst_csv_name(csv, 0), "a,1");
    assert_string_equal(rst_csv_name(csv, 1), "say \"b\"");
    check_cell(csv, 0, 0, " x "); /* spaces inside quotes belong to the cell */
    check_cell(csv, 0, 1, "");
    check_cell(csv, 1, 0, "two\nlines");
    check_cell(csv, 2, 1, "first\n# no comment");
    check_cell(csv, 3, 0, "last");
    const size_t lines[] = {2, 4, 6, 7}; /* on which the rows end */
    for (size_t row = 0; row < 4; row++)
        CHECK(rst_csv_line(csv, row) == lines[row], "row %zu: line %zu", row, rst_csv_line(csv, row));
    rst_csv_destroy(csv);
}

static void comments_empty_lines_spaces(void **state)
{
    (void)state;
    struct rst_csv *csv =
        read_text("# a comment, with \"one quote\n\n  a , b c\t,d\n#1,2\n\n 1 ,  , #3 \n   \n4,5,6\n# end");
    assert_int_equal(rst_csv_columns(csv), 3);
    assert_int_equal(rst_csv_rows(csv), 2);
    assert_string_equal(rst_csv_name(csv, 0), "a");
    assert_string_equal(rst_csv_name(csv, 1), "b c");
    assert_string_equal(rst_csv_name(csv, 2), "d");
    check_cell(csv, 0, 0, "1");
    check_cell(csv, 0, 1, "");
    check_cell(csv, 0, 2, "#3"); /* a # that does not begin the line is text */
    assert_int_equal(rst_csv_line(csv, 0), 6);
    assert_int_equal(rst_csv_line(csv, 1), 8);
    rst_csv_destroy(csv);
}

/* LF, CRLF and a last line without an end give one and the same table. */
static void line_ends(void **state)
{
    (void)state;
    const char *const texts[] = {"a,b\n1,2\n3,4\n", "a,b\r\n1,2\r\n3,4\r\n", "a,b\n1,2\r\n3,4",
                                 "a,b\r\n1,2\r\n3,\"4\""};
    for (int i = 0; i < 4; i++) {
        struct rst_csv *csv = read_text(texts[i]);
        CHECK(rst_csv_rows(csv) == 2 && rst_csv_columns(csv) == 2, "text %d", i);
        assert_string_equal(rst_csv_name(csv, 1), "b");
        check_cell(csv, 0, 1, "2");
        check_cell(csv, 1, 1, "4");
        CHECK(rst_csv_line(csv, 0) == 2 && rst_csv_line(csv, 1) == 3, "text %d", i);
        rst_csv_destroy(csv);
    }
}

static void byte_order_mark(void **state)
{
    (void)state;
    struct rst_csv *csv = read_text("\xEF\xBB\xBF"
                                    "a,b\n1,2\n");
    assert_string_equal(rst_csv_name(csv, 0), "a");
    rst_csv_destroy(csv);
}

static void header_alone(void **state)
{
    (void)state;
    struct rst_csv *csv = read_text("a,b,c\n");
    assert_int_equal(rst_csv_rows(csv), 0);
    assert_int_equal(rst_csv_columns(csv), 3);
    rst_csv_destroy(csv);
}

/* Published values of the 64-bit FNV-1a for "a" and "foobar", which are tables without rows. */
static void fingerprint(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        uint64_t hash;
    } known[] = {{"a", UINT64_C(0xaf63dc4c8601ec8c)}, {"foobar", UINT64_C(0x85944171f73967e8)}};
    for (int i = 0; i < 2; i++) {
        struct rst_csv *csv = read_text(known[i].text);
        CHECK(rst_csv_fingerprint(csv) == known[i].hash, "%s", known[i].text);
        rst_csv_destroy(csv);
    }
    struct rst_csv *plain = read_text("a\n1\n"), *commented = read_text("a\n1\n#\n");
    CHECK(rst_csv_fingerprint(plain) != rst_csv_fingerprint(commented), "other bytes, same fingerprint");
    rst_csv_destroy(plain);
    rst_csv_destroy(commented);
}

static void standard_input(void **state)
{
    (void)state;
    const char text[] = "a,b\n1,2\n";
    write_table(text, strlen(text));
    CHECK(freopen(TABLE, "rb", stdin) != NULL, "cannot redirect the standard input");
    struct rst_csv *csv = NULL;
    CHECK(rst_csv_read("-", RST_BYTES_OF_TABLE, &csv, NULL) == RESTITUTE_OK, "standard input not read");
    check_cell(csv, 0, 1, "2");
    rst_csv_destroy(csv);
    check_refused("-", RESTITUTE_ERROR_FORMAT, (const char *[]){"standard input", NULL}, "standard input at its end");
}

static void many_rows(void **state)
{
    (void)state;
    const size_t rows = 100000;
    FILE *file = fopen(TABLE, "wb");
    CHECK(file != NULL, "cannot write %s", TABLE);
    fputs("number,square\n", file);
    for (size_t i = 0; i < rows; i++)
        fprintf(file, "%zu,%zu\n", i, i * i);
    fclose(file);
    struct rst_csv *csv = NULL;
    assert_int_equal(rst_csv_read(TABLE, RST_BYTES_OF_TABLE, &csv, NULL), RESTITUTE_OK);
    assert_int_equal(rst_csv_rows(csv), rows);
    for (size_t i = 0; i < rows; i++) {
        char expected[32];
        snprintf(expected, sizeof expected, "%zu", i * i);
        check_cell(csv, i, 1, expected);
        CHECK(rst_csv_line(csv, i) == i + 2, "row %zu", i);
    }
    rst_csv_destroy(csv);
}

/* A header of a million names, compared each with each, would outlast the time that a test has. */
static void many_columns(void **state)
{
    (void)state;
    enum { columns = 1000000, width = 9 };
    char *text = malloc((size_t)columns * width + 1), *at = text;
    CHECK(text != NULL, "no memory");
    for (int i = 0; i < columns; i++)
        at += sprintf(at, "c%07d,", i);
    at[-1] = '\n';
    struct rst_csv *csv = read_text(text);
    assert_int_equal(rst_csv_columns(csv), columns);
    assert_string_equal(rst_csv_name(csv, columns - 1), "c0999999");
    rst_csv_destroy(csv);
    text[(size_t)width * (columns - 1) + width - 2] = '0'; /* c0999999 -> c0999990 */
    write_table(text, strlen(text));
    check_refused(TABLE, RESTITUTE_ERROR_FORMAT, (const char *[]){"line 1", "column c0999990 appears twice", NULL},
                  "the last of a million names repeated");
    free(text);
}

static void long_cell(void **state)
{
    (void)state;
    const size_t length = 1000000;
    char *text = malloc(length + 3);
    CHECK(text != NULL, "no memory");
    memcpy(text, "a\n", 2);
    memset(text + 2, 'x', length);
    text[length + 2] = '\0';
    struct rst_csv *csv = read_text(text);
    check_cell(csv, 0, 0, text + 2);
    rst_csv_destroy(csv);
    free(text);
}

/* ---- what is refused */

static void malformed_tables(void **state)
{
    (void)state;
    static const struct {
        const char *what, *text, *words[4];
    } cases[] = {
        {"empty file", "", {"empty"}},
        {"empty lines", "\n\r\n  \n", {"empty"}},
        {"comments alone", "# a,b\n# c", {"empty"}},
        {"too few cells", "a,b,c\n1,2,3\n1,2\n", {"line 3", "2 cells", "3 columns"}},
        {"too many cells", "a,b\n\n1,2,3\n", {"line 3", "3 cells", "2 columns"}},
        {"ragged last line without an end", "a,b\n1,2\n3", {"line 3", "1 cell", "2 columns"}},
        {"comma at the end", "a,b\n1,2,\n", {"line 2", "3 cells", "2 columns"}},
        {"ragged behind a comment", "# x\na,b\n# y\n1\n", {"line 4", "1 cell", "2 columns"}},
        {"ragged behind a cell of two lines", "a,b\n\"1\n1\",2\n1\n", {"line 4", "1 cell", "2 columns"}},
        {"stray quote in a cell", "a,b\n1,2\n1,2\"3\n", {"line 3"}},
        {"text behind a quoted cell", "a,b\n\"1\"x,2\n", {"line 2"}},
        {"quote never closed", "a,b\n1,\"2\n", {"line 2", "quote"}},
        {"quote never closed in the header", "\"a", {"line 1", "quote"}},
        {"column without a name", "a,,c\n1,2,3\n", {"line 1", "column 2"}},
        {"quoted empty name", "a,\"\"\n", {"line 1", "column 2"}},
        {"name missing at the end", "#\na,b,\n1,2,3\n", {"line 2", "column 3"}},
        {"repeated name", "# x\nalpha,beta,alpha\n", {"line 2", "alpha", "twice"}},
        {"two repeated names: the first that repeats is named", "z,b,b,a,z,a\n", {"line 1", "column b", "twice"}},
        {"repeated name, one quoted", "alpha,\"alpha\"\n", {"line 1", "alpha", "twice"}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_table(cases[i].text, strlen(cases[i].text));
        const char *words[] = {TABLE, cases[i].words[0], cases[i].words[1], cases[i].words[2], NULL};
        check_refused(TABLE, RESTITUTE_ERROR_FORMAT, words, cases[i].what);
    }
}

static void nul_byte(void **state)
{
    (void)state;
    const char text[] = "a,b\n1,2\n1,\0002\n";
    write_table(text, sizeof text - 1);
    check_refused(TABLE, RESTITUTE_ERROR_FORMAT, (const char *[]){TABLE, "line 3", NULL}, "NUL byte");
}

static void unreadable_files(void **state)
{
    (void)state;
    check_refused("test_csv_nowhere.csv", RESTITUTE_ERROR_FILE, (const char *[]){"test_csv_nowhere.csv", NULL},
                  "missing file");
    check_refused(RESTITUTE_SOURCE_DIR, RESTITUTE_ERROR_FILE, NULL, "a directory");
    check_refused("", RESTITUTE_ERROR_FILE, NULL, "empty path");
    char path[5000]; /* longer than any file name and than the message: its end is named */
    memset(path, 'x', sizeof path);
    strcpy(path + sizeof path - 9, "/end.csv");
    check_refused(path, RESTITUTE_ERROR_FILE, (const char *[]){"/end.csv", NULL}, "endless path");
    check_refused("100%s%n.csv", RESTITUTE_ERROR_FILE, (const char *[]){"100%s%n.csv", NULL}, "path like a format");
}

static void endless_files(void **state)
{
    (void)state;
    const char fifo[] = "test_csv_fifo";
    make_fifo(fifo);
    check_refused(fifo, RESTITUTE_ERROR_FILE, (const char *[]){fifo, "not a regular file", NULL}, "a FIFO");
    unlink(fifo);
    check_refused("/dev/zero", RESTITUTE_ERROR_FILE, (const char *[]){"/dev/zero", "not a regular file", NULL},
                  "a device");
    if (sizeof(off_t) > 4 && make_sparse(TABLE, (off_t)4294967297))
        check_refused(TABLE, RESTITUTE_ERROR_FILE, (const char *[]){TABLE, "4294967297", "4294967296", NULL},
                      "too large");
}

/* Whatever the bytes: a table in which every cell can be read, or a refusal that names the file. */
static void check_any_bytes(const char *bytes, size_t length, int number)
{
    struct rst_csv *csv = UNTOUCHED;
    restitute_error error = {-99, "old"};
    write_table(bytes, length);
    const int status = rst_csv_read(TABLE, RST_BYTES_OF_TABLE, &csv, &error);
    CHECK(status == error.status, "case %d", number);
    if (status != RESTITUTE_OK) {
        CHECK(status == RESTITUTE_ERROR_FORMAT, "case %d: status %d (%s)", number, status, error.message);
        CHECK(csv == UNTOUCHED && strstr(error.message, TABLE), "case %d: %s", number, error.message);
        return;
    }
    CHECK(rst_csv_columns(csv) > 0, "case %d", number);
    size_t last = 0;
    for (size_t row = 0; row < rst_csv_rows(csv); row++) {
        for (size_t column = 0; column < rst_csv_columns(csv); column++)
            CHECK(strlen(rst_csv_cell(csv, row, column)) <= length, "case %d", number);
        CHECK(rst_csv_line(csv, row) >= last, "case %d row %zu", number, row);
        last = rst_csv_line(csv, row);
    }
    rst_csv_destroy(csv);
}

static const char rich_table[] = "# c\r\na,\"b \"\"q\"\"\",c\n1, 2 ,\"3\n4\"\r\n\n\"x,y\",,z\n#\n7,8,9";

static void random_bytes(void **state)
{
    (void)state;
    static const char likely[] = ",\"\n\r# \ta1";
    uint64_t seed = 20;
    char bytes[400];
    for (int number = 0; number < 1500; number++) {
        const size_t length = (size_t)random_below(&seed, sizeof bytes);
        for (size_t i = 0; i < length; i++)
            bytes[i] = number % 2 ? (char)random_bits(&seed) : likely[random_below(&seed, sizeof likely - 1)];
        check_any_bytes(bytes, length, number);
    }
}

static void changed_bytes(void **state)
{
    (void)state;
    uint64_t seed = 21;
    for (int number = 0; number < 1000; number++) {
        char bytes[sizeof rich_table];
        memcpy(bytes, rich_table, sizeof bytes);
        for (int i = 0; i < 1 + number % 3; i++) {
            const int place = random_below(&seed, sizeof bytes - 1);
            bytes[place] = (char)random_bits(&seed);
        }
        check_any_bytes(bytes, sizeof bytes - 1, number);
    }
}

static void truncated_table(void **state)
{
    (void)state;
    for (size_t length = 0; length < sizeof rich_table; length++)
        check_any_bytes(rich_table, length, (int)length);
}

/* ---- numbers */

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
        cmocka_unit_test_teardown(plain_table, remove_table),
        cmocka_unit_test_teardown(quotes, remove_table),
        cmocka_unit_test_teardown(comments_empty_lines_spaces, remove_table),
        cmocka_unit_test_teardown(line_ends, remove_table),
        cmocka_unit_test_teardown(byte_order_mark, remove_table),
        cmocka_unit_test_teardown(header_alone, remove_table),
        cmocka_unit_test_teardown(fingerprint, remove_table),
        cmocka_unit_test_teardown(standard_input, remove_table),
        cmocka_unit_test_teardown(many_rows, remove_table),
        cmocka_unit_test_teardown(many_columns, remove_table),
        cmocka_unit_test_teardown(long_cell, remove_table),
        cmocka_unit_test_teardown(malformed_tables, remove_table),
        cmocka_unit_test_teardown(nul_byte, remove_table),
        cmocka_unit_test(unreadable_files),
        cmocka_unit_test_teardown(endless_files, remove_table),
        cmocka_unit_test_teardown(random_bytes, remove_table),
        cmocka_unit_test_teardown(changed_bytes, remove_table),
        cmocka_unit_test_teardown(truncated_table, remove_table),
        cmocka_unit_test(numbers),
        cmocka_unit_test(no_numbers),
        cmocka_unit_test(infinity_is_no_number),
        cmocka_unit_test(too_large_or_small),
        cmocka_unit_test(every_double),
        cmocka_unit_test(comma_locale),
    };
    return cmocka_run_group_tests_name("files: tables and numbers", tests, NULL, NULL);
}
