/* The machine of builder.h: it solves what a stage asks for, and goes to the next when all of it is there.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "cells.h"

#include <float.h>
#include <stdio.h>
#include <stdlib.h>

/* Impacts are solved to this part of the tolerance: those that are interpolated, whose jumps where the solver takes other
 * levels are not to be taken for a shape, and those of the checks, which have their estimates added to the difference.
 * Twice as much lets 2 of 60 random solids miss 1e-4. Where checks fail for no other reason, the first is lessened
 * (docs/table.md). */
static const double part_for_filling = 0.5, part_for_checks = 0.25, part_for_cell_checks = 0.2;

/* Of one impact at a node of a cell, about a thousand levels: a few that hardly rebound would take a hundred times the
 * usual work, and tell by their estimates that they did not. */
static const int64_t most_updates = 3000000;

/* Times that points are added after a check. */
static const int most_rounds = 12;

/* Impacts given to the threads in one call. */
static const int64_t largest_piece = 4096;

void restitute_table_options_init(restitute_table_options *options)
{
    if (!options) return;
    *options = (restitute_table_options){
        .struct_size = sizeof *options, .tolerance = 1e-5, .threads = 1, .max_impacts = 20000000};
}

static int check_options(const restitute_table_options *o, restitute_error *error)
{
    if (o->struct_size != sizeof *o)
        return rst_report(error, RESTITUTE_ERROR_STRUCT_SIZE,
                          "restitute_table_options.struct_size = %zu: must be %zu; prepare the struct with "
                          "restitute_table_options_init of this version",
                          o->struct_size, sizeof *o);
    if (!(o->tolerance >= 1e-7 && o->tolerance <= 0.1))
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "tolerance = %.17g: must be in [1e-07, 0.1]", o->tolerance);
    if (o->threads < 0 || o->threads > 1024)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "threads = %d: must be in [0, 1024] (0: all)", o->threads);
    if (o->max_impacts <= 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "max_impacts = %lld: must be > 0", (long long)o->max_impacts);
    return RESTITUTE_OK;
}

/* Seams of half octaves around a range. */
static void seams_around(const double range[2], double *low, double *high)
{
    int64_t bits;
    const int shift = 51;
    memcpy(&bits, &range[0], sizeof bits);
    bits = bits >> shift << shift;
    memcpy(low, &bits, sizeof bits);
    memcpy(&bits, &range[1], sizeof bits);
    bits = ((bits >> shift) + ((bits & ((INT64_C(1) << shift) - 1)) != 0)) << shift;
    memcpy(high, &bits, sizeof bits);
}

/* The same of whole octaves. */
static void octaves_around(const double range[2], double *low, double *high)
{
    int exponent;
    const double fraction = frexp(range[1], &exponent);
    *high = ldexp(1, fraction > 0.5 ? exponent : exponent - 1);
    frexp(range[0], &exponent);
    *low = ldexp(1, exponent - 1);
}

static void set_axes(struct restitute_table_builder *b)
{
    const struct rst_family *f = &b->family;
    const int trees = f->range[0][0] < f->range[0][1] && f->range[1][0] < f->range[1][1];
    for (int a = 0; a < 3; a++) {
        b->active[a] = f->range[a][0] < f->range[a][1];
        b->low[a] = f->range[a][0];
        b->high[a] = f->range[a][1];
        if (a == RST_CHI) continue;
        b->seam_low[a] = b->seam_high[a] = f->range[a][0];
        if (!b->active[a]) continue;
        (trees ? octaves_around : seams_around)(f->range[a], &b->seam_low[a], &b->seam_high[a]);
        b->low[a] = log(b->seam_low[a]);
        b->high[a] = log(b->seam_high[a]);
    }
    b->active[RST_CHI] &= f->sliding != RST_NO_FRICTION;
    b->active[RST_STICK] = f->sliding == RST_SLIDES;
    b->active[RST_SLIP] = f->sliding == RST_SLIDES && 2 * f->range[2][1] > 1;
}

