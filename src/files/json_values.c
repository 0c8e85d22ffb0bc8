/* Texts and numbers of the outermost object of a JSON file, checked.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "files/json_values.h"

#include <math.h>
#include <string.h>

#include "base/report.h"
#include "files/json_place.h"

int rst_json_copy_text(const struct json_file *file, const char *key, int required, char *target, size_t size)
{
    const json_t *value = json_object_get(file->root, key);
    if (!value && !required) return RESTITUTE_OK;
    if (!value) return rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s: no key \"%s\"", file->name, key);
    const size_t line = rst_json_line_of_key(file->text, key);
    if (!json_is_string(value))
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: \"%s\" must be text", file->name, line,
                          key);
    const size_t length = json_string_length(value);
    if (length == 0 || length >= size || strlen(json_string_value(value)) != length)
        return rst_report(file->error, RESTITUTE_ERROR_DOMAIN,
                          "%s line %zu: \"%s\" has %zu bytes: must have 1 to %zu, "
                          "none of them zero",
                          file->name, line, key, length, size - 1);
    memcpy(target, json_string_value(value), length + 1);
    return RESTITUTE_OK;
}

int rst_json_number(const struct json_file *file, const json_t *object, const char *key, size_t line, int required,
                    double *number)
{
    const json_t *value = json_object_get(object, key);
    if (!value && !required) return RESTITUTE_OK;
    if (!value)
        return line ? rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: no key \"%s\"", file->name, line,
                                 key)
                    : rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s: no key \"%s\"", file->name, key);
    if (!json_is_number(value))
        return rst_report(file->error, RESTITUTE_ERROR_FORMAT, "%s line %zu: \"%s\" must be a number", file->name,
                          line ? line : rst_json_line_of_key(file->text, key), key);
    *number = json_number_value(value);
    return RESTITUTE_OK;
}

int rst_json_positive(const struct json_file *file, const char *key, int required, int zero_allowed, double *number)
{
    const int status = rst_json_number(file, file->root, key, 0, required, number);
    if (status != RESTITUTE_OK || !json_object_get(file->root, key)) return status;
    if (isfinite(*number) && (*number > 0 || (zero_allowed && *number == 0))) return RESTITUTE_OK;
    return rst_report(file->error, RESTITUTE_ERROR_DOMAIN, "%s line %zu: %s = %.15g: must be finite and %s 0",
                      file->name, rst_json_line_of_key(file->text, key), key, *number, zero_allowed ? ">=" : ">");
}
