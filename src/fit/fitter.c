/* The handle of a fit: a scan, local fits, robust weights, rival models, and the result.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/report.h"
#include "base/sized.h"
#include "fit/least.h"
#include "fit/search.h"

/* Rounds of robust weights; most starts, unless options say how many. */
enum { ROUNDS = 30, STARTS = 8 };

struct restitute_fitter {
    struct rst_fit_data data;
    struct rst_fit_search search;
    double *weight;
    struct rst_fit_intervals intervals;
    size_t turn, turns; /* scan, starts, then weights and intervals, then the rivals, then the result */
    int status;         /* of the latest turn; negative: no other follows */
    restitute_fit_result result;
};

/* A rival model that may explain the data as well. One fit, which starts from the present constants
 * and the best of three viscosities. `from`: the constants of the solid. */
static int try_rival(restitute_fitter *f, int kind, const double *known, const double *from)
{
    const struct rst_fit_model *m = &f->search.model;
    struct rst_fit_model model;
    struct rst_fit_search rival;
    double ours[RESTITUTE_FIT_CONSTANTS], logs[3 * RESTITUTE_FIT_CONSTANTS];
    rst_fit_constants(m, f->search.logs, ours);
    rst_fit_model_make(&f->data, kind, known, &model);
    if ((model.free == m->free && kind == m->kind) || model.free > f->data.rows) return RESTITUTE_OK;
    if (model.free > m->free && f->intervals.judged > f->intervals.noise)
        return RESTITUTE_OK; /* nothing left to explain */
    for (size_t k = 0; k < 3 * model.free; k++) {
        const size_t i = model.index[k % model.free];
        logs[k] = log(i < model.solid ? from[i] : ours[i + m->solid - model.solid]); /* friction, shifts */
        if (i + 1 == model.solid) logs[k] += log(10) * ((double)(k / model.free) - 1);
    }
    int status = rst_fit_search_create(&f->data, &model, f->weight, 1, &rival);
    if (status) return status;
    if (model.free) status = rst_fit_choose(&rival, 3, logs);
    if (status >= 0) status = model.free ? rst_fit_local(&rival, 0) : rst_fit_again(&rival);
    if (status >= 0) rst_fit_remark_rival(&f->search, &f->intervals, &rival, &f->result);
    rst_fit_search_release(&rival);
    return status;
}

/* The series without the term of the largest part in the worst direction. */
static int try_shorter_series(restitute_fitter *f)
{
    const struct rst_fit_model *m = &f->search.model;
    const double *v = f->intervals.vector + (m->free - 1) * m->free;
    double known[RESTITUTE_FIT_CONSTANTS], ours[RESTITUTE_FIT_CONSTANTS];
    size_t worst = 0;
    if (m->free < 2) return RESTITUTE_OK;
    memcpy(known, m->known, sizeof known);
    rst_fit_constants(m, f->search.logs, ours);
    for (size_t k = 1; k < m->free; k++)
        if (m->index[k] < m->solid && fabs(v[k]) > fabs(v[worst])) worst = k;
    if (m->index[worst] >= m->solid) return RESTITUTE_OK;
    known[m->index[worst]] = 0;
    return try_rival(f, RESTITUTE_FIT_MODEL_PRONY, known, ours);
}

/* Solids with one constant more or fewer, and Maxwell for Kelvin-Voigt. A new spring starts with
 * the modulus of the other. */
static int try_rivals(restitute_fitter *f)
{
    static const int parts[] = {0, 1, 5, 7, 6}; /* of a kind, bits: modulus1, modulus2, viscosity */
    const struct rst_fit_model *m = &f->search.model;
    double part[RST_FIT_PARTS], known[RST_FIT_PARTS], ours[RESTITUTE_FIT_CONSTANTS];
    int status = RESTITUTE_OK;
    rst_fit_constants(m, f->search.logs, ours);
    if (m->free == 0) return try_rival(f, m->kind, NULL, ours); /* are the known constants right? */
    if (m->kind == RESTITUTE_FIT_MODEL_PRONY) return try_shorter_series(f);
    for (int i = 0; i < RST_FIT_PARTS; i++)
        part[i] = i == RST_FIT_VISCOSITY ? m->viscosity : ours[0], known[i] = NAN;
    for (size_t i = 0; i < m->solid; i++)
        part[rst_fit_part(m->kind, i)] = ours[i], known[rst_fit_part(m->kind, i)] = m->known[i];
    for (int kind = RESTITUTE_FIT_MODEL_ELASTIC; kind <= RESTITUTE_FIT_MODEL_MAXWELL && status >= 0; kind++) {
        const int differ = parts[kind] ^ parts[m->kind], other = differ == 3; /* the spring beside or behind the dashpot */
        const int which = other ? (parts[kind] & 1) : differ == 1 ? 0 : differ == 2 ? 1 : 2;
        double theirs[RST_FIT_PARTS], from[RST_FIT_PARTS];
        if ((!other && differ != 1 << which) || !isnan(known[which])) continue; /* one that is known cannot be left out */
        for (size_t i = 0; i < rst_fit_solid_constants(kind, 0); i++)
            theirs[i] = known[rst_fit_part(kind, i)], from[i] = part[rst_fit_part(kind, i)];
        status = try_rival(f, kind, theirs, from);
    }
    return status;
}

