/* Text with numbers, and setting the optional error of a call. Every library has its own, since
 * none exports them.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_REPORT_H
#define RST_REPORT_H

#include <restitute/restitute.h>
#include <stdarg.h>

#if defined(__GNUC__)
#define RST_PRINTF(position, first) __attribute__((__format__(__printf__, position, first)))
#else
#define RST_PRINTF(position, first)
#endif

/* vsnprintf and snprintf with a decimal point, whatever locale the program has set: programs read
 * names and messages. */
int rst_vprint(char *text, size_t size, const char *format, va_list arguments) RST_PRINTF(3, 0);
int rst_print(char *text, size_t size, const char *format, ...) RST_PRINTF(3, 4);

/* Fill `error` (if wanted) and return `status`. */
int rst_report(restitute_error *error, int status, const char *format, ...) RST_PRINTF(3, 4);

/* Add a remark behind what `error` (if wanted) says already; its status stays. */
void rst_remark(restitute_error *error, const char *format, ...) RST_PRINTF(2, 3);

/* Clear `error` (if wanted) and return OK. */
int rst_done(restitute_error *error);

#endif
