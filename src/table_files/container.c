/* The block of text with the checksum, before HDF5 that is made in memory.
 *
 * The block: a line "restitute <title>, schema <n>, checksum <16 hexadecimal digits>, bytes
 * <count>, values at <places of the datasets>", a line for human readers, zeros up to 512 bytes.
 * The checksum is FNV-1a of all bytes after the block, then of the places. A change of a single
 * byte always changes it.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "table_files/container.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/whole_file.h"
#include "io/new_file.h"

enum { block_size = 512 };

static uint64_t checksum(const unsigned char *bytes, size_t size, const uint64_t place[rst_sets])
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    for (int i = 0; i < rst_sets; i++)
        hash = (hash ^ place[i]) * UINT64_C(0x100000001b3);
    return hash;
}

static const char before_places[] = ", values at";

static void make_block(const char *title, const unsigned char *bytes, size_t size, const uint64_t place[rst_sets],
                       char block[block_size])
{
    memset(block, 0, block_size);
    int used = snprintf(block, block_size, "restitute %s, schema %d, checksum %016" PRIx64 ", bytes %zu%s", title,
                        rst_schema, checksum(bytes, size, place), size, before_places);
    for (int i = 0; i < rst_sets; i++)
        used += snprintf(block + used, (size_t)(block_size - used), " %" PRIu64, place[i]);
    snprintf(block + used, (size_t)(block_size - used),
             "\nHDF5 begins at byte 512 (a user block of HDF5); h5py and h5dump read this file as it is.\n");
}

/* ---- reading bytes */

/* No table is larger. */
static const uint64_t most_bytes = UINT64_C(1) << 32;

static int read_all(const char *path, struct rst_old_file *file, restitute_error *error)
{
    char *bytes = NULL;
    const int status = rst_read_whole(path, path, most_bytes, &bytes, &file->size, error);
    if (status == RESTITUTE_OK) file->bytes = (unsigned char *)bytes;
    return status;
}

/* Report what is wrong with the block. */
static int refuse_block(const char *path, const char *title, const struct rst_old_file *file,
                        restitute_error *error)
{
    char start[64];
    int version = 0;
    snprintf(start, sizeof start, "restitute %s, schema ", title);
    const size_t length = strlen(start);
    if (file->size < length || memcmp(file->bytes, start, length) != 0)
        return rst_report(error, RESTITUTE_ERROR_FORMAT, "%.120s: is not a %s file of restitute", path, title);
    for (size_t i = length; i < file->size && i < length + 6 && file->bytes[i] >= '0' && file->bytes[i] <= '9'; i++)
        version = 10 * version + (file->bytes[i] - '0');
    if (version > rst_schema)
        return rst_report(error, RESTITUTE_ERROR_FORMAT,
                          "%.120s: schema %d: this library reads schema %d; it was written by a later one, or is damaged",
                          path, version, rst_schema);
    if (version > 0 && version < rst_schema)
        return rst_report(error, RESTITUTE_ERROR_FORMAT,
                          "%.120s: schema %d, of an earlier library; this one reads schema %d: build the table again",
                          path, version, rst_schema);
    return rst_report(error, RESTITUTE_ERROR_FORMAT, "%.120s: is damaged or cut: its checksum is wrong", path);
}

/* The places are read from the block. Then the block is written again with them and compared: any
 * other form is refused. */
static int check_block(const char *path, const char *title, struct rst_old_file *file, restitute_error *error)
{
    char block[block_size], text[block_size + 1] = "";
    const size_t size = file->size > block_size ? file->size - block_size : 0;
    if (size == 0) return refuse_block(path, title, file, error);
    memcpy(text, file->bytes, block_size);
    char *next = strstr(text, before_places);
    if (next) next += strlen(before_places);
    for (int i = 0; i < rst_sets && next; i++)
        file->place[i] = strtoull(next, &next, 10);
    make_block(title, file->bytes + block_size, size, file->place, block);
    if (memcmp(block, file->bytes, block_size) == 0) return RESTITUTE_OK;
    return refuse_block(path, title, file, error);
}

int rst_old_file_open(const char *path, const char *title, struct rst_old_file *file, restitute_error *error)
{
    *file = (struct rst_old_file){0};
    int status = read_all(path, file, error);
    if (!status) status = check_block(path, title, file, error);
    if (status) rst_old_file_close(file);
    return status;
}

void rst_old_file_close(struct rst_old_file *file)
{
    free(file->bytes);
    *file = (struct rst_old_file){0};
}

/* ---- writing */

hid_t rst_container_begin(void)
{
    return rst_image_create(block_size);
}

/* Block and image as one file. Returns 0 or an errno. */
static int write_file(const char *title, const uint64_t *place, const void *image, size_t size, const char *path)
{
    struct rst_new_file file;
    char *bytes = malloc(block_size + size);
    if (!bytes) return ENOMEM;
    make_block(title, image, size, place, bytes);
    memcpy(bytes + block_size, image, size);
    int problem = rst_new_file_write(path, bytes, block_size + size, &file);
    if (!problem) problem = rst_new_file_commit(&file);
    free(bytes);
    return problem;
}

int rst_container_end(hid_t file, const uint64_t *place, const char *title, const char *path, restitute_error *error)
{
    size_t size = 0;
    void *image = file >= 0 ? rst_image_close(file, &size) : NULL;
    if (!place || !image) {
        free(image);
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "%.120s: cannot be made: HDF5 fails in memory", path);
    }
    const int problem = write_file(title, place, image, size, path);
    free(image);
    if (problem == ENOMEM) return rst_report(error, RESTITUTE_ERROR_MEMORY, "%.120s: out of memory", path);
    if (problem)
        return rst_report(error, RESTITUTE_ERROR_FILE, "%.120s: cannot be written: %s", path, strerror(problem));
    return RESTITUTE_OK;
}
