/* Looking up a pair in a table of trees (tree.h): one place, or a block of them.
 *
 * A place is found in five steps: its spot along w and gamma; ez there; its sheet of psi, which depends on ez; its
 * leaf; the polynomial of the leaf. In a large table nearly all that the last two read comes from far away, and each
 * step waits for the one before. A block takes every step for all its places before the next one, so that these waits
 * are shared.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cell_sum.h"
#include "lookup.h"

/* Ask for memory that is read soon. */
#if defined(__GNUC__)
#define FETCH(address) __builtin_prefetch(address)
#else
#define FETCH(address) ((void)(address))
#endif

enum { line = 64 }; /* bytes that come at once */

/* A place on its way. */
struct seat {
    struct rst_spot spot;
    double beyond; /* rst_slip_beyond */
    uint64_t chi;  /* in [0, 1) of its axis, as rst_tree_bits */
    struct rst_sheet sheet;
    uint32_t code;
    int32_t next; /* on the way to the leaf */
};

static inline double sum_rebound(const restitute_table *t, const struct rst_spot *spot, int64_t cell)
{
    const struct rst_shape shape = t->rebound.shape[cell];
    const double w = rst_tree_place(spot->w, shape.depth); /* all halvings are along w */
    const double gamma = rst_tree_place(spot->gamma, shape.level);
    return rst_clamp(rst_sum_rebound(t->ez + cell * rst_pair_functions, w, gamma), 0, 1);
}

static inline double find_rebound(const restitute_table *t, const struct rst_spot *spot)
{
    const uint32_t code = rst_tree_code_alone(spot->w);
    return sum_rebound(t, spot, rst_tree_find(&t->rebound, spot->octave, spot->root, 0, spot->gamma, code));
}

/* (27), beyond psi_c */
static inline double closed_form(double chi, double ez, double v_n, double sliding)
{
    return rst_clamp(2 * chi * (1 + ez) * (v_n / sliding) - 1, -1, 1);
}

/* chi is in the table's range. */
static inline uint64_t chi_place(const restitute_table *t, double chi)
{
    if (t->n_chi == 1) return 0;
    return rst_tree_bits(rst_clamp((chi - t->chi_low) / (t->chi_high - t->chi_low), 0, rst_below_number));
}

/* Bits of a place on a sheet. */
static inline void set_code(const restitute_table *t, struct seat *s)
{
    const struct rst_tree *tree = &t->tangent;
    s->code = rst_tree_code(tree, RST_ALONG_W, s->spot.w) | rst_tree_code(tree, RST_ALONG_CHI, s->chi) |
              rst_tree_code(tree, RST_ALONG_PSI, s->sheet.place);
}

/* Places by value: they are in registers, and what has just been written in parts is slow to read as a whole. */
static inline double sum_tangential(const restitute_table *t, int64_t cell, uint64_t psi, uint64_t chi, uint64_t w,
                                    uint64_t gamma)
{
    const struct rst_shape shape = t->tangent.shape[cell];
    const int8_t *halvings = t->tangent.halvings[shape.depth];
    const rst_four u = {rst_tree_place_single(psi, halvings[RST_ALONG_PSI]),
                        rst_tree_place_single(chi, halvings[RST_ALONG_CHI]),
                        rst_tree_place_single(w, halvings[RST_ALONG_W]),
                        rst_tree_place_single(gamma, shape.level)};
    if (t->n_chi == 1) return rst_sum_without_chi(t->ex_cells + cell * rst_functions_without_chi, u);
    return rst_sum_cell(t->ex_cells + cell * rst_most_functions, u);
}

static inline double ex_of(const struct rst_sheet *sheet, double kept, double ez)
{
    return rst_clamp((kept + sheet->y * ez) * sheet->quotient, -1, 1);
}

/* The first fans of all sheets: which sheet it is tells ez. */
static inline void fetch_fans(const restitute_table *t, const struct rst_spot *spot)
{
    const int32_t *start = rst_tree_start(&t->tangent, spot->octave, spot->root, spot->gamma);
    for (int i = 0; i < rst_sheets; i++)
        FETCH(t->tangent.fan[start[i] & ~(start[i] >> 31)]);
}

/* All coefficients of a cell. */
static inline void fetch_cell(const restitute_table *t, int64_t cell)
{
    const int64_t functions = t->n_chi == 1 ? rst_functions_without_chi : rst_most_functions;
    const int64_t size = functions * (int64_t)sizeof *t->ex_cells;
    const char *from = (const char *)t->ex_cells + cell * size;
    for (int64_t i = 0; i < size; i += line)
        FETCH(from + i);
    FETCH(from + size - 1);
}

/* ---- one place */

double rst_cells_rebound(const restitute_table *t, double delta1, double gamma)
{
    struct rst_spot spot;
    rst_spot_find(t, delta1, gamma, &spot);
    return find_rebound(t, &spot);
}

