/* The walk over elements (walk.h): levels at which the edge is on a node, from the panels of the
 * normal motion.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sync/walk.h"

#include <float.h>
#include <math.h>

#include "base/gross_slip.h"
#include "sync/tuning.h"

/* Where the levels are: ends of the panels of the compression and, if gross slip ends, the angle of
 * the edge then. */
struct ladder {
    int64_t n_marks, parts, start; /* start: level at which gross slip ends, 0: none */
    double *mark;                  /* n_marks + 1 */
};

/* What the walk works on. */
struct room {
    double *mark, *time, *memory, *left, *body, *stress; /* left: of each term's first layer (see first_layer) */
    struct walk_level *level;
    struct walk_shear *shear;
    struct walk_term *term;
};

static int lay_out(struct rst_motion *motion, int64_t n_panels, int64_t most, size_t terms, struct room *r)
{
    const size_t n = (size_t)most, levels = 2 * n + 1, marks = (size_t)n_panels + 2;
    const size_t capacity = (n + walk_lanes) / walk_lanes * walk_lanes;
    const size_t of_level = sizeof(struct walk_level) / sizeof(double), of_shear = sizeof(struct walk_shear) / sizeof(double);
    const size_t of_term = sizeof(struct walk_term) / sizeof(double);
    const size_t count = marks + levels * (1 + of_level + of_shear + terms) + terms + 2 * (terms + 1) * of_term +
                         capacity * (walk_columns + 2 * (terms + 1));
    if (rst_make_room(&motion->walk_room, &motion->walk_size, count)) return 1;
    r->mark = motion->walk_room;
    r->time = r->mark + marks;
    r->level = (struct walk_level *)(r->time + levels);
    r->shear = (struct walk_shear *)((double *)r->level + levels * of_level);
    r->memory = (double *)r->shear + levels * of_shear;
    r->left = r->memory + levels * terms;
    r->term = (struct walk_term *)(r->left + terms);
    r->body = (double *)r->term + 2 * (terms + 1) * of_term;
    r->stress = r->body + capacity * walk_columns;
    return 0;
}

/* The angle at which gross slip ends splits the panel that it is in, unless it is at an end of
 * it. */
static void set_marks(const struct sync_normal *normal, const struct rst_problem *problem, int sticks,
                      struct ladder *ladder)
{
    const int split = sticks && problem->mode == RST_GROSS_SLIP;
    double angle = -1;
    int64_t returning = 0, at = 0;
    ladder->n_marks = 0;
    ladder->mark[0] = 0;
    if (split) rst_sync_find_velocity(normal, rst_end_of_gross_slip(problem), &angle, &returning);
    for (int64_t p = 0; p < normal->n_compression; p++) {
        const struct sync_panel *panel = &normal->panel[p];
        const double margin = rst_same_angle * (panel->to - panel->from);
        if (angle > panel->from + margin && angle < panel->to - margin) {
            ladder->mark[++ladder->n_marks] = angle;
            at = ladder->n_marks;
        }
        ladder->mark[++ladder->n_marks] = panel->to;
        if (split && fabs(angle - panel->to) <= margin) at = ladder->n_marks;
    }
    ladder->start = at * ladder->parts;
    if (returning) ladder->start = 2 * ladder->n_marks * ladder->parts - ladder->start;
}

static double angle_of(const struct ladder *ladder, int64_t i)
{
    const int64_t m = i / ladder->parts, rest = i % ladder->parts;
    if (rest == 0) return ladder->mark[m];
    return ladder->mark[m] + (ladder->mark[m + 1] - ladder->mark[m]) * (double)rest / (double)ladder->parts;
}

/* At the points of a panel, what is left there of the stress that an arm has at its start. */
static const double *fading_on(const struct sync_normal *normal, int64_t p, size_t k)
{
    return normal->kernel + rst_stages * rst_points * ((size_t)normal->n_arms * (size_t)p + k);
}

/* What the polynomial of M_k lacks on the panel p. M_k starts from 0, and that of a fast arm is
 * soon g tau D': smooth but for -g tau exp(-s/tau), of which the panels have what collocation makes
 * of it, kernel(:, 0) of rst_arms times what it left of it at the start of the panel. For an arm
 * that is slow on the first panel both are the same but for rounding. */
