/* Memory that is kept between calls, so that plans are made once.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/memory.h"

#include <stdlib.h>
#include <string.h>

static void release(struct rst_own_memory *own)
{
    struct bem_memory *memory = (struct bem_memory *)own;
    for (int i = 0; i < BEM_SIZES; i++)
        rst_bem_transform_destroy(memory->transforms[i]);
    fftw_free(memory->block);
    free(memory->terms);
    free(memory);
}

struct bem_memory *rst_bem_memory_of(struct rst_workspace *workspace)
{
    return rst_own_memory_of(workspace, sizeof(struct bem_memory), release);
}

int rst_bem_memory_fields(struct bem_memory *memory, int64_t m, int64_t n_terms, struct bem_fields *fields)
{
    double **single[] = {&fields->p,       &fields->p_before, &fields->p_new,  &fields->tau,        &fields->tau_before,
                         &fields->tau_new, &fields->f_z,      &fields->f_x,    &fields->f_new,      &fields->drift_z,
                         &fields->drift_x, &fields->h,        &fields->target, &fields->low,        &fields->high,
                         &fields->gap,     &fields->s,        &fields->anchor, &fields->gap_before, &fields->s_before,
                         &fields->free,    &fields->r,        &fields->z,      &fields->d,          &fields->kd,
                         &fields->touched};
    const size_t count = sizeof single / sizeof *single, cells = (size_t)(m * m);
    const size_t wanted = cells * (count + 2 * (size_t)n_terms);
    if (wanted > memory->block_size) {
        double *block = fftw_alloc_real(wanted);
        if (!block) return 1;
        fftw_free(memory->block);
        memory->block = block;
        memory->block_size = wanted;
    }
    memset(memory->block, 0, wanted * sizeof *memory->block);
    for (size_t i = 0; i < count; i++)
        *single[i] = memory->block + i * cells;
    fields->m = m;
    fields->n_terms = n_terms;
    fields->b_z = memory->block + count * cells;
    fields->b_x = fields->b_z + cells * (size_t)n_terms;
    return 0;
}

struct bem_transform *rst_bem_memory_transform(struct bem_memory *memory, int64_t m)
{
    int i = 0;
    while (i < BEM_SIZES && memory->transforms[i] && memory->transforms[i]->m != m)
        i++;
    if (i == BEM_SIZES) rst_bem_transform_destroy(memory->transforms[--i]), memory->transforms[i] = NULL;
    if (!memory->transforms[i]) memory->transforms[i] = rst_bem_transform_create(m);
    return memory->transforms[i];
}

double *rst_bem_memory_terms(struct bem_memory *memory, size_t count)
{
    if (count > memory->terms_size) {
        double *terms = malloc(count * sizeof *terms);
        if (!terms) return NULL;
        free(memory->terms);
        memory->terms = terms;
        memory->terms_size = count;
    }
    return memory->terms;
}
