/* Numbers and texts in HDF5: little-endian doubles, 64-bit integers, fixed strings.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "container.h"

static int close_all(int good, hid_t a, hid_t b, hid_t c)
{
    const hid_t all[3] = {a, b, c};
    for (int i = 0; i < 3; i++)
        if (all[i] >= 0) H5Idec_ref(all[i]); /* closes what is of any kind */
    return good ? 0 : -1;
}

static int put_scalar(hid_t place, const char *name, hid_t file_type, hid_t memory_type, const void *value)
{
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t attribute = space < 0 ? -1 : H5Acreate2(place, name, file_type, space, H5P_DEFAULT, H5P_DEFAULT);
    const int good = attribute >= 0 && H5Awrite(attribute, memory_type, value) >= 0;
    return close_all(good, attribute, space, -1);
}

int rst_put_number(hid_t place, const char *name, double value)
{
    return put_scalar(place, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value);
}

int rst_put_integer(hid_t place, const char *name, int64_t value)
{
    return put_scalar(place, name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
}

int rst_put_text(hid_t place, const char *name, const char *text)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    if (type < 0 || H5Tset_size(type, strlen(text) + 1) < 0) return close_all(0, type, -1, -1);
    return close_all(put_scalar(place, name, type, type, text) == 0, type, -1, -1);
}

/* Without the time of writing: the same table gives the same bytes. */
int rst_put_values(hid_t place, const char *name, int rank, const int64_t *size, const double *value,
                   const char *units, const char *description)
{
    hsize_t length[4];
    for (int i = 0; i < rank; i++)
        length[i] = (hsize_t)size[i];
    const hid_t space = H5Screate_simple(rank, length, NULL), how = H5Pcreate(H5P_DATASET_CREATE);
    hid_t set = -1;
    if (space >= 0 && how >= 0 && H5Pset_obj_track_times(how, 0) >= 0)
        set = H5Dcreate2(place, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT);
    const int good = set >= 0 && H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0 &&
                     rst_put_text(set, "units", units) == 0 && rst_put_text(set, "description", description) == 0;
    return close_all(good, set, space, how);
}

/* An attribute that is one value of a class. */
static hid_t open_scalar(hid_t place, const char *name, H5T_class_t class)
{
    if (H5Aexists(place, name) <= 0) return -1;
    const hid_t attribute = H5Aopen(place, name, H5P_DEFAULT);
    const hid_t type = attribute < 0 ? -1 : H5Aget_type(attribute);
    const hid_t space = attribute < 0 ? -1 : H5Aget_space(attribute);
    const int good = type >= 0 && space >= 0 && H5Tget_class(type) == class &&
                     H5Sget_simple_extent_npoints(space) == 1 && (class != H5T_STRING || H5Tis_variable_str(type) == 0);
    close_all(1, type, space, -1);
    if (good) return attribute;
    close_all(1, attribute, -1, -1);
    return -1;
}

int rst_get_number(hid_t place, const char *name, double *value)
{
    const hid_t attribute = open_scalar(place, name, H5T_FLOAT);
    if (attribute < 0) return -1;
    return close_all(H5Aread(attribute, H5T_NATIVE_DOUBLE, value) >= 0, attribute, -1, -1);
}

int rst_get_integer(hid_t place, const char *name, int64_t *value)
{
    const hid_t attribute = open_scalar(place, name, H5T_INTEGER);
    if (attribute < 0) return -1;
    return close_all(H5Aread(attribute, H5T_NATIVE_INT64, value) >= 0, attribute, -1, -1);
}

int rst_get_text(hid_t place, const char *name, size_t size, char *text)
{
    const hid_t attribute = open_scalar(place, name, H5T_STRING);
    if (attribute < 0) return -1;
    const hid_t type = H5Tcopy(H5T_C_S1);
    memset(text, 0, size);
    const int good = type >= 0 && H5Tset_size(type, size) >= 0 && H5Aget_storage_size(attribute) <= size &&
                     H5Aread(attribute, type, text) >= 0;
    text[size - 1] = '\0';
    return close_all(good, attribute, type, -1);
}

static hid_t open_set(hid_t place, const char *name)
{
    return H5Lexists(place, name, H5P_DEFAULT) > 0 ? H5Dopen2(place, name, H5P_DEFAULT) : -1;
}

/* Values are stored as they are, in one piece, as put_set does it: HDF5 makes no room for chunks and opens no other file. */
static int in_one_piece(hid_t set)
{
    const hid_t how = H5Dget_create_plist(set);
    const int good = how >= 0 && H5Pget_layout(how) == H5D_CONTIGUOUS && H5Pget_external_count(how) == 0;
    return close_all(good, how, -1, -1) == 0;
}

/* So there cannot be more of them than bytes in the file: what is made room for is bounded. */
static int fits(hid_t place, int64_t count)
{
    hsize_t bytes;
    const hid_t file = H5Iget_file_id(place);
    const int good = file >= 0 && H5Fget_filesize(file, &bytes) >= 0 && count >= 0 && (hsize_t)count <= bytes;
    if (file >= 0) H5Fclose(file);
    return good;
}

int64_t rst_count_values(hid_t place, const char *name)
{
    const hid_t set = open_set(place, name);
    if (set < 0) return -1;
    const hid_t type = H5Dget_type(set), space = H5Dget_space(set);
    int64_t count = -1;
    if (type >= 0 && space >= 0 && H5Tget_class(type) == H5T_FLOAT && in_one_piece(set))
        count = H5Sget_simple_extent_npoints(space);
    close_all(1, set, type, space);
    return fits(place, count) ? count : -1;
}

int rst_get_values(hid_t place, const char *name, int64_t count, double *value)
{
    if (rst_count_values(place, name) != count) return -1;
    const hid_t set = open_set(place, name);
    const int good = H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0;
    return close_all(good, set, -1, -1);
}
