/* The history of an impact by the method `sync`: the run once more, sampled between its levels.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "kernels.h"
#include "sync_run.h"

/* A run with what is needed between its levels. */
struct trace {
    struct sync_scene scene;
    struct store store;
    int64_t slides; /* slips before it sticks */
    int64_t n_knots;
    double *rate; /* n + 1 */
    struct sync_knot *knot;
};

static int follow(const struct rst_problem *problem, struct rst_workspace *workspace, const struct rst_outcome *outcome,
                  struct trace *trace, restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    struct store *store = &trace->store;
    double *room;
    const struct rst_outcome finer = rst_sync_with_elements(problem, outcome);
    int status = rst_sync_repeat(problem, workspace, &finer, finer.elements, 1 + sizeof *trace->knot / sizeof(double),
                                 0, store, &room, error);
    if (status) return status;
    trace->scene = rst_sync_scene(problem, store);
    trace->slides = problem->mode == RST_GROSS_SLIP;
    trace->rate = room;
    trace->knot = (struct sync_knot *)(room + store->levels + 1);
    trace->n_knots = 0;
    rst_edge_rates(&trace->scene, s->g, s->tau, store->level, store->trace, trace->rate);
    if (rst_sync_sticks(problem, -outcome->velocity))
        rst_trace_shear(&trace->scene, s->g, s->tau, store->level, store->trace,
                        store->node, store->body, store->beta, store->faded, store->term, &trace->n_knots, trace->knot);
    return RESTITUTE_OK;
}

int rst_sync_record(const struct rst_problem *problem, struct rst_workspace *workspace,
                    const struct rst_outcome *outcome, struct rst_history *history, restitute_error *error)
{
    struct trace trace;
    int64_t l = 0, i = -1;
    if (outcome->sunk) { /* no end of contact that samples could be spread to, and no levels: first touch alone */
        history->samples[0] = (struct rst_sample){.velocity = 1, .shear_velocity = 1};
        history->count = 1;
        return RESTITUTE_OK;
    }
    int status = follow(problem, workspace, outcome, &trace, error);
    if (status) return status;
    const int64_t last_level = 2 * trace.scene.n - 1;
    const double end = trace.store.level[last_level + 1].time; /* the contact time but for what was extrapolated */
    for (size_t k = 0; k < history->capacity; k++) {
        struct rst_sample *sample = &history->samples[k];
        const double share = (double)k / (double)(history->capacity - 1);
        const double time = k + 1 < history->capacity ? share * end : end;
        while (l < last_level && trace.store.level[l + 1].time <= time)
            l++;
        while (i + 2 < trace.n_knots && trace.knot[i + 1].time <= time)
            i++;
        rst_sample_impact(&trace.scene, trace.slides, trace.store.level, trace.store.node, trace.rate, trace.n_knots,
                          trace.knot, l, i, time, sample);
        sample->shear_velocity /= problem->psi;
        sample->time = k + 1 < history->capacity ? share * outcome->contact_time : outcome->contact_time;
    }
    history->count = history->capacity;
    return RESTITUTE_OK;
}
