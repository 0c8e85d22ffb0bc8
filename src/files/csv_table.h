/* CSV tables, for materials and for the command: a header row of column names, then rows of as many
 * cells. Immutable.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CSV_TABLE_H
#define RST_CSV_TABLE_H

#include <restitute/restitute.h>

struct rst_csv;

/* Most bytes of a file: of a material, 64 MiB, a million of terms; of a table of cells, 4 GiB. */
#define RST_BYTES_OF_MATERIAL (UINT64_C(1) << 26)
#define RST_BYTES_OF_TABLE (UINT64_C(1) << 32)

/* Read a table (RFC 4180: commas, optional double quotes; LF or CRLF) of up to `most` bytes. Empty
 * lines and lines that begin with # are skipped, spaces around unquoted cells dropped. It may have
 * no rows.
 *
 * path     a regular file; "-" is standard input, of whatever kind
 * returns  ERROR_FILE (cannot be read, not regular, too large); ERROR_FORMAT for an empty file, a
 *          row with more or fewer cells than the header, a stray quote, an empty or repeated column
 *          name; ERROR_MEMORY */
int rst_csv_read(const char *path, uint64_t most, struct rst_csv **csv, restitute_error *error);

/* Release a table; NULL is allowed. */
void rst_csv_destroy(struct rst_csv *csv);

/* Number of rows below the header, and of columns. */
size_t rst_csv_rows(const struct rst_csv *csv);
size_t rst_csv_columns(const struct rst_csv *csv);

/* Name of a column, and a cell, from 0; they live as long as the table. */
const char *rst_csv_name(const struct rst_csv *csv, size_t column);
const char *rst_csv_cell(const struct rst_csv *csv, size_t row, size_t column);

/* The line of the file, from 1, on which a row ends. */
size_t rst_csv_line(const struct rst_csv *csv, size_t row);

/* FNV-1a of the file's bytes. */
uint64_t rst_csv_fingerprint(const struct rst_csv *csv);

#endif
