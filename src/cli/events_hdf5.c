/* The event log as an HDF5 file: /events/<column>, numbers as doubles and kinds as numbers and words.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "events_hdf5.h"

#ifdef RESTITUTE_WITH_HDF5
#include "hdf5_text.h"

bool events_hdf5_built(void)
{
    return true;
}

static bool write_group(hid_t file, const struct event_table *table, bool physical)
{
    const hid_t group = H5Gcreate2(file, "events", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    bool good = group >= 0 && hdf5_write_text(file, "restitute_version", restitute_version());
    const hid_t word = H5Tcopy(H5T_C_S1);
    H5Tset_size(word, H5T_VARIABLE);
    for (int column = 0; column < EVENT_COLUMNS && good; column++)
        good = column == EVENT_KIND
                   ? hdf5_write_column(group, event_column_name(column, physical), "", word, table->kind, table->count)
                   : hdf5_write_column(group, event_column_name(column, physical), event_column_unit(column, physical),
                                       H5T_NATIVE_DOUBLE, table->number[column], table->count);
    H5Tclose(word);
    if (group >= 0) H5Gclose(group);
    return good;
}

bool events_hdf5_write(const char *path, const struct event_table *table, bool physical, FILE *stream,
                       struct reason *why)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL); /* messages are ours */
    const hid_t file = rst_image_create(0);
    const bool good = file >= 0 && write_group(file, table, physical);
    return hdf5_finish(file, good, stream) ? true : refuse(why, "%.200s cannot be made as HDF5", path);
}
#else
bool events_hdf5_built(void)
{
    return false;
}

/* Never reached: events_check() refuses first. */
bool events_hdf5_write(const char *path, const struct event_table *table, bool physical, FILE *stream,
                       struct reason *why)
{
    (void)table, (void)physical, (void)stream;
    return refuse(why, "%.200s: HDF5 is not in this build", path);
}
#endif
