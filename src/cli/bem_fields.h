/* Pressure, traction and stick map of an impact by boundary elements: to HDF5, or as a figure.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_BEM_FIELDS_H
#define CLI_BEM_FIELDS_H

#include "options.h"

/* What keeps the fields of a run; NULL where --fields is not given. */
struct bem_fields_keeper;

/* Refuse a place, an extension or a method that --fields cannot do; else let `options` use a method that keeps fields.
 * */
bool bem_fields_begin(const struct settings *settings, restitute_options *options, struct bem_fields_keeper **keeper,
                      struct reason *why);

/* Write what was kept, and release. Nothing for NULL. */
bool bem_fields_write(const struct settings *settings, struct bem_fields_keeper *keeper, struct reason *why);

void bem_fields_release(struct bem_fields_keeper *keeper);

#endif
