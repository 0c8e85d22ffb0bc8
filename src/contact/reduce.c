/* Replace a long Prony series by a short one, for the times of a simulation (docs/contact.md).
 * Least squares of the relative error of G(t) and of its integral over the first step. The log(tau)
 * are equally spaced, and moduli are >= 0, so that the result is a solid.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "contact/law.h"

/* Samples in time; for the bound ten times as many, since G falls between samples. */
enum { samples = 128, checks = 10 * samples, unknowns = rst_most_terms + 1, most_sweeps = 20000 };

/* Candidates for how far the relaxation times extend beyond both ends of the window. The pair with
 * the smallest bound is taken. */
static const double reaches[] = {1, 0.5, 0.25, 0.1, 0.03};
enum { reach_count = sizeof reaches / sizeof reaches[0] };

/* The iteration ends when a sweep changes all moduli by less than this, relatively. It is far below
 * the error of a fit with a few terms. */
static const double settled = 1e-9;

/* Below this share of G(0) nothing is fitted. So squares of relative errors do not overflow. */
static const double nothing = 1e-60;

/* A term of G(t); or of its integral up to t, which determines the force after the first step. */
static double term_of(int integral, double tau, double t)
{
    return integral ? -tau * expm1(-t / tau) : exp(-t / tau);
}

static double modulus(int integral, const struct rst_series *s, double t)
{
    double g = s->g_inf * (integral ? t : 1);
    for (size_t k = 0; k < s->n_terms; k++)
        g += s->g[k] * term_of(integral, s->tau[k], t);
    return g;
}

static double between(double first, double last, int i, int n)
{
    return n > 1 ? first * pow(last / first, (double)i / (n - 1)) : sqrt(first * last);
}

/* Normal equations of G(t) at the samples and, with the same weight, of the integral; the last
 * unknown is G_inf. */
static void set_up(const struct rst_series *s, int n, const double *tau, double shortest, double longest,
                   double matrix[unknowns][unknowns], double *right)
{
    for (int i = 0; i <= samples; i++) {
        const int integral = i == samples;
        const double t = integral ? shortest : between(shortest, longest, i, samples);
        const double weight = integral ? samples : 1, whole = modulus(integral, s, t);
        double row[unknowns];
        for (int k = 0; k < n; k++)
            row[k] = term_of(integral, tau[k], t) / whole;
        row[n] = s->g_inf > 0 ? (integral ? t : 1) / whole : 0; /* a fluid must stay a fluid */
        for (int k = 0; k <= n; k++) {
            right[k] += weight * row[k];
            for (int j = 0; j <= n; j++)
                matrix[k][j] += weight * row[k] * row[j];
        }
    }
}

/* The least squares with x >= 0, one unknown after the other. */
static void solve_positive(int n, const double matrix[unknowns][unknowns], const double *right, double *x)
{
    double change = 1, size = 1;
    for (int sweep = 0; sweep < most_sweeps && change > settled * size; sweep++) {
        change = size = 0;
        for (int i = 0; i < n; i++) {
            double rest = right[i];
            for (int j = 0; j < n; j++)
                if (j != i) rest -= matrix[i][j] * x[j];
            const double next = matrix[i][i] > 0 ? fmax(0, rest / matrix[i][i]) : 0;
            change += fabs(next - x[i]);
            size += next;
            x[i] = next;
        }
    }
}

/* Largest relative error. Both moduli fall with time, so that between two times each is between its
 * values there. */
static double bound_error(const struct rst_series *whole, const struct rst_series *few, double shortest, double longest)
{
    const double first = modulus(1, whole, shortest);
    double bound = fabs(modulus(1, few, shortest) - first) / first, before[2] = {0};
    for (int i = 0; i < checks; i++) {
        const double t = between(shortest, longest, i, checks), now[2] = {modulus(0, whole, t), modulus(0, few, t)};
        if (i > 0) bound = fmax(bound, fmax(before[0] - now[1], before[1] - now[0]) / now[0]);
        before[0] = now[0];
        before[1] = now[1];
    }
    return bound;
}

void rst_reduce_series(const struct rst_series *series, int terms, double shortest, double longest, struct rst_law *law,
                       double *error_bound)
{
    law->eta = series->eta;
    *error_bound = INFINITY;
    if (!(modulus(0, series, longest) > nothing * modulus(0, series, 0))) return;
    for (int trial = 0; trial < reach_count * reach_count; trial++) {
        const double fastest = shortest * reaches[trial / reach_count],
                     slowest = longest / reaches[trial % reach_count];
        double tau[rst_most_terms], matrix[unknowns][unknowns] = {{0}}, right[unknowns] = {0}, x[unknowns] = {0};
        for (int k = 0; k < terms; k++)
            tau[k] = between(fastest, slowest, k, terms);
        set_up(series, terms, tau, shortest, longest, matrix, right);
        solve_positive(terms + 1, matrix, right, x);
        const struct rst_series few = {.g_inf = x[terms], .n_terms = (size_t)terms, .tau = tau, .g = x};
        const double bound = bound_error(series, &few, shortest, longest);
        if (!(bound < *error_bound)) continue;
        *error_bound = bound;
        law->g_inf = x[terms];
        law->at.terms = 0;
        for (int k = 0; k < terms; k++)
            if (x[k] > 0) { /* terms without modulus would only cost memory and time */
                law->tau[law->at.terms] = tau[k];
                law->g[law->at.terms++] = x[k];
            }
    }
    for (int k = law->at.terms; k < rst_most_terms; k++)
        law->tau[k] = law->g[k] = 0;
}