static int check_model(const restitute_fitter *f, restitute_error *error)
{
    const struct rst_fit_model *m = &f->search.model;
    if (m->count > RESTITUTE_FIT_CONSTANTS)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "%zu constants, shifts of temperatures included: must be at most %d", m->count,
                          RESTITUTE_FIT_CONSTANTS);
    if (f->data.rows < m->free)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                          "%zu measured values are fewer than the %zu constants of the model", f->data.rows, m->free);
    for (size_t i = 0; i < m->solid; i++) /* 1e8 on both sides is searched, and the core takes 1e-30 to 1e30 */
        if (!(fabs(m->centre[i]) <= log(1e20)))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN,
                              "contact times or known constants call for a modulus or viscosity near %.3g: must be in "
                              "[1e-20, 1e20]; check units",
                              exp(m->centre[i]));
    return RESTITUTE_OK;
}

static int prepare(restitute_fitter *f, restitute_error *error)
{
    struct rst_fit_model model;
    const int automatic = f->data.options.starts == 0;
    if (automatic) f->data.options.starts = STARTS;
    rst_fit_model_make(&f->data, f->data.options.model, f->data.options.known, &model);
    f->weight = malloc(f->data.rows * sizeof *f->weight);
    for (size_t i = 0; f->weight && i < f->data.rows; i++)
        f->weight[i] = 1;
    f->search.model = model;
    f->turns = (size_t)f->data.options.starts + 4;
    rst_fit_thin(&f->data, 1);
    const int status = check_model(f, error);
    if (status) return status;
    if (!f->weight || rst_fit_search_create(&f->data, &model, f->weight, (size_t)f->data.options.starts, &f->search))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu points", f->data.n);
    f->search.automatic = automatic;
    return RESTITUTE_OK;
}

int restitute_fitter_create(size_t n, const restitute_fit_point *points, const restitute_fit_options *options,
                            restitute_fitter **fitter, restitute_error *error)
{
    restitute_fit_options own;
    if (!fitter) return rst_report(error, RESTITUTE_ERROR_NULL, "fitter is NULL");
    int status = RST_TAKE(fit_options, &own, options, error);
    if (status) return status;
    restitute_fitter *f = calloc(1, sizeof *f);
    if (!f) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    status = rst_fit_data_create(n, points, &own, &f->data, error);
    if (!status) status = prepare(f, error);
    if (status) {
        restitute_fitter_destroy(f);
        return status;
    }
    restitute_fit_result_init(&f->result);
    *fitter = f;
    return rst_done(error);
}

void restitute_fitter_destroy(restitute_fitter *fitter)
{
    if (!fitter) return;
    rst_fit_search_release(&fitter->search);
    rst_fit_data_release(&fitter->data);
    free(fitter->weight);
    free(fitter);
}

/* Half the width of an interval in standard deviations; without degrees of freedom nothing is
 * determined. */
static double quantile(const restitute_fitter *f)
{
    const double upper = 0.5 + 0.5 * f->data.options.confidence;
    return f->data.options.noise_known ? gsl_cdf_ugaussian_Pinv(upper)
           : f->intervals.dof          ? gsl_cdf_tdist_Pinv(upper, (double)f->intervals.dof)
                                       : INFINITY;
}

/* Iterate robust weights until they converge, then find what the data determine. */
static int settle(restitute_fitter *f)
{
    double change = 1;
    rst_fit_thin(&f->data, 0);
    int status = rst_fit_again(&f->search);
    for (int round = 0; f->data.options.loss && round < ROUNDS && status >= 0 && change > 1e-4; round++) {
        status = rst_fit_reweigh(&f->search, f->weight, &change);
        if (status >= 0) status = rst_fit_again(&f->search);
    }
    if (status >= 0) status = rst_fit_judge_other(&f->search);
    if (status >= 0) status = rst_fit_rescale(&f->search);
    if (status >= 0) status = rst_fit_intervals(&f->search, &f->intervals);
    return status < 0 ? status : rst_fit_profile(&f->search, quantile(f), &f->intervals);
}

