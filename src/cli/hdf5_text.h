/* HDF5 files of the command, in builds with HDF5: text, and their end.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_HDF5_TEXT_H
#define CLI_HDF5_TEXT_H

#include <stdbool.h>
#include <stdio.h>

#include "io/hdf5_image.h"

/* Give a file, a group or a dataset a text attribute. */
bool hdf5_write_text(hid_t place, const char *name, const char *text);

/* An empty dataset without the time of writing: the same run gives the same bytes. */
hid_t hdf5_create_set(hid_t place, const char *name, hid_t type, hid_t space);

/* A dataset of `count` values of that type with the attribute `unit`; an empty unit: none. */
bool hdf5_write_column(hid_t group, const char *name, const char *unit, hid_t type, const void *values, size_t count);

/* Close a file in memory; if `good`, send it to `stream`. False if anything fails. */
bool hdf5_finish(hid_t file, bool good, FILE *stream);

#endif
