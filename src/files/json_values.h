/* Texts and numbers of the outermost object of a JSON file, checked.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_JSON_VALUES_H
#define RST_JSON_VALUES_H

#include <jansson.h>
#include <restitute/restitute.h>

/* A JSON file while it is read. */
struct json_file {
    const char *path, *name; /* name: the path as it appears in messages */
    const char *text;
    json_t *root;
    uint64_t fingerprint;
    restitute_error *error;
};

/* Copy a text that is to fit into `size` bytes. */
int rst_json_copy_text(const struct json_file *file, const char *key, int required, char *target, size_t size);

/* Read a number from an object; a missing one leaves `number` as it is, unless it is required. */
int rst_json_number(const struct json_file *file, const json_t *object, const char *key, size_t line, int required,
                    double *number);

/* A number of the outermost object that must be finite and > 0, or >= 0. */
int rst_json_positive(const struct json_file *file, const char *key, int required, int zero_allowed, double *number);

#endif