static void write_constants(restitute_fitter *f)
{
    const struct rst_fit_model *m = &f->search.model;
    const struct rst_fit_intervals *c = &f->intervals;
    restitute_fit_result *r = &f->result;
    rst_fit_constants(m, f->search.logs, r->value);
    r->constants = m->count;
    for (size_t i = 0; i < m->count; i++) {
        rst_fit_name(&f->data, m, i, r->name[i]);
        r->low[i] = r->high[i] = r->value[i];
        r->correlation[i][i] = 1;
    }
    for (size_t k = 0; k < m->free; k++) {
        const size_t i = m->index[k];
        r->low[i] = r->value[i] * exp(-c->below[k]);
        r->high[i] = r->value[i] * exp(c->above[k]);
        for (size_t l = 0; l < m->free; l++) {
            const double square = c->variance[k * m->free + k] * c->variance[l * m->free + l];
            if (l != k && square > 0) r->correlation[i][m->index[l]] = c->variance[k * m->free + l] / sqrt(square);
        }
    }
}

static int finish(restitute_fitter *f)
{
    restitute_fit_result *r = &f->result;
    const struct rst_fit_intervals *c = &f->intervals;
    const size_t p = f->search.model.free;
    write_constants(f);
    r->values = f->data.rows;
    r->rank = c->rank;
    r->rms = sqrt(f->search.sum / (double)f->data.rows);
    r->noise = f->data.options.noise_known ? (c->dof ? sqrt(f->search.sum / (double)c->dof) : NAN) : c->noise;
    r->condition = !p ? 1 : c->values[p - 1] > 0 ? c->values[0] / c->values[p - 1] : INFINITY; /* 0/0 too */
    const int status = rst_fit_remarks(&f->search, c, r);
    r->impacts = f->data.impacts;
    return status;
}

static int take_turn(restitute_fitter *f)
{
    const size_t starts = (size_t)f->data.options.starts, turn = f->turn;
    if (turn == 0) return rst_fit_scan(&f->search);
    if (turn <= starts) return rst_fit_local(&f->search, turn - 1);
    return turn == starts + 1 ? settle(f) : turn == starts + 2 ? try_rivals(f) : finish(f);
}

static int failed(const restitute_fitter *f, restitute_error *error)
{
    return rst_report(error, f->status, "the fit failed: %s", restitute_status_text(f->status));
}

int restitute_fitter_run(restitute_fitter *f, double *done, restitute_error *error)
{
    if (!f || !done) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", f ? "done" : "fitter");
    if (f->turn < f->turns && f->status >= 0) {
        rst_fit_gsl_begin();
        f->status = take_turn(f);
        rst_fit_gsl_end();
        if (f->status >= 0) f->turn++;
    }
    if (f->status < 0) return failed(f, error);
    *done = (double)f->turn / (double)f->turns;
    return rst_done(error);
}

static int check_finished(const restitute_fitter *f, restitute_error *error)
{
    if (!f) return rst_report(error, RESTITUTE_ERROR_NULL, "fitter is NULL");
    if (f->status < 0) return failed(f, error);
    if (f->turn == f->turns) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_ERROR_DOMAIN, "the fit is not finished: call restitute_fitter_run");
}

int restitute_fitter_result(const restitute_fitter *f, restitute_fit_result *result, restitute_error *error)
{
    int status = check_finished(f, error);
    if (status) return status;
    if (!result) return rst_report(error, RESTITUTE_ERROR_NULL, "result is NULL");
    restitute_fit_result own = f->result;
    status = RST_CHECK(fit_result, result, error);
    if (!status) status = rst_fit_solid(&f->data, &f->search.model, own.value, 1, &own.material, error);
    if (status < 0) return status;
    RST_GIVE(&own, result);
    return rst_done(error);
}

int restitute_fitter_values(const restitute_fitter *f, double *ez, double *ex, double *contact_time,
                            restitute_error *error)
{
    int status = check_finished(f, error);
    if (status) return status;
    restitute_result *results = calloc(f->data.n, sizeof *results);
    struct rst_fit_data data = f->data; /* a copy: only its count of impacts changes */
    status = results ? rst_fit_solve_points(&data, &f->search.model, f->result.value, results) : RESTITUTE_ERROR_MEMORY;
    for (size_t i = 0; i < f->data.n && status >= 0; i++) {
        if (ez) ez[i] = results[i].ez;
        if (ex) ex[i] = results[i].ex;
        if (contact_time) contact_time[i] = results[i].contact_time;
    }
    free(results);
    return status < 0 ? rst_report(error, status, "%s", restitute_status_text(status)) : rst_done(error);
}

int restitute_fit(size_t n, const restitute_fit_point *points, const restitute_fit_options *options,
                  restitute_fit_result *result, restitute_error *error)
{
    restitute_fitter *fitter;
    double done = 0;
    if (!result) return rst_report(error, RESTITUTE_ERROR_NULL, "result is NULL");
    int status = RST_CHECK(fit_result, result, error);
    if (!status) status = restitute_fitter_create(n, points, options, &fitter, error);
    if (status) return status;
    while (!status && done < 1)
        status = restitute_fitter_run(fitter, &done, error);
    if (!status) status = restitute_fitter_result(fitter, result, error);
    restitute_fitter_destroy(fitter);
    return status;
}
