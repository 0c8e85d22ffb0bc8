/* Figures and their impacts.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sweep_figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"

static const double solid_sphere = 7.0 / 6.0; /* chi, incompressible */

const struct sweep_figure sweep_figures[] = {
    {"fig4", "Normal restitution, Kelvin-Voigt", SWEEP_EZ, 1, 120, {0}, 0.01, 100},
    {"fig5", "Tangential restitution, Kelvin-Voigt", SWEEP_CONTOURS, 76, 61, {0}, 0.01, 100},
    {"fig6", "Normal restitution, standard solid", SWEEP_EZ, 6, 48, {0, 0.01, 0.0825, 0.3, 1, 3}, 0.01, 100},
    {"fig7", "Tangential restitution without slip", SWEEP_NO_SLIP, 5, 48, {0, 0.01, 0.0825, 0.3, 1}, 0.01, 100},
    {"fig8", "Tangential restitution, γ = 0.0825", SWEEP_CONTOURS, 76, 61, {0.0825}, 0.01, 100},
    {"fig9", "Tangential restitution, γ = 1", SWEEP_CONTOURS, 76, 61, {1}, 0.01, 100},
    {"fig10", "From which ψ on the contact slips to the end", SWEEP_PSI_C, 4, 16, {0, 0.0825, 0.3, 1}, 0.01, 30},
    {"fig11",
     "The formula (31) beside simulations of growing resolution",
     SWEEP_PSI_C_ERROR,
     4,
     16,
     {8, 16, 32, 64},
     0.01,
     10},
    {"maxwell", "Maxwell body", SWEEP_MAXWELL, 4, 48, {0.5, 1, 2, 3}, 0.1, 100},
    {"temperature",
     "Restitution at six temperatures",
     SWEEP_TEMPERATURE,
     6,
     41,
     {-40, -20, 0, 25, 50, 80},
     1e-3,
     100},
    {"tangent",
     "Normal restitution over the loss tangent",
     SWEEP_TANGENT,
     7,
     40,
     {0, 0.01, 0.1, 0.3, 1, 10, NAN},
     0.01,
     100},
    {"friction", "What friction does to the tangential energy", SWEEP_FRICTION, 5, 48, {0, 0.1, 0.3, 1, 3}, 0.05, 6},
};
const size_t sweep_figure_count = sizeof sweep_figures / sizeof *sweep_figures;

const struct sweep_figure *sweep_figure_named(const char *name)
{
    for (size_t i = 0; i < sweep_figure_count; i++)
        if (strcmp(name, sweep_figures[i].name) == 0) return &sweep_figures[i];
    return NULL;
}

/* Williams, Landel and Ferry, with the constants of polyisobutylene for 298 K of Ferry, Viscoelastic Properties of
 * Polymers, table 11-II. The material file is for 25 degrees Celsius. */
double sweep_time_shift(double temperature)
{
    const double c1 = 8.61, c2 = 200.4, difference = temperature - 25;
    return pow(10, -c1 * difference / (c2 + difference));
}

struct sweep_numbers sweep_numbers_at(const struct sweep_figure *figure, size_t curve, double x, double psi)
{
    const double value = figure->curve[figure->kind == SWEEP_CONTOURS ? 0 : curve]; /* a curve is a psi there */
    struct sweep_numbers n = {.chi = solid_sphere, .psi = psi, .delta1 = x, .gamma = value};
    switch (figure->kind) {
    case SWEEP_NO_SLIP:
        n.psi = 0;
        break;
    case SWEEP_CONTOURS: /* 0 to 5 by 1/15, with the kinks at 1, 7/3 and 11/3 */
        n.psi = (double)curve / 15;
        break;
    case SWEEP_PSI_C_ERROR: /* a curve is a resolution */
        n.gamma = 0.3;
        break;
    case SWEEP_MAXWELL:
        n.relaxation = x;
        n.psi = value;
        break;
    case SWEEP_TANGENT:
        if (isnan(n.gamma)) n.relaxation = x;
        break;
    case SWEEP_FRICTION:
        n.psi = x;
        n.delta1 = value;
        n.gamma = 0.3;
        break;
    default:
        break;
    }
    return n;
}

