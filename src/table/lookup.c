/* The one code path of all lookups. It takes no branch on the place: on which side of psi = 1 and of psi_c it lies cannot
 * be foreseen. Nothing is written but the outputs, and nothing overflows or is invalid, for hosts that trap that.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "form.h"

#include <float.h>

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Where a pair is. */
struct spot {
    const struct rst_node *node; /* lower end of the cell of speed */
    const double *ex;            /* its lower left node */
    double u, s;                 /* places in [0, 1] along speed and psi */
    double of_speed[4];          /* cubic weights along the speed */
    double full, ez;             /* 1 + e_z, e_z */
    double y, q;                 /* y; psi, or 1/psi beyond psi = 1 */
    double slips, beyond;        /* psi > 1; psi >= psi_c: 1 or 0, since a branch could not be foreseen */
    double raw;                  /* e_x before it is kept within its bounds */
};

/* Cubic weights; those of slopes are times the width, since slopes are by s. */
static inline void find_speed(const restitute_table *t, double speed, struct spot *at)
{
    const double v = smaller(larger(speed, t->d.low), t->d.high); /* NaN: low */
    /* s rounds up and down: a speed just above the lowest node may lie below it */
    const double place = larger(smaller(rst_axis_place(v, NULL), t->end), t->node->at);
    const struct rst_node *node = t->node + t->bin[(int)((place - t->node->at) * t->bins_per_s)];
    node -= node->at > place; /* a bin begins a hair late */
    while (node[1].at <= place)
        node++;
    at->node = node;
    at->u = (place - node->at) * node->inverse_width;
    const double width = node[1].at - node->at;
    rst_hermite(at->u, at->of_speed);
    at->of_speed[1] *= width;
    at->of_speed[3] *= width;
    const double ez = at->of_speed[0] * node[0].ez + at->of_speed[1] * node[0].slope +
                      (at->of_speed[2] * node[1].ez + at->of_speed[3] * node[1].slope);
    at->ez = smaller(larger(ez, 0), 1);
    at->full = 1 + at->ez;
}

static inline void find_psi(const restitute_table *t, double sliding, double v_n, struct spot *at)
{
    const int64_t sticks = t->d.stick_cells, cells = t->d.slip_cells, slips = sliding > v_n;
    const double width = t->share * at->full * v_n; /* (psi_c - 1) v_n */
    const double more = sliding - v_n;
    at->slips = (double)slips;
    at->beyond = (double)(slips & (more >= width));
    at->q = smaller(sliding, v_n) / (larger(sliding, v_n) + rst_least);
    at->y = at->slips * smaller(more, width) / (width + rst_least);
    const double along =
        at->slips * (rst_panel_place(at->y) * t->of_slip) + (1 - at->slips) * (at->q * t->of_stick);
    const int64_t last = sticks - 1 + slips * (cells - sticks), found = (int64_t)along;
    const int64_t cell = found < last ? found : last;
    at->s = along - (double)cell;
    at->ex = t->d.ex + 4 * ((at->node - t->node) * rst_places(&t->d) + cell + slips * (sticks + 1));
}

/* The sum over the four nodes of a cell. */
static inline double sum_up(const struct spot *at, int64_t row, const double w[4], const double x[4])
{
    const double *low = at->ex, *high = low + row;
    double part[2][2];
    for (int i = 0; i < 2; i++) {
        part[0][i] = (w[0] * low[i] + w[1] * low[2 + i]) + (w[2] * low[4 + i] + w[3] * low[6 + i]);
        part[1][i] = (w[0] * high[i] + w[1] * high[2 + i]) + (w[2] * high[4 + i] + w[3] * high[6 + i]);
    }
    return (x[0] * part[0][0] + x[1] * part[0][1]) + (x[2] * part[1][0] + x[3] * part[1][1]);
}

static inline void find_pair(const restitute_table *t, struct spot *at, restitute_table_value *pair)
{
    double w[4];
    rst_hermite(at->s, w);
    const double g = sum_up(at, 4 * rst_places(&t->d), w, at->of_speed);
    const double q = at->slips * at->q + (1 - at->slips), closed = 2 * t->d.chi * at->full * q - 1; /* (27) */
    at->raw = (1 - at->beyond) * ((g + at->slips * at->y * at->ez) * q) + at->beyond * closed;
    pair->ez = at->ez;
    pair->ex = smaller(larger(at->raw, -1), 1);
}

static inline void evaluate(const restitute_table *t, double speed, double sliding, double v_n, struct spot *at,
                            restitute_table_value *pair)
{
    find_speed(t, speed, at);
    find_psi(t, sliding, v_n, at);
    find_pair(t, at, pair);
}

void rst_table_evaluate(const restitute_table *table, double speed, double sliding, double v_n,
                        restitute_table_value *pair)
{
    struct spot at;
    evaluate(table, speed, sliding, v_n, &at, pair);
}

/* psi v_n; infinite without friction. A sum: of two branches a compiler may compute both, infinity times 0 too. */
static inline double sliding_of(const restitute_table_contact *c, double v_t)
{
    const int none = c->psi_factor > DBL_MAX;
    return (none ? 0 : c->psi_factor) * fabs(v_t) + (none ? (double)INFINITY : 0);
}

static inline int good_speeds(double v_n, double v_t)
{
    return (v_n >= 0) & (v_n <= rst_largest_speed) & (fabs(v_t) <= rst_largest_speed);
}

static inline int check_contact(const restitute_table_contact *c)
{
    if (c->struct_size != sizeof *c) return RESTITUTE_ERROR_STRUCT_SIZE;
    return c->psi_factor >= 0 && c->speed_factor > 0 ? RESTITUTE_OK : RESTITUTE_ERROR_DOMAIN;
}

