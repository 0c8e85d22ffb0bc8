/* Serendipity elements of degree four (serendipity.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "serendipity.h"

#include <string.h>

static const int8_t level_of[rst_places] = {0, 2, 1, 2, 0};

/* Functions of a pair of axes, by level. */
static const int8_t of_pair[rst_pair_functions][2] = {{0, 0}, {0, 4}, {4, 0}, {4, 4},                         /* level 0 */
                                                      {2, 0}, {2, 4}, {0, 2}, {4, 2},                         /* level 1 */
                                                      {1, 0}, {1, 4}, {3, 0}, {3, 4}, {0, 1}, {4, 1}, {0, 3}, /* level 2 */
                                                      {4, 3}, {2, 2}};

enum { from_level_1 = 4, from_level_2 = 8, cross = 16 };

static void add_node(struct rst_serendipity *s, const int active[rst_cell_axes], int first, int second)
{
    static const int axis[4] = {RST_W, RST_G, RST_P, RST_C};
    const int8_t place[4] = {of_pair[first][0], of_pair[first][1], of_pair[second][0], of_pair[second][1]};
    int8_t *at = s->at[s->count];
    for (int i = 0; i < 4; i++) {
        if (!active[axis[i]] && place[i] > 0) return;
        at[axis[i]] = place[i];
    }
    s->number[at[0]][at[1]][at[2]][at[3]] = (int16_t)s->count++;
}

void rst_serendipity_set(const int active[rst_cell_axes], struct rst_serendipity *nodes)
{
    memset(nodes->number, -1, sizeof nodes->number);
    nodes->count = 0;
    for (int second = 0; second < from_level_1; second++)
        for (int first = 0; first < cross; first++)
            add_node(nodes, active, first, second);
    for (int second = 0; second < from_level_1; second++)
        add_node(nodes, active, cross, second);
    for (int second = from_level_1; second < rst_pair_functions; second++)
        for (int first = 0; first < (second < from_level_2 ? from_level_2 : from_level_1); first++)
            add_node(nodes, active, first, second);
}

/* Value at the node that is at another place along one axis. */
static double beside(const struct rst_serendipity *s, const double *value, const int8_t at[rst_cell_axes], int axis,
                     int place)
{
    int8_t there[rst_cell_axes];
    memcpy(there, at, sizeof there);
    there[axis] = (int8_t)place;
    return value[s->number[there[0]][there[1]][there[2]][there[3]]];
}

/* Lower levels first, along one axis after the other. */
void rst_serendipity_rise(const struct rst_serendipity *nodes, double *value)
{
    for (int axis = 0; axis < rst_cell_axes; axis++)
        for (int level = 1; level <= 2; level++)
            for (int64_t n = 0; n < nodes->count; n++) {
                const int8_t *at = nodes->at[n];
                const double part = 0.25 * at[axis];
                if (level_of[at[axis]] != level) continue;
                value[n] -= (1 - part) * beside(nodes, value, at, axis, 0) + part * beside(nodes, value, at, axis, 4);
                if (level == 2) value[n] -= 0.75 * beside(nodes, value, at, axis, 2);
            }
}

void rst_serendipity_slopes(double u, double df[rst_places])
{
    const double parabola = 4 * u * (1 - u), part = (4.0 / 3) * (2 * u - 1) * parabola;
    const double slope = 4 * (1 - 2 * u), part_slope = (4.0 / 3) * (2 * parabola + (2 * u - 1) * slope);
    df[0] = -1;
    df[1] = part_slope * (4 * u - 3) + 4 * part;
    df[2] = slope;
    df[3] = part_slope * (4 * u - 1) + 4 * part;
    df[4] = 1;
}

double rst_serendipity_sum(const struct rst_serendipity *nodes, const double *coefficient,
                           const double u[rst_cell_axes])
{
    double f[rst_cell_axes][rst_places], sum = 0;
    for (int a = 0; a < rst_cell_axes; a++)
        rst_serendipity_functions(u[a], f[a]);
    for (int64_t n = 0; n < nodes->count; n++) {
        const int8_t *at = nodes->at[n];
        sum += coefficient[n] * (f[0][at[0]] * f[1][at[1]] * f[2][at[2]] * f[3][at[3]]);
    }
    return sum;
}
