/* A user's program that reads the material file named by its argument and steel by name, which it
 * finds beside the shared library. Exit status 0 if both are solids.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include <restitute/files.h>

int main(int argc, char **argv)
{
    restitute_material *material = NULL;
    restitute_error error;
    if (argc != 2) {
        fprintf(stderr, "usage: consumer_files MATERIAL_FILE\n");
        return 2;
    }
    if (restitute_material_read(argv[1], &material, NULL, &error) != RESTITUTE_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("%s: %zu Prony terms\n", argv[1], restitute_material_terms(material));
    restitute_material_destroy(material);
    if (restitute_material_by_name("steel", &material, NULL, &error) != RESTITUTE_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    restitute_material_destroy(material);
    return 0;
}
