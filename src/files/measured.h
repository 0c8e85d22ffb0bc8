/* What a material file says of the measurement: temperature, its shift, the window of times.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_MEASURED_H
#define RST_MEASURED_H

#include <restitute/files.h>

#include "files/json_values.h"

/* These keys, in short, for a message; and whether a key is one. */
#define RST_MEASURED_KEYS "temperature_c, wlf_.., window_s"
int rst_is_measured_key(const char *key);

/* sum G_k tau_k + eta_inf, which goes with the times of a solid. */
int rst_viscosity_of(const restitute_material *material, double *viscosity, restitute_error *error);

/* Fill temperature, wlf_* and window of `info`; what is missing stays. */
int rst_read_measured(const struct json_file *file, restitute_material_info *info);

#endif
