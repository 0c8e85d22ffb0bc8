/* The lock of FFTW's planner.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/planner.h"

#include <pthread.h>

/* FFTW's planner is not thread-safe; solvers of several threads plan one after the other. Executing
 * needs no lock. */
static pthread_mutex_t planner = PTHREAD_MUTEX_INITIALIZER;

void rst_bem_lock_planner(void)
{
    pthread_mutex_lock(&planner);
}

void rst_bem_unlock_planner(void)
{
    pthread_mutex_unlock(&planner);
}
