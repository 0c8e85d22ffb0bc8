/* The numbers of the C side of the method `sync`: what it was tuned for, and its limits. Those of
 * the Fortran side are in fortran/sync/tuning.f90. Each number stands in one of the two. The target
 * sync-campaign calibrates what estimates need (docs/sync.md, section 7).
 *
 * "Twice" is what twice the value does to 200 random impacts at tolerances from 1e-3 to 1e-7: the
 * largest error over the tolerance against results at 1e-8 (now 0.75, one outlier apart), the mean
 * one (now 0.0066), and the time, with max_work = 0.01. What changes none of these by more than a
 * tenth has no effect.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_TUNING_H
#define RST_SYNC_TUNING_H

/* ---- estimates */

/* Two runs, or two walks, differ by about the error of the coarser one. This part of it is the
 * estimate for the finer one. Twice: mean error -30 %, +9 of 1200 tolerances not reached */
static const double rst_share_of_change = 0.5;

/* Two walks may agree by chance after extrapolation: the least part of the change before it that
 * counts. Half of it does if changes fall regularly, by a factor that is so close to 4. With 0.3
 * one of 700 impacts at chi from 4 to 1000 was off by four tolerances; 1 takes a quarter more
 * elements. Twice: +5 of 1200 tolerances not reached; of the second: no effect */
static const double rst_share_by_chance = 0.5, rst_regular = 0.5;

/* Two runs may agree by chance, so that no estimate is below this part of the tolerance. With 0.003
 * two of 80 000 estimates were low by 12 (docs/records/accuracy.md). Twice: no effect */
static const double rst_least_estimate = 0.01;

/* What pieces of U' may miss, as a part of the tolerance, and the part of that which an estimate
 * gets, by sync-campaign. Twice: mean error -17 % */
static const double rst_piece_part = 0.3;

/* ---- resolution */

/* What polynomials may miss in the first run, and the factor from run to run. Halved panels give
 * 2^-6 where all is smooth; this asks for less, so that only panels that are not smooth are halved
 * further. Twice: no effect; of the second: mean error +11 % */
static const double rst_first_roughness = 1e-2, rst_roughness_falls = 1.0 / 32;

/* Roughness, and where iterations end, are not below that: some units of rounding, 1e-13 below. */
static const double rst_least_panel_roughness = 3e-13, rst_least_closeness = 1e-12;

/* Part of the roughness below which a stick margin is none, and a front is at rest. Twice: no
 * effect */
static const double rst_noise = 0.01;

/* Panels of the first run are at most (pi/2)/2^halvings wide: halvings = 1 for tolerances from that
 * on, one more for each factor of 64 below, by which halved panels gain. Twice: no effect.
 * One more above the largest usual chi, where U' keeps sqrt(chi) times the errors of A: without it
 * two coarse runs agreed by chance, beyond the tolerance 1e-3, in 12 of 3000 impacts with
 * chi > 50 */
static const double rst_coarse_above = 3e-5, rst_usual_chi = 4;

/* Newton's steps end when the next one would change velocities by less than that part of what
 * polynomials may miss: of the normal motion, of pieces. Twice: no effect; of the second: no
 * effect */
static const double rst_closeness = 1e-5, rst_piece_closeness = 1e-3;

/* Pairs of runs with finer panels that are tried before elements are, where slip seems to stick
 * again, and the elements of the first walk then, at least: so many times chi^(1/3), if chi > 1.
 * Twice: time +26 %, 4 refused; of the second: 12 refused */
enum { rst_trials_of_front = 3, rst_first_elements = 32 };

/* Part of a panel by which an angle is not at its end, for walks, and times of the first panel from
 * which an arm is slow there: exp(-t/tau) is then its polynomial but for rounding. Twice: no
 * effect; of the second: no effect */
static const double rst_same_angle = 1e-6, rst_slow_arm = 100;

/* ---- what is left out */

/* Part of the tolerance below which a rebound is none. Twice: no effect */
static const double rst_rest_part = 0.01;

/* ---- limits and bounds, which nothing was tuned for */

/* Part of the tolerance that an estimate may take: what merged terms leave (src/solver/solver.c,
 * merging_share). */
static const double rst_acceptance = 0.9;

/* Velocities are known to that in a run, by rounding, and slower rebounds are lost in it. Twice: no
 * effect; of the second: no effect */
static const double rst_rounding = 1e-13, rst_slowest = 1e-10;

/* What pieces of U' may miss at least: the rounding of single values of D', which is about 1. Finer
 * ones would follow that. Twice: no effect */
static const double rst_least_roughness = 1e-15;

/* Panels of a motion that is not lost in rounding; elements of the last walk. Those of the walk
 * that keeps the ledger: at least so many times chi^(1/2), if chi > 1, but not more than the last.
 * Twice: more time, and a ledger that closes four times better; parts change by 0.01 of the energy
 * at most. */
enum { rst_most_panels = 4096, rst_most_elements = 16384, rst_ledger_elements = 256, rst_most_ledger_elements = 3072 };

/* A step of a walk that would end before it begins, over the step before. A tenth, or ten times: no
 * effect on the pair, 3e-5 on residual_x */
static const double rst_least_step = 1e-3;

/* Room at first: for four times the panels of a run, and for pieces that events add. Where it is
 * too small, it is doubled. Trials for a piece that work allows in the mean: usual motions take
 * 1.3. A sphere of chi = 573 took 9, and 30 times max_work; now 6 times. Twice: 12 times */
enum { rst_first_panels = 8, rst_first_pieces = 16, rst_trials_of_piece = 2 };

/* Histories: a place on a panel is found to rounding, which takes 50 bisections. Largest force:
 * samples on a panel, which miss 1/64^2 of a parabola between two points. Twice: a quarter of
 * that */
static const double rst_place_found = 1e-15;
enum { rst_most_bisections = 60, rst_force_samples = 64 };

#endif
