/* The normal problem of the method `sync` as polynomials (fortran/sync_curve.f90), where it is smooth enough for them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "kernels.h"
#include "status.h"
#include "sync_run.h"

/* Part of the error wanted that may be left out between the points, see sync_normal.c. */
static const double left_in_levels = 0.3;

/* Degrees that there are, and down to which error that is wanted each is worth a trial (docs/accuracy.md). */
static const struct {
    int64_t degree;
    double error;
} degrees[] = {{8, 1e-5}, {12, 1e-8}, {16, 0}};
enum { degree_count = sizeof degrees / sizeof degrees[0], highest_degree = 16 };

/* With short memory of several terms there are as many systems of equations, and only the lowest degree is cheaper
 * than levels, where it is likely to do. */
static const double error_of_many = 2e-4;

/* Where friction is so strong that all but the edge sticks, forces and the sums over nodes are to agree better than
 * polynomials let them if a phase lasts longer than so many relaxation times. */
static const double thinnest_slip = 0.02, gentle_memory = 3.5;

/* Where more of the velocity is lost there are sharp bends. */
static const double least_rebound = 0.05;

/* Sweeps stop when velocities change by less than this part of the tolerance, but not before they fall regularly, or by
 * what rounding leaves. */
static const double part_unfinished = 0.004, coarsest = 4e-6, rounding = 1e-12;

/* The error that unfinished sweeps leave, over what they say is left: 19 in 20 of 19 000 standard solids, and all but
 * a few in a thousand twice that. */
static const double share_of_unfinished = 4;

/* The end of the restitution is known that much better than what is between the points. */
static const double part_of_end = 0.05, part_of_end_if_memory_fades = 0.25;

/* Levels for the largest force where no others are made. */
enum { few_levels = 16 };

static size_t columns(size_t terms)
{
    return (2 + 2 * terms) + (3 + terms) + (5 + 3 * terms);
}

static size_t few_room(size_t terms)
{
    const size_t n = few_levels;
    return (2 * n + 1) * (sizeof(struct sync_level) + terms * sizeof(struct sync_trace)) / sizeof(double) +
           (n + 1) * (sizeof(struct sync_node) / sizeof(double));
}

size_t rst_sync_curve_room(int64_t n_terms)
{
    const size_t terms = (size_t)n_terms, rows = highest_degree + 1, equations = terms * (1 + rows * rows);
    return rows * columns(terms) + 2 * terms + (equations > few_room(terms) ? equations : few_room(terms));
}

int rst_sync_is_thin(const struct rst_problem *problem)
{
    return problem->mode == RST_PARTIAL_SLIP && problem->psi < thinnest_slip;
}

/* Whether memory fades within an impact whose phases last so long. */
static int is_short(const struct rst_solid *solid, double lasts)
{
    for (int64_t k = 0; k < solid->n_terms; k++)
        if (solid->tau[k] * gentle_memory < lasts) return 1;
    return 0;
}

/* A solid with a dashpot stays at levels: runs alone on levels from polynomials kept to their law too rarely there (of
 * 20 000 Kelvin-Voigt impacts at 2.5e-6 one in ten was told too low an error of e_x, by 10 times at most; with levels one
 * in seventy, by 3). */
int rst_sync_may_be_smooth(const struct rst_problem *problem, const struct sync_grid *grid)
{
    const struct rst_solid *s = &problem->solid;
    const double lasts = 1.4 * grid->radius * grid->radius;
    if (problem->elements > 0 || grid->start > 0 || s->eta > 0) return 0;
    return !(rst_sync_is_thin(problem) && is_short(s, lasts));
}

void rst_sync_follow_curve(const struct rst_problem *problem, double *room, double wanted, struct normal *normal)
{
    const struct rst_solid *s = &problem->solid;
    const size_t terms = (size_t)s->n_terms;
    const double swings = rst_sync_stepped_swings(problem);
    const double closeness = fmax(rounding, fmin(part_unfinished * problem->tolerance, coarsest) / swings);
    const double allowed = left_in_levels * wanted / swings, depth = normal->grid.radius * normal->grid.radius;
    const int many = terms > 1 && is_short(s, 1.4 * depth), last = many ? 1 : degree_count;
    int64_t failed = 0;
    double lacks[2], *layer = room + (highest_degree + 1) * columns(terms);
    for (int i = 0; i < last && !failed; i++) {
        const int64_t p = degrees[i].degree;
        const size_t rows = (size_t)p + 1;
        double *curve = room, *going = curve + rows * (5 + 3 * terms), *coming = going + rows * (2 + 2 * terms);
        if (allowed < (many ? error_of_many : degrees[i].error)) continue;
        normal->kernel->follow_curve(p, depth, s->g_inf, s->n_terms, s->g, s->tau, closeness, normal->turn,
                                     normal->spread, going, coming, curve, layer, layer + 2 * terms, layer + 3 * terms,
                                     lacks, &failed);
        if (failed) return;
        normal->updates += 2 * p;
        normal->contact_time = normal->turn[1] > 0 ? normal->turn[0] + normal->turn[1] : coming[p];
        normal->velocity = coming[(size_t)p + 2 * rows];
        if (!isfinite(normal->velocity)) return;
        normal->velocity = fmax(-1, normal->velocity);
        normal->depth = going[p];
        normal->error = (normal->turn[1] > 0 ? part_of_end_if_memory_fades : part_of_end) * lacks[0] +
                        share_of_unfinished * lacks[1];
        normal->taken_off = lacks[0];
        normal->curve = curve;
        normal->layer = layer;
        if (-normal->velocity < least_rebound) return;
        if (normal->error <= wanted && lacks[0] <= allowed) {
            normal->degree = p;
            normal->reached = 1;
            return;
        }
    }
}

double rst_sync_curve_force(const struct rst_problem *problem, const struct normal *normal)
{
    const struct rst_solid *s = &problem->solid;
    const size_t terms = (size_t)s->n_terms, n = few_levels;
    struct sync_level *level = (struct sync_level *)(normal->layer + 2 * terms);
    struct sync_trace *trace = (struct sync_trace *)(level + 2 * n + 1);
    struct sync_node *node = (struct sync_node *)(trace + terms * (2 * n + 1));
    int64_t failed;
    normal->kernel->sample_curve(normal->degree, normal->turn, normal->spread, s->g_inf, s->n_terms, s->g,
                                 s->tau, normal->curve, normal->layer, few_levels, level, trace, node, &failed);
    return failed ? NAN : rst_sync_largest_force(level, few_levels);
}
