/** @file fit.h
 *  Component `fit` of restitute: material constants from measured impacts, and a Prony series from
 *  a DMA curve.
 *
 *  Link restitute::fit, a library of its own: it needs the GNU Scientific Library (GSL >= 2.7),
 *  which is under the GNU General Public License, so a program that links restitute::fit and is
 *  passed on falls under that licence.
 *
 *  Five lines:
 *
 *      restitute_fit_point drop[20];      // each by its init function; scene and ez filled in
 *      restitute_fit_options options; restitute_fit_options_init(&options);
 *      restitute_fit_result result; restitute_fit_result_init(&result);
 *      restitute_fit(20, drop, &options, &result, &error);
 *      // result.name[0] = "modulus1_pa" (a standard solid is the default) is result.value[0],
 *      // in [result.low[0], result.high[0]]; result.material
 *
 *  What can be known. e_z and e_x are numbers without a unit: all moduli times f and all times
 *  times f^(-2/5) leave them as they are, at every speed and for every sphere. So e_z(v) alone
 *  never gives a modulus. One contact time, or one known constant (`known`), sets the scale.
 *  Without it the fitted solid still has the right e_z and e_x; the constants are reported as not
 *  determined, and the remarks say which of them may change together.
 *
 *  How. Nonlinear least squares in the logarithms of the constants (GSL's trust region), from
 *  several starts that are chosen by a quasi-random scan; derivatives are differences, updated by
 *  Broyden's rule unless shifts are fitted. The forward model is the method `sync` (@ref
 *  restitute_solve_scene_many); many points without e_x are interpolated between impacts evenly
 *  spaced in log T, within 1e-5. Intervals are those of the linearised problem with Student's t;
 *  where they reach beyond 20 % and no loss is robust, ends move out to where the sum of squares
 *  has risen as much (profile likelihood). Without standard deviations all values of e count alike,
 *  contact times by their relative error, and the noise is estimated from the residuals. Equal
 *  input gives equal bits.
 *
 *  The rules of restitute.h hold. GSL has one error handler for the process, and its own ends the
 *  program: it is switched off while a call of this component runs and restored afterwards. GSL may
 *  also raise floating-point flags: do not trap them in these calls. Where there is no memory left
 *  this component returns ERROR_MEMORY; GSL may then lose some blocks.
 *
 *  SPDX-License-Identifier: BSD-3-Clause (this file and the component's source)
 */
#ifndef RESTITUTE_FIT_H
#define RESTITUTE_FIT_H

#include <restitute/restitute.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Lengths of arrays in the results. */
enum {
    RESTITUTE_FIT_CONSTANTS = 32,
    RESTITUTE_FIT_NAME = 32,
    RESTITUTE_DMA_TERMS = 64,
    RESTITUTE_DMA_SHIFTS = 32
};

/** Which solid; its constants, in the order of restitute_fit_options.known and of the results. */
typedef enum restitute_fit_model {
    RESTITUTE_FIT_MODEL_ELASTIC = 1,        /**< modulus_pa */
    RESTITUTE_FIT_MODEL_KELVIN_VOIGT = 2,   /**< modulus1_pa, viscosity_pa_s */
    RESTITUTE_FIT_MODEL_STANDARD_SOLID = 3, /**< modulus1_pa, modulus2_pa, viscosity_pa_s; the
                                                 default */
    RESTITUTE_FIT_MODEL_MAXWELL = 4,        /**< modulus_pa, viscosity_pa_s */
    RESTITUTE_FIT_MODEL_PRONY = 5           /**< equilibrium_modulus_pa, then a modulus a term; the
                                                 times are given */
} restitute_fit_model;

/** What a residual counts: its square, or less where it is large, so that outliers do not pull. */
typedef enum restitute_fit_loss {
    RESTITUTE_FIT_LOSS_SQUARES = 0, /**< the default */
    RESTITUTE_FIT_LOSS_HUBER = 1,   /**< linear beyond 1.345 standard deviations */
    RESTITUTE_FIT_LOSS_CAUCHY = 2   /**< logarithmic: outliers hardly count */
} restitute_fit_loss;

/** What the data leave open, bits of restitute_fit_result.flags; the remarks say it with names and
 *  numbers. */
typedef enum restitute_fit_flag {
    RESTITUTE_FIT_FLAG_UNDETERMINED = 1, /**< other constants or another model fit as well */
    RESTITUTE_FIT_FLAG_SIMPLER = 2,      /**< a model with fewer constants fits as well */
    RESTITUTE_FIT_FLAG_MISFIT = 4,       /**< the data do not follow the model */
    RESTITUTE_FIT_FLAG_LIMITS = 8,       /**< impacts beyond the limits of the contact model (@ref
                                              restitute_flag) */
    RESTITUTE_FIT_FLAG_UNFINISHED = 16   /**< the iteration did not converge */
} restitute_fit_flag;

/** One measured impact. NaN stands for what was not measured; at least one of ez, ex and
 *  contact_time was. */