/* First guesses, to be doubled: solids turn within a decade of delta1, that is, five of speed. */
static void set_probes(struct restitute_table_builder *b)
{
    const double decade = log(10);
    const double speed = (b->high[0] - b->low[0]) / decade / (b->family.of_contact ? 5 : 1);
    const double gamma = b->active[1] ? (b->high[1] - b->low[1]) / decade : 0; /* infinity is no axis */
    const int fine = b->options.tolerance < 3e-6;
    b->probe[RST_SPEED] = speed < 0.5 ? 9 : speed < 2 ? 17 : 33;
    b->probe[RST_GAMMA] = gamma < 0.5 ? 9 : gamma < 2 ? 17 : 33;
    b->probe[RST_CHI] = 9;
    b->probe[RST_STICK] = fine ? 17 : 9;
    b->probe[RST_SLIP] = fine ? 33 : 17;
}

double rst_builder_number(const struct restitute_table_builder *b, enum rst_axis axis, double u)
{
    if (axis == RST_CHI) return b->low[axis] + (b->high[axis] - b->low[axis]) * u;
    if (!b->active[axis]) return b->family.range[axis][0];
    if (u <= 0) return b->seam_low[axis];
    if (u >= 1) return b->seam_high[axis];
    return exp(b->low[axis] + (b->high[axis] - b->low[axis]) * u);
}

int restitute_table_builder_create(const restitute_table_family *family, const restitute_table_options *options,
                                   restitute_table_builder **builder, restitute_error *error)
{
    restitute_table_options defaults;
    restitute_table_options_init(&defaults);
    if (!options) options = &defaults;
    if (!family || !builder)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", family ? "builder" : "family");
    int status = check_options(options, error);
    if (status) return status;
    struct restitute_table_builder *b = calloc(1, sizeof *b);
    if (!b) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    b->options = *options;
    status = rst_family_set(family, &b->family, error);
    if (!status) {
        set_axes(b);
        set_probes(b);
        const int cells = b->active[RST_SPEED] && b->active[RST_GAMMA];
        b->filling_tolerance = b->later_tolerance = part_for_filling * options->tolerance;
        if (cells)
            status = rst_cells_create(b, error);
        else if (rst_plan_probes(b))
            status = rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    }
    if (status) {
        restitute_table_builder_destroy(b);
        return status;
    }
    *builder = b;
    return rst_done(error);
}

void restitute_table_builder_destroy(restitute_table_builder *builder)
{
    if (!builder) return;
    rst_family_free(&builder->family);
    restitute_table_destroy(builder->draft);
    free(builder->point);
    free(builder->solved);
    free(builder->journal);
    rst_memo_clear(&builder->memo);
    rst_cells_free(builder->cells);
    free(builder);
}

/* ---- solving */

struct place {
    double speed, gamma, chi, psi;
};

static struct place place_of(const struct restitute_table_builder *b, const struct rst_point *p)
{
    if (b->cells) return (struct place){.speed = p->u[0], .gamma = p->u[1], .chi = p->u[2], .psi = p->s};
    struct place at = {.speed = rst_builder_number(b, RST_SPEED, p->u[0]),
                       .gamma = rst_builder_number(b, RST_GAMMA, p->u[1]),
                       .chi = rst_builder_number(b, RST_CHI, p->u[2]),
                       .psi = p->s};
    if (!p->later) return at;
    const double ez = p->column >= 0 ? b->solved[p->column].ez : rst_table_rebound(b->draft, at.speed, at.gamma);
    at.psi = 1 + rst_y_of_t(p->s) * (restitute_critical_psi(at.chi, fmin(1, fmax(0, ez))) - 1);
    return at;
}

