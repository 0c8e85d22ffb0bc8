/* Memory that a solver keeps between calls, so that frequent calls do not allocate.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_WORKSPACE_H
#define RST_WORKSPACE_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* First member of what a method of another component keeps in the workspace. */
struct rst_own_memory {
    void (*release)(struct rst_own_memory *memory);
};

struct rst_workspace {
    double *terms; /* rst_term_arrays times n_terms values: g, tau, decay, gain, stress */
    size_t terms_size;
    double *elements; /* what the method lays out in it */
    size_t elements_size;
    struct rst_own_memory *own; /* of the solver's method; NULL: none */
    int keeps_motion;           /* whether the normal motion is kept for later impacts on the same solid */
};

/* What the method keeps in the workspace: `size` bytes, zeros at first. NULL: out of memory. */
static inline void *rst_own_memory_of(struct rst_workspace *workspace, size_t size,
                                      void (*release)(struct rst_own_memory *memory))
{
    if (!workspace->own) workspace->own = calloc(1, size);
    if (workspace->own) workspace->own->release = release;
    return workspace->own;
}

/* Room for `count` doubles. If it grows, the old contents are lost. Nonzero: out of memory, and
 * nothing has changed. */
int rst_make_room(double **room, size_t *size, size_t count);

/* Room for the arrays of n_terms terms (at least 1). Nonzero: out of memory, the old contents are
 * kept. */
int rst_workspace_terms(struct rst_workspace *workspace, size_t n_terms);

/* Room for `count` doubles of element data. Nonzero: out of memory, the old contents are kept. */
int rst_workspace_elements(struct rst_workspace *workspace, size_t count);

void rst_workspace_free(struct rst_workspace *workspace);

enum { rst_term_arrays = 5 };

#endif
