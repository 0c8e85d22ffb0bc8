/* Time stepping of the impact: velocity Verlet for the sphere (5); in each step the normal problem
 * for p, then the tangential one for tau (docs/bem.md). All is of second order in the step.
 *   D'' = -(15/64) int p dA,   U'' = -(15/32) chi int tau dA,   u_x = (3/2) U where it sticks.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "bem/run.h"

#include <math.h>
#include <string.h>

#include "bem/stepper.h"

static const double pull = 1.5;

/* int p dA is 8 int f dX. */
static double normal_mass_factor(void)
{
    return rst_mass_factor() / 8;
}

static double shear_mass_factor(const struct bem_setup *setup)
{
    return rst_mass_factor() / 4 * setup->problem->chi;
}

/* Contact is sought this many cells beyond its extrapolated edge. */
static const double reach = 3;

/* Energy conservation bounds velocities by those at first touch. Larger ones mean that the step is
 * unstable. */
static const double most_speed = 1.05;

static void swap_in(double **before, double **now, double **new)
{
    double *oldest = *before;
    *before = *now;
    *now = *new;
    *new = oldest;
}

/* Sizes with fast transforms; not too many of them. */
static int64_t size_for(double cells, int64_t most)
{
    static const int64_t sizes[] = {8, 12, 16, 20, 24, 30, 36, 40, 48, 54, 60, 64, 72, 80, 90, 96, 108, 120, 128};
    static const int count = sizeof sizes / sizeof *sizes;
    int64_t doubling = 1;
    while (doubling * sizes[count - 1] < cells)
        doubling *= 2;
    for (int i = 0; i < count; i++)
        if (doubling * sizes[i] >= cells) return doubling * sizes[i] < most ? doubling * sizes[i] : most;
    return most;
}

/* Gap and s of an elastic solid on a larger part of the grid, from the tractions of the last two
 * steps. */
static void look_back(struct bem_stepper *s, const double *p, const double *tau, const struct bem_motion *motion,
                      double *gap, double *s_field)
{
    const int64_t ld = s->f.m, m = s->all->m;
    const double c = s->solid->c;
    rst_bem_normal_target(ld, m, s->setup->spacing, motion->depth, -1, s->f.h, gap);
    rst_bem_convolve(s->all, BEM_NORMAL, ld, p, s->f.f_new);
    rst_bem_add_scaled(ld, m, c, s->f.f_new, gap);
    rst_bem_convolve(s->all, BEM_SHEAR, ld, tau, s->f.f_new);
    for (int64_t j = 0; j < m; j++)
        for (int64_t i = j * ld; i < j * ld + m; i++)
            s_field[i] = c * s->f.f_new[i] - pull * motion->shift;
    s->run->convolutions += 2;
    s->run->updates += 8 * m * m;
}

/* Clear everything outside the first m cells. */
static void clear_beyond(int64_t ld, int64_t m, double *x)
{
    for (int64_t j = 0; j < m; j++)
        memset(x + j * ld + m, 0, (size_t)(ld - m) * sizeof *x);
    memset(x + m * ld, 0, (size_t)((ld - m) * ld) * sizeof *x);
}

/* Choose the part of the grid for the next step, at least `least` wide. A solid with memory keeps
 * it on the whole grid: where contact will be, and where it was, for the ledger. A ledger does not
 * change the bits of the result. */
