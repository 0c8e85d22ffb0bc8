/* The loop over elements of the method sync, compiled for several vector widths.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_LANES_H
#define RST_LANES_H

#include "kernels.h"

struct lanes_variant {
    const char *name;
    sync_loop *loop;
};

/* The i-th variant, from narrow to wide, if this processor has it; a NULL name ends the list. All give the same bits. */
struct lanes_variant rst_lanes_variant(int i);

/* The widest that this processor has. */
sync_loop *rst_widest_lanes(void);

#endif
