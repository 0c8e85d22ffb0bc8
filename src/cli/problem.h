/* From what the user gave, by options or in a row, to the impact that the library solves.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef CLI_PROBLEM_H
#define CLI_PROBLEM_H

#include <restitute/restitute.h>

#include "fields.h"
#include "materials.h"

/* What was given; the rest is left to the defaults. */
struct values {
    bool given[FIELD_COUNT];
    double number[FIELD_COUNT];
    const char *material; /* path; NULL: not given */
    int deformable;       /* a restitute_deformable; 0: not given */
    const char *partner;  /* path of the partner's own material; NULL: it has none */
    int rotation_blocked; /* 0 or 1; -1: not given */
};

/* Nothing given. */
struct values values_none(void);

/* The texts of options, one a field, NULL: not given. */
bool values_read(char *const texts[FIELD_COUNT], struct values *values, struct reason *why);

/* A cell of a column of a scene; an empty one counts as not given where that makes sense. */
bool values_take(const char *column, const char *cell, struct values *values, struct reason *why);

/* How the user calls things in this place, for messages. */
enum naming { NAME_OPTIONS, NAME_COLUMNS };

/* An impact ready to be solved: dimensionless, or in SI units. */
struct problem {
    bool physical;
    restitute_impact impact;
    restitute_scene scene;
    const restitute_material_info *info; /* of the material; NULL if dimensionless */
};

/* True if any value in SI units is given (or the material, partner or blocked rotation); likewise dimensionless. */
bool values_physical(const struct values *values);
bool values_dimensionless(const struct values *values);

/* Refuse what does not fit together or is missing, without a look at the numbers. */
bool values_check(const struct values *values, enum naming naming, struct reason *why);

/* Build the impact from checked values. */
bool problem_build(const struct values *values, enum naming naming, struct materials *materials,
                   struct problem *problem, struct reason *why);

/* Solve it. Returns the library's status; `error` tells what went wrong. ledger and history may be NULL. */
int problem_solve(restitute_solver *solver, const struct problem *problem, restitute_result *result,
                  restitute_ledger *ledger, restitute_history *history, restitute_error *error);

/* The word that partner_read would read. */
const char *partner_word(const struct values *values);

/* A partner: rigid, same, or the file of its own material. A rotation_blocked cell. False for anything else. */
bool partner_read(const char *text, const char *place, struct values *values, struct reason *why);
bool switch_read(const char *text, const char *place, int *on, struct reason *why);

#endif
