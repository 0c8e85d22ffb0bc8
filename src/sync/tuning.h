/* All tuned numbers of the method `sync`. Those of the estimates are calibrated by the target sync-campaign
 * (docs/sync.md, "How the error is estimated").
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_TUNING_H
#define RST_SYNC_TUNING_H

/* Two runs differ by the error of the coarser one. This part of it is the estimate for the finer one, of the normal motion, and
 * of the tangential one behind a front and with elements; by chance: least part of the change before extrapolation. */
static const double rst_share_of_change = 0.5, rst_share_of_elements = 0.5, rst_share_by_chance = 0.1;

/* The same if changes of elements fall regularly, to a quarter within that. */
static const double rst_share_if_regular = 0.05, rst_regular = 0.5;

/* Two runs may agree by chance, so that no estimate is below this part of the tolerance. */
static const double rst_least_estimate = 0.003;

/* What polynomials may miss in the first run, and by what that falls from run to run: less than 2^-6, which halved panels
 * give where all is smooth, so that only panels that are not smooth are halved further. */
static const double rst_first_roughness = 1e-2, rst_roughness_falls = 1.0 / 32;

/* The same for the pieces of U', as a part of the tolerance; what an estimate gets of it, since two runs may agree by chance; and
 * the part of the roughness below which slack is none. */
static const double rst_piece_part = 0.3, rst_share_of_pieces = 0.3, rst_noise = 0.01;

/* Panels of the first run are at most (pi/2)/2^halvings wide: halvings = 1 for tolerances from that on, one more for each
 * factor of 64 below. */
static const double rst_coarse_above = 3e-5;

/* Newton's steps end when the next one would change velocities by less than that part of what polynomials may miss: of the normal
 * motion, of pieces. */
static const double rst_closeness = 1e-5, rst_piece_closeness = 1e-3;

/* Velocities are known to that in a run, by rounding. */
static const double rst_rounding = 1e-13;

/* Part of the tolerance below which a rebound is none; slower ones are lost in rounding. */
static const double rst_rest_part = 0.01, rst_slowest = 1e-10;

/* e_x differs from that without slip by at most this times psi, which is left out where it is a small part of the tolerance. */
static const double rst_change_by_slip = 2, rst_negligible_part = 0.25;

/* Part of the tolerance that an estimate may take; the rest is for merged terms. */
static const double rst_acceptance = 0.9;

/* Pairs of runs with finer panels that are tried before elements are, where slip seems to stick again. */
enum { rst_trials_of_front = 3 };

/* A motion that takes more panels is lost in rounding. */
enum { rst_most_panels = 4096 };

/* Elements of the first walk, at least, of the last one, at most, and of the one that keeps the ledger. */
enum { rst_first_elements = 32, rst_most_elements = 16384, rst_ledger_elements = 256 };

#endif
