/* Room for Prony terms, and the checks on terms from any file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "files/prony_terms.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/report.h"

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
