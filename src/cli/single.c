/* One impact: solve it and show the result as text, CSV or JSON.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "single.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output.h"
#include "places.h"
#include "provenance.h"
#include "rows.h"

struct single {
    const struct settings *settings;
    struct materials materials;
    struct problem problem;
    restitute_numbers numbers; /* of a scene; NaN where they have no meaning */
    restitute_result result;
    restitute_ledger ledger;
    int status;
};

static bool check_options(const struct settings *settings, struct reason *why)
{
    if (settings->text[TEXT_FIGURE]) return refuse(why, "--figure = %.200s: needs --grid", settings->text[TEXT_FIGURE]);
    if (settings->resume) return refuse(why, "--resume: needs --input or --grid");
    if (settings->contours) return refuse(why, "--contours: needs --grid or --input, and --figure");
    if (settings->text[TEXT_SHARD] || settings->text[TEXT_JOIN])
        return refuse(why, "--shard, --join: need --input or --grid");
    if (settings->text[TEXT_THREADS])
        return refuse(why, "--threads = %s: needs --input or --grid", settings->text[TEXT_THREADS]);
    return output_check(settings->text[TEXT_OUTPUT], "--output", why);
}

/* The dimensionless numbers as given, in the struct that a scene fills. */
static void numbers_of_impact(const restitute_impact *impact, restitute_numbers *numbers)
{
    numbers->chi = impact->chi;
    numbers->psi = impact->psi;
    numbers->delta1 = impact->delta1;
    numbers->gamma = impact->gamma;
    numbers->delta2 = impact->delta1 > 0 ? impact->delta1 * sqrt(impact->gamma) : 0.0;
}

static bool solve(struct single *single, struct reason *why)
{
    const struct settings *settings = single->settings;
    restitute_solver *solver;
    restitute_error error;
    restitute_result_init(&single->result);
    restitute_ledger_init(&single->ledger);
    restitute_numbers_init(&single->numbers);
    if (!problem_build(&settings->values, NAME_OPTIONS, &single->materials, &single->problem, why) ||
        !places_check_settings(settings, &single->materials, why))
        return false;
    if (!single->problem.physical)
        numbers_of_impact(&single->problem.impact, &single->numbers);
    else if (restitute_scene_numbers(&single->problem.scene, &single->numbers, &error) < 0)
        return refuse(why, "%s", error.message);
    if (restitute_solver_create(&settings->solver, &solver, &error) < 0) return refuse(why, "%s", error.message);
    single->status = problem_solve(solver, &single->problem, &single->result, &single->ledger, NULL, &error);
    restitute_solver_destroy(solver);
    if (single->status < 0) return refuse(why, "%s", error.message);
    if (error.message[0]) complain("remark: %s", error.message);
    return true;
}

/* "label   value unit   (value2 unit2)"; the second part only for a scene, whose scale is not 0. */
static void line(FILE *stream, const char *label, double value, const char *unit, double scale, const char *scale_unit)
{
    fprintf(stream, "  %-22s %-12.6g %s", label, value, unit);
    if (scale > 0) fprintf(stream, "   (%.6g %s)", value / scale, scale_unit);
    fputc('\n', stream);
}

static void text_numbers(FILE *stream, const struct single *single)
{
    const restitute_numbers *numbers = &single->numbers;
    const struct {
        const char *name;
        double value;
    } shown[] = {{"chi", numbers->chi},
                 {"psi", numbers->psi},
                 {"delta1", numbers->delta1},
                 {"gamma", numbers->gamma},
                 {"delta2", numbers->delta2}};
    fputs("\nDimensionless numbers\n ", stream);
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++)
        if (!isnan(shown[i].value)) fprintf(stream, " %s = %.6g ", shown[i].name, shown[i].value);
    const double critical = restitute_critical_psi(numbers->chi, single->result.ez);
    fprintf(stream, "\n  slip lasts to the end of contact from psi = %.6g on\n", critical);
}

static void text_impact(FILE *stream, const struct single *single)
{
    const restitute_result *result = &single->result;
    const restitute_numbers *numbers = &single->numbers;
    const bool physical = single->problem.physical;
    fputs("\nImpact\n", stream);
    line(stream, "contact time", result->contact_time, physical ? "s" : "T", numbers->time, "T");
    line(stream, "largest indentation", result->max_indentation, physical ? "m" : "d0", numbers->length_z, "d0");
    line(stream, "largest contact radius", result->max_contact_radius, physical ? "m" : "a_el", numbers->length_x,
         "a_el");
    line(stream, "largest normal force", result->max_normal_force, physical ? "N" : "m v_z0^2/d0", numbers->force,
         "m v_z0^2/d0");
}

