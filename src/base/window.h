/* The window of times of a material, in words.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_WINDOW_H
#define RST_WINDOW_H

#include "base/report.h"

/* Remark that something, `text`, is not in the window, which two materials may not share. */
static inline void rst_remark_window(const char *text, const restitute_material *material, restitute_error *error)
{
    double shortest, longest;
    restitute_material_window(material, &shortest, &longest, NULL);
    if (shortest > longest)
        rst_remark(error, "%s the windows in which the two materials were measured: they have no time in common", text);
    else
        rst_remark(error, "%s the window %.3g to %.3g s in which the material was measured", text, shortest, longest);
}

#endif
