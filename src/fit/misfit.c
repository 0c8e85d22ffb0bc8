/* Whether residuals look like noise: their order, and their size.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

#include "fit/search.h"

/* Probability below which a model is rejected, and sizes of residuals that are suspect in any
 * order. These sizes are chosen, not derived: noise of 5 % must pass, and searches that ended at a
 * wrong minimum had left 6 to 18 %. */
static const double WRONG_BELOW = 0.01, LARGE_E = 0.07, LARGE_TIME = 0.1;

/* The same for the order of residuals. An arch of 8 values, of a standard solid fitted to a broad
 * spectrum, has a chance of 1.1 to 1.5 %. */
static const double PATTERNED_BELOW = 0.02;

/* A pattern below the measurable size is ignored: it comes from the error of the solver. */
static const double PRACTICAL = 1e-3;

/* A residual and its sort keys; the last key is the row. With fewer than LEAST residuals no order
 * is improbable enough. */
enum { KEYS = 5, LEAST = 6 };
struct place {
    double key[KEYS], residual;
};

static int compare(const void *a, const void *b)
{
    const struct place *x = a, *y = b;
    for (int k = 0; k < KEYS; k++)
        if (x->key[k] != y->key[k]) return x->key[k] > y->key[k] ? 1 : -1;
    return 0;
}

/* Bartels (J. Am. Stat. Assoc. 77, 1982, 40): probability that neighbours in random order have so
 * similar ranks. The sum of squared differences is beta distributed, nearly: below 2 % it falls in
 * 1.5 to 2.5 % of all orders of 6 to 9 values, counted. Overwrites the places. */
static double chance_of_order(struct place *places, size_t count)
{
    const double n = (double)count;
    double sum = 0;
    if (count < LEAST) return 1;
    for (size_t i = 0; i < count; i++)
        places[i] = (struct place){{places[i].residual, (double)i}, 0};
    qsort(places, count, sizeof *places, compare);
    for (size_t rank = 0; rank < count; rank++)
        places[(size_t)places[rank].key[1]].residual = (double)rank;
    for (size_t i = 1; i < count; i++)
        sum += pow(places[i].residual - places[i - 1].residual, 2);
    const double shape = 5 * n * (n + 1) * (n - 1) * (n - 1) / (2 * (n - 2) * (5 * n * n - 2 * n - 9)) - 0.5;
    return gsl_cdf_beta_P(3 * sum / (n * (n * n - 1)), shape, shape);
}

/* Rows of ez by speed, of all temperatures; or all rows by kind, solid, angle and T. */
static size_t arrange(const struct rst_fit_search *s, int apart, struct place *places)
{
    const struct rst_fit_data *d = s->data;
    size_t n = 0;
    for (size_t i = 0; i < d->rows; i++) {
        const struct rst_fit_row *row = &d->row[i];
        const restitute_scene *scene = &d->scene[row->point];
        if (rst_fit_passed_over(d, d->place[row->point].first) || (!apart && row->kind != RST_FIT_EZ)) continue;
        places[n++] = apart ? (struct place){{row->kind, (double)d->group[row->point],
                                              fabs(scene->tangential_speed) / scene->normal_speed,
                                              -d->place[row->point].time, (double)i},
                                             s->r[i]}
                            : (struct place){{scene->normal_speed, (double)i}, s->r[i]};
    }
    qsort(places, n, sizeof *places, compare);
    return n;
}

/* Standard deviation of e, or of relative contact times, from the residuals; 0: no degree of
 * freedom is left. */
static double noise_of(const struct rst_fit_search *s, int time)
{
    const struct rst_fit_data *d = s->data;
    double sum = 0, weights = 0, rows = 0, n = 0;
    for (size_t i = 0; i < d->rows; i++) {
        if (rst_fit_passed_over(d, d->place[d->row[i].point].first)) continue;
        rows++;
        if ((d->row[i].kind == RST_FIT_TIME) != time) continue;
        const double w = s->weight ? s->weight[i] : 1, unit = time ? d->row[i].measured : 1;
        sum += w * s->r[i] * s->r[i], weights += w * pow(unit / d->row[i].sigma, 2), n++;
    }
    const double dof = rows - (double)s->model.free;
    return n > 0 && dof > 0 ? sqrt(sum / weights * rows / dof) : 0;
}

int rst_fit_misfit(const struct rst_fit_search *s, size_t dof, struct rst_fit_misfit *m)
{
    const struct rst_fit_data *d = s->data;
    struct place *places = malloc(d->rows * sizeof *places);
    double squares = 0, chance[2];
    if (!places) return RESTITUTE_ERROR_MEMORY;
    for (int apart = 0; apart < 2; apart++)
        chance[apart] = chance_of_order(places, arrange(s, apart, places));
    free(places);
    for (size_t i = 0; i < d->rows; i++)
        squares += (s->weight ? s->weight[i] : 1) * s->r[i] * s->r[i];
    m->noise_e = noise_of(s, 0);
    m->noise_time = noise_of(s, 1);
    m->chance = chance[0] == chance[1] ? chance[0] : fmin(1, 2 * fmin(chance[0], chance[1])); /* two tests */
    m->patterned = m->chance < PATTERNED_BELOW && fmax(m->noise_e, m->noise_time) > PRACTICAL;
    m->large = !d->options.noise_known && (m->noise_e > LARGE_E || m->noise_time > LARGE_TIME);
    m->surpassed = d->options.noise_known && dof && gsl_cdf_chisq_Q(squares, (double)dof) < WRONG_BELOW;
    return RESTITUTE_OK;
}
