/* The numbers that describe an impact: one table for the options, the columns of a case file, their units and ranges.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_FIELDS_H
#define CLI_FIELDS_H

#include "message.h"

enum field {
    FIELD_CHI,
    FIELD_PSI,
    FIELD_DELTA1,
    FIELD_GAMMA,
    FIELD_DELTA2,
    FIELD_RADIUS1,
    FIELD_DENSITY1,
    FIELD_MASS1,
    FIELD_INERTIA1,
    FIELD_RADIUS2,
    FIELD_DENSITY2,
    FIELD_MASS2,
    FIELD_INERTIA2,
    FIELD_SPEED,
    FIELD_ANGLE,
    FIELD_SPIN1,
    FIELD_SPIN2,
    FIELD_FRICTION,
    FIELD_MODULUS1,
    FIELD_MODULUS2,
    FIELD_VISCOSITY,
    FIELD_POISSON,
    FIELD_TIME_SHIFT,
    FIELD_COUNT
};

/* All up to this one are dimensionless, the others in SI units. */
#define FIELD_LAST_DIMENSIONLESS FIELD_DELTA2

struct field_rule {
    const char *option, *alias; /* without the two dashes; alias may be NULL */
    const char *column;
    const char *unit;
    double low, high;
    bool low_allowed, high_allowed;
    bool may_be_empty; /* an empty cell means: not given */
    const char *range; /* the same in words */
    const char *help;
};

extern const struct field_rule field_rules[FIELD_COUNT];

/* Read the text of a field, strictly, and check its range. `place` is how the user calls it: "--psi" or "psi". */
bool field_read(enum field field, const char *text, const char *place, double *value, struct reason *why);

/* The field of this column name, FIELD_COUNT if there is none. */
enum field field_of_column(const char *column);

#endif
