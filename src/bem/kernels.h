/* The Fortran procedures of the component; see the folder fortran/bem.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef BEM_KERNELS_H
#define BEM_KERNELS_H

#include <fftw3.h>
#include <stdint.h>

/* Kinds of fortran/bem/influence.f90. */
enum bem_kind { BEM_NORMAL = 0, BEM_SHEAR = 1 };

void rst_bem_influence_table(int64_t kind, int64_t n, double *table);
void rst_bem_creep_form(double g_inf, int64_t n, const double *g, const double *tau, double *instantaneous,
                        double *flow, int64_t *n_creep, double *compliance, double *lambda);

void rst_bem_set_twiddles(int64_t n, fftw_complex *w);
void rst_bem_lay_rows(int64_t ld, int64_t m, int64_t n, const double *x, int64_t ldv, fftw_complex *v);
void rst_bem_turn(int64_t m, int64_t n, const fftw_complex *w, int64_t ldv, const fftw_complex *v, fftw_complex *t,
                  fftw_complex *line);
void rst_bem_filter(int64_t n, const fftw_complex *w, const double *factor, int64_t ldv, fftw_complex *t);
void rst_bem_turn_back(int64_t m, int64_t n, const fftw_complex *w, int64_t ldv, const fftw_complex *t, fftw_complex *v,
                       fftw_complex *line);
void rst_bem_take_rows(int64_t ld, int64_t m, int64_t n, int64_t ldv, const fftw_complex *v, double *x);

void rst_bem_clamp(int64_t ld, int64_t m, const double *low, const double *high, double *x);
void rst_bem_free_residual(int64_t ld, int64_t m, const double *low, const double *high, const double *rhs,
                           const double *x, const double *u, double *free, double *r, double *squares, double *count,
                           double *changed);
void rst_bem_new_direction(int64_t ld, int64_t m, const double *free, const double *r, const double *z, double *rz,
                           double *d);
void rst_bem_take_step(int64_t ld, int64_t m, const double *low, const double *high, const double *r, const double *kd,
                       double *d, double *x, double *alpha, double *stopped);
void rst_bem_add_scaled(int64_t ld, int64_t m, double a, const double *y, double *x);

void rst_bem_start_normal(int64_t ld, int64_t m, const double *p, const double *p_before, double *start, double *low,
                          double *high);
void rst_bem_start_shear(int64_t ld, int64_t m, const double *p, const double *tau, const double *tau_before,
                         const double *high, double *start);
void rst_bem_recall(int64_t ld, int64_t m, int64_t n_terms, const double *decay, const double *b, double held,
                    const double *drift, const double *f, double *h);
void rst_bem_remember(int64_t ld, int64_t m, int64_t n_terms, const double *decay, const double *gain, double half_flow,
                      const double *f_new, double *b, double *drift, double *f);
void rst_bem_normal_target(int64_t ld, int64_t m, double spacing, double depth, double c, const double *h,
                           double *target);
void rst_bem_enter(int64_t ld, int64_t m, double spacing, double first_ratio, const double *p, const double *p_before,
                   const double *gap, const double *gap_before, const double *s, const double *s_before, double *a);
void rst_bem_shear_bounds(int64_t ld, int64_t m, int64_t mode, const double *p, double *low, double *high);
void rst_bem_shear_target(int64_t ld, int64_t m, double shift, double c, const double *a, const double *h,
                          double *target);
void rst_bem_measure(int64_t ld, int64_t m, int64_t near, double c, const double *f, const double *target,
                     const double *p, double *gap, double *gap_before, double *force, double *contact);
void rst_bem_settle(int64_t ld, int64_t m, int64_t near, double shift, double c, const double *h, const double *f,
                    const double *p, const double *tau_before, const double *tau, const double *low, const double *high,
                    double *a, double *s, double *s_before, double *force, double *stick, double *work);

#endif