static int choose_part(struct bem_stepper *s, int64_t least)
{
    const double growth = rst_bem_radius_of(s->motion.contact) - rst_bem_radius_of(s->before.contact);
    const double wanted = (rst_bem_radius_of(s->motion.contact) + fmax(0, growth)) / s->setup->spacing + reach;
    int64_t m = size_for(fmax(wanted, (double)least), s->f.m);
    const int64_t m_before = s->near ? s->near->m : 0;
    const int shrinks = growth < 0 && s->motion.contact < 0.98 * s->run->max_area;
    if (m < m_before && !shrinks) m = m_before;
    s->near = rst_bem_memory_transform(s->memory, m);
    if (!s->near) return 1;
    if (m < m_before) {
        double *fields[] = {s->f.p_before, s->f.p_new, s->f.tau_before, s->f.tau_new};
        for (int i = 0; i < 4; i++)
            clear_beyond(s->f.m, m, fields[i]);
    }
    s->all = rst_bem_is_elastic(s->solid) ? s->near : rst_bem_memory_transform(s->memory, s->f.m);
    if (m > m_before && rst_bem_is_elastic(s->solid) && s->run->steps > 0 && !s->setup->normal_only) {
        look_back(s, s->f.p_before, s->f.tau_before, &s->before, s->f.gap_before, s->f.s_before);
        look_back(s, s->f.p, s->f.tau, &s->motion, s->f.gap, s->f.s);
    }
    return !s->all;
}

/* The normal problem, on a larger part of the grid if the contact reaches the border of the present
 * part. */
static enum bem_end press(struct bem_stepper *s, double depth, double shift)
{
    for (;;) {
        const enum bem_end end = rst_bem_solve_normal(s, depth, shift);
        if (end != BEM_OUTGREW || s->near->m == s->f.m) return end;
        if (choose_part(s, s->near->m + s->near->m / 8 + 2)) return BEM_NO_MEMORY;
    }
}

static void add_work(struct bem_stepper *s, const struct bem_motion *b, const struct bem_motion *q)
{
    s->run->work.normal += 0.5 * (b->force + q->force) * (q->depth - b->depth);
    s->run->work.shear += 0.5 * (b->shear_force + q->shear_force) * (q->shift - b->shift);
    for (int64_t i = 0; s->setup->keep_ledger && i < s->f.m * s->f.m; i++)
        s->f.touched[i] += s->f.p_new[i];
}

static enum bem_end advance(struct bem_stepper *s)
{
    const struct bem_setup *setup = s->setup;
    const int euler = setup->variant.explicit_euler;
    const struct bem_motion b = s->motion;
    struct bem_motion q = b;
    const double h = setup->step, x_factor = shear_mass_factor(setup), z_factor = normal_mass_factor();
    const double a = -z_factor * b.force, c = -x_factor * b.shear_force;
    enum bem_end end;
    q.depth += h * (b.velocity + (euler ? 0 : h / 2 * a));
    q.shift += h * (b.shear_velocity + (euler ? 0 : h / 2 * c));
    if (choose_part(s, 0)) return BEM_NO_MEMORY;
    end = press(s, q.depth, q.shift);
    if (end == BEM_REBOUND && !setup->normal_only && setup->problem->mode != RST_FRICTIONLESS)
        end = rst_bem_solve_shear(s, q.shift);
    if (end != BEM_REBOUND) return end;
    q.force = s->motion.force, q.contact = s->motion.contact;
    q.shear_force = s->motion.shear_force, q.stick = s->motion.stick;
    q.velocity -= z_factor * h * (euler ? q.force : 0.5 * (b.force + q.force));
    q.shear_velocity -= x_factor * h * (euler ? q.shear_force : 0.5 * (b.shear_force + q.shear_force));
    q.time += h;
    add_work(s, &b, &q);
    swap_in(&s->f.p_before, &s->f.p, &s->f.p_new);
    swap_in(&s->f.tau_before, &s->f.tau, &s->f.tau_new);
    s->before = b;
    s->motion = q;
    s->run->steps++;
    return BEM_REBOUND;
}

/* The force vanishes as (t_end - t)^(3/2). */
static double end_of_contact(double h, double force_before, double force, double time)
{
    if (!(force_before > force && force > 0)) return time;
    const double ratio = pow(force / force_before, 2.0 / 3);
    return time + h * fmin(1, ratio / (1 - ratio));
}

static void note_largest(struct bem_run *run, const struct bem_motion *q)
{
    run->max_depth = fmax(run->max_depth, q->depth);
    run->max_force = fmax(run->max_force, q->force);
    run->max_area = fmax(run->max_area, q->contact);
}