/* How far the scene strains the model, and what of it passes a limit, in words. */
static void text_validity(FILE *stream, const struct single *single)
{
    const restitute_result *result = &single->result;
    const restitute_options *limits = &single->settings->solver;
    const struct {
        const char *name;
        double value, limit;
        int flag;
    } shown[] = {
        {"v_z0/wave speed", result->speed_ratio, limits->speed_limit, RESTITUTE_FLAG_FAST},
        {"contact radius/R", result->radius_ratio, limits->radius_limit, RESTITUTE_FLAG_LARGE_CONTACT},
        {"slide/contact radius", result->displacement_ratio, limits->displacement_limit, RESTITUTE_FLAG_LONG_SLIDE},
        {"Dundurs' beta", result->dundurs_beta, limits->dundurs_limit, RESTITUTE_FLAG_COUPLED}};
    if (!single->problem.physical) return;
    fputs("\nModel limits\n", stream);
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) {
        fprintf(stream, "  %-22s %-12.3g (limit %g)\n", shown[i].name, shown[i].value, shown[i].limit);
        if (result->flags & shown[i].flag) fprintf(stream, "    passed: %s\n", restitute_flag_text(shown[i].flag));
    }
}

static void text_energy(FILE *stream, const struct single *single)
{
    const restitute_ledger *ledger = &single->ledger;
    fputs("\nEnergy, as fractions of what came in\n"
          "              rebound    friction     viscous        left    residual\n",
          stream);
    fprintf(stream, "  normal     %8.5f           -    %8.5f    %8.5f    %8.1e\n", ledger->rebound_z, ledger->viscous_z,
            ledger->left_z, ledger->residual_z);
    fprintf(stream, "  tangential %8.5f    %8.5f    %8.5f    %8.5f    %8.1e\n", ledger->rebound_x, ledger->friction_x,
            ledger->viscous_x, ledger->left_x, ledger->residual_x);
}

static void text_numerics(FILE *stream, const struct single *single)
{
    const restitute_result *result = &single->result;
    const bool physical = single->problem.physical;
    fputs("\nNumerics\n", stream);
    fprintf(stream, "  %-22s %s, tolerance %g\n", "method", result->method, single->settings->solver.tolerance);
    fprintf(stream, "  %-22s %lld, spacing %.6g %s\n", "elements", (long long)result->elements, result->element_spacing,
            physical ? "m" : "a_el");
    fprintf(stream, "  %-22s %lld of %.6g %s\n", "steps", (long long)result->steps, result->time_step,
            physical ? "s" : "T");
    fprintf(stream, "  %-22s %.3g nominal seconds\n", "work", result->work);
    fprintf(stream, "  %-22s %lld, bound on their effect %.1e\n", "relaxation times merged",
            (long long)result->terms_merged, result->merging_bound);
}

static void write_text(FILE *stream, const struct single *single)
{
    const restitute_result *result = &single->result;
    char name[4 * sizeof single->problem.info->name] = "";
    if (single->problem.physical) snprintf(name, sizeof name, ": %s", single->problem.info->name);
    escape(name, sizeof name);
    fprintf(stream, "restitute %s%s", restitute_version(), name);
    fputs("\n\nRestitution\n", stream);
    fprintf(stream, "  normal       ez = %9.6f +- %.1e\n", result->ez, result->error_ez);
    fprintf(stream, "  tangential   ex = %9.6f +- %.1e\n", result->ex, result->error_ex);
    if (single->status != RESTITUTE_OK) fprintf(stream, "  remark: %s\n", restitute_status_text(single->status));
    text_impact(stream, single);
    text_validity(stream, single);
    text_numbers(stream, single);
    text_energy(stream, single);
    text_numerics(stream, single);
}

/* The options given become the input columns. */
static void write_csv(FILE *stream, const struct single *single)
{
    const struct values *values = &single->settings->values;
    struct row row;
    row_from_result(single->status, &single->result, &row);
    for (int names = 1; names >= 0; names--) {
        for (enum field field = 0; field < FIELD_COUNT; field++)
            if (values->given[field])
                fprintf(stream, "%s,", names ? field_rules[field].column : number_text(values->number[field]).text);
        if (values->material) cell_write(stream, names ? "material" : values->material), fputc(',', stream);
        if (values->deformable) cell_write(stream, names ? "partner" : partner_word(values)), fputc(',', stream);
        if (values->rotation_blocked >= 0) fprintf(stream, "%s,", names ? "rotation_blocked" : "1");
        if (names)
            row_write_result_names(stream);
        else
            row_write_result(stream, &row);
    }
    free(row.status);
}

struct named_number {
    const char *name;
    double value;
};

