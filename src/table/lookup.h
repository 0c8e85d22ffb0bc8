/* Looking up a pair: a cell of speed, e_z, the place of psi that follows from it, e_x.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_LOOKUP_H
#define RST_TABLE_LOOKUP_H

#include "form.h"

/* The pair at `speed` on the table's axis and psi = sliding/v_n; v_n may be 0 and sliding infinite. */
void rst_table_evaluate(const restitute_table *table, double speed, double sliding, double v_n,
                        restitute_table_value *pair);

#endif
