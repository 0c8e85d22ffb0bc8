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
    double temperature; /**< "temperature_c": that of the constants, degrees Celsius; NaN if the
                             file gives none */
    double wlf_c1, wlf_c2, wlf_reference; /**< "wlf_c1", "wlf_c2_k" (K), "wlf_reference_c" (degrees
                             Celsius); NaN likewise. log10 a_T = -c1 (T - T0)/(c2 + T - T0) */
    double wlf_range[2]; /**< "wlf_range_c": degrees Celsius between which the shift holds;
                              (-infinity, infinity) if the file gives none */
    double window[2];    /**< "window_s": of @ref restitute_material_set_window; (0, infinity)
                              likewise */
    double viscosity;    /**< sum G_k tau_k + eta_inf of the solid as it was read, Pa s: it tells
                              whether its times were shifted since */
} restitute_material_info;

/** Prepare with empty texts, window (0, infinity), no limits of the shift and all else NaN. */
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
 *      temperature_c  that of the constants, > -273.15        window_s       [shortest, longest], > 0
 *      wlf_c1, wlf_c2_k, wlf_reference_c                      all or none, beside temperature_c
 *      wlf_range_c    [lowest, highest], beside wlf_c1; temperature_c is in it
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
 *  at most 64 MiB: a FIFO, a device and what is larger are refused by name. The window becomes that
 *  of the material, @ref restitute_material_set_window.
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

/** Read one of the material files that are installed with the library; docs/materials.md lists
 *  them.
 *
 *  It is looked for in the folder that the environment variable RESTITUTE_MATERIALS names, or else
 *  in share/restitute/materials beside this library. A program with the static library needs the
 *  variable, unless it is installed beside that folder itself.
 *
 *  @param name  as "polyisobutylene": the name of the file without .json
 *  @return as @ref restitute_material_read; ERROR_DOMAIN for an unknown name: `error` lists the
 *          known ones; ERROR_FILE if there is no such folder
 *
 *      restitute_material_by_name("steel", &steel, &info, &error);          // info.density */
RESTITUTE_SINCE_0_1 int restitute_material_by_name(const char *name, restitute_material **material,
    restitute_material_info *info, restitute_error *error);

/** A material at another temperature than that of its constants, by the equation of Williams,
 *  Landel and Ferry: times, viscosities and window times a_T(temperature)/a_T(info->temperature).
 *
 *  @param material     as it was read: one that was shifted since is refused
 *  @param info         of the material, from @ref restitute_material_read or by name
 *  @param temperature  degrees Celsius, in wlf_range and above wlf_reference - wlf_c2
 *  @param shifted      the new material
 *  @return ERROR_DOMAIN also where the file has no constants for the shift; what @ref
 *          restitute_material_shifted returns; ERROR_STRUCT_SIZE, ERROR_MEMORY
 *
 *      restitute_material_at_temperature(rubber, &info, 40, &warm_rubber, &error); */
RESTITUTE_SINCE_0_1 int restitute_material_at_temperature(const restitute_material *material,
    const restitute_material_info *info, double temperature, restitute_material **shifted,
    restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