typedef struct restitute_fit_point {
    size_t struct_size;           /**< set by @ref restitute_fit_point_init */
    const restitute_scene *scene; /**< required; points may share one. Its material is the
                                       partner's, or NULL: rigid, or with BOTH_BODIES_DEFORM of the
                                       fitted solid. friction NaN: to be fitted, from ex */
    double temperature;           /**< any scale with degrees of 1 K; NaN (default): that of
                                       reference */
    double ez;                    /**< in [0, 1] */
    double ex;                    /**< in [-1, 1], of the contact point */
    double contact_time;          /**< s, in [1e-100, 1e100] */
    double sigma_ez, sigma_ex;    /**< standard deviations, in [1e-100, 1e100]; NaN (default): 1, a
                                       common one */
    double sigma_contact_time;    /**< s, in [1e-100, 1e100]; NaN (default): contact_time itself,
                                       so that its relative error counts like e's */
} restitute_fit_point;

/** Prepare with no scene and NaN for all that is measured. */
RESTITUTE_INIT(RESTITUTE_SINCE_0_1, fit_point)

/** How to fit. */
typedef struct restitute_fit_options {
    size_t struct_size;            /**< set by @ref restitute_fit_options_init */
    int model;                     /**< a @ref restitute_fit_model; default STANDARD_SOLID */
    size_t terms;                  /**< PRONY: 1 to 20; required with it, else not read */
    const double *relaxation_time; /**< PRONY: tau_k, s, in [1e-30, 1e30], no two alike; `terms`
                                        values, copied; required with it, else not read */
    const double *known;           /**< optional: as many values as the solid has constants, each in
                                        [1e-30, 1e30], with PRONY also 0, or NaN: to be fitted;
                                        copied */
    double poisson_ratio;          /**< in [0, 0.5]; default 0.5 */
    int loss;                      /**< a @ref restitute_fit_loss; default SQUARES */
    int noise_known;               /**< nonzero: the sigmas, all given, are the noise itself;
                                        default 0: only weights */
    double confidence;             /**< of the intervals, in [0.5, 0.999]; default 0.95 */
    double reference_temperature;  /**< where a_T = 1; NaN (default): that of the first point */
    double wlf_c1, wlf_c2;         /**< log10 a_T = -c1 (T - T_r)/(c2 + T - T_r); NaN (default): a_T
                                        of every other temperature is fitted. a_T multiplies all
                                        relaxation times */
    int starts;                    /**< local fits from the best of the scan, 1 to 100; default 0:
                                        5, and up to 8 while residuals are far too large */
    uint64_t seed;                 /**< shifts the quasi-random scan; default 1 */
    int threads;                   /**< as in @ref restitute_options; default 1 */
    /** Asked in the caller's thread before every batch of at most 200 impacts; nonzero ends the
     *  call with ERROR_INTERRUPTED. NULL (default): nobody is asked */
    int (*interrupted)(void *data);
    void *interrupted_data;        /**< is handed to it */
} restitute_fit_options;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, fit_options)

/** What came out: the constants of the model, then "friction" and "shift_<temperature>" where they
 *  are fitted. */
typedef struct restitute_fit_result {
    size_t struct_size;           /**< set by @ref restitute_fit_result_init */
    size_t constants;             /**< how many */
    char name[RESTITUTE_FIT_CONSTANTS][RESTITUTE_FIT_NAME];
    double value[RESTITUTE_FIT_CONSTANTS];
    /** 0 or infinity: no such bound, and with both not determined; both the value: known */
    double low[RESTITUTE_FIT_CONSTANTS], high[RESTITUTE_FIT_CONSTANTS];
    double correlation[RESTITUTE_FIT_CONSTANTS][RESTITUTE_FIT_CONSTANTS]; /**< of the logarithms */
    size_t values;                /**< measured values of ez, ex, contact_time that were fitted */
    size_t rank;                  /**< combinations of constants that the data determine */
    double rms;                   /**< root of the mean squared weighted residual */
    double noise;                 /**< its standard deviation for the degrees of freedom left,
                                       values - rank; NaN: none left */
    double condition;             /**< largest over smallest singular value of the weighted
                                       Jacobian; infinite: the smallest is 0 */
    int64_t impacts;              /**< that were solved */
    int flags;                    /**< bits of @ref restitute_fit_flag */
    char remarks[2000];           /**< a line a remark, each ending with a newline */
    restitute_material *material; /**< the solid at the reference temperature, for
                                       restitute_material_destroy */
} restitute_fit_result;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, fit_result)

/** Fit the constants of a solid to measured impacts. Twenty points take some tenths of a second.
 *
 *  @param n,points  1 to 1e6 measurements, each prepared by @ref restitute_fit_point_init
 *  @param options   NULL: the defaults
 *  @param result    prepared by @ref restitute_fit_result_init
 *  @param error     optional; names the point, e.g. "points[3].ez = 1.2: must be in [0, 1]"
 *  @return OK, also if flags are raised; ERROR_DOMAIN (also for fewer values than constants),
 *          ERROR_NULL, ERROR_STRUCT_SIZE, ERROR_MEMORY, ERROR_INTERRUPTED, ERROR_INTERNAL */