static int unstable(const struct bem_stepper *s)
{
    const struct bem_motion *q = &s->motion;
    /* no force while it is pressed in; one that has all but sunk is moved by what iterations leave,
     * and may lose it, the earlier the coarser the grid is */
    const double slow = s->setup->problem->solid.can_sink ? 1e-2 : 1e-3;
    const int lost = s->run->max_force > 0 && q->force <= 0 && q->velocity > slow;
    return lost || !(fabs(q->velocity) <= most_speed) ||
           !(fabs(q->shear_velocity) <= most_speed * s->setup->problem->shear_speed);
}

static int rests(const struct bem_stepper *s)
{
    const double slow = s->setup->rest_speed;
    return s->setup->problem->solid.can_sink && fabs(s->motion.velocity) < slow &&
           normal_mass_factor() * s->motion.force < 100 * slow; /* at a turning point it is of order 1 */
}

/* Whether a sphere without force leaves. For a sphere that nearly rests, the iterations may also
 * leave no cell in contact. */
static int leaves(const struct bem_stepper *s)
{
    return !s->setup->problem->solid.can_sink || s->motion.velocity <= -s->setup->rest_speed;
}

/* From sums to fractions of the energies before the impact; u_x = 1.5 U. */
static void scale_work(const struct bem_setup *setup, struct bem_work *work)
{
    const double z = 2 * normal_mass_factor(), x = 2 * shear_mass_factor(setup);
    work->normal *= z;
    work->left_normal *= z;
    work->shear *= x;
    work->friction *= x / pull;
    work->left_shear *= x / pull;
}

static void follow(struct bem_stepper *s, struct bem_observer *observer)
{
    const struct bem_setup *setup = s->setup;
    struct bem_run *run = s->run;
    double force_before = 0;
    while (run->steps < setup->most_steps) {
        const double last_force = s->motion.force, last_time = s->motion.time;
        const enum bem_end end = advance(s);
        if (end != BEM_REBOUND) {
            run->end = end;
            return;
        }
        note_largest(run, &s->motion);
        if (observer) observer->see(observer, setup, run, &s->motion, &s->f);
        if (unstable(s)) run->end = BEM_UNSETTLED;
        if (rests(s)) run->end = BEM_SUNK;
        if (s->motion.force <= 0 && run->max_force > 0 && run->end == BEM_TOO_LONG) {
            run->end = leaves(s) ? BEM_REBOUND : BEM_SUNK;
            run->contact_time = end_of_contact(setup->step, force_before, last_force, last_time);
        }
        if (run->end != BEM_TOO_LONG) return;
        force_before = last_force;
    }
}

void rst_bem_run(const struct bem_setup *setup, struct bem_memory *memory, struct bem_observer *observer,
                 struct bem_run *run)
{
    struct bem_stepper s = {.setup = setup, .solid = setup->solid, .memory = memory, .run = run};
    *run = (struct bem_run){.end = BEM_NO_MEMORY, .step = setup->step, .ringing = setup->solid->ringing};
    if (rst_bem_memory_fields(memory, setup->m, setup->solid->n_terms, &s.f)) return;
    if (setup->keep_ledger && !rst_bem_memory_transform(memory, setup->m)) return;
    run->end = BEM_TOO_LONG;
    s.cell = 4 * setup->spacing;
    s.motion.velocity = 1;
    s.motion.shear_velocity = setup->problem->shear_speed;
    s.before = s.motion;
    rst_bem_normal_target(setup->m, setup->m, setup->spacing, 0, -1, s.f.h, s.f.gap); /* r^2/2 */
    follow(&s, observer);
    if (setup->keep_ledger && (run->end == BEM_REBOUND || run->end == BEM_SUNK)) rst_bem_find_left(&s);
    run->last = s.motion;
    scale_work(setup, &run->work);
}
