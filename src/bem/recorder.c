/* Snapshots of the fields. The computed quarter is reflected to the whole grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/bem.h>

#include <math.h>
#include <stdlib.h>

#include "base/sized.h"
#include "bem/method.h"

struct snapshot {
    double time, spacing;
    size_t cells;
    double *values; /* pressure, traction, stick */
};

struct restitute_bem_recorder {
    struct bem_method method;
    size_t capacity, count;
    struct snapshot snapshots[];
};

enum { most_snapshots = 1000 };

RST_DEFAULTS(bem_snapshot, 0)

int restitute_bem_recorder_create(size_t count, restitute_bem_recorder **recorder, restitute_error *error)
{
    if (!recorder) return rst_report(error, RESTITUTE_ERROR_NULL, "recorder is NULL");
    if (count < 1 || count > most_snapshots)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "count = %zu: must be in [1, %d]", count, most_snapshots);
    restitute_bem_recorder *r = calloc(1, sizeof *r + count * sizeof *r->snapshots);
    if (!r) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for a recorder");
    r->capacity = count;
    r->method = rst_bem_standard;
    r->method.recorder = r;
    *recorder = r;
    return rst_done(error);
}

void rst_bem_recorder_begin(restitute_bem_recorder *recorder)
{
    for (size_t i = 0; i < recorder->count; i++)
        free(recorder->snapshots[i].values);
    recorder->count = 0;
}

void restitute_bem_recorder_destroy(restitute_bem_recorder *recorder)
{
    if (!recorder) return;
    rst_bem_recorder_begin(recorder);
    free(recorder);
}

const restitute_method *restitute_bem_recorder_method(const restitute_bem_recorder *recorder)
{
    return recorder ? &recorder->method.base : NULL;
}

size_t restitute_bem_recorder_count(const restitute_bem_recorder *recorder)
{
    return recorder ? recorder->count : 0;
}

/* Tractions of the run are times the spacing. */
static void unfold(const struct bem_setup *setup, const struct bem_fields *f, double *values)
{
    const int64_t m = f->m, n = 2 * m;
    const int no_slip = setup->problem->mode == RST_NO_SLIP;
    const double of_traction = setup->problem->shear_scale / setup->spacing;
    for (int64_t j = 0; j < n; j++)
        for (int64_t i = 0; i < n; i++) {
            const int64_t x = i < m ? m - 1 - i : i - m, y = j < m ? m - 1 - j : j - m;
            const double p = f->p[y * m + x], tau = f->tau[y * m + x];
            values[j * n + i] = p / setup->spacing;
            values[n * n + j * n + i] = tau * of_traction;
            values[2 * n * n + j * n + i] = p > 0 && (no_slip || fabs(tau) < p);
        }
}

int rst_bem_recorder_see(restitute_bem_recorder *recorder, const struct bem_setup *setup, int64_t step, int64_t steps,
                         const struct bem_motion *motion, const struct bem_fields *fields)
{
    const size_t cells = 2 * (size_t)fields->m;
    const double wanted = (double)steps * (double)(recorder->count + 1) / (double)(recorder->capacity + 1);
    if (recorder->count == recorder->capacity || (double)step + 0.5 < wanted || step >= steps) return 0;
    struct snapshot *s = &recorder->snapshots[recorder->count];
    *s = (struct snapshot){.time = motion->time, .spacing = setup->spacing, .cells = cells};
    s->values = malloc(3 * cells * cells * sizeof *s->values);
    if (!s->values) return 1;
    unfold(setup, fields, s->values);
    recorder->count++;
    return 0;
}

int restitute_bem_recorder_get(const restitute_bem_recorder *recorder, size_t index, restitute_bem_snapshot *snapshot,
                               restitute_error *error)
{
    if (!recorder || !snapshot)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", recorder ? "snapshot" : "recorder");
    const int status = RST_CHECK(bem_snapshot, snapshot, error);
    if (status) return status;
    if (recorder->count == 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "recorder has no snapshots: restitute_solve makes them with a history");
    if (index >= recorder->count)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "index = %zu: must be below %zu", index, recorder->count);
    const struct snapshot *s = &recorder->snapshots[index];
    const restitute_bem_snapshot own = {.struct_size = sizeof own,
                                        .time = s->time,
                                        .spacing = s->spacing,
                                        .cells = s->cells,
                                        .pressure = s->values,
                                        .traction = s->values + s->cells * s->cells,
                                        .stick = s->values + 2 * s->cells * s->cells};
    RST_GIVE(&own, snapshot);
    return rst_done(error);
}