RESTITUTE_SINCE_0_1 int restitute_fit(size_t n, const restitute_fit_point *points,
    const restitute_fit_options *options, restitute_fit_result *result, restitute_error *error);

/** The same in pieces, for progress: create, run until done is 1, read, destroy. One thread at a
 *  time.
 *
 *      double done = 0;
 *      while (done < 1 && restitute_fitter_run(fitter, &done, &error) == RESTITUTE_OK)
 *          show(done); */
typedef struct restitute_fitter restitute_fitter;

/** Points, their scenes and options are copied; materials of partners and interrupted_data must
 *  live as long as the fitter. */
RESTITUTE_SINCE_0_1 int restitute_fitter_create(size_t n, const restitute_fit_point *points,
    const restitute_fit_options *options, restitute_fitter **fitter, restitute_error *error);

/** One piece of the work: the scan, a local fit, the intervals, the other models or the result. A
 *  failed one ends the work: later calls return its status, and the fitter can only be destroyed.
 *  @param done  out: the part done, 1 at the end */
RESTITUTE_SINCE_0_1 int restitute_fitter_run(restitute_fitter *fitter, double *done,
    restitute_error *error);

/** The result, after the end. */
RESTITUTE_SINCE_0_1 int restitute_fitter_result(const restitute_fitter *fitter,
    restitute_fit_result *result, restitute_error *error);

/** What the fitted solid gives for each point, measured or not; n values each, NULL: not wanted.
 *  options.interrupted is asked here, too; the fitter can still be used after it. */
RESTITUTE_SINCE_0_1 int restitute_fitter_values(const restitute_fitter *fitter, double *ez,
    double *ex, double *contact_time, restitute_error *error);

/** NULL is allowed. */
RESTITUTE_SINCE_0_1 void restitute_fitter_destroy(restitute_fitter *fitter);

/* ------------------------------------------------------------------------------------------ DMA */

/** How to turn storage and loss moduli into a Prony series. */
typedef struct restitute_dma_options {
    size_t struct_size;           /**< set by @ref restitute_dma_options_init */
    double poisson_ratio;         /**< in [0, 0.5]; default 0.5 */
    int tension;                  /**< nonzero: the moduli are E' and E''; G = E/(2(1 + nu)).
                                       Default 0: shear */
    double noise;                 /**< relative standard deviation of the moduli, in [1e-4, 0.5];
                                       default 0.01. Terms that buy less are left out */
    double reference_temperature; /**< where a_T = 1; NaN (default): that of the first row */
    double wlf_c1, wlf_c2;        /**< NaN (default): a free shift a temperature; else log10 a_T is
                                       given by them */
} restitute_dma_options;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, dma_options)

/** A series with positive terms only, as few as the data carry. */
typedef struct restitute_dma_result {
    size_t struct_size;           /**< set by @ref restitute_dma_result_init */
    double equilibrium_modulus;   /**< Pa; 0: none */
    size_t terms;
    /** s ascending, Pa */
    double relaxation_time[RESTITUTE_DMA_TERMS], modulus[RESTITUTE_DMA_TERMS];
    size_t temperatures;          /**< distinct ones, ascending; 0: none were given */
    /** a_T: times are multiplied by it */
    double temperature[RESTITUTE_DMA_SHIFTS], shift[RESTITUTE_DMA_SHIFTS];
    double wlf_c1, wlf_c2;        /**< given, or fitted to the shifts; NaN: fewer than three
                                       temperatures, or no such law */
    double rms, worst;            /**< relative residuals of the moduli: root mean square and
                                       largest */
    int flags;                    /**< MISFIT: rms far above the noise; UNDETERMINED: temperatures
                                       do not overlap, or all frequencies lie within a decade */
    char remarks[1000];
    restitute_material *material; /**< for restitute_material_destroy */
} restitute_dma_result;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, dma_result)

/** A Prony series from storage and loss moduli.
 *
 *  The loss modulus gives a first series of two terms a decade. All times and moduli are refined
 *  together, then terms merged or removed as long as the Bayesian information criterion falls.
 *
 *  @param n                 rows, 3 to 100000
 *  @param frequency         Hz, in [1e-30, 1e30]: omega = 2 pi f
 *  @param storage,loss      Pa, in [1e-30, 1e30]
 *  @param temperature       NULL: one temperature
 *
 *      restitute_dma_fit(n, f, storage, loss, NULL, NULL, &result, &error); */
RESTITUTE_SINCE_0_1 int restitute_dma_fit(size_t n, const double *frequency, const double *storage,
    const double *loss, const double *temperature, const restitute_dma_options *options,
    restitute_dma_result *result, restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
