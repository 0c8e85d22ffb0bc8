/* A Prony series during its fit, and the moduli to which it is fitted.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_FIT_DMA_H
#define RST_FIT_DMA_H

#include "fit/model.h"

/* Logarithms are natural. Residuals are relative, over the noise: storage of all rows, then
 * loss. */
struct rst_dma {
    size_t n;
    const double *omega;
    double *storage, *loss; /* shear moduli */
    size_t *group;          /* temperature of a row */
    double *r; /* residuals, the latest */
    double noise;
    struct rst_temperatures temperature;
    int free_shifts;
    double shift[RESTITUTE_DMA_SHIFTS]; /* log a_T */
    size_t terms;
    double g[RESTITUTE_DMA_TERMS], tau[RESTITUTE_DMA_TERMS], equilibrium; /* logarithms; equilibrium itself, 0: none */
    double sum;                                                           /* of squared residuals */
};

/* dma_terms.c: from shifts to a first series; refine it; shorten it as far as the data allow. */
int rst_dma_begin(struct rst_dma *dma);
int rst_dma_shorten(struct rst_dma *dma);
double rst_dma_sum(const struct rst_dma *dma); /* of squared residuals */

#endif
