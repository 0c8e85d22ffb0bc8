/** @file files.h
 *  Component `files` of restitute: materials from files.
 *
 *  Link restitute::files. It needs Jansson; the core does not. The rules of
 *  restitute.h hold here too; messages name the file, the line, the offending value and its allowed
 *  range. Numbers are read with a point, whatever locale the program has set. Where there is no
 *  memory left this component returns ERROR_MEMORY; the behaviour of Jansson is then unspecified.
 *
 *      restitute_material *rubber;
 *      restitute_error error;
 *      if (restitute_material_read("polyisobutylene.json", &rubber, NULL, &error) < 0)
 *          puts(error.message);
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_FILES_H
#define RESTITUTE_FILES_H

#include <restitute/restitute.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------ materials */

/** What a material file says beside the solid itself. */
typedef struct restitute_material_info {
    size_t struct_size; /**< set by @ref restitute_material_info_init */
    char name[128];     /**< "name"; for a .csv file the file's name */
    char source[512];   /**< "source"; empty if the file names none */
    char model[32];     /**< "elastic", "standard_solid", "kelvin_voigt", "maxwell" or "prony" */
    double density;     /**< "density_kg_m3"; NaN if the file gives none */
    uint64_t
        fingerprint;    /**< of all bytes read (FNV-1a, of a JSON and its CSV combined): another
                             value, another content */
} restitute_material_info;

/** Prepare with empty texts and density NaN. */
RESTITUTE_INIT(RESTITUTE_SINCE_0_1, material_info)

/** Read a material, by the extension of the file.
 *
 *  `.csv`: the columns tau_s (relaxation times, s) and G_Pa (moduli, Pa) of a pure Prony series;
 *  Poisson ratio 0.5. Lines that begin with # are comments.
 *
 *  `.json`: one object with the keys
 *
 *      name           text, required, 1 to 127 bytes          source         text, 1 to 511 bytes
 *      poisson_ratio  required, in [0, 0.5]                   density_kg_m3  > 0
 *      model          required; it decides which further keys are required:
 *        elastic         modulus_pa
 *        standard_solid  modulus1_pa, modulus2_pa, viscosity_pa_s
 *        kelvin_voigt    modulus1_pa, viscosity_pa_s
 *        maxwell         modulus_pa, viscosity_pa_s
 *        prony           terms: [{"tau_s": .., "modulus_pa": ..}, ..], or prony_csv: the name of a
 *                        .csv file as above, relative to the folder of the JSON file; optional
 *                        equilibrium_modulus_pa >= 0 and parallel_viscosity_pa_s >= 0, both 0 if
 *                        absent
 *
 *  All moduli are shear moduli, G = E/(2(1 + nu)); ranges are those of @ref
 *  restitute_material_prony. Unknown and repeated keys are refused. Both files are regular ones of
 *  at most 64 MiB: a FIFO, a device and what is larger are refused by name.
 *
 *  @param path      the file
 *  @param material  the new material, for @ref restitute_material_destroy
 *  @param info      optional: what else the file says
 *  @return ERROR_FILE (cannot be read, not regular, too large), ERROR_FORMAT (not of the form
 *          above), ERROR_DOMAIN (a value out of its range), ERROR_NULL, ERROR_STRUCT_SIZE,
 *          ERROR_MEMORY
 *
 *      restitute_material_info info; restitute_material_info_init(&info);
 *      restitute_material_read("polyisobutylene.json", &rubber, &info, &error); // info.density */
RESTITUTE_SINCE_0_1 int restitute_material_read(const char *path, restitute_material **material,
    restitute_material_info *info, restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
