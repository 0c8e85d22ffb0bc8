/* Size of the grid and duration. First guess: the impact on an elastic solid with the modulus at
 * the time of the impact, D = G(D)^(-2/5) (an elastic impact has the largest indentation 1 in units
 * formed with its own modulus, at the time 1.47). Runs on a coarse grid correct it until the
 * contact fits the grid.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/box.h"

#include <math.h>

static const int64_t coarse = 16, coarse_steps = 40;

/* The grid is this times the guessed radius. A run whose contact fills less than the second value
 * is repeated. */
static const double generous = 1.15, least_part = 0.6;

/* The guess of the time is more accurate than this factor. */
static const double far_off = 1e6;

enum { most_tries = 60 };

static double guess_depth(const struct rst_solid *solid)
{
    return rst_likely_depth(solid->g_inf, solid->eta, solid->n_terms, solid->g, solid->tau);
}

static void settle_time(const struct bem_run *run, struct bem_box *box)
{
    box->sinks = run->end == BEM_SUNK;
    box->sink_time = run->last.time;
    box->time = box->sinks ? INFINITY : run->contact_time;
}

void rst_bem_guess_times(const struct rst_solid *solid, double *shortest, double *longest)
{
    const double time = rst_elastic_contact_time() * guess_depth(solid);
    *shortest = time / far_off;
    *longest = time * far_off;
}

/* With steps of second order for every variant: explicit steps may need so many that the search
 * would not end. */
int rst_bem_find_box(const struct rst_problem *problem, struct bem_solid *solid, struct bem_memory *memory,
                     struct bem_box *box)
{
    const double depth = guess_depth(&problem->solid);
    double side = generous * sqrt(depth), step = rst_elastic_contact_time() * depth / (double)coarse_steps;
    for (int i = 0; i < most_tries; i++) {
        struct bem_run run;
        const struct bem_setup setup = {.problem = problem,
                                        .solid = solid,
                                        .normal_only = 1,
                                        .m = coarse,
                                        .spacing = side / (double)coarse,
                                        .step = step,
                                        .rest_speed = 1e-4,
                                        .most_steps = 30 * coarse_steps};
        rst_bem_solid_step(step, 0, solid);
        rst_bem_run(&setup, memory, NULL, &run);
        if (run.end == BEM_NO_MEMORY) return run.end;
        box->radius = rst_bem_radius_of(run.max_area);
        if (run.end == BEM_UNSETTLED) {
            step /= 4; /* unstable */
        } else if (run.end == BEM_OUTGREW) {
            side *= 1.5;
        } else if (run.end == BEM_TOO_LONG) {
            step *= 4;
        } else if (box->radius < least_part * side) {
            side = fmax(side / 4, generous * box->radius);
        } else if (run.steps < coarse_steps / 2) {
            step /= 2;
        } else {
            settle_time(&run, box);
            return BEM_REBOUND;
        }
    }
    return BEM_TOO_LONG;
}
