/* Campaign: random impacts of the whole domain and of its corners (support/campaign.h), compared
 * with `sync` at 1e-8.
 *
 *     sync_campaign COUNT SEED CORNER TOLERANCE,... [METHOD [MAX_WORK]]
 *
 * CORNER is a name, "corners" (all but the two domains) or "all". METHOD is sync (default) or
 * euler. Of sync every 64th impact is solved by `euler` and `cvode` as well, so that other methods
 * check the reference.
 *
 * The table goes to stdout, one row a corner and tolerance. Its errors are over the tolerance, of
 * impacts that end with OK or NO_REBOUND. The true error is what exceeds the estimate of the
 * reference. "low" counts estimates below it. An impact is not judged ("no ref") if its reference
 * is not known to a tenth of the tolerance. Lines with # below the rows hold the messages of the
 * first 20 failures and the worst cases, with the commands that solve them again.
 *
 * Exit status 0: the aims of sync are met, 1: they are not, 2: usage.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <time.h>

#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif

#include "../support/campaign.h"
#include "../support/remarks.h"
#include "../support/sync.h"

enum { piece = 128, threads = 2, most_rows = 12, every = 64, explained = 20 };

static const double reference_tolerance = 1e-8, rounding = 1e-15; /* of e_z and e_x: four units in the last place */
static const double reference_work = 0.1;                         /* the tested method has the default */
#ifdef RESTITUTE_WITH_CVODE
static const double cvode_work = 0.03;
#endif

enum worst { ERROR, ESTIMATE, FORCE, TIME, WORST };

/* A method at a tolerance, on one corner. */
struct row {
    restitute_options options;
    int step, tested; /* every so many impacts; the aims are for this row */
    long count, refused, sank, not_reached, unjudged, beyond, far, low, far_too_low, bad_force;
    double seconds, longest; /* all pieces, the longest one */
    double *errors;          /* of those judged with OK or NO_REBOUND, over the tolerance */
    long judged, compared;   /* those, and all that have a reference */
    double worst[WORST];
    char *worst_command[WORST];
    struct remark remarks[most_remarks];
};

