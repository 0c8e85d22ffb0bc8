/* What a material file says of the measurement, and the material at another temperature.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "files/measured.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/report.h"
#include "base/sized.h"
#include "files/json_place.h"

static const double absolute_zero = -273.15;
static const char *const wlf_keys[] = {"wlf_c1", "wlf_c2_k", "wlf_reference_c"};

int rst_is_measured_key(const char *key)
{
    for (int i = 0; i < 3; i++)
        if (strcmp(key, wlf_keys[i]) == 0) return 1;
    return strcmp(key, "temperature_c") == 0 || strcmp(key, "window_s") == 0 || strcmp(key, "wlf_range_c") == 0;
}

/* A temperature in degrees Celsius. */
static int read_temperature(const struct json_file *file, const char *key, double *value)
{
    const int status = rst_json_number(file, file->root, key, 0, 0, value);
    if (status != RESTITUTE_OK || !json_object_get(file->root, key)) return status;
    if (*value > absolute_zero && isfinite(*value)) return RESTITUTE_OK;
    return rst_report(file->error, RESTITUTE_ERROR_DOMAIN, "%s line %zu: %s = %.15g: must be above -273.15", file->name,
                      rst_json_line_of_key(file->text, key), key, *value);
}

/* All three constants or none; they mean nothing without the temperature of the constants. */
static int read_wlf(const struct json_file *file, restitute_material_info *info)
{
    const char *given = NULL, *missing = isnan(info->temperature) ? "temperature_c" : NULL; /* > raises a flag */
    for (int i = 0; i < 3; i++)
        if (json_object_get(file->root, wlf_keys[i]))
            given = wlf_keys[i];
        else
            missing = wlf_keys[i];
    if (!given) return RESTITUTE_OK;
    if (missing)
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: %s needs %s beside it", file->name,
                          rst_json_line_of_key(file->text, given), given, missing);
    int status = rst_json_positive(file, "wlf_c1", 1, 0, &info->wlf_c1);
    if (status == RESTITUTE_OK) status = rst_json_positive(file, "wlf_c2_k", 1, 0, &info->wlf_c2);
    if (status == RESTITUTE_OK) status = read_temperature(file, "wlf_reference_c", &info->wlf_reference);
    if (status == RESTITUTE_OK && !(info->temperature > info->wlf_reference - info->wlf_c2))
        status = rst_report(file->error, RESTITUTE_ERROR_DOMAIN,
                            "%s line %zu: temperature_c = %.15g: must be above wlf_reference_c - wlf_c2_k = %.15g",
                            file->name, rst_json_line_of_key(file->text, "temperature_c"), info->temperature,
                            info->wlf_reference - info->wlf_c2);
    return status;
}

/* Two numbers, ascending; a key that is missing leaves them. */
static int read_pair(const struct json_file *file, const char *key, double above, double pair[2])
{
    const json_t *list = json_object_get(file->root, key);
    if (!list) return RESTITUTE_OK;
    const size_t line = rst_json_line_of_key(file->text, key);
    if (!json_is_array(list) || json_array_size(list) != 2 || !json_is_number(json_array_get(list, 0)) ||
        !json_is_number(json_array_get(list, 1)))
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: \"%s\" must be two numbers: [.., ..]",
                          file->name, line, key);
    for (size_t i = 0; i < 2; i++)
        pair[i] = json_number_value(json_array_get(list, i));
    if (pair[0] > above && pair[1] > pair[0] && isfinite(pair[1])) return RESTITUTE_OK;
    return rst_report(file->error, RESTITUTE_ERROR_DOMAIN,
                      "%s line %zu: %s = [%.15g, %.15g]: must be finite, > %g and ascending", file->name, line, key,
                      pair[0], pair[1], above);
}

