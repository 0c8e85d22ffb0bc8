/* `restitute table info` and `query`: what a table file holds.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "files/csv_table.h"
#include "files/number.h"
#include "output.h"
#include "places.h"
#include "provenance.h"
#include "rows.h"
#include "table_settings.h"

static restitute_table *read_table(const struct table_settings *settings)
{
    restitute_table *table = NULL;
    restitute_error error;
    if (restitute_table_read(settings->file, &table, &error) < 0) complain("%s", error.message);
    return table;
}

/* The output of `query`: a place that can be written, and neither the table nor the cases. */
static bool check_places(const struct table_settings *settings, struct reason *why)
{
    struct places places = {0};
    places_read(&places, "the table", settings->file);
    places_read(&places, "--input", settings->text[TABLE_INPUT]);
    places_write(&places, "--output", settings->text[TABLE_OUTPUT]);
    return places_check(&places, why) && output_check(settings->text[TABLE_OUTPUT], "--output", why);
}

/* ---- info */

/* Add a line or a part of one. */
static void add(char *text, size_t size, const char *format, double number)
{
    const size_t used = strlen(text);
    snprintf(text + used, size - used, format, number);
}

void table_limits(const restitute_table_info *i, char *text, size_t size)
{
    *text = '\0';
    if (i->rebound_speed > 0) add(text, size, "no rebound up to %.4g m/s", i->rebound_speed);
    const struct {
        double speed;
        const char *format;
    } limit[] = {{i->fast_speed, "not slow against shear waves from %.4g m/s on"},
                 {i->large_contact_speed, "contact not small against the sphere from %.4g m/s on"},
                 {i->long_slide_speed, "long slide at 45 degrees from %.4g m/s on"}};
    for (int k = 0; k < 3; k++) {
        if (isinf(limit[k].speed)) continue;
        if (*text) add(text, size, "; ", 0);
        add(text, size, limit[k].format, limit[k].speed);
    }
}

static void print_info(const restitute_table_info *i)
{
    char limits[400], version[4 * sizeof i->version];
    printf("%-16s %.6g to %.6g m/s\n%-16s %.6g\n", "speed", i->speed[0], i->speed[1], "chi", i->chi);
    if (!isnan(i->gamma))
        printf("%-16s %.6g to %.6g\n%-16s %.6g\n", "delta1", i->delta1[0], i->delta1[1], "gamma", i->gamma);
    printf("%-16s %g\n%-16s %g m, %g kg (effective)\n", "friction", i->friction, "radius, mass", i->radius, i->mass);
    printf("%-16s %g\n", "tolerance", i->tolerance);
    printf("%-16s %.2g (ez), %.2g (ex), verified at %lld places\n", "error", i->error_ez, i->error_ex,
           (long long)i->checks);
    table_limits(i, limits, sizeof limits);
    printf("%-16s %s\n", "limits", *limits ? limits : "none is passed");
    printf("%-16s %lld\n", "impacts solved", (long long)i->impacts);
    printf("%-16s %lld speeds, %lld + %lld cells of psi; %.3g MB\n", "nodes", (long long)i->speeds,
           (long long)i->stick_cells, (long long)i->slip_cells, (double)i->bytes / 1e6);
    snprintf(version, sizeof version, "%s", i->version);
    escape(version, sizeof version);
    printf("%-16s %s\n", "built by", version);
}

static void set_number(json_t *object, const char *name, double number)
{
    json_object_set_new(object, name, json_of_number(number));
}

