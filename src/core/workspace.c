/* Growing, never shrinking workspace.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "workspace.h"

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

int rst_shelf_levels(struct rst_shelf *shelf, size_t count)
{
    if (count <= shelf->levels_size) return 0;
    if (count > SIZE_MAX / sizeof(double)) return 1;
    double *larger = realloc(shelf->levels, count * sizeof(double));
    if (!larger) return 1;
    larger[0] = 0;
    shelf->levels = larger;
    shelf->levels_size = count;
    return 0;
}

int rst_shelf_dense(struct rst_shelf *shelf, size_t count)
{
    return grow(&shelf->dense, &shelf->dense_size, count);
}

void rst_workspace_free(struct rst_workspace *workspace)
{
    free(workspace->terms);
    free(workspace->elements);
    for (int i = 0; i < rst_shelves; i++) {
        free(workspace->shelves[i].levels);
        free(workspace->shelves[i].dense);
    }
    free(workspace->spare.levels);
    free(workspace->spare.dense);
    if (workspace->own) workspace->own->release(workspace->own);
    *workspace = (struct rst_workspace){0};
}
