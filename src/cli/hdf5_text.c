/* Text attributes of fixed length; columns; files from memory.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "hdf5_text.h"

#include <stdlib.h>
#include <string.h>

bool hdf5_write_text(hid_t place, const char *name, const char *text)
{
    const hid_t space = H5Screate(H5S_SCALAR), type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, strlen(text) + 1);
    const hid_t attribute = H5Acreate2(place, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const bool good = attribute >= 0 && H5Awrite(attribute, type, text) >= 0;
    if (attribute >= 0) H5Aclose(attribute);
    H5Tclose(type);
    H5Sclose(space);
    return good;
}

hid_t hdf5_create_set(hid_t place, const char *name, hid_t type, hid_t space)
{
    const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(how, 0);
    const hid_t set = H5Dcreate2(place, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT);
    H5Pclose(how);
    return set;
}

bool hdf5_write_column(hid_t group, const char *name, const char *unit, hid_t type, const void *values, size_t count)
{
    const hsize_t length = count;
    const hid_t space = H5Screate_simple(1, &length, NULL);
    const hid_t set = hdf5_create_set(group, name, type, space);
    bool good = set >= 0 && (count == 0 || H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    if (good && *unit) good = hdf5_write_text(set, "unit", unit);
    if (set >= 0) H5Dclose(set);
    H5Sclose(space);
    return good;
}

bool hdf5_finish(hid_t file, bool good, FILE *stream)
{
    size_t size = 0;
    void *bytes = file >= 0 ? rst_image_close(file, &size) : NULL;
    good = bytes && good && fwrite(bytes, 1, size, stream) == size;
    free(bytes);
    return good;
}
