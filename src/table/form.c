/* Nodes of a table and its room.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>

#include "table_form.h"

void rst_octaves_set(double low, double high, int k, struct rst_octaves *axis)
{
    int64_t first, last;
    *axis = (struct rst_octaves){.low = low, .high = low, .shift = 52 - k, .scale = ldexp(1, k - 52)};
    if (!(low < high)) return;
    memcpy(&first, &low, sizeof first);
    memcpy(&last, &high, sizeof last);
    axis->high = nextafter(high, low);
    axis->first = first >> axis->shift;
    axis->cells = (last >> axis->shift) - axis->first;
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

double rst_slip_node(const struct rst_slip_cells *cells, int64_t i)
{
    const int64_t half = (cells->octaves - 1) * rst_quintic;
    const int turned = i > half;
    const int64_t j = turned ? i - half - 1 : i;
    const double start = ldexp(cells->end, (int)(j / rst_quintic));
    const double number = start + start * (double)(j % rst_quintic) / rst_quintic;
    const double u = j == half ? 0.5 : (number - cells->end) / cells->stretch;
    return turned ? 1 - u : u;
}

void rst_table_count(restitute_table *form)
{
    form->n_speed = form->speed.cells * rst_cubic + 1;
    form->n_gamma = form->gamma.cells * rst_cubic + 1;
    form->slip_start = form->stick_cells * rst_quintic + 1;
    const int64_t half = form->slip.octaves > 0 ? (form->slip.octaves - 1) * rst_quintic + 1 : 0;
    form->turned_start = form->slip_start + half;
    form->n_psi = form->turned_start + half;
}

void rst_table_chi_weights(restitute_table *form)
{
    for (int64_t j = 0; j < form->n_chi; j++) {
        double product = 1;
        for (int64_t i = 0; i < form->n_chi; i++)
            if (i != j) product *= form->chi[j] - form->chi[i];
        form->chi_weight[j] = 1 / product;
    }
}

restitute_table *rst_table_allocate(const restitute_table *form)
{
    const size_t n_ez = (size_t)form->n_speed * (size_t)form->n_gamma;
    const size_t n_ex = n_ez * (size_t)form->n_psi * (size_t)form->n_chi;
    const size_t size = n_ez + n_ex + 2 * (size_t)form->terms;
    restitute_table *table = malloc(sizeof *table + size * sizeof(double));
    if (!table) return NULL;
    *table = *form;
    table->block_size = size;
    table->ez = table->block;
    table->ex = table->block + n_ez;
    table->term = table->block + n_ez + n_ex;
    return table;
}

void restitute_table_destroy(restitute_table *table)
{
    free(table);
}