void rst_cells_pair(const restitute_table *t, double delta1, double gamma, double chi, double sliding, double v_n,
                    restitute_table_value *pair)
{
    struct seat s;
    rst_spot_find(t, delta1, gamma, &s.spot);
    fetch_fans(t, &s.spot);
    chi = rst_chi_in_table(t, chi);
    const double beyond = rst_slip_beyond(chi, sliding, v_n), ez = find_rebound(t, &s.spot);
    pair->ez = ez;
    if (beyond > 1 + ez) {
        pair->ex = closed_form(chi, ez, v_n, sliding);
        return;
    }
    s.chi = chi_place(t, chi);
    s.sheet = rst_sheet_find(sliding, v_n, beyond, ez);
    set_code(t, &s);
    const int64_t cell = rst_tree_find(&t->tangent, s.spot.octave, s.spot.root, s.sheet.number, s.spot.gamma, s.code);
    pair->ex = ex_of(&s.sheet, sum_tangential(t, cell, s.sheet.place, s.chi, s.spot.w, s.spot.gamma), ez);
}

/* ---- a block of places */

static void find_spots(const restitute_table *t, int n, const struct rst_asked *a, struct seat *s)
{
    const struct rst_tree *tree = &t->rebound;
    for (int i = 0; i < n; i++) {
        struct rst_spot *spot = &s[i].spot;
        rst_spot_find(t, a[i].speed, a[i].gamma, spot);
        s[i].code = rst_tree_code_alone(spot->w);
        s[i].next = rst_tree_first(tree, *rst_tree_start(tree, spot->octave, spot->root, spot->gamma), s[i].code);
    }
}

void rst_cells_rebounds(const restitute_table *t, int n, const struct rst_asked *a, double *ez)
{
    struct seat s[rst_block];
    find_spots(t, n, a, s);
    for (int i = 0; i < n; i++)
        ez[i] = sum_rebound(t, &s[i].spot, rst_tree_rest(&t->rebound, s[i].next, 1, s[i].code));
}

/* ez, and ex as if all slip to the end; returns how many do not, and which. */
static int find_rebounds(const restitute_table *t, int n, const struct rst_asked *a, struct seat *s, double *ez,
                         double *ex, int *kept)
{
    int count = 0;
    for (int i = 0; i < n; i++) {
        ez[i] = sum_rebound(t, &s[i].spot, rst_tree_rest(&t->rebound, s[i].next, 1, s[i].code));
        const double chi = rst_chi_in_table(t, a[i].chi), sliding = a[i].sliding;
        s[i].chi = chi_place(t, chi);
        s[i].beyond = rst_slip_beyond(chi, sliding, a[i].v_n);
        ex[i] = closed_form(chi, ez[i], rst_if_larger(s[i].beyond, 1 + ez[i], a[i].v_n, 0),
                            rst_if_larger(s[i].beyond, 1 + ez[i], sliding, 1)); /* v_t may be 0 */
        kept[count] = i;
        count += !(s[i].beyond > 1 + ez[i]);
    }
    return count;
}

static void find_sheets(const restitute_table *t, int n, const int *kept, const struct rst_asked *asked,
                        const double *ez, struct seat *seats)
{
    const struct rst_tree *tree = &t->tangent;
    for (int k = 0; k < n; k++) {
        const struct rst_asked *a = &asked[kept[k]];
        struct seat *s = &seats[kept[k]];
        s->sheet = rst_sheet_select(a->sliding, a->v_n, s->beyond, ez[kept[k]]);
        set_code(t, s);
        const int32_t *start = rst_tree_start(tree, s->spot.octave, s->spot.root, s->spot.gamma);
        s->next = rst_tree_first(tree, start[s->sheet.number], s->code);
    }
}

static void find_leaves(const restitute_table *t, int n, const int *kept, struct seat *seats)
{
    for (int k = 0; k < n; k++) {
        struct seat *s = &seats[kept[k]];
        s->next = (int32_t)rst_tree_rest(&t->tangent, s->next, 1, s->code);
        FETCH(&t->tangent.shape[s->next]);
        fetch_cell(t, s->next);
    }
}

void rst_cells_pairs(const restitute_table *t, int n, const struct rst_asked *a, double *ez, double *ex)
{
    struct seat s[rst_block];
    int kept[rst_block];
    find_spots(t, n, a, s);
    const int count = find_rebounds(t, n, a, s, ez, ex, kept);
    find_sheets(t, count, kept, a, ez, s);
    find_leaves(t, count, kept, s);
    for (int k = 0; k < count; k++) {
        const struct seat *at = &s[kept[k]];
        const double sum = sum_tangential(t, at->next, at->sheet.place, at->chi, at->spot.w, at->spot.gamma);
        ex[kept[k]] = ex_of(&at->sheet, sum, ez[kept[k]]);
    }
}
