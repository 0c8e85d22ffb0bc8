/* The arrays of a history.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_HISTORY_H
#define TEST_HISTORY_H

#include <restitute/restitute.h>

enum { history_columns = 8, all_columns = 0xff };

/* Rows of `samples` numbers, in the order of the struct; a bit of `wanted` for each. */
static inline void set_columns(restitute_history *h, size_t samples, double columns[], int wanted)
{
    double **const member[history_columns] = {
        &h->time,         &h->indentation,      &h->contact_radius,  &h->stick_radius,
        &h->normal_force, &h->tangential_force, &h->normal_velocity, &h->tangential_velocity};
    h->capacity = samples;
    for (int i = 0; i < history_columns; i++)
        if (wanted >> i & 1) *member[i] = columns + (size_t)i * samples;
}

#endif
