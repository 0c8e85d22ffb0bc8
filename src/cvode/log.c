/* A growing array of events.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cvode/log.h"

#include <stdlib.h>

int rst_log_add(struct event_log *log, const restitute_cvode_event *event)
{
    if (log->count == log->capacity) {
        const size_t capacity = log->capacity ? 2 * log->capacity : 256;
        restitute_cvode_event *larger = realloc(log->event, capacity * sizeof *larger);
        if (!larger) return 1;
        log->event = larger;
        log->capacity = capacity;
    }
    log->event[log->count++] = *event;
    return 0;
}

void rst_log_release(struct event_log *log)
{
    free(log->event);
    *log = (struct event_log){0};
}
