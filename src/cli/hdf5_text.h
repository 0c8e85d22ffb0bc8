/* Text in HDF5 files, in builds with HDF5.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_HDF5_TEXT_H
#define CLI_HDF5_TEXT_H

#include <hdf5.h>
#include <stdbool.h>

/* Give a file, a group or a dataset a text attribute. */
bool hdf5_write_text(hid_t place, const char *name, const char *text);

#endif