int restitute_table_pair(const restitute_table *table, double normal_speed, double tangential_speed,
                         restitute_table_value *pair)
{
    struct spot at;
    if (!table || !pair) return RESTITUTE_ERROR_NULL;
    if (!good_speeds(normal_speed, tangential_speed)) return RESTITUTE_ERROR_DOMAIN;
    evaluate(table, normal_speed, sliding_of(&table->own, tangential_speed), normal_speed, &at, pair);
    return RESTITUTE_OK;
}

/* Each step for so many places before the next: they do not wait for one another. 8 and 32 are as fast. */
enum { block = 16 };

int restitute_table_pairs(const restitute_table *table, const restitute_table_contact *contact, size_t n,
                          const double *normal_speeds, const double *tangential_speeds, double *ez, double *ex)
{
    if (!table || (n > 0 && (!normal_speeds || !tangential_speeds))) return RESTITUTE_ERROR_NULL;
    const restitute_table_contact c = contact ? *contact : table->own;
    const int status = check_contact(&c);
    if (status) return status;
    int good = 1;
    for (size_t i = 0; i < n; i++)
        good &= good_speeds(normal_speeds[i], tangential_speeds[i]);
    if (!good) return RESTITUTE_ERROR_DOMAIN;
    for (size_t done = 0; done < n; done += block) {
        struct spot at[block];
        restitute_table_value pair;
        const double *v_n = normal_speeds + done, *v_t = tangential_speeds + done;
        const int count = n - done < block ? (int)(n - done) : block;
        for (int i = 0; i < count; i++)
            find_speed(table, v_n[i] * c.speed_factor, &at[i]);
        for (int i = 0; i < count; i++)
            find_psi(table, sliding_of(&c, v_t[i]), v_n[i], &at[i]);
        for (int i = 0; i < count; i++) { /* results may be written over the speeds */
            find_pair(table, &at[i], &pair);
            if (ez) ez[done + (size_t)i] = pair.ez;
            if (ex) ex[done + (size_t)i] = pair.ex;
        }
    }
    return RESTITUTE_OK;
}

/* ---- derivatives */

/* e_z by s, g by s, and g by the place in its cell of psi. */
struct rates {
    double ez, of_speed, of_psi;
};

static struct rates rates_at(const restitute_table *t, const struct spot *at)
{
    const int64_t row = 4 * rst_places(&t->d);
    const struct rst_node *node = at->node;
    double w[4], rate_w[4], rate_x[4];
    rst_hermite(at->s, w);
    rst_hermite_slope(at->s, rate_w);
    rst_hermite_slope(at->u, rate_x);
    rate_x[0] *= node->inverse_width;
    rate_x[2] *= node->inverse_width;
    return (struct rates){rate_x[0] * node[0].ez + rate_x[1] * node[0].slope + rate_x[2] * node[1].ez +
                              rate_x[3] * node[1].slope,
                          sum_up(at, row, w, rate_x), sum_up(at, row, rate_w, at->of_speed)};
}

/* e_x by s at constant psi, and by psi. */
static void rates_of_ex(const restitute_table *t, const struct spot *at, const struct rates *r, double *by_s,
                        double *by_psi)
{
    if (at->slips <= 0) {
        *by_s = r->of_speed;
        *by_psi = r->of_psi * (double)t->d.stick_cells;
    } else if (at->beyond > 0) {
        *by_s = 2 * t->d.chi * r->ez * at->q;
        *by_psi = -2 * t->d.chi * at->full * at->q * at->q;
    } else {
        const double by_y = r->of_psi * rst_panel_slope(at->y) * (double)t->d.slip_cells + at->ez; /* of psi e_x */
        *by_s = (r->of_speed + at->y * r->ez * (1 - by_y / at->full)) * at->q;
        *by_psi = (by_y / (t->share * at->full) - at->raw) * at->q;
    }
}

static void find_slope(const restitute_table *t, const restitute_table_contact *c, double v_n, double v_t,
                       restitute_table_slope *slope)
{
    const double v = larger(v_n, 1e-100), speed = v * c->speed_factor, sliding = sliding_of(c, v_t);
    struct spot at;
    restitute_table_value pair;
    double of_place = 0, by_s, by_psi;
    evaluate(t, speed, sliding, v, &at, &pair);
    const struct rates r = rates_at(t, &at);
    if (speed >= t->d.low && speed <= t->d.high) rst_axis_place(speed, &of_place);
    of_place *= c->speed_factor;
    slope->ez_normal = r.ez * of_place;
    slope->ex_normal = slope->ex_tangential = 0;
    if (fabs(at.raw) > 1 || c->psi_factor > DBL_MAX) return;
    rates_of_ex(t, &at, &r, &by_s, &by_psi);
    slope->ex_normal = by_s * of_place - by_psi * (sliding / v) / v;
    slope->ex_tangential = by_psi * (c->psi_factor / v);
}

int restitute_table_pair_of(const restitute_table *table, const restitute_table_contact *contact, double normal_speed,
                            double tangential_speed, restitute_table_value *pair, restitute_table_slope *slope)
{
    if (!table || !pair) return RESTITUTE_ERROR_NULL;
    const restitute_table_contact *c = contact ? contact : &table->own;
    const int status = check_contact(c);
    if (status) return status;
    if (!good_speeds(normal_speed, tangential_speed)) return RESTITUTE_ERROR_DOMAIN;
    struct spot at;
    evaluate(table, normal_speed * c->speed_factor, sliding_of(c, tangential_speed), normal_speed, &at, pair);
    if (slope) find_slope(table, c, normal_speed, tangential_speed, slope);
    return RESTITUTE_OK;
}
