/* Work done by a child of this process, as programs that fork do it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_CHILD_H
#define TEST_CHILD_H

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "check.h"

/* Nonzero: the child's work was good. One that hangs is ended after ten minutes. */
static inline int good_in_child(int (*work)(void *of), void *of)
{
    int status = 0;
    fflush(NULL);
    const pid_t child = fork();
    CHECK(child >= 0, "no child");
    if (child == 0) {
        alarm(600);
        _exit(work(of) ? 0 : 1);
    }
    CHECK(waitpid(child, &status, 0) == child, "the child is lost");
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

#endif
