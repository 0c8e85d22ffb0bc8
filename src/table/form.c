/* Nodes of a table and its room.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "table_form.h"

void rst_octaves_set(double low, double high, int k, struct rst_octaves *axis)
{
    int64_t first, last;
    *axis = (struct rst_octaves){.low = low,
                                 .high = low,
                                 .shift = 52 - k,
                                 .mask = (INT64_C(1) << (52 - k)) - 1,
                                 .scale = ldexp(rst_cubic, k - 52)};
    if (!(low < high)) return;
    memcpy(&first, &low, sizeof first);
    memcpy(&last, &high, sizeof last);
    axis->high = nextafter(high, low);
    axis->first = first >> axis->shift;
    axis->cells = (last >> axis->shift) - axis->first;
}

void rst_octaves_limit(double low, double high, struct rst_octaves *axis)
{
    if (axis->cells == 0) return;
    if (low > axis->low) axis->low = low;
    if (high < axis->high) axis->high = high;
}

double rst_octaves_node(const struct rst_octaves *axis, int64_t i)
{
    if (axis->cells == 0) return axis->low;
    double start, end;
    const int64_t bits = (axis->first + i / rst_cubic) << axis->shift;
    const int64_t next = (axis->first + i / rst_cubic + 1) << axis->shift;
    memcpy(&start, &bits, sizeof start);
    memcpy(&end, &next, sizeof end);
    return start + (end - start) * (double)(i % rst_cubic) / rst_cubic;
}

double rst_slip_node(int64_t cells, int64_t i)
{
    return (double)i / (double)(cells * rst_cubic) * rst_largest_r;
}

double rst_slip_y(double r)
{
    return fmin(0.5, r * (r + 2 * rst_soft));
}

/* Places are kept by 2^-42 of a cell behind the start of the first one and before the end of the last one, so that no
 * rounding, in whatever direction, leads beyond. y = 1 leads to the same place as y = 0, since total - square is soft
 * without rounding. */
static void set_psi_cells(restitute_table *form)
{
    const double begin = rst_cells_begin + 0x1p-42, less = 0x1p-40;
    const double of_root = fmax((double)form->slip_cells - less, 0) / rst_largest_r, square = of_root * of_root;
    const double total = square + rst_soft * rst_soft * square, soft = total - square;
    form->psi_cells[0] = (struct rst_psi_cells){
        .of_psi = fmax((double)form->stick_cells - less, 0), .begin = begin, .open = 1};
    form->psi_cells[1] = (struct rst_psi_cells){.square = rst_two_of(square),
                                                .soft = rst_two_of(soft),
                                                .total = rst_two_of(total),
                                                .of_root = of_root,
                                                .begin = begin - sqrt(soft),
                                                .closed = 1,
                                                .small = rst_small};
    form->share = square > 0 ? rst_small * ((2 * form->chi_low - 1) / square) : 0;
    form->limit = 4 * square;
}

void rst_table_count(restitute_table *form)
{
    form->n_speed = form->speed.cells * rst_cubic + 1;
    form->n_gamma = form->gamma.cells * rst_cubic + 1;
    if (form->n_cells > 0) {
        form->n_speed = form->n_cells;
        form->n_chi = form->chi_low < form->chi_high ? rst_places : 1;
        form->n_psi = rst_places;
        rst_serendipity_set((int[rst_cell_axes]){[RST_W] = 1, [RST_G] = 1}, &form->of_ez);
        rst_serendipity_set((int[rst_cell_axes]){1, 1, [RST_C] = form->n_chi > 1, [RST_P] = 1}, &form->of_ex);
        form->n_gamma = form->of_ex.count;
        return;
    }
    form->n_chi = form->chi_cells * rst_cubic + 1;
    form->start[0] = 0;
    form->start[1] = form->stick_cells * rst_cubic + 1;
    const int64_t half = form->slip_cells > 0 ? form->slip_cells * rst_cubic + 1 : 0;
    form->start[2] = form->start[1] + half;
    form->n_psi = form->start[2] + half;
    form->two_axes = form->n_speed > 1 && form->n_gamma == 1 && form->n_chi == 1 && form->slip_cells > 0 &&
                     form->chi_low > 0.5 && form->chi_low <= rst_most_chi_of_two_axes;
    form->first_cell[0] = 0;
    form->first_cell[1] = form->stick_cells;
    form->first_cell[2] = form->stick_cells + form->slip_cells;
    form->cells_of_psi = form->stick_cells + 2 * form->slip_cells;
    set_psi_cells(form);
}

