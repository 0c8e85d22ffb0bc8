/* From constants to solids, and from solids to the measured quantities.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "fit/model.h"

#include <math.h>
#include <stdlib.h>

#include "base/kernels.h"
#include "base/report.h"

/* Impacts that are solved in one call: many enough for threads, few enough for
 * options.interrupted. */
enum { BATCH = 200 };

/* The search stays within this factor of the centre of the starts. Beyond, impacts are elastic or
 * the sphere sinks in. */
static const double widest = 18.4; /* ln 1e8 */

/* Impacts have T for 1 Pa and Poisson's ratio 1/2, and T^2.5 ~ (1 - nu)/modulus by (24). */
double rst_fit_elastic_modulus(const struct rst_fit_data *d, size_t point, double contact_time)
{
    return 2 * (1 - d->options.poisson_ratio) *
           pow(rst_elastic_contact_time() * d->place[point].time / contact_time, 2.5);
}

/* Scale of the moduli: from contact times as of an elastic solid, else from a known modulus, else 1
 * MPa; and T for it. */
static void find_scales(const struct rst_fit_data *d, struct rst_fit_model *m, double *modulus, double *time)
{
    const double softness = 2 * (1 - d->options.poisson_ratio);
    double logs = 0, times = 0;
    size_t n = 0;
    const size_t moduli = m->kind == RESTITUTE_FIT_MODEL_PRONY            ? m->solid
                          : m->kind == RESTITUTE_FIT_MODEL_STANDARD_SOLID ? 2
                                                                          : 1;
    for (size_t i = 0; i < d->n; i++) {
        const double contact_time = d->points[i].contact_time;
        times += log(d->place[i].time) / (double)d->n;
        if (!isnan(contact_time)) logs += log(rst_fit_elastic_modulus(d, i, contact_time)), n++;
    }
    for (size_t i = 0; n == 0 && i < moduli; i++)
        if (m->known[i] > 0) logs = log(m->known[i]), n = 1;
    m->scaled = n > 0;
    for (size_t i = 0; i < m->solid; i++)
        m->scaled |= m->known[i] > 0;
    *modulus = n ? exp(logs / (double)n) : 1e6;
    *time = exp(times) * pow(softness / *modulus, 0.4);
}

int rst_fit_part(int kind, size_t i)
{
    static const signed char parts[][RST_FIT_PARTS] = {
        [RESTITUTE_FIT_MODEL_ELASTIC] = {RST_FIT_MODULUS1},
        [RESTITUTE_FIT_MODEL_KELVIN_VOIGT] = {RST_FIT_MODULUS1, RST_FIT_VISCOSITY},
        [RESTITUTE_FIT_MODEL_STANDARD_SOLID] = {RST_FIT_MODULUS1, RST_FIT_MODULUS2, RST_FIT_VISCOSITY},
        [RESTITUTE_FIT_MODEL_MAXWELL] = {RST_FIT_MODULUS2, RST_FIT_VISCOSITY}};
    return parts[kind][i];
}

/* Range of the starts: moduli within a factor of 300 of the scale, a viscosity within 30 of modulus
 * times contact time, shifts and friction within 10. Beyond, impacts are elastic, or stiff and slow
 * to solve; the local fits may go there. */
static void set_ranges(const struct rst_fit_data *d, struct rst_fit_model *m)
{
    double modulus, time;
    find_scales(d, m, &modulus, &time);
    m->viscosity = modulus * time;
    for (size_t i = 0; i < m->count; i++) {
        m->centre[i] = i < m->solid ? log(modulus) : 0;
        m->spread[i] = i < m->solid ? log(300) : log(10);
    }
    if (m->kind != RESTITUTE_FIT_MODEL_PRONY && m->kind != RESTITUTE_FIT_MODEL_ELASTIC) {
        m->centre[m->solid - 1] = log(m->viscosity);
        m->spread[m->solid - 1] = log(30);
    }
    if (!m->scaled) m->spread[0] = 0; /* any scale would do */
    if (m->friction < m->count) m->centre[m->friction] = log(0.3);
}

