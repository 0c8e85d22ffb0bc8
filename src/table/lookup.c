/* The one code path of all lookups. It does not branch on psi, since the processor cannot predict
 * on which side of psi = 1 and of psi_c it lies. It writes only the outputs. No operation overflows
 * or is invalid, for programs that trap this.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/form.h"

#include <float.h>

/* Inline, since a call would pass the results through memory. */
#if defined(__GNUC__)
#define ALWAYS_INLINE static inline __attribute__((__always_inline__))
#else
#define ALWAYS_INLINE static inline
#endif

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Where a pair is along the speed. */
struct at_speed {
    const struct rst_node *node; /* lower end of the cell */
    double u, weight[4];         /* place in [0, 1]; cubic weights: those of slopes are times the width, since slopes are by s */
    double ez;
};

/* Where it is along psi. */
struct at_psi {
    double place;         /* in cells of its panel */
    double y, q;          /* y; psi, or 1/psi beyond psi = 1 */
    double slips, beyond; /* psi > 1; psi >= psi_c: 1 or 0 in place of unpredictable branches */
};

/* Its cell. */
struct at_cell {
    const double *low; /* lower left node */
    double s;          /* place in [0, 1] along psi */
};

static inline double find_place(const restitute_table *t, double speed)
{
    const double v = smaller(larger(speed, t->d.low), t->d.high); /* NaN: low */
    /* s rounds up and down: a speed just above the lowest node may lie below it */
    return larger(smaller(rst_axis_place(v, NULL), t->end), t->node->at);
}

/* The lower node of the cell that a place is in. */
static inline const struct rst_node *find_node(const restitute_table *t, double place)
{
    const struct rst_node *node = t->node + t->bin[(int)((place - t->node->at) * t->bins_per_s)];
    node -= node->at > place; /* a bin begins slightly late */
    while (node[1].at <= place)
        node++;
    return node;
}

static inline double find_ez(const struct rst_node *node, const double x[4])
{
    const double ez = x[0] * node[0].ez + x[1] * node[0].slope + (x[2] * node[1].ez + x[3] * node[1].slope);
    return smaller(larger(ez, 0), 1);
}

static inline struct at_speed find_speed(const restitute_table *t, double place)
{
    struct at_speed at;
    const struct rst_node *node = find_node(t, place);
    const double width = node[1].at - node->at;
    at.node = node;
    at.u = (place - node->at) * node->inverse_width;
    rst_hermite(at.u, at.weight);
    at.weight[1] *= width;
    at.weight[3] *= width;
    at.ez = find_ez(node, at.weight);
    return at;
}

static inline struct at_psi find_psi(const restitute_table *t, double ez, double sliding, double v_n)
{
    struct at_psi at;
    const double width = t->share * (1 + ez) * v_n; /* (psi_c - 1) v_n */
    const double more = sliding - v_n;
    at.slips = (double)(sliding > v_n);
    at.beyond = (double)(sliding >= v_n + (width + rst_least)); /* not at rest; more >= width would become a branch */
    at.q = smaller(sliding, v_n) / (larger(sliding, v_n) + rst_least);
    at.y = at.slips * smaller(more, width) / (width + rst_least);
    at.place = at.slips * (rst_panel_place(at.y) * t->of_slip) + (1 - at.slips) * (at.q * t->of_stick);
    return at;
}

static inline struct at_cell find_cell(const restitute_table *t, const struct rst_node *node, double place, int64_t slips)
{
    const int64_t sticks = t->d.stick_cells;
    const int64_t last = sticks - 1 + slips * (t->d.slip_cells - sticks), found = (int64_t)place;
    const int64_t cell = found < last ? found : last;
    return (struct at_cell){t->d.ex + 4 * ((node - t->node) * rst_places(&t->d) + cell + slips * (sticks + 1)),
                            place - (double)cell};
}

/* The sum over the four nodes of a cell. */
static inline double sum_up(const double *low, int64_t row, const double w[4], const double x[4])
{
    const double *high = low + row;
    double part[2][2];
    for (int i = 0; i < 2; i++) {
        part[0][i] = (w[0] * low[i] + w[1] * low[2 + i]) + (w[2] * low[4 + i] + w[3] * low[6 + i]);
        part[1][i] = (w[0] * high[i] + w[1] * high[2 + i]) + (w[2] * high[4 + i] + w[3] * high[6 + i]);
    }
    return (x[0] * part[0][0] + x[1] * part[0][1]) + (x[2] * part[1][0] + x[3] * part[1][1]);
}

