/* The measurements that `restitute fit` reads: rows of a CSV, every value checked and named by its line.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fit_settings.h"

/* Columns that are no fields of a scene. HEIGHTs of a drop stand for the speed and ez: v = sqrt(2 g h). */
enum measure { EZ, EX, TIME, SIGMA_EZ, SIGMA_EX, SIGMA_TIME, WEIGHT, TEMPERATURE, DROP, REBOUND, MEASURES };
enum curve { FREQUENCY, STORAGE, LOSS, CURVE_TEMPERATURE, CURVES };

struct column_rule {
    const char *name;
    double low, high;
    const char *range;
};

static const struct column_rule measures[MEASURES] = {{"ez", 0, 1, "must be in [0, 1]"},
                                                      {"ex", -1, 1, "must be in [-1, 1]"},
                                                      {"contact_time_s", 1e-100, 1e100, "must be > 0"},
                                                      {"sigma_ez", 1e-100, 1e100, "must be > 0"},
                                                      {"sigma_ex", 1e-100, 1e100, "must be > 0"},
                                                      {"sigma_contact_time_s", 1e-100, 1e100, "must be > 0"},
                                                      {"weight", 1e-100, 1e100, "must be > 0"},
                                                      {"temperature_C", -273.15, 1e4, "must be in [-273.15, 1e4]"},
                                                      {"drop_height_m", 1e-100, 1e50, "must be > 0"},
                                                      {"rebound_height_m", 0, 1e50, "must be >= 0"}};

static const struct column_rule curves[CURVES] = {{"frequency_Hz", 1e-30, 1e30, "must be > 0"},
                                                  {"storage_Pa", 1e-30, 1e30, "must be > 0"},
                                                  {"loss_Pa", 1e-30, 1e30, "must be > 0"},
                                                  {"temperature_C", -273.15, 1e4, "must be in [-273.15, 1e4]"}};

static const double gravity = 9.80665;

/* The column with this name; the number of columns if there is none. */
static size_t find(const restitute_csv *csv, const char *name)
{
    size_t i = 0;
    while (i < restitute_csv_columns(csv) && strcmp(restitute_csv_name(csv, i), name) != 0)
        i++;
    return i;
}

/* A cell by its rule; empty or no such column: NaN. */
static bool cell(const restitute_csv *csv, size_t row, const struct column_rule *rule, double *value,
                 struct reason *why)
{
    const char *text = restitute_csv_cell(csv, row, find(csv, rule->name));
    *value = NAN;
    if (!text || !*text) return true;
    if (restitute_number_read(text, value) != RESTITUTE_OK)
        return refuse(why, "%s = \"%.64s\" is not a number: %s", rule->name, text, rule->range);
    return *value >= rule->low && *value <= rule->high ? true
                                                       : refuse(why, "%s = %.64s: %s", rule->name, text, rule->range);
}

static bool at_line(const char *source, const restitute_csv *csv, size_t row, struct reason *why)
{
    const struct reason inner = *why;
    return refuse(why, "%.120s line %zu (row %zu): %s", source, restitute_csv_line(csv, row), row + 1, inner.text);
}

static bool of_rules(const char *name, const struct column_rule *rules, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(rules[i].name, name) == 0) return true;
    return false;
}

static bool of_scene(const char *name)
{
    const enum field field = field_of_column(name);
    return (field > FIELD_LAST_DIMENSIONLESS && field <= FIELD_FRICTION) || strcmp(name, "partner") == 0 ||
           strcmp(name, "rotation_blocked") == 0;
}

