/* From a method's outcome to the public structs, in the caller's units.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_OUTPUT_H
#define RST_OUTPUT_H

#include "base/problem.h"

struct rst_units rst_units_of(const struct rst_problem *problem, const restitute_scene *scene,
                              const restitute_numbers *numbers);
void rst_write_result(const struct rst_problem *problem, const struct rst_outcome *outcome, int64_t terms_merged,
                      double merging_bound, restitute_result *result);
void rst_write_ledger(const struct rst_problem *problem, const struct rst_outcome *outcome, restitute_ledger *ledger);
void rst_write_history(const struct rst_history *samples, const struct rst_units *units, restitute_history *history);

#endif
