/* SPDX-License-Identifier: BSD-3-Clause
 * A homogeneous gas of like rough spheres that cools by its impacts: direct simulation Monte Carlo
 * (DSMC) after Bird.
 *
 * Units: the mass of a sphere is 1; speeds in m/s; lengths in l = 1/(n pi d^2), n the number
 * density, d the diameter; hence times in l over 1 m/s. The positions do not matter in a
 * homogeneous gas, and the spheres' size for the impact alone. */
#ifndef GAS_H
#define GAS_H

#include <restitute/table.h>
#include <stddef.h>
#include <stdint.h>

#define GAS_INERTIA 0.4 /* q = J/(m R^2) of a solid sphere */

struct gas_pair {
    double ez, ex;
};

/* Restitution: from a table for spheres of this radius and mass; with table NULL a constant ez and
 * no friction. */
struct gas_law {
    const restitute_table *table;
    struct gas_pair constant;
    double radius, mass; /* m, kg; not used without a table */
};

struct gas {
    struct gas_law law;
    size_t n;
    double (*v)[3]; /* velocities */
    double (*s)[3]; /* R times the spins */
    double time;
    double cost; /* energy lost in impacts */
    uint64_t random, impacts;
};

/* (ez, ex) of an impact; speeds >= 0. */
struct gas_pair gas_pair(const struct gas_law *law, double normal_speed, double tangential_speed);

/* n >= 2 spheres with Maxwell's velocities of temperature <v^2>/3 = translational, with total
 * momentum zero, and spins with q <s^2>/3 = rotational. Returns 0, or -1 if there is no memory. */
int gas_create(struct gas *gas, const struct gas_law *law, size_t n, double translational, double rotational,
               uint64_t seed);
void gas_destroy(struct gas *gas);

/* Advance by n/8 drawn pairs, of which a third collides: about 0.08 impacts a sphere. */
void gas_step(struct gas *gas);

double gas_translational(const struct gas *gas); /* temperature <v^2>/3 */
double gas_rotational(const struct gas *gas);    /* q <s^2>/3 */

/* Median of |s| over that of |v|. The mean squares do not show it if a few spheres have most of the
 * spin. NaN if there is no memory. */
double gas_median_spin(const struct gas *gas);

#endif
