/* Text with numbers, and setting the optional error of a call. Every library has its own, since
 * none exports them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_REPORT_H
#define RST_REPORT_H

#include <locale.h>
#include <restitute/restitute.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#if defined(__GNUC__)
#define RST_PRINTF(position, first) __attribute__((__format__(__printf__, position, first)))
#else
#define RST_PRINTF(position, first)
#endif

static inline int rst_vprint(char *text, size_t size, const char *format, va_list arguments) RST_PRINTF(3, 0);
static inline int rst_print(char *text, size_t size, const char *format, ...) RST_PRINTF(3, 4);

/* vsnprintf and snprintf with a decimal point, whatever locale the program has set: programs read
 * names and messages. */
static inline int rst_vprint(char *text, size_t size, const char *format, va_list arguments)
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

static inline int rst_print(char *text, size_t size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = rst_vprint(text, size, format, arguments);
    va_end(arguments);
    return length;
}

static inline int rst_report(restitute_error *error, int status, const char *format, ...) RST_PRINTF(3, 4);

/* Fill `error` (if wanted) and return `status`. */
static inline int rst_report(restitute_error *error, int status, const char *format, ...)
{
    if (error) {
        va_list arguments;
        error->status = status;
        va_start(arguments, format);
        rst_vprint(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
    }
    return status;
}

static inline void rst_remark(restitute_error *error, const char *format, ...) RST_PRINTF(2, 3);

/* Append a remark to the message in `error` (if wanted); its status stays. */
static inline void rst_remark(restitute_error *error, const char *format, ...)
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

/* Clear `error` (if wanted) and return OK. */
static inline int rst_done(restitute_error *error)
{
    if (error) {
        error->status = RESTITUTE_OK;
        error->message[0] = '\0';
    }
    return RESTITUTE_OK;
}

#endif