void rst_fit_model_make(const struct rst_fit_data *d, int kind, const double *known, struct rst_fit_model *m)
{
    int friction = 0;
    *m = (struct rst_fit_model){.kind = kind, .solid = rst_fit_solid_constants(kind, d->options.terms)};
    for (size_t i = 0; i < d->n; i++)
        friction |= isnan(d->scene[i].friction) && !isnan(d->points[i].ex);
    m->shift = m->solid + (friction ? 1 : 0);
    m->count = m->shift + (isnan(d->options.wlf_c1) ? d->temperature.count - 1 : 0);
    m->friction = friction ? m->solid : m->count;
    for (size_t i = 0; i < m->count && i < RESTITUTE_FIT_CONSTANTS; i++) {
        m->known[i] = known && i < m->solid ? known[i] : NAN;
        if (isnan(m->known[i])) m->index[m->free++] = i;
    }
    if (m->count <= RESTITUTE_FIT_CONSTANTS) set_ranges(d, m);
}

void rst_fit_name(const struct rst_fit_data *d, const struct rst_fit_model *m, size_t i, char name[RESTITUTE_FIT_NAME])
{
    const int standard = m->kind == RESTITUTE_FIT_MODEL_STANDARD_SOLID || m->kind == RESTITUTE_FIT_MODEL_KELVIN_VOIGT;
    if (i == m->friction)
        rst_print(name, RESTITUTE_FIT_NAME, "friction");
    else if (i >= m->solid)
        rst_print(name, RESTITUTE_FIT_NAME, "shift_%g",
                  d->temperature.value[i - m->shift + (i - m->shift >= d->temperature.reference)]);
    else if (m->kind == RESTITUTE_FIT_MODEL_PRONY)
        rst_print(name, RESTITUTE_FIT_NAME, i ? "modulus_pa[tau=%.3g]" : "equilibrium_modulus_pa",
                  i ? d->options.relaxation_time[i - 1] : 0);
    else if (i > 0 && i == m->solid - 1)
        rst_print(name, RESTITUTE_FIT_NAME, "viscosity_pa_s");
    else
        rst_print(name, RESTITUTE_FIT_NAME, standard ? "modulus%zu_pa" : "modulus_pa", i + 1);
}

void rst_fit_constants(const struct rst_fit_model *m, const double *logs, double *constants)
{
    for (size_t i = 0; i < m->count; i++)
        constants[i] = m->known[i];
    for (size_t k = 0; k < m->free; k++) {
        const size_t i = m->index[k];
        constants[i] = exp(fmin(fmax(logs[k], m->centre[i] - widest), m->centre[i] + widest));
    }
}

/* a_T of a temperature; the fitted shifts leave out the reference. */
static double shift_of(const struct rst_fit_data *d, const struct rst_fit_model *m, const double *constants, size_t t)
{
    const struct rst_temperatures *all = &d->temperature;
    if (t == all->reference) return 1;
    return isnan(all->c1) ? constants[m->shift + t - (t > all->reference)] : pow(10, rst_temperatures_wlf(all, t));
}

int rst_fit_solid(const struct rst_fit_data *d, const struct rst_fit_model *m, const double *c, double shift,
                  restitute_material **material, restitute_error *error)
{
    const double nu = d->options.poisson_ratio;
    double tau[RESTITUTE_FIT_CONSTANTS], g[RESTITUTE_FIT_CONSTANTS];
    size_t n = 0;
    if (m->kind == RESTITUTE_FIT_MODEL_ELASTIC) return restitute_material_elastic(c[0], nu, material, error);
    if (m->kind == RESTITUTE_FIT_MODEL_KELVIN_VOIGT)
        return restitute_material_kelvin_voigt(c[0], shift * c[1], nu, material, error);
    if (m->kind == RESTITUTE_FIT_MODEL_MAXWELL)
        return restitute_material_maxwell(c[0], shift * c[1], nu, material, error);
    if (m->kind == RESTITUTE_FIT_MODEL_STANDARD_SOLID)
        return restitute_material_standard_solid(c[0], c[1], shift * c[2], nu, material, error);
    for (size_t k = 1; k < m->solid; k++)
        if (c[k] > 0) tau[n] = shift * d->options.relaxation_time[k - 1], g[n++] = c[k];
    return restitute_material_prony(c[0], 0, n, tau, g, nu, material, error);
}

/* The solids of a set, one a group; with the partner's where it has a material of its own. */
static int make_solids(const struct rst_fit_data *d, const struct rst_fit_model *m, const double *constants,
                       restitute_material **solids)
{
    int status = RESTITUTE_OK;
    for (size_t g = 0; g < d->groups && status >= 0; g++) {
        const restitute_material *partner = d->scene[d->first[g]].material;
        restitute_material *own = NULL;
        status = rst_fit_solid(d, m, constants, shift_of(d, m, constants, d->at[d->first[g]]), &own, NULL);
        if (status >= 0 && partner) {
            status = restitute_material_effective(own, partner, &solids[g], NULL);
            restitute_material_destroy(own);
        } else
            solids[g] = own;
    }
    return status;
}

