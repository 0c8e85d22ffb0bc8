/* The tuned numbers of the method `sync`, fourteen, and its limits. Those of the estimates are calibrated by the target
 * sync-campaign (docs/sync.md, section 9). Thresholds of one loop, as where its iterations end, are at the heads of the files in
 * fortran/sync.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_TUNING_H
#define RST_SYNC_TUNING_H

/* ---- estimates */

/* Two runs, or two walks, differ by about the error of the coarser one. This part of it is the estimate for the finer one. */
static const double rst_share_of_change = 0.5;

/* Two walks may agree by chance after extrapolation: the least part of the change before it that counts. Half of it does if
 * changes fall regularly, by a factor that is so close to 4. With 0.3 one of 700 impacts at chi from 4 to 1000 was off by four
 * tolerances; 1 takes a quarter more elements. */
static const double rst_share_by_chance = 0.5, rst_regular = 0.5;

/* Two runs may agree by chance, so that no estimate is below this part of the tolerance. A coarser run that differs by no more
 * will do for walks. */
static const double rst_least_estimate = 0.01;

/* What pieces of U' may miss, as a part of the tolerance, and the part of that which an estimate gets. */
static const double rst_piece_part = 0.3;

/* ---- resolution */

/* What polynomials may miss in the first run, and the factor from run to run. Halved panels give 2^-6 where all is smooth; this
 * asks for less, so that only panels that are not smooth are halved further. */
static const double rst_first_roughness = 1e-2, rst_roughness_falls = 1.0 / 32;

/* Part of the roughness below which slack is none, and a front is at rest. */
static const double rst_noise = 0.01;

/* Panels of the first run are at most (pi/2)/2^halvings wide: halvings = 1 for tolerances from that on, one more for each
 * factor of 64 below. */
static const double rst_coarse_above = 3e-5;

/* Newton's steps end when the next one would change velocities by less than that part of what polynomials may miss: of the normal
 * motion, of pieces. */
static const double rst_closeness = 1e-5, rst_piece_closeness = 1e-3;

/* Pairs of runs with finer panels that are tried before elements are, where slip seems to stick again, and the elements of
 * the first walk then, at least: so many times chi^(1/3), if chi > 1. */
enum { rst_trials_of_front = 3, rst_first_elements = 32 };

/* ---- what is left out */

/* Part of the tolerance below which a rebound is none. */
static const double rst_rest_part = 0.01;

/* ---- limits and bounds, which nothing was tuned for */

/* Part of the tolerance that an estimate may take: what merged terms leave (src/solver/solver.c, merging_share). */
static const double rst_acceptance = 0.9;

/* Velocities are known to that in a run, by rounding, and slower rebounds are lost in it. */
static const double rst_rounding = 1e-13, rst_slowest = 1e-10;

/* What pieces of U' may miss at least: the rounding of single values of D', which is about 1. Finer ones would follow that. */
static const double rst_least_roughness = 1e-15;

/* Panels of a motion that is not lost in rounding; elements of the last walk. Those of the walk that keeps the ledger: at least
 * so many times chi^(1/2), if chi > 1, but not more than the last. */
enum { rst_most_panels = 4096, rst_most_elements = 16384, rst_ledger_elements = 256, rst_most_ledger_elements = 3072 };

#endif
