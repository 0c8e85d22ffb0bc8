/* `restitute table`, or what is missing for it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "table.h"

#ifdef RESTITUTE_WITH_TABLE_FILES
#include "table_settings.h"

int table_main(int count, char **arguments)
{
    static int (*const actions[TABLE_ACTIONS])(const struct table_settings *) = {table_build_run, table_info_run,
                                                                                 table_query_run};
    struct table_settings settings;
    const enum reading reading = table_options_read(count, arguments, &settings);
    const int status = reading == READING_GO_ON ? actions[settings.action](&settings)
                       : reading == READING_STOP ? EXIT_DONE
                                               : EXIT_USAGE;
    table_options_release(&settings);
    return status;
}
#else
int table_main(int count, char **arguments)
{
    (void)count;
    (void)arguments;
    return complain("table: this build has no component table_files, which needs HDF5");
}
#endif
