/* The limit of time of a call.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CLOCK_H
#define RST_CLOCK_H

/* Processor time of the calling thread, in s: neither other threads nor other programs spend it. Where a system does not
 * tell it, the time of day. */
double rst_clock(void);

#endif
