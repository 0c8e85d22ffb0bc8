/* A table in memory: its numbers, and an index to find a cell quickly.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_FORM_H
#define RST_TABLE_FORM_H

#include "table/axis.h"

#include <restitute/table.h>

#include "base/ranges.h"
#include "base/sized.h"
#include "base/status.h"

/* A node along the speed. */
struct rst_node {
    double at, inverse_width; /* s, and 1 over the width of the cell above */
    double ez, slope;         /* e_z, de_z/ds */
};

/* Largest speed of lookups, m/s: its product with the factors of a contact does not overflow. */
static const double rst_largest_speed = 1e100;

/* Nothing is divided by 0, for programs that trap that. */
static const double rst_least = 0x1p-1000;

struct restitute_table {
    restitute_table_data d;
    restitute_table_contact own;
    double share;           /* rst_share(chi) */
    double of_stick, of_slip; /* cells of psi */
    double end;             /* just below s of the last node */
    double bins_per_s;      /* bins are even; a bin knows the cell of its lower end */
    struct rst_node *node;  /* [speeds] */
    uint16_t *bin;
    size_t bytes;
};

enum { rst_most_bins = 8192, rst_most_speeds = 32768, rst_most_cells = 1024 };

/* max(0, 2 chi - 1): psi_c - 1 over 1 + e_z. A smaller one counts as 0: the slip panel would be
 * narrower than the rounding error of psi - 1, and e_x changes by less than that in it. */
static inline double rst_share(double chi)
{
    const double least = 1e-9;
    return 2 * chi - 1 > least ? 2 * chi - 1 : 0;
}

/* Solid spheres of any size have one chi, but for rounding of sums. */
static inline int rst_same_chi(double a, double b)
{
    return fabs(a - b) <= 1e-9 * fabs(b);
}

/* Number of places of psi: each panel has its own at psi = 1. */
static inline int64_t rst_places(const restitute_table_data *d)
{
    return d->stick_cells + d->slip_cells + 2;
}

/* The pair at `speed` on the table's axis and psi = sliding/v_n; v_n may be 0 and sliding
 * infinite. */
void rst_table_evaluate(const restitute_table *table, double speed, double sliding, double v_n, double *ez, double *ex);

/* The contact that a call is about, which is one of a table; NULL: the table's own. */
int rst_check_other_contact(const restitute_table_contact *contact, restitute_error *error);

/* The speeds that are looked up are in their ranges; `place` is "" or "s[i]" of many. */
int rst_check_speeds(double normal, double sliding, const char *place, restitute_error *error);

/* Highest value of chi that tables take, and lowest. */
static const double rst_chi_range[2] = {0.3, 1000};

#endif
