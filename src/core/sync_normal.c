/* The normal problem of the method `sync`, refined until its error estimate meets what is wanted.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <string.h>

#include "kernels.h"
#include "status.h"
#include "sync_run.h"

/* Solutions at n and n/2 levels are compared. The method is of fourth order: the change is 15 times the error of the
 * finer one, which is taken off. */
static const double part_taken = 1.0 / 15;

/* Of three runs, two extrapolated velocities are compared: the estimate is this part of their difference and, as that
 * may be small by chance, a part of n^-4.5, as the median error falls. With two runs it is a part of the change and
 * more of n^-4. Such that 95 of 100 are not too small (docs/accuracy.md). */
static const double share_of_difference = 0.5, usual_error = 2.5, share_of_change = 0.6, usual_error_of_two = 5;

/* The levels have what extrapolation takes off; it is to be this part of the error that is wanted, and less for
 * spheres that turn easily, which swing sqrt(2 chi) times as often as the contact lasts. */
static const double left_in_levels = 0.3;

/* Iterations stop when velocities change by less than this part of the tolerance, or by what rounding leaves. */
static const double closeness = 0.002, rounding = 1e-12;

/* So many times less close are the first two runs: no result rests on them but by a small part of what they change,
 * and the next run, which they guess for. */
static const double slack_of_first_runs[] = {10, 3};

/* The levels of the tangential problem are denser, and n of them move the edge by n^-2 at the turning point: what is
 * left unfinished is to be less than this part of it. */
static const double unevenness = 1e-3;

/* asinh of the impact speed over that of the creep at the turning point (sync_grid.turn): 1e8. */
static const double strongest_damping = 19.1;

double rst_sync_swings(const struct rst_problem *problem)
{
    return fmax(1, problem->chi * 6 / 7);
}

/* What the normal problem is asked for follows chi in these steps, so that impacts on one solid whose chi is alike
 * share its solution. */
double rst_sync_stepped_swings(const struct rst_problem *problem)
{
    const double swings = rst_sync_swings(problem) / 1.001; /* rounding of chi = 7/6 is not to cost a step */
    double step = 1;
    while (step < swings)
        step *= 2;
    return step > 1 && swings <= 0.75 * step ? 0.75 * step : step;
}

double rst_sync_closeness(const struct rst_problem *problem)
{
    const double n = rst_sync_levels_to_start(problem->tolerance, rst_sync_stepped_swings(problem));
    return problem->elements > 0 ? rounding
                                 : fmax(rounding, fmin(closeness * problem->tolerance, unevenness / (n * n)));
}

static size_t doubles(size_t size, size_t count)
{
    return count * (size / sizeof(double));
}

/* What the solution on a shelf belongs to: impacts that differ in their tangential side alone, as in a table, share it.
 * swings: what it takes of chi. Solids of more terms are not remembered. */
enum { most_terms_known = 8 };
struct solid_known {
    double g_inf, eta, n_terms, g[most_terms_known], tau[most_terms_known];
};
struct question {
    struct solid_known solid;
    double closeness, first, last, wanted, swings, allowed;
};

/* The head of the levels on a shelf. */
struct memo {
    double known; /* whether it answers a question */
    struct question question;
    struct normal normal; /* levels 0: none */
    struct kept kept;
};

static struct memo *memo_of(const struct rst_shelf *shelf)
{
    return (struct memo *)shelf->levels;
}

struct kept *rst_sync_kept(const struct rst_shelf *shelf)
{
    return &memo_of(shelf)->kept;
}

struct rst_shelf *rst_sync_shelf(const struct rst_problem *problem, struct rst_workspace *workspace)
{
    return &workspace->shelves[rst_sync_stepped_swings(problem) > 1];
}

static struct question question_of(const struct rst_problem *problem, int64_t first, int64_t last, double wanted)
{
    const struct rst_solid *s = &problem->solid;
    struct question q = {.solid = {.g_inf = s->g_inf, .eta = s->eta, .n_terms = (double)s->n_terms},
                         .closeness = rst_sync_closeness(problem),
                         .first = (double)first,
                         .last = (double)last,
                         .wanted = wanted,
                         .swings = rst_sync_stepped_swings(problem),
                         .allowed = (double)problem->max_updates};
    for (int64_t k = 0; k < s->n_terms && k < most_terms_known; k++) {
        q.solid.g[k] = s->g[k];
        q.solid.tau[k] = s->tau[k];
    }
    return q;
}

