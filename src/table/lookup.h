/* What the parts of the lookup share.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_LOOKUP_H
#define RST_TABLE_LOOKUP_H

#include "table_form.h"

/* Places that are looked up at once: their waits for memory overlap, and what they read, half a KB each, stays in the
 * first-level cache. 16 and 64 are as fast. */
enum { rst_block = 32 };

/* A place: psi = sliding/v_n; v_n may be 0 and sliding infinite. */
struct rst_asked {
    double speed, gamma, chi, sliding, v_n;
};

/* A pair from a table of trees, and ez alone. */
double rst_cells_rebound(const restitute_table *t, double delta1, double gamma);
void rst_cells_pair(const restitute_table *t, double delta1, double gamma, double chi, double sliding, double v_n,
                    restitute_table_value *pair);

/* Up to rst_block of them, with the same bits. */
void rst_cells_pairs(const restitute_table *t, int n, const struct rst_asked *asked, double *ez, double *ex);

/* The same of ez alone. */
void rst_cells_rebounds(const restitute_table *t, int n, const struct rst_asked *asked, double *ez);

/* ez from a table of two axes; a pair; and up to rst_block pairs. */
double rst_two_axes_rebound(const restitute_table *t, double speed);
void rst_two_axes_pair(const restitute_table *t, double speed, double sliding, double v_n, restitute_table_value *pair);
void rst_two_axes_pairs(const restitute_table *t, int n, const double *speed, const double *sliding, const double *v_n,
                        double *ez, double *ex);

static inline double rst_chi_in_table(const restitute_table *t, double chi)
{
    return rst_clamp(chi, t->chi_low, t->chi_high);
}

#endif
