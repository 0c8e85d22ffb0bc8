/** @file table_files.h
 *  Component `table_files` of restitute: tables in HDF5 files.
 *
 *  Link restitute::table_files. It needs HDF5; a program that builds its tables in memory (table.h)
 *  does not. The rules of restitute.h hold. HDF5 itself is usually built for one thread: do not
 *  call these functions from several at once.
 *
 *      restitute_table_write(table, "rubber.h5", &error);
 *      restitute_table *table; restitute_table_read("rubber.h5", &table, &error);
 *
 *  A file is an ordinary HDF5 file, which h5py, h5dump or MATLAB read, behind a user block of 512
 *  bytes: one line of text that says what it is, the version of its schema, a checksum, and at
 *  which bytes the datasets begin. The checksum is of all bytes behind the block and of these
 *  places: a damaged or cut file is refused.
 *
 *  Files of strangers: @ref restitute_table_read does not use HDF5. It takes the values from the
 *  places that the block names and checks them, so that the worst a forged file can be is a wrong
 *  table. Do not open such a file with other programs: they use HDF5, which has read beyond its
 *  buffers in damaged files (1.10.8 in H5Aexists). A file must be regular and of at most 4 GiB. No
 *  array is larger than the file.
 *
 *  How files are written:
 *  - A file is made in memory and written beside its place as PATH.restitute-N.tmp. It gets its
 *    name when it is complete. On any failure the old file stays and nothing else is left. HDF5
 *    itself never sees the disk.
 *  - Symbolic links are followed and stay.
 *  - A file that is replaced keeps its mode, and its owner where that is allowed. A new one has
 *    0666 less the umask. A read-only file is refused.
 *  - A device, a pipe, or an open file that /dev/stdout names is written through and never
 *    replaced. Folders, sockets and block devices are refused.
 *  - The temporary file is locked (flock). What a killed process left is removed by the next call
 *    with that path.
 *
 *  Where memory runs out, this library returns ERROR_MEMORY or ERROR_FILE; the behaviour of HDF5 in
 *  writing is then unspecified.
 *
 *  Schema 8. The dataset `numbers` is one compound of doubles and 64-bit integers: the range of
 *  speeds `low` and `high`; `tolerance`, `error_ez`, `error_ex`, `impacts`, `checks`,
 *  `restitute_version` (text); the contact: `chi`, `gamma`, `delta1`, `psi_factor`, `duration`,
 *  `friction`, `radius`, `mass`, `density`, `dundurs_beta`, `poisson_ratio`, `equilibrium_modulus`,
 *  `parallel_viscosity`, and the window of the material, `shortest` and `longest`; the limits
 *  `speed_limit`, `radius_limit`, `displacement_limit`, `dundurs_limit`; the counts `speeds`,
 *  `stick_cells`, `slip_cells`, `terms`. The others are datasets of doubles. All are little-endian, in one piece,
 *  with attributes `units` and `description`:
 *
 *      speed [speeds]                                        m/s, ascending; two equal: a seam
 *      ez [speeds][2]                                        ez, d ez/ds
 *      ex [speeds][stick_cells + 1 + slip_cells + 1][4]      g, dg/ds, dg/dp, d2g/ds dp
 *      strain [speeds][4]                                    v/c_s, a_max/R, d_max/a_max, contact
 *                                                            time (s)
 *      relaxation_time [terms], modulus [terms]              of the material, s and Pa
 *
 *  s(v) is log2(v) within 7e-7. p counts the cells of psi: psi = p/stick_cells, then t =
 *  p/slip_cells with t(y) = 1/2 + (y - 1/2) (1 + c^(1/4) - (y (1 - y) + c)^(1/4)), c = 2e-4, y =
 *  (psi - 1)/(psi_c - 1). g is ex up to psi = 1, and psi ex - y ez beyond. Between nodes ez and g
 *  are Hermite's cubics: examples/tables/read_table.py.
 *
 *  Files of schemas 1 to 7 are refused: build the table again. Schemas 1 to 5 had tables of other
 *  kinds or another t(y). In schema 6 the numbers were attributes, which only HDF5 can read. Schema 7 had no contact times.
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_TABLE_FILES_H
#define RESTITUTE_TABLE_FILES_H

#include <restitute/table.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Write a table, as said above. A program with a limit on the size of files (RLIMIT_FSIZE) gets an
 *  error if it ignores SIGXFSZ; else that signal ends it.
 *
 *  @return OK, ERROR_FILE, ERROR_NULL, ERROR_MEMORY */
RESTITUTE_SINCE_0_1 int restitute_table_write(const restitute_table *table, const char *path,
    restitute_error *error);

/** Read a table. It looks up the bits that the written one does.
 *
 *  @param table  the new table, for @ref restitute_table_destroy
 *  @return OK; ERROR_FILE (cannot be read, not regular, too large); ERROR_FORMAT (damaged, cut, of
 *          another schema, or no table at all); ERROR_NULL, ERROR_MEMORY */
RESTITUTE_SINCE_0_1 int restitute_table_read(const char *path, restitute_table **table,
    restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
