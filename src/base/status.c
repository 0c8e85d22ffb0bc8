/* Status texts, version.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/status.h"

#define TEXT(number) #number
#define VERSION_TEXT(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

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
    return VERSION_TEXT(RESTITUTE_VERSION_MAJOR, RESTITUTE_VERSION_MINOR, RESTITUTE_VERSION_PATCH);
}
