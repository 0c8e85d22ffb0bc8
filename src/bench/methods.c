/* The table of methods. A new method of the library is one more line, and one more in BENCH_METHODS.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "methods.h"

#include <string.h>

#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif

const struct bench_method bench_methods[BENCH_METHODS] = {
    {.name = "euler", .handle = restitute_method_euler, .takes_time_step = 1, .finest = 1e-5, .fine = 1e-4},
    {.name = "sync", .handle = restitute_method_sync, .finest = 1e-8, .fine = 1e-8},
    {.name = "paper-euler", .motion = PAPER_EULER, .takes_time_step = 1},
    {.name = "paper-verlet", .motion = PAPER_VERLET, .takes_time_step = 1},
    {.name = "paper-forward", .motion = PAPER_FORWARD, .takes_time_step = 1},
#ifdef RESTITUTE_WITH_CVODE
    {.name = "cvode", .handle = restitute_method_cvode},
#endif
};

const struct bench_method *bench_reference_method(void)
{
    const struct bench_method *best = NULL;
    for (int i = 0; i < BENCH_METHODS; i++) {
        const struct bench_method *m = &bench_methods[i];
        if (m->finest > 0 && (!best || m->finest < best->finest)) best = m;
    }
    return best;
}

int bench_method_index(const char *name, size_t length)
{
    for (int i = 0; i < BENCH_METHODS; i++)
        if (strlen(bench_methods[i].name) == length && memcmp(bench_methods[i].name, name, length) == 0) return i;
    return -1;
}
