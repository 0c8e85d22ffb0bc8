/* Setting the optional error of a call; the core has the same, which it does not export.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_REPORT_H
#define RST_CVODE_REPORT_H

#include <restitute/restitute.h>

#if defined(__GNUC__)
#define RST_CVODE_PRINTF __attribute__((__format__(__printf__, 3, 4)))
#else
#define RST_CVODE_PRINTF
#endif

/* Fill `error` (if wanted) and return `status`. */
int report(restitute_error *error, int status, const char *format, ...) RST_CVODE_PRINTF;

/* Clear `error` (if wanted) and return OK. */
int report_done(restitute_error *error);

#endif
