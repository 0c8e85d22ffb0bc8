/* Datasets in HDF5: little-endian doubles, compounds, and what they are in words.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "table_files/container.h"

static int close_all(int good, hid_t a, hid_t b, hid_t c)
{
    const hid_t all[3] = {a, b, c};
    for (int i = 0; i < 3; i++)
        if (all[i] >= 0) H5Idec_ref(all[i]); /* closes what is of any kind */
    return good ? 0 : -1;
}

static int put_text(hid_t set, const char *name, const char *text)
{
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    hid_t attribute = -1;
    if (type >= 0 && space >= 0 && H5Tset_size(type, strlen(text) + 1) >= 0)
        attribute = H5Acreate2(set, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    return close_all(attribute >= 0 && H5Awrite(attribute, type, text) >= 0, type, space, attribute);
}

/* In one piece, without the time of writing: the same table gives the same bytes. Closes
 * `space`. */
static int put_set(hid_t file, const char *name, hid_t file_type, hid_t memory_type, hid_t space, const void *value,
                   const char *units, const char *description, uint64_t *place)
{
    const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
    hid_t set = -1;
    if (space >= 0 && how >= 0 && H5Pset_obj_track_times(how, 0) >= 0)
        set = H5Dcreate2(file, name, file_type, space, H5P_DEFAULT, how, H5P_DEFAULT);
    const int written = set >= 0 && H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0 &&
                        put_text(set, "units", units) == 0 && put_text(set, "description", description) == 0;
    const haddr_t at = written ? H5Dget_offset(set) : HADDR_UNDEF;
    *place = at;
    return close_all(at != HADDR_UNDEF, set, space, how);
}

int rst_put_values(hid_t file, const char *name, int rank, const int64_t *size, const double *value, const char *units,
                   const char *description, uint64_t *place)
{
    hsize_t length[4];
    for (int i = 0; i < rank; i++)
        length[i] = (hsize_t)size[i];
    return put_set(file, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, H5Screate_simple(rank, length, NULL), value, units,
                   description, place);
}

int rst_put_compound(hid_t file, const char *name, hid_t type, const void *bytes, const char *units,
                     const char *description, uint64_t *place)
{
    return put_set(file, name, type, type, H5Screate(H5S_SCALAR), bytes, units, description, place);
}
