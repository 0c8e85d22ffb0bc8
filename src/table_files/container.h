/* Files of restitute in HDF5: a block of text with a checksum, then HDF5. See table_files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CONTAINER_H
#define RST_CONTAINER_H

#include <hdf5.h>

#include <restitute/table_files.h>

#include "../core/report.h"
#include "../output/hdf5_image.h"

/* Of what is written, and alone is read. */
enum { rst_schema = 6 };

/* A new file, in memory; negative: HDF5 fails. */
hid_t rst_container_begin(void);

/* Close it; if `good`, write it behind the block that tells what it is. */
int rst_container_end(hid_t file, int good, const char *title, const char *path, restitute_error *error);

/* A whole file in memory, checked. */
struct rst_old_file {
    unsigned char *bytes;
    size_t size;
    hid_t file;
};
int rst_old_file_open(const char *path, const char *title, struct rst_old_file *file, restitute_error *error);
void rst_old_file_close(struct rst_old_file *file);

/* Datasets of doubles, and attributes; negative if HDF5 refuses. Readers take what has exactly the type class and size
 * asked for. */
int rst_put_values(hid_t place, const char *name, int rank, const int64_t *size, const double *value,
                   const char *units, const char *description);
int rst_put_number(hid_t place, const char *name, double value);
int rst_put_integer(hid_t place, const char *name, int64_t value);
int rst_put_text(hid_t place, const char *name, const char *text);
int rst_get_values(hid_t place, const char *name, int64_t count, double *value);
int rst_get_number(hid_t place, const char *name, double *value);
int rst_get_integer(hid_t place, const char *name, int64_t *value);
int rst_get_text(hid_t place, const char *name, size_t size, char *text);

/* Number of values of a dataset; negative if there is none, or one that claims more than the file could hold. */
int64_t rst_count_values(hid_t place, const char *name);

#endif
