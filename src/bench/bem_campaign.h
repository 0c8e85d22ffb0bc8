/* Boundary elements against the foundation, on impacts drawn at random.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BENCH_BEM_CAMPAIGN_H
#define BENCH_BEM_CAMPAIGN_H

#include <restitute/restitute.h>
#include <stdio.h>

enum bench_solid { DRAWN_ELASTIC, DRAWN_STANDARD, DRAWN_PRONY, DRAWN_SOLIDS };
enum { BENCH_MOST_TERMS = 6 };

/* One drawn impact. Moduli over G_r, times over T. */
struct bench_draw {
    enum bench_solid kind;
    double chi, psi;
    double delta1, gamma; /* of a standard solid */
    double g_inf;         /* of a Prony series */
    int n_terms;
    double tau[BENCH_MOST_TERMS], g[BENCH_MOST_TERMS];
};

/* One row: what both methods say. Failures have the status and no numbers (NaN). */
struct bench_bem_row {
    long index;
    struct bench_draw draw;
    double ez_sync, ex_sync, ez_bem, ex_bem;
    double error_ez, error_ex; /* that bem estimates */
    double seconds_sync, seconds_bem;
    int status_sync, status_bem;
};

/* The same draw for the same seed and index, whatever else is drawn. */
void bench_draw_impact(unsigned seed, long index, struct bench_draw *draw);

/* Cells over the radius on a grid of that many cells along a side: 64, 128 and 256 give 29, 60 and 122. */
int64_t bench_bem_elements(int grid);

/* Solve a draw by both. The solvers carry the options. Nonzero: the material cannot be made. */
int bench_bem_run(restitute_solver *sync, restitute_solver *bem, long index, const struct bench_draw *draw,
                  struct bench_bem_row *row);

void bench_write_bem_header(FILE *stream);
int bench_is_bem_header(const char *line);
void bench_write_bem_row(const struct bench_bem_row *row, FILE *stream);

/* Read a line that bench_write_bem_row() wrote; the draw comes from the seed. 0: it is none, of another seed,
 * or has numbers that no run gives. */
int bench_read_bem_row(const char *line, unsigned seed, struct bench_bem_row *row);

/* Table of differences by solid, and every row above `limit`. */
void bench_print_bem(const struct bench_bem_row *rows, size_t n, double limit, FILE *stream);

/* Differences over psi, a colour a solid. */
void bench_draw_bem(const struct bench_bem_row *rows, size_t n, FILE *commands);

#endif
