/* What the method sync computes in every impact (fortran/sync_interfaces.f90, sync_lanes.F90), compiled for several
 * vector widths. SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_SYNC_KERNEL_H
#define RST_SYNC_KERNEL_H

#include "kernels.h"

typedef void sync_normal_levels(const struct sync_grid *grid, double g_inf, double eta, int64_t n_terms,
                                const double *g, const double *tau, int64_t n, double closeness, int64_t guessed,
                                struct sync_level *level, double *memory, double *loading, struct sync_node *node,
                                int64_t *failed);
typedef void sync_double_levels(int64_t n, struct sync_level *level);
typedef void sync_dense_levels(const struct sync_grid *grid, double g_inf, double eta, int64_t n_terms, const double *g,
                               const double *tau, int64_t n, int64_t r, const struct sync_level *coarse,
                               struct sync_level *level, struct sync_trace *trace, struct sync_node *node,
                               int64_t *failed);
typedef void sync_finish_levels(double g_inf, int64_t n_terms, int64_t n, const struct sync_trace *trace,
                                const struct sync_node *node, struct sync_level *level);
typedef void sync_follow_shear(const struct sync_scene *scene, sync_loop *elements, const double *g, const double *tau,
                               const struct sync_level *level, const struct sync_trace *trace,
                               const struct sync_node *node, double *body, double *beta, double *faded,
                               struct sync_term *term, struct sync_shear *state);

struct sync_kernel {
    const char *name;
    sync_normal_levels *normal_levels;
    sync_double_levels *double_levels;
    sync_dense_levels *dense_levels;
    sync_finish_levels *finish_levels;
    sync_follow_shear *follow_shear;
    sync_loop *elements;
};

/* The i-th variant, from narrow to wide, if this processor has it; otherwise NULL. All give the same bits. */
const struct sync_kernel *rst_sync_kernel(int i);

/* The widest that this processor has. */
const struct sync_kernel *rst_widest_sync_kernel(void);

#endif