static bool check_columns(const restitute_csv *csv, const char *source, const struct column_rule *rules, size_t count,
                          bool scene, struct reason *why)
{
    char names[200] = "";
    for (size_t i = 0; i < count; i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%s", i ? ", " : "", rules[i].name);
    for (size_t i = 0; i < restitute_csv_columns(csv); i++) {
        const char *name = restitute_csv_name(csv, i);
        if (!of_rules(name, rules, count) && !(scene && of_scene(name)))
            return refuse(why, "%.100s: unknown column \"%.40s\"; known are %s%s", source, name, names,
                          scene ? " and those of a scene; see --help" : "");
    }
    return restitute_csv_rows(csv) ? true : refuse(why, "%.200s: has column names but no rows", source);
}

/* Columns of the scene, over what the options gave for all rows. */
static bool scene_cells(const restitute_csv *csv, size_t row, const struct fit_settings *s, struct values *values,
                        struct reason *why)
{
    *values = s->values;
    for (size_t i = 0; i < restitute_csv_columns(csv); i++) {
        const char *name = restitute_csv_name(csv, i);
        const enum field field = field_of_column(name);
        if (!of_scene(name)) continue;
        if (field < FIELD_COUNT && s->values.given[field])
            return refuse(why, "column %s and option --%s both give the value", name, field_rules[field].option);
        if (!values_take(name, restitute_csv_cell(csv, row, i), values, why)) return false;
    }
    return true;
}

/* Heights in the place of speed and ez. */
static bool take_heights(double *number, struct values *values, struct reason *why)
{
    if (isnan(number[DROP]))
        return isnan(number[REBOUND]) ? true : refuse(why, "rebound_height_m without drop_height_m");
    if (values->given[FIELD_SPEED]) return refuse(why, "drop_height_m and speed_m_s both give the speed");
    values->number[FIELD_SPEED] = sqrt(2 * gravity * number[DROP]);
    values->given[FIELD_SPEED] = true;
    if (isnan(number[REBOUND])) return true;
    if (!isnan(number[EZ])) return refuse(why, "rebound_height_m and ez both give ez");
    number[EZ] = sqrt(number[REBOUND] / number[DROP]);
    return number[EZ] <= 1 ? true
                           : refuse(why, "rebound_height_m = %g: must be in [0, drop_height_m = %g]", number[REBOUND],
                                    number[DROP]);
}

static void set_sigmas(const double *number, restitute_fit_point *p)
{
    const double from_weight = isnan(number[WEIGHT]) ? NAN : 1 / sqrt(number[WEIGHT]);
    p->ez = number[EZ], p->ex = number[EX], p->contact_time = number[TIME], p->temperature = number[TEMPERATURE];
    p->sigma_ez = isnan(number[SIGMA_EZ]) ? from_weight : number[SIGMA_EZ];
    p->sigma_ex = isnan(number[SIGMA_EX]) ? from_weight : number[SIGMA_EX];
    p->sigma_contact_time = isnan(number[SIGMA_TIME]) ? from_weight * number[TIME] : number[SIGMA_TIME];
}

/* The scene is built as `pair` builds it, with a stand-in for the solid that is looked for. */
static bool build_scene(struct values *values, struct fit_input *input, restitute_fit_point *p, struct reason *why)
{
    struct problem problem;
    const struct material_entry *partner = NULL;
    const bool fitted = !values->given[FIELD_FRICTION];
    if (values->partner && !(partner = materials_get(&input->materials, values->partner, why))) return false;
    values->partner = NULL;
    values->given[FIELD_FRICTION] = values->given[FIELD_MODULUS1] = true;
    values->number[FIELD_MODULUS1] = 1;
    if (fitted) values->number[FIELD_FRICTION] = 0;
    if (!problem_build(values, NAME_COLUMNS, &input->materials, &problem, why)) return false;
    p->scene = problem.scene;
    p->scene.material = partner ? partner->material : NULL;
    if (fitted && !isnan(p->ex)) p->scene.friction = NAN;
    return true;
}

static bool read_point(const struct fit_settings *s, struct fit_input *input, size_t row, struct reason *why)
{
    double number[MEASURES];
    struct values values;
    restitute_fit_point *p = &input->points[row];
    restitute_fit_point_init(p);
    for (int i = 0; i < MEASURES; i++)
        if (!cell(input->csv, row, &measures[i], &number[i], why)) return false;
    if (!scene_cells(input->csv, row, s, &values, why) || !take_heights(number, &values, why)) return false;
    set_sigmas(number, p);
    if (isnan(p->ez) && isnan(p->ex) && isnan(p->contact_time))
        return refuse(why, "nothing is measured: ez, ex or contact_time_s must be given");
    const double sigmas[] = {p->sigma_ez, p->sigma_ex, p->sigma_contact_time};
    const double measured[] = {p->ez, p->ex, p->contact_time};
    for (int i = 0; i < 3 && s->options.noise_known; i++)
        if (!isnan(measured[i]) && isnan(sigmas[i]))
            return refuse(why, "%s is missing: must be > 0 for all that is measured, or for nothing",
                          measures[SIGMA_EZ + i].name);
    return build_scene(&values, input, p, why);
}

static bool read_points(struct fit_settings *s, struct fit_input *input, struct reason *why)
{
    const restitute_csv *csv = input->csv;
    const size_t none = restitute_csv_columns(csv);
    const char *source = s->text[FIT_INPUT];
    if (!check_columns(csv, source, measures, MEASURES, true, why)) return false;
    if (find(csv, "speed_m_s") == none && find(csv, "drop_height_m") == none)
        return refuse(why, "%.200s: column speed_m_s (or drop_height_m) is missing", source);
    if (find(csv, "ez") == none && find(csv, "rebound_height_m") == none && find(csv, "ex") == none &&
        find(csv, "contact_time_s") == none)
        return refuse(why, "%.200s: column ez (or rebound_height_m, ex, contact_time_s) is missing", source);
    s->options.noise_known =
        find(csv, "sigma_ez") < none || find(csv, "sigma_ex") < none || find(csv, "sigma_contact_time_s") < none;
    if (s->options.noise_known && find(csv, "weight") < none)
        return refuse(why, "%.200s: columns weight and sigma_...: give one kind", source);
    input->points = allocate(input->n, sizeof *input->points);
    for (size_t row = 0; row < input->n; row++)
        if (!read_point(s, input, row, why)) return at_line(source, csv, row, why);
    return true;
}

static bool read_curve(const struct fit_settings *s, struct fit_input *input, struct reason *why)
{
    const restitute_csv *csv = input->csv;
    const char *source = s->text[FIT_DMA];
    double **const arrays[CURVES] = {&input->frequency, &input->storage, &input->loss, &input->temperature};
    if (!check_columns(csv, source, curves, CURVES, false, why)) return false;
    for (int i = 0; i < CURVES; i++) {
        const bool there = find(csv, curves[i].name) < restitute_csv_columns(csv);
        if (!there && i < CURVE_TEMPERATURE) return refuse(why, "%.200s: column %s is missing", source, curves[i].name);
        if (there) *arrays[i] = allocate(input->n, sizeof **arrays[i]);
        for (size_t row = 0; there && row < input->n; row++) {
            bool good = cell(csv, row, &curves[i], &(*arrays[i])[row], why);
            if (good && isnan((*arrays[i])[row]))
                good = refuse(why, "%s is empty: %s", curves[i].name, curves[i].range);
            if (!good) return at_line(source, csv, row, why);
        }
    }
    return true;
}

bool fit_input_read(struct fit_settings *settings, struct fit_input *input, struct reason *why)
{
    const char *path = settings->text[FIT_INPUT] ? settings->text[FIT_INPUT] : settings->text[FIT_DMA];
    restitute_error error;
    memset(input, 0, sizeof *input);
    if (restitute_csv_read(path, &input->csv, &error) < 0) return refuse(why, "%s", error.message);
    input->n = restitute_csv_rows(input->csv);
    if ((settings->text[FIT_WLF] || settings->text[FIT_REFERENCE]) &&
        find(input->csv, "temperature_C") == restitute_csv_columns(input->csv))
        return refuse(why, "--wlf, --reference-temperature: %.200s has no column temperature_C", path);
    if (settings->options.threads < 0) settings->options.threads = input->n < 200 ? 1 : 0; /* more only cost, for few */
    return settings->text[FIT_INPUT] ? read_points(settings, input, why) : read_curve(settings, input, why);
}

void fit_input_release(struct fit_input *input)
{
    free(input->points);
    free(input->frequency);
    free(input->storage);
    free(input->loss);
    free(input->temperature);
    materials_release(&input->materials);
    restitute_csv_destroy(input->csv);
}

void fit_input_place(const struct fit_settings *settings, const struct fit_input *input, const char *message,
                     struct reason *why)
{
    const char *source = settings->text[FIT_INPUT] ? settings->text[FIT_INPUT] : settings->text[FIT_DMA];
    const char *rest = strchr(message, ']');
    size_t row = 0;
    refuse(why, "%.120s: %s", source, message);
    if (rest && (sscanf(message, "points[%zu]", &row) == 1 || sscanf(message, "row[%zu]", &row) == 1) &&
        row < input->n) {
        refuse(why, "%s", rest + 1 + strspn(rest + 1, ".: "));
        at_line(source, input->csv, row, why);
    }
}
