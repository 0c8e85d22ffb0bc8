/* Setting the optional error of a call.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "report.h"

#include <stdarg.h>
#include <stdio.h>

int report(restitute_error *error, int status, const char *format, ...)
{
    va_list arguments;
    if (!error) return status;
    error->status = status;
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    return status;
}

int report_done(restitute_error *error)
{
    if (error) {
        error->status = RESTITUTE_OK;
        error->message[0] = '\0';
    }
    return RESTITUTE_OK;
}
