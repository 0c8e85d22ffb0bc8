/* HDF5 files made in memory: HDF5 does not write to a disk. If the disk is full and HDF5 cannot
 * close a file, it crashes at the end of the program.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_HDF5_IMAGE_H
#define RST_HDF5_IMAGE_H

#include <hdf5.h>

/* A new file in memory. Its content will begin at byte `block` of the final file. Negative: HDF5
 * fails. */
hid_t rst_image_create(hsize_t block);

/* Close it. The bytes from `block` on, on the heap; NULL: no memory, or HDF5 fails. */
void *rst_image_close(hid_t file, size_t *size);

#endif