static int is_known(const struct rst_shelf *shelf, const struct question *question)
{
    const struct memo *memo = memo_of(shelf);
    return memo && memo->known != 0 && memcmp(&memo->question, question, sizeof *question) == 0;
}

static void remember(const struct rst_shelf *shelf, const struct question *question, const struct normal *normal)
{
    *memo_of(shelf) = (struct memo){question->solid.n_terms <= most_terms_known, *question, *normal, {0}};
}

/* Both shelves are for one solid: then whoever times the method knows when it starts from nothing. */
static void forget_other_solids(struct rst_workspace *workspace, const struct question *question)
{
    for (int i = 0; i < rst_shelves; i++) {
        struct memo *memo = memo_of(&workspace->shelves[i]);
        if (memo && memo->known != 0 && memcmp(&memo->question.solid, &question->solid, sizeof question->solid) != 0)
            memo->known = 0;
    }
}

size_t rst_sync_normal_room(int64_t levels, int64_t n_terms)
{
    const size_t n = (size_t)levels, m = (size_t)n_terms;
    return doubles(sizeof(struct memo), 1) + doubles(sizeof(struct sync_level), 2 * n + 1) +
           doubles(sizeof(struct sync_node), n + 1) + 2 * m * (2 * n + 1);
}

/* A run with half as many levels as that is too coarse to guess from. */
enum { least_doubled = 8 };

/* One run, on the shelf, which has room. guessed: the run with half the levels is there. Nonzero if iterations do not
 * settle. */
static int run(const struct rst_problem *problem, const struct rst_shelf *shelf, int64_t levels, int guessed,
               double slack, struct normal *normal)
{
    const struct rst_solid *s = &problem->solid;
    const size_t n = (size_t)levels, m = (size_t)s->n_terms;
    struct memo *memo = memo_of(shelf);
    struct sync_level *level = (struct sync_level *)(memo + 1);
    struct sync_node *node = (struct sync_node *)(level + 2 * n + 1);
    double *memory = (double *)(node + n + 1), *loading = memory + m * (2 * n + 1);
    int64_t failed;
    memo->known = 0;
    memo->kept = (struct kept){0};
    if (guessed) rst_double_levels(levels / 2, level);
    rst_normal_levels(&normal->grid, s->g_inf, s->eta, s->n_terms, s->g, s->tau, levels,
                                  slack * rst_sync_closeness(problem), guessed, level, memory, loading, node, &failed);
    normal->level = level;
    normal->levels = levels;
    normal->updates += 2 * levels;
    return failed || !isfinite(level[2 * n].velocity);
}

int rst_sync_is_graded(const struct rst_problem *problem)
{
    const struct rst_solid *s = &problem->solid;
    struct sync_grid grid;
    rst_choose_grid(s->g_inf, s->eta, s->n_terms, s->g, s->tau, &grid);
    return grid.start > 0;
}

static int choose_grid(const struct rst_problem *problem, struct normal *normal, restitute_error *error)
{
    const struct rst_solid *s = &problem->solid;
    *normal = (struct normal){0};
    rst_choose_grid(s->g_inf, s->eta, s->n_terms, s->g, s->tau, &normal->grid);
    if (normal->grid.turn > strongest_damping)
        return rst_report(
            error, RESTITUTE_ERROR_TOO_MUCH_WORK,
            "rebound slower than 1e-8 of the impact: lost in rounding; the damping is too strong for this "
            "method, take euler");
    return RESTITUTE_OK;
}

static int make_room(const struct rst_problem *problem, struct rst_shelf *shelf, int64_t levels, restitute_error *error)
{
    if (rst_shelf_levels(shelf, rst_sync_normal_room(levels, problem->solid.n_terms)))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for %lld levels", (long long)levels);
    return RESTITUTE_OK;
}

