/* Outputs of the command.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool output_is_standard(const char *path)
{
    return !path || strcmp(path, "-") == 0;
}

bool output_is_stream(const char *path)
{
    struct rst_place place;
    if (output_is_standard(path)) return true;
    if (rst_place_find(path, &place) != 0) return false;
    rst_place_release(&place);
    return place.through;
}

char *path_with_suffix(const char *path, const char *suffix)
{
    const size_t size = strlen(path) + strlen(suffix) + 1;
    char *joined = allocate(size, 1);
    snprintf(joined, size, "%s%s", path, suffix);
    return joined;
}

char *path_beside(const char *path, const char *suffix)
{
    struct rst_place place;
    if (rst_place_find(path, &place) != 0) return path_with_suffix(path, suffix);
    char *beside = path_with_suffix(place.target, suffix);
    rst_place_release(&place);
    return beside;
}

static bool not_written(const char *path, int problem, struct reason *why)
{
    return output_is_standard(path) ? refuse(why, "standard output cannot be written: %s", strerror(problem))
                                    : refuse(why, "%.200s: cannot be written: %s", path, strerror(problem));
}

bool output_check(const char *path, const char *option, struct reason *why)
{
    struct rst_place place;
    if (output_is_standard(path)) return true;
    if (!*path) return refuse(why, "%s is empty: must be a file name", option);
    int problem = rst_place_find(path, &place);
    if (problem == EISDIR || problem == ENOTSUP)
        return refuse(why, "%s = %.200s: is not a regular file, nor a device or pipe; - is standard output", option,
                      path);
    if (!problem) {
        problem = rst_place_check(&place);
        rst_place_release(&place);
    }
    return problem ? refuse(why, "%s = %.200s: cannot be written: %s", option, path, strerror(problem)) : true;
}

bool output_open(const char *path, struct output *output, struct reason *why)
{
    memset(output, 0, sizeof *output);
    output->stream = open_memstream(&output->bytes, &output->size);
    if (!output->stream) return refuse(why, "out of memory");
    if (!output_is_standard(path)) output->path = copy_of(path);
    return true;
}

int output_open_stream(const char *path, struct reason *why)
{
    struct rst_place place;
    if (output_is_standard(path)) return STDOUT_FILENO;
    int problem = rst_place_find(path, &place), file = -1;
    if (!problem) {
        file = rst_open_through(&place);
        problem = errno;
        rst_place_release(&place);
    }
    if (file < 0) not_written(path, problem, why);
    return file;
}

bool output_send(struct output *output, int descriptor, const char *name, struct reason *why)
{
    int problem = fflush(output->stream) == 0 ? 0 : ENOMEM; /* that is all that memory can lack */
    if (!problem) problem = rst_write_all(descriptor, output->bytes, output->size);
    outputs_abandon(output, 1);
    return problem ? not_written(name, problem, why) : true;
}

/* Standard output may hold what was printed before. */
static int write_standard(const struct output *output)
{
    return fflush(stdout) == 0 ? rst_write_all(STDOUT_FILENO, output->bytes, output->size) : errno;
}

bool outputs_write(struct output *outputs, size_t count, struct reason *why)
{
    for (size_t i = 0; i < count; i++) {
        struct output *o = &outputs[i];
        if (!o->stream) continue;
        int problem = fclose(o->stream) == 0 ? 0 : ENOMEM;
        o->stream = NULL;
        if (!problem && o->path) {
            problem = rst_new_file_write(o->path, o->bytes, o->size, &o->file);
            o->written = !problem;
        } else if (!problem) {
            problem = write_standard(o);
        }
        if (!problem) continue;
        not_written(o->path, problem, why);
        outputs_abandon(outputs, count);
        return false;
    }
    return true;
}

bool outputs_commit(struct output *outputs, size_t count, struct reason *why)
{
    for (size_t i = 0; i < count; i++) {
        const int problem = outputs[i].written ? rst_new_file_commit(&outputs[i].file) : 0;
        outputs[i].written = false;
        if (!problem) continue;
        not_written(outputs[i].path, problem, why);
        outputs_abandon(outputs, count);
        return false;
    }
    outputs_abandon(outputs, count);
    return true;
}

bool outputs_finish(struct output *outputs, size_t count, struct reason *why)
{
    return outputs_write(outputs, count, why) && outputs_commit(outputs, count, why);
}

bool output_finish(struct output *output, struct reason *why)
{
    return outputs_finish(output, 1, why);
}

void outputs_abandon(struct output *outputs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct output *o = &outputs[i];
        if (o->stream) fclose(o->stream);
        if (o->written) rst_new_file_drop(&o->file);
        free(o->bytes);
        free(o->path);
        memset(o, 0, sizeof *o);
    }
}