static json_t *json_of_numbers(const struct named_number *numbers, size_t count)
{
    json_t *object = json_object();
    for (size_t i = 0; i < count; i++)
        json_object_set_new(object, numbers[i].name, json_of_number(numbers[i].value));
    return object;
}

static json_t *json_of_result(const struct single *single)
{
    const restitute_result *result = &single->result;
    const struct named_number numbers[] = {{"ez", result->ez},
                                           {"ex", result->ex},
                                           {"error_ez", result->error_ez},
                                           {"error_ex", result->error_ex},
                                           {"contact_time", result->contact_time},
                                           {"max_indentation", result->max_indentation},
                                           {"max_contact_radius", result->max_contact_radius},
                                           {"max_normal_force", result->max_normal_force},
                                           {"element_spacing", result->element_spacing},
                                           {"time_step", result->time_step},
                                           {"work", result->work},
                                           {"merging_bound", result->merging_bound},
                                           {"speed_ratio", result->speed_ratio},
                                           {"radius_ratio", result->radius_ratio},
                                           {"displacement_ratio", result->displacement_ratio},
                                           {"dundurs_beta", result->dundurs_beta}};
    json_t *object = json_of_numbers(numbers, sizeof numbers / sizeof numbers[0]);
    json_object_set_new(object, "elements", json_integer(result->elements));
    json_object_set_new(object, "steps", json_integer(result->steps));
    json_object_set_new(object, "terms_merged", json_integer(result->terms_merged));
    json_t *flags = json_array();
    for (int flag = 1; flag <= result->flags; flag *= 2)
        if (result->flags & flag) json_array_append_new(flags, json_string(restitute_flag_text(flag)));
    json_object_set_new(object, "flags", flags);
    json_object_set_new(object, "method", json_string(result->method));
    json_object_set_new(object, "status",
                        json_string(single->status == RESTITUTE_OK ? "" : restitute_status_text(single->status)));
    return object;
}

static json_t *json_of_ledger(const restitute_ledger *ledger)
{
    const struct named_number numbers[] = {
        {"rebound_z", ledger->rebound_z},   {"viscous_z", ledger->viscous_z}, {"left_z", ledger->left_z},
        {"residual_z", ledger->residual_z}, {"rebound_x", ledger->rebound_x}, {"friction_x", ledger->friction_x},
        {"viscous_x", ledger->viscous_x},   {"left_x", ledger->left_x},       {"residual_x", ledger->residual_x}};
    return json_of_numbers(numbers, sizeof numbers / sizeof numbers[0]);
}

static json_t *json_of_dimensionless(const restitute_numbers *numbers)
{
    const struct named_number shown[] = {{"chi", numbers->chi},
                                         {"psi", numbers->psi},
                                         {"delta1", numbers->delta1},
                                         {"gamma", numbers->gamma},
                                         {"delta2", numbers->delta2}};
    return json_of_numbers(shown, sizeof shown / sizeof shown[0]);
}

static json_t *make_record(struct single *single)
{
    const bool physical = single->problem.physical;
    json_t *units = row_units(NULL, physical);
    json_object_set_new(units, "max_contact_radius", json_string(physical ? "m" : "a_el"));
    json_object_set_new(units, "max_normal_force", json_string(physical ? "N" : "m v_z0^2/d0"));
    json_object_set_new(units, "element_spacing", json_string(physical ? "m" : "a_el"));
    json_object_set_new(units, "work", json_string("nominal s"));
    json_object_set_new(units, "time_step", json_string(physical ? "s" : "T"));
    return provenance_record(single->settings, provenance_settings(single->settings, NULL, &single->materials), units);
}

static bool write_result(struct single *single, struct reason *why)
{
    const struct settings *settings = single->settings;
    const char *path = settings->text[TEXT_OUTPUT];
    struct output output[2];
    if (settings->format == FORMAT_JSON)
        return provenance_write(path,
                                json_pack("{s:o, s:o, s:o, s:o}", "meta", make_record(single), "result",
                                          json_of_result(single), "numbers", json_of_dimensionless(&single->numbers),
                                          "energy", json_of_ledger(&single->ledger)),
                                why);
    if (!output_open(path, &output[0], why)) return false;
    if (settings->format == FORMAT_CSV)
        write_csv(output[0].stream, single);
    else
        write_text(output[0].stream, single);
    return provenance_open_beside(path, make_record(single), &output[1], why) && outputs_finish(output, 2, why);
}

int single_run(const struct settings *settings)
{
    struct single single = {.settings = settings};
    struct reason why;
    const bool done = check_options(settings, &why) && solve(&single, &why) && write_result(&single, &why);
    materials_release(&single.materials);
    return done ? EXIT_DONE : complain("%s", why.text);
}
