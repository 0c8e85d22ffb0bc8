/* The elastic normal problem alone, for comparison with other boundary element programs:  bem_hertz
 * M FILE A paraboloid r^2/2 pressed by 1 into a half-space with E* = 4, 2M x 2M cells, contact
 * radius 1 over 0.9 M cells. Writes the pressure of a quarter to FILE (M lines of M values) and
 * prints spacing, force, iterations and the best of ten times, in s.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bem/bounded.h"

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void press(struct bem_bounded *b, int64_t m, double spacing, double *target)
{
    rst_bem_normal_target(m, m, spacing, 1, 1, b->low, target); /* low: a field of zeros */
    memset(b->x, 0, (size_t)(m * m) * sizeof *b->x);
    b->iterations = b->convolutions = 0;
    if (rst_bem_solve_bounded(b)) exit(1);
}

int main(int count, char **arguments)
{
    const int64_t m = count == 3 ? atoll(arguments[1]) : 0;
    if (m < 4 || m % 2) return fprintf(stderr, "usage: bem_hertz M FILE (M even)\n"), 2;
    const double spacing = 1 / (0.9 * (double)m);
    double *fields[10], best = DBL_MAX, force = 0;
    for (int i = 0; i < 10; i++)
        if (!(fields[i] = calloc((size_t)(m * m), sizeof(double)))) return 1;
    for (int64_t i = 0; i < m * m; i++)
        fields[1][i] = DBL_MAX;
    struct bem_bounded b = {.transform = rst_bem_transform_create(m),
                            .kind = BEM_NORMAL,
                            .ld = m,
                            .low = fields[0],
                            .high = fields[1],
                            .rhs = fields[2],
                            .x = fields[3],
                            .u = fields[4],
                            .free = fields[5],
                            .r = fields[6],
                            .z = fields[7],
                            .d = fields[8],
                            .kd = fields[9],
                            .closeness = 1e-8,
                            .most_iterations = 300};
    FILE *file = fopen(arguments[2], "w");
    if (!b.transform || !file) return 1;
    for (int i = 0; i < 10; i++) {
        const double before = now();
        press(&b, m, spacing, fields[2]);
        const double took = now() - before;
        if (took < best) best = took;
    }
    for (int64_t j = 0; j < m; j++)
        for (int64_t i = 0; i < m; i++) {
            const double p = b.x[j * m + i] / spacing;
            force += 4 * spacing * spacing * p;
            fprintf(file, "%.17g%c", p, i + 1 < m ? ' ' : '\n');
        }
    fclose(file);
    printf("%.17g %.17g %lld %.6g\n", spacing, force, (long long)b.iterations, best);
    rst_bem_transform_destroy(b.transform);
    for (int i = 0; i < 10; i++)
        free(fields[i]);
    return 0;
}
