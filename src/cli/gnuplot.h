/* A figure drawn by gnuplot as a child process: commands through a pipe, no shell, the picture back on its output.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_GNUPLOT_H
#define CLI_GNUPLOT_H

#include <sys/types.h>

#include "output.h"

struct gnuplot {
    FILE *commands; /* write gnuplot commands here */
    FILE *complaints;
    pid_t process;
    struct output picture;
};

/* Refuse an extension other than .svg and .png, and a machine without gnuplot. */
bool gnuplot_check(const char *path, struct reason *why);

/* Start gnuplot for a picture of this size (in points; .png has twice as many pixels). */
bool gnuplot_open(const char *path, int width, int height, struct gnuplot *gnuplot, struct reason *why);

/* All commands are written: wait for the picture and give it its name. */
bool gnuplot_close(struct gnuplot *gnuplot, struct reason *why);

/* Write a text as a gnuplot string that can do nothing but be shown. */
void gnuplot_string(FILE *commands, const char *text);

#endif
