/* Structs that grow at their end.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/sized.h"

#include <string.h>

#include "base/report.h"

/* A longer one has members that we do not know. They are 0, so that the caller may release what the
 * struct points to after every call has refused it. */
void rst_init(void *value, size_t size, const void *defaults, size_t size_of_defaults)
{
    if (!value || size < sizeof size) return;
    memset(value, 0, size);
    memcpy(value, defaults, size < size_of_defaults ? size : size_of_defaults);
    memcpy(value, &size, sizeof size);
}

/* Bytes by which later headers may lengthen a struct. What is longer was not prepared at all. */
static const size_t most_growth = 4096;

int rst_check_layout(const struct rst_layout *layout, const void *value, restitute_error *error)
{
    const size_t size = *(const size_t *)value, first = layout->first;
    const int whole = size % sizeof size == 0;
    if (whole && size >= first && size <= layout->size) return RESTITUTE_OK;
    if (whole && size > layout->size && size - layout->size <= most_growth)
        return rst_report(
            error, RESTITUTE_ERROR_STRUCT_SIZE,
            "%s.struct_size = %zu: must be at most %zu; the program was compiled with later headers than those "
            "of the library in use",
            layout->name, size, layout->size);
    if (first == layout->size)
        return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                          "%s.struct_size = %zu: must be %zu; prepare the struct with %s_init", layout->name, size,
                          first, layout->name);
    return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                      "%s.struct_size = %zu: must be in [%zu, %zu], a multiple of %zu; prepare the struct with %s_init",
                      layout->name, size, first, layout->size, sizeof size, layout->name);
}

int rst_check_array(const struct rst_layout *layout, const void *array, size_t n, const char *name,
                    restitute_error *error)
{
    int status = n > 0 ? rst_check_layout(layout, array, error) : RESTITUTE_OK;
    for (size_t i = 1; i < n && !status; i++) {
        const size_t size = *(const size_t *)rst_at(array, i), first = *(const size_t *)array;
        if (size != first)
            status = rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                                "%s[%zu].struct_size = %zu: must be %zu, as of the first", name, i, size, first);
    }
    return status;
}

void rst_copy(void *to, size_t size, const void *from)
{
    const size_t there = *(const size_t *)to, here = *(const size_t *)from;
    if (there < size) size = there;
    if (here < size) size = here;
    memcpy((char *)to + sizeof size, (const char *)from + sizeof size, size - sizeof size);
}

int rst_take(const struct rst_layout *layout, void *ours, const void *theirs, restitute_error *error)
{
    const int status = theirs ? rst_check_layout(layout, theirs, error) : RESTITUTE_OK;
    if (theirs && !status) rst_copy(ours, layout->size, theirs);
    return status;
}
