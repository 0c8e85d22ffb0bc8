/* What a builder has solved, in a file.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "container.h"

static const char title[] = "unfinished table";

/* Builders of earlier schemas asked for other impacts. */
enum { oldest_schema = 3 };

static int write_journal(const restitute_table_builder *builder, const char *settings, const char *path,
                         restitute_error *error)
{
    size_t count;
    const double *journal = restitute_table_builder_journal(builder, &count), nothing[4] = {0};
    const int64_t size[2] = {(int64_t)count, 4};
    const hid_t file = rst_container_begin();
    const int failed = file < 0 || rst_put_text(file, "settings", settings) ||
                       rst_put_text(file, "restitute_version", restitute_version()) ||
                       rst_put_values(file, "impacts", RST_DOUBLES, 2, size, count ? journal : nothing, "1",
                                      "ez, ex, estimated error of ez, of ex");
    return rst_container_end(file, !failed, title, path, error);
}

int restitute_table_builder_write(const restitute_table_builder *builder, const char *settings, const char *path,
                                  restitute_error *error)
{
    if (!builder || !settings || !path)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !builder    ? "builder"
                          : !settings ? "settings"
                                      : "path");
    const struct rst_quiet quiet = rst_quiet_begin();
    const int status = write_journal(builder, settings, path, error);
    rst_quiet_end(quiet);
    return status ? status : rst_done(error);
}

/* The text of an attribute is what its own length and content say. */
static int check_text(hid_t file, const char *name, const char *text, const char *path, restitute_error *error)
{
    const size_t size = strlen(text) + 2;
    char *found = malloc(size);
    if (!found) return rst_report(error, RESTITUTE_ERROR_MEMORY, "%.120s: out of memory", path);
    const int same = rst_get_text(file, name, size, found) == 0 && strcmp(found, text) == 0;
    free(found);
    if (same) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%.120s: was begun with other settings or by another version",
                      path);
}

static int read_journal(hid_t file, restitute_table_builder *builder, const char *settings, const char *path,
                        restitute_error *error)
{
    int status = check_text(file, "settings", settings, path, error);
    if (!status) status = check_text(file, "restitute_version", restitute_version(), path, error);
    if (status) return status;
    const int64_t count = rst_count_values(file, "impacts", RST_DOUBLES);
    double *journal = count >= 0 ? malloc((size_t)(count + 1) * sizeof *journal) : NULL;
    if (count >= 0 && !journal)
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "%.120s: out of memory for its impacts", path);
    if (!journal || count % 4 != 0 || (count > 0 && rst_get_values(file, "impacts", RST_DOUBLES, count, journal))) {
        free(journal);
        return rst_report(error, RESTITUTE_ERROR_FORMAT, "%.120s: holds no impacts", path);
    }
    status = restitute_table_builder_restore(builder, journal, (size_t)count / 4, error);
    free(journal);
    return status;
}

int restitute_table_builder_read(restitute_table_builder *builder, const char *settings, const char *path,
                                 restitute_error *error)
{
    struct rst_old_file file;
    if (!builder || !settings || !path)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !builder    ? "builder"
                          : !settings ? "settings"
                                      : "path");
    const struct rst_quiet quiet = rst_quiet_begin();
    int status = rst_old_file_open(path, title, oldest_schema, &file, error);
    if (!status) {
        status = read_journal(file.file, builder, settings, path, error);
        rst_old_file_close(&file);
    }
    rst_quiet_end(quiet);
    return status ? status : rst_done(error);
}
