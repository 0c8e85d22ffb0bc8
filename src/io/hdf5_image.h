/* HDF5 files made in memory: HDF5 never sees a disk, whose end it does not survive (a file that it
 * cannot close makes it crash when the program ends).
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_HDF5_IMAGE_H
#define RST_HDF5_IMAGE_H

#include <hdf5.h>

/* HDF5 wants a name even for what is in memory, and that there is no such file. */
extern const char rst_no_file[];

/* A new file in memory, whose content begins at byte `block` of the file that it will be. Negative:
 * HDF5 fails. */
hid_t rst_image_create(hsize_t block);

/* Close it. The bytes from `block` on, on the heap; NULL: no memory, or HDF5 fails. */
void *rst_image_close(hid_t file, size_t *size);

#endif
