/* Looking up a pair: tensor products of the weights of table_form.h. Nothing is written but the outputs; the only
 * function of libm is, in tables of ranges, the fifth root of the speed, which cannot set errno for what gets here.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>

#include "lookup.h"

/* Weights along speed and gamma, and where the block of values starts. */
struct place {
    double speed[4], gamma[4];
    int64_t corner; /* of the ez values */
    int n_speed, n_gamma;
};

static inline int axis_weights(const struct rst_octaves *axis, double number, double w[4], int64_t *node)
{
    *node = 0;
    w[0] = 1;
    if (axis->cells == 0) return 1;
    int64_t cell;
    rst_cubic_weights(rst_octaves_find(axis, number, &cell), w);
    *node = cell * rst_cubic;
    return 4;
}

static inline void find_place(const restitute_table *t, double speed, double gamma, struct place *p)
{
    int64_t i, j;
    p->n_speed = axis_weights(&t->speed, speed, p->speed, &i);
    p->n_gamma = axis_weights(&t->gamma, gamma, p->gamma, &j);
    p->corner = i * t->n_gamma + j;
}

static inline double rebound(const restitute_table *t, const struct place *p)
{
    const double *v = t->ez + p->corner;
    double sum = 0;
    for (int i = 0; i < p->n_speed; i++)
        for (int j = 0; j < p->n_gamma; j++)
            sum += p->speed[i] * p->gamma[j] * v[i * t->n_gamma + j];
    return rst_clamp(sum, 0, 1);
}

/* Any number of axes, of which one is neither delta1 nor gamma. */
static double sum_some_axes(const restitute_table *t, const struct place *p, const double *v, const double *w, int n,
                            const double *x, int m)
{
    const int64_t n_chi = t->n_chi, row = t->n_psi * n_chi;
    double sum = 0;
    for (int i = 0; i < p->n_speed; i++)
        for (int j = 0; j < p->n_gamma; j++)
            for (int k = 0; k < n; k++)
                for (int l = 0; l < m; l++)
                    sum += p->speed[i] * p->gamma[j] * w[k] * x[l] * v[(i * t->n_gamma + j) * row + k * n_chi + l];
    return sum;
}

static double sum_general(const restitute_table *t, const struct place *p, double chi, int64_t node, double s)
{
    double w[4] = {1}, x[4] = {1}, chi_s;
    const double *v = t->ex + (p->corner * t->n_psi + node) * t->n_chi;
    const int n = t->n_psi > 1 ? 4 : 1, m = t->n_chi > 1 ? 4 : 1;
    if (n > 1) rst_cubic_weights(s, w);
    if (m > 1) {
        v += rst_chi_find(t, chi, &chi_s);
        rst_cubic_weights(chi_s, x);
    }
    return sum_some_axes(t, p, v, w, n, x, m);
}

/* ex below psi_c, by all axes. */
static double tangential(const restitute_table *t, const struct place *p, double chi, double sliding, double v_n,
                         double full, double width)
{
    double s, quotient, closed;
    if (t->stick_cells == 0) return sum_general(t, p, chi, 0, 0);
    const int64_t node = rst_psi_find(t, sliding, v_n, width * v_n, &s, &quotient, &closed);
    return sum_general(t, p, chi, node, s) + closed * (full * quotient - 1);
}

/* psi = sliding/v_n; v_n may be 0 and sliding infinite. Apart from the case of two axes, which needs fewer registers
 * to be saved. */
#if defined(__GNUC__)
__attribute__((__noinline__))
#endif
static void
evaluate_general(const restitute_table *t, double speed, double gamma, double chi, double sliding, double v_n,
                 restitute_table_value *pair)
{
    struct place p;
    find_place(t, speed, gamma, &p);
    chi = rst_chi_in_table(t, chi);
    const double ez = rebound(t, &p), full = 2 * chi * (1 + ez), critical = 2 * chi > 1 ? full - ez : 1;
    pair->ez = ez;
    if (v_n > 1) sliding /= v_n, v_n = 1; /* nothing overflows */
    if (sliding > critical * v_n)
        pair->ex = rst_clamp(full * (v_n / sliding) - 1, -1, 1); /* (27) */
    else
        pair->ex = rst_clamp(tangential(t, &p, chi, sliding, v_n, full, critical - 1), -1, 1);
}

