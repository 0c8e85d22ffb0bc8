/* The calls of files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L /* setenv */
#include <stdlib.h>

#include <restitute/files.h>

#include "caller.h"

void call_files(void)
{
    restitute_material *material, *warm;
    ONE(material_info, info);
    FILE *file = fopen("old_program.json", "w");
    if (!file) {
        done(RESTITUTE_ERROR_FILE);
        return;
    }
    fputs("{\"name\": \"steel\", \"model\": \"elastic\", \"modulus_pa\": 8e10, \"poisson_ratio\": 0.3, "
          "\"temperature_c\": 20, "
          "\"wlf_c1\": 8.86, \"wlf_c2_k\": 101.6, \"wlf_reference_c\": 0, \"window_s\": [1e-3, 1]}\n",
          file);
    fclose(file);
    DONE(restitute_material_read("old_program.json", &material, info, &error));
    SHOW(restitute_material_modulus(material, 1), info->density, info->fingerprint != 0);
    TEXT(info->model);
    DONE(restitute_material_at_temperature(material, info, 40, &warm, &error));
    SHOW(restitute_material_modulus(warm, 1), info->window[0], info->wlf_c2);
    restitute_material_destroy(warm);
    restitute_material_destroy(material);
    setenv("RESTITUTE_MATERIALS", ".", 1);
    DONE(restitute_material_by_name("old_program", &material, info, &error));
    restitute_material_destroy(material);
}
