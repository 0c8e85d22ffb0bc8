/* The energy ledger of the method cvode (theory.md, 8): the run is repeated. Dissipation and the
 * energy of elements that leave are added up by the trapezoidal rule over CVODE's steps and over
 * the elements that leave.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/gross_slip.h"
#include "base/report.h"
#include "cvode/solve.h"

/* Largest and smallest number of elements of a ledger. It is a check, and needs no more even if the
 * pair did. */
static const int64_t most_ledger_elements = 1024, fewest_ledger_elements = 256;

/* The elements that leave in a step give up what they hold by and by. */
static const double fewest_ledger_steps = 2000;

/* The sums, and the values at the last step. */
struct bookkeeper {
    struct rst_ledger ledger;
    double rate[3], square;
    double *held_z, *held_x, *before_z, *before_x;
    int64_t inside;
};

static double width(const struct elements *e, int64_t n, int64_t i, double radius)
{
    const double outer = i + 1 < n ? e->x[i + 1] : radius, inner = i > 0 ? e->x[i - 1] : 0;
    return 0.5 * (outer - inner);
}

static int64_t count_inside(const struct run *run)
{
    int64_t n = 0;
    while (n < run->scene.n_nodes && run->elements.x[n] * run->elements.x[n] < run->contact.square)
        n++;
    return n;
}

/* Energies in units of the impact energy over those of elements; of x at the speed U'. */
static double of_work_z(void)
{
    return 2 * rst_mass_factor();
}

static double of_work_x(const struct run *run)
{
    return 4 * rst_mass_factor() * run->setup->problem->chi;
}

/* Elements that left in this step: what they held when the edge passed them. */
static void post_left(const struct run *run, struct bookkeeper *keeper, int64_t inside)
{
    const struct elements *e = &run->elements;
    const double z = of_work_z(), x = of_work_x(run);
    const double fallen = keeper->square - run->contact.square;
    for (int64_t i = inside; i < keeper->inside; i++) {
        const double share = fallen > 0 ? (keeper->square - e->x[i] * e->x[i]) / fallen : 1;
        const double part = fmax(0, fmin(1, share)), w = width(e, run->scene.n_nodes, i, run->setup->radius);
        keeper->ledger.left_z += z * w * (keeper->before_z[i] + part * (keeper->held_z[i] - keeper->before_z[i]));
        keeper->ledger.left_x += x * w * (keeper->before_x[i] + part * (keeper->held_x[i] - keeper->before_x[i]));
    }
}

static void post(struct run *run, double from, double to)
{
    struct bookkeeper *keeper = run->observer;
    const struct rst_solid *s = &run->setup->problem->solid;
    const struct elements *e = &run->elements;
    const struct recovery *r = &run->recovery;
    double rate[3];
    const double z = of_work_z(), x = of_work_x(run);
    const double half = 0.5 * (to - from);
    rst_run_evaluate(run);
    memcpy(keeper->before_z, keeper->held_z, (size_t)run->scene.n_nodes * sizeof(double));
    memcpy(keeper->before_x, keeper->held_x, (size_t)run->scene.n_nodes * sizeof(double));
    rst_cvode_energy_rates(&run->scene, s->g, s->tau, &run->contact, e->x, e->entry, e->past, e->motion, e->shift, e->c,
                           e->b, r->rate, r->u, r->v, e->amplitude, run->shears, keeper->inside, to, run->y, rate,
                           keeper->held_z, keeper->held_x);
    keeper->ledger.viscous_z += z * half * (keeper->rate[0] + rate[0]);
    keeper->ledger.viscous_x += x * half * (keeper->rate[1] + rate[1]);
    keeper->ledger.friction_x += x * half * (keeper->rate[2] + rate[2]);
    const int64_t inside = count_inside(run);
    if (run->scene.restitution) post_left(run, keeper, inside);
    memcpy(keeper->rate, rate, sizeof rate);
    keeper->square = run->contact.square;
    keeper->inside = inside;
}

/* What friction takes before the contact sticks; without sticking, to the end. */
static void add_gross_slip(const struct rst_problem *problem, double end, struct rst_ledger *ledger)
{
    if (problem->mode == RST_FRICTIONLESS)
        ledger->viscous_x = ledger->left_x = 0;
    else if (problem->mode == RST_GROSS_SLIP)
        ledger->friction_x += rst_gross_slip_work(problem, end);
}

/* A sphere that has sunk in: nothing is left of its energy at the end of time, neither in it nor in
 * springs, which all relax. */
static void sink(const struct rst_problem *problem, struct rst_outcome *outcome)
{
    struct rst_ledger *ledger = &outcome->ledger;
    const double before = problem->shear_speed, after = outcome->shear_velocity;
    *ledger = (struct rst_ledger){.viscous_z = 1};
    if (problem->mode == RST_FRICTIONLESS) return;
    if (problem->mode == RST_GROSS_SLIP)
        ledger->friction_x =
            rst_gross_slip_work(problem, rst_never_sticks(problem, 0) ? 0 : rst_end_of_gross_slip(problem));
    ledger->viscous_x = before * before - after * after - ledger->friction_x;
}

/* Where the slip at the edge is narrower than an element, what friction takes and what elements
 * hold as they leave are mistaken for each other. */
static int remark_residual(const struct rst_problem *problem, const struct rst_outcome *outcome, restitute_error *error)
{
    static const double remarkable = 0.01;
    const struct rst_ledger *l = &outcome->ledger;
    const double before = problem->shear_speed * problem->shear_speed, after = outcome->shear_velocity;
    const double missed = 1 - (after * after + l->friction_x + l->viscous_x + l->left_x) / before;
    if (!(fabs(missed) > remarkable) || problem->mode == RST_FRICTIONLESS) return RESTITUTE_OK;
    return rst_report(error, RESTITUTE_OK,
                      "ledger: its tangential parts miss %.2g of the energy, slip is too narrow; take the method sync",
                      missed);
}

int rst_cvode_ledger(const struct run_setup *setup, struct cvode_memory *memory, struct rst_outcome *outcome,
                     restitute_error *error)
{
    struct run_setup all = *setup;
    struct bookkeeper keeper = {.ledger = {0}};
    struct run run = {.observe = post, .observer = &keeper};
    if (outcome->sunk) {
        sink(setup->problem, outcome);
        return RESTITUTE_OK;
    }
    all.n_nodes = outcome->elements > most_ledger_elements ? most_ledger_elements : outcome->elements;
    if (all.n_nodes < fewest_ledger_elements) all.n_nodes = fewest_ledger_elements;
    all.radius = outcome->max_contact_radius;
    all.rebound = -outcome->velocity;
    all.longest_step = outcome->contact_time / fewest_ledger_steps;
    all.budget = INT64_MAX;
    all.until = INFINITY;
    keeper.held_z = calloc(4 * (size_t)all.n_nodes, sizeof(double));
    if (!keeper.held_z) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the ledger");
    keeper.held_x = keeper.held_z + all.n_nodes;
    keeper.before_z = keeper.held_x + all.n_nodes;
    keeper.before_x = keeper.before_z + all.n_nodes;
    const int status = rst_run_follow(&run, &all, &memory->trace, NULL);
    add_gross_slip(setup->problem, run.shears ? run.slip_end : outcome->velocity, &keeper.ledger);
    if (status == RESTITUTE_OK) outcome->ledger = keeper.ledger;
    rst_run_release(&run);
    free(keeper.held_z);
    return status ? rst_report(error, status, "%s", run.text) : remark_residual(setup->problem, outcome, error);
}