restitute_impact sweep_impact(const struct sweep_numbers *numbers, restitute_material **solid)
{
    restitute_impact impact;
    restitute_impact_init(&impact);
    *solid = NULL;
    impact.chi = numbers->chi;
    impact.psi = numbers->psi;
    impact.delta1 = numbers->delta1;
    impact.gamma = numbers->gamma;
    if (numbers->relaxation > 0 && restitute_material_maxwell(1, numbers->relaxation, 0.5, solid, NULL) == RESTITUTE_OK)
        impact.material = *solid;
    return impact;
}

restitute_options sweep_fine_options(const struct settings *settings)
{
    restitute_options options = settings->solver;
    options.method = restitute_method_sync();
    options.tolerance = fmax(1e-8, 0.01 * options.tolerance);
    options.elements = 0;
    options.time_step = 0;
    return options;
}

/* A steel ball, so that the speed alone is left. */
static void sample_of_temperature(const struct sweep *sweep, double speed, struct sweep_sample *sample)
{
    static const struct {
        enum field field;
        double number;
    } ball[] = {{FIELD_RADIUS1, 0.005}, {FIELD_DENSITY1, 7800}, {FIELD_FRICTION, 0.3}, {FIELD_ANGLE, 30}};
    struct values *v = &sample->values;
    *v = values_none();
    v->material = sweep->material;
    for (size_t i = 0; i < sizeof ball / sizeof *ball; i++)
        v->given[ball[i].field] = true, v->number[ball[i].field] = ball[i].number;
    v->given[FIELD_SPEED] = v->given[FIELD_TIME_SHIFT] = true;
    v->number[FIELD_SPEED] = speed / cos(30 * 3.14159265358979323846 / 180);
    v->number[FIELD_TIME_SHIFT] = sweep_time_shift(sweep->figure->curve[sample->curve]);
    sample->numbers = (struct sweep_numbers){NAN, NAN, NAN, NAN, 0};
}

double sweep_along(const struct sweep_figure *figure, double part)
{
    return figure->kind == SWEEP_FRICTION ? figure->low + (figure->high - figure->low) * part
                                          : figure->low * pow(figure->high / figure->low, part);
}

/* Along the axis points lie at random, one in each of equal parts; those of contours, and those
 * that are compared with each other, are regular. */
static void draw_sample(const struct sweep *sweep, size_t curve, size_t point, uint64_t *state,
                        struct sweep_sample *sample)
{
    const struct sweep_figure *f = sweep->figure;
    const double psi = random_in(state, 0.2, 5), where = random_in(state, 0, 1);
    const bool regular = f->kind == SWEEP_CONTOURS || f->kind == SWEEP_TEMPERATURE || f->kind == SWEEP_PSI_C_ERROR;
    const double part = regular ? (double)point / (double)(f->points - 1) : ((double)point + where) / (double)f->points;
    const double x = sweep_along(f, part);
    sample->curve = curve;
    sample->ez = sample->ex = NAN;
    if (f->kind == SWEEP_TEMPERATURE) {
        sample_of_temperature(sweep, x, sample);
        return;
    }
    sample->numbers = sweep_numbers_at(f, curve, x, psi);
    /* None close to the limit of rebound, 0.312: up to about 0.32 the library may report none, since e_z is so small, and
     * further up contacts last for very long. */
    if (sample->numbers.relaxation > 0.3 && sample->numbers.relaxation < 0.4) sample->numbers.relaxation *= 4.0 / 3;
    sweep_draw(state, &sample->numbers, &sample->values);
}

bool sweep_solve(const struct settings *settings, size_t count, const struct sweep_numbers *numbers,
                 restitute_result *results, struct reason *why)
{
    const restitute_options options = sweep_fine_options(settings);
    restitute_impact *impacts = allocate(count, sizeof *impacts);
    restitute_material **solids = allocate(count, sizeof(restitute_material *));
    restitute_error error;
    for (size_t i = 0; i < count; i++) {
        impacts[i] = sweep_impact(&numbers[i], &solids[i]);
        restitute_result_init(&results[i]);
        results[i].ez = results[i].ex = results[i].contact_time = NAN;
    }
    const int status = restitute_solve_many(count, impacts, &options, results, NULL, &error);
    for (size_t i = 0; i < count; i++)
        restitute_material_destroy(solids[i]);
    free(impacts);
    free(solids);
    return status >= 0 || refuse(why, "%s", error.message);
}

