/* Whether residuals look like noise: the test of runs, and their size.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>

#include "search.h"

/* Chance below which a model is called wrong, and residuals that are suspect whatever their order. The latter are chosen, not
 * derived: noise of 5 % is to pass, while searches that ended in a wrong place had left 6 to 18 %. */
static const double WRONG_BELOW = 0.01, LARGE_E = 0.07, LARGE_TIME = 0.1;

/* A pattern below what can be measured is none: it is that of the solver's error. */
static const double PRACTICAL = 1e-3;

/* A residual and where it stands in the order: by the first key that differs. The last one is the row. */
enum { KEYS = 5 };
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

/* Wald and Wolfowitz: chance that signs in random order have so few runs. */
static double chance_of_runs(const struct place *places, size_t n)
{
    double up = 0, down = 0, runs = 1;
    for (size_t i = 0; i < n; i++) {
        if (places[i].residual > 0)
            up++;
        else
            down++;
        if (i && (places[i].residual > 0) != (places[i - 1].residual > 0)) runs++;
    }
    if (up < 3 || down < 3) return 1;
    const double mean = 2 * up * down / (up + down) + 1;
    return gsl_cdf_ugaussian_P((runs + 0.5 - mean) / sqrt((mean - 1) * (mean - 2) / (up + down - 1)));
}

/* Rows of ez by speed, of all temperatures; or all rows by kind, solid, angle and T. */
static size_t arrange(const struct rst_fit_search *s, int apart, struct place *places)
{
    const struct rst_fit_data *d = s->data;
    size_t n = 0;
    for (size_t i = 0; i < d->rows; i++) {
        const struct rst_fit_row *row = &d->row[i];
        const restitute_scene *scene = &d->points[row->point].scene;
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

/* Standard deviation of e, or of relative contact times, that the residuals show; 0: nothing is left to estimate it. */
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
        chance[apart] = chance_of_runs(places, arrange(s, apart, places));
    free(places);
    for (size_t i = 0; i < d->rows; i++)
        squares += (s->weight ? s->weight[i] : 1) * s->r[i] * s->r[i];
    m->noise_e = noise_of(s, 0);
    m->noise_time = noise_of(s, 1);
    m->chance = chance[0] == chance[1] ? chance[0] : fmin(1, 2 * fmin(chance[0], chance[1])); /* two tests */
    m->patterned = m->chance < WRONG_BELOW && fmax(m->noise_e, m->noise_time) > PRACTICAL;
    m->large = !d->options.noise_known && (m->noise_e > LARGE_E || m->noise_time > LARGE_TIME);
    m->surpassed = d->options.noise_known && dof && gsl_cdf_chisq_Q(squares, (double)dof) < WRONG_BELOW;
    return RESTITUTE_OK;
}
