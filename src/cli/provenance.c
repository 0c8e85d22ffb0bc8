/* The record of how a result was made.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "provenance.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

json_t *json_of_number(double value)
{
    if (isnan(value)) return json_null();
    return isinf(value) ? json_string(number_text(value).text) : json_real(value);
}

static json_t *json_of_fingerprint(uint64_t fingerprint)
{
    char text[40];
    snprintf(text, sizeof text, "fnv1a64:%016" PRIx64, fingerprint);
    return json_string(text);
}

/* What the options gave: under the name of the column that says the same. */
static json_t *given_values(const struct values *values)
{
    json_t *object = json_object();
    for (enum field field = 0; field < FIELD_COUNT; field++)
        if (values->given[field])
            json_object_set_new(object, field_rules[field].column, json_of_number(values->number[field]));
    if (values->material) json_object_set_new(object, "material", json_string(values->material));
    if (values->deformable) json_object_set_new(object, "partner", json_string(partner_word(values)));
    if (values->rotation_blocked >= 0)
        json_object_set_new(object, "rotation_blocked", json_integer(values->rotation_blocked));
    return object;
}

static json_t *described(struct materials *materials, const char *path)
{
    struct reason why;
    const struct material_entry *entry = materials_get(materials, path, &why);
    if (!entry) return json_pack("{s:s, s:s}", "file", path, "refused", why.text);
    return json_pack("{s:s, s:s, s:s, s:o, s:o}", "name", entry->info.name, "source", entry->info.source, "model",
                     entry->info.model, "density_kg_m3", json_of_number(entry->info.density), "fingerprint",
                     json_of_fingerprint(entry->info.fingerprint));
}

/* All materials that the rows name, each once: their contents belong to the inputs that a resumed run must find again.
 * */
static json_t *materials_of_column(const struct cases *cases, size_t column, struct materials *materials)
{
    json_t *object = json_object();
    for (size_t row = 0; row < cases->rows; row++) {
        const char *path = cases_cell(cases, row, column);
        if (strchr(path, '.') && !json_object_get(object, path))
            json_object_set_new(object, path, described(materials, path));
    }
    return object;
}

/* The material or the partner's: from the option or from the column of that name; null if it has none. */
static json_t *given_material(const char *option, const char *name, const struct cases *cases,
                              struct materials *materials)
{
    if (option) return described(materials, option);
    for (size_t column = 0; cases && column < cases->columns; column++)
        if (strcmp(cases_name(cases, column), name) == 0) return materials_of_column(cases, column, materials);
    return json_null();
}

static json_t *given_input(const struct settings *settings, const struct cases *cases)
{
    if (!cases) return json_null();
    if (settings->sweep)
        return json_pack("{s:s, s:I, s:I}", "figure", settings->sweep, "seed", (json_int_t)settings->seed, "rows",
                         (json_int_t)cases->all);
    if (!cases->csv) return json_pack("{s:s}", "grid", settings->text[TEXT_GRID]);
    return json_pack("{s:s, s:I, s:o}", "file", cases->source, "rows", (json_int_t)cases->all, "fingerprint",
                     json_of_fingerprint(rst_csv_fingerprint(cases->csv)));
}

json_t *provenance_settings(const struct settings *settings, const struct cases *cases, struct materials *materials)
{
    const restitute_options *solver = &settings->solver;
    json_t *object = json_object();
    json_object_set_new(object, "version", json_string(restitute_version()));
    json_object_set_new(object, "method", json_string(restitute_method_name(solver->method)));
    json_object_set_new(object, "tolerance", json_real(solver->tolerance));
    json_object_set_new(object, "elements", solver->elements ? json_integer(solver->elements) : json_string("chosen"));
    json_object_set_new(object, "time_step",
                        solver->time_step > 0 ? json_real(solver->time_step) : json_string("chosen"));
    json_object_set_new(object, "max_work", json_of_number(solver->max_work));
    json_object_set_new(object, "time_limit_s",
                        solver->time_limit <= 0         ? json_string("default")
                        : solver->time_limit < INFINITY ? json_real(solver->time_limit)
                                                        : json_string("none"));
    json_object_set_new(object, "values", given_values(&settings->values));
    json_object_set_new(object, "material", given_material(settings->values.material, "material", cases, materials));
    json_object_set_new(object, "partner", given_material(settings->values.partner, "partner", cases, materials));
    json_object_set_new(object, "input", given_input(settings, cases));
    return object;
}

json_t *provenance_record(const struct settings *settings, json_t *settings_object, json_t *units)
{
    json_t *command = json_array();
    for (int i = 0; i < settings->argument_count; i++) {
        json_t *word = json_string(settings->arguments[i]);
        json_array_append_new(command, word ? word : json_string("(not UTF-8)"));
    }
    return json_pack("{s:s, s:s, s:o, s:o, s:o}", "program", "restitute", "version", restitute_version(), "command",
                     command, "settings", settings_object, "units", units);
}

/* A document into an output, not yet finished. Releases the document. */
static bool open_document(const char *path, json_t *document, struct output *output, struct reason *why)
{
    bool good = output_open(path, output, why);
    if (good && json_dumpf(document, output->stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) != 0) {
        outputs_abandon(output, 1);
        good = refuse(why, "%.200s: cannot be written as JSON", path ? path : "standard output");
    }
    if (good) fputc('\n', output->stream);
    json_decref(document);
    return good;
}

bool provenance_write(const char *path, json_t *document, struct reason *why)
{
    struct output output;
    return open_document(path, document, &output, why) && output_finish(&output, why);
}

bool provenance_open_beside(const char *path, json_t *record, struct output *output, struct reason *why)
{
    memset(output, 0, sizeof *output);
    if (output_is_stream(path)) {
        json_decref(record);
        return true;
    }
    char *beside = path_beside(path, ".meta.json");
    const bool good = open_document(beside, record, output, why);
    free(beside);
    return good;
}
