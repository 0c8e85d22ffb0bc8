/* A user's program that builds a table in memory and looks up in it. Exit status 0 if the pair is one.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include <restitute/table.h>

int main(void)
{
    restitute_table_family family;
    restitute_table_options options;
    restitute_table *table = NULL;
    restitute_table_value pair;
    restitute_error error;
    restitute_table_family_init(&family);
    restitute_table_options_init(&options);
    family.delta1[0] = 0.1, family.delta1[1] = 0.2;
    options.tolerance = 1e-2;
    if (restitute_table_build(&family, &options, &table, &error) != RESTITUTE_OK ||
        restitute_table_numbers_pair(table, 7.0 / 6, 2, 0.15, 1, &pair) != RESTITUTE_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    printf("ez = %g, ex = %g\n", pair.ez, pair.ex);
    restitute_table_destroy(table);
    return !(pair.ez > 0 && pair.ez < 1 && pair.ex > -1 && pair.ex < 1);
}
