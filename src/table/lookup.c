/* The one code path of all lookups. It does not branch on psi, since the processor cannot predict
 * on which side of psi = 1 and of psi_c it lies. It writes only the outputs. No operation overflows
 * or is invalid, for programs that trap this.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/form.h"

#include <float.h>

/* Inline, since a call would pass the results through memory. */
#if defined(__GNUC__)
#define ALWAYS_INLINE static inline __attribute__((__always_inline__))
#define COLD static __attribute__((__noinline__, __cold__))
#else
#define ALWAYS_INLINE static inline
#define COLD static
#endif

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* Where a pair is along psi. */
struct at_psi {
    double place;         /* in cells of its panel */
    double y, q;          /* y; psi, or 1/psi beyond psi = 1 */
    double slips, beyond; /* psi > 1; psi >= psi_c: 1 or 0 in place of unpredictable branches */
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

/* The lower left node of the cell of a place along psi. The place becomes the one in [0, 1] within
 * the cell. */
static inline const double *find_cell(const restitute_table *t, const struct rst_node *node, int64_t slips,
                                      double *place)
{
    const int64_t sticks = t->d.stick_cells;
    const int64_t last = sticks - 1 + slips * (t->d.slip_cells - sticks), found = (int64_t)*place;
    const int64_t cell = found < last ? found : last;
    *place -= (double)cell;
    return t->d.ex + 4 * ((node - t->node) * rst_places(&t->d) + cell + slips * (sticks + 1));
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

static inline double find_ex(const restitute_table *t, double g, double ez, const struct at_psi *at)
{
    const double q = at->slips * at->q + (1 - at->slips), closed = 2 * t->d.chi * (1 + ez) * q - 1; /* (27) */
    const double ex = (1 - at->beyond) * ((g + at->slips * at->y * ez) * q) + at->beyond * closed;
    return smaller(larger(ex, -1), 1);
}

ALWAYS_INLINE void evaluate(const restitute_table *t, double speed, double sliding, double v_n, double *ez, double *ex)
{
    double of_speed[4], of_psi[4];
    const double place = find_place(t, speed);
    const struct rst_node *node = find_node(t, place);
    const double width = node[1].at - node->at;
    rst_hermite((place - node->at) * node->inverse_width, of_speed);
    of_speed[1] *= width; /* slopes are by s */
    of_speed[3] *= width;
    *ez = find_ez(node, of_speed);
    struct at_psi psi = find_psi(t, *ez, sliding, v_n);
    const double *low = find_cell(t, node, sliding > v_n, &psi.place);
    rst_hermite(psi.place, of_psi);
    *ex = find_ex(t, sum_up(low, 4 * rst_places(&t->d), of_psi, of_speed), *ez, &psi);
}

void rst_table_evaluate(const restitute_table *table, double speed, double sliding, double v_n, double *ez, double *ex)
{
    evaluate(table, speed, sliding, v_n, ez, ex);
}

/* ---- many places */

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

/* `evaluate` for up to `block` places, in a third of the time. For one place alone it would take
 * 8 % longer. */
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
    for (int i = 0; i < n; i++)
        low[i] = find_cell(t, node[i], sliding[i] > v_n[i], &place[i]);
    find_weights(n, place, of_psi);
    for (int i = 0; i < n; i++) {
        const double w[4] = {of_psi[0][i], of_psi[1][i], of_psi[2][i], of_psi[3][i]};
        const double x[4] = {of_speed[0][i], of_speed[1][i], of_speed[2][i], of_speed[3][i]};
        ex[i] = sum_up(low[i], 4 * rst_places(&t->d), w, x);
    }
    for (int i = 0; i < n; i++) {
        const struct at_psi psi = {place[i], y[i], q[i], slips[i], beyond[i]};
        ex[i] = find_ex(t, ex[i], ez[i], &psi);
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

/* One test; what every caller's struct has is read in place. */
static inline int good_contact(const restitute_table_contact *c)
{
    return RST_IS_SIZED(table_contact, c) && c->psi_factor >= 0 && c->speed_factor > 0;
}

int rst_check_other_contact(const restitute_table_contact *contact, restitute_error *error)
{
    const int status = RST_CHECK(table_contact, contact, error);
    if (status || good_contact(contact)) return status;
    if (contact->speed_factor == 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "contact is not set: restitute_table_contact_set fills it");
    return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                      "contact.psi_factor = %g, speed_factor = %g: must be >= 0 and > 0; restitute_table_contact_set "
                      "fills it",
                      contact->psi_factor, contact->speed_factor);
}

int rst_check_speeds(double normal, double sliding, const char *place, restitute_error *error)
{
    if (good_speeds(normal, sliding)) return RESTITUTE_OK;
    const int at = normal >= 0 && normal <= rst_largest_speed;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s_speed%s (m/s) = %.17g: must be in [%g, %g]",
                      at ? "sliding" : "normal", place, at ? sliding : normal, at ? -rst_largest_speed : 0,
                      rst_largest_speed);
}

COLD int refuse(const restitute_table_contact *c, double v_n, double v_t, restitute_error *error)
{
    const int status = rst_check_other_contact(c, error);
    return status ? status : rst_check_speeds(v_n, v_t, "", error);
}

int restitute_table_pair(const restitute_table *table, const restitute_table_contact *contact, double normal_speed,
                         double sliding_speed, double *ez, double *ex, restitute_error *error)
{
    if (!table) return rst_report(error, RESTITUTE_ERROR_NULL, "table is NULL");
    const restitute_table_contact *c = contact ? contact : &table->own;
    if ((contact && !good_contact(contact)) || !good_speeds(normal_speed, sliding_speed))
        return refuse(c, normal_speed, sliding_speed, error);
    const double speed = normal_speed * c->speed_factor, sliding = sliding_of(c, sliding_speed);
    double own_ez, own_ex;
    evaluate(table, speed, sliding, normal_speed, &own_ez, &own_ex);
    if (ez) *ez = own_ez;
    if (ex) *ex = own_ex;
    return error ? rst_done(error) : RESTITUTE_OK;
}

/* All speeds are in their ranges. The first loop has no branches; where it fails, the second one
 * finds the place. */
static int check_many(size_t n, const double *normal, const double *sliding, restitute_error *error)
{
    int good = 1;
    char place[32];
    for (size_t i = 0; i < n; i++)
        good &= good_speeds(normal[i], sliding[i]);
    for (size_t i = 0; !good; i++)
        if (!good_speeds(normal[i], sliding[i])) {
            rst_print(place, sizeof place, "s[%zu]", i);
            return rst_check_speeds(normal[i], sliding[i], place, error);
        }
    return RESTITUTE_OK;
}

int restitute_table_pair_many(const restitute_table *table, const restitute_table_contact *contact, size_t n,
                              const double *normal_speeds, const double *sliding_speeds, double *ez, double *ex,
                              restitute_error *error)
{
    if (!table || (n > 0 && (!normal_speeds || !sliding_speeds)))
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL",
                          !table           ? "table"
                          : !normal_speeds ? "normal_speeds"
                                           : "sliding_speeds");
    restitute_table_contact c = table->own;
    int status = contact ? rst_check_other_contact(contact, error) : RESTITUTE_OK;
    if (!status && contact) status = RST_TAKE(table_contact, &c, contact, error);
    if (!status) status = check_many(n, normal_speeds, sliding_speeds, error);
    if (status) return status;
    for (size_t done = 0; done < n; done += block) {
        double speed[block], sliding[block], own_ez[block], own_ex[block];
        const double *v_n = normal_speeds + done, *v_t = sliding_speeds + done;
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
    return rst_done(error);
}
