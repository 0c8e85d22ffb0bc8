/* The stages of the build of a table of patches (grid.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "grid.h"

#include <stdlib.h>

/* Parts of the tolerance: what the last coefficients of a column may be worth, and how far a check may be off along
 * an axis. */
static const double part_for_column = 0.5, part_along = 0.5;

enum { lattice_nodes = rst_cubic << rst_finest_patch, most_failures = 8 };

static const double golden = 0.61803398874989485;

int64_t rst_grid_at(int64_t octave, int64_t k, int64_t i)
{
    return octave * lattice_nodes + (i << (rst_finest_patch - k));
}

struct rst_column *rst_grid_column(const struct rst_grid *g, int64_t at, int64_t by)
{
    const int32_t number = g->column_at[at * g->lattice[1] + by];
    return number > 0 ? &g->column[number - 1] : NULL;
}

int rst_grid_create(struct restitute_table_builder *b)
{
    struct rst_grid *g = calloc(1, sizeof *g);
    b->grid = g;
    if (!g) return 1;
    for (int a = 0; a < 2; a++) {
        rst_octaves_set(b->seam_low[a], b->seam_high[a], 0, &g->axis[a]);
        g->lattice[a] = g->axis[a].cells * lattice_nodes + 1;
    }
    g->regions = g->axis[0].cells * g->axis[1].cells;
    g->region = calloc((size_t)g->regions, sizeof *g->region);
    g->column_at = calloc((size_t)(g->lattice[0] * g->lattice[1]), sizeof *g->column_at);
    return !g->region || !g->column_at;
}

void rst_grid_free(struct rst_grid *g)
{
    if (!g) return;
    for (int64_t i = 0; i < g->columns; i++)
        free(g->column[i].value);
    free(g->column);
    free(g->column_at);
    free(g->region);
    free(g->check);
    free(g);
}

/* ---- nodes */

int64_t rst_grid_coarser(const struct rst_grid *g, int64_t patch, const int64_t i[2], int *along)
{
    const int64_t octave[2] = {patch / g->axis[1].cells, patch % g->axis[1].cells};
    const struct rst_region *r = &g->region[patch];
    for (int across = 0; across < 2; across++) {
        const int64_t last = rst_cubic << r->k[across], step = i[across] == 0 ? -1 : 1;
        if (i[across] != 0 && i[across] != last) continue;
        if (octave[across] + step < 0 || octave[across] + step >= g->axis[across].cells) continue;
        const int64_t other = patch + step * (across == 0 ? g->axis[1].cells : 1);
        *along = 1 - across;
        if (g->region[other].k[*along] < r->k[*along]) return other;
    }
    return -1;
}

/* Edges that neighbours share must not be much coarser than the cells at them. Nonzero if any patch was divided. */
static int balance(struct rst_grid *g)
{
    int any = 0;
    for (int64_t p = 0; p < g->regions; p++)
        for (int across = 0; across < 2; across++) {
            const int64_t step = across == 0 ? g->axis[1].cells : 1, along = 1 - across;
            const int last = across == 0 ? p / step + 1 == g->axis[0].cells : (p + 1) % g->axis[1].cells == 0;
            if (last) continue;
            struct rst_region *a = &g->region[p], *c = &g->region[p + step];
            struct rst_region *coarse = a->k[along] < c->k[along] ? a : c;
            const int64_t finest = a->k[along] > c->k[along] ? a->k[along] : c->k[along];
            if (coarse->k[along] >= finest - 1) continue;
            coarse->k[along] = finest - 1;
            coarse->checked = 0;
            any = 1;
        }
    return any;
}

static int new_column(struct restitute_table_builder *b, const int64_t octave[2], const int64_t k[2],
                      const int64_t i[2])
{
    struct rst_grid *g = b->grid;
    int32_t *at =
        &g->column_at[rst_grid_at(octave[0], k[0], i[0]) * g->lattice[1] + rst_grid_at(octave[1], k[1], i[1])];
    if (*at) return 0;
    if (g->columns == INT32_MAX) return 1;
    if (g->columns == g->column_capacity) {
        const int64_t capacity = g->columns ? 2 * g->columns : 1024;
        struct rst_column *columns = realloc(g->column, (size_t)capacity * sizeof *columns);
        if (!columns) return 1;
        g->column = columns;
        g->column_capacity = capacity;
    }
    struct rst_column *c = &g->column[g->columns];
    *c = (struct rst_column){.delta1 = rst_patch_node(&g->axis[0], octave[0], k[0], i[0]),
                             .gamma = rst_patch_node(&g->axis[1], octave[1], k[1], i[1]),
                             .ez = NAN,
                             .goal = part_for_column * b->options.tolerance,
                             .pending = 1};
    if (rst_columns_start(b, c)) return 1;
    *at = (int32_t)++g->columns;
    return 0;
}

