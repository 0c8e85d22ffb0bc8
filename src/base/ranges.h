/* Ranges of input, wide enough for any system of units, within which no product overflows.
 *
 * Moduli (Pa) and times (s) lie in 1e-30 to 1e30, radii, masses and speeds in 1e-50 to 1e50. Then
 * by (24), in decades:
 *
 *     a_el ~ m^.2 v^.4 R^.4 G^-.2         56       G_k/G_r, over the smallest G_inf   60
 *     d0 = a_el^2/R                       82       tau_k/T                            82
 *     T = d0/v ~ m^.4 v^-.2 R^-.2 G^-.4   52       D, of a sphere that sinks in       55
 *     m v/T                              112       psi, with friction from 1e-30 on  130
 *
 * (of a mere dashpot, of 1e-60 to 1e60 Pa s: d0 137, T 107, m v/T 167). The largest products are
 * G tau^2 D^(1/2) of terms that relax fast, 60 + 164 + 28 = 252 decades, D^(5/2) (G/tau) D of those
 * that relax slowly, where sum G_k is G_r, 138 + 82 + 55 = 275, and psi^2, 260. A double has 308.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_RANGES_H
#define RST_RANGES_H

struct rst_range {
    double low, high;
};

static const struct rst_range rst_moduli = {1e-30, 1e30};      /* Pa */
static const struct rst_range rst_times = {1e-30, 1e30};       /* s, relaxation times */
static const struct rst_range rst_viscosities = {1e-60, 1e60}; /* Pa s */
static const struct rst_range rst_sizes = {1e-50, 1e50};       /* m, kg, m/s: radii, masses, speeds that are not 0 */
static const struct rst_range rst_speeds = {-1e50, 1e50};      /* m/s */
static const struct rst_range rst_spins = {-1e100, 1e100};     /* rad/s; and radius times spin is a speed */
static const struct rst_range rst_positions = {-1e100, 1e100}; /* m */
static const struct rst_range rst_lengths = {1e-100, 1e100};   /* of a vector that is not 0 */
static const struct rst_range rst_inertias = {1e-150, 1e150};  /* kg m^2 */
static const struct rst_range rst_densities = {1e-100, 1e100}; /* kg/m^3 */
static const double rst_least_friction = 1e-30;                /* but 0 */

/* More would be a mistake; OpenMP ends the program where it cannot start what it is asked for. */
enum { rst_most_threads = 1024 };

#endif
