/* A long Prony series as a short one, for the times that a simulation can feel: least squares in the relative error of G(t) and
 * of its integral over the first step, with evenly spaced log(tau) and moduli >= 0, so that it stays a solid
 * (docs/contact.md). SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>

#include "law.h"

/* Times are sampled that often; for the bound ten times as often, since G falls between samples. */
enum { samples = 128, checks = 10 * samples, unknowns = rst_most_terms + 1, most_sweeps = 20000 };

/* How far the times reach beyond both ends of the window: the pair with the smallest bound is taken. */
static const double reaches[] = {1, 0.5, 0.25, 0.1, 0.03};
enum { reach_count = sizeof reaches / sizeof reaches[0] };

/* Relative change of all moduli in a sweep below which it ends: far below the errors that a few terms leave. */
static const double settled = 1e-9;

static double modulus(const struct rst_series *s, double t)
{
    double g = s->g_inf;
    for (size_t k = 0; k < s->n_terms; k++)
        g += s->g[k] * exp(-t / s->tau[k]);
    return g;
}

/* int_0^t G: what the first step feels. */
static double impulse(const struct rst_series *s, double t)
{
    double sum = s->g_inf * t;
    for (size_t k = 0; k < s->n_terms; k++)
        sum -= s->g[k] * s->tau[k] * expm1(-t / s->tau[k]);
    return sum;
}

static double sample_time(double shortest, double longest, int i, int n)
{
    return shortest * pow(longest / shortest, (double)i / (n - 1));
}

/* Normal equations: column n_terms is that of the equilibrium modulus. */
struct equations {
    int n;
    double matrix[unknowns][unknowns], right[unknowns];
};

static void add_row(struct equations *e, const double *row, double value)
{
    for (int i = 0; i < e->n; i++) {
        e->right[i] += row[i] * value;
        for (int j = 0; j < e->n; j++)
            e->matrix[i][j] += row[i] * row[j];
    }
}

static void set_up(const struct rst_series *s, const struct rst_law *law, double shortest, double longest,
                   struct equations *e)
{
    const int n_terms = (int)law->n_terms;
    double row[unknowns];
    *e = (struct equations){.n = n_terms + 1};
    for (int i = 0; i < samples; i++) {
        const double t = sample_time(shortest, longest, i, samples), scale = 1 / modulus(s, t);
        for (int k = 0; k < n_terms; k++)
            row[k] = scale * exp(-t / law->tau[k]);
        row[n_terms] = s->g_inf > 0 ? scale : 0; /* what flows is to flow still */
        add_row(e, row, 1);
    }
    const double scale = sqrt(samples) / impulse(s, shortest);
    for (int k = 0; k < n_terms; k++)
        row[k] = -scale * law->tau[k] * expm1(-shortest / law->tau[k]);
    row[n_terms] = s->g_inf > 0 ? scale * shortest : 0;
    add_row(e, row, sqrt(samples));
}

/* The least squares with x >= 0, one unknown after the other. */
static void solve_positive(const struct equations *e, double *x)
{
    double change = 1, size = 1;
    for (int sweep = 0; sweep < most_sweeps && change > settled * size; sweep++) {
        change = size = 0;
        for (int i = 0; i < e->n; i++) {
            double rest = e->right[i];
            for (int j = 0; j < e->n; j++)
                if (j != i) rest -= e->matrix[i][j] * x[j];
            const double next = e->matrix[i][i] > 0 ? fmax(0, rest / e->matrix[i][i]) : 0;
            change += fabs(next - x[i]);
            size += next;
            x[i] = next;
        }
    }
}

/* Largest relative error. Both moduli fall with time, so that between two times each is between its values there. */
static double bound_error(const struct rst_series *whole, const struct rst_series *few, double shortest, double longest)
{
    const double first = impulse(whole, shortest);
    double bound = fabs(impulse(few, shortest) - first) / first, before[2] = {0};
    for (int i = 0; i < checks; i++) {
        const double t = sample_time(shortest, longest, i, checks), now[2] = {modulus(whole, t), modulus(few, t)};
        if (i > 0) bound = fmax(bound, fmax(before[0] - now[1], before[1] - now[0]) / now[0]);
        before[0] = now[0];
        before[1] = now[1];
    }
    return bound;
}

/* The best moduli for times from `fastest` to `slowest`, and their bound. */
static double fit(const struct rst_series *series, double shortest, double longest, double fastest, double slowest,
                  struct rst_law *law)
{
    struct equations equations;
    double x[unknowns] = {0};
    const int terms = (int)law->n_terms;
    for (int k = 0; k < terms; k++)
        law->tau[k] = terms > 1 ? sample_time(fastest, slowest, k, terms) : sqrt(fastest * slowest);
    set_up(series, law, shortest, longest, &equations);
    solve_positive(&equations, x);
    law->g_inf = x[terms];
    for (int k = 0; k < terms; k++)
        law->g[k] = x[k];
    const struct rst_series few = {.g_inf = law->g_inf, .n_terms = (size_t)terms, .tau = law->tau, .g = law->g};
    return bound_error(series, &few, shortest, longest);
}

/* Terms of no modulus cost memory and time. */
static void drop_empty(struct rst_law *law)
{
    int64_t kept = 0;
    for (int64_t k = 0; k < law->n_terms; k++)
        if (law->g[k] > 0) {
            law->tau[kept] = law->tau[k];
            law->g[kept++] = law->g[k];
        }
    for (int64_t k = kept; k < law->n_terms; k++)
        law->tau[k] = law->g[k] = 0;
    law->n_terms = kept;
}

void rst_reduce_series(const struct rst_series *series, int terms, double shortest, double longest, struct rst_law *law,
                       double *error_bound)
{
    struct rst_law trial = *law;
    trial.n_terms = terms;
    trial.eta = series->eta;
    *error_bound = INFINITY;
    for (int i = 0; i < reach_count; i++)
        for (int j = 0; j < reach_count; j++) {
            const double bound = fit(series, shortest, longest, shortest * reaches[i], longest / reaches[j], &trial);
            if (!(bound < *error_bound)) continue;
            *error_bound = bound;
            *law = trial;
        }
    drop_empty(law);
}
