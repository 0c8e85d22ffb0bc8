/* Messages, numbers as text, and memory for the command.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "message.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Length of the character of UTF-8 at `text` if a terminal shows it; 0 for a control character or
 * what is no UTF-8. */
static size_t shown(const unsigned char *text)
{
    const size_t length = *text < 0x80   ? 1
                          : *text < 0xc2 ? 0
                          : *text < 0xe0 ? 2
                          : *text < 0xf0 ? 3
                          : *text < 0xf5 ? 4
                                         : 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80) return 0;
    const bool control = *text < 0x20 || *text == 0x7f || (*text == 0xc2 && text[1] < 0xa0);
    return control ? 0 : length;
}

void escape(char *text, size_t size)
{
    char copy[2000], *to = text;
    snprintf(copy, sizeof copy, "%s", text);
    for (const unsigned char *from = (const unsigned char *)copy; *from;) {
        const size_t length = shown(from), room = size - (size_t)(to - text);
        if ((length ? length : 4) >= room) break;
        if (length)
            memcpy(to, from, length);
        else
            snprintf(to, room, "\\x%02x", *from);
        to += length ? length : 4;
        from += length ? length : 1;
    }
    *to = '\0';
}

bool refuse(struct reason *why, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why->text, sizeof why->text, format, arguments);
    va_end(arguments);
    escape(why->text, sizeof why->text);
    return false;
}

int complain(const char *format, ...)
{
    char text[2000];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    escape(text, sizeof text);
    fprintf(stderr, "restitute: %s\n", text);
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
