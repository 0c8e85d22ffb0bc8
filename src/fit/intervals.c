/* How well the data determine the constants: noise, singular values, covariance; and the weights of
 * robust losses.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

#include "fit/least.h"
#include "fit/search.h"

/* No drop test measures e to better than PRACTICAL. A constant that would need this counts as not
 * determined. The impacts are solved to SOLVED. */
static const double PRACTICAL = 1e-3, SOLVED = 1e-6;

/* A direction along which the constants may change by a factor of 10 within one standard deviation
 * is not determined. */
static const double LOOSE = 2.302585;

/* Tuned for 95 % efficiency on Gaussian noise, as is usual. */
static const double HUBER = 1.345, CAUCHY = 2.385;

/* A change of e by 1 in units of the residuals: mean over the rows. */
static double unit(const struct rst_fit_data *d)
{
    double sum = 0;
    for (size_t i = 0; i < d->rows; i++) {
        const double sigma = d->row[i].sigma / (d->row[i].kind == RST_FIT_TIME ? d->row[i].measured : 1);
        sum += sigma * sigma;
    }
    return sqrt((double)d->rows / sum);
}

/* Median of |r| over 0.6745, a scale that does not depend on outliers. */
static double robust_scale(const struct rst_fit_data *d, const double *r, size_t free_constants, double *sorted)
{
    for (size_t i = 0; i < d->rows; i++)
        sorted[i] = fabs(r[i]);
    gsl_sort(sorted, 1, d->rows);
    const double spread = gsl_stats_median_from_sorted_data(sorted, 1, d->rows) / 0.6745;
    const double dof = (double)d->rows / fmax(1, (double)d->rows - (double)free_constants);
    return fmax(spread * sqrt(dof), SOLVED * unit(d));
}

/* Weight psi(u)/u, psi(u) and psi'(u) of the loss. */
static double weigh(int loss, double u, double *psi, double *slope)
{
    const double c = u / CAUCHY;
    double w = 1;
    *slope = 1;
    if (loss == RESTITUTE_FIT_LOSS_HUBER && fabs(u) > HUBER)
        w = HUBER / fabs(u), *slope = 0;
    else if (loss == RESTITUTE_FIT_LOSS_CAUCHY)
        w = 1 / (1 + c * c), *slope = (1 - c * c) * w * w;
    *psi = w * u;
    return w;
}

int rst_fit_reweigh(struct rst_fit_search *s, double *weight, double *change)
{
    const size_t rows = s->data->rows;
    double *sorted = malloc(rows * sizeof *sorted), psi, slope;
    const int status = sorted ? rst_fit_linearise(s, NULL) : RESTITUTE_ERROR_MEMORY;
    *change = 0;
    if (status >= 0) {
        const double scale = s->data->options.noise_known ? 1 : robust_scale(s->data, s->r, s->model.free, sorted);
        for (size_t i = 0; i < rows; i++) {
            const double w = fmax(1e-6, weigh(s->data->options.loss, s->r[i] / scale, &psi, &slope));
            *change = fmax(*change, fabs(w - weight[i]));
            weight[i] = w;
        }
    }
    free(sorted);
    return status;
}

/* Variance of a residual. With a robust loss that of Huber's M-estimate: scale^2 sum psi^2/dof over
 * mean(psi')^2. */
static void find_noise(const struct rst_fit_search *s, struct rst_fit_intervals *c, double *sorted)
{
    const struct rst_fit_data *d = s->data;
    double sum = 0, slopes = 0, psi, slope;
    const double scale = d->options.loss ? robust_scale(d, s->r, s->model.free, sorted) : 1;
    for (size_t i = 0; i < d->rows; i++) {
        weigh(d->options.loss, s->r[i] / scale, &psi, &slope);
        sum += psi * psi, slopes += slope / (double)d->rows;
    }
    c->dof = d->rows > c->rank ? d->rows - c->rank : 0;
    const double found = scale * sqrt(sum / (double)c->dof) / fmax(slopes, 0.1);
    c->noise = d->options.noise_known ? 1 : c->dof ? fmax(found, SOLVED * unit(d)) : NAN;
    c->judged = fmax(isnan(c->noise) ? 0 : c->noise, PRACTICAL * unit(d));
}

/* Directions beyond the first `rank` are not determined, nor is a constant that has a part in
 * them. */
static void set_variance(const struct rst_fit_search *s, struct rst_fit_intervals *c)
{
    const size_t p = s->model.free;
    for (size_t i = 0; i < p; i++) {
        double loose = 0;
        for (size_t k = c->rank; k < p; k++)
            loose += pow(c->vector[k * p + i], 2);
        c->determined[i] = loose < 1e-3 && !isnan(c->noise);
        for (size_t j = 0; j < p; j++) {
            c->variance[i * p + j] = 0;
            for (size_t k = 0; k < c->rank; k++)
                c->variance[i * p + j] += c->vector[k * p + i] * c->vector[k * p + j] * pow(c->noise / c->values[k], 2);
        }
    }
}

/* Another fit that is equally good is separate if a constant differs by more than three standard
 * deviations. Then constants that differ by more than one are not determined. */
static void look_at_other(const struct rst_fit_search *s, struct rst_fit_intervals *c)
{
    const size_t p = s->model.free;
    double most = 0, away[RESTITUTE_FIT_CONSTANTS];
    for (size_t i = 0; i < p && s->other_sum < INFINITY; i++) {
        away[i] = c->determined[i] ? fabs(s->other[i] - s->logs[i]) / sqrt(c->variance[i * p + i]) : 0;
        most = fmax(most, away[i]);
    }
    for (size_t i = 0; i < p && most > 3; i++) {
        c->otherwise[i] = away[i] > 1;
        if (c->otherwise[i]) c->determined[i] = 0;
    }
}

int rst_fit_intervals(struct rst_fit_search *s, struct rst_fit_intervals *c)
{
    const size_t rows = s->data->rows, p = s->model.free;
    double *j = malloc((rows * p + rows) * sizeof *j), *sorted = j + rows * p;
    *c = (struct rst_fit_intervals){.rank = p};
    int status = j ? rst_fit_linearise(s, j) : RESTITUTE_ERROR_MEMORY;
    if (status >= 0 && p) status = rst_fit_singular(rows, p, j, c->values, c->vector);
    if (status >= 0) {
        find_noise(s, c, sorted);
        c->rank = 0;
        while (c->rank < p && c->judged < LOOSE * c->values[c->rank])
            c->rank++;
        find_noise(s, c, sorted); /* with the degrees of freedom of that rank */
        set_variance(s, c);
        look_at_other(s, c);
    }
    free(j);
    return status;
}
