/* Growing, never shrinking workspace.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/workspace.h"

#include <stdlib.h>

static int grow(double **block, size_t *size, size_t wanted)
{
    if (wanted <= *size) return 0;
    if (wanted > SIZE_MAX / sizeof(double)) return 1;
    double *larger = malloc(wanted * sizeof(double));
    if (!larger) return 1;
    free(*block);
    *block = larger;
    *size = wanted;
    return 0;
}

int rst_workspace_terms(struct rst_workspace *workspace, size_t n_terms)
{
    return grow(&workspace->terms, &workspace->terms_size, rst_term_arrays * (n_terms > 0 ? n_terms : 1));
}

int rst_workspace_elements(struct rst_workspace *workspace, size_t count)
{
    return grow(&workspace->elements, &workspace->elements_size, count);
}

void rst_workspace_free(struct rst_workspace *workspace)
{
    free(workspace->terms);
    free(workspace->elements);
    if (workspace->own) workspace->own->release(workspace->own);
    *workspace = (struct rst_workspace){0};
}
