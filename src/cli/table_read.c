/* `restitute table info`, `query` and `export`: what a table file holds.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <restitute/files.h>

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

/* The output of `query` or `export`: a place that can be written, and neither the table nor the
 * cases. */
static bool check_places(const struct table_settings *settings, struct reason *why)
{
    struct places places = {0};
    places_read(&places, "the table", settings->file);
    places_read(&places, "--input", settings->text[TABLE_INPUT]);
    places_write(&places, "--output", settings->text[TABLE_OUTPUT]);
    return places_check(&places, why) && output_check(settings->text[TABLE_OUTPUT], "--output", why);
}

/* ---- info */

static void print_range(const char *name, const double range[2], const char *unit)
{
    if (isnan(range[0])) return;
    if (range[0] == range[1])
        printf("%-16s %.6g%s\n", name, range[0], unit);
    else
        printf("%-16s %.6g to %.6g%s\n", name, range[0], range[1], unit);
}

static void print_nodes(const restitute_table_info *i, int64_t rebound_cells)
{
    if (rebound_cells > 0)
        printf("%-16s %lld of ex, %lld of ez; %.3g MB\n", "cells", (long long)i->nodes[0], (long long)rebound_cells,
               (double)i->bytes / 1e6);
    else
        printf("%-16s %lld %s, %lld gamma, %lld chi, %lld psi; %.3g MB\n", "nodes", (long long)i->nodes[0],
               i->of_contact ? "speed" : "delta1", (long long)i->nodes[1], (long long)i->nodes[2],
               (long long)i->nodes[3], (double)i->bytes / 1e6);
}

static void print_info(const restitute_table_info *i, int64_t rebound_cells)
{
    printf("%-16s %s\n", "kind", i->of_contact ? "one contact" : "ranges");
    print_range("speed", i->speed, " m/s");
    print_range("chi", i->chi, "");
    print_range("delta1", i->delta1, "");
    print_range("gamma", i->gamma, "");
    if (i->of_contact)
        printf("%-16s %g\n%-16s %g m, %g kg (effective)\n", "friction", i->friction, "radius, mass", i->radius,
               i->mass);
    printf("%-16s %g\n", "tolerance", i->tolerance);
    printf("%-16s %.2g (ez), %.2g (ex), verified at %lld points\n", "error", i->error_ez, i->error_ex,
           (long long)i->checks);
    printf("%-16s %lld\n", "impacts solved", (long long)i->impacts);
    print_nodes(i, rebound_cells);
    char version[4 * sizeof i->version];
    snprintf(version, sizeof version, "%s", i->version);
    escape(version, sizeof version);
    printf("%-16s %s\n", "built by", version);
}

static json_t *json_of_range(const double range[2])
{
    return json_pack("[o, o]", json_of_number(range[0]), json_of_number(range[1]));
}

static json_t *json_of_info(const restitute_table_info *i, int64_t rebound_cells)
{
    json_t *object =
        json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "kind", i->of_contact ? "contact" : "ranges", "speed_m_s",
                  json_of_range(i->speed), "chi", json_of_range(i->chi), "delta1", json_of_range(i->delta1), "gamma",
                  json_of_range(i->gamma), "friction", json_of_number(i->friction), "radius_m",
                  json_of_number(i->radius), "mass_kg", json_of_number(i->mass));
    json_object_set_new(object, "tolerance", json_of_number(i->tolerance));
    json_object_set_new(object, "error_ez", json_of_number(i->error_ez));
    json_object_set_new(object, "error_ex", json_of_number(i->error_ex));
    json_object_set_new(object, "impacts", json_integer(i->impacts));
    json_object_set_new(object, "checks", json_integer(i->checks));
    json_t *nodes = json_array();
    for (int k = 0; k < 4; k++)
        json_array_append_new(nodes, json_integer(i->nodes[k]));
    json_object_set_new(object, "nodes", nodes);
    if (rebound_cells > 0)
        json_object_set_new(object, "cells",
                            json_pack("{s:I, s:I}", "ex", (json_int_t)i->nodes[0], "ez", (json_int_t)rebound_cells));
    json_object_set_new(object, "bytes", json_integer((json_int_t)i->bytes));
    json_object_set_new(object, "version", json_string(i->version));
    return object;
}