static inline double find_g(const restitute_table *t, const struct at_cell *at, const double of_speed[4])
{
    double w[4];
    rst_hermite(at->s, w);
    return sum_up(at->low, 4 * rst_places(&t->d), w, of_speed);
}

/* e_x before it is kept within its bounds. */
static inline double raw_ex(const restitute_table *t, double g, double ez, const struct at_psi *at)
{
    const double q = at->slips * at->q + (1 - at->slips), closed = 2 * t->d.chi * (1 + ez) * q - 1; /* (27) */
    return (1 - at->beyond) * ((g + at->slips * at->y * ez) * q) + at->beyond * closed;
}

static inline double kept(double ex)
{
    return smaller(larger(ex, -1), 1);
}

struct spot {
    struct at_speed speed;
    struct at_psi psi;
    struct at_cell cell;
    double raw;
};

ALWAYS_INLINE struct spot find(const restitute_table *t, double speed, double sliding, double v_n)
{
    struct spot at;
    at.speed = find_speed(t, find_place(t, speed));
    at.psi = find_psi(t, at.speed.ez, sliding, v_n);
    at.cell = find_cell(t, at.speed.node, at.psi.place, sliding > v_n);
    at.raw = raw_ex(t, find_g(t, &at.cell, at.speed.weight), at.speed.ez, &at.psi);
    return at;
}

ALWAYS_INLINE void evaluate(const restitute_table *t, double speed, double sliding, double v_n, restitute_table_value *pair)
{
    const struct spot at = find(t, speed, sliding, v_n);
    *pair = (restitute_table_value){at.speed.ez, kept(at.raw)};
}

void rst_table_evaluate(const restitute_table *table, double speed, double sliding, double v_n, restitute_table_value *pair)
{
    evaluate(table, speed, sliding, v_n, pair);
}

/* Places a block. Each step is done for all places of a block before the next step. So places do
 * not wait for each other, and steps that read no table are vectorised. 8 and 32 are as fast. */
enum { block = 16 };

/* Cubic weights at many places. */
static inline void find_weights(int n, const double *u, double weight[4][block])
{
    for (int i = 0; i < n; i++) {
        double w[4];
        rst_hermite(u[i], w);
        weight[0][i] = w[0], weight[1][i] = w[1], weight[2][i] = w[2], weight[3][i] = w[3];
    }
}

static void evaluate_block(const restitute_table *t, int n, const double *speed, const double *sliding, const double *v_n,
                           double *ez, double *ex)
{
    const struct rst_node *node[block];
    const double *low[block];
    double place[block], y[block], q[block], slips[block], beyond[block], u[block], width[block];
    double of_speed[4][block], of_psi[4][block];
    for (int i = 0; i < n; i++)
        place[i] = find_place(t, speed[i]);
    for (int i = 0; i < n; i++) {
        node[i] = find_node(t, place[i]);
        u[i] = (place[i] - node[i]->at) * node[i]->inverse_width;
        width[i] = node[i][1].at - node[i]->at;
    }
    find_weights(n, u, of_speed);
    for (int i = 0; i < n; i++) {
        of_speed[1][i] *= width[i];
        of_speed[3][i] *= width[i];
    }
    for (int i = 0; i < n; i++) {
        const double w[4] = {of_speed[0][i], of_speed[1][i], of_speed[2][i], of_speed[3][i]};
        ez[i] = find_ez(node[i], w);
    }
    for (int i = 0; i < n; i++) {
        const struct at_psi psi = find_psi(t, ez[i], sliding[i], v_n[i]);
        place[i] = psi.place, y[i] = psi.y, q[i] = psi.q, slips[i] = psi.slips, beyond[i] = psi.beyond;
    }
    for (int i = 0; i < n; i++) {
        const struct at_cell cell = find_cell(t, node[i], place[i], sliding[i] > v_n[i]);
        low[i] = cell.low;
        u[i] = cell.s;
    }
    find_weights(n, u, of_psi);
    for (int i = 0; i < n; i++) {
        const double w[4] = {of_psi[0][i], of_psi[1][i], of_psi[2][i], of_psi[3][i]};
        const double x[4] = {of_speed[0][i], of_speed[1][i], of_speed[2][i], of_speed[3][i]};
        ex[i] = sum_up(low[i], 4 * rst_places(&t->d), w, x);
    }
    for (int i = 0; i < n; i++) {
        const struct at_psi psi = {place[i], y[i], q[i], slips[i], beyond[i]};
        ex[i] = kept(raw_ex(t, ex[i], ez[i], &psi));
    }
}

