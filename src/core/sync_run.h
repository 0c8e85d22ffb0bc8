/* What the files of the method `sync` share: the normal problem, a run, its memory, its repetition.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_RUN_H
#define RST_SYNC_RUN_H

#include <stddef.h>

#include "problem.h"
#include "workspace.h"

/* Most levels that a run may have: with more, rounding adds up to more than they gain. */
enum { rst_sync_most_levels = 1 << 15 };

/* The solution of the normal problem, on its shelf. */
struct normal {
    struct sync_grid grid;
    int64_t levels;             /* of one phase */
    struct sync_level *level;   /* 2 levels + 1 */
    double velocity, error;     /* at its end, extrapolated, with its estimated error */
    double taken_off;           /* by extrapolation, of the velocity: the levels are off by as much */
    double contact_time, depth; /* at its end and at the turning point */
    int reached;                /* whether both are as wanted */
    int64_t updates, ahead;     /* spent, and with the last run that was thought of */
};

/* Levels from `first` on doubled, up to `last`, until three on end have settled and the error is as wanted. Two on
 * end at least are a result; without, as for problem->max_updates too small, normal->levels is 0. */
int rst_sync_normal(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t first, int64_t last,
                    double wanted, struct normal *normal, restitute_error *error);

/* Solve again, at that number of levels alone and on the spare shelf; normal->levels is 0 if it does not settle. */
int rst_sync_normal_again(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t levels,
                          struct normal *normal, restitute_error *error);

/* The solution with so many levels that the outcome just found rests on: it is on one of both shelves, unless a finer
 * one that did not settle took its place. */
int rst_sync_normal_of(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t levels,
                       struct normal *normal, restitute_error *error);

/* Room that rst_sync_normal takes on its shelf. */
size_t rst_sync_normal_room(int64_t levels, int64_t n_terms);

/* Whether damping is so strong that levels crowd at both ends of the compression. */
int rst_sync_is_graded(const struct rst_problem *problem);

/* How much faster than for a solid sphere the tangential oscillation is, squared; 1 for slower ones. */
double rst_sync_swings(const struct rst_problem *problem);

/* The same rounded up to 1, 1.5, 2, 3, 4, 6, ... (slack of 1e-3). */
double rst_sync_stepped_swings(const struct rst_problem *problem);

/* The count that the median impact needs for its estimate of e_x to meet the tolerance. */
double rst_sync_levels_to_start(double tolerance, double swings);

/* By how much iterations are left unfinished, at most. */
double rst_sync_closeness(const struct rst_problem *problem);

/* What a run works on. */
struct store {
    int64_t levels;           /* n */
    int64_t capacity;         /* of the arrays of elements */
    struct sync_level *level; /* 2n + 1 */
    struct sync_trace *trace; /* n_terms times 2n + 1 */
    struct sync_node *node;   /* n + 1 */
    struct sync_term *term;   /* n_terms */
    double *body;             /* columns times capacity */
    double *beta, *faded;     /* n_terms times capacity */
};

/* Whether elements are needed: not without friction, nor in slip to the end, which is known once e_z is (THEORY 4.2).
 * */
int rst_sync_sticks(const struct rst_problem *problem, double rebound);

struct sync_scene rst_sync_scene(const struct rst_problem *problem, const struct store *store);

/* How many levels the tangential problem has: `ratio` times those of the normal one, or these thinned. */
struct resolution {
    int64_t ratio, levels;
};

/* Most runs that impacts begin with: with these levels, half of them, a quarter. */
enum { rst_sync_first_runs = 3 };

/* Where the normal problem is kept: one shelf for chi up to 7/6, one for others. */
struct rst_shelf *rst_sync_shelf(const struct rst_problem *problem, struct rst_workspace *workspace);

/* Which dense levels of a shelf are made from the solution there. */
struct kept {
    int64_t ratio, levels, all; /* of the resolution, ratio 0: nothing; levels that the others are taken from */
    double largest_force;
};
struct kept *rst_sync_kept(const struct rst_shelf *shelf);

/* The levels of the first `runs` runs, on the shelf, where they are kept for other impacts on the solid; the arrays of
 * elements are the same for all. */
int rst_sync_first_levels(const struct rst_problem *problem, struct rst_workspace *workspace,
                          const struct normal *normal, const struct resolution *resolution, int runs,
                          struct store *store, double *largest_force, restitute_error *error);

/* Those of a run alone, all in workspace->elements; `room`: for `more` doubles. */
int rst_sync_levels(const struct rst_problem *problem, struct rst_workspace *workspace, const struct normal *normal,
                    const struct resolution *resolution, size_t more, struct store *store, double *largest_force,
                    double **room, restitute_error *error);

/* Room that the former takes on the shelf, and the latter in workspace->elements. */
size_t rst_sync_first_room(int64_t levels, int64_t n_terms);
size_t rst_sync_run_room(int64_t levels, int64_t n_terms);

/* Largest of 2n + 1 forces, by the parabola through it and its neighbours. */
double rst_sync_largest_force(const struct sync_level *level, int64_t n);

/* Fill outcome->ledger; the rest of the outcome is known. */
int rst_sync_ledger(const struct rst_problem *problem, struct rst_workspace *workspace, struct rst_outcome *outcome,
                    restitute_error *error);

/* The outcome for those who step elements: they need twice the levels for the same error, unless levels are told. */
struct rst_outcome rst_sync_with_elements(const struct rst_problem *problem, const struct rst_outcome *outcome);

/* The levels of that outcome again, no more than `most`, and fewer where they are not found between those of the normal
 * problem; `room`: for `a_level` doubles a level of both phases and `more` besides. */
int rst_sync_repeat(const struct rst_problem *problem, struct rst_workspace *workspace,
                    const struct rst_outcome *outcome, int64_t most, size_t a_level, size_t more, struct store *store,
                    double **room, restitute_error *error);

/* See struct restitute_method. */
int rst_sync_record(const struct rst_problem *problem, struct rst_workspace *workspace,
                    const struct rst_outcome *outcome, struct rst_history *history, restitute_error *error);

#endif