static json_t *json_of_info(const restitute_table_info *i)
{
    json_t *object = json_pack("{s:[o, o], s:[o, o]}", "speed_m_s", json_of_number(i->speed[0]),
                               json_of_number(i->speed[1]), "delta1", json_of_number(i->delta1[0]),
                               json_of_number(i->delta1[1]));
    set_number(object, "chi", i->chi);
    set_number(object, "gamma", i->gamma);
    set_number(object, "friction", i->friction);
    set_number(object, "radius_m", i->radius);
    set_number(object, "mass_kg", i->mass);
    set_number(object, "tolerance", i->tolerance);
    set_number(object, "error_ez", i->error_ez);
    set_number(object, "error_ex", i->error_ex);
    set_number(object, "rebound_speed_m_s", i->rebound_speed);
    set_number(object, "fast_speed_m_s", i->fast_speed);
    set_number(object, "large_contact_speed_m_s", i->large_contact_speed);
    set_number(object, "long_slide_speed_m_s", i->long_slide_speed);
    json_object_set_new(object, "impacts", json_integer(i->impacts));
    json_object_set_new(object, "checks", json_integer(i->checks));
    json_object_set_new(object, "speeds", json_integer(i->speeds));
    json_object_set_new(object, "stick_cells", json_integer(i->stick_cells));
    json_object_set_new(object, "slip_cells", json_integer(i->slip_cells));
    json_object_set_new(object, "bytes", json_integer((json_int_t)i->bytes));
    json_object_set_new(object, "version", json_string(i->version));
    return object;
}

int table_info_run(const struct table_settings *settings)
{
    const char *format = settings->text[TABLE_FORMAT] ? settings->text[TABLE_FORMAT] : "text";
    struct reason why;
    restitute_table_info info;
    if (strcmp(format, "text") != 0 && strcmp(format, "json") != 0)
        return complain("--format = \"%.64s\": must be text or json", format);
    restitute_table *table = read_table(settings);
    if (!table) return EXIT_USAGE;
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    restitute_table_destroy(table);
    if (*format == 't')
        print_info(&info);
    else if (!provenance_write(NULL, json_of_info(&info), &why))
        return complain("%s", why.text);
    return EXIT_DONE;
}

/* ---- query */

struct query {
    const restitute_table *table;
    restitute_table_info info;
    double value[2]; /* normal and tangential speed */
    int flags;       /* limits of the model that some pair passes */
};
static const char *const columns[2] = {"normal_speed_m_s", "tangential_speed_m_s"};

struct pair {
    double ez, ex;
};

static int look_up(struct query *q, struct pair *pair)
{
    int flags;
    if (restitute_table_flags(q->table, q->value[0], q->value[1], &flags, NULL) >= 0) q->flags |= flags;
    return restitute_table_pair(q->table, NULL, q->value[0], q->value[1], &pair->ez, &pair->ex, NULL);
}

/* The table takes such a speed as the end. That of a solid whose e_z is the same at all speeds says nothing. */
static bool outside(const struct query *q)
{
    const bool one = q->info.speed[0] >= q->info.speed[1];
    return (q->info.speeds > 2 || one) && (q->value[0] < q->info.speed[0] || q->value[0] > q->info.speed[1]);
}

static void warn(const struct query *q)
{
    for (int bit = 1; bit <= q->flags; bit *= 2)
        if (q->flags & bit) complain("warning: %s", restitute_flag_text(bit));
}

static bool check_query(const struct table_settings *s, struct reason *why)
{
    static const enum table_text speeds[2] = {TABLE_NORMAL_SPEED, TABLE_TANGENTIAL_SPEED};
    for (int i = 0; s->text[TABLE_INPUT] && i < 2; i++)
        if (s->text[speeds[i]])
            return refuse(why, "--%s: not with --input, whose columns give the values", table_text_names[speeds[i]]);
    const char *format = s->text[TABLE_FORMAT];
    if (!format || strcmp(format, "csv") == 0) return true;
    if (strcmp(format, "text") != 0) return refuse(why, "--format = \"%.64s\": must be text or csv", format);
    return s->text[TABLE_INPUT] ? refuse(why, "--format = text: not with --input, which gives csv") : true;
}

static bool find_one(const struct table_settings *s, struct query *q, struct pair *pair, struct reason *why)
{
    q->value[0] = NAN;
    if (!table_number(s, TABLE_NORMAL_SPEED, 0, 1e100, &q->value[0], why) ||
        !table_number(s, TABLE_TANGENTIAL_SPEED, -1e100, 1e100, &q->value[1], why))
        return false;
    if (isnan(q->value[0])) return refuse(why, "--normal-speed is missing");
    return look_up(q, pair) >= 0 ? true : refuse(why, "the table has no answer to this");
}

