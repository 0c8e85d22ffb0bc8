/* Strict reading of one number, independent of the program's locale.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "files/number.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* strtod also takes blanks before it, hexadecimal and "nan(...)": none belongs in a table. */
static int only_number_characters(const char *text)
{
    const char *digits = text + (*text == '+' || *text == '-');
    if (strcasecmp(digits, "inf") == 0) return 1;
    return *text != '\0' && strspn(text, "0123456789+-.eE") == strlen(text);
}

int rst_number_read(const char *text, double *value)
{
    if (!only_number_characters(text)) return RESTITUTE_ERROR_FORMAT;
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (plain == (locale_t)0) return RESTITUTE_ERROR_MEMORY;
    const locale_t before = uselocale(plain);
    char *end;
    errno = 0;
    const double number = strtod(text, &end);
    const int range = errno == ERANGE;
    uselocale(before);
    freelocale(plain);
    if (end == text || *end != '\0') return RESTITUTE_ERROR_FORMAT;
    if (range && (isinf(number) || number == 0.0)) /* a subnormal also gives ERANGE, but it is a number */
        return RESTITUTE_ERROR_DOMAIN;
    *value = number;
    return RESTITUTE_OK;
}
