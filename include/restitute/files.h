/** @file files.h
 *  Component `files` of restitute: materials from files, and the plain CSV tables that the command reads.
 *
 *  Link restitute::files. It needs Jansson and libcsv; the core needs neither. The rules of restitute.h hold here too:
 *  every function returns a @ref restitute_status, a failed call leaves its outputs untouched, nothing is printed, and
 *  the optional last argument names the file, the line, the offending value and its allowed range. Numbers are read
 *  with a point, whatever locale the program has set. Where there is no memory left this component returns ERROR_MEMORY; the
 *  behaviour of Jansson is then unspecified.
 *
 *      restitute_material *rubber;
 *      restitute_error error;
 *      if (restitute_material_read("polyisobutylene.json", &rubber, &error) < 0) puts(error.message);
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_FILES_H
#define RESTITUTE_FILES_H

#include <restitute/restitute.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- materials */

/** What a material file says beside the solid itself. */
typedef struct restitute_material_info {
    size_t struct_size; /**< set by @ref restitute_material_info_init */
    char name[128];     /**< "name"; for a .csv file the file's name */
    char source[512];   /**< "source"; empty if the file names none */
    char model[32];     /**< "elastic", "standard_solid", "kelvin_voigt", "maxwell" or "prony" */
    double density;     /**< "density_kg_m3"; NaN if the file gives none */
    uint64_t
        fingerprint; /**< of all bytes read (FNV-1a, of a JSON and its CSV combined): another value, another content */
} restitute_material_info;

/** Prepare with empty texts and density NaN. */
RESTITUTE_API void restitute_material_info_init(restitute_material_info *info);

/** Read a material, by the extension of the file.
 *
 *  `.csv`: the columns tau_s (relaxation times, s) and G_Pa (moduli, Pa) of a pure Prony series; Poisson ratio 0.5.
 *  Lines that begin with # are comments.
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
 *        prony           terms: [{"tau_s": .., "modulus_pa": ..}, ..], or prony_csv: the name of a .csv file as above,
 *                        relative to the folder of the JSON file;
 *                        optional equilibrium_modulus_pa >= 0 and parallel_viscosity_pa_s >= 0, both 0 if absent
 *
 *  All moduli are shear moduli, G = E/(2(1 + nu)); ranges are those of @ref restitute_material_prony. Unknown and repeated
 *  keys are refused.
 *  Both files are regular ones of at most 64 MiB: a FIFO, a device and what is larger are refused by name.
 *
 *  @param path      the file
 *  @param material  the new material, for @ref restitute_material_destroy
 *  @param error     optional
 *  @return ERROR_FILE (cannot be read, not regular, too large), ERROR_FORMAT (not of the form above), ERROR_DOMAIN (a
 *          value out of its range), ERROR_NULL, ERROR_MEMORY */
RESTITUTE_API int restitute_material_read(const char *path, restitute_material **material, restitute_error *error);

/** The same, with what else the file says.
 *
 *      restitute_material_info info; restitute_material_info_init(&info);
 *      restitute_material_read_info("polyisobutylene.json", &rubber, &info, &error);      // info.density: 920
 *
 *  @param info  optional, NULL: not wanted */
RESTITUTE_API int restitute_material_read_info(const char *path, restitute_material **material,
                                               restitute_material_info *info, restitute_error *error);

/* ---- CSV tables */

/** A table of text cells: a header row of column names, then rows of as many cells. Immutable. */
typedef struct restitute_csv restitute_csv;

/** Read a table (RFC 4180: commas, optional double quotes; LF or CRLF). Empty lines and lines that begin with # are
 *  skipped, spaces around unquoted cells dropped.
 *
 *  @param path   a regular file; "-" is standard input, of whatever kind; either has at most 4 GiB
 *  @param csv    the new table, for @ref restitute_csv_destroy; it may have no rows
 *  @param error  optional
 *  @return ERROR_FILE (cannot be read, not regular, too large); ERROR_FORMAT for an empty file, a row with more or fewer cells than the header, a stray quote,
 *          an empty or repeated column name; ERROR_NULL, ERROR_MEMORY
 *
 *      restitute_csv *table;
 *      if (restitute_csv_read("cases.csv", &table, &error) == RESTITUTE_OK) puts(restitute_csv_cell(table, 0, 0)); */
RESTITUTE_API int restitute_csv_read(const char *path, restitute_csv **csv, restitute_error *error);

/** Release a table; NULL is allowed. */
RESTITUTE_API void restitute_csv_destroy(restitute_csv *csv);

/** Number of rows below the header, and of columns; 0 for NULL. */
RESTITUTE_API size_t restitute_csv_rows(const restitute_csv *csv);
RESTITUTE_API size_t restitute_csv_columns(const restitute_csv *csv);

/** Name of a column, 0 to columns - 1; NULL outside. */
RESTITUTE_API const char *restitute_csv_name(const restitute_csv *csv, size_t column);

/** A cell, row and column from 0; NULL outside. It lives as long as the table. */
RESTITUTE_API const char *restitute_csv_cell(const restitute_csv *csv, size_t row, size_t column);

/** The line of the file, from 1, on which a row ends; 0 outside. */
RESTITUTE_API size_t restitute_csv_line(const restitute_csv *csv, size_t row);

/** FNV-1a of the file's bytes; 0 for NULL. */
RESTITUTE_API uint64_t restitute_csv_fingerprint(const restitute_csv *csv);

/** Read one number strictly: decimal digits with an optional sign, point and exponent, or inf; the whole text, no spaces.
 *
 *  @return OK; ERROR_FORMAT for anything else ("1.0x", "", "nan", "0x10"); ERROR_DOMAIN for one too large for a double or
 *          too small to differ from 0; ERROR_NULL
 *
 *      double value;
 *      int status = restitute_number_read("1e-9", &value); */
RESTITUTE_API int restitute_number_read(const char *text, double *value);

#ifdef __cplusplus
}
#endif

#endif
