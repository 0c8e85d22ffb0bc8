/* Structs of the library with their defaults.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_PREPARED_H
#define TEST_PREPARED_H

/* Declares `variable`, a restitute_NAME with its defaults. */
#define PREPARED(NAME, variable)                                                                                       \
    restitute_##NAME variable;                                                                                         \
    restitute_##NAME##_init(&variable)

#endif
