/* What a table says of itself.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "family.h"

void restitute_table_info_init(restitute_table_info *info)
{
    if (!info) return;
    *info = (restitute_table_info){.struct_size = sizeof *info};
}

static void copy_range(double to[2], const double from[2])
{
    to[0] = from[0];
    to[1] = from[1];
}

static void describe_contact(const restitute_table *t, restitute_table_info *i)
{
    copy_range(i->speed, t->asked[0]);
    for (int end = 0; end < 2; end++) {
        i->delta1[end] = t->own.delta1 * pow(t->asked[0][end], 0.2);
        i->gamma[end] = t->own.gamma;
    }
}

/* Of what a tree takes. */
static size_t bytes_of(const struct rst_tree *t)
{
    if (!t->room) return 0;
    const size_t starts = (size_t)((t->of.octaves * t->of.roots * t->of.sheets) << t->part_bits);
    return (size_t)t->leaves * (sizeof *t->leaf + sizeof *t->shape) + (size_t)t->fans * sizeof *t->fan +
           starts * sizeof *t->start;
}

int restitute_table_describe(const restitute_table *table, restitute_table_info *info, restitute_error *error)
{
    if (!table || !info) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", table ? "info" : "table");
    if (info->struct_size != sizeof *info)
        return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                          "restitute_table_info.struct_size = %zu: must be %zu; prepare the struct with "
                          "restitute_table_info_init of this version",
                          info->struct_size, sizeof *info);
    *info = (restitute_table_info){.struct_size = sizeof *info,
                                   .of_contact = table->of_contact,
                                   .speed = {NAN, NAN},
                                   .friction = table->friction,
                                   .radius = table->radius,
                                   .mass = table->mass,
                                   .tolerance = table->tolerance,
                                   .error_ez = table->error_ez,
                                   .error_ex = table->error_ex,
                                   .impacts = table->impacts,
                                   .checks = table->checks,
                                   .nodes = {table->n_speed, table->n_gamma, table->n_chi, table->n_psi},
                                   .bytes = sizeof *table + table->block_size * sizeof(double) +
                                            bytes_of(&table->rebound) + bytes_of(&table->tangent)};
    memcpy(info->version, table->version, sizeof info->version);
    copy_range(info->chi, table->asked[2]);
    if (table->of_contact)
        describe_contact(table, info);
    else {
        copy_range(info->delta1, table->asked[0]);
        copy_range(info->gamma, table->asked[1]);
    }
    return rst_done(error);
}
