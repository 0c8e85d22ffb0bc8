/* Prony terms from a CSV file, and the checks on terms from any file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "files/prony_terms.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/report.h"
#include "files/csv_table.h"
#include "files/file_text.h"
#include "files/number.h"

int rst_prony_terms_allocate(size_t count, struct prony_terms *terms, restitute_error *error)
{
    const struct prony_terms fresh = {count, calloc(count + 1, sizeof(double)), calloc(count + 1, sizeof(double)),
                                      calloc(count + 1, sizeof(size_t))};
    *terms = fresh;
    if (fresh.relaxation_time && fresh.modulus && fresh.line) return RESTITUTE_OK;
    rst_prony_terms_release(terms);
    return rst_report(error, RESTITUTE_ERROR_MEMORY, "no memory for %zu Prony terms", count);
}

void rst_prony_terms_release(struct prony_terms *terms)
{
    free(terms->relaxation_time);
    free(terms->modulus);
    free(terms->line);
    *terms = (struct prony_terms){0, NULL, NULL, NULL};
}

/* A relaxation time and the line it stands in, for sorting. */
struct timed_line {
    double time;
    size_t line;
};

static int by_time(const void *left, const void *right)
{
    const struct timed_line *a = left, *b = right;
    if (a->time != b->time) return a->time < b->time ? -1 : 1;
    return (a->line > b->line) - (a->line < b->line);
}

static int check_distinct(const struct prony_terms *terms, const char *file, const char *time_key,
                          restitute_error *error)
{
    struct timed_line *sorted = malloc((terms->count + 1) * sizeof *sorted);
    if (!sorted)
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "%s: no memory for %zu Prony terms", file, terms->count);
    for (size_t i = 0; i < terms->count; i++)
        sorted[i] = (struct timed_line){terms->relaxation_time[i], terms->line[i]};
    qsort(sorted, terms->count, sizeof *sorted, by_time);
    int status = RESTITUTE_OK;
    for (size_t i = 1; i < terms->count && status == RESTITUTE_OK; i++)
        if (sorted[i].time == sorted[i - 1].time)
            status =
                rst_report(error, RESTITUTE_ERROR_DOMAIN,
                           "%s line %zu: %s = %.15g stands in line %zu too: no two terms may have one relaxation time",
                           file, sorted[i].line, time_key, sorted[i].time, sorted[i - 1].line);
    free(sorted);
    return status;
}

int rst_prony_terms_check(const struct prony_terms *terms, const char *file, const char *time_key,
                          const char *modulus_key, restitute_error *error)
{
    for (size_t i = 0; i < terms->count; i++) {
        const double value[2] = {terms->relaxation_time[i], terms->modulus[i]};
        const char *key[2] = {time_key, modulus_key};
        for (int k = 0; k < 2; k++)
            if (!(value[k] > 0 && isfinite(value[k])))
                return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s line %zu: %s = %.15g: must be finite and > 0",
                                  file, terms->line[i], key[k], value[k]);
    }
    return check_distinct(terms, file, time_key, error);
}

/* Exactly the two columns, in any order. */
static int find_columns(const struct rst_csv *csv, const char *file, size_t column[2], restitute_error *error)
{
    static const char *const names[2] = {"tau_s", "G_Pa"};
    int found[2] = {0, 0};
    for (size_t i = 0; i < rst_csv_columns(csv); i++) {
        const char *name = rst_csv_name(csv, i);
        const int which = strcmp(name, names[0]) == 0 ? 0 : strcmp(name, names[1]) == 0 ? 1 : -1;
        if (strpbrk(name, ";\t"))
            return rst_report(error, RESTITUTE_ERROR_FORMAT,
                              "%s: the column names are separated by %s: must be by commas, tau_s,G_Pa", file,
                              strchr(name, ';') ? "semicolons" : "tabs");
        if (which < 0)
            return rst_report(error, RESTITUTE_ERROR_FORMAT,
                              "%s: unknown column %.64s; a Prony table has tau_s and G_Pa", file, name);
        column[which] = i;
        found[which] = 1;
    }
    for (int k = 0; k < 2; k++)
        if (!found[k])
            return rst_report(error, RESTITUTE_ERROR_FORMAT, "%s: no column %s; a Prony table has tau_s and G_Pa", file,
                              names[k]);
    return RESTITUTE_OK;
}

static int read_cell(const struct rst_csv *csv, const char *file, size_t row, size_t column, double *value,
                     restitute_error *error)
{
    const char *cell = rst_csv_cell(csv, row, column);
    const int status = rst_number_read(cell, value);
    if (status == RESTITUTE_OK) return status;
    return rst_report(error, status, "%s line %zu: %s = \"%.64s\": must be a finite number > 0", file,
                      rst_csv_line(csv, row), rst_csv_name(csv, column), cell);
}

static int terms_from_table(const struct rst_csv *csv, const char *file, struct prony_terms *terms,
                            restitute_error *error)
{
    size_t column[2] = {0, 0};
    int status = find_columns(csv, file, column, error);
    if (status == RESTITUTE_OK && rst_csv_rows(csv) == 0)
        status = rst_report(error, RESTITUTE_ERROR_FORMAT, "%s: has column names but no rows", file);
    if (status == RESTITUTE_OK) status = rst_prony_terms_allocate(rst_csv_rows(csv), terms, error);
    if (status != RESTITUTE_OK) return status;
    for (size_t i = 0; i < terms->count && status == RESTITUTE_OK; i++) {
        terms->line[i] = rst_csv_line(csv, i);
        status = read_cell(csv, file, i, column[0], &terms->relaxation_time[i], error);
        if (status == RESTITUTE_OK) status = read_cell(csv, file, i, column[1], &terms->modulus[i], error);
    }
    if (status == RESTITUTE_OK) status = rst_prony_terms_check(terms, file, "tau_s", "G_Pa", error);
    if (status != RESTITUTE_OK) rst_prony_terms_release(terms);
    return status;
}

int rst_prony_terms_read_csv(const char *path, struct prony_terms *terms, uint64_t *fingerprint, restitute_error *error)
{
    struct rst_csv *csv;
    int status = rst_csv_read(path, RST_BYTES_OF_MATERIAL, &csv, error);
    if (status != RESTITUTE_OK) return status;
    status = terms_from_table(csv, rst_file_name_for_message(path), terms, error);
    *fingerprint = rst_csv_fingerprint(csv);
    rst_csv_destroy(csv);
    return status;
}
