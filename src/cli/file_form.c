/* The endings of file names.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _XOPEN_SOURCE 700

#include "file_form.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

enum file_form file_form_of(const char *path)
{
    static const struct {
        const char *ending;
        enum file_form form;
    } known[] = {{".csv", FORM_CSV}, {".h5", FORM_HDF5}, {".hdf5", FORM_HDF5},
                 {".svg", FORM_SVG}, {".png", FORM_PNG}, {".pdf", FORM_PDF}};
    const char *ending = strrchr(path, '.');
    for (size_t i = 0; ending && i < sizeof known / sizeof known[0]; i++)
        if (strcasecmp(ending, known[i].ending) == 0) return known[i].form;
    return FORM_UNKNOWN;
}
