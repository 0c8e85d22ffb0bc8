/* Strict reading of one number, independent of the program's locale.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_NUMBER_H
#define RST_NUMBER_H

#include <restitute/status.h>

/* Decimal digits with an optional sign, point and exponent, or inf; the whole text, no spaces.
 *
 * returns  ERROR_FORMAT for anything else ("1.0x", "", "nan", "0x10"); ERROR_DOMAIN for one too
 *          large for a double or too small to differ from 0; ERROR_MEMORY */
int rst_number_read(const char *text, double *value);

#endif
