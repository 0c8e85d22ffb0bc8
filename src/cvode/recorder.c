/* The recorder: a method of its own that keeps the events and the work of its last impact.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "base/report.h"
#include "base/sized.h"
#include "cvode/method.h"

struct restitute_cvode_recorder {
    struct cvode_method method;
    struct cvode_record record;
};

RST_DEFAULTS(cvode_events, 0)
RST_DEFAULTS(cvode_work, 0)

const char *restitute_cvode_event_text(int kind)
{
    switch (kind) {
#define EVENT_CASE(name, value, word)                                                                                  \
    case value:                                                                                                        \
        return word;
        RESTITUTE_CVODE_EVENT_LIST(EVENT_CASE)
#undef EVENT_CASE
    default:
        return "unknown event";
    }
}

int restitute_cvode_recorder_create(const restitute_method *method, restitute_cvode_recorder **recorder,
                                    restitute_error *error)
{
    if (!recorder) return rst_report(error, RESTITUTE_ERROR_NULL, "recorder is NULL");
    if (!method) method = restitute_method_cvode();
    if (method != restitute_method_cvode() && method != restitute_method_cvode_bdf() &&
        method != restitute_method_cvode_adams())
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "method: must be one of cvode, cvode-bdf and cvode-adams");
    restitute_cvode_recorder *r = calloc(1, sizeof *r);
    if (!r) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for a recorder");
    r->method = *(const struct cvode_method *)method;
    r->method.record = &r->record;
    *recorder = r;
    return rst_done(error);
}

void restitute_cvode_recorder_destroy(restitute_cvode_recorder *recorder)
{
    if (!recorder) return;
    rst_log_release(&recorder->record.log);
    free(recorder);
}

const restitute_method *restitute_cvode_recorder_method(const restitute_cvode_recorder *recorder)
{
    return recorder ? &recorder->method.base : NULL;
}

static int check_recorder(const restitute_cvode_recorder *recorder, const void *output, const char *name,
                          restitute_error *error)
{
    if (!recorder || !output)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", recorder ? name : "recorder");
    if (recorder->record.work.steps == 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "the recorder has not seen an impact yet");
    return RESTITUTE_OK;
}

/* The log is in the units of the problem: lengths d0 and a_el, U' for the tangential velocity. */
static void hand_out(const struct cvode_record *record, restitute_cvode_events *events)
{
    const struct rst_units *units = &record->units;
    events->count = record->log.count;
    for (size_t i = 0; i < record->log.count && i < events->capacity; i++) {
        restitute_cvode_event *event = &events->event[i];
        *event = record->log.event[i];
        event->time *= units->time;
        event->position *= units->length_x;
        event->indentation *= units->length_z;
        event->normal_velocity *= units->velocity;
        event->tangential_velocity *= units->shear_velocity / record->shear_speed;
    }
}

int restitute_cvode_recorder_events(const restitute_cvode_recorder *recorder, restitute_cvode_events *events,
                                    restitute_error *error)
{
    restitute_cvode_events own;
    int status = check_recorder(recorder, events, "events", error);
    if (!status) status = RST_TAKE(cvode_events, &own, events, error);
    if (status) return status;
    if (own.capacity > 0 && !own.event)
        return rst_report(error, RESTITUTE_ERROR_NULL, "events.event is NULL, but events.capacity is %zu",
                          own.capacity);
    hand_out(&recorder->record, &own);
    RST_GIVE(&own, events);
    return rst_done(error);
}

int restitute_cvode_recorder_work(const restitute_cvode_recorder *recorder, restitute_cvode_work *work,
                                  restitute_error *error)
{
    int status = check_recorder(recorder, work, "work", error);
    if (!status) status = RST_CHECK(cvode_work, work, error);
    if (status) return status;
    RST_GIVE(&recorder->record.work, work);
    return rst_done(error);
}