static double first_layer(const struct sync_normal *normal, int64_t p, size_t k, double left, const double *weight,
                          double time)
{
    const double tau = 1 / normal->rate[k], slow = rst_slow_arm * normal->panel[0].time[rst_stages];
    const double *fade = fading_on(normal, p, k);
    double collocated = weight[0];
    if (tau > slow) return 0;
    for (int i = 0; i < rst_stages; i++)
        collocated += weight[i + 1] * fade[i];
    return normal->g[k] * tau * (left * collocated - exp(-time / tau));
}

/* The level at an angle on a panel, without its step. The first arms may be a spring, which the
 * walk has apart. */
static void set_level(const struct sync_normal *normal, int64_t p, double angle, size_t terms, const double *left,
                      struct walk_level *level, double *time, double *memory)
{
    const struct sync_panel *panel = &normal->panel[p];
    const size_t first = (size_t)normal->n_arms - terms;
    double weight[rst_points];
    rst_sync_weights_at((angle - panel->from) / (panel->to - panel->from), weight);
    level->radius = rst_value_of(weight, panel->radius);
    level->depth = rst_value_of(weight, panel->depth);
    level->velocity = rst_value_of(weight, panel->velocity);
    level->force = rst_value_of(weight, panel->force);
    *time = rst_value_of(weight, panel->time);
    for (size_t k = 0; k < terms; k++)
        memory[k] = rst_value_of(weight, normal->memory + rst_points * ((size_t)normal->n_arms * (size_t)p + first + k)) +
                    first_layer(normal, p, first + k, left[k], weight, *time);
}

static void set_levels(const struct sync_normal *normal, const struct ladder *ladder, int64_t end, size_t terms,
                       struct room *r)
{
    const int64_t n = ladder->n_marks * ladder->parts;
    const size_t first = (size_t)normal->n_arms - terms;
    int64_t p = 0;
    for (size_t k = 0; k < terms; k++)
        r->left[k] = 1;
    for (int64_t l = 0; l <= end; l++) {
        const double angle = angle_of(ladder, l <= n ? l : 2 * n - l);
        while (p < normal->n_panels - 1 &&
               (p < normal->n_compression ? angle > normal->panel[p].to || l > n : angle < normal->panel[p].to)) {
            for (size_t k = 0; k < terms; k++)
                r->left[k] *= fading_on(normal, p, first + k)[rst_stages - 1];
            p++;
        }
        set_level(normal, p, angle, terms, r->left, &r->level[l], &r->time[l], r->memory + (size_t)l * terms);
        if (l > n) r->level[l].radius = r->level[2 * n - l].radius;
        /* Not 0 by rounding, or less where the polynomial of time swings beside the turning point:
         * what slips in no time would have any velocity. */
        r->level[l].step = l > 0 ? r->time[l] - r->time[l - 1] : 0;
        if (l > 0 && !(r->level[l].step > DBL_EPSILON * r->time[l]))
            r->level[l].step = fmax(rst_least_step * r->level[l - 1].step, DBL_EPSILON * r->time[l]);
    }
}

int rst_walk(struct rst_motion *motion, const struct rst_run *run, const struct rst_problem *problem, int sticks,
             int64_t parts, int divides, struct rst_walk *walk)
{
    const struct rst_solid *s = &problem->solid;
    const struct sync_normal *normal = &run->normal;
    const size_t terms = (size_t)s->n_terms;
    struct room r;
    if (lay_out(motion, normal->n_compression, (normal->n_compression + 1) * parts, terms, &r)) return 1;
    struct ladder ladder = {.parts = parts, .mark = r.mark};
    set_marks(normal, problem, sticks, &ladder);
    const int64_t n = ladder.n_marks * parts, end = normal->n_panels > normal->n_compression ? 2 * n : n;
    set_levels(normal, &ladder, end, terms, &r);
    const struct walk w = {.n = n,
                           .n_terms = s->n_terms,
                           .capacity = (n + walk_lanes) / walk_lanes * walk_lanes,
                           .start = sticks ? ladder.start : 2 * n,
                           .end = end,
                           .mode = problem->mode,
                           .divides = divides,
                           .chi = problem->chi,
                           .psi = problem->shear_speed,
                           .g_inf = s->g_inf,
                           .eta = s->eta};
    rst_follow_elements(&w, s->g, s->tau, r.level, r.memory, r.shear, r.term, r.body, r.stress, &walk->ledger);
    walk->n = n;
    walk->velocity = r.shear[end].velocity;
    walk->time = r.time;
    walk->shear = r.shear;
    return 0;
}