static inline void evaluate(const restitute_table *t, double speed, double gamma, double chi, double sliding,
                            double v_n, restitute_table_value *pair)
{
    if (t->two_axes)
        rst_two_axes_pair(t, speed, sliding, v_n, pair);
    else if (t->n_cells > 0)
        rst_cells_pair(t, speed, gamma, chi, sliding, v_n, pair);
    else
        evaluate_general(t, speed, gamma, chi, sliding, v_n, pair);
}

void rst_table_evaluate(const restitute_table *table, double speed, double gamma, double chi, double psi,
                        restitute_table_value *pair)
{
    evaluate(table, speed, gamma, chi, psi, 1, pair);
}

double rst_table_rebound(const restitute_table *table, double speed, double gamma)
{
    struct place p;
    if (table->n_cells > 0) return rst_cells_rebound(table, speed, gamma);
    if (table->two_axes) return rst_two_axes_rebound(table, speed);
    find_place(table, speed, gamma, &p);
    return rebound(table, &p);
}

/* Up to rst_block places of a table of trees; ez and ex as they are wanted. */
static void evaluate_block(const restitute_table *t, int n, const struct rst_asked *asked, double *ez, double *ex)
{
    double unwanted[rst_block];
    if (ex)
        rst_cells_pairs(t, n, asked, ez ? ez : unwanted, ex);
    else if (ez)
        rst_cells_rebounds(t, n, asked, ez);
}

static inline int block_of(size_t left)
{
    return left < rst_block ? (int)left : rst_block;
}

/* psi v_n; infinite without friction. A sum: of two branches a compiler may compute both, infinity times 0 too. */
static inline double sliding_of(const restitute_table_contact *c, double v_t)
{
    const int none = c->psi_factor > DBL_MAX;
    return (none ? 0 : c->psi_factor) * fabs(v_t) + (none ? (double)INFINITY : 0);
}

/* The number that the first axis goes by. */
static inline double speed_of(const restitute_table *t, const restitute_table_contact *c, double v_n)
{
    return t->of_contact ? v_n * c->speed_factor : c->delta1 * pow(v_n, 0.2);
}

static inline int good_speeds(double v_n, double v_t)
{
    return v_n >= 0 && v_n <= rst_largest_speed && fabs(v_t) <= rst_largest_speed;
}

static inline const restitute_table_contact *contact_or_own(const restitute_table *table,
                                                            const restitute_table_contact *contact)
{
    return contact ? contact : &table->own;
}

static inline int check_contact(const restitute_table *table, const restitute_table_contact *contact)
{
    if (!contact) return table->of_contact ? RESTITUTE_OK : RESTITUTE_ERROR_DOMAIN;
    if (contact->struct_size != sizeof *contact) return RESTITUTE_ERROR_STRUCT_SIZE;
    return contact->psi_factor >= 0 ? RESTITUTE_OK : RESTITUTE_ERROR_DOMAIN; /* NaN would be an index */
}

int restitute_table_pair(const restitute_table *table, double normal_speed, double tangential_speed,
                         restitute_table_value *pair)
{
    if (!table || !pair) return RESTITUTE_ERROR_NULL;
    if (!table->of_contact || !good_speeds(normal_speed, tangential_speed)) return RESTITUTE_ERROR_DOMAIN;
    const restitute_table_contact *c = &table->own;
    evaluate(table, normal_speed, c->gamma, c->chi, sliding_of(c, tangential_speed), normal_speed, pair);
    return RESTITUTE_OK;
}

static void pairs_one_by_one(const restitute_table *t, const restitute_table_contact *c, size_t n, const double *v_n,
                             const double *v_t, double *ez, double *ex)
{
    for (size_t i = 0; i < n; i++) {
        restitute_table_value pair;
        evaluate(t, speed_of(t, c, v_n[i]), c->gamma, c->chi, sliding_of(c, v_t[i]), v_n[i], &pair);
        if (ez) ez[i] = pair.ez;
        if (ex) ex[i] = pair.ex;
    }
}

static void pairs_by_blocks(const restitute_table *t, const restitute_table_contact *c, size_t n, const double *v_n,
                            const double *v_t, double *ez, double *ex)
{
    struct rst_asked asked[rst_block];
    for (size_t done = 0; done < n; done += rst_block) {
        const int count = block_of(n - done);
        for (int i = 0; i < count; i++)
            asked[i] = (struct rst_asked){speed_of(t, c, v_n[done + i]), c->gamma, c->chi, sliding_of(c, v_t[done + i]),
                                          v_n[done + i]};
        evaluate_block(t, count, asked, ez ? ez + done : NULL, ex ? ex + done : NULL);
    }
}

