/** @file table_files.h
 *  Component `table_files` of restitute: tables in HDF5 files.
 *
 *  Link restitute::table_files. It needs HDF5; a program that builds its tables in memory (table.h) does not. The rules of
 *  restitute.h hold. HDF5 itself is usually built for one thread: do not call these functions from several at once.
 *
 *      restitute_table_write(table, "rubber.h5", &error);
 *      restitute_table *table; restitute_table_read("rubber.h5", &table, &error);
 *
 *  A file is an ordinary HDF5 file, which h5py, h5dump or MATLAB read, behind a user block of 512 bytes: one line of text that says what it is,
 *  the version of its schema, and a checksum of all bytes behind it. Nothing of a file whose checksum is wrong reaches
 *  HDF5: a damaged or cut file is refused, or it gives the same table.
 *  The checksum stops accidents, not strangers, who can compute it: HDF5 then reads what they made. Do not open files of strangers.
 *  What is read is a regular file of at most 4 GiB, and room is made for no more values than it has bytes.
 *
 *  How files are written:
 *  - A file is made in memory and written beside its place as PATH.restitute-N.tmp. It gets its name when it is
 *    complete. On any failure the old file stays and nothing else is left. HDF5 itself never sees the disk.
 *  - Symbolic links are followed and stay.
 *  - A file that is replaced keeps its mode, and its owner where that is allowed. A new one has 0666 less the umask.
 *    A read-only file is refused.
 *  - A device, a pipe, or an open file that /dev/stdout names is written through and never replaced.
 *    Folders, sockets and block devices are refused.
 *  - The temporary file is locked (flock). What a killed process left is removed by the next call with that path.
 *
 *  Where memory runs out, this library returns ERROR_MEMORY or ERROR_FILE; what HDF5 itself does then is its own matter.
 *
 *  Schema 3. Attributes of the root: `kind` ("contact" or "ranges"), `restitute_version`, `tolerance`, `error_ez`,
 *  `error_ex` (verified), `impacts`, `checks`, and the members of @ref restitute_table_data of the same names. Datasets, each with
 *  attributes `units` and `description`: `speed` or `delta1`, `gamma`, `chi`, `psi` (1 + y beyond psi = 1) along the axes; `ez` [speed][gamma];
 *  `ex` [speed][gamma][psi][chi]; `relaxation_time`, `modulus` of the material.
 *
 *  A table with axes of delta1 and gamma (`cells` > 0) has instead `leaves` [cells][7], `rebound_leaves` [rebound_cells][7], `chain`,
 *  `functions` [coefficient][4], `ez` [rebound_cells][17], and `ex` [cells][coefficient] in single precision.
 *
 *  Files of schemas 1 and 2 are read, but for tables with axes of delta1 and gamma and for unfinished ones.
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_TABLE_FILES_H
#define RESTITUTE_TABLE_FILES_H

#include <restitute/table.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Write a table, as said above. A program with a limit on the size of files (RLIMIT_FSIZE) gets an error if it ignores
 *  SIGXFSZ; else that signal ends it.
 *
 *  @return OK, ERROR_FILE, ERROR_NULL, ERROR_MEMORY */
RESTITUTE_API int restitute_table_write(const restitute_table *table, const char *path, restitute_error *error);

/** Read a table. It looks up the bits that the written one does.
 *
 *  @param table  the new table, for @ref restitute_table_destroy
 *  @return OK; ERROR_FILE (cannot be read, not regular, too large); ERROR_FORMAT (damaged, cut, of another schema, or no table at all); ERROR_NULL,
 *          ERROR_MEMORY */
RESTITUTE_API int restitute_table_read(const char *path, restitute_table **table, restitute_error *error);

/** Write what a builder has solved, to go on from later.
 *
 *  @param settings  a line of your own that names family and options; only a builder with the same line may go on
 *  @return as @ref restitute_table_write */
RESTITUTE_API int restitute_table_builder_write(const restitute_table_builder *builder, const char *settings,
                                                const char *path, restitute_error *error);

/** Give a new builder what another one wrote, see @ref restitute_table_builder_restore.
 *
 *  @return ERROR_DOMAIN if the file is for other settings; else as @ref restitute_table_read */
RESTITUTE_API int restitute_table_builder_read(restitute_table_builder *builder, const char *settings, const char *path,
                                               restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
