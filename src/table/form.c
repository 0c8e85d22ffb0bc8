/* Making a table from its numbers: one block of memory, checked.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/form.h"

#include <stdlib.h>

static const int64_t most_terms = 1000000;

static int refuse(restitute_error *error, const char *name)
{
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "%s: not a valid value of a table", name);
}

static int in_range(const double *value, int64_t n, double low, double high)
{
    for (int64_t i = 0; i < n; i++)
        if (!(value[i] >= low && value[i] <= high)) return 0;
    return 1;
}

static int check_counts(const struct rst_table_data *d, restitute_error *error)
{
    if (d->speeds < 2 || d->speeds > rst_most_speeds) return refuse(error, "speeds");
    if (d->stick_cells < 1 || d->stick_cells > rst_most_cells) return refuse(error, "stick_cells");
    if (d->slip_cells < 1 || d->slip_cells > rst_most_cells) return refuse(error, "slip_cells");
    if (d->terms < 0 || d->terms > most_terms) return refuse(error, "terms");
    if (!(d->chi >= rst_chi_range[0] && d->chi <= rst_chi_range[1])) return refuse(error, "chi");
    if (!(d->psi_factor >= 0)) return refuse(error, "psi_factor");
    if (!(d->low >= rst_sizes.low && d->high <= rst_largest_speed && d->low <= d->high)) return refuse(error, "range");
    return RESTITUTE_OK;
}

/* Slopes may be steep, but nothing may overflow or be NaN. */
static int check_values(const struct rst_table_data *d, restitute_error *error)
{
    const double steep = 1e6;
    const int64_t n = d->speeds;
    if (!in_range(d->speed, n, rst_sizes.low, rst_largest_speed)) return refuse(error, "speed");
    for (int64_t i = 0; i + 1 < n; i++)
        if (d->speed[i] > d->speed[i + 1]) return refuse(error, "speed");
    if (d->speed[0] > d->low || d->speed[n - 1] < d->high || !(d->speed[0] < d->speed[n - 1]))
        return refuse(error, "speed");
    if (!in_range(d->ez, 2 * n, -steep, steep)) return refuse(error, "ez");
    if (!in_range(d->ex, 4 * n * rst_places(d), -steep, steep)) return refuse(error, "ex");
    if (!in_range(d->strain, 3 * n, 0, INFINITY)) return refuse(error, "strain");
    return RESTITUTE_OK;
}

/* Number of bins: one for the narrowest cell, so that few have more than one edge in them. */
static int count_bins(const struct rst_table_data *d)
{
    const double all = rst_axis_place(d->speed[d->speeds - 1], NULL) - rst_axis_place(d->speed[0], NULL);
    double narrowest = all;
    for (int64_t i = 0; i + 1 < d->speeds; i++) {
        const double width = rst_axis_place(d->speed[i + 1], NULL) - rst_axis_place(d->speed[i], NULL);
        if (width > 0) narrowest = fmin(narrowest, width);
    }
    return (int)fmin(rst_most_bins, ceil(all / narrowest - 1e-6)); /* a whole number, but for rounding */
}

static void set_nodes(restitute_table *t)
{
    const int64_t n = t->d.speeds;
    for (int64_t i = 0; i < n; i++) {
        t->node[i].at = rst_axis_place(t->d.speed[i], NULL);
        t->node[i].ez = t->d.ez[2 * i];
        t->node[i].slope = t->d.ez[2 * i + 1];
    }
    for (int64_t i = 0; i + 1 < n; i++) {
        const double width = t->node[i + 1].at - t->node[i].at;
        t->node[i].inverse_width = width > 0 ? 1 / width : 0;
    }
    t->node[n - 1].inverse_width = 0;
    t->end = nextafter(t->node[n - 1].at, -INFINITY); /* the highest speed belongs to the last cell */
}

/* A bin begins slightly late. Edges of cells are on edges of bins, so few searches need a further
 * step. */
static void set_bins(restitute_table *t, int bins)
{
    const double hair = 1e-9, first = t->node[0].at, width = (t->end - first) / bins;
    const int64_t last = t->d.speeds - 2;
    int64_t cell = 0;
    t->bins_per_s = 1 / width;
    for (int i = 0; i <= bins; i++) {
        while (cell < last && t->node[cell + 1].at <= first + ((double)i + hair) * width)
            cell++;
        t->bin[i] = (uint16_t)cell;
    }
}

static char *place(char **next, const void *from, size_t bytes)
{
    char *here = *next;
    if (from && bytes > 0) memcpy(here, from, bytes);
    *next += (bytes + 15) / 16 * 16;
    return here;
}

/* Nodes of ex lie side by side from a boundary of 16 bytes on. */
static void fill(restitute_table *t, const struct rst_table_data *d, int bins)
{
    const size_t n = (size_t)d->speeds, terms = (size_t)d->terms, size = sizeof(double);
    char *next = (char *)t + (sizeof *t + 15) / 16 * 16;
    t->d = *d;
    t->d.ex = (double *)(void *)place(&next, d->ex, 4 * n * (size_t)rst_places(d) * size);
    t->node = (struct rst_node *)(void *)place(&next, NULL, n * sizeof *t->node);
    t->d.speed = (double *)(void *)place(&next, d->speed, n * size);
    t->d.ez = (double *)(void *)place(&next, d->ez, 2 * n * size);
    t->d.strain = (double *)(void *)place(&next, d->strain, 3 * n * size);
    t->d.relaxation_time = (double *)(void *)place(&next, d->relaxation_time, terms * size);
    t->d.modulus = (double *)(void *)place(&next, d->modulus, terms * size);
    t->bin = (uint16_t *)(void *)place(&next, NULL, ((size_t)bins + 1) * sizeof *t->bin);
    t->bytes = (size_t)(next - (char *)t);
    t->share = rst_share(d->chi);
    t->of_stick = (double)d->stick_cells;
    t->of_slip = (double)d->slip_cells;
    set_nodes(t);
    set_bins(t, bins);
    restitute_table_contact_init(&t->own);
    t->own.speed_factor = 1;
    t->own.psi_factor = d->psi_factor;
    t->own.radius = d->radius;
    t->own.mass = d->mass;
}

void restitute_table_contact_init(restitute_table_contact *contact)
{
    if (!contact) return;
    *contact = (restitute_table_contact){.struct_size = sizeof *contact, .speed_factor = 1, .touch_gap = 1e-6};
}

int restitute_private_table_make(const struct rst_table_data *data, restitute_table **table, restitute_error *error)
{
    int status = check_counts(data, error);
    if (!status) status = check_values(data, error);
    if (status) return status;
    const int bins = count_bins(data);
    const size_t n = (size_t)data->speeds, places = (size_t)rst_places(data);
    const size_t bytes = sizeof **table + n * (4 * places * sizeof(double) + 6 * sizeof(double) + sizeof(struct rst_node)) +
                         2 * (size_t)data->terms * sizeof(double) + ((size_t)bins + 1) * sizeof(uint16_t) + 10 * 16;
    restitute_table *made = malloc(bytes);
    if (!made) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    fill(made, data, bins);
    *table = made;
    return RESTITUTE_OK;
}

const struct rst_table_data *restitute_private_table_data(const restitute_table *table)
{
    return &table->d;
}

void restitute_table_destroy(restitute_table *table)
{
    free(table);
}
