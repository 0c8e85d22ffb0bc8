/* How a result was made, as JSON: version, command line, settings, inputs, units. It holds no date, so that the same
 * command writes the same bytes.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_PROVENANCE_H
#define CLI_PROVENANCE_H

#include <jansson.h>

#include "cases.h"
#include "output.h"

/* All that the numbers depend on; two runs with equal settings give equal rows. cases may be NULL. */
json_t *provenance_settings(const struct settings *settings, const struct cases *cases, struct materials *materials);

/* The whole record; takes over `settings_object` and `units`. */
json_t *provenance_record(const struct settings *settings, json_t *settings_object, json_t *units);

/* Write a JSON document to a file or to standard output. Releases the document. */
bool provenance_write(const char *path, json_t *document, struct reason *why);

/* Begin the record of a result file beside it, as PATH.meta.json, to be finished together with the
 * result; nothing for a stream. Releases the record. */
bool provenance_open_beside(const char *path, json_t *record, struct output *output, struct reason *why);

/* A number; infinity as the text "inf", not-a-number as null, for which JSON has no numbers. */
json_t *json_of_number(double value);

#endif
