/* A user's program that reads the table named by its argument. Exit status 0 if it holds a pair for
 * 1 m/s.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdio.h>

#include <restitute/table_files.h>

int main(int argc, char **argv)
{
    restitute_table *table = NULL;
    double ez, ex;
    restitute_error error;
    if (argc != 2 || restitute_table_read(argv[1], &table, &error) != RESTITUTE_OK) {
        fprintf(stderr, "%s\n", argc == 2 ? error.message : "usage: consumer_table_files TABLE");
        return 1;
    }
    const int status = restitute_table_pair(table, NULL, 1, 0.5, &ez, &ex, &error);
    restitute_table_destroy(table);
    return status != RESTITUTE_OK;
}