static int read_wlf_range(const struct json_file *file, restitute_material_info *info)
{
    const int status = read_pair(file, "wlf_range_c", absolute_zero, info->wlf_range);
    if (status != RESTITUTE_OK || isinf(info->wlf_range[1])) return status;
    const size_t line = rst_json_line_of_key(file->text, "wlf_range_c");
    if (isnan(info->wlf_c1))
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: wlf_range_c needs wlf_c1 beside it",
                          file->name, line);
    if (info->temperature >= info->wlf_range[0] && info->temperature <= info->wlf_range[1]) return status;
    return rst_report(file->error, RESTITUTE_ERROR_DOMAIN,
                      "%s line %zu: wlf_range_c = [%.15g, %.15g]: must have temperature_c = %.15g in it", file->name,
                      line, info->wlf_range[0], info->wlf_range[1], info->temperature);
}

int rst_read_measured(const struct json_file *file, restitute_material_info *info)
{
    int status = read_temperature(file, "temperature_c", &info->temperature);
    if (status == RESTITUTE_OK) status = read_wlf(file, info);
    if (status == RESTITUTE_OK) status = read_wlf_range(file, info);
    return status == RESTITUTE_OK ? read_pair(file, "window_s", 0, info->window) : status;
}

int rst_viscosity_of(const restitute_material *material, double *viscosity, restitute_error *error)
{
    const size_t n = restitute_material_terms(material);
    double *tau = malloc((2 * n + 1) * sizeof *tau);
    if (!tau) return rst_report(error, RESTITUTE_ERROR_MEMORY, "no memory for %zu Prony terms", n);
    restitute_material_series(material, NULL, viscosity, tau, tau + n, NULL);
    for (size_t k = 0; k < n; k++)
        *viscosity += tau[k] * tau[n + k];
    free(tau);
    return RESTITUTE_OK;
}

/* The material has the times that `info` tells of. Otherwise the shift would be added to another
 * one. The tolerance is for rounding of the sum. */
static int check_times(const restitute_material *material, const restitute_material_info *info, restitute_error *error)
{
    double viscosity;
    const int status = rst_viscosity_of(material, &viscosity, error);
    if (status != RESTITUTE_OK || isnan(info->viscosity)) return status;
    if (fabs(viscosity - info->viscosity) <= 1e-9 * info->viscosity) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "material: sum G tau is %.6g Pa s, but %.6g in info: it was shifted already, or info is of "
                      "another; give the material as it was read",
                      viscosity, info->viscosity);
}

/* log10 a_T from the reference temperature. A file may have any number: the sum of two halves does
 * not overflow. */
static double wlf_decades(const restitute_material_info *info, double temperature)
{
    const double half = 0.5 * (temperature - info->wlf_reference);
    return -info->wlf_c1 * half / (0.5 * info->wlf_c2 + half);
}

int restitute_material_at_temperature(const restitute_material *material, const restitute_material_info *info,
                                      double temperature, restitute_material **shifted, restitute_error *error)
{
    restitute_material_info own;
    if (!material || !info || !shifted)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !material ? "material"
                          : !info   ? "info"
                                    : "shifted");
    int status = RST_TAKE(material_info, &own, info, error);
    if (status) return status;
    if (isnan(own.wlf_c1) || isnan(own.wlf_c2))
        return rst_report(
            error, RESTITUTE_ERROR_DOMAIN,
            "temperature = %g: the file of %s gives no shift of times with temperature (wlf_c1, wlf_c2_k)", temperature,
            own.name[0] ? own.name : "the material");
    if (!(temperature > own.wlf_reference - own.wlf_c2 && isfinite(temperature)))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "temperature = %g: must be above %g degrees Celsius",
                          temperature, own.wlf_reference - own.wlf_c2);
    if (!(temperature >= own.wlf_range[0] && temperature <= own.wlf_range[1]))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "temperature = %g: must be in [%g, %g] degrees Celsius, where the shift of %s holds",
                          temperature, own.wlf_range[0], own.wlf_range[1], own.name[0] ? own.name : "the material");
    status = check_times(material, &own, error);
    if (status) return status;
    const double decades = wlf_decades(&own, temperature) - wlf_decades(&own, own.temperature);
    return restitute_material_shifted(material, pow(10, decades), shifted, error);
}
