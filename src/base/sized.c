/* Structs that grow at their end.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/sized.h"

#include <string.h>

#include "base/report.h"

/* A longer one has members that we do not know: it gets its size alone, and every call refuses
 * it. */
void rst_init(void *value, size_t size, const void *defaults, size_t size_of_defaults)
{
    if (!value) return;
    if (size <= size_of_defaults) memcpy(value, defaults, size);
    memcpy(value, &size, sizeof size);
}

int rst_check_layout(const struct rst_layout *layout, const void *value, restitute_error *error)
{
    const size_t size = *(const size_t *)value;
    if (size >= layout->first && size <= layout->size) return RESTITUTE_OK;
    if (size > layout->size && size % sizeof(size_t) == 0 && size < 2 * layout->size)
        return rst_report(
            error, RESTITUTE_ERROR_STRUCT_SIZE,
            "%s.struct_size = %zu: must be at most %zu; the program was compiled with later headers than those "
            "of the library in use",
            layout->name, size, layout->size);
    return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                      "%s.struct_size = %zu: must be %zu; prepare the struct with %s_init", layout->name, size,
                      layout->size, layout->name);
}

void rst_copy(void *to, size_t size, const void *from)
{
    const size_t there = *(const size_t *)to, here = *(const size_t *)from;
    if (there < size) size = there;
    if (here < size) size = here;
    memcpy((char *)to + sizeof size, (const char *)from + sizeof size, size - sizeof size);
}
