/* The time history of one impact as CSV, and as a figure.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "history.h"

#include <stdlib.h>

#include "bem_fields.h"
#include "events.h"
#include "figure.h"
#include "places.h"
#include "provenance.h"

enum { HISTORY_COLUMNS = 8 };

/* Names of the columns in SI units and dimensionless. F0 = m v_z0^2/d0, v0 = v_z0, V0 = mu v_z0 (2-nu)/(2-2nu). */
static const struct {
    const char *physical, *physical_unit, *dimensionless, *dimensionless_unit;
} columns[HISTORY_COLUMNS] = {
    {"time_s", "s", "time_T", "T"},
    {"indentation_m", "m", "indentation_d0", "d0"},
    {"contact_radius_m", "m", "contact_radius_a_el", "a_el"},
    {"stick_radius_m", "m", "stick_radius_a_el", "a_el"},
    {"normal_force_N", "N", "normal_force_F0", "F0 = m v_z0^2/d0"},
    {"tangential_force_N", "N", "tangential_force_mu_F0", "friction F0"},
    {"normal_velocity_m_s", "m/s", "normal_velocity_v0", "v0 = v_z0"},
    {"tangential_velocity_m_s", "m/s", "tangential_velocity_V0", "V0 = friction v_z0 (2-nu)/(2-2nu)"},
};

static const char *column_name(int column, bool physical)
{
    return physical ? columns[column].physical : columns[column].dimensionless;
}

/* Room for all columns in one piece, which starts at history->time. */
static void allocate_history(size_t samples, restitute_history *history)
{
    restitute_history_init(history);
    history->capacity = samples;
    history->time = allocate(HISTORY_COLUMNS * samples, sizeof(double));
    double **const arrays[] = {&history->indentation,        &history->contact_radius,   &history->stick_radius,
                               &history->normal_force,       &history->tangential_force, &history->normal_velocity,
                               &history->tangential_velocity};
    for (size_t i = 0; i < HISTORY_COLUMNS - 1; i++)
        *arrays[i] = history->time + (i + 1) * samples;
}

static void write_rows(FILE *stream, const restitute_history *history, bool physical)
{
    for (int column = 0; column < HISTORY_COLUMNS; column++)
        fprintf(stream, "%s%c", column_name(column, physical), column + 1 < HISTORY_COLUMNS ? ',' : '\n');
    for (size_t i = 0; i < history->count; i++)
        for (size_t column = 0; column < HISTORY_COLUMNS; column++)
            fprintf(stream, "%s%c", number_text(history->time[column * history->capacity + i]).text,
                    column + 1 < HISTORY_COLUMNS ? ',' : '\n');
}

static json_t *history_units(bool physical)
{
    json_t *units = json_object();
    for (int column = 0; column < HISTORY_COLUMNS; column++)
        json_object_set_new(units, column_name(column, physical),
                            json_string(physical ? columns[column].physical_unit : columns[column].dimensionless_unit));
    return units;
}

static json_t *event_units(bool physical)
{
    json_t *units = json_object();
    for (int column = 0; column < EVENT_COLUMNS; column++)
        json_object_set_new(units, event_column_name(column, physical),
                            json_string(event_column_unit(column, physical)));
    return units;
}

/* Takes over `units`. */
static json_t *make_record(const struct settings *settings, struct materials *materials, json_t *units, int status)
{
    json_t *record = provenance_record(settings, provenance_settings(settings, NULL, materials), units);
    json_object_set_new(record, "status", json_string(status == RESTITUTE_OK ? "" : restitute_status_text(status)));
    return record;
}

static bool check_options(const struct settings *settings, struct reason *why)
{
    const char *figure = settings->text[TEXT_FIGURE], *output = settings->text[TEXT_OUTPUT];
    if (figure && !figure_check(figure, why)) return false;
    return output_check(output, "--output", why);
}

static bool solve(const struct settings *settings, const struct problem *problem, restitute_history *history,
                  struct event_table *events, int *status, struct reason *why)
{
    restitute_solver *solver;
    restitute_result result;
    restitute_error error;
    restitute_options options = settings->solver;
    struct bem_fields_keeper *fields;
    struct event_keeper *log;
    restitute_result_init(&result);
    if (!events_begin(settings, &options, &log, why)) return false;
    if (!bem_fields_begin(settings, &options, &fields, why)) {
        events_end(log);
        return false;
    }
    bool done = restitute_solver_create(&options, &solver, &error) >= 0;
    if (done) {
        *status = problem_solve(solver, problem, &result, NULL, history, &error);
        restitute_solver_destroy(solver);
        done = *status >= 0;
    }
    if (!done) refuse(why, "%s", error.message);
    if (done) done = events_take(log, events, why) && bem_fields_write(settings, fields, why);
    events_end(log);
    bem_fields_release(fields);
    if (!done) return false;
    if (error.message[0]) complain("remark: %s", error.message);
    return true;
}

static bool write_result(const struct settings *settings, const struct problem *problem, struct materials *materials,
                         const restitute_history *history, const struct event_table *events, int status,
                         struct reason *why)
{
    const char *events_path = settings->text[TEXT_EVENTS];
    const char *path = settings->text[TEXT_OUTPUT], *figure = settings->text[TEXT_FIGURE];
    struct output outputs[4] = {{0}};
    if (!output_open(path, &outputs[0], why)) return false;
    write_rows(outputs[0].stream, history, problem->physical);
    bool good = provenance_open_beside(path, make_record(settings, materials, history_units(problem->physical), status),
                                       &outputs[1], why);
    if (events_path)
        good = good && events_open(events_path, events, problem->physical, &outputs[2], why) &&
               provenance_open_beside(events_path,
                                      make_record(settings, materials, event_units(problem->physical), status),
                                      &outputs[3], why);
    if (!good) outputs_abandon(outputs, 4);
    if (!good || !outputs_finish(outputs, 4, why)) return false;
    return !figure || figure_of_history(figure, settings, problem, history, why);
}

int history_run(const struct settings *given)
{
    struct settings chosen = *given;
    const struct settings *settings = &chosen;
    struct event_table events = {0};
    struct materials materials = {0};
    struct problem problem;
    struct reason why;
    restitute_history history;
    int status = RESTITUTE_OK;
    allocate_history(settings->samples, &history);
    const bool done = check_options(settings, &why) && events_check(&chosen, &why) &&
                      problem_build(&settings->values, NAME_OPTIONS, &materials, &problem, &why) &&
                      places_check_settings(settings, &materials, &why) &&
                      solve(settings, &problem, &history, &events, &status, &why) &&
                      write_result(settings, &problem, &materials, &history, &events, status, &why);
    events_release(&events);
    free(history.time);
    materials_release(&materials);
    return done ? EXIT_DONE : complain("%s", why.text);
}
