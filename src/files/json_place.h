/* Where a key stands in a JSON text. Jansson reports the line of a syntax error, but not of a wrong
 * value.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RESTITUTE_JSON_PLACE_H
#define RESTITUTE_JSON_PLACE_H

#include <stddef.h>

/* The line, from 1, of `key` in the outermost object; 0 if it is not there. The text is valid
 * JSON. */
size_t rst_json_line_of_key(const char *text, const char *key);

/* Lines on which the first `count` items of the array `key` of the outermost object begin, in one
 * walk. */
void rst_json_lines_of_items(const char *text, const char *key, size_t *line, size_t count);

#endif
