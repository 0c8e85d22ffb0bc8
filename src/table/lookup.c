/* Looking up a pair: tensor products of the weights of table_form.h. Nothing is written but the outputs; the only function of
 * libm is, in tables of ranges, the fifth root of the speed, which cannot set errno for what gets here.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>

#include "table_form.h"

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

static inline double clamp(double value, double low, double high)
{
    value = !(value > low) ? low : value; /* NaN as well */
    return value > high ? high : value;
}

static inline double rebound(const restitute_table *t, const struct place *p)
{
    const double *v = t->ez + p->corner;
    double sum = 0;
    for (int i = 0; i < p->n_speed; i++)
        for (int j = 0; j < p->n_gamma; j++)
            sum += p->speed[i] * p->gamma[j] * v[i * t->n_gamma + j];
    return clamp(sum, 0, 1);
}

/* Two axes: four rows of four values. */
static inline double sum_two_axes(const restitute_table *t, const double w[4], int64_t row, int64_t node, double s)
{
    double q[4], c[4];
    const int64_t stride = t->n_psi;
    const double *v = t->ex + row * stride + node;
    rst_cubic_weights(s, q);
    for (int j = 0; j < 4; j++)
        c[j] = (w[0] * v[j] + w[1] * v[stride + j]) + (w[2] * v[2 * stride + j] + w[3] * v[3 * stride + j]);
    return (q[0] * c[0] + q[1] * c[1]) + (q[2] * c[2] + q[3] * c[3]);
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

static inline double chi_in_table(const restitute_table *t, double chi)
{
    return clamp(chi, t->chi_low, t->chi_high);
}

/* ex below psi_c, by all axes. */
static double tangential(const restitute_table *t, const struct place *p, double chi, double sliding, double v_n,
                         double full, double width)
{
    double s, quotient;
    if (t->stick_cells == 0) return sum_general(t, p, chi, 0, 0);
    const int64_t node = rst_psi_find(t, sliding, v_n, width, &s, &quotient);
    return sum_general(t, p, chi, node, s) + (sliding > v_n) * (full * quotient - 1);
}

/* psi = sliding/v_n; v_n may be 0 and sliding infinite. Apart from the case of two axes, which needs fewer registers to be saved. */
#if defined(__GNUC__)
__attribute__((__noinline__))
#endif
static void
evaluate_general(const restitute_table *t, double speed, double gamma, double chi, double sliding, double v_n,
                 restitute_table_value *pair)
{
    struct place p;
    find_place(t, speed, gamma, &p);
    chi = chi_in_table(t, chi);
    const double ez = rebound(t, &p), full = 2 * chi * (1 + ez), critical = 2 * chi > 1 ? full - ez : 1;
    pair->ez = ez;
    if (sliding > critical * v_n)
        pair->ex = clamp(full * (v_n / sliding) - 1, -1, 1); /* (27) */
    else
        pair->ex = clamp(tangential(t, &p, chi, sliding, v_n, full, critical - 1), -1, 1);
}

/* Four numbers that are added at once, and four as they stand in a cell. */
#if defined(__GNUC__)
typedef float four __attribute__((__vector_size__(16)));
typedef float four_kept __attribute__((__vector_size__(16), __aligned__(4), __may_alias__));
#else
#error "lookup.c needs the vector types of gcc and clang"
#endif

static inline double rebound_in_cell(const restitute_table *t, const struct rst_spot *spot)
{
    const struct rst_tree *tree = &t->rebound;
    const uint32_t code = rst_tree_code(tree, RST_ALONG_W, spot->w);
    const int64_t cell = rst_tree_find(tree, spot->octave, spot->root, 0, spot->gamma, code);
    const struct rst_shape shape = tree->shape[cell];
    const double *c = t->ez + cell * rst_pair_functions;
    double w[rst_places], g[rst_places];
    rst_serendipity_functions(rst_tree_place(spot->w, tree->halvings[RST_ALONG_W][shape.depth]), w);
    rst_serendipity_functions(rst_tree_place(spot->gamma, shape.level), g);
    const double low = (w[0] * c[0] + w[4] * c[2]) + (w[2] * c[4] + (w[1] * c[8] + w[3] * c[10]));
    const double high = (w[0] * c[1] + w[4] * c[3]) + (w[2] * c[5] + (w[1] * c[9] + w[3] * c[11]));
    const double left = g[2] * c[6] + (g[1] * c[12] + g[3] * c[14]);
    const double right = g[2] * c[7] + (g[1] * c[13] + g[3] * c[15]);
    return clamp((g[0] * low + g[4] * high) + (w[0] * left + w[4] * right) + w[2] * g[2] * c[16], 0, 1);
}

/* The 17 functions of a pair of axes, in their order. */
struct pair_functions {
    four ends, middles, quarters[2];
    float cross;
};

#define CHOOSE __builtin_shufflevector

/* f: functions of four axes by place; of which x and y are two. */
#define PAIR_OF(f, x, y)                                                                                               \
    {.ends = CHOOSE((f)[0], (f)[4], x, x, 4 + x, 4 + x) * CHOOSE((f)[0], (f)[4], y, 4 + y, y, 4 + y),                  \
     .middles = CHOOSE((f)[2], (f)[2], x, x, y, y) * CHOOSE((f)[0], (f)[4], y, 4 + y, x, 4 + x),                       \
     .quarters = {CHOOSE((f)[1], (f)[3], x, x, 4 + x, 4 + x) * CHOOSE((f)[0], (f)[4], y, 4 + y, y, 4 + y),             \
                  CHOOSE((f)[1], (f)[3], y, y, 4 + y, 4 + y) * CHOOSE((f)[0], (f)[4], x, 4 + x, x, 4 + x)},            \
     .cross = (f)[2][x] * (f)[2][y]}

/* Sums over functions of w and gamma, for one of psi and chi after the other; those that every one of these has in three parts, since
 * additions wait for each other. */
struct sums {
    four ends[3], middles, quarters[2];
};

static inline const float *add_level_0(const float *c, four value, struct sums *sum)
{
    const four_kept *v = (const four_kept *)(const void *)c;
    sum->ends[0] += value * v[0];
    sum->middles += value * v[1];
    sum->quarters[0] += value * v[2];
    sum->quarters[1] += value * v[3];
    return c + 16;
}

static inline const float *add_level_1(const float *c, four value, struct sums *sum)
{
    const four_kept *v = (const four_kept *)(const void *)c;
    sum->ends[0] += value * v[0];
    sum->middles += value * v[1];
    return c + 8;
}

static inline const float *add_level_2(const float *c, four value, four *sum)
{
    *sum += value * *(const four_kept *)(const void *)c;
    return c + 4;
}

static inline four all(float x)
{
    return (four){x, x, x, x};
}

static inline double add_up(const struct sums *sum, const struct pair_functions *first, float last)
{
    const four total = (first->ends * (sum->ends[0] + (sum->ends[1] + sum->ends[2])) + first->middles * sum->middles) +
                       (first->quarters[0] * sum->quarters[0] + first->quarters[1] * sum->quarters[1]);
    return (double)(((total[0] + total[1]) + (total[2] + total[3])) + first->cross * last);
}

/* The polynomial of a cell whose table has an axis of chi. f: functions of psi, chi, w, gamma. */
static inline double sum_cell(const float *c, four f[rst_places])
{
    const struct pair_functions first = PAIR_OF(f, 2, 3), second = PAIR_OF(f, 0, 1);
    struct sums sum = {{{0}, {0}, {0}}, {0}, {{0}, {0}}};
    for (int i = 0; i < 4; i++)
        c = add_level_0(c, all(second.ends[i]), &sum);
    const four last = second.ends * *(const four_kept *)(const void *)c;
    c += 4;
    for (int i = 0; i < 4; i++)
        c = add_level_1(c, all(second.middles[i]), &sum);
    for (int i = 0; i < 4; i++)
        c = add_level_2(c, all(second.quarters[0][i]), &sum.ends[1]);
    for (int i = 0; i < 4; i++)
        c = add_level_2(c, all(second.quarters[1][i]), &sum.ends[2]);
    add_level_2(c, all(second.cross), &sum.ends[1]);
    return add_up(&sum, &first, (last[0] + last[1]) + (last[2] + last[3]));
}

/* The same without an axis of chi. */
static inline double sum_cell_without_chi(const float *c, four f[rst_places])
{
    const struct pair_functions first = PAIR_OF(f, 2, 3);
    struct sums sum = {{{0}, {0}, {0}}, {0}, {{0}, {0}}};
    c = add_level_0(c, all(f[0][0]), &sum);
    c = add_level_0(c, all(f[4][0]), &sum);
    const float last = f[0][0] * c[0] + f[4][0] * c[1];
    c = add_level_1(c + 2, all(f[2][0]), &sum);
    c = add_level_2(c, all(f[1][0]), &sum.ends[1]);
    add_level_2(c, all(f[3][0]), &sum.ends[2]);
    return add_up(&sum, &first, last);
}

/* rst_serendipity_functions of four axes at once. */
static inline void functions_of_four(four u, four f[rst_places])
{
    const four twice = 2 * u, parabola = 2 * twice * (1 - u), part = parabola * (twice - 1) * (4.0F / 3);
    f[0] = 1 - u;
    f[1] = part * (2 * twice - 3);
    f[2] = parabola;
    f[3] = part * (2 * twice - 1);
    f[4] = u;
}

/* At a place on a sheet; chi: in [0, 1). */
static inline double tangential_in_cell(const restitute_table *t, const struct rst_spot *spot, double chi,
                                        int64_t sheet, double psi)
{
    const struct rst_tree *tree = &t->tangent;
    const uint32_t code = rst_tree_code(tree, RST_ALONG_W, spot->w) | rst_tree_code(tree, RST_ALONG_CHI, chi) |
                          rst_tree_code(tree, RST_ALONG_PSI, psi);
    const int64_t cell = rst_tree_find(tree, spot->octave, spot->root, sheet, spot->gamma, code);
    const struct rst_shape shape = tree->shape[cell];
    four f[rst_places];
    functions_of_four((four){(float)rst_tree_place(psi, tree->halvings[RST_ALONG_PSI][shape.depth]),
                             (float)rst_tree_place(chi, tree->halvings[RST_ALONG_CHI][shape.depth]),
                             (float)rst_tree_place(spot->w, tree->halvings[RST_ALONG_W][shape.depth]),
                             (float)rst_tree_place(spot->gamma, shape.level)},
                      f);
    if (t->n_chi == 1) return sum_cell_without_chi(t->ex_cells + cell * rst_functions_without_chi, f);
    return sum_cell(t->ex_cells + cell * rst_most_functions, f);
}

/* A table of trees. */
#if defined(__GNUC__)
__attribute__((__noinline__))
#endif
static void
evaluate_cells(const restitute_table *t, double speed, double gamma, double chi, double sliding, double v_n,
               restitute_table_value *pair)
{
    struct rst_spot spot;
    double psi, y, quotient;
    rst_spot_find(t, speed, gamma, &spot);
    chi = chi_in_table(t, chi);
    const double ez = rebound_in_cell(t, &spot), full = 2 * chi * (1 + ez), critical = 2 * chi > 1 ? full - ez : 1;
    pair->ez = ez;
    if (sliding > critical * v_n) {
        pair->ex = clamp(full * (v_n / sliding) - 1, -1, 1); /* (27) */
        return;
    }
    const int64_t sheet = rst_sheet_find(sliding, v_n, critical - 1, &psi, &y, &quotient);
    const double by_chi = t->n_chi > 1 ? clamp((chi - t->chi_low) / (t->chi_high - t->chi_low), 0, rst_below_one) : 0;
    const double kept = tangential_in_cell(t, &spot, by_chi, sheet, psi);
    pair->ex = clamp((kept + y * ez) * quotient, -1, 1);
}

/* The same for speed and psi alone: one contact of a viscoelastic solid with friction. */
static inline void evaluate_two_axes(const restitute_table *t, double speed, double sliding, double v_n,
                                     restitute_table_value *pair)
{
    double w[4], s, quotient;
    int64_t cell;
    rst_cubic_weights(rst_octaves_find(&t->speed, speed, &cell), w);
    const double *v = t->ez + cell * rst_cubic;
    const double ez = clamp((w[0] * v[0] + w[1] * v[1]) + (w[2] * v[2] + w[3] * v[3]), 0, 1);
    const double full = t->chi_low * 2 * (1 + ez), critical = 2 * t->chi_low > 1 ? full - ez : 1;
    pair->ez = ez;
    if (sliding > critical * v_n) {
        pair->ex = clamp(full * (v_n / sliding) - 1, -1, 1); /* (27) */
        return;
    }
    const int64_t node = rst_psi_find(t, sliding, v_n, critical - 1, &s, &quotient);
    const double closed = (sliding > v_n) * (full * quotient - 1); /* (27), from psi = 1 on */
    pair->ex = clamp(sum_two_axes(t, w, cell * rst_cubic, node, s) + closed, -1, 1);
}

static inline void evaluate(const restitute_table *t, double speed, double gamma, double chi, double sliding,
                            double v_n, restitute_table_value *pair)
{
    if (t->two_axes)
        evaluate_two_axes(t, speed, sliding, v_n, pair);
    else if (t->n_cells > 0)
        evaluate_cells(t, speed, gamma, chi, sliding, v_n, pair);
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
    if (table->n_cells > 0) {
        struct rst_spot spot;
        rst_spot_find(table, speed, gamma, &spot);
        return rebound_in_cell(table, &spot);
    }
    find_place(table, speed, gamma, &p);
    return rebound(table, &p);
}

/* psi v_n; infinite without friction. */
static inline double sliding_of(const restitute_table_contact *c, double v_t)
{
    return c->psi_factor > DBL_MAX ? INFINITY : c->psi_factor * fabs(v_t);
}

/* The number that the first axis goes by. */
static inline double speed_of(const restitute_table *t, const restitute_table_contact *c, double v_n)
{
    return t->of_contact ? v_n * c->speed_factor : c->delta1 * pow(v_n, 0.2);
}

static inline int good_speeds(double v_n, double v_t)
{
    return v_n >= 0 && v_n <= DBL_MAX && fabs(v_t) <= DBL_MAX;
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
    for (size_t i = 0; i < n; i++) {
        restitute_table_value pair;
        evaluate(table, speed_of(table, c, normal_speeds[i]), c->gamma, c->chi, sliding_of(c, tangential_speeds[i]),
                 normal_speeds[i], &pair);
        if (ez) ez[i] = pair.ez;
        if (ex) ex[i] = pair.ex;
    }
    return RESTITUTE_OK;
}

int restitute_table_numbers_pair(const restitute_table *table, double chi, double psi, double delta1, double gamma,
                                 restitute_table_value *pair)
{
    if (!table || !pair) return RESTITUTE_ERROR_NULL;
    if (table->of_contact || !(chi >= 0) || !(psi >= 0) || !(delta1 >= 0) || !(gamma >= 0))
        return RESTITUTE_ERROR_DOMAIN;
    evaluate(table, delta1, gamma, chi, psi, 1, pair);
    return RESTITUTE_OK;
}