int table_info_run(const struct table_settings *settings)
{
    const char *format = settings->text[TABLE_FORMAT] ? settings->text[TABLE_FORMAT] : "text";
    struct reason why;
    restitute_table_info info;
    restitute_table_data data;
    if (strcmp(format, "text") != 0 && strcmp(format, "json") != 0)
        return complain("--format = \"%.64s\": must be text or json", format);
    restitute_table *table = read_table(settings);
    if (!table) return EXIT_USAGE;
    restitute_table_info_init(&info);
    restitute_table_describe(table, &info, NULL);
    restitute_table_data_init(&data);
    restitute_table_to_data(table, &data, NULL);
    const int64_t rebound_cells = data.rebound_cells; /* 0 without cells */
    restitute_table_destroy(table);
    if (*format == 't')
        print_info(&info, rebound_cells);
    else if (!provenance_write(NULL, json_of_info(&info, rebound_cells), &why))
        return complain("%s", why.text);
    return EXIT_DONE;
}

/* ---- query */

/* What a row gives: speeds, or numbers. */
struct query {
    const restitute_table *table;
    restitute_table_info info;
    double value[4];
};
static const char *const speed_columns[] = {"normal_speed_m_s", "tangential_speed_m_s"};
static const char *const number_columns[] = {"chi", "psi", "delta1", "gamma"};

static int look_up(const struct query *q, restitute_table_value *pair)
{
    if (q->info.of_contact) return restitute_table_pair(q->table, q->value[0], q->value[1], pair);
    return restitute_table_numbers_pair(q->table, q->value[0], q->value[1], q->value[2], q->value[3], pair);
}

static void set_defaults(struct query *q)
{
    const restitute_table_info *i = &q->info;
    const double speeds[4] = {NAN, 0, 0, 0}, numbers[4] = {i->chi[0], NAN, i->delta1[0], i->gamma[0]};
    memcpy(q->value, i->of_contact ? speeds : numbers, sizeof q->value);
}

static const enum table_text speed_options[] = {TABLE_NORMAL_SPEED, TABLE_TANGENTIAL_SPEED};
static const enum table_text number_options[] = {TABLE_CHI, TABLE_PSI, TABLE_DELTA1, TABLE_GAMMA};

/* The name of the first value that lies outside the table, which takes it as the end; NULL: none does. An elastic
 * table is the same for all speeds, or all delta1 and gamma. */
static const char *outside(const struct query *q)
{
    const restitute_table_info *i = &q->info;
    const bool elastic = !i->of_contact && (i->delta1[0] == 0 || isinf(i->gamma[0]));
    const double *const speeds[4] = {i->nodes[0] > 1 ? i->speed : NULL, NULL, NULL, NULL};
    const double *const numbers[4] = {i->chi, NULL, elastic ? NULL : i->delta1, elastic ? NULL : i->gamma};
    for (int k = 0; k < 4; k++) {
        const double *range = i->of_contact ? speeds[k] : numbers[k];
        if (range && (q->value[k] < range[0] || q->value[k] > range[1]))
            return i->of_contact ? speed_columns[k] : number_columns[k];
    }
    return NULL;
}

/* Options that the table, or --input, has no use for. */
static bool check_query(const struct table_settings *s, const struct query *q, struct reason *why)
{
    const bool contact = q->info.of_contact;
    for (int i = 0; i < (contact ? 4 : 2); i++)
        if (s->text[contact ? number_options[i] : speed_options[i]])
            return refuse(why, "--%s: not for a table of %s",
                          table_text_names[contact ? number_options[i] : speed_options[i]],
                          contact ? "one contact, which is asked by --normal-speed and --tangential-speed"
                                  : "ranges, which is asked by --chi, --psi, --delta1 and --gamma");
    for (int i = 0; s->text[TABLE_INPUT] && i < (contact ? 2 : 4); i++)
        if (s->text[contact ? speed_options[i] : number_options[i]])
            return refuse(why, "--%s: not with --input, whose columns give the values",
                          table_text_names[contact ? speed_options[i] : number_options[i]]);
    const char *format = s->text[TABLE_FORMAT];
    if (!format || strcmp(format, "csv") == 0) return true;
    if (strcmp(format, "text") != 0) return refuse(why, "--format = \"%.64s\": must be text or csv", format);
    return s->text[TABLE_INPUT] ? refuse(why, "--format = text: not with --input, which gives csv") : true;
}