/* The columns that the patches need as they are divided now. */
static int need_columns(struct restitute_table_builder *b)
{
    struct rst_grid *g = b->grid;
    for (int64_t p = 0; p < g->regions; p++) {
        const int64_t octave[2] = {p / g->axis[1].cells, p % g->axis[1].cells};
        const int64_t *k = g->region[p].k;
        int64_t i[2];
        int along;
        for (i[0] = 0; i[0] <= rst_cubic << k[0]; i[0]++)
            for (i[1] = 0; i[1] <= rst_cubic << k[1]; i[1]++)
                if (rst_grid_coarser(g, p, i, &along) < 0 && new_column(b, octave, k, i)) return 1;
    }
    return 0;
}

/* ---- checks */

static int add_check(struct restitute_table_builder *b, struct rst_check check)
{
    struct rst_grid *g = b->grid;
    if (g->checks == g->check_capacity) {
        const int64_t capacity = g->checks ? 2 * g->checks : 1024;
        struct rst_check *checks = realloc(g->check, (size_t)capacity * sizeof *checks);
        if (!checks) return 1;
        g->check = checks;
        g->check_capacity = capacity;
    }
    const struct rst_point p = {
        .u = {check.delta1, check.gamma, check.chi}, .s = check.psi, .column = -1, .slot = g->checks};
    g->check[g->checks++] = check;
    return rst_plan_add(b, p);
}

/* psi from a place: [0, 1] on the stick side, [1, 2] for 1 + y. */
static double psi_at(const struct restitute_table_builder *b, const struct rst_check *c, double place)
{
    if (place <= 1) return place;
    const double ez = rst_table_rebound(b->draft, c->delta1, c->gamma);
    return 1 + (place - 1) * (restitute_critical_psi(c->chi, ez) - 1);
}

/* At places of chi and psi that are points of every column. */
static int check_along(struct restitute_table_builder *b, struct rst_check c)
{
    static const double t[3] = {0.14644660940672624, 0.5, 0.85355339059327376};
    const int chis = b->active[RST_CHI] ? 3 : 1, kinds = b->active[RST_SLIP] ? 6 : 3;
    for (int i = 0; i < chis; i++)
        for (int j = 0; j < kinds; j++) {
            c.chi = rst_builder_number(b, RST_CHI, 0.5 * i);
            c.psi = psi_at(b, &c, j < 3 ? 0.5 * j : 1 + rst_y_of_t(t[j - 3]));
            if (add_check(b, c)) return 1;
        }
    return 0;
}

static int check_middle(struct restitute_table_builder *b, struct rst_check c)
{
    const int kinds = b->active[RST_SLIP] ? 6 : 3;
    for (int j = 0; j < kinds; j++) {
        const double number = (double)b->grid->checks;
        const double place = fmod(golden * number, 1);
        c.chi = rst_builder_number(b, RST_CHI, fmod(golden * golden * 0.7 * number, 1));
        c.psi = psi_at(b, &c, j % 2 == 1 || kinds == 3 ? place : 1 + place);
        if (add_check(b, c)) return 1;
    }
    return 0;
}

static int check_cell(struct restitute_table_builder *b, int64_t p, int64_t i, int64_t j)
{
    const struct rst_grid *g = b->grid;
    const int64_t octave[2] = {p / g->axis[1].cells, p % g->axis[1].cells}, *k = g->region[p].k, cell[2] = {i, j};
    double node[2], half[2], middle[2];
    for (int a = 0; a < 2; a++) {
        const int64_t first = rst_cubic * cell[a],
                      end = (i + j) % 2 ? 0 : 2; /* the cubic is worst in the outer intervals */
        node[a] = rst_patch_node(&g->axis[a], octave[a], k[a], first + 1 + (i + j) % 2);
        half[a] = 0.5 * (rst_patch_node(&g->axis[a], octave[a], k[a], first + end) +
                         rst_patch_node(&g->axis[a], octave[a], k[a], first + end + 1));
        middle[a] = 0.5 * (rst_patch_node(&g->axis[a], octave[a], k[a], first) +
                           rst_patch_node(&g->axis[a], octave[a], k[a], first + rst_cubic));
    }
    struct rst_check c = {.delta1 = half[0], .gamma = node[1], .patch = p, .kind = 0};
    if (check_along(b, c)) return 1;
    c = (struct rst_check){.delta1 = node[0], .gamma = half[1], .patch = p, .kind = 1};
    if (check_along(b, c)) return 1;
    c = (struct rst_check){.delta1 = middle[0], .gamma = middle[1], .patch = p, .kind = 2};
    return check_middle(b, c);
}

static int plan_checks(struct restitute_table_builder *b)
{
    struct rst_grid *g = b->grid;
    rst_plan_begin(b);
    g->first_new_check = g->checks;
    for (int64_t p = 0; p < g->regions; p++) {
        if (g->region[p].checked) continue;
        for (int64_t i = 0; i < INT64_C(1) << g->region[p].k[0]; i++)
            for (int64_t j = 0; j < INT64_C(1) << g->region[p].k[1]; j++)
                if (check_cell(b, p, i, j)) return 1;
        g->region[p].checked = 1;
    }
    return 0;
}

