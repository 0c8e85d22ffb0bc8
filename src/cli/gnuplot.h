/* A figure drawn by gnuplot as a child process: commands from a temporary file, no shell, the
 * picture back by a pipe.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_GNUPLOT_H
#define CLI_GNUPLOT_H

#include "output.h"

struct gnuplot {
    FILE *commands; /* write gnuplot commands here */
    struct output picture;
};

/* Refuse an extension other than .svg, .png and .pdf, and a machine without gnuplot. */
bool gnuplot_check(const char *path, struct reason *why);

/* Begin a picture of this size (in points; .png has twice as many pixels). */
bool gnuplot_open(const char *path, int width, int height, struct gnuplot *gnuplot, struct reason *why);

/* All commands are written: let gnuplot draw, and give the picture its name. */
bool gnuplot_close(struct gnuplot *gnuplot, struct reason *why);

/* Write a text as a gnuplot string that can do nothing but be shown. */
void gnuplot_string(FILE *commands, const char *text);

#endif
