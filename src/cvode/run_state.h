/* An impact that is being followed by the method cvode: what run, events and elements share.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_RUN_STATE_H
#define RST_CVODE_RUN_STATE_H

#include <stdio.h>

#include "base/method.h"
#include "cvode/integrator.h"
#include "cvode/kernels.h"
#include "cvode/log.h"
#include "cvode/trace.h"

/* The scene and the accuracy of the run. */
struct run_setup {
    const struct rst_problem *problem;
    int64_t n_nodes;   /* elements; 0: the normal side alone */
    double closeness;  /* relative error of a step */
    double depth;      /* scale of the depth */
    double radius;     /* largest, of the elements; 0 without elements */
    double rebound;    /* D' at the end, where known: decides on slip to the end */
    double rest_speed; /* a sphere that cannot rebound faster than this has sunk in */
    double longest_step; /* 0: any */
    enum integrator_family family;
    int64_t budget;                  /* of updates: what this run may spend */
    double until;                    /* of the problem's clock: when this run has to end */
    int64_t most_events, most_steps; /* events an element, steps of CVODE: more mean that something is wrong */
};

/* Elements: one block of memory. */
struct elements {
    double *x, *entry, *past, *shift, *c, *b, *amplitude, *d, *f, *value, *layer, *layer_weight;
    int64_t *motion;
    int *change; /* elements that are to change their motion now */
};

/* Modes in which a slipping element recovers. */
struct recovery {
    double *rate, *u, *v, *from_u, *from_v;
};

struct run {
    const struct run_setup *setup;
    struct trace *trace;             /* of the compression: written by a run without elements, read by all */
    struct event_log *log;           /* NULL: not wanted */
    void (*sample)(struct run *run); /* after each part of a step, while run_look() can evaluate it; NULL: not called */
    void (*observe)(struct run *run, double from,
                    double to); /* then, with the memory at its end; again after an event */
    void *observer;

    struct cvode_scene scene;
    struct cvode_contact contact;
    struct cvode_sums sums;
    struct elements elements;
    struct recovery recovery;
    double *doubles; /* what the last two point into */
    struct integrator *integrator;
    double time, *y, *start_y, *start_rate, *look, *scratch;
    int64_t near, inside;          /* where the search starts */
    int64_t next_entry, outermost; /* for entry and exit events */
    double slip_end;               /* D' at which gross slip ends; below any: it does not */
    int shears;                    /* tangential states are being integrated */
    int ended, sunk;

    double max_depth, max_time, max_force;
    double end_velocity, end_shear_velocity, depth; /* where it ended */
    struct integrator_counts work;
    int64_t updates, event_count;
    int64_t checks; /* of work */
    double seconds; /* that it took, of timed runs */
    char text[200];
};

/* Say why, and return the status. */
static inline int rst_run_fail(struct run *run, int status, const char *text)
{
    snprintf(run->text, sizeof run->text, "%s", text);
    return status;
}

#endif