static int journal_add(struct restitute_table_builder *b, const struct rst_solved *solved)
{
    if (b->journal_count == b->journal_capacity) {
        const int64_t capacity = b->journal_capacity ? 2 * b->journal_capacity : 1024;
        struct rst_solved *journal = realloc(b->journal, (size_t)capacity * sizeof *journal);
        if (!journal) return 1;
        b->journal = journal;
        b->journal_capacity = capacity;
    }
    b->journal[b->journal_count++] = *solved;
    b->used++;
    return 0;
}

/* What a thread pool is given at once. */
struct piece {
    int64_t count;
    int64_t *index; /* of the points */
    restitute_impact *impacts;
    restitute_scene *scenes;
    restitute_result *results;
    int *statuses;
};

static void piece_free(struct piece *p)
{
    free(p->index);
    free(p->impacts);
    free(p->scenes);
    free(p->results);
    free(p->statuses);
}

static int piece_allocate(const struct restitute_table_builder *b, int64_t count, struct piece *p)
{
    const size_t n = (size_t)count;
    *p = (struct piece){.index = malloc(n * sizeof *p->index),
                        .results = malloc(n * sizeof *p->results),
                        .statuses = malloc(n * sizeof *p->statuses)};
    if (b->family.of_contact)
        p->scenes = malloc(n * sizeof *p->scenes);
    else
        p->impacts = malloc(n * sizeof *p->impacts);
    return !p->index || !p->results || !p->statuses || (!p->scenes && !p->impacts);
}

static void piece_add(const struct restitute_table_builder *b, int64_t index, struct piece *p)
{
    const struct place at = place_of(b, &b->point[index]);
    const int64_t i = p->count++;
    p->index[i] = index;
    restitute_result_init(&p->results[i]);
    if (p->scenes)
        rst_family_scene(&b->family, at.speed, at.psi, &p->scenes[i]);
    else
        rst_family_impact(&b->family, at.speed, at.gamma, at.chi, at.psi, &p->impacts[i]);
}

/* One impact alone, psi times a factor. */
static int solve_alone(const struct piece *p, int64_t i, double factor, const restitute_options *options,
                       restitute_error *error)
{
    if (p->scenes) {
        restitute_scene scene = p->scenes[i];
        scene.tangential_speed *= factor;
        return restitute_solve_scenes(options, 1, &scene, &p->results[i], NULL, 1, error);
    }
    restitute_impact impact = p->impacts[i];
    impact.psi *= factor;
    return restitute_solve_many(options, 1, &impact, &p->results[i], NULL, 1, error);
}

/* An impact that the solver gives up, such as some with psi = 2 chi, whose slip would end just where D' = 0 (THEORY
 * 4.3), is solved a millionth beside, or else to larger tolerances; its estimated error says what it is worth. What is
 * refused in the end is named. */
static int solve_again(const struct restitute_table_builder *b, const struct piece *p, int64_t i,
                       restitute_options options, restitute_error *error)
{
    static const double looser = 4, loosest = 0.02, beside = 1e-6;
    const double wanted = options.tolerance;
    restitute_error why = {.message = ""};
    int status = solve_alone(p, i, 1 + beside, &options, &why);
    if (status >= 0) p->results[i].error_ex += 2 * beside;
    while (status == RESTITUTE_ERROR_TOO_MUCH_WORK && options.tolerance * looser <= loosest) {
        options.tolerance *= looser;
        status = solve_alone(p, i, 1, &options, &why);
    }
    const struct place at = place_of(b, &b->point[p->index[i]]);
    if (status == RESTITUTE_ERROR_TOO_MUCH_WORK && b->cells && !rst_cells_asked(b, at.speed, at.gamma)) {
        /* a node of a cell at the end of the range: that end instead, and the cell will be halved */
        p->impacts[i].delta1 = fmin(fmax(at.speed, b->family.range[0][0]), b->family.range[0][1]);
        p->impacts[i].gamma = fmin(fmax(at.gamma, b->family.range[1][0]), b->family.range[1][1]);
        options.tolerance = wanted;
        status = solve_alone(p, i, 1, &options, &why);
    }
    if (status >= 0) return status;
    const char *axis = p->scenes ? "speed (m/s)" : "delta1";
    if (status == RESTITUTE_ERROR_TOO_MUCH_WORK)
        return rst_report(
            error, status,
            "%s = %g, gamma = %g, chi = %g, psi = %g: too much work, or a rebound that is lost in rounding: "
            "the damping is too strong for a table; lower the upper end of %s",
            axis, at.speed, at.gamma, at.chi, at.psi, axis);
    return rst_report(error, status, "%s = %g, gamma = %g, chi = %g, psi = %g: %.120s", axis, at.speed, at.gamma,
                      at.chi, at.psi, why.message);
}

