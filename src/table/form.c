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
    form->two_axes = form->n_speed > 1 && form->n_gamma == 1 && form->n_chi == 1 && form->slip_cells > 0;
    form->psi_cells[0] = (struct rst_psi_cells){.of_psi = nextafter((double)form->stick_cells, 0)};
    form->psi_cells[1] = (struct rst_psi_cells){
        .of_root = nextafter((double)(form->slip_cells > 0 ? form->slip_cells : 1) / rst_largest_r, 0), .of_closed = 1};
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
    w->begin = (double)w->first;
    w->end = (double)w->roots * rst_below_one;
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

/* The cubic through h at four nodes of an octave, by powers. */
static void set_h(const struct rst_octaves *gamma, int64_t octave, double h[4])
{
    double y[4];
    for (int i = 0; i < 4; i++)
        y[i] = rst_table_h(rst_octaves_node(gamma, octave * rst_cubic + i));
    const double first = 3 * (y[1] - y[0]), second = 4.5 * (y[2] - 2 * y[1] + y[0]);
    const double third = 4.5 * ((y[3] - y[0]) - 3 * (y[2] - y[1]));
    h[0] = y[0];
    h[1] = first - second / 3 + third * 2 / 9;
    h[2] = second - third;
    h[3] = third;
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
    const size_t size = n_ez + n_term + n_ez * (size_t)form->n_psi * (size_t)form->n_chi;
    restitute_table *table = malloc(sizeof *table + size * sizeof(double));
    if (!table) return NULL;
    *table = *form;
    table->block_size = size;
    table->ez = table->block;
    table->term = table->ez + n_ez;
    table->ex = table->term + n_term;
    return table;
}

void restitute_table_destroy(restitute_table *table)
{
    if (!table) return;
    rst_tree_fell(&table->rebound);
    rst_tree_fell(&table->tangent);
    free(table);
}
