/* Inside of a material.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_MATERIAL_H
#define RST_MATERIAL_H

#include <restitute/restitute.h>

struct restitute_material {
    double g_inf, eta; /* Pa, Pa s */
    double nu;
    double beta; /* Dundurs' constant of a pair of unlike materials; 0 for a material by itself */
    int is_effective; /* the solid of two bodies, made by restitute_material_effective */
    double window[2]; /* s: times in which it was measured */
    size_t n_terms;
    double *tau, *g; /* s, Pa; sorted by tau */
    double values[]; /* behind tau and g */
};

#endif