/* psi v_n; infinite without friction. Written as a sum: of two branches a compiler may compute
 * both, and so infinity times 0. */
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
    if (!table || !pair) return RESTITUTE_ERROR_NULL;
    if (!good_speeds(normal_speed, tangential_speed)) return RESTITUTE_ERROR_DOMAIN;
    evaluate(table, normal_speed, sliding_of(&table->own, tangential_speed), normal_speed, pair);
    return RESTITUTE_OK;
}

int restitute_table_pairs(const restitute_table *table, const restitute_table_contact *contact, size_t n,
                          const double *normal_speeds, const double *tangential_speeds, double *ez, double *ex)
{
    if (!table || (n > 0 && (!normal_speeds || !tangential_speeds))) return RESTITUTE_ERROR_NULL;
    const int status = check_contact(contact ? contact : &table->own);
    if (status) return status;
    const restitute_table_contact c = contact ? *contact : table->own;
    int good = 1;
    for (size_t i = 0; i < n; i++)
        good &= good_speeds(normal_speeds[i], tangential_speeds[i]);
    if (!good) return RESTITUTE_ERROR_DOMAIN;
    for (size_t done = 0; done < n; done += block) {
        double speed[block], sliding[block], own_ez[block], own_ex[block];
        const double *v_n = normal_speeds + done, *v_t = tangential_speeds + done;
        const int count = n - done < block ? (int)(n - done) : block;
        for (int i = 0; i < count; i++) {
            speed[i] = v_n[i] * c.speed_factor;
            sliding[i] = sliding_of(&c, v_t[i]);
        }
        evaluate_block(table, count, speed, sliding, v_n, own_ez, own_ex);
        /* results may be written over the speeds */
        if (ez) memcpy(ez + done, own_ez, (size_t)count * sizeof *ez);
        if (ex) memcpy(ex + done, own_ex, (size_t)count * sizeof *ex);
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
    const struct rst_node *node = at->speed.node;
    double w[4], rate_w[4], rate_x[4];
    rst_hermite(at->cell.s, w);
    rst_hermite_slope(at->cell.s, rate_w);
    rst_hermite_slope(at->speed.u, rate_x);
    rate_x[0] *= node->inverse_width;
    rate_x[2] *= node->inverse_width;
    return (struct rates){rate_x[0] * node[0].ez + rate_x[1] * node[0].slope + rate_x[2] * node[1].ez +
                              rate_x[3] * node[1].slope,
                          sum_up(at->cell.low, row, w, rate_x), sum_up(at->cell.low, row, rate_w, at->speed.weight)};
}

/* e_x by s at constant psi, and by psi. */
static void rates_of_ex(const restitute_table *t, const struct spot *at, const struct rates *r, double *by_s,
                        double *by_psi)
{
    if (at->psi.slips <= 0) {
        *by_s = r->of_speed;
        *by_psi = r->of_psi * (double)t->d.stick_cells;
    } else if (at->psi.beyond > 0) {
        *by_s = 2 * t->d.chi * r->ez * at->psi.q;
        *by_psi = -2 * t->d.chi * (1 + at->speed.ez) * at->psi.q * at->psi.q;
    } else {
        const double by_y = r->of_psi * rst_panel_slope(at->psi.y) * (double)t->d.slip_cells + at->speed.ez; /* of psi e_x */
        *by_s = (r->of_speed + at->psi.y * r->ez * (1 - by_y / (1 + at->speed.ez))) * at->psi.q;
        *by_psi = (by_y / (t->share * (1 + at->speed.ez)) - at->raw) * at->psi.q;
    }
}

static void find_slope(const restitute_table *t, const restitute_table_contact *c, double v_n, double v_t,
                       restitute_table_slope *slope)
{
    const double v = larger(v_n, 1e-100), speed = v * c->speed_factor, sliding = sliding_of(c, v_t);
    const struct spot at = find(t, speed, sliding, v);
    double of_place = 0, by_s, by_psi;
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
    evaluate(table, normal_speed * c->speed_factor, sliding_of(c, tangential_speed), normal_speed, pair);
    if (slope) find_slope(table, c, normal_speed, tangential_speed, slope);
    return RESTITUTE_OK;
}
