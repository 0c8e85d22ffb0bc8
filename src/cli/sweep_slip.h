/* psi_c by simulation: from which psi on does no element ever stick? The paper's algorithm steps every element from
 * first touch on, and nothing is taken from (31) or from the theory behind it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_SWEEP_SLIP_H
#define CLI_SWEEP_SLIP_H

#include <restitute/restitute.h>
#include <stdint.h>

/* Bisection with so many elements over the largest contact radius and 64 times as many steps over the contact, both
 * of which `result` tells. NaN: not solved. */
double sweep_critical_psi(double chi, double delta1, double gamma, const restitute_result *result, int64_t elements);

#endif
