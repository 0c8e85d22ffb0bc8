/* Stability map: what a method makes of a prescribed number of steps, over the plane of (delta1, gamma).
 *
 * chi = 7/6, psi = 1.5, delta1 and gamma 1e-6, 1e-5, ..., 1e6; 10, 1e2, ..., 1e5 steps in a contact time, an element
 * for every 32 steps, at least 4. A method that cannot take a time step is given the elements.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_STABILITY_H
#define BENCH_STABILITY_H

#include "methods.h"
#include "scenes.h"

enum { MAP_DECADES = 13, MAP_LEVELS = 5 };

/* X(name, text) */
#define BENCH_VERDICT_LIST(X)                                                                                          \
    X(ERROR, "error")               /* a pair came back, and its error is known */                                     \
    X(REFUSED, "refused")           /* negative status */                                                              \
    X(UNSTABLE, "unstable")         /* no end, not finite, or outside of 0 <= ez <= 1, |ex| <= 1 */                    \
    X(WRONG, "wrong")               /* error above ten times the estimate, and ten times the tolerance */              \
    X(TOO_SLOW, "too slow")         /* more than the time allowed for a cell */                                        \
    X(NO_REFERENCE, "no reference") /* of this place of the map; nothing is run */

#define BENCH_VERDICT_ENUM(name, text) BENCH_##name,
enum bench_verdict { BENCH_VERDICT_LIST(BENCH_VERDICT_ENUM) BENCH_VERDICTS };
#undef BENCH_VERDICT_ENUM

extern const char *const bench_verdict_names[BENCH_VERDICTS];

struct bench_cell {
    int method;
    int64_t steps;
    double delta1, gamma;
    enum bench_verdict verdict;
    double ez, ex, error_ez, error_ex, estimate; /* NaN: none */
    double uncertainty;                          /* of the reference */
    double seconds;
};

/* The scene of a place of the map, 0 <= place < MAP_DECADES^2, with its reference if it can be had. */
void bench_map_scene(int place, int quick, struct bench_scene *scene);

/* Steps of a level, 0 <= level < MAP_LEVELS. */
int64_t bench_map_steps(int level);

/* One cell; `coarser` is the cell of the level before, NULL for the first: a cell that would exceed the budget (s) is
 * not run. Nonzero: out of memory, no cell. */
int bench_map_cell(const struct bench_scene *scene, int method, int level, double budget,
                   const struct bench_cell *coarser, struct bench_cell *cell);

#endif
