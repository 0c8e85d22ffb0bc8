/* Which variant of the loop over elements a processor can run. RST_WIDE_LANES: the build has the wide ones.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "lanes.h"

#include <stddef.h>

#ifdef RST_WIDE_LANES
sync_loop rst_sync_lanes_avx2, rst_sync_lanes_avx512f;
#endif

struct lanes_variant rst_lanes_variant(int i)
{
    if (i == 0) return (struct lanes_variant){"any", rst_sync_lanes_any};
#ifdef RST_WIDE_LANES
    if (i == 1 && __builtin_cpu_supports("avx2")) return (struct lanes_variant){"avx2", rst_sync_lanes_avx2};
    if (i == 2 && __builtin_cpu_supports("avx512f")) return (struct lanes_variant){"avx512f", rst_sync_lanes_avx512f};
#endif
    return (struct lanes_variant){NULL, NULL};
}

sync_loop *rst_widest_lanes(void)
{
    sync_loop *widest = rst_sync_lanes_any;
    for (int i = 1; rst_lanes_variant(i).name; i++)
        widest = rst_lanes_variant(i).loop;
    return widest;
}
