/* Result rows.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "files/number.h"
#include "provenance.h"

/* What is written behind the inputs, and what a number that is read back must be: the least, the most, the same in
 * words. */
static const struct {
    const char *name;
    double low, high;
    const char *range;
} result_columns[ROW_NUMBERS + 2] = {{"ez", 0, 1, "must be in [0, 1]"},
                                     {"ex", -1, 1, "must be in [-1, 1]"},
                                     {"contact_time", 0, INFINITY, "must be >= 0 (inf: no rebound)"},
                                     {"max_indentation", 0, INFINITY, "must be >= 0"},
                                     {"error_ez", 0, INFINITY, "must be >= 0"},
                                     {"error_ex", 0, INFINITY, "must be >= 0"},
                                     {.name = "method"},
                                     {.name = "status"}};

const char *row_column_name(const struct cases *cases, size_t column)
{
    return column < cases->columns ? cases_name(cases, column) : result_columns[column - cases->columns].name;
}

void rows_release(struct row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++)
        free(rows[i].status);
    free(rows);
}

/* A remark of the solver, and the names of the model limits that are passed: "text; FAST LARGE_CONTACT". */
static char *remark(int status, int flags)
{
    char text[400] = "";
    size_t used = 0;
    if (status != RESTITUTE_OK)
        used = (size_t)snprintf(text, sizeof text, "%s%s", restitute_status_text(status), flags ? "; " : "");
    const char *separator = "";
#define NAME_OF(name, bit, words)                                                                                      \
    if (flags & (bit)) {                                                                                               \
        used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", separator, #name);                           \
        separator = " ";                                                                                               \
    }
    RESTITUTE_FLAG_LIST(NAME_OF)
#undef NAME_OF
    return copy_of(text);
}

void row_from_result(int status, const restitute_result *result, struct row *row)
{
    const double number[ROW_NUMBERS] = {
        result->ez, result->ex, result->contact_time, result->max_indentation, result->error_ez, result->error_ex};
    row->solved = true;
    memcpy(row->number, number, sizeof number);
    row->method = result->method;
    row->status = remark(status, result->flags);
}

/* The rows that are impacts, as the library takes them; all are of one kind (cases_check). */
struct chunk {
    size_t n;
    bool physical;
    size_t *index; /* of the row */
    restitute_impact *impacts;
    restitute_scene *scenes;
    restitute_result *results;
    int *statuses;
};

static struct chunk chunk_new(size_t capacity)
{
    return (struct chunk){.index = allocate(capacity, sizeof(size_t)),
                          .impacts = allocate(capacity, sizeof(restitute_impact)),
                          .scenes = allocate(capacity, sizeof(restitute_scene)),
                          .results = allocate(capacity, sizeof(restitute_result)),
                          .statuses = allocate(capacity, sizeof(int))};
}

static void chunk_release(struct chunk *chunk)
{
    free(chunk->index);
    free(chunk->impacts);
    free(chunk->scenes);
    free(chunk->results);
    free(chunk->statuses);
}

static void chunk_add(struct chunk *chunk, size_t index, const struct problem *problem)
{
    const size_t n = chunk->n++;
    chunk->physical = problem->physical;
    chunk->index[n] = index;
    chunk->impacts[n] = problem->impact;
    chunk->scenes[n] = problem->scene;
    chunk->statuses[n] = RESTITUTE_ERROR_MEMORY; /* as long as nobody has solved it */
    restitute_result_init(&chunk->results[n]);
}

static void chunk_solve(struct chunk *chunk, const struct settings *settings)
{
    if (chunk->physical)
        restitute_solve_scene_many(chunk->n, chunk->scenes, &settings->solver, chunk->results, chunk->statuses, NULL);
    else
        restitute_solve_many(chunk->n, chunk->impacts, &settings->solver, chunk->results, chunk->statuses, NULL);
}

/* A row that failed among the others is solved by itself: the batch tells a status a row, this tells why. */
static void take_solution(const struct chunk *chunk, size_t n, restitute_solver *solver, struct row *row)
{
    const struct problem problem = {
        .physical = chunk->physical, .impact = chunk->impacts[n], .scene = chunk->scenes[n]};
    int status = chunk->statuses[n];
    restitute_error error;
    if (status < 0) status = problem_solve(solver, &problem, &chunk->results[n], NULL, NULL, &error);
    if (status < 0)
        row->status = copy_of(error.message);
    else
        row_from_result(status, &chunk->results[n], row);
}

/* Files are read and messages made by this thread alone; the library's threads see finished impacts. */
void rows_solve(const struct cases *cases, const struct settings *settings, struct materials *materials,
                restitute_solver *solver, size_t first, size_t count, struct row *rows)
{
    struct chunk chunk = chunk_new(count);
    for (size_t i = first; i < first + count; i++) {
        struct values values;
        struct problem problem;
        struct reason why;
        memset(&rows[i], 0, sizeof rows[i]);
        if (cases_values(cases, settings, i, &values, &why) &&
            problem_build(&values, NAME_COLUMNS, materials, &problem, &why))
            chunk_add(&chunk, i, &problem);
        else
            rows[i].status = copy_of(why.text);
    }
    chunk_solve(&chunk, settings);
    for (size_t n = 0; n < chunk.n; n++)
        take_solution(&chunk, n, solver, &rows[chunk.index[n]]);
    chunk_release(&chunk);
}

void cell_write(FILE *stream, const char *cell)
{
    const size_t length = strlen(cell);
    const bool spaced = length && (strchr(" \t", cell[0]) || strchr(" \t", cell[length - 1]));
    if (!spaced && cell[0] != '#' && !strpbrk(cell, ",\"\r\n")) {
        fputs(cell, stream);
        return;
    }
    fputc('"', stream);
    for (; *cell; cell++) {
        if (*cell == '"') fputc('"', stream);
        fputc(*cell, stream);
    }
    fputc('"', stream);
}

void row_write_result_names(FILE *stream)
{
    for (int i = 0; i < ROW_NUMBERS; i++)
        fprintf(stream, "%s,", result_columns[i].name);
    fputs("method,status\n", stream);
}

void row_write_result(FILE *stream, const struct row *row)
{
    for (int i = 0; i < ROW_NUMBERS; i++)
        fprintf(stream, "%s,", row->solved ? number_text(row->number[i]).text : "");
    fprintf(stream, "%s,", row->solved ? row->method : "");
    cell_write(stream, row->status);
    fputc('\n', stream);
}

void row_write_header(FILE *stream, const struct cases *cases)
{
    for (size_t i = 0; i < cases->columns; i++) {
        cell_write(stream, cases_name(cases, i));
        fputc(',', stream);
    }
    row_write_result_names(stream);
}

void row_write(FILE *stream, const struct cases *cases, size_t index, const struct row *row)
{
    for (size_t i = 0; i < cases->columns; i++) {
        cell_write(stream, cases_cell(cases, index, i));
        fputc(',', stream);
    }
    row_write_result(stream, row);
}

/* A number of a row that is solved; a row that is not has none. */
static bool read_number(const char *cell, size_t column, bool solved, double *number, struct reason *why)
{
    const double low = result_columns[column].low, high = result_columns[column].high;
    const bool good =
        solved ? rst_number_read(cell, number) == RESTITUTE_OK && *number >= low && *number <= high : !*cell;
    return good || refuse(why, "%s = \"%.64s\": %s", result_columns[column].name, cell,
                          solved ? result_columns[column].range : "must be empty, since method is empty");
}

bool row_read(const struct rst_csv *csv, size_t index, size_t first, const restitute_method *method, struct row *row,
              struct reason *why)
{
    const char *method_cell = rst_csv_cell(csv, index, first + ROW_NUMBERS);
    const char *status = rst_csv_cell(csv, index, first + ROW_NUMBERS + 1);
    row->solved = *method_cell != '\0';
    row->method = restitute_method_name(method);
    if (row->solved && strcmp(method_cell, row->method) != 0)
        return refuse(why, "method = \"%.64s\": must be %s", method_cell, row->method);
    if (!row->solved && !*status) return refuse(why, "method and status are empty: neither solved nor failed");
    for (size_t i = 0; i < ROW_NUMBERS; i++)
        if (!read_number(rst_csv_cell(csv, index, first + i), i, row->solved, &row->number[i], why)) return false;
    row->status = copy_of(status);
    return true;
}

json_t *row_json(const struct cases *cases, size_t index, const struct row *row)
{
    json_t *object = json_object();
    for (size_t i = 0; i < cases->columns; i++) {
        const char *cell = cases_cell(cases, index, i);
        double number;
        json_t *value = rst_number_read(cell, &number) == RESTITUTE_OK ? json_of_number(number) : json_string(cell);
        json_object_set_new(object, cases_name(cases, i), value ? value : json_null());
    }
    for (int i = 0; i < ROW_NUMBERS; i++)
        json_object_set_new(object, result_columns[i].name, row->solved ? json_of_number(row->number[i]) : json_null());
    json_object_set_new(object, "method", row->solved ? json_string(row->method) : json_null());
    json_t *status = json_string(row->status);
    json_object_set_new(object, "status", status ? status : json_string("failed"));
    return object;
}

json_t *row_units(const struct cases *cases, bool physical)
{
    json_t *units = json_object();
    for (size_t i = 0; cases && i < cases->columns; i++) {
        const enum field field = field_of_column(cases_name(cases, i));
        if (field < FIELD_COUNT) json_object_set_new(units, cases_name(cases, i), json_string(field_rules[field].unit));
    }
    for (int i = 0; i < ROW_NUMBERS; i++)
        json_object_set_new(units, result_columns[i].name, json_string("1"));
    json_object_set_new(units, result_columns[ROW_CONTACT_TIME].name, json_string(physical ? "s" : "T"));
    json_object_set_new(units, result_columns[ROW_MAX_INDENTATION].name, json_string(physical ? "m" : "d0"));
    return units;
}
