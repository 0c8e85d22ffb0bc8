/* The history of an impact by the method cvode: the run once more, sampled evenly by CVODE's own
 * interpolation.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "base/report.h"
#include "cvode/elements.h"
#include "cvode/solve.h"

struct recorder {
    struct rst_history *history;
    double interval, end;
};

static void keep(struct run *run, double t, const double *y)
{
    struct rst_history *history = ((const struct recorder *)run->observer)->history;
    const double force = run->setup->problem->mode == RST_FRICTIONLESS ? 0
                         : run->shears                                 ? run->sums.force
                                                                       : run->contact.force;
    history->samples[history->count++] =
        (struct rst_sample){.time = t,
                            .indentation = y[0],
                            .contact_radius = run->contact.radius,
                            .stick_radius = rst_run_stick_radius(run),
                            .normal_force = run->contact.force,
                            .shear_force = force,
                            .velocity = y[1],
                            .shear_velocity = rst_run_shear_velocity(run, y) / run->setup->problem->shear_speed};
}

static void sample(struct run *run)
{
    const struct recorder *recorder = run->observer;
    struct rst_history *history = recorder->history;
    while (history->count + 1 < history->capacity) {
        const double t = (double)history->count * recorder->interval;
        const double *y;
        if (t > run->time || rst_run_look(run, t, &y)) return;
        keep(run, t, y);
    }
}

int rst_cvode_record(const struct rst_problem *problem, struct cvode_memory *memory, const struct rst_outcome *outcome,
                     struct rst_history *history, restitute_error *error)
{
    struct run_setup setup = rst_cvode_setup(problem);
    struct recorder recorder = {.history = history};
    struct run run = {.sample = sample, .observer = &recorder};
    const double *y;
    recorder.end = outcome->followed_time;
    recorder.interval = recorder.end / (double)(history->capacity - 1);
    setup.n_nodes = outcome->elements > 0 ? outcome->elements : 2;
    setup.radius = outcome->max_contact_radius;
    setup.rebound = -outcome->velocity;
    setup.budget = INT64_MAX;
    setup.until = INFINITY;
    history->samples[0] = (struct rst_sample){.velocity = 1, .shear_velocity = 1};
    history->count = 1;
    const int status = rst_run_follow(&run, &setup, &memory->trace, NULL);
    if (!status && rst_run_look(&run, run.time, &y) == 0) keep(&run, run.time, y);
    rst_run_release(&run);
    return status ? rst_report(error, status, "%s", run.text) : RESTITUTE_OK;
}