double rst_chi_node(const restitute_table *form, int64_t i)
{
    const int64_t last = form->chi_cells * rst_cubic;
    if (i == last) return form->chi_high;
    return form->chi_low + (form->chi_high - form->chi_low) * ((double)i / (double)last);
}

double rst_table_h(double gamma)
{
    return pow(gamma, 0.56) * pow(1 + gamma, 0.44);
}

void rst_w_axis_logs(struct rst_w_axis *w)
{
    w->begin = (double)w->first - rst_roots_begin;
    w->end = rst_roots_begin + (double)w->roots - 0x1p-40;
    for (int i = 0; i < 5; i++)
        w->series[i] = (i % 2 ? -1 : 1) * w->scale / ((i + 1) * log(2));
    for (int i = 0; i < rst_log_parts; i++) {
        const double middle = 1 + (i + 0.5) / rst_log_parts;
        w->inverse[i] = 1 / middle;
        w->log[i] = log2(middle) * w->scale;
    }
}

void rst_w_axis_set(double low, double high, const struct rst_octaves *gamma, int64_t width, struct rst_w_axis *w)
{
    const double end = rst_octaves_node(gamma, gamma->cells * rst_cubic), scale = ldexp(1, -(int)width);
    const double first = log2(low * rst_table_h(rst_octaves_node(gamma, 0))) * scale;
    const double last = log2(high * rst_table_h(end)) * scale;
    *w = (struct rst_w_axis){.first = (int64_t)floor(first), .width = width, .scale = scale};
    w->roots = (int64_t)floor(last) + 1 - w->first;
    rst_w_axis_logs(w);
}

/* Doubles that hold so many bytes. */
static size_t doubles(size_t bytes)
{
    return (bytes + sizeof(double) - 1) / sizeof(double);
}

/* The cubic through four evenly spaced values, by powers of the place in [0, 1]. */
static void set_cubic(const double y[4], double power[4])
{
    const double first = 3 * (y[1] - y[0]), second = 4.5 * (y[2] - 2 * y[1] + y[0]);
    const double third = 4.5 * ((y[3] - y[0]) - 3 * (y[2] - y[1]));
    power[0] = y[0];
    power[1] = first - second / 3 + third * 2 / 9;
    power[2] = second - third;
    power[3] = third;
}

/* h in an octave of gamma. */
static void set_h(const struct rst_octaves *gamma, int64_t octave, double h[4])
{
    double y[4];
    for (int i = 0; i < 4; i++)
        y[i] = rst_table_h(rst_octaves_node(gamma, octave * rst_cubic + i));
    set_cubic(y, h);
}

/* The same by powers of the place in [1, 2]. */
static void set_shifted_cubic(const double y[4], double power[4])
{
    double a[4];
    set_cubic(y, a);
    power[0] = (a[0] - a[1]) + (a[2] - a[3]);
    power[1] = (a[1] - 2 * a[2]) + 3 * a[3];
    power[2] = a[2] - 3 * a[3];
    power[3] = a[3];
}

/* A bicubic through four by four values, rows `stride` apart, of which `less` is taken away. */
static void set_patch(const double *value, int64_t stride, const double less[4], double patch[4][4])
{
    double row[4][4];
    for (int i = 0; i < 4; i++) {
        set_shifted_cubic(value + i * stride, row[i]);
        row[i][0] -= less[i];
    }
    for (int j = 0; j < 4; j++) {
        double power[4];
        set_shifted_cubic((double[]){row[0][j], row[1][j], row[2][j], row[3][j]}, power);
        for (int i = 0; i < 4; i++)
            patch[i][j] = power[i];
    }
}

