/* Derivatives in a table with axes of delta1 and gamma: those of the polynomials of the cells that a lookup takes.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "slope.h"

#include "table_form.h"

/* Functions of a cell along an axis, and their derivatives by the number that the axis goes by. */
struct edge {
    double f[rst_places], df[rst_places];
};

static const struct edge no_axis = {.f = {1}};

/* stretch: how the place u in the root goes with that number. */
static void set_edge(uint64_t u, int halvings, double stretch, struct edge *e)
{
    const double place = rst_tree_place(u, halvings);
    rst_serendipity_functions(place, e->f);
    rst_serendipity_slopes(place, e->df);
    for (int i = 0; i < rst_places; i++)
        e->df[i] *= ldexp(stretch, halvings);
}

/* Of log2 w by delta1; 0 outside of the table. */
static double w_stretch(const restitute_table *t, double delta1)
{
    return delta1 >= t->speed.low && delta1 <= t->speed.high ? t->w.scale / (delta1 * log(2)) : 0;
}

/* ez, and its derivative by delta1. */
static double rebound(const restitute_table *t, const struct rst_spot *spot, double stretch, double *slope)
{
    const uint32_t code = rst_tree_code(&t->rebound, RST_ALONG_W, spot->w);
    const int64_t leaf = rst_tree_find(&t->rebound, spot->octave, spot->root, 0, spot->gamma, code);
    const struct rst_shape shape = t->rebound.shape[leaf];
    const double *v = t->ez + leaf * rst_pair_functions;
    struct edge w, gamma;
    set_edge(spot->w, t->rebound.halvings[shape.depth][RST_ALONG_W], stretch, &w);
    set_edge(spot->gamma, shape.level, 0, &gamma);
    double ez = 0, by_delta1 = 0;
    for (int64_t n = 0; n < t->of_ez.count; n++) {
        const int8_t *at = t->of_ez.at[n];
        ez += w.f[at[RST_W]] * gamma.f[at[RST_G]] * v[n];
        by_delta1 += w.df[at[RST_W]] * gamma.f[at[RST_G]] * v[n];
    }
    *slope = ez > 0 && ez < 1 ? by_delta1 : 0;
    return fmin(1, fmax(0, ez));
}

/* Where in the tree of ex, and how the place on the sheet goes with psi, or beyond psi = 1 with y. */
struct seat {
    int64_t sheet;
    uint64_t chi, psi;
    double y, stretch;
};

static struct seat find_seat(const restitute_table *t, double chi, double psi, double ez)
{
    const struct rst_sheet sheet = rst_sheet_find(psi, 1, rst_slip_beyond(chi, psi, 1), ez);
    struct seat seat = {.sheet = sheet.number, .psi = sheet.place, .y = sheet.y, .stretch = 1};
    if (seat.sheet > 0)
        seat.stretch = 0.25 * rst_slip_sheets / rst_largest_r / sqrt(fmin(seat.y, 1 - seat.y) + rst_soft * rst_soft);
    if (t->n_chi > 1) seat.chi = rst_tree_bits(fmin(rst_below_number, (chi - t->chi_low) / (t->chi_high - t->chi_low)));
    return seat;
}

/* What is kept: its value, and its derivatives by delta1 and by psi or y. */
struct kept {
    double value, by_delta1, by_psi;
};

static struct kept sum_cell(const restitute_table *t, const struct rst_spot *spot, double stretch,
                            const struct seat *seat)
{
    const struct rst_tree *tree = &t->tangent;
    const uint32_t code = rst_tree_code(tree, RST_ALONG_W, spot->w) | rst_tree_code(tree, RST_ALONG_CHI, seat->chi) |
                          rst_tree_code(tree, RST_ALONG_PSI, seat->psi);
    const int64_t leaf = rst_tree_find(tree, spot->octave, spot->root, seat->sheet, spot->gamma, code);
    const int depth = tree->shape[leaf].depth;
    const float *v = t->ex_cells + leaf * t->of_ex.count;
    struct edge w, gamma, chi = no_axis, psi;
    struct kept sum = {0, 0, 0};
    set_edge(spot->w, tree->halvings[depth][RST_ALONG_W], stretch, &w);
    set_edge(spot->gamma, tree->shape[leaf].level, 0, &gamma);
    if (t->n_chi > 1) set_edge(seat->chi, tree->halvings[depth][RST_ALONG_CHI], 0, &chi);
    set_edge(seat->psi, tree->halvings[depth][RST_ALONG_PSI], seat->stretch, &psi);
    for (int64_t n = 0; n < t->of_ex.count; n++) {
        const int8_t *at = t->of_ex.at[n];
        const double part = gamma.f[at[RST_G]] * chi.f[at[RST_C]] * (double)v[n];
        sum.value += w.f[at[RST_W]] * psi.f[at[RST_P]] * part;
        sum.by_delta1 += w.df[at[RST_W]] * psi.f[at[RST_P]] * part;
        sum.by_psi += w.f[at[RST_W]] * psi.df[at[RST_P]] * part;
    }
    return sum;
}

/* Beyond psi = 1: psi ex is what is kept and y ez; y moves with psi_c, which moves with ez. */
static void slip_slope(const struct kept *kept, double y, double ez, double psi, double width, double width_by_ez,
                       struct rst_slope *slope)
{
    const double ex = (kept->value + y * ez) / psi, by_y = kept->by_psi + ez;
    const double y_by_delta1 = -y * width_by_ez * slope->ez_speed / width;
    slope->ex_speed = (kept->by_delta1 + by_y * y_by_delta1 + y * slope->ez_speed) / psi;
    slope->ex_psi = (by_y / width - ex) / psi;
}

void rst_cell_slope(const restitute_table *t, double delta1, double gamma, double chi, double psi,
                    struct rst_slope *slope)
{
    struct rst_spot spot;
    const double stretch = w_stretch(t, delta1);
    rst_spot_find(t, delta1, gamma, &spot);
    *slope = (struct rst_slope){.ez_speed = 0};
    const double ez = rebound(t, &spot, stretch, &slope->ez_speed);
    chi = fmin(fmax(chi, t->chi_low), t->chi_high);
    const double full = 2 * chi * (1 + ez), critical = 2 * chi > 1 ? full - ez : 1;
    if (psi >= critical) { /* psi^2 could overflow */
        slope->ex_speed = 2 * chi * slope->ez_speed / psi;
        slope->ex_psi = -full / psi / psi;
        return;
    }
    const struct seat seat = find_seat(t, chi, psi, ez);
    const struct kept kept = sum_cell(t, &spot, stretch, &seat);
    slope->ex_speed = kept.by_delta1;
    slope->ex_psi = kept.by_psi;
    if (psi > 1) slip_slope(&kept, seat.y, ez, psi, critical - 1, 2 * chi - 1, slope);
}
