/* Status texts and error messages.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "status.h"

#include <stdarg.h>
#include <stdio.h>

#include "version.h"

const char *restitute_status_text(int status)
{
    switch (status) {
#define TEXT_OF(name, value, text)                                                                                     \
    case RESTITUTE_##name:                                                                                             \
        return text;
        RESTITUTE_STATUS_LIST(TEXT_OF)
#undef TEXT_OF
    default:
        return "unknown status";
    }
}

const char *restitute_version(void)
{
    return RESTITUTE_VERSION_TEXT;
}

int rst_report(restitute_error *error, int status, const char *format, ...)
{
    if (error) {
        va_list arguments;
        error->status = status;
        va_start(arguments, format);
        vsnprintf(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
    }
    return status;
}

int rst_done(restitute_error *error)
{
    if (error) {
        error->status = RESTITUTE_OK;
        error->message[0] = '\0';
    }
    return RESTITUTE_OK;
}
