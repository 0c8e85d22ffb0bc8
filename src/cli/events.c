/* The event log as CSV, and where it comes from.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "events.h"

#include <stdlib.h>
#include <string.h>

#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif

#include "events_hdf5.h"
#include "file_form.h"

static const struct {
    const char *physical, *physical_unit, *dimensionless, *dimensionless_unit;
} columns[EVENT_COLUMNS] = {
    [EVENT_TIME] = {"time_s", "s", "time_T", "T"},
    [EVENT_KIND] = {"event", "", "event", ""},
    [EVENT_POSITION] = {"position_m", "m", "position_a_el", "a_el"},
    [EVENT_INDENTATION] = {"indentation_m", "m", "indentation_d0", "d0"},
    [EVENT_NORMAL_VELOCITY] = {"normal_velocity_m_s", "m/s", "normal_velocity_v0", "v0 = v_z0"},
    [EVENT_TANGENTIAL_VELOCITY] = {"tangential_velocity_m_s", "m/s", "tangential_velocity_V0",
                                   "V0 = friction v_z0 (2-nu)/(2-2nu)"},
    [EVENT_ELEMENTS] = {"elements", "1", "elements", "1"},
};

const char *event_column_name(int column, bool physical)
{
    return physical ? columns[column].physical : columns[column].dimensionless;
}

const char *event_column_unit(int column, bool physical)
{
    return physical ? columns[column].physical_unit : columns[column].dimensionless_unit;
}

static bool is_hdf5(const char *path)
{
    return file_form_of(path) == FORM_HDF5;
}

#ifdef RESTITUTE_WITH_CVODE
bool events_check(struct settings *settings, struct reason *why)
{
    const char *path = settings->text[TEXT_EVENTS], *method = restitute_method_name(settings->solver.method);
    if (!path) return true;
    if (!settings->text[TEXT_METHOD])
        settings->solver.method = restitute_method_cvode();
    else if (strncmp(method, "cvode", strlen("cvode")) != 0)
        return refuse(why, "--events: the method %s logs none; must be cvode, cvode-bdf or cvode-adams", method);
    if (!output_is_standard(path) && !is_hdf5(path) && file_form_of(path) != FORM_CSV)
        return refuse(why, "--events = \"%.64s\": must end in .csv, .h5 or .hdf5; - is standard output", path);
    if (is_hdf5(path) && !events_hdf5_built())
        return refuse(why, "--events = \"%.64s\": HDF5 is not in this build (Debian: libhdf5-dev); take a .csv", path);
    return output_check(path, "--events", why);
}

bool events_begin(const struct settings *settings, restitute_options *options, struct event_keeper **keeper,
                  struct reason *why)
{
    restitute_cvode_recorder *recorder;
    restitute_error error;
    *keeper = NULL;
    if (!settings->text[TEXT_EVENTS]) return true;
    if (restitute_cvode_recorder_create(options->method, &recorder, &error) < 0)
        return refuse(why, "%s", error.message);
    options->method = restitute_cvode_recorder_method(recorder);
    *keeper = (struct event_keeper *)recorder;
    return true;
}

void events_end(struct event_keeper *keeper)
{
    restitute_cvode_recorder_destroy((restitute_cvode_recorder *)keeper);
}

bool events_take(const struct event_keeper *keeper, struct event_table *table, struct reason *why)
{
    const restitute_cvode_recorder *recorder = (const restitute_cvode_recorder *)keeper;
    restitute_error error;
    restitute_cvode_events events;
    restitute_cvode_events_init(&events);
    if (!keeper) return true;
    int status = restitute_cvode_recorder_events(recorder, &events, &error); /* the number */
    events.capacity = events.count;
    events.event = allocate(events.capacity, sizeof *events.event);
    if (status >= 0) status = restitute_cvode_recorder_events(recorder, &events, &error);
    const size_t n = status >= 0 ? events.count : 0;
    table->count = n;
    table->kind = allocate(n, sizeof *table->kind);
    for (int column = 0; column < EVENT_COLUMNS; column++)
        table->number[column] = allocate(n, sizeof(double));
    for (size_t i = 0; i < n; i++) {
        const restitute_cvode_event *event = &events.event[i];
        table->kind[i] = restitute_cvode_event_text(event->kind);
        table->number[EVENT_TIME][i] = event->time;
        table->number[EVENT_KIND][i] = event->kind;
        table->number[EVENT_POSITION][i] = event->position;
        table->number[EVENT_INDENTATION][i] = event->indentation;
        table->number[EVENT_NORMAL_VELOCITY][i] = event->normal_velocity;
        table->number[EVENT_TANGENTIAL_VELOCITY][i] = event->tangential_velocity;
        table->number[EVENT_ELEMENTS][i] = event->elements;
    }
    free(events.event);
    return status >= 0 || refuse(why, "%s", error.message);
}
#else
bool events_check(struct settings *settings, struct reason *why)
{
    if (!settings->text[TEXT_EVENTS]) return true;
    return refuse(why,
                  "--events needs the component cvode, which is not in this build (SUNDIALS; Debian: libsundials-dev)");
}

bool events_begin(const struct settings *settings, restitute_options *options, struct event_keeper **keeper,
                  struct reason *why)
{
    (void)settings, (void)options, (void)why;
    *keeper = NULL;
    return true;
}

void events_end(struct event_keeper *keeper)
{
    (void)keeper;
}

bool events_take(const struct event_keeper *keeper, struct event_table *table, struct reason *why)
{
    (void)keeper, (void)table, (void)why;
    return true;
}
#endif

static void write_csv(FILE *stream, const struct event_table *table, bool physical)
{
    for (int column = 0; column < EVENT_COLUMNS; column++)
        fprintf(stream, "%s%c", event_column_name(column, physical), column + 1 < EVENT_COLUMNS ? ',' : '\n');
    for (size_t i = 0; i < table->count; i++)
        for (int column = 0; column < EVENT_COLUMNS; column++)
            fprintf(stream, "%s%c", column == EVENT_KIND ? table->kind[i] : number_text(table->number[column][i]).text,
                    column + 1 < EVENT_COLUMNS ? ',' : '\n');
}

bool events_open(const char *path, const struct event_table *table, bool physical, struct output *output,
                 struct reason *why)
{
    if (!output_open(path, output, why)) return false;
    if (is_hdf5(path)) return events_hdf5_write(path, table, physical, output->stream, why);
    write_csv(output->stream, table, physical);
    return true;
}

void events_release(struct event_table *table)
{
    for (int column = 0; column < EVENT_COLUMNS; column++)
        free(table->number[column]);
    free(table->kind);
}
