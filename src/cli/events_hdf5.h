/* The event log in HDF5, where it is built.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_EVENTS_HDF5_H
#define CLI_EVENTS_HDF5_H

#include "events.h"

/* Whether this build writes HDF5. */
bool events_hdf5_built(void);

/* One group /events with a dataset a column, its unit as attribute. The file goes to `stream`, its
 * name to messages. */
bool events_hdf5_write(const char *path, const struct event_table *table, bool physical, FILE *stream,
                       struct reason *why);

#endif
