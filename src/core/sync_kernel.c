/* Which variant of the method sync a processor can run. RST_WIDE_KERNELS: the build has the wide ones.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sync_kernel.h"

#include <stddef.h>

#define DECLARE(width)                                                                                                 \
    sync_normal_levels rst_normal_levels##width;                                                                       \
    sync_double_levels rst_double_levels##width;                                                                       \
    sync_dense_levels rst_dense_levels##width;                                                                         \
    sync_finish_levels rst_finish_levels##width;                                                                       \
    sync_follow_shear rst_follow_shear##width

#define KERNEL(width, loop)                                                                                            \
    {                                                                                                                  \
        .name = #loop, .normal_levels = rst_normal_levels##width, .double_levels = rst_double_levels##width,           \
        .dense_levels = rst_dense_levels##width, .finish_levels = rst_finish_levels##width,                            \
        .follow_shear = rst_follow_shear##width, .elements = rst_sync_lanes_##loop                                     \
    }

DECLARE();
sync_loop rst_sync_lanes_any;
static const struct sync_kernel kernel_any = KERNEL(, any);

#ifdef RST_WIDE_KERNELS
DECLARE(_avx2);
DECLARE(_avx512f);
sync_loop rst_sync_lanes_avx2, rst_sync_lanes_avx512f;
static const struct sync_kernel kernel_avx2 = KERNEL(_avx2, avx2), kernel_avx512f = KERNEL(_avx512f, avx512f);
#endif

const struct sync_kernel *rst_sync_kernel(int i)
{
    if (i == 0) return &kernel_any;
#ifdef RST_WIDE_KERNELS
    if (i == 1 && __builtin_cpu_supports("avx2")) return &kernel_avx2;
    if (i == 2 && __builtin_cpu_supports("avx512f")) return &kernel_avx512f;
#endif
    return NULL;
}

const struct sync_kernel *rst_widest_sync_kernel(void)
{
    const struct sync_kernel *widest = &kernel_any;
    for (int i = 1; rst_sync_kernel(i); i++)
        widest = rst_sync_kernel(i);
    return widest;
}
