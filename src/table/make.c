/* A table from columns: values, and slopes by seven neighbours.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table/builder.h"

#include <stdlib.h>

/* One block for the arrays that the numbers of a table point to; NULL: out of memory. */
static double *allocate(struct rst_table_data *d)
{
    const int64_t size[] = {d->speeds, 2 * d->speeds, 3 * d->speeds, 4 * d->speeds * rst_places(d), d->terms, d->terms};
    double **const array[] = {&d->speed, &d->ez, &d->strain, &d->ex, &d->relaxation_time, &d->modulus};
    int64_t all = 0;
    for (int i = 0; i < 6; i++)
        all += size[i];
    double *const block = malloc((size_t)all * sizeof *block), *next = block;
    for (int i = 0; i < 6 && block; next += size[i++])
        *array[i] = next;
    return block;
}

static void describe(const struct rst_builder *b, struct rst_table_data *d)
{
    const struct rst_contact *c = &b->contact;
    const restitute_material *m = c->scene.material;
    *d = (struct rst_table_data){.low = b->options.speed[0],
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
                                 .poisson_ratio = restitute_material_poisson_ratio(m),
                                 .speed_limit = b->options.speed_limit,
                                 .radius_limit = b->options.radius_limit,
                                 .displacement_limit = b->options.displacement_limit,
                                 .terms = (int64_t)restitute_material_terms(m),
                                 .speeds = b->columns,
                                 .stick_cells = b->cells[0],
                                 .slip_cells = b->cells[1]};
    d->psi_factor = rst_psi_factor(c);
    restitute_material_series(m, &d->equilibrium_modulus, &d->parallel_viscosity, NULL, NULL);
    snprintf(d->version, sizeof d->version, "%s", restitute_version());
}

/* Slopes by s of a column, of e_z and of g and its slopes by psi, which the nodes have. */
static void slopes_by_speed(const struct rst_builder *b, int64_t i, struct rst_table_data *d)
{
    struct rst_stencil s;
    const int64_t places = rst_places(d);
    rst_column_stencil(b, i, &s);
    d->ez[2 * i + 1] = 0;
    for (int k = 0; k < s.n; k++)
        d->ez[2 * i + 1] += s.w[k] * b->column[s.first + k].normal.ez;
    for (int64_t j = 0; j < places; j++) {
        double *node = d->ex + 4 * (i * places + j);
        node[1] = node[3] = 0;
        for (int k = 0; k < s.n; k++) {
            const double *other = d->ex + 4 * ((s.first + k) * places + j);
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

static void fill(const struct rst_builder *b, struct rst_table_data *d)
{
    const int64_t places = rst_places(d);
    restitute_material_series(b->contact.scene.material, NULL, NULL, d->relaxation_time, d->modulus);
    for (int64_t i = 0; i < b->columns; i++) {
        const struct rst_column *c = &b->column[i];
        d->speed[i] = c->speed;
        d->ez[2 * i] = c->normal.ez;
        memcpy(d->strain + 3 * i, c->normal.strain, sizeof c->normal.strain);
        slopes_by_psi(c->g[0], b->cells[0], d->ex + 4 * i * places);
        slopes_by_psi(c->g[1], b->cells[1], d->ex + 4 * (i * places + b->cells[0] + 1));
    }
    for (int64_t i = 0; i < b->columns; i++)
        slopes_by_speed(b, i, d);
}

int rst_make_table(const struct rst_builder *b, restitute_table **table, restitute_error *error)
{
    struct rst_table_data d;
    describe(b, &d);
    double *block = allocate(&d);
    if (!block) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the table");
    fill(b, &d);
    const int status = restitute_private_table_make(&d, table, error);
    free(block);
    return status;
}