/* One that fails stays NaN, and so fails the check of the scatter. */
static void solve_samples(struct sweep *sweep)
{
    struct reason why;
    struct sweep_numbers *numbers = allocate(sweep->count, sizeof *numbers);
    restitute_result *results = allocate(sweep->count, sizeof *results);
    for (size_t i = 0; i < sweep->count; i++)
        numbers[i] = sweep->samples[i].numbers;
    if (!sweep_solve(sweep->settings, sweep->count, numbers, results, &why))
        complain("%s, from numbers alone: %s", sweep->figure->name, why.text);
    for (size_t i = 0; i < sweep->count; i++)
        sweep->samples[i].ez = results[i].ez, sweep->samples[i].ex = results[i].ex;
    free(numbers);
    free(results);
}

void sweep_plan(struct sweep *sweep)
{
    const struct sweep_figure *f = sweep->figure;
    uint64_t state = (uint64_t)sweep->settings->seed * 1000 + (uint64_t)(f - sweep_figures);
    sweep->count = f->curves * f->points;
    sweep->samples = allocate(sweep->count, sizeof *sweep->samples);
    for (size_t i = 0; i < sweep->count; i++)
        draw_sample(sweep, i / f->points, i % f->points, &state, &sweep->samples[i]);
    if (f->kind != SWEEP_TEMPERATURE) solve_samples(sweep);
}

static void set_number(struct cases *cases, size_t row, size_t column, bool given, double number)
{
    cases_set(cases, row, column, given && !isnan(number) ? number_text(number).text : "");
}

/* Inputs that no sample has get no column. */
static size_t inputs_of(const struct sweep *sweep, enum field *inputs)
{
    size_t count = 0;
    for (enum field field = FIELD_LAST_DIMENSIONLESS + 1; field < FIELD_COUNT; field++) {
        bool any = false;
        for (size_t i = 0; i < sweep->count; i++)
            any |= sweep->samples[i].values.given[field];
        if (any) inputs[count++] = field;
    }
    return count;
}

void sweep_cases(const struct sweep *sweep, struct cases *cases)
{
    enum { NOTES = 8 };
    const char *names[CASES_MADE_COLUMNS] = {"curve", "chi",   "psi",        "delta1",
                                             "gamma", "tau_T", "ez_numbers", "ex_numbers"};
    enum field inputs[FIELD_COUNT];
    const size_t last = NOTES + inputs_of(sweep, inputs);
    const bool file = sweep->figure->kind == SWEEP_TEMPERATURE;
    for (size_t k = NOTES; k < last; k++)
        names[k] = field_rules[inputs[k - NOTES]].column;
    names[last] = file ? "material" : "partner";
    cases_make(cases, sweep->count, last + 1, names, NOTES);
    for (size_t i = 0; i < sweep->count; i++) {
        const struct sweep_sample *s = &sweep->samples[i];
        const struct sweep_numbers *n = &s->numbers;
        const bool maxwell = n->relaxation > 0;
        const double notes[NOTES] = {(double)s->curve,
                                     n->chi,
                                     n->psi,
                                     maxwell ? NAN : n->delta1,
                                     maxwell ? NAN : n->gamma,
                                     maxwell ? n->relaxation : NAN,
                                     s->ez,
                                     s->ex};
        for (size_t k = 0; k < NOTES; k++)
            set_number(cases, i, k, true, notes[k]);
        for (size_t k = NOTES; k < last; k++)
            set_number(cases, i, k, s->values.given[inputs[k - NOTES]], s->values.number[inputs[k - NOTES]]);
        cases_set(cases, i, last, file ? sweep->material : partner_word(&s->values));
    }
}