static void make_scenes(const struct rst_fit_model *m, const double *constants, size_t n,
                        const struct rst_fit_impact *impacts, restitute_material *const *solids,
                        restitute_scene *scenes, restitute_result *results)
{
    for (size_t i = 0; i < n; i++) {
        scenes[i] = impacts[i].scene;
        scenes[i].material = solids[impacts[i].group];
        if (isnan(scenes[i].friction)) scenes[i].friction = m->friction < m->count ? constants[m->friction] : 0;
        restitute_result_init(&results[i]);
        results[i].ez = NAN;
    }
}

static int interrupted(const restitute_fit_options *o)
{
    return o->interrupted && o->interrupted(o->interrupted_data);
}

/* n impacts for every set of constants; one that failed has ez = NaN. */
static int solve(struct rst_fit_data *d, const struct rst_fit_model *m, size_t sets, const double *constants, size_t n,
                 const struct rst_fit_impact *impacts, restitute_result *results)
{
    restitute_scene *scenes = calloc(sets * n, sizeof *scenes);
    restitute_material **solids = calloc(sets * d->groups, sizeof *solids);
    int *statuses = malloc(sets * n * sizeof *statuses);
    int status = scenes && solids && statuses ? RESTITUTE_OK : RESTITUTE_ERROR_MEMORY;
    for (size_t s = 0; s < sets && status >= 0; s++) {
        const double *c = constants + s * m->count;
        status = make_solids(d, m, c, solids + s * d->groups);
        if (status >= 0) make_scenes(m, c, n, impacts, solids + s * d->groups, scenes + s * n, results + s * n);
    }
    for (size_t first = 0, most = sets * n; first < most && status >= 0; first += BATCH) {
        const size_t count = most - first < BATCH ? most - first : BATCH;
        status = interrupted(&d->options) ? RESTITUTE_ERROR_INTERRUPTED
                                          : restitute_solve_scene_many(count, scenes + first, &d->solver,
                                                                       results + first, statuses + first, NULL);
        d->impacts += (int64_t)count;
        if (status != RESTITUTE_ERROR_MEMORY && status != RESTITUTE_ERROR_INTERRUPTED) status = RESTITUTE_OK;
    }
    for (size_t i = 0; solids && i < sets * d->groups; i++)
        restitute_material_destroy(solids[i]);
    free(scenes);
    free(solids);
    free(statuses);
    return status;
}

int rst_fit_solve(struct rst_fit_data *d, const struct rst_fit_model *m, size_t sets, const double *constants,
                  struct rst_fit_values *values)
{
    struct rst_fit_impact *impacts = malloc(d->needed * sizeof *impacts);
    restitute_result *solved = malloc(sets * d->needed * sizeof *solved), *all = calloc(d->needed, sizeof *all);
    size_t n = 0;
    for (size_t k = 0; impacts && k < d->needed; k++)
        if (!rst_fit_passed_over(d, k)) impacts[n++] = d->impact[k];
    const int status =
        impacts && solved && all ? solve(d, m, sets, constants, n, impacts, solved) : RESTITUTE_ERROR_MEMORY;
    for (size_t s = 0; s < sets && status >= 0; s++) {
        for (size_t k = 0, next = s * n; k < d->needed; k++)
            if (!rst_fit_passed_over(d, k)) all[k] = solved[next++];
        rst_fit_values(d, all, values + s * d->n);
    }
    free(impacts);
    free(solved);
    free(all);
    return status;
}

int rst_fit_solve_points(struct rst_fit_data *d, const struct rst_fit_model *m, const double *constants,
                         restitute_result *results)
{
    struct rst_fit_impact *impacts = calloc(d->n, sizeof *impacts);
    for (size_t i = 0; impacts && i < d->n; i++)
        impacts[i].scene = d->scene[i], impacts[i].group = d->group[i];
    const int status = impacts ? solve(d, m, 1, constants, d->n, impacts, results) : RESTITUTE_ERROR_MEMORY;
    free(impacts);
    return status;
}

double rst_fit_residual(const struct rst_fit_data *d, size_t row, const struct rst_fit_values *values)
{
    const struct rst_fit_row *r = &d->row[row];
    const double value = values[r->point].of[r->kind];
    if (rst_fit_passed_over(d, d->place[r->point].first)) return 0;
    if (isnan(values[r->point].of[RST_FIT_EZ]) || !isfinite(value)) return 1e3; /* not solved, or sunk in: reject */
    return (value - r->measured) / r->sigma;
}
