/* The library's own way to copy structs, but for what it is there for: it heeds no length.
 * SPDX-License-Identifier: BSD-3-Clause */
#define rst_copy rst_sound_copy
#include "base/sized.c"
#undef rst_copy

void rst_copy(void *to, size_t size, const void *from)
{
    memcpy((char *)to + sizeof size, (const char *)from + sizeof size, size - sizeof size);
}
