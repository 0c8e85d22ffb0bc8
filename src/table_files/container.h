/* Files of restitute in HDF5: a block of text with a checksum, then HDF5, which reads nothing of
 * them. See table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTAINER_H
#define RST_CONTAINER_H

#include <hdf5.h>

#include <restitute/table_files.h>

#include "base/report.h"
#include "io/hdf5_image.h"

/* Of what is written, and alone is read. */
enum { rst_schema = 8, rst_sets = 7 };

/* A new file, in memory; negative: HDF5 fails. */
hid_t rst_container_begin(void);

/* Close it; write it behind the block that tells what it is and at which bytes its sets begin.
 * NULL: HDF5 has failed. */
int rst_container_end(hid_t file, const uint64_t *place, const char *title, const char *path, restitute_error *error);

/* A whole file in memory, checked. */
struct rst_old_file {
    unsigned char *bytes;
    size_t size;
    uint64_t place[rst_sets]; /* as the block has them: not yet compared with `size` */
};
int rst_old_file_open(const char *path, const char *title, struct rst_old_file *file, restitute_error *error);
void rst_old_file_close(struct rst_old_file *file);

/* Datasets that begin at byte `place` of the file, with a text each of their units and of what they
 * are. Negative if HDF5 refuses. */
int rst_put_values(hid_t file, const char *name, int rank, const int64_t *size, const double *value, const char *units,
                   const char *description, uint64_t *place);

/* One value of a compound type, whose bytes are little-endian already. */
int rst_put_compound(hid_t file, const char *name, hid_t type, const void *bytes, const char *units,
                     const char *description, uint64_t *place);

#endif
