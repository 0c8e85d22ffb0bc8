/* The energy ledger of the method cvode (theory.md, 8): the run is repeated, and the balances of
 * its elements are added up, by the trapezoidal rule over CVODE's steps and over the elements.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdlib.h>

#include "base/gross_slip.h"
#include "base/report.h"
#include "cvode/elements.h"
#include "cvode/solve.h"

/* Largest and smallest number of elements of a ledger. It is a check, and needs no more even if the
 * pair did. */
static const int64_t most_ledger_elements = 1024, fewest_ledger_elements = 256;

/* Steps of a ledger: so many over psi, as slip is as narrow, but not fewer and not more than these.
 * Where the solid relaxes within a step, what friction and dashpots take is mistaken for each
 * other. */
static const double ledger_steps = 150, fewest_ledger_steps = 5000, most_ledger_steps = 50000;

/* The sums over elements, whose energies are those at the last step. */
struct bookkeeper {
    struct rst_ledger sum;
    struct element_energy *before, *now;
    double square, shift;
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

/* What becomes of an element that the edge passes with a stress q while its limit f falls at this
 * rate. It slips while f falls from q to 0. For the work of friction its creep after a third of
 * that time counts, for the way it slips the creep after half of it: exact for a spring alone and
 * for a dashpot alone. Friction is 8 % low at most for the two in parallel, 23 % in series. */
static struct rst_ledger released(const struct rst_solid *s, const struct element_energy *e, double rate)
{
    const double time = fmax(1e-100, rate > 1e-100 ? fabs(e->q) / rate : 0);
    double third = s->g_inf + 3 * s->eta / time, half = s->g_inf + 2 * s->eta / time, springs = s->g_inf;
    for (int64_t k = 0; k < s->n_terms; k++) {
        const double viscosity = s->g[k] * s->tau[k] / time;
        third -= 3 * viscosity * expm1(-time / s->tau[k] / 3);
        half -= 2 * viscosity * expm1(-time / s->tau[k] / 2);
        springs += s->g[k] * exp(-time / s->tau[k]);
    }
    const double slip = e->q / half;
    return (struct rst_ledger){.friction_x = 0.5 * e->q * e->q / third,
                               .left_x = fmax(0, e->held_x - e->q * slip + 0.5 * springs * slip * slip)};
}

/* An element from one step to the next, or for that part of it until it leaves: the trapezoidal
 * rule in time. Where it slips, its balance tells what friction takes. */
static struct rst_ledger follow(const struct rst_solid *s, const struct element_energy *was,
                                const struct element_energy *is, double time, double shift, double part, int leaves,
                                int slips)
{
    const struct element_energy *const end = leaves ? was : is; /* beyond the edge it would run backward */
    const int stuck = was->motion == RST_ELEMENT_STICKS, sticks = stuck && is->motion == RST_ELEMENT_STICKS;
    struct rst_ledger spent = {.viscous_z = 0.5 * part * time * (was->viscous_z + end->viscous_z),
                               .viscous_x = 0.5 * part * time * (was->viscous_x + end->viscous_x),
                               .left_z = leaves ? was->held_z + part * (is->held_z - was->held_z) : 0};
    double held = is->held_x;
    if (leaves && slips) {
        const double rate = time > 0 ? (was->f - is->f) / time : 0;
        const struct rst_ledger before = released(s, was, rate), after = released(s, is, rate);
        const double passed = stuck && !sticks ? 0 : part; /* what slips at the end has been released */
        held = before.left_x + passed * (after.left_x - before.left_x);
        spent.friction_x = before.friction_x + passed * (after.friction_x - before.friction_x);
    } else if (leaves)
        held = was->held_x + part * (is->held_x - was->held_x);
    if (leaves) spent.left_x = held;
    if (!slips || (!leaves && sticks)) return spent;
    const double lost = 0.5 * part * (was->q + is->q) * shift - (held - was->held_x);
    if (leaves && stuck) spent.viscous_x = lost - spent.friction_x;
    spent.viscous_x = fmin(fmax(0, spent.viscous_x), fmax(0, lost)); /* a step may be longer than a relaxation */
    spent.friction_x = lost - spent.viscous_x;
    return spent;
}

static void post(struct run *run, double from, double to)
{
    struct bookkeeper *keeper = run->observer;
    const struct rst_solid *s = &run->setup->problem->solid;
    const struct elements *e = &run->elements;
    const struct recovery *r = &run->recovery;
    const double shift = run->shears ? run->y[2 + 2 * s->n_terms] : 0;
    rst_run_rates(run, run->time, run->y, run->scratch);
    const int64_t inside = count_inside(run), n = run->scene.restitution ? keeper->inside : inside;
    rst_cvode_element_energies(&run->scene, s->g, s->tau, e->x, e->entry, e->past, e->motion, e->shift, e->c, e->b,
                               r->rate, r->u, r->v, e->amplitude, run->shears,
                               run->scene.restitution ? n : run->scene.n_nodes, to, run->y, keeper->now);
    for (int64_t i = 0; i < n; i++) {
        const double fallen = keeper->square - run->contact.square, to_fall = keeper->square - e->x[i] * e->x[i];
        const double part = i < inside || !(fallen > to_fall) ? 1 : fmax(0, to_fall / fallen);
        const struct rst_ledger spent =
            follow(s, &keeper->before[i], &keeper->now[i], to - fmax(from, fmin(to, e->entry[i])),
                   shift - keeper->shift, part, i >= inside, run->shears && run->setup->problem->mode != RST_NO_SLIP);
        const double w = width(e, run->scene.n_nodes, i, run->setup->radius);
        keeper->sum.viscous_z += w * spent.viscous_z;
        keeper->sum.left_z += w * spent.left_z;
        keeper->sum.viscous_x += w * spent.viscous_x;
        keeper->sum.friction_x += w * spent.friction_x;
        keeper->sum.left_x += w * spent.left_x;
    }
    struct element_energy *const swapped = keeper->before;
    keeper->before = keeper->now;
    keeper->now = swapped;
    keeper->square = run->contact.square;
    keeper->shift = shift;
    keeper->inside = inside;
}

/* The sums in units of the impact energy over those of elements; of x at the speed U'. None is
 * negative by its own error. */
static struct rst_ledger in_units(const struct rst_problem *problem, struct rst_ledger sum)
{
    const double z = 2 * rst_mass_factor(), x = 2 * z * problem->chi;
    return (struct rst_ledger){.viscous_z = z * sum.viscous_z,
                               .left_z = z * sum.left_z,
                               .viscous_x = x * sum.viscous_x,
                               .friction_x = fmax(0, x * sum.friction_x),
                               .left_x = fmax(0, x * sum.left_x)};
}

/* What friction takes before the contact sticks; without sticking, to the end. */
static void add_gross_slip(const struct rst_problem *problem, double end, struct rst_ledger *ledger)
{
    if (problem->mode == RST_FRICTIONLESS)
        ledger->viscous_x = ledger->left_x = 0;
    else if (problem->mode == RST_GROSS_SLIP)
        ledger->friction_x += rst_gross_slip_work(problem, end);
}

int rst_cvode_ledger(const struct run_setup *setup, struct cvode_memory *memory, struct rst_outcome *outcome,
                     restitute_error *error)
{
    struct run_setup all = *setup;
    struct bookkeeper keeper = {.sum = {0}};
    struct run run = {.observe = post, .observer = &keeper};
    /* so slow a rebound is an error of the run; this one, of other steps, may not end */
    if (outcome->sunk || -outcome->velocity < setup->rest_speed) {
        outcome->ledger = rst_sunk_ledger(setup->problem, outcome->shear_velocity);
        return RESTITUTE_OK;
    }
    all.n_nodes = outcome->elements > most_ledger_elements ? most_ledger_elements : outcome->elements;
    if (all.n_nodes < fewest_ledger_elements) all.n_nodes = fewest_ledger_elements;
    all.radius = outcome->max_contact_radius;
    all.rebound = -outcome->velocity;
    all.longest_step = outcome->contact_time /
                       fmin(most_ledger_steps, fmax(fewest_ledger_steps, ledger_steps / setup->problem->shear_speed));
    all.budget = INT64_MAX;
    all.until = INFINITY;
    struct element_energy *const memory_of = calloc(2 * (size_t)all.n_nodes, sizeof *memory_of);
    if (!memory_of) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for the ledger");
    keeper.before = memory_of;
    keeper.now = memory_of + all.n_nodes;
    const int status = rst_run_follow(&run, &all, &memory->trace, NULL);
    keeper.sum = in_units(setup->problem, keeper.sum);
    add_gross_slip(setup->problem, run.shears ? run.slip_end : outcome->velocity, &keeper.sum);
    if (status == RESTITUTE_OK) outcome->ledger = keeper.sum;
    rst_run_release(&run);
    free(memory_of);
    return status ? rst_report(error, status, "%s", run.text) : RESTITUTE_OK;
}
