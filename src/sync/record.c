/* The history of an impact by the method `sync`: the polynomials of the run that gave the pair,
 * sampled.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sync/record.h"

#include <math.h>

#include "base/gross_slip.h"
#include "base/status.h"
#include "sync/tuning.h"
#include "sync/walk.h"

/* The tangential side: pieces, or where elements were stepped their levels, or gross slip alone. */
struct trace {
    const struct rst_problem *problem;
    const struct sync_normal *normal;
    const struct sync_store *store; /* NULL: not by pieces */
    const struct rst_walk *walk;    /* NULL: not by elements */
};

/* Where on a panel the time is: time rises with x. */
static double place_of(const struct sync_panel *panel, double time)
{
    double low = 0, high = 1, weight[rst_points];
    if (time <= panel->time[0]) return 0;
    if (time >= panel->time[rst_stages]) return 1;
    for (int i = 0; high - low > rst_place_found && i < rst_most_bisections; i++) {
        const double x = 0.5 * (low + high);
        rst_sync_weights_at(x, weight);
        if (rst_value_of(weight, panel->time) < time)
            low = x;
        else
            high = x;
    }
    return 0.5 * (low + high);
}

/* Slip before it sticks, or to the end. */
static void slide(const struct rst_problem *problem, struct rst_sample *sample)
{
    sample->stick_radius = 0;
    sample->shear_force = problem->mode == RST_FRICTIONLESS ? 0 : sample->normal_force;
    sample->shear_velocity = rst_slipping_velocity(problem, sample->velocity);
}

static void follow_pieces(const struct trace *trace, int64_t panel, double x, int64_t *at, struct rst_sample *sample)
{
    const struct sync_store *store = trace->store;
    while (*at + 1 < store->n_pieces && (store->piece[*at].panel < panel + 1 ||
                                         (store->piece[*at].panel == panel + 1 && store->piece[*at].to < x)))
        ++*at;
    const struct sync_piece *piece = &store->piece[*at];
    if (store->n_pieces == 0 || piece->panel > panel + 1 || (piece->panel == panel + 1 && x < piece->from)) {
        slide(trace->problem, sample);
        return;
    }
    double weight[rst_points], y = (x - piece->from) / (piece->to - piece->from);
    if (piece->rooted) y = 1 - sqrt(fmax(0, 1 - y));
    rst_sync_weights_at(fmin(1, fmax(0, y)), weight);
    sample->shear_velocity = rst_value_of(weight, piece->shear_velocity);
    sample->shear_force = rst_value_of(weight, piece->shear_force);
    sample->stick_radius = fmin(sample->contact_radius, fmax(0, rst_value_of(weight, piece->stick_radius)));
}

/* Between levels U' is a line. The walk does not say where the front is: the stick radius is 0
 * where all slips. */
static void follow_walk(const struct trace *trace, int64_t *at, struct rst_sample *sample)
{
    const struct rst_walk *walk = trace->walk;
    while (*at + 2 <= 2 * walk->n && walk->time[*at + 1] <= sample->time)
        ++*at;
    const double h = walk->time[*at + 1] - walk->time[*at];
    const double share = h > 0 ? fmin(1, fmax(0, (sample->time - walk->time[*at]) / h)) : 0;
    const struct walk_shear *s = &walk->shear[*at];
    sample->shear_velocity = s[0].velocity + share * (s[1].velocity - s[0].velocity);
    sample->shear_force = (s[0].force + share * (s[1].force - s[0].force));
    sample->stick_radius = 0;
}

static void sample_at(const struct trace *trace, double time, int64_t *p, int64_t *at, struct rst_sample *sample)
{
    const struct sync_normal *normal = trace->normal;
    double weight[rst_points];
    while (*p + 1 < normal->n_panels && normal->panel[*p].time[rst_stages] < time)
        ++*p;
    const struct sync_panel *panel = &normal->panel[*p];
    const double x = place_of(panel, time);
    rst_sync_weights_at(x, weight);
    *sample = (struct rst_sample){.time = time,
                                  .indentation = rst_value_of(weight, panel->depth),
                                  .contact_radius = fmax(0, rst_value_of(weight, panel->radius)),
                                  .normal_force = fmax(0, rst_value_of(weight, panel->force)),
                                  .velocity = rst_value_of(weight, panel->velocity)};
    if (trace->store)
        follow_pieces(trace, *p, x, at, sample);
    else if (trace->walk)
        follow_walk(trace, at, sample);
    else
        slide(trace->problem, sample);
    if (trace->problem->mode == RST_NO_SLIP) {
        sample->stick_radius = sample->contact_radius;
        return;
    }
    sample->shear_force = fmax(-sample->normal_force, fmin(sample->normal_force, sample->shear_force));
}

int rst_motion_record(const struct rst_problem *problem, struct rst_workspace *workspace,
                    const struct rst_outcome *outcome, struct rst_history *history, restitute_error *error)
{
    struct rst_motion *motion = rst_motion_of(workspace);
    struct rst_walk walk;
    double velocity;
    int64_t p = 0, at = 0, found = RST_SOLVED;
    if (outcome->sunk) { /* no end of contact that samples could be spread to: first touch alone */
        history->samples[0] = (struct rst_sample){.velocity = 1, .shear_velocity = 1};
        history->count = 1;
        return RESTITUTE_OK;
    }
    const struct rst_run *run = &motion->run[outcome->halvings];
    struct trace trace = {.problem = problem, .normal = &run->normal};
    const int slides = rst_never_sticks(problem, -outcome->velocity);
    if (!slides && outcome->walked > 0) {
        if (rst_walk(motion, run, problem, 1, outcome->walked, 0, &walk))
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for elements");
        trace.walk = &walk;
    } else if (!slides) {
        if (rst_motion_contact(motion, run, problem, outcome->halvings, INT64_MAX, &velocity, &found))
            return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for pieces");
        trace.store = &motion->store;
    }
    const double end = run->normal.panel[run->normal.n_panels - 1].time[rst_stages];
    for (size_t k = 0; k < history->capacity; k++) {
        const double share = (double)k / (double)(history->capacity - 1);
        sample_at(&trace, share * end, &p, &at, &history->samples[k]);
        history->samples[k].shear_velocity /= problem->shear_speed;
    }
    history->count = history->capacity;
    return RESTITUTE_OK;
}
