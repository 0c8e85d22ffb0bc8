/* Growing, never shrinking workspace.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/workspace.h"

#include <stdlib.h>

int rst_make_room(double **room, size_t *size, size_t count)
{
    if (count <= *size) return 0;
    if (count > SIZE_MAX / sizeof(double)) return 1;
    double *larger = malloc(count * sizeof(double));
    if (!larger) return 1;
    free(*room);
    *room = larger;
    *size = count;
    return 0;
}

int rst_workspace_terms(struct rst_workspace *workspace, size_t n_terms)
{
    return rst_make_room(&workspace->terms, &workspace->terms_size, rst_term_arrays * (n_terms > 0 ? n_terms : 1));
}

int rst_workspace_elements(struct rst_workspace *workspace, size_t count)
{
    return rst_make_room(&workspace->elements, &workspace->elements_size, count);
}

void rst_workspace_free(struct rst_workspace *workspace)
{
    free(workspace->terms);
    free(workspace->elements);
    if (workspace->own) workspace->own->release(workspace->own);
    *workspace = (struct rst_workspace){0};
}
