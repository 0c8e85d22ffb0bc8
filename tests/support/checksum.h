/* The checksum of a table file (FNV-1a of all bytes behind the block of text, then of the places of
 * its sets), put down as its writer does.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_CHECKSUM_H
#define TEST_CHECKSUM_H

#include <stdlib.h>
#include <string.h>

#include "check.h"

static inline void set_checksum(unsigned char *content, size_t length)
{
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    char text[17], *place = strstr((char *)content, "checksum ");
    CHECK(place != NULL, "no checksum");
    for (size_t i = 512; i < length; i++)
        hash = (hash ^ content[i]) * UINT64_C(0x100000001b3);
    char *next = strstr((char *)content, "values at");
    CHECK(next != NULL, "no places");
    next += strlen("values at");
    for (int i = 0; i < 7; i++)
        hash = (hash ^ strtoull(next, &next, 10)) * UINT64_C(0x100000001b3);
    snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
    memcpy(place + 9, text, 16);
}

#endif
