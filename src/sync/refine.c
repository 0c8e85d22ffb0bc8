/* Elements where slip sticks again (docs/sync.md, section 8): walks with more and more of them.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sync/verdict.h"
#include "sync/walk.h"

static int walk_once(struct rst_motion *motion, const struct rst_problem *problem, const struct rst_run *run,
                     int64_t parts, struct rst_outcome *outcome, struct rst_walk *walk, restitute_error *error)
{
    const double n = (double)(parts * (run->normal.n_compression + 1));
    const double work = 2 * n * n * (1.0 + (double)problem->solid.n_terms);
    if ((double)outcome->updates + work > (double)problem->max_updates) return rst_sync_too_much_work(problem, error);
    outcome->updates += (int64_t)work;
    if (rst_walk(motion, run, problem, 1, parts, 0, walk))
        return rst_report(error, RESTITUTE_ERROR_MEMORY, "out of memory for elements");
    return RESTITUTE_OK;
}

/* A walk has the ends of all panels among its levels: it is over the finest run that is not too
 * fine for four walks. Returned are its halvings. */
static int run_to_walk(const struct rst_motion *motion, int finest)
{
    int halvings = finest;
    while (halvings > 0 && 8 * motion->run[halvings].normal.n_compression > rst_most_elements &&
           motion->run[halvings - 1].found == motion->run[finest].found)
        halvings--;
    return halvings;
}

static void note_walk(const struct rst_walk *walk, int64_t parts, double velocity, struct rst_outcome *outcome)
{
    outcome->shear_velocity = velocity;
    outcome->elements = walk->n;
    outcome->steps = 2 * walk->n;
    outcome->step = outcome->followed_time / (double)outcome->steps;
    outcome->spacing = outcome->max_contact_radius / (double)walk->n;
    outcome->walked = parts;
}

/* Whether twice the elements, which take four times as long, are worth it: rounding adds twice as
 * much to the error. Not after two walks, whose estimate is low if they agree by chance. `left`:
 * seconds before the last walk. */
static int can_double(const struct rst_problem *problem, int64_t n, int walked, double left,
                      struct rst_outcome *outcome)
{
    if (2 * n > rst_most_elements) return 0;
    if (walked > 2 && 4 * rst_rounding * (double)n > outcome->error_ex * problem->shear_speed) return 0;
    outcome->late = rst_lacks_time(problem, 4, left);
    return !outcome->late;
}

/* U' by elements, half as many and all of them: of second order, so extrapolated, until two
 * extrapolations agree. Two may agree by chance, so that a part of the change before extrapolation
 * counts, too: half of that if twice in a row it fell to a quarter, as it does where all is
 * regular. */
int rst_walk_refining(struct rst_motion *motion, const struct rst_problem *problem, int halvings,
                      struct rst_outcome *outcome, restitute_error *error)
{
    outcome->halvings = run_to_walk(motion, halvings);
    const struct rst_run *run = &motion->run[outcome->halvings];
    const int64_t panels = run->normal.n_compression;
    struct rst_walk coarse, now;
    const double rest =
        outcome->error_ez + rst_piece_part * rst_piece_roughness(problem, outcome->halvings) +
        (outcome->sunk ? 4 * problem->chi * run->normal.residual_speed / problem->shear_speed : 0); /* see compare */
    double before = 0, extrapolated = 0;
    int walked = 1, regular = 0;
    const double first = rst_first_elements * cbrt(fmax(1, problem->chi)); /* U' swings faster than D' */
    int64_t parts = 1 + (int64_t)first / panels;
    const int given = problem->elements > 0;
    if (given) parts = 1 + problem->elements / (2 * panels);
    int status = walk_once(motion, problem, run, parts, outcome, &coarse, error);
    while (!status) {
        const double left = rst_time_left(problem);
        parts *= 2;
        status = walk_once(motion, problem, run, parts, outcome, &now, error);
        if (status) break;
        const double plain = now.velocity - coarse.velocity, last = extrapolated;
        double change = fabs(plain);
        extrapolated = now.velocity + plain / 3;
        regular = ++walked > 2 && fabs(before / plain - 4) < rst_regular ? regular + 1 : 0;
        if (walked > 2)
            change = fmax(rst_share_by_chance / (regular > 1 ? 2 : 1) * change, fabs(extrapolated - last));
        before = plain;
        if (!given || walked == 2) note_walk(&now, parts, extrapolated, outcome);
        const double off = fabs(extrapolated - outcome->shear_velocity); /* of a given walk from finer ones */
        const int coarser = given && (double)now.n < 4 * first; /* than any chosen one: nothing is known */
        change = rst_share_of_change * change + rst_rounding * (double)now.n + off;
        outcome->error_ex = coarser ? 2 : change / problem->shear_speed + rest;
        if ((walked > 2 && !coarser && (given || rst_meets(problem, outcome))) ||
            !can_double(problem, now.n, walked, left, outcome))
            return outcome->late ? RESTITUTE_TOLERANCE_NOT_REACHED : RESTITUTE_OK;
        coarse = now;
    }
    return status == RESTITUTE_ERROR_TOO_MUCH_WORK && outcome->walked > 0 ? RESTITUTE_TOLERANCE_NOT_REACHED : status;
}
