/* Impacts of one contact at one speed: a column of a table. The only interface between builder and
 * solver.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_COLUMN_H
#define RST_TABLE_COLUMN_H

#include "table/form.h"

/* What is built for: the scene at 1 m/s, with a friction of its own if it slides. */
struct rst_contact {
    restitute_scene scene;
    restitute_numbers numbers; /* of the scene, sliding at 1 m/s with friction 1 */
    double friction;           /* 0: none; infinity: no slip, at any speed */
    int timeless;              /* a spring or a dashpot alone: e_z does not change with speed */
};

/* Check a scene and copy the needed values. The caller keeps the material. */
int rst_contact_set(const restitute_scene *scene, struct rst_contact *contact, restitute_error *error);

/* Whether e_x changes with psi: neither without friction nor without slip. */
static inline int rst_has_psi(const struct rst_contact *contact)
{
    return contact->friction > 0 && isfinite(contact->friction);
}

/* psi v_n/|v_t| (22). */
double rst_psi_factor(const struct rst_contact *contact);

/* One of these belongs to a thread at a time. */
struct rst_column_solver {
    const struct rst_contact *contact;
    const restitute_table_options *build;
    restitute_options options;
    restitute_plan *plan; /* of the column; NULL: none yet */
    double speed;         /* of the column, m/s */
};

/* Its plan is to be destroyed. */
void rst_column_solver_init(const struct rst_contact *contact, const restitute_table_options *build, double tolerance,
                            struct rst_column_solver *s);

/* Values that do not depend on psi. */
struct rst_column_normal {
    double ez, error;
    double strain[4]; /* v_z/c_s, a_max/R, d_max/a_max, contact time in s */
    int sunk;
};

/* Whether e_x is 0 up to psi_c. What sinks with chi < 1/2 slides on: friction cannot stop it. */
static inline int rst_column_rests(const struct rst_contact *contact, const struct rst_column_normal *normal)
{
    return normal->sunk && contact->numbers.chi >= 0.5;
}

/* The solver may fail where a sphere hardly rebounds. */
static inline int rst_column_is_too_hard(int status)
{
    return status == RESTITUTE_ERROR_TOO_MUCH_WORK || status == RESTITUTE_ERROR_CONVERGENCE;
}

/* These return a status < 0 with its message, else OK. */

/* Begin the column at a speed, in m/s, unless the build is interrupted. */
int rst_column_begin(struct rst_column_solver *s, double speed, restitute_error *error);

/* Solve psi = 0 of the column that was begun. */
int rst_column_normal(struct rst_column_solver *s, struct rst_column_normal *normal, restitute_error *error);

/* Solve one place of psi: e_x and its estimated error. */
int rst_column_solve(struct rst_column_solver *s, double psi, double *ex, double *error_ex, restitute_error *error);

#endif