static bool find_one(const struct table_settings *s, struct query *q, restitute_table_value *pair, struct reason *why)
{
    const bool contact = q->info.of_contact;
    for (int i = 0; i < (contact ? 2 : 4); i++)
        if (!table_number(s, contact ? speed_options[i] : number_options[i], contact && i == 1 ? -1e300 : 0,
                          contact ? 1e300 : INFINITY, &q->value[i], why))
            return false;
    if (isnan(q->value[contact ? 0 : 1])) return refuse(why, "--%s is missing", contact ? "normal-speed" : "psi");
    return look_up(q, pair) >= 0 ? true : refuse(why, "the table has no answer to this");
}

static int query_one(const struct table_settings *s, struct query *q)
{
    struct reason why;
    struct output output;
    restitute_table_value pair;
    const bool csv = s->text[TABLE_FORMAT] && strcmp(s->text[TABLE_FORMAT], "csv") == 0;
    if (!find_one(s, q, &pair, &why) || !check_places(s, &why) || !output_open(s->text[TABLE_OUTPUT], &output, &why))
        return complain("%s", why.text);
    fprintf(output.stream, csv ? "ez,ex\n%s," : "ez = %s\n", number_text(pair.ez).text);
    fprintf(output.stream, csv ? "%s\n" : "ex = %s\n", number_text(pair.ex).text);
    if (!output_finish(&output, &why)) return complain("%s", why.text);
    const char *name = outside(q);
    if (name) complain("warning: %s is outside the table's range: its end is taken", name);
    return EXIT_DONE;
}

/* Which column of the file gives which value; -1: the default. */
static bool find_columns(const struct query *q, const restitute_csv *csv, int column[4], struct reason *why)
{
    const int n = q->info.of_contact ? 2 : 4;
    const char *const *names = q->info.of_contact ? speed_columns : number_columns;
    for (int k = 0; k < 4; k++)
        column[k] = -1;
    for (size_t i = 0; i < restitute_csv_columns(csv); i++)
        for (int k = 0; k < n; k++)
            if (strcmp(restitute_csv_name(csv, i), names[k]) == 0) column[k] = (int)i;
    const int needed = q->info.of_contact ? 0 : 1;
    if (column[needed] < 0) return refuse(why, "the column %s is missing", names[needed]);
    return true;
}

