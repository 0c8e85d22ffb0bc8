/* Text with numbers, and setting the optional error of a call.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/report.h"

#include <locale.h>
#include <stdio.h>
#include <string.h>

int rst_vprint(char *text, size_t size, const char *format, va_list arguments)
{
    const locale_t none = (locale_t)0, plain = newlocale(LC_ALL_MASK, "C", none);
    const locale_t before = plain != none ? uselocale(plain) : none;
    const int length = vsnprintf(text, size, format, arguments);
    if (plain != none) {
        uselocale(before);
        freelocale(plain);
    }
    return length;
}

int rst_print(char *text, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = rst_vprint(text, size, format, arguments);
    va_end(arguments);
    return length;
}

int rst_report(restitute_error *error, int status, const char *format, ...)
{
    if (error) {
        va_list arguments;
        error->status = status;
        va_start(arguments, format);
        rst_vprint(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
        for (char *c = error->message; *c; c++) /* of a stranger's file: one line, and no terminal obeys it */
            if ((unsigned char)*c < ' ' || *c == 127) *c = '?';
    }
    return status;
}

void rst_remark(restitute_error *error, const char *format, ...)
{
    if (error) {
        va_list arguments;
        const size_t used = strlen(error->message), size = sizeof error->message;
        const int mark = used > 0 ? snprintf(error->message + used, size - used, "; ") : 0;
        if (used + (size_t)mark >= size) return;
        va_start(arguments, format);
        rst_vprint(error->message + used + mark, size - used - (size_t)mark, format, arguments);
        va_end(arguments);
    }
}

int rst_done(restitute_error *error)
{
    if (error) {
        error->status = RESTITUTE_OK;
        error->message[0] = '\0';
    }
    return RESTITUTE_OK;
}