static void set_inverse(const double ez[4], double inverse[4])
{
    double power[4];
    set_shifted_cubic((double[]){1 / (1 + ez[0]), 1 / (1 + ez[1]), 1 / (1 + ez[2]), 1 / (1 + ez[3])}, power);
    memcpy(inverse, (double[]){power[0], power[2], power[1], power[3]}, sizeof power);
}

void rst_table_set_polynomials(restitute_table *t)
{
    const int64_t parts[3] = {t->stick_cells, t->slip_cells, t->slip_cells};
    if (!t->two_axes) return;
    t->low = rst_two_of(t->speed.low);
    t->high = rst_two_of(t->speed.high);
    for (int64_t i = 0; i < t->speed.cells; i++) {
        const double *ez = t->ez + i * rst_cubic, *ex = t->ex + i * rst_cubic * t->n_psi;
        double closed[2][4] = {{0}, {0}}; /* at psi = 1; beyond it that is taken away already */
        for (int j = 0; j < 4; j++)
            closed[0][j] = 2 * t->chi_low * (1 + ez[j]) - 1;
        set_inverse(ez, t->inverse[i]);
        for (int part = 0; part < 3; part++)
            for (int64_t j = 0; j < parts[part]; j++)
                set_patch(ex + t->start[part] + j * rst_cubic, t->n_psi, closed[part > 0],
                          t->patch[i * t->cells_of_psi + t->first_cell[part] + j]);
    }
}

/* Trees are planted already. The coefficients of ex begin at a line of memory: a leaf is then on no more lines than it
 * needs. */
static restitute_table *allocate_cells(const restitute_table *form)
{
    const size_t n_ez = (size_t)form->rebound.leaves * rst_pair_functions, n_term = 2 * (size_t)form->terms;
    const size_t n_ex = (size_t)form->n_cells * (size_t)form->n_gamma;
    const size_t octaves = (size_t)form->gamma.cells, line = 64;
    const size_t size = n_ez + n_term + 4 * octaves + doubles(n_ex * sizeof(float) + line);
    restitute_table *table = malloc(sizeof *table + size * sizeof(double));
    if (!table) return NULL;
    *table = *form;
    table->block_size = size;
    table->ez = table->block;
    table->term = table->ez + n_ez;
    table->h = (double(*)[4])(void *)(table->term + n_term);
    for (size_t i = 0; i < octaves; i++)
        set_h(&form->gamma, (int64_t)i, table->h[i]);
    char *free_room = (char *)(table->h + octaves);
    table->ex_cells = (float *)(void *)(free_room + (line - (uintptr_t)free_room % line) % line);
    table->ex = NULL;
    return table;
}

restitute_table *rst_table_allocate(const restitute_table *form)
{
    if (form->n_cells > 0) return allocate_cells(form);
    const size_t n_ez = (size_t)form->n_speed * (size_t)form->n_gamma, n_term = 2 * (size_t)form->terms;
    const size_t n_ex = n_ez * (size_t)form->n_psi * (size_t)form->n_chi, line = 64;
    const size_t n_speed = form->two_axes ? (size_t)form->speed.cells : 0;
    const size_t n_patch = n_speed * (size_t)form->cells_of_psi * 16;
    const size_t size = n_ez + n_term + n_ex + 4 * n_speed + n_patch + line / sizeof(double);
    restitute_table *table = malloc(sizeof *table + size * sizeof(double));
    if (!table) return NULL;
    *table = *form;
    table->block_size = size;
    table->ez = table->block;
    table->term = table->ez + n_ez;
    table->ex = table->term + n_term;
    table->inverse = (double(*)[4])(void *)(table->ex + n_ex);
    char *free_room = (char *)(table->inverse + n_speed);
    table->patch = (double(*)[4][4])(void *)(free_room + (line - (uintptr_t)free_room % line) % line);
    return table;
}

void restitute_table_destroy(restitute_table *table)
{
    if (!table) return;
    rst_tree_fell(&table->rebound);
    rst_tree_fell(&table->tangent);
    free(table);
}