static int piece_solve(const struct restitute_table_builder *b, struct piece *p, restitute_error *error)
{
    restitute_options options;
    restitute_options_init(&options);
    options.method = restitute_method_sync();
    const double for_checks = (b->cells ? part_for_cell_checks : part_for_checks) * b->options.tolerance;
    const double for_filling = b->part ? b->later_tolerance : b->filling_tolerance;
    options.tolerance = fmax(1e-8, b->stage == RST_CHECKING ? for_checks : for_filling);
    if (b->cells && b->stage != RST_CHECKING) options.max_updates = most_updates;
    const size_t n = (size_t)p->count;
    int status =
        p->scenes ? restitute_solve_scenes(&options, n, p->scenes, p->results, p->statuses, b->options.threads, error)
                  : restitute_solve_many(&options, n, p->impacts, p->results, p->statuses, b->options.threads, error);
    if (status != RESTITUTE_ERROR_TOO_MUCH_WORK) return status;
    for (int64_t i = 0; i < p->count; i++)
        if (p->statuses[i] < 0 && (status = solve_again(b, p, i, options, error)) < 0) return status;
    return RESTITUTE_OK;
}

/* Solve up to `most` points of this part, from next on; those of the other part are passed over. */
static int solve_some(struct restitute_table_builder *b, int64_t most, restitute_error *error)
{
    struct piece p;
    if (piece_allocate(b, most, &p)) {
        piece_free(&p);
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld impacts", (long long)most);
    }
    int64_t next = b->next;
    for (; next < b->points && p.count < most; next++)
        if (b->point[next].later == b->part && !b->point[next].known) piece_add(b, next, &p);
    int status = piece_solve(b, &p, error);
    for (int64_t i = 0; i < p.count && status >= 0; i++) {
        const restitute_result *r = &p.results[i];
        const struct rst_solved solved = {r->ez, r->ex, r->error_ez, r->error_ex};
        b->solved[p.index[i]] = solved;
        if (journal_add(b, &solved)) status = rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    }
    if (status >= 0) b->next = next;
    piece_free(&p);
    return status < 0 ? status : RESTITUTE_OK;
}

/* Take what was solved before the build was interrupted. */
static void replay(struct restitute_table_builder *b)
{
    for (; b->next < b->points && b->used < b->journal_count; b->next++)
        if (b->point[b->next].later == b->part && !b->point[b->next].known) b->solved[b->next] = b->journal[b->used++];
}

/* ---- stages */

static void begin_part(struct restitute_table_builder *b, int part)
{
    b->part = part;
    b->next = 0;
}

/* What earlier rounds have solved already. */
static void recall(struct restitute_table_builder *b)
{
    for (int64_t i = 0; i < b->points; i++)
        b->point[i].known = rst_memo_find(&b->memo, (int)b->stage, &b->point[i], &b->solved[i]);
}

static int remember(struct restitute_table_builder *b)
{
    for (int64_t i = 0; i < b->points; i++)
        if (!b->point[i].known && rst_memo_add(&b->memo, (int)b->stage, &b->point[i], &b->solved[i])) return 1;
    return 0;
}

