/* One impact at one resolution by the method cvode, from first touch to the end of contact.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_RUN_H
#define RST_CVODE_RUN_H

#include "cvode/run_state.h"

/* Follow an impact; 0, or a status with its reason in run->text. The outcome is in `run`. Memory is
 * released by rst_run_release(), whatever the status. */
int rst_run_follow(struct run *run, const struct run_setup *setup, struct trace *trace, struct event_log *log);
void rst_run_release(struct run *run);

/* States at a time within the last step, with the contact and, where there are elements, their
 * margins and sums. Nonzero: not there. The memory of elements decays from its reference time. At
 * an earlier time exp(t/tau) would overflow. */
int rst_run_look(struct run *run, double t, const double **y);

#endif
