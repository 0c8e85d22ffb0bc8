/* Numbers that measure the assumptions of the model.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_VALIDITY_H
#define RST_VALIDITY_H

#include "base/problem.h"

/* Add the exceeded limits to the message of `error`. */
void rst_name_limits(const restitute_options *options, const restitute_scene *scene, const restitute_result *result,
                     restitute_error *error);

/* Fill the ratios and the flags of `result`, whose contact time is known. `scene` NULL: a
 * dimensionless impact, for which they are unknown. */
void rst_judge_validity(const restitute_options *options, const restitute_scene *scene,
                        const restitute_numbers *numbers, const struct rst_outcome *outcome, restitute_result *result);

#endif
