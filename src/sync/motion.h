/* The normal motion of a solid at several resolutions, and room for the tangential motions on it.
 * One object of the caller (docs/sync.md): it is filled for the solid of a problem, and serves
 * every impact on that solid.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_MOTION_H
#define RST_SYNC_MOTION_H

#include <stddef.h>

#include "base/problem.h"
#include "base/workspace.h"
#include "sync/kernels.h"

/* Resolutions: each has panels half as wide as the one before. */
enum { rst_most_halvings = 8 };

enum { RST_NOT_SOLVED = -1 }; /* else as rst_follow_normal found */

struct rst_run {
    struct sync_normal normal;
    int64_t found, capacity;
    double stop_speed; /* up to which all of this is the same */
    double *room;
    size_t room_size;
};

struct rst_motion {
    struct rst_own_memory own; /* released with the workspace */
    double *arms;              /* g and rate of the solid held, and of the one asked for */
    double eta, scale, stop_speed;
    int first;
    int64_t n_arms, most_arms;
    struct rst_run run[rst_most_halvings + 1];
    struct sync_store store;
    double *store_room, *walk_room;
    size_t store_size, walk_size;
};

/* The motion that a workspace keeps; NULL: out of memory. */
struct rst_motion *rst_motion_of(struct rst_workspace *workspace);

/* Take the solid of the problem. first: the halvings of its first run. keep: runs stay if they were
 * for the same solid and first, bit by bit: a run follows the one before it. Nonzero: out of
 * memory. */
int rst_motion_begin(struct rst_motion *motion, const struct rst_problem *problem, int first, int keep);

/* Room for runs with `from` to `to` halvings on solids of up to that many arms. Nonzero: out of
 * memory. */
int rst_motion_reserve(struct rst_motion *motion, int from, int to, int64_t arms);

/* The normal motion with panels of at most (pi/2)/2^halvings; RST_LACKS_ROOM: it wants more than
 * `most` of them. NULL: out of memory. */
const struct rst_run *rst_motion_run(struct rst_motion *motion, int halvings, int64_t most);

/* Of a run that was solved. */
static inline const struct sync_panel *rst_last_panel(const struct rst_run *run)
{
    return &run->normal.panel[run->normal.n_panels - 1];
}

/* What the polynomials of a run may miss: not below rounding, which narrower panels do not
 * lessen. */
double rst_roughness(int halvings);

/* What pieces of U' over psi may miss: not more than a part of the tolerance. With given points
 * U' takes sqrt(chi) times what panels miss, which else are narrower (rst_usual_chi). */
double rst_piece_roughness(const struct rst_problem *problem, int halvings);

/* The tangential motion on a run: U' at the end; RST_LACKS_PIECES: it wants more than
 * `most` of them, many more trials, or more time than is left. Nonzero: out of memory. */
int rst_motion_contact(struct rst_motion *motion, const struct rst_run *run, const struct rst_problem *problem,
                       int halvings, int64_t most, double *velocity, int64_t *found);

#endif
