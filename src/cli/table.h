/* restitute table: build a table of restitution pairs into a file, tell about it, look up in it, export it.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_TABLE_H
#define CLI_TABLE_H

#include "message.h"

/* Read the options behind `restitute table` and run. Returns the exit status. */
int table_main(int count, char **arguments);

#endif
