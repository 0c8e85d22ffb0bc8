/* The measurements that `restitute fit` reads: columns of a CSV by name. The library checks the values; what it says of
 * points[i] or row[i] is said of the line in the file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "files/number.h"
#include "fit_settings.h"

/* Columns that are no fields of a scene. Heights of a drop stand for the speed and ez: v = sqrt(2 g h). */
enum measure { EZ, EX, TIME, SIGMA_EZ, SIGMA_EX, SIGMA_TIME, WEIGHT, DROP, REBOUND, TEMPERATURE, MEASURES };
static const char *const measures[MEASURES] = {
    "ez",     "ex",           "contact_time_s", "sigma_ez",        "sigma_ex", "sigma_contact_time_s",
    "weight", "drop_height_m", "rebound_height_m", "temperature_C"};

enum curve { FREQUENCY, STORAGE, LOSS, CURVE_TEMPERATURE, CURVES };
static const char *const curves[CURVES] = {"frequency_Hz", "storage_Pa", "loss_Pa", "temperature_C"};

static const double gravity = 9.80665;

static bool at_line(const struct fit_input *input, size_t row, struct reason *why)
{
    const struct reason inner = *why;
    return refuse(why, "%.120s line %zu (row %zu): %s", input->source, rst_csv_line(input->csv, row), row + 1,
                  inner.text);
}

static bool of_scene(const char *name)
{
    const enum field field = field_of_column(name);
    return (field > FIELD_LAST_DIMENSIONLESS && field <= FIELD_FRICTION) || strcmp(name, "partner") == 0 ||
           strcmp(name, "rotation_blocked") == 0;
}

static bool has(const struct fit_input *input, const char *name)
{
    for (size_t i = 0; i < rst_csv_columns(input->csv); i++)
        if (strcmp(rst_csv_name(input->csv, i), name) == 0) return true;
    return false;
}

/* All columns with these names into input->numbers, one behind the other; empty cells and missing columns: NaN. */
static bool read_numbers(struct fit_input *input, const char *const *names, size_t count, struct reason *why)
{
    const struct rst_csv *csv = input->csv;
    input->numbers = allocate(count * input->n, sizeof *input->numbers);
    for (size_t i = 0; i < count * input->n; i++)
        input->numbers[i] = NAN;
    for (size_t column = 0; column < rst_csv_columns(csv); column++) {
        const char *name = rst_csv_name(csv, column);
        size_t k = 0;
        while (k < count && strcmp(names[k], name) != 0)
            k++;
        if (k == count && names == measures && of_scene(name)) continue;
        if (k == count)
            return refuse(why, "%.100s: unknown column \"%.40s\"; known are listed by --help", input->source, name);
        for (size_t row = 0; row < input->n; row++) {
            const char *text = rst_csv_cell(csv, row, column);
            if (*text && rst_number_read(text, &input->numbers[k * input->n + row]) != RESTITUTE_OK) {
                refuse(why, "%s = \"%.64s\" is not a number", name, text);
                return at_line(input, row, why);
            }
        }
    }
    return true;
}

/* Columns of the scene, over what the options gave for all rows. */
static bool scene_cells(const struct rst_csv *csv, size_t row, const struct fit_settings *s, struct values *values,
                        struct reason *why)
{
    *values = s->values;
    for (size_t i = 0; i < rst_csv_columns(csv); i++) {
        const char *name = rst_csv_name(csv, i);
        const enum field field = field_of_column(name);
        if (!of_scene(name)) continue;
        if (field < FIELD_COUNT && s->values.given[field])
            return refuse(why, "column %s and option --%s both give the value", name, field_rules[field].option);
        if (!values_take(name, rst_csv_cell(csv, row, i), values, why)) return false;
    }
    return true;
}

/* Heights in the place of speed and ez. */
static bool take_heights(double drop, double rebound, double *ez, struct values *values, struct reason *why)
{
    if (isnan(drop)) return isnan(rebound) ? true : refuse(why, "rebound_height_m without drop_height_m");
    if (values->given[FIELD_SPEED]) return refuse(why, "drop_height_m and speed_m_s both give the speed");
    if (!isnan(rebound) && !isnan(*ez)) return refuse(why, "rebound_height_m and ez both give ez");
    if (!(drop > 0)) return refuse(why, "drop_height_m = %g: must be > 0", drop);
    if (rebound < 0 || rebound > drop)
        return refuse(why, "rebound_height_m = %g: must be in [0, drop_height_m = %g]", rebound, drop);
    values->number[FIELD_SPEED] = sqrt(2 * gravity * drop);
    values->given[FIELD_SPEED] = true;
    if (!isnan(rebound)) *ez = sqrt(rebound / drop);
    return true;
}

/* The scene is built as `pair` builds it, with a stand-in for the solid that is looked for. */
static bool build_scene(struct values *values, struct fit_input *input, bool with_ex, restitute_scene *scene,
                        struct reason *why)
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
    *scene = problem.scene;
    scene->material = partner ? partner->material : NULL;
    if (fitted && with_ex) scene->friction = NAN;
    return true;
}