/* Largest differences of the table to the impacts of the checks, and the panels where they are too large. A check
 * beyond psi = 1 that is recalled was at the psi_c of an earlier table, within the error of ez. */
static void compare(struct restitute_table_builder *b)
{
    b->worst_ez = b->worst_ex = 0;
    memset(b->failing, 0, sizeof b->failing);
    for (int64_t i = 0; i < b->points; i++) {
        const struct rst_point *p = &b->point[i];
        const struct place at = place_of(b, p);
        const struct rst_solved *s = &b->solved[i];
        restitute_table_value pair;
        const double psi = b->family.sliding == RST_NO_FRICTION ? INFINITY : at.psi;
        rst_table_evaluate(b->draft, at.speed, at.gamma, at.chi, psi, &pair);
        const double off_ez = fabs(pair.ez - s->ez) + s->error_ez, off_ex = fabs(pair.ex - s->ex) + s->error_ex;
        b->worst_ez = fmax(b->worst_ez, off_ez);
        b->worst_ex = fmax(b->worst_ex, off_ex);
        if (fmax(off_ez, off_ex) <= b->options.tolerance) continue;
        for (int a = 0; a < 2; a++)
            b->failing[a][rst_panels_find(&b->panels[a], p->u[a])] = 1;
    }
}

/* Halve the panels of an axis where checks fail, all or those whose coefficients say that points are missing. */
static int halve_panels(struct restitute_table_builder *b, int axis, int all)
{
    int added = 0;
    for (int panel = b->panels[axis].count - 1; panel >= 0 && b->active[axis]; panel--) {
        const int short_of = b->panel_tail[axis][panel] > 0.03 * b->options.tolerance;
        if (b->failing[axis][panel] && (all || short_of)) added |= !rst_panels_halve(&b->panels[axis], panel);
    }
    if (added) b->n[axis] = rst_panels_points(&b->panels[axis]);
    return added;
}

static int lengthen(struct restitute_table_builder *b, int axis)
{
    const int64_t most = axis == RST_CHI ? rst_most_chi : 129;
    if (!b->active[axis] || b->n[axis] >= most) return 0;
    b->n[axis] += 3 + b->n[axis] / 6;
    if (b->n[axis] > most) b->n[axis] = most;
    rst_panels_one(b->n[axis], &b->panels[axis]);
    return 1;
}

/* More points where the last coefficients say that they are missing. If they do not say: along psi and chi, and better
 * impacts. */
static int add_points(struct restitute_table_builder *b)
{
    const double outer = 0.5 * fmax(b->tail[RST_SPEED], b->tail[RST_GAMMA]);
    int added = 0;
    for (int a = 0; a < 2; a++)
        added |= halve_panels(b, a, 0);
    /* new places along psi or chi are new everywhere: only where that is what matters most */
    for (int a = 2; a < rst_axes; a++)
        if (b->tail[a] > fmax(0.1 * b->options.tolerance, added ? outer : 0)) added |= lengthen(b, a);
    if (added) return 1;
    b->filling_tolerance *= 0.4;
    b->later_tolerance = b->filling_tolerance;
    rst_memo_clear(&b->memo);
    for (int a = 0; a < rst_axes; a++)
        if (a < 2)
            halve_panels(b, a, 1);
        else
            lengthen(b, a);
    return 1;
}

static int64_t points_of_filling(const struct restitute_table_builder *b)
{
    const int64_t slip = b->active[RST_SLIP] && b->n[RST_SLIP] > 2 ? b->n[RST_SLIP] - 2 : 0;
    return b->n[0] * b->n[1] * b->n[2] * (b->n[RST_STICK] + slip);
}