static int query_one(const struct table_settings *s, struct query *q)
{
    struct reason why;
    struct output output;
    struct pair pair;
    const bool csv = s->text[TABLE_FORMAT] && strcmp(s->text[TABLE_FORMAT], "csv") == 0;
    if (!find_one(s, q, &pair, &why) || !check_places(s, &why) || !output_open(s->text[TABLE_OUTPUT], &output, &why))
        return complain("%s", why.text);
    fprintf(output.stream, csv ? "ez,ex\n%s," : "ez = %s\n", number_text(pair.ez).text);
    fprintf(output.stream, csv ? "%s\n" : "ex = %s\n", number_text(pair.ex).text);
    if (!output_finish(&output, &why)) return complain("%s", why.text);
    if (outside(q)) complain("warning: %s is outside the table's range: its end is taken", columns[0]);
    warn(q);
    return EXIT_DONE;
}

/* Which column of the file gives which value; -1: 0. */
static bool find_columns(const struct rst_csv *csv, int column[2], struct reason *why)
{
    for (int k = 0; k < 2; k++) {
        column[k] = -1;
        for (size_t i = 0; i < rst_csv_columns(csv); i++)
            if (strcmp(rst_csv_name(csv, i), columns[k]) == 0) column[k] = (int)i;
    }
    return column[0] >= 0 ? true : refuse(why, "the column %s is missing", columns[0]);
}

/* One row: the values, and what came of them. */
static bool answer_row(struct query *q, const struct rst_csv *csv, size_t row, const int column[2], FILE *out)
{
    struct pair pair = {NAN, NAN};
    bool good = true;
    q->value[1] = 0;
    for (int k = 0; k < 2; k++)
        if (column[k] >= 0)
            good &= rst_number_read(rst_csv_cell(csv, row, (size_t)column[k]), &q->value[k]) == RESTITUTE_OK;
    const bool done = good && look_up(q, &pair) == RESTITUTE_OK;
    for (size_t i = 0; i < rst_csv_columns(csv); i++) {
        cell_write(out, rst_csv_cell(csv, row, i));
        fputc(',', out);
    }
    if (done)
        fprintf(out, "%s,%s,\n", number_text(pair.ez).text, number_text(pair.ex).text);
    else
        fprintf(out, ",,%s\n", good ? "a value is out of its range" : "a cell is no number");
    return done;
}

static int query_many(const struct table_settings *s, struct query *q)
{
    struct rst_csv *csv;
    restitute_error error;
    struct reason why;
    struct output output;
    int column[2];
    size_t failed = 0, beyond = 0;
    if (rst_csv_read(s->text[TABLE_INPUT], RST_BYTES_OF_TABLE, &csv, &error) < 0) return complain("%s", error.message);
    bool good = find_columns(csv, column, &why) && check_places(s, &why) &&
                output_open(s->text[TABLE_OUTPUT], &output, &why);
    if (good) {
        for (size_t i = 0; i < rst_csv_columns(csv); i++) {
            cell_write(output.stream, rst_csv_name(csv, i));
            fputc(',', output.stream);
        }
        fputs("ez,ex,status\n", output.stream);
        for (size_t row = 0; row < rst_csv_rows(csv); row++) {
            const bool done = answer_row(q, csv, row, column, output.stream);
            failed += !done;
            beyond += done && outside(q);
        }
        good = output_finish(&output, &why);
    }
    rst_csv_destroy(csv);
    if (!good) return complain("%s", why.text);
    warn(q);
    if (beyond) complain("warning: rows outside the table's ranges, whose ends are taken: %zu", beyond);
    return failed ? EXIT_SOME_FAILED : EXIT_DONE;
}

int table_query_run(const struct table_settings *settings)
{
    struct reason why;
    struct query q = {.table = read_table(settings)};
    if (!q.table) return EXIT_USAGE;
    restitute_table_info_init(&q.info);
    restitute_table_describe(q.table, &q.info, NULL);
    const int status = !check_query(settings, &why)  ? complain("%s", why.text)
                       : settings->text[TABLE_INPUT] ? query_many(settings, &q)
                                                     : query_one(settings, &q);
    restitute_table_destroy((restitute_table *)q.table);
    return status;
}
