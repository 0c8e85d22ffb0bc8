/* The kernels for the vectors of this machine.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "contact/kernel.h"

void rst_choose_kernels(rst_kernel **one, rst_kernel **lanes)
{
    *one = rst_step_one;
    *lanes = rst_step_lanes;
#ifdef RST_HAS_AVX2
    if (__builtin_cpu_supports("avx2")) {
        *one = rst_step_one_avx2;
        *lanes = rst_step_lanes_avx2;
    }
#endif
}