/* One row: the values, and what came of them. */
static bool answer_row(struct query *q, const restitute_csv *csv, size_t row, const int column[4], FILE *out)
{
    restitute_table_value pair = {NAN, NAN};
    bool good = true;
    set_defaults(q);
    for (int k = 0; k < 4; k++)
        if (column[k] >= 0)
            good &=
                restitute_number_read(restitute_csv_cell(csv, row, (size_t)column[k]), &q->value[k]) == RESTITUTE_OK;
    const bool done = good && look_up(q, &pair) == RESTITUTE_OK;
    for (size_t i = 0; i < restitute_csv_columns(csv); i++) {
        cell_write(out, restitute_csv_cell(csv, row, i));
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
    restitute_csv *csv;
    restitute_error error;
    struct reason why;
    struct output output;
    int column[4];
    size_t failed = 0, beyond = 0;
    if (restitute_csv_read(s->text[TABLE_INPUT], &csv, &error) < 0) return complain("%s", error.message);
    bool good = find_columns(q, csv, column, &why) && check_places(s, &why) &&
                output_open(s->text[TABLE_OUTPUT], &output, &why);
    if (good) {
        for (size_t i = 0; i < restitute_csv_columns(csv); i++) {
            cell_write(output.stream, restitute_csv_name(csv, i));
            fputc(',', output.stream);
        }
        fputs("ez,ex,status\n", output.stream);
        for (size_t row = 0; row < restitute_csv_rows(csv); row++) {
            const bool done = answer_row(q, csv, row, column, output.stream);
            failed += !done;
            beyond += done && outside(q);
        }
        good = output_finish(&output, &why);
    }
    restitute_csv_destroy(csv);
    if (!good) return complain("%s", why.text);
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
    set_defaults(&q);
    const int status = !check_query(settings, &q, &why) ? complain("%s", why.text)
                       : settings->text[TABLE_INPUT]    ? query_many(settings, &q)
                                                        : query_one(settings, &q);
    restitute_table_destroy((restitute_table *)q.table);
    return status;
}

/* ---- export */

/* psi of a node: beyond 1 it is given by y. */
static double psi_of(double place, double chi, double ez)
{
    return place <= 1 ? place : 1 + (place - 1) * (restitute_critical_psi(chi, fmin(1, fmax(0, ez))) - 1);
}

/* ex of a node, as it is kept: the axes go on to the seams around the range asked for, where a lookup would take its
 * end. `node`: of the first two axes. Beyond psi = 1 it is what ex exceeds full slip by that is kept. */
static double stored_ex(const restitute_table_data *d, int64_t node, int64_t k, int64_t l, double chi, double psi)
{
    if (d->psi_factor > 1e300 && d->of_contact) return -1; /* no friction */
    const double kept = d->ex[(node * d->nodes[3] + l) * d->nodes[2] + k];
    const bool slips = d->stick_cells > 0 && l > 3 * d->stick_cells;
    const double ex = slips ? kept + (2 * chi * (1 + fmin(1, fmax(0, d->ez[node]))) / psi - 1) : kept;
    return fmin(1, fmax(-1, ex));
}

static void export_row(FILE *out, const double value[6])
{
    for (int i = 0; i < 6; i++)
        fprintf(out, "%s%c", number_text(value[i]).text, i < 5 ? ',' : '\n');
}

static void export_rows(const restitute_table_data *d, double *const place[4], FILE *out)
{
    for (int64_t i = 0; i < d->nodes[0] * d->nodes[1]; i++)
        for (int64_t k = 0; k < d->nodes[2]; k++)
            for (int64_t l = 0; l < d->nodes[3]; l++) {
                const double chi = place[2][k], psi = psi_of(place[3][l], chi, d->ez[i]);
                const double gamma = d->of_contact ? d->own_gamma : place[1][i % d->nodes[1]];
                const double value[6] = {place[0][i / d->nodes[1]],
                                         gamma,
                                         chi,
                                         d->of_contact && d->psi_factor > 1e300 ? INFINITY : psi,
                                         fmin(1, fmax(0, d->ez[i])),
                                         stored_ex(d, i, k, l, chi, psi)};
                export_row(out, value);
            }
}

static void export_cells(const restitute_table *table, const restitute_table_data *d, FILE *out)
{
    double(*node)[6] = allocate((size_t)d->nodes[1], sizeof *node);
    for (int64_t cell = 0; cell < d->cells; cell++) {
        restitute_table_cell_nodes(table, cell, node);
        for (int64_t i = 0; i < d->nodes[1]; i++)
            export_row(out, node[i]);
    }
    free(node);
}

static void export_dense(const restitute_table *table, const restitute_table_data *d, FILE *out)
{
    double *place[4];
    for (int axis = 0; axis < 4; axis++) {
        place[axis] = allocate((size_t)d->nodes[axis], sizeof *place[axis]);
        restitute_table_nodes(table, axis, place[axis]);
    }
    export_rows(d, place, out);
    for (int axis = 0; axis < 4; axis++)
        free(place[axis]);
}

static void export_table(const restitute_table *table, const restitute_table_data *d, FILE *out)
{
    fprintf(out, "%s,gamma,chi,psi,ez,ex\n", d->of_contact ? "speed_m_s" : "delta1");
    (d->cells > 0 ? export_cells : export_dense)(table, d, out);
}

int table_export_run(const struct table_settings *settings)
{
    struct output output;
    struct reason why;
    restitute_table_data data;
    restitute_table *table = read_table(settings);
    if (!table) return EXIT_USAGE;
    restitute_table_data_init(&data);
    restitute_table_to_data(table, &data, NULL);
    bool good = check_places(settings, &why) && output_open(settings->text[TABLE_OUTPUT], &output, &why);
    if (good) {
        export_table(table, &data, output.stream);
        good = output_finish(&output, &why);
    }
    restitute_table_destroy(table);
    return good ? EXIT_DONE : complain("%s", why.text);
}