static void pairs_of_two_axes(const restitute_table *t, const restitute_table_contact *c, size_t n, const double *v_n,
                              const double *v_t, double *ez, double *ex)
{
    double speed[rst_block], sliding[rst_block], normal[rst_block], unwanted[2][rst_block];
    for (size_t done = 0; done < n; done += rst_block) {
        const int count = block_of(n - done);
        for (int i = 0; i < count; i++) {
            normal[i] = v_n[done + i]; /* results may be written over it */
            speed[i] = speed_of(t, c, normal[i]);
            sliding[i] = sliding_of(c, v_t[done + i]);
        }
        rst_two_axes_pairs(t, count, speed, sliding, normal, ez ? ez + done : unwanted[0],
                           ex ? ex + done : unwanted[1]);
    }
}

int restitute_table_pairs(const restitute_table *table, const restitute_table_contact *contact, size_t n,
                          const double *normal_speeds, const double *tangential_speeds, double *ez, double *ex)
{
    if (!table || (n > 0 && (!normal_speeds || !tangential_speeds))) return RESTITUTE_ERROR_NULL;
    const int status = check_contact(table, contact);
    if (status) return status;
    int good = 1;
    for (size_t i = 0; i < n; i++)
        good &= good_speeds(normal_speeds[i], tangential_speeds[i]);
    if (!good) return RESTITUTE_ERROR_DOMAIN;
    const restitute_table_contact *c = contact_or_own(table, contact);
    if (table->n_cells > 0 && n > 1)
        pairs_by_blocks(table, c, n, normal_speeds, tangential_speeds, ez, ex);
    else if (table->two_axes && n > 1)
        pairs_of_two_axes(table, c, n, normal_speeds, tangential_speeds, ez, ex);
    else
        pairs_one_by_one(table, c, n, normal_speeds, tangential_speeds, ez, ex);
    return RESTITUTE_OK;
}

static inline int good_numbers(double chi, double psi, double delta1, double gamma)
{
    return (chi >= 0) & (psi >= 0) & (delta1 >= 0) & (gamma >= 0);
}

int restitute_table_numbers_pair(const restitute_table *table, double chi, double psi, double delta1, double gamma,
                                 restitute_table_value *pair)
{
    if (!table || !pair) return RESTITUTE_ERROR_NULL;
    if (table->of_contact || !good_numbers(chi, psi, delta1, gamma)) return RESTITUTE_ERROR_DOMAIN;
    evaluate(table, delta1, gamma, chi, psi, 1, pair);
    return RESTITUTE_OK;
}

/* One place after the other, or a block. */
static void evaluate_many(const restitute_table *t, int n, const struct rst_asked *asked, double *ez, double *ex)
{
    if (t->n_cells > 0) {
        evaluate_block(t, n, asked, ez, ex);
        return;
    }
    for (int i = 0; i < n; i++) {
        restitute_table_value pair;
        evaluate(t, asked[i].speed, asked[i].gamma, asked[i].chi, asked[i].sliding, asked[i].v_n, &pair);
        if (ez) ez[i] = pair.ez;
        if (ex) ex[i] = pair.ex;
    }
}

int restitute_table_numbers_pairs(const restitute_table *table, size_t n, const double *chi, const double *psi,
                                  const double *delta1, const double *gamma, double *ez, double *ex)
{
    struct rst_asked asked[rst_block];
    if (!table || (n > 0 && (!chi || !psi || !delta1 || !gamma))) return RESTITUTE_ERROR_NULL;
    int good = !table->of_contact;
    for (size_t i = 0; i < n; i++)
        good &= good_numbers(chi[i], psi[i], delta1[i], gamma[i]);
    if (!good) return RESTITUTE_ERROR_DOMAIN;
    for (size_t done = 0; done < n; done += rst_block) {
        const int count = block_of(n - done);
        for (int i = 0; i < count; i++)
            asked[i] = (struct rst_asked){delta1[done + i], gamma[done + i], chi[done + i], psi[done + i], 1};
        evaluate_many(table, count, asked, ez ? ez + done : NULL, ex ? ex + done : NULL);
    }
    return RESTITUTE_OK;
}