struct batch {
    long n;
    restitute_impact impacts[piece];
    restitute_result results[piece];
    int statuses[piece];
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void keep_worst(struct row *row, enum worst what, double value, const restitute_impact *impact)
{
    if (!(value > row->worst[what])) return;
    row->worst[what] = value;
    free(row->worst_command[what]);
    row->worst_command[what] = command_of(impact, &row->options);
}

/* Counts the message that the impact gives when it is solved by itself. */
static void keep_remark(struct row *row, const restitute_impact *impact)
{
    restitute_solver *solver;
    restitute_error error = {0};
    restitute_result result;
    restitute_result_init(&result);
    if (restitute_solver_create(&row->options, &solver, NULL) < 0) return;
    const int status = restitute_solve(solver, impact, &result, NULL, NULL, &error);
    restitute_solver_destroy(solver);
    struct remark *remark = add_remark(row->remarks, status, error.message);
    if (!remark->example) remark->example = command_of(impact, &row->options);
}

/* The slowest impact is in the piece that took longest. */
static void time_singly(struct row *row, const struct batch *b)
{
    restitute_solver *solver;
    if (restitute_solver_create(&row->options, &solver, NULL) < 0) return;
    for (long i = 0; i < b->n; i++) {
        restitute_result result;
        restitute_result_init(&result);
        const double start = now();
        restitute_solve(solver, &b->impacts[i], &result, NULL, NULL, NULL);
        keep_worst(row, TIME, now() - start, &b->impacts[i]);
    }
    restitute_solver_destroy(solver);
}

static void solve_batch(struct row *row, struct batch *b)
{
    restitute_error error;
    for (long i = 0; i < b->n; i++) {
        restitute_result_init(&b->results[i]);
        b->statuses[i] = 1000;
    }
    const double start = now();
    restitute_solve_many((size_t)b->n, b->impacts, &row->options, b->results, b->statuses, &error);
    const double taken = now() - start;
    if (b->n > 0 && b->statuses[0] == 1000) {
        fprintf(stderr, "sync_campaign: %s\n", error.message);
        exit(2);
    }
    row->seconds += taken;
    if (taken <= row->longest) return;
    row->longest = taken;
    time_singly(row, b);
}

/* What the row's result is off by, if there is a reference for it. */
static void compare(struct row *row, const restitute_impact *impact, int status, const restitute_result *r,
                    const restitute_result *fine)
{
    const double z = certain_error(r->ez, fine->ez, fine->error_ez + rounding);
    const double x = certain_error(r->ex, fine->ex, fine->error_ex + rounding);
    const int finite = isfinite(r->ez) && isfinite(r->ex) && isfinite(r->error_ez) && isfinite(r->error_ex);
    const double error = (finite ? fmax(z, x) : INFINITY) / row->options.tolerance;
    const double low = finite ? fmax(too_low_by(z, r->error_ez), too_low_by(x, r->error_ex)) : INFINITY;
    row->compared++;
    row->low += low > 1;
    row->far_too_low += low > 10;
    keep_worst(row, ESTIMATE, low, impact);
    if (status == RESTITUTE_TOLERANCE_NOT_REACHED) return;
    row->errors[row->judged++] = error;
    row->beyond += error > 1;
    row->far += error > 3;
    keep_worst(row, ERROR, error, impact);
    if (status == RESTITUTE_OK) keep_worst(row, FORCE, fabs(r->max_normal_force / fine->max_normal_force - 1), impact);
}

/* fine: NULL for the reference itself */
static void judge(struct row *row, const restitute_impact *impact, int status, const restitute_result *r,
                  const restitute_result *fine, int fine_status)
{
    row->count++;
    row->refused += status < 0;
    row->sank += status == RESTITUTE_NO_REBOUND;
    row->not_reached += status == RESTITUTE_TOLERANCE_NOT_REACHED;
    if ((status < 0 || status == RESTITUTE_TOLERANCE_NOT_REACHED) && row->refused + row->not_reached <= explained)
        keep_remark(row, impact);
    if (status < 0) return;
    if (!(r->max_normal_force > 0) || !isfinite(r->max_normal_force)) {
        row->bad_force++;
        keep_worst(row, FORCE, INFINITY, impact);
    }
    if (!fine) return;
    if (fine_status < 0 || !(fmax(fine->error_ez, fine->error_ex) <= row->options.tolerance / 10))
        row->unjudged++;
    else
        compare(row, impact, status, r, fine);
}

/* Impacts first, first + 1, ... of a corner, by all rows; the first row is the reference. */
static void run_batch(struct row *rows, int n_rows, const struct batch *fine, long first)
{
    static struct batch part;
    for (int k = 0; k < n_rows; k++) {
        long at[piece];
        part.n = 0;
        for (long i = 0; i < fine->n; i++)
            if ((first + i) % rows[k].step == 0) {
                part.impacts[part.n] = fine->impacts[i];
                at[part.n++] = i;
            }
        solve_batch(&rows[k], &part);
        for (long j = 0; j < part.n; j++)
            judge(&rows[k], &part.impacts[j], part.statuses[j], &part.results[j], &fine->results[at[j]],
                  fine->statuses[at[j]]);
    }
}

static void run_corner(const struct campaign_corner *corner, struct campaign_draw *draw, struct row *rows, int n_rows,
                       long count, const double *tolerances, int n_tolerances)
{
    static struct batch fine;
    const double start = now();
    double shown = start;
    for (long first = 0; first < count; first += fine.n) {
        fine.n = count - first < piece ? count - first : piece;
        for (long i = 0; i < fine.n; i++) {
            draw->tolerance = tolerances[i % n_tolerances];
            fine.impacts[i] = corner->draw(draw);
        }
        solve_batch(&rows[0], &fine);
        for (long i = 0; i < fine.n; i++)
            judge(&rows[0], &fine.impacts[i], fine.statuses[i], &fine.results[i], NULL, 0);
        run_batch(rows + 1, n_rows - 1, &fine, first);
        for (long i = 0; i < fine.n; i++)
            free_impact(&fine.impacts[i]);
        if (now() - shown < 10 && first + fine.n < count) continue;
        shown = now();
        fprintf(stderr, "%-15s %ld of %ld, %.0f s\n", corner->name, first + fine.n, count, shown - start);
    }
}

static void print_head(void)
{
    printf("%-15s %-6s %6s %7s %7s %6s %7s %6s %7s %7s %8s %8s %8s %6s %6s %9s %6s %8s %9s %9s\n", "corner", "method",
           "tol", "n", "refused", "sank", "not_met", "no_ref", "beyond", "beyond3", "median", "99_%", "worst", "low_%",
           "low>10", "worst_low", "bad_F", "F_off", "us/impact", "slowest_s");
}

static void print_row(const char *corner, struct row *r)
{
    const double *e = r->errors;
    qsort(r->errors, (size_t)r->judged, sizeof *r->errors, by_value);
    printf("%-15s %-6s %6.0e %7ld %7ld %6ld %7ld", corner, restitute_method_name(r->options.method),
           r->options.tolerance, r->count, r->refused, r->sank, r->not_reached);
    if (r->compared > 0 && r->judged > 0)
        printf(" %6ld %7ld %7ld %8.1e %8.1e %8.2g %6.2f %6ld %9.3g %6ld %8.1e", r->unjudged, r->beyond, r->far,
               e[r->judged / 2], e[r->judged * 99 / 100], e[r->judged - 1],
               100.0 * (double)r->low / (double)r->compared, r->far_too_low, r->worst[ESTIMATE], r->bad_force,
               r->worst[FORCE]);
    else
        printf(" %6ld %7s %7s %8s %8s %8s %6s %6s %9s %6ld %8s", r->unjudged, "-", "-", "-", "-", "-", "-", "-", "-",
               r->bad_force, "-");
    printf(" %9.0f %9.3g\n", 1e6 * r->seconds / (double)(r->count ? r->count : 1), r->worst[TIME]);
}

static void print_remarks(const struct row *r)
{
    static const char *const what[] = {"error in tolerances:", "error over estimate:", "force off by:", "slowest, s:"};
    static const double shown_from[] = {1, 5, 0.1, 1};
    const char *method = restitute_method_name(r->options.method);
    for (int k = 0; k < most_remarks; k++)
        if (r->remarks[k].count > 0)
            printf("# %s %g: %ld times%s status %d, %s\n#     %s\n", method, r->options.tolerance, r->remarks[k].count,
                   k == most_remarks - 1 ? " others, the first" : "", r->remarks[k].status, r->remarks[k].text,
                   r->remarks[k].example);
    for (int k = 0; k < WORST; k++)
        if (r->worst[k] > shown_from[k])
            printf("# %s %g: %s %.3g\n#     %s\n", method, r->options.tolerance, what[k], r->worst[k],
                   r->worst_command[k]);
}

/* No result with OK beyond three tolerances, none refused, none without a force. Estimates hold in
 * 95 %, and within a factor of ten in all. The tolerance is met in 99.5 %. */
static int meets_aims(const struct row *r)
{
    return !r->tested || (r->far == 0 && r->refused == 0 && r->bad_force == 0 && 20 * r->low <= r->compared &&
                          r->far_too_low == 0 && 200 * r->not_reached <= r->count);
}

static int finish(const char *corner, struct row *rows, int n_rows)
{
    int met = 1;
    for (int k = 0; k < n_rows; k++) {
        print_row(corner, &rows[k]);
        met = met && meets_aims(&rows[k]);
    }
    for (int k = 0; k < n_rows; k++) {
        print_remarks(&rows[k]);
        for (int i = 0; i < WORST; i++)
            free(rows[k].worst_command[i]);
        free_remarks(rows[k].remarks);
        free(rows[k].errors);
    }
    fflush(stdout);
    return met;
}

static struct row row_of(const restitute_method *method, double tolerance, int step, long count)
{
    struct row row = {.options = to_tolerance(tolerance), .step = step};
    row.options.method = method;
    row.options.threads = threads;
    row.tested = step == 1 && method == restitute_method_sync();
    row.errors = malloc((size_t)count * sizeof *row.errors);
    if (!row.errors) exit(2);
    return row;
}

/* The reference, the tested method at its tolerances, other methods. */
static int make_rows(struct row *rows, const restitute_options *tested, const double *tolerances, int n, long count)
{
    int k = 0;
    rows[k++] = row_of(restitute_method_sync(), reference_tolerance, 1, count);
    rows[0].tested = 0;
    rows[0].options.max_work = reference_work;
    for (int i = 0; i < n; i++) {
        rows[k] = row_of(tested->method, tolerances[i], 1, count);
        rows[k].options.time_limit = 0; /* the default */
        rows[k++].options.max_work = tested->max_work;
    }
    if (tested->method != restitute_method_sync()) return k;
    rows[k++] = row_of(restitute_method_euler(), 1e-3, every, count);
    rows[k - 1].options.max_work = reference_work;
#ifdef RESTITUTE_WITH_CVODE
    rows[k++] = row_of(restitute_method_cvode(), 1e-5, every, count);
    rows[k - 1].options.max_work = cvode_work;
#endif
    return k;
}

static int read_tolerances(char *list, double *tolerances)
{
    int n = 0;
    for (char *word = strtok(list, ","); word && n < most_rows - 3; word = strtok(NULL, ","))
        tolerances[n++] = strtod(word, NULL);
    return n;
}

static int is_wanted(const char *wanted, const char *corner)
{
    const int domain = strcmp(corner, "domain") == 0 || strcmp(corner, "usual") == 0;
    return strcmp(wanted, "all") == 0 || strcmp(wanted, corner) == 0 || (strcmp(wanted, "corners") == 0 && !domain);
}

static int usage(void)
{
    fprintf(stderr, "usage: sync_campaign COUNT SEED CORNER TOLERANCE,... [sync|euler [MAX_WORK]]\n"
                    "CORNER is all, corners or one of ");
    for (int i = 0; i < CAMPAIGN_CORNERS; i++)
        fprintf(stderr, "%s%s", campaign_corners[i].name, i < CAMPAIGN_CORNERS - 1 ? " " : "\n");
    return 2;
}

int main(int argc, char **argv)
{
    static struct row rows[most_rows];
    static struct campaign_draw draw;
    double tolerances[most_rows];
    const long count = argc > 4 ? strtol(argv[1], NULL, 10) : 0;
    const int n_tolerances = argc > 4 ? read_tolerances(argv[4], tolerances) : 0;
    int known = 0, met = 1;
    if (argc < 5 || argc > 7 || count < 1 || n_tolerances < 1) return usage();
    restitute_options normal = sync_to(reference_tolerance), tested = sync_to(reference_tolerance);
    if (argc > 5 && strcmp(argv[5], "euler") == 0) tested.method = restitute_method_euler();
    if (argc > 6) tested.max_work = strtod(argv[6], NULL);
    read_pib(draw.pib_tau, draw.pib_g);
    if (restitute_solver_create(&normal, &draw.normal, NULL) < 0) return 2;
    print_head();
    for (int i = 0; i < CAMPAIGN_CORNERS; i++) {
        if (!is_wanted(argv[3], campaign_corners[i].name)) continue;
        known = 1;
        draw.random = strtoull(argv[2], NULL, 10) + (uint64_t)i * UINT64_C(1000000007);
        const int n_rows = make_rows(rows, &tested, tolerances, n_tolerances, count);
        run_corner(&campaign_corners[i], &draw, rows, n_rows, count, tolerances, n_tolerances);
        met = finish(campaign_corners[i].name, rows, n_rows) && met;
    }
    restitute_solver_destroy(draw.normal);
    return !known ? usage() : !met;
}