static int64_t points_of_checks(const struct restitute_table_builder *b)
{
    int64_t outer = 1;
    for (int a = 0; a < 3; a++)
        outer *= b->active[a] ? b->n[a] - 1 : 1;
    const int64_t stick = b->active[RST_STICK] ? b->n[RST_STICK] - 1 : 1;
    return outer * (stick + (b->active[RST_SLIP] ? b->n[RST_SLIP] - 1 : 0)) + rst_most_cell_checks;
}

static int begin_filling(struct restitute_table_builder *b, restitute_error *error)
{
    const int64_t ahead = points_of_filling(b) + points_of_checks(b);
    if (b->used + ahead > b->options.max_impacts) {
        if (b->draft) {
            b->stage = RST_FINISHED;
            return RESTITUTE_OK;
        }
        return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK,
                          "max_impacts = %lld: the table needs %lld after the %lld solved; raise it or the tolerance, "
                          "or narrow the ranges",
                          (long long)b->options.max_impacts, (long long)ahead, (long long)b->used);
    }
    if (rst_plan_filling(b)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    b->stage = RST_FILLING;
    recall(b);
    return RESTITUTE_OK;
}

static int after_probing(struct restitute_table_builder *b, restitute_error *error)
{
    int resolved;
    if (rst_read_probes(b, &resolved)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    if (resolved) {
        for (int axis = 0; axis < rst_axes; axis++)
            rst_panels_one(b->n[axis], &b->panels[axis]);
        return begin_filling(b, error);
    }
    if (remember(b) || rst_plan_probes(b)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    recall(b); /* the points of a line are among those of one with twice as many */
    return RESTITUTE_OK;
}

static int after_filling(struct restitute_table_builder *b, restitute_error *error)
{
    const int status = rst_make_draft(b, error);
    if (status) return status;
    if (remember(b) || rst_plan_checks(b)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    b->stage = RST_CHECKING;
    recall(b);
    return RESTITUTE_OK;
}

static int after_checking(struct restitute_table_builder *b, restitute_error *error)
{
    const double before = fmax(b->worst_ez, b->worst_ex);
    compare(b);
    const double worst = fmax(b->worst_ez, b->worst_ex);
    b->stagnant = b->rounds > 0 && worst > 0.8 * before ? b->stagnant + 1 : 0;
    b->draft->checks = b->points;
    if (remember(b)) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory");
    if (worst > b->options.tolerance && b->stagnant < 2 && b->rounds++ < most_rounds && add_points(b))
        return begin_filling(b, error);
    b->stage = RST_FINISHED;
    return RESTITUTE_OK;
}

static int next_stage(struct restitute_table_builder *b, restitute_error *error)
{
    if (b->part == 0) {
        begin_part(b, 1);
        return RESTITUTE_OK;
    }
    begin_part(b, 0);
    if (b->cells) return rst_cells_next(b, error);
    switch (b->stage) {
    case RST_PROBING:
        return after_probing(b, error);
    case RST_FILLING:
        return after_filling(b, error);
    default:
        return after_checking(b, error);
    }
}

static int hand_over(struct restitute_table_builder *b, restitute_table **table, restitute_error *error)
{
    restitute_table *t = b->draft;
    if (!t) return rst_report(error, RESTITUTE_ERROR_DOMAIN, "builder: the table has been handed over already");
    b->draft = NULL;
    t->tolerance = b->options.tolerance;
    t->error_ez = b->worst_ez;
    t->error_ex = b->worst_ex;
    t->impacts = b->used;
    rst_octaves_limit(t->asked[0][0], t->asked[0][1], &t->speed);
    rst_octaves_limit(t->asked[1][0], t->asked[1][1], &t->gamma);
    rst_table_set_polynomials(t);
    snprintf(t->version, sizeof t->version, "%s", restitute_version());
    *table = t;
    if (fmax(t->error_ez, t->error_ex) <= t->tolerance) return rst_done(error);
    return rst_report(error, RESTITUTE_TOLERANCE_NOT_REACHED,
                      "tolerance = %g: verified errors %.2g (ez), %.2g (ex) after %lld impacts", t->tolerance,
                      t->error_ez, t->error_ex, (long long)t->impacts);
}

int restitute_table_builder_run(restitute_table_builder *builder, size_t impacts, restitute_table **table,
                                restitute_error *error)
{
    if (!builder || !table) return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", builder ? "table" : "builder");
    if (impacts == 0) return rst_report(error, RESTITUTE_ERROR_DOMAIN, "impacts = 0: must be > 0");
    int64_t left = impacts > (size_t)INT64_MAX ? INT64_MAX : (int64_t)impacts;
    while (builder->stage != RST_FINISHED) {
        replay(builder);
        if (builder->next < builder->points) {
            if (left <= 0) return rst_done(error);
            const int64_t before = builder->used, piece = left < largest_piece ? left : largest_piece;
            const int status = solve_some(builder, piece, error);
            if (status) return status;
            left -= builder->used - before;
        } else {
            const int status = next_stage(builder, error);
            if (status) return status;
        }
    }
    return hand_over(builder, table, error);
}

const double *restitute_table_builder_journal(const restitute_table_builder *builder, size_t *count)
{
    if (count) *count = builder ? (size_t)builder->journal_count : 0;
    return builder ? (const double *)builder->journal : NULL;
}

/* More than can be in memory, and few enough that no size of them overflows. */
static const size_t most_restored = SIZE_MAX / (2 * sizeof(struct rst_solved));

int restitute_table_builder_restore(restitute_table_builder *builder, const double *journal, size_t count,
                                    restitute_error *error)
{
    if (!builder || !journal)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", builder ? "journal" : "builder");
    if (builder->journal_count > 0)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "builder: has solved %lld impacts already",
                          (long long)builder->journal_count);
    if (count > most_restored)
        return rst_report(error, RESTITUTE_ERROR_DOMAIN, "count = %zu: must be <= %zu", count, most_restored);
    for (size_t i = 0; i < 4 * count; i++)
        if (!(fabs(journal[i]) <= (i % 4 < 2 ? 2 : DBL_MAX)))
            return rst_report(error, RESTITUTE_ERROR_DOMAIN, "journal[%zu] = %g: no result of an impact", i,
                              journal[i]);
    struct rst_solved *copy = malloc((count + 1) * sizeof *copy);
    if (!copy) return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %zu impacts", count);
    memcpy(copy, journal, count * sizeof *copy);
    free(builder->journal);
    builder->journal = copy;
    builder->journal_count = (int64_t)count;
    builder->journal_capacity = (int64_t)count + 1;
    return rst_done(error);
}

int64_t restitute_table_builder_solved(const restitute_table_builder *builder)
{
    return builder ? builder->used : 0;
}

/* Checks come after a filling, and often one round is enough. */
int64_t restitute_table_builder_expected(const restitute_table_builder *builder)
{
    if (!builder) return 0;
    int64_t ahead = 0;
    for (int64_t i = builder->next; i < builder->points; i++)
        ahead += !builder->point[i].known && builder->point[i].later >= builder->part;
    if (builder->part == 0)
        for (int64_t i = 0; i < builder->next; i++)
            ahead += builder->point[i].later && !builder->point[i].known;
    if (builder->stage == RST_PROBING || builder->cells) return builder->used + ahead;
    return builder->used + ahead + (builder->stage == RST_FILLING ? points_of_checks(builder) : 0);
}

int restitute_table_build(const restitute_table_family *family, const restitute_table_options *options,
                          restitute_table **table, restitute_error *error)
{
    restitute_table_builder *builder;
    if (!table) return rst_report(error, RESTITUTE_ERROR_NULL, "table is NULL");
    int status = restitute_table_builder_create(family, options, &builder, error);
    if (status) return status;
    status = restitute_table_builder_run(builder, SIZE_MAX, table, error);
    restitute_table_builder_destroy(builder);
    return status;
}
