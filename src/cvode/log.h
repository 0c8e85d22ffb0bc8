/* The events of an impact, in the units of the problem.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_LOG_H
#define RST_CVODE_LOG_H

#include <restitute/cvode.h>

struct event_log {
    restitute_cvode_event *event;
    size_t count, capacity;
};

/* Nonzero: no memory. */
int rst_log_add(struct event_log *log, const restitute_cvode_event *event);

void rst_log_release(struct event_log *log);

#endif
