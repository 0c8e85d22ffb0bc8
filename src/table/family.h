/* A family of impacts, checked and copied: what a builder solves impacts of.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_TABLE_FAMILY_H
#define RST_TABLE_FAMILY_H

#include "../core/ranges.h"
#include "../core/report.h"
#include "table_form.h"

enum rst_sliding { RST_SLIDES, RST_NEVER_SLIPS, RST_NO_FRICTION };

struct rst_family {
    int of_contact;
    restitute_scene scene;        /* with friction 1 where it slides, and our own copy of the material */
    restitute_material *material; /* that copy; NULL for ranges */
    restitute_numbers numbers;    /* of the scene at 1 m/s, friction 1 and sliding 1 m/s */
    double friction;
    enum rst_sliding sliding;
    double range[3][2]; /* speed or delta1, gamma, chi; both alike: no axis */
    double asked[3][2]; /* as requested */
};

int rst_family_set(const restitute_table_family *given, struct rst_family *family, restitute_error *error);
void rst_family_free(struct rst_family *family);

/* What the table says of its family, all but the axes and values. */
int rst_family_describe(const struct rst_family *family, restitute_table *form);

/* One impact of the family. */
void rst_family_impact(const struct rst_family *family, double speed, double gamma, double chi, double psi,
                       restitute_impact *impact);
void rst_family_scene(const struct rst_family *family, double speed, double psi, restitute_scene *scene);

#endif
