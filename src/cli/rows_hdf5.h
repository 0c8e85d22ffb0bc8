/* Result rows as an HDF5 file.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_ROWS_HDF5_H
#define CLI_ROWS_HDF5_H

#include "rows.h"

/* Whether this build can. */
bool rows_hdf5_built(void);

/* A dataset a column, as in the CSV: doubles with the attribute unit where a column has numbers (an empty cell is NaN),
 * else text; and the record as the attribute `record` of the file. */
bool rows_hdf5_write(const char *path, const struct cases *cases, const struct row *rows, const json_t *record,
                     struct reason *why);

#endif