/* Largest differences to all impacts of the checks, and which patches do not do. */
static void compare(struct restitute_table_builder *b)
{
    struct rst_grid *g = b->grid;
    const double tolerance = b->options.tolerance;
    for (int64_t i = 0; i < b->points; i++)
        g->check[b->point[i].slot].solved = b->solved[i];
    for (int64_t p = 0; p < g->regions; p++)
        g->region[p].along[0] = g->region[p].along[1] = g->region[p].middle = 0;
    b->worst_ez = b->worst_ex = 0;
    for (int64_t i = 0; i < g->checks; i++) {
        const struct rst_check *c = &g->check[i];
        restitute_table_value pair;
        rst_table_evaluate(b->draft, c->delta1, c->gamma, c->chi, c->psi, &pair);
        const double ez = fabs(pair.ez - c->solved.ez), ex = fabs(pair.ex - c->solved.ex);
        const double worst = fmax(ez + c->solved.error_ez, ex + c->solved.error_ex);
        b->worst_ez = fmax(b->worst_ez, ez + c->solved.error_ez);
        b->worst_ex = fmax(b->worst_ex, ex + c->solved.error_ex);
        struct rst_region *r = &g->region[c->patch];
        if (c->kind < 2 && fmax(ez, ex) > part_along * tolerance) r->along[c->kind] = 1;
        if (worst > tolerance) r->middle = 1;
    }
}

/* Columns of a patch are to be better. Where a coarser neighbour has just been divided the patch gets nodes that have
 * no column yet. */
static void raise_goals(struct rst_grid *g, int64_t p)
{
    const int64_t octave[2] = {p / g->axis[1].cells, p % g->axis[1].cells}, *k = g->region[p].k;
    int64_t i[2];
    int along;
    for (i[0] = 0; i[0] <= rst_cubic << k[0]; i[0]++)
        for (i[1] = 0; i[1] <= rst_cubic << k[1]; i[1]++) {
            struct rst_column *column =
                rst_grid_column(g, rst_grid_at(octave[0], k[0], i[0]), rst_grid_at(octave[1], k[1], i[1]));
            if (column && rst_grid_coarser(g, p, i, &along) < 0) column->goal *= 0.6;
        }
}

/* Divide patches where checks along an axis fail; where only others do, their columns get more points, or both. */
static int refine(struct restitute_table_builder *b)
{
    struct rst_grid *g = b->grid;
    int any = 0;
    for (int64_t p = 0; p < g->regions; p++) {
        struct rst_region *r = &g->region[p];
        const int divide = r->along[0] || r->along[1], failed = divide || r->middle;
        if (!failed || r->failures >= most_failures) continue;
        r->failures++;
        any = 1;
        if (!divide) raise_goals(g, p);
        for (int a = 0; a < 2; a++)
            if ((divide ? r->along[a] : r->failures % 2 == 0) && r->k[a] < rst_finest_patch) {
                r->k[a]++;
                r->checked = 0;
            }
    }
    while (balance(g))
        continue;
    return any;
}

/* ---- stages */

static int out_of_memory(restitute_error *error)
{
    return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
}

static int begin_filling(struct restitute_table_builder *b, restitute_error *error)
{
    b->stage = RST_FILLING;
    if (need_columns(b) || rst_columns_plan(b)) return out_of_memory(error);
    if (b->used + b->points <= b->options.max_impacts) return RESTITUTE_OK;
    rst_plan_begin(b);
    if (b->draft) {
        b->stage = RST_FINISHED;
        return RESTITUTE_OK;
    }
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                      "max_impacts = %lld: the table needs more after the %lld solved; raise it or the tolerance, "
                      "or narrow the ranges",
                      (long long)b->options.max_impacts, (long long)b->used);
}

static int after_filling(struct restitute_table_builder *b, restitute_error *error)
{
    int any;
    restitute_table *table;
    if (rst_columns_lengthen(b, &any)) return out_of_memory(error);
    if (any) return begin_filling(b, error);
    if (rst_patches_make(b, &table)) return out_of_memory(error);
    restitute_table_destroy(b->draft);
    b->draft = table;
    if (plan_checks(b)) return out_of_memory(error);
    b->stage = RST_CHECKING;
    return RESTITUTE_OK;
}

static int after_checking(struct restitute_table_builder *b, restitute_error *error)
{
    compare(b);
    b->draft->checks = b->grid->checks;
    if (!refine(b)) {
        rst_plan_begin(b);
        b->stage = RST_FINISHED;
        return RESTITUTE_OK;
    }
    for (int64_t i = 0; i < b->grid->columns; i++)
        b->grid->column[i].pending = 0;
    return begin_filling(b, error);
}

int rst_grid_next(struct restitute_table_builder *b, restitute_error *error)
{
    if (b->stage == RST_PROBING) return begin_filling(b, error);
    if (b->stage == RST_CHECKING) return after_checking(b, error);
    rst_columns_collect(b, b->part);
    if (b->part == 0) {
        b->part = 1;
        b->next = 0;
        return RESTITUTE_OK;
    }
    b->part = 0;
    b->next = 0;
    return after_filling(b, error);
}
