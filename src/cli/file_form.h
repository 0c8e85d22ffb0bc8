/* What a file is to hold, by the ending of its name.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_FILE_FORM_H
#define CLI_FILE_FORM_H

enum file_form { FORM_UNKNOWN, FORM_CSV, FORM_HDF5, FORM_SVG, FORM_PNG, FORM_PDF };

/* .csv, .h5 or .hdf5, .svg, .png, .pdf, in capitals or not. */
enum file_form file_form_of(const char *path);

#endif
