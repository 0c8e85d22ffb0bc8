/* A table from columns: values, and slopes by seven neighbours.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <stdlib.h>

/* What the arrays of a table's numbers point to, in one block. */
struct arrays {
    double *block, *speed, *ez, *strain, *ex, *relaxation_time, *modulus;
};

static int allocate(restitute_table_data *d, struct arrays *a)
{
    const int64_t n = d->speeds, ex = 4 * n * rst_places(d);
    a->block = malloc((size_t)(7 * n + ex + 2 * d->terms) * sizeof *a->block);
    if (!a->block) return RESTITUTE_ERROR_MEMORY;
    d->speed = a->speed = a->block;
    d->ez = a->ez = a->speed + n;
    d->strain = a->strain = a->ez + 2 * n;
    d->ex = a->ex = a->strain + 4 * n;
    d->relaxation_time = a->relaxation_time = a->ex + ex;
    d->modulus = a->modulus = a->relaxation_time + d->terms;
    return RESTITUTE_OK;
}

static void describe(const struct rst_builder *b, restitute_table_data *d)
{
    const struct rst_contact *c = &b->contact;
    const restitute_material *m = c->scene.material;
    *d = (restitute_table_data){.struct_size = sizeof *d,
                                .low = b->options.speed[0],
                                .high = b->options.speed[1],
                                .tolerance = b->options.tolerance,
                                .error_ez = b->error_ez,
                                .error_ex = b->error_ex,
                                .impacts = b->impacts,
                                .checks = b->checks,
                                .chi = c->numbers.chi,
                                .gamma = c->numbers.gamma,
                                .delta1 = c->numbers.delta1,
                                .duration = c->numbers.time,
                                .friction = c->friction,
                                .radius = c->numbers.radius,
                                .mass = c->numbers.mass,
                                .density = c->numbers.density,
                                .dundurs_beta = c->numbers.dundurs_beta,
                                .poisson_ratio = restitute_material_poisson_ratio(m),
                                .speed_limit = b->options.speed_limit,
                                .radius_limit = b->options.radius_limit,
                                .displacement_limit = b->options.displacement_limit,
                                .dundurs_limit = b->options.dundurs_limit,
                                .terms = (int64_t)restitute_material_terms(m),
                                .speeds = b->columns,
                                .stick_cells = b->cells[0],
                                .slip_cells = b->cells[1]};
    d->psi_factor = rst_psi_factor(c);
    restitute_material_window(m, &d->shortest, &d->longest, NULL);
    restitute_material_series(m, &d->equilibrium_modulus, &d->parallel_viscosity, NULL, NULL, NULL);
    rst_print(d->version, sizeof d->version, "%s", restitute_version());
}

/* Slopes by s of a column, of e_z and of g and its slopes by psi, which the nodes have. */
static void slopes_by_speed(const struct rst_builder *b, int64_t i, int64_t places, const struct arrays *a)
{
    struct rst_stencil s;
    rst_column_stencil(b, i, &s);
    a->ez[2 * i + 1] = 0;
    for (int k = 0; k < s.n; k++)
        a->ez[2 * i + 1] += s.w[k] * b->column[s.first + k].normal.ez;
    for (int64_t j = 0; j < places; j++) {
        double *node = a->ex + 4 * (i * places + j);
        node[1] = node[3] = 0;
        for (int k = 0; k < s.n; k++) {
            const double *other = a->ex + 4 * ((s.first + k) * places + j);
            node[1] += s.w[k] * other[0];
            node[3] += s.w[k] * other[2];
        }
    }
}

/* g and its slope by psi, of a panel. */
static void slopes_by_psi(const double *g, int64_t cells, double *node)
{
    for (int64_t j = 0; j <= cells; j++) {
        node[4 * j] = g[j];
        node[4 * j + 2] = rst_even_slope(g, cells, j);
    }
}

static void fill(const struct rst_builder *b, int64_t places, const struct arrays *a)
{
    restitute_material_series(b->contact.scene.material, NULL, NULL, a->relaxation_time, a->modulus, NULL);
    for (int64_t i = 0; i < b->columns; i++) {
        const struct rst_column *c = &b->column[i];
        a->speed[i] = c->speed;
        a->ez[2 * i] = c->normal.ez;
        memcpy(a->strain + 4 * i, c->normal.strain, sizeof c->normal.strain);
        slopes_by_psi(c->g[0], b->cells[0], a->ex + 4 * i * places);
        slopes_by_psi(c->g[1], b->cells[1], a->ex + 4 * (i * places + b->cells[0] + 1));
    }
    for (int64_t i = 0; i < b->columns; i++)
        slopes_by_speed(b, i, places, a);
}

int rst_make_table(const struct rst_builder *b, restitute_table **table, restitute_error *error)
{
    restitute_table_data d;
    struct arrays a;
    describe(b, &d);
    if (allocate(&d, &a)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    fill(b, rst_places(&d), &a);
    const int status = restitute_table_create(&d, table, error);
    free(a.block);
    return status;
}
