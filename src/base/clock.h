/* The limit of time of a call.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CLOCK_H
#define RST_CLOCK_H

/* Processor time of the calling thread, in s: neither other threads nor other programs spend it. On
 * systems without such a clock: the time of day. */
double rst_clock(void);

#endif
