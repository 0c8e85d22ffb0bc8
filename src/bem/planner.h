/* FFTW plans by one thread at a time.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_PLANNER_H
#define BEM_PLANNER_H

void rst_bem_lock_planner(void);
void rst_bem_unlock_planner(void);

#endif
