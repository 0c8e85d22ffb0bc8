/* The file of a run that may be long, OUT.partial: lines as far as they are done, so that an
 * interrupted run can go on. It is locked as long as it is open: of two runs with one output one is
 * refused.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_UNFINISHED_H
#define CLI_UNFINISHED_H

#include "output.h"

struct unfinished {
    char *path; /* beside the file that the output leads to; NULL: not open */
    int file;
    bool empty; /* nothing is done yet */
};

/* Open OUT.partial of an output. One that is left from an interrupted run is continued with
 * `resume`, else refused. */
bool unfinished_open(const char *output, bool resume, struct unfinished *unfinished, struct reason *why);

/* Lock the file that has the name now. */
bool unfinished_lock_again(struct unfinished *unfinished, struct reason *why);

/* Cut off a last line that was not written to its end; what comes next is appended. Line ends
 * within quotes are none. */
bool unfinished_cut(struct unfinished *unfinished, struct reason *why);

/* Append what was written to an output, which is released. */
bool unfinished_append(struct unfinished *unfinished, struct output *lines, struct reason *why);

/* Give it the final name, if it has so many lines. */
bool unfinished_commit(struct unfinished *unfinished, const char *output, size_t lines, struct reason *why);

/* Close it; the file stays for --resume, or is removed. Nothing happens to one that is not open. */
void unfinished_leave(struct unfinished *unfinished);
void unfinished_remove(struct unfinished *unfinished);

#endif
