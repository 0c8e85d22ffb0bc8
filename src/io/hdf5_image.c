/* HDF5 files made in memory.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "io/hdf5_image.h"

#include <stdlib.h>
#include <string.h>

/* HDF5 needs a name even for a file in memory, and no file may have it. */
static const char no_file[] = "/dev/null/in_memory";

hid_t rst_image_create(hsize_t block)
{
    enum { increment = 65536 }; /* bytes by which the memory grows */
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = H5Pcreate(H5P_FILE_CREATE);
    hid_t file = -1;
    if (access >= 0 && creation >= 0 && H5Pset_fapl_core(access, increment, 0) >= 0 &&
        H5Pset_userblock(creation, block) >= 0)
        file = H5Fcreate(no_file, H5F_ACC_TRUNC, creation, access);
    if (access >= 0) H5Pclose(access);
    if (creation >= 0) H5Pclose(creation);
    return file;
}

void *rst_image_close(hid_t file, size_t *size)
{
    static const char signature[] = "\211HDF\r\n\032\n"; /* the first bytes of an HDF5 file */
    char *bytes = NULL;
    ssize_t length = H5Fflush(file, H5F_SCOPE_GLOBAL) < 0 ? -1 : H5Fget_file_image(file, NULL, 0);
    if (length > (ssize_t)sizeof signature) bytes = malloc((size_t)length);
    if (bytes) length = H5Fget_file_image(file, bytes, (size_t)length);
    const int good = H5Fclose(file) >= 0 && bytes && length > 0 && memcmp(bytes, signature, strlen(signature)) == 0;
    if (good) {
        *size = (size_t)length;
        return bytes;
    }
    free(bytes);
    return NULL;
}
