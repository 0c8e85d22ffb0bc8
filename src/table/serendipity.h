/* The polynomials of a cell of a tree: serendipity elements of degree four.
 *
 * Along one axis there are five places, u = 0, 1/4, 1/2, 3/4, 1, in three levels: the ends have level 0 and straight
 * lines, the middle level 1 and the parabola that is 0 at the ends, the quarters level 2 and quartics that are 0 at
 * all other places. A cell has only the nodes whose levels, added over the axes, are at most 2, 136 of 5^4, and as
 * coefficients what the value at a node exceeds the lower levels by. That holds all terms up to fourth order but no
 * products of many high powers, which are small: cells of 4^4 nodes, cubics along all axes, have larger errors. On a
 * face only the nodes of the face count, and what is so on a face is so on a part of it: cells that share them are
 * continuous.
 *
 * The axes go in pairs: (w, gamma) and (psi, chi). A pair has 17 functions: four of level 0, four of level 1, nine of
 * level 2. SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_SERENDIPITY_H
#define RST_TABLE_SERENDIPITY_H

#include <stdint.h>

#include "nodes.h"

enum {
    rst_places = 5, /* along an axis */
    rst_quarters = rst_places - 1,
    rst_pair_functions = 17,
    rst_most_functions = 136,
    rst_functions_without_chi = 50
};

/* The nodes of a cell in the order in which its coefficients are kept: for all functions of psi and chi of level 0 the
 * first 16 of w and gamma; for these again the last of them; for those of level 1 eight, of level 2 four. */
struct rst_serendipity {
    int64_t count;
    int8_t at[rst_most_functions][rst_cell_axes]; /* places, 0 to 4 */
    int16_t number[rst_places][rst_places][rst_places][rst_places]; /* -1: no node */
};

/* Nodes of cells that have no more than one place along axes that are not active. */
void rst_serendipity_set(const int active[rst_cell_axes], struct rst_serendipity *nodes);

/* From values at the nodes to coefficients, in place. */
void rst_serendipity_rise(const struct rst_serendipity *nodes, double *value);

/* The five functions of an axis at u in [0, 1], by place. */
static inline void rst_serendipity_functions(double u, double f[rst_places])
{
    const double parabola = 4 * u * (1 - u), part = (4.0 / 3) * (2 * u - 1) * parabola;
    f[0] = 1 - u;
    f[1] = part * (4 * u - 3);
    f[2] = parabola;
    f[3] = part * (4 * u - 1);
    f[4] = u;
}

/* Their derivatives. */
void rst_serendipity_slopes(double u, double df[rst_places]);

/* The polynomial at u in [0, 1]^4; 0 along axes that are not active. */
double rst_serendipity_sum(const struct rst_serendipity *nodes, const double *coefficient,
                           const double u[rst_cell_axes]);

#endif