int rst_sync_normal_again(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t levels,
                          struct normal *normal, restitute_error *error)
{
    struct rst_shelf *shelf = &workspace->spare;
    int status = choose_grid(problem, normal, error);
    if (!status) status = make_room(problem, shelf, levels, error);
    if (status) return status;
    if (run(problem, shelf, levels, 0, 1, normal)) normal->levels = 0;
    memo_of(shelf)->normal = *normal;
    return RESTITUTE_OK;
}

int rst_sync_normal_of(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t levels,
                       struct normal *normal, restitute_error *error)
{
    const struct rst_shelf *shelves[] = {rst_sync_shelf(problem, workspace), &workspace->spare};
    for (int i = 0; i < 2; i++) {
        *normal = memo_of(shelves[i])->normal;
        if (normal->levels == levels) return RESTITUTE_OK;
    }
    const int status = rst_sync_normal_again(problem, workspace, levels, normal, error);
    if (status || normal->levels > 0) return status;
    return rst_report(error, RESTITUTE_ERROR_TOO_MUCH_WORK, "iterations do not settle with %lld levels",
                      (long long)levels);
}

/* The runs on end so far. */
struct series {
    int count;
    int64_t levels;                      /* of the last, if count > 0 */
    double time, velocity, extrapolated; /* the latter if count > 1 */
};

/* One more run: from the second on there is a result. */
static void compare(const struct rst_problem *problem, double wanted, struct series *series, struct normal *normal)
{
    const struct sync_level *end = &normal->level[2 * normal->levels];
    const double change = end->velocity - series->velocity, n = (double)normal->levels;
    const double extrapolated = fmax(-1, end->velocity + part_taken * change);
    if (series->count > 0) {
        normal->velocity = extrapolated;
        normal->contact_time = end->time + part_taken * (end->time - series->time);
        normal->depth = normal->level[normal->levels].depth;
        normal->error = series->count > 1 ? share_of_difference * fabs(extrapolated - series->extrapolated) +
                                                usual_error * pow(n, -4.5)
                                          : share_of_change * fabs(change) + usual_error_of_two * pow(n, -4);
        normal->error += 1.5 * rst_sync_closeness(problem);
        normal->taken_off = part_taken * fabs(change);
        normal->reached =
            normal->error <= wanted && normal->taken_off <= left_in_levels * wanted / rst_sync_stepped_swings(problem);
    }
    *series = (struct series){series->count + 1, normal->levels, end->time, end->velocity, extrapolated};
}

int rst_sync_normal(const struct rst_problem *problem, struct rst_workspace *workspace, int64_t first, int64_t last,
                    double wanted, struct normal *normal, restitute_error *error)
{
    int64_t found = 0;
    struct rst_shelf *shelf = rst_sync_shelf(problem, workspace);
    struct series series = {0};
    const struct question question = question_of(problem, first, last, wanted);
    if (is_known(shelf, &question)) {
        *normal = memo_of(shelf)->normal;
        return RESTITUTE_OK;
    }
    forget_other_solids(workspace, &question);
    int status = choose_grid(problem, normal, error);
    if (status) return status;
    for (int64_t n = first; n <= last && n <= rst_sync_most_levels; n *= 2) {
        normal->ahead = normal->updates + 2 * n;
        if (normal->ahead > problem->max_updates) break;
        status = make_room(problem, shelf, n, error);
        if (status) return status;
        const double slack = series.count < 2 ? slack_of_first_runs[series.count] : 1;
        if (run(problem, shelf, n, series.count > 0 && n >= least_doubled, slack, normal)) {
            series.count = 0;
            continue;
        }
        compare(problem, wanted, &series, normal);
        if (series.count > 1) found = n;
        if (series.count > 2 && normal->reached) {
            remember(shelf, &question, normal);
            return RESTITUTE_OK;
        }
    }
    if (found > 0 && normal->levels != found && run(problem, shelf, found, 0, 1, normal))
        found = 0; /* the last one has spoilt the levels, which are not found again */
    normal->levels = found;
    if (memo_of(shelf)) memo_of(shelf)->normal = *normal;
    return RESTITUTE_OK;
}