static bool read_point(const struct fit_settings *s, struct fit_input *input, size_t row, struct reason *why)
{
    double number[MEASURES];
    struct values values;
    restitute_fit_point *p = &input->points[row];
    for (size_t k = 0; k < MEASURES; k++)
        number[k] = input->numbers[k * input->n + row];
    if (!scene_cells(input->csv, row, s, &values, why) ||
        !take_heights(number[DROP], number[REBOUND], &number[EZ], &values, why))
        return false;
    restitute_fit_point_init(p);
    const double from_weight = 1 / sqrt(number[WEIGHT]); /* NaN: not given */
    p->ez = number[EZ], p->ex = number[EX], p->contact_time = number[TIME], p->temperature = number[TEMPERATURE];
    p->sigma_ez = s->options.noise_known ? number[SIGMA_EZ] : from_weight;
    p->sigma_ex = s->options.noise_known ? number[SIGMA_EX] : from_weight;
    p->sigma_contact_time = s->options.noise_known ? number[SIGMA_TIME] : from_weight * number[TIME];
    p->scene = &input->scenes[row];
    return build_scene(&values, input, !isnan(p->ex), &input->scenes[row], why);
}

/* Only ratios of weights count: over their mean, so that the noise is that of a usual row. No weight: 1. */
static bool scale_weights(struct fit_input *input, struct reason *why)
{
    double *weight = input->numbers + WEIGHT * input->n, sum = 0;
    for (size_t i = 0; i < input->n; i++) {
        if (isnan(weight[i])) weight[i] = 1;
        if (!(weight[i] > 0 && weight[i] <= 1e100)) {
            refuse(why, "weight = %g: must be > 0", weight[i]);
            return at_line(input, i, why);
        }
        sum += weight[i] / (double)input->n;
    }
    for (size_t i = 0; i < input->n; i++)
        weight[i] /= sum;
    return true;
}

static bool read_points(struct fit_settings *s, struct fit_input *input, struct reason *why)
{
    if (!has(input, "speed_m_s") && !has(input, "drop_height_m"))
        return refuse(why, "%.200s: column speed_m_s (or drop_height_m) is missing", input->source);
    if (!has(input, "ez") && !has(input, "rebound_height_m") && !has(input, "ex") && !has(input, "contact_time_s"))
        return refuse(why, "%.200s: column ez (or rebound_height_m, ex, contact_time_s) is missing", input->source);
    s->options.noise_known = has(input, "sigma_ez") || has(input, "sigma_ex") || has(input, "sigma_contact_time_s");
    if (s->options.noise_known && has(input, "weight"))
        return refuse(why, "%.200s: columns weight and sigma_...: give one kind", input->source);
    input->points = allocate(input->n, sizeof *input->points);
    input->scenes = allocate(input->n, sizeof *input->scenes);
    if (has(input, "weight") && !scale_weights(input, why)) return false;
    for (size_t row = 0; row < input->n; row++)
        if (!read_point(s, input, row, why)) return at_line(input, row, why);
    return true;
}

static bool read_curve(struct fit_input *input, struct reason *why)
{
    for (int i = 0; i < CURVE_TEMPERATURE; i++)
        if (!has(input, curves[i])) return refuse(why, "%.200s: column %s is missing", input->source, curves[i]);
    input->frequency = input->numbers;
    input->storage = input->frequency + input->n;
    input->loss = input->storage + input->n;
    input->temperature = has(input, "temperature_C") ? input->loss + input->n : NULL;
    return true;
}

bool fit_input_read(struct fit_settings *s, struct fit_input *input, struct reason *why)
{
    const bool impacts = s->text[FIT_INPUT];
    restitute_error error;
    *input = (struct fit_input){.source = impacts ? s->text[FIT_INPUT] : s->text[FIT_DMA]};
    if (rst_csv_read(input->source, RST_BYTES_OF_TABLE, &input->csv, &error) < 0)
        return refuse(why, "%s", error.message);
    input->n = rst_csv_rows(input->csv);
    if (input->n == 0) return refuse(why, "%.200s: has column names but no rows", input->source);
    if ((s->text[FIT_WLF] || s->text[FIT_REFERENCE]) && !has(input, "temperature_C"))
        return refuse(why, "--wlf, --reference-temperature: %.200s has no column temperature_C", input->source);
    if (s->options.threads < 0) s->options.threads = input->n < 200 ? 1 : 0; /* more only cost, for few */
    if (!read_numbers(input, impacts ? measures : curves, impacts ? MEASURES : CURVES, why)) return false;
    return impacts ? read_points(s, input, why) : read_curve(input, why);
}

void fit_input_release(struct fit_input *input)
{
    free(input->points);
    free(input->scenes);
    free(input->numbers);
    materials_release(&input->materials);
    rst_csv_destroy(input->csv);
}

/* The column for a field that the library names at the beginning of a message; the rest follows in *after. */
static const char *column_of(const char *text, const char **after)
{
    static const char *const columns[] = {"contact_time_s", "sigma_contact_time_s", "temperature_C", "storage_Pa", "loss_Pa",
                                          "frequency_Hz"};
    const size_t length = strcspn(text, " ");
    *after = text + length;
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
        const size_t stem = (size_t)(strrchr(columns[i], '_') - columns[i]);
        if (stem == length && strncmp(text, columns[i], stem) == 0) return columns[i];
    }
    *after = text;
    return "";
}

bool fit_input_place(const struct fit_input *input, const char *message, struct reason *why)
{
    const char *rest = strchr(message, ']');
    size_t row = 0;
    if (!rest || (sscanf(message, "points[%zu]", &row) != 1 && sscanf(message, "row[%zu]", &row) != 1))
        return refuse(why, "%.120s: %s", input->source, message);
    const char *after, *column = column_of(rest + 1 + strspn(rest + 1, ".: "), &after);
    refuse(why, "%s%s", column, after);
    return at_line(input, row, why);
}
