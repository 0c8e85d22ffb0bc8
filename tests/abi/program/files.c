/* The calls of files.h.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/files.h>

#include "caller.h"

void call_files(void)
{
    restitute_material *material;
    ONE(material_info, info);
    FILE *file = fopen("old_program.json", "w");
    if (!file) {
        done(RESTITUTE_ERROR_FILE);
        return;
    }
    fputs("{\"name\": \"steel\", \"model\": \"elastic\", \"modulus_pa\": 8e10, \"poisson_ratio\": 0.3}\n", file);
    fclose(file);
    DONE(restitute_material_read("old_program.json", &material, info, &error));
    SHOW(restitute_material_modulus(material, 1), info->density, info->fingerprint != 0);
    TEXT(info->model);
    restitute_material_destroy(material);
}
