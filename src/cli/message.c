/* Messages, numbers as text, and memory for the command.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "message.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool refuse(struct reason *why, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why->text, sizeof why->text, format, arguments);
    va_end(arguments);
    return false;
}

int complain(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fputs("restitute: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    return EXIT_USAGE;
}

struct number_text number_text(double value)
{
    struct number_text result;
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(result.text, sizeof result.text, "%.*g", digits, value);
        if (isnan(value) || strtod(result.text, NULL) == value) break;
    }
    return result;
}

void out_of_memory(void)
{
    complain("out of memory");
    exit(EXIT_USAGE);
}

void *allocate(size_t count, size_t size)
{
    void *memory = calloc(count ? count : 1, size ? size : 1);
    if (!memory) out_of_memory();
    return memory;
}

char *copy_of(const char *text)
{
    const size_t size = strlen(text) + 1;
    return memcpy(allocate(size, 1), text, size);
}
