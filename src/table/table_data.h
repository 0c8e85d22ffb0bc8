/* The numbers of a table: the content of its file, and the interface between table and table_files.
 *
 * Nodes are products of speeds and of places of psi. The axis of speed is s(v) (axis.h), almost
 * log2(v); cells may have any width, and two equal speeds are a seam. psi has two panels of even
 * cells: psi itself from 0 to 1, then t(y) from 0 to 1, y = (psi - 1)/(psi_c - 1). At a node stand
 * g and its derivatives: g = e_x up to psi = 1, and g = psi e_x - y e_z beyond, which is 0 at
 * psi_c.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_DATA_H
#define RST_TABLE_DATA_H

#include <restitute/table.h>

struct rst_table_data {
    double low, high; /* m/s, range of normal speeds */
    double tolerance, error_ez, error_ex;
    int64_t impacts, checks;
    char version[32]; /* of the library that built it */

    /* the contact it was built for */
    double chi, gamma, delta1;     /* delta1 at 1 m/s; gamma and delta1 are NaN for solids without */
    double psi_factor;             /* psi v_n/|v_t| */
    double duration;               /* T at 1 m/s, s (22) */
    double friction, radius, mass; /* m, kg: effective */
    double poisson_ratio, equilibrium_modulus, parallel_viscosity;
    double speed_limit, radius_limit, displacement_limit; /* see restitute_options */
    int64_t terms;

    int64_t speeds, stick_cells, slip_cells;
    double *relaxation_time, *modulus; /* [terms] */
    double *speed;                     /* [speeds], m/s, ascending */
    double *ez;                        /* [speeds][2]: e_z, de_z/ds */
    double *strain;                    /* [speeds][3]: v_z/c_s, a_max/R, d_max/a_max */
    double *ex;                        /* [speeds][psi][4]: g, dg/ds, dg/dp, d2g/ds dp; p counts cells of psi */
};

/* Number of places of psi: each panel has its own at psi = 1. */
static inline int64_t rst_places(const struct rst_table_data *d)
{
    return d->stick_cells + d->slip_cells + 2;
}

/* The numbers of a table; they live as long as it does. */
RESTITUTE_API const struct rst_table_data *restitute_private_table_data(const restitute_table *table);

/* A table of such numbers, copied. ERROR_DOMAIN: these are not the numbers of a table. */
RESTITUTE_API int restitute_private_table_make(const struct rst_table_data *data, restitute_table **table,
                                               restitute_error *error);

#endif
