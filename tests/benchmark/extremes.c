/* Campaign: impacts at the ends of the domain, by one method (docs/records/extremes.md).
 *
 *     extremes METHOD COUNT SEED [FIRST [MAX_WORK [TIME_LIMIT]]]
 *
 * Cases 0 to CORNERS-1 are corners: products of the ends of all ranges. All others are random:
 * delta1 and gamma in [1e-12, 1e12], psi in [1e-9, 1e9], chi in [1/3, 1e3], log-uniform, of all
 * classes of solids. A case depends on SEED and its number alone: `extremes METHOD 1 SEED NUMBER`
 * repeats it. Every 16th has a ledger if psi is at least 1e-3; every 16th block of 64 goes through
 * restitute_solve_many as well; samples go through a second method. Exit status 0: no fault, 1:
 * faults, 2: usage.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#define PLAIN_CHECKS
#include "extremes.h"
#include "../support/result.h"
#include "../support/solve.h"
#include "bench.h"

enum { most_terms = 30, block = 64, CHI = 4, PSI = 7, DELTA1 = 4, GAMMA = 5, TOLERANCES = 4 };
static const double chi_end[CHI] = {1.0 / 3, 0.5, 7.0 / 6, 1000}, delta1_end[DELTA1] = {0, 1e-12, 1, 1e12};
static const double psi_end[PSI] = {0, 1e-9, 1, 2, 1e9, 1e12, INFINITY};
static const double gamma_end[GAMMA] = {0, 1e-12, 1, 1e12, INFINITY};
static const long corners = CHI * PSI * DELTA1 * GAMMA;
enum class { ELASTIC, KELVIN_VOIGT, STANDARD, MAXWELL, PRONY, CLASSES };

struct solved_case {
    restitute_impact impact; /* with a solid of its own, or none */
    double tolerance;
    int status;
    restitute_result result;
};

struct campaign {
    restitute_options options;
    restitute_solver *solver[TOLERANCES], *second[TOLERANCES];
    int every; /* so many cases are one sample of the second method */
    uint64_t seed;
    long status[4]; /* OK, NO_REBOUND, TOLERANCE_NOT_REACHED, failed */
    long ledgers, batched, compared, unknown, low, far;
    struct worst slowest, residual, error; /* s, of the energy, over the estimate */
    struct remark remarks[most_remarks];
};

/* Of sync, and of the others, which are dearer. */
static const double fine_tolerances[TOLERANCES] = {1e-2, 1e-3, 1e-5, 1e-7},
                    coarse_tolerances[TOLERANCES] = {0.1, 1e-2, 3e-3, 1e-3};
static const double *tolerances = coarse_tolerances;

/* Two to thirty terms anywhere in 24 decades of time; every fourth solid flows, every second has a
 * dashpot. */
static restitute_material *draw_prony(uint64_t *random)
{
    double tau[most_terms], g[most_terms];
    const int terms = 2 + random_below(random, most_terms - 1), flows = random_below(random, 4) == 0;
    const int narrow = random_below(random, 2); /* moduli of one order: as measured series are */
    const double eta = random_below(random, 2) ? random_log(random, 1e-12, 1e12) : 0;
    for (int k = 0; k < terms; k++) {
        tau[k] = random_log(random, 1e-12, 1e12);
        g[k] = narrow ? random_log(random, 0.1, 10) : random_log(random, 1e-12, 1e12);
    }
    return solid_of(flows ? 0 : 1, eta, (size_t)terms, tau, g);
}

static struct solved_case draw(const struct campaign *c, long number)
{
    struct solved_case d = {.tolerance = tolerances[number % TOLERANCES]};
    if (number < corners) {
        d.impact = impact_of(chi_end[number % CHI], psi_end[number / CHI % PSI],
                             delta1_end[number / CHI / PSI % DELTA1], gamma_end[number / CHI / PSI / DELTA1]);
        return d;
    }
    uint64_t random = random_of(c->seed, number);
    enum class class = (enum class)random_below(&random, CLASSES);
    if (class == ELASTIC && random_below(&random, 8)) class = STANDARD; /* they are all alike */
    const double g = 1, chi = fmax(1.0 / 3, random_log(&random, 1.0 / 3, 1e3)), psi = random_log(&random, 1e-9, 1e9);
    const double delta1 = random_log(&random, 1e-12, 1e12), gamma = random_log(&random, 1e-12, 1e12);
    d.impact = impact_of(chi, psi, class == ELASTIC ? 0 : delta1, class == KELVIN_VOIGT ? 0 : gamma);
    if (class == MAXWELL) d.impact.material = solid_of(0, 0, 1, &delta1, &g);
    if (class == PRONY) d.impact.material = draw_prony(&random);
    return d;
}

static void check_result(const struct solved_case *d, double max_work, const char *message)
{
    const restitute_result *r = &d->result;
    const double error = fmax(r->error_ez, r->error_ex);
    const int status = d->status;
    const char *wrong = fault_of(r, status);
    if (status < 0) {
        EXPECT(message[0] != '\0', "status %d without a message", status);
        EXPECT(r->ez == 42 && r->work == 42, "a failed call wrote its result");
        return;
    }
    EXPECT(!wrong, "%s: ez %.17g ex %.17g, status %d, error %g", wrong, r->ez, r->ex, status, error);
    EXPECT(r->max_normal_force > 0 && isfinite(r->max_normal_force), "largest force %g", r->max_normal_force);
    EXPECT(r->max_indentation > 0 && isfinite(r->max_indentation), "depth %g", r->max_indentation);
    EXPECT(r->work <= 2 * max_work, "work %g of max_work %g", r->work, max_work);
    EXPECT(status != RESTITUTE_OK || error <= d->tolerance, "OK with an estimate of %g", error);
    EXPECT(status != RESTITUTE_TOLERANCE_NOT_REACHED || (error > d->tolerance && message[0]),
           "TOLERANCE_NOT_REACHED with %g, message '%s'", error, message);
}

/* Parts of the energy are not negative, and nearly all is accounted for: ten times what the methods
 * miss in usual impacts. The estimate of e_z, which ends at 1, covers what the rebound differs by
 * from its square. It is an estimate, not a bound: a fault is ten times as much, as in
 * compare(). */
static void check_ledger(struct campaign *c, const restitute_result *r, const restitute_ledger *l)
{
    const double parts[] = {l->rebound_z,  l->viscous_z, l->left_z, l->rebound_x,
                            l->friction_x, l->viscous_x, l->left_x};
    for (int k = 0; k < 7; k++)
        EXPECT(parts[k] >= -1e-12 && isfinite(parts[k]), "part %d of the ledger is %g", k, parts[k]);
    EXPECT(fabs(l->residual_z) <= 0.02 && fabs(l->residual_x) <= 0.05, "residuals %g %g", l->residual_z, l->residual_x);
    EXPECT(fabs(l->rebound_z - r->ez * r->ez) <= 10 * r->error_ez + 1e-12, "rebound %.17g of ez %.17g", l->rebound_z,
           r->ez);
    c->ledgers++;
    keep_worst(&c->residual, fabs(l->residual_z));
}

/* What two results differ by beyond the estimate of the second, over that of the first. */
static void compare(struct campaign *c, const struct solved_case *d)
{
    const restitute_result *r = &d->result;
    PREPARED(result, other);
    const int status = restitute_solve(c->second[current % TOLERANCES], &d->impact, &other, NULL, NULL, NULL);
    const double z = fabs(r->ez - other.ez) - other.error_ez - 1e-15,
                 x = fabs(r->ex - other.ex) - other.error_ex - 1e-15;
    const int known = status >= 0 && !(fmax(other.error_ez, other.error_ex) > d->tolerance);
    c->compared += known;
    c->unknown += !known;
    if (!known) return;
    const double ratio = fmax(z <= 0 ? 0 : z / r->error_ez, x <= 0 ? 0 : x / r->error_ex);
    c->low += ratio > 1;
    c->far += ratio > 10;
    EXPECT(ratio <= 10 || fmax(z, x) <= d->tolerance, /* wrong, and nothing says so */
           "ez %.9g ex %.9g, estimates %.2g %.2g; second method %.9g %.9g, %.2g %.2g: %.3g times", r->ez, r->ex,
           r->error_ez, r->error_ex, other.ez, other.ex, other.error_ez, other.error_ex, ratio);
    keep_worst(&c->error, ratio);
}

static void solve_case(struct campaign *c, struct solved_case *d)
{
    restitute_error error = {0};
    PREPARED(ledger, ledger);
    restitute_result *r = &d->result;
    const int k = (int)(current % TOLERANCES), with_ledger = current % 16 == 3 && d->impact.psi >= 1e-3;
    const long before = faults;
    restitute_result_init(r);
    r->ez = r->work = 42;
    alarm(60); /* hangs */
    feclearexcept(FE_ALL_EXCEPT);
    const double start = bench_time();
    d->status = restitute_solve(c->solver[k], &d->impact, r, with_ledger ? &ledger : NULL, NULL, &error);
    const double taken = bench_time() - start;
    expect_no_exception("restitute_solve");
    alarm(0);
    c->status[d->status < 0 || d->status > 2 ? 3 : d->status]++;
    /* nominal seconds may be some of this machine */
    const double limit = fmax(0.1, fmin(c->options.time_limit, 4 * c->options.max_work));
    EXPECT(with_ledger || taken <= 2 * limit, "%.2f s", taken);
    if (!with_ledger) keep_worst(&c->slowest, taken);
    if (d->status < 0 || d->status == RESTITUTE_TOLERANCE_NOT_REACHED) add_remark(c->remarks, d->status, error.message);
    check_result(d, c->options.max_work, error.message);
    if (with_ledger && d->status == RESTITUTE_OK && !strstr(error.message, "ledger: ")) /* a remark: off */
        check_ledger(c, r, &ledger);
    if (d->status >= 0 && c->second[k] && current / TOLERANCES % c->every == 0) compare(c, d);
    if (faults > before && faults <= shown_faults)
        printf("    tolerance %g, chi %.17g psi %.17g delta1 %.17g gamma %.17g, %zu terms\n", d->tolerance,
               d->impact.chi, d->impact.psi, d->impact.delta1, d->impact.gamma,
               restitute_material_terms(d->impact.material));
}

/* Cases of one tolerance again, in one call, by two threads: the same bits. */
static void check_batch(struct campaign *c, const struct solved_case *d, long first)
{
    enum { n = block / TOLERANCES };
    restitute_options options = c->options;
    options.threads = 2;
    for (int k = 0; k < TOLERANCES; k++) {
        restitute_impact impacts[n];
        restitute_result again[n];
        int statuses[n];
        for (int j = 0; j < n; j++) {
            restitute_result_init(&again[j]);
            impacts[j] = d[k + TOLERANCES * j].impact;
        }
        options.tolerance = d[k].tolerance;
        alarm(600);
        restitute_solve_many(n, impacts, &options, again, statuses, NULL);
        alarm(0);
        for (int j = 0; j < n; j++) {
            const struct solved_case *single = &d[k + TOLERANCES * j];
            const restitute_result *r = &single->result, *b = &again[j];
            current = first + k + TOLERANCES * j;
            if (current % 16 == 3) continue; /* a ledger rounds otherwise */
            EXPECT(statuses[j] == single->status, "status %d, in a batch %d", single->status, statuses[j]);
            EXPECT(single->status < 0 || (b->ez == r->ez && b->ex == r->ex && b->error_ex == r->error_ex),
                   "ez %.17g ex %.17g, in a batch %.17g %.17g", r->ez, r->ex, b->ez, b->ex);
            c->batched++;
        }
    }
}

static void run(struct campaign *c, long first, long count)
{
    static struct solved_case cases[block];
    for (long at = first; at < first + count; at += block) {
        const int n = (int)(first + count - at < block ? first + count - at : block);
        for (int i = 0; i < n; i++) {
            current = at + i;
            cases[i] = draw(c, current);
            solve_case(c, &cases[i]);
        }
        if (n == block && at / block % 16 == 0 && isinf(c->options.time_limit)) check_batch(c, cases, at);
        for (int i = 0; i < n; i++)
            restitute_material_destroy((restitute_material *)cases[i].impact.material);
        if (at / block % 256 == 0) fprintf(stderr, "%ld of %ld, %ld faults\n", at + n - first, count, faults);
    }
}

static void report(const struct campaign *c)
{
    const long *s = c->status;
    current = -1;
    EXPECT(c->far < 3 || 200 * c->far <= c->compared, /* compare() forgives a wrong number within the tolerance */
           "%ld of %ld compared are beyond ten estimates", c->far, c->compared);
    printf("%ld cases: OK %ld, NO_REBOUND %ld, TOLERANCE_NOT_REACHED %ld, failed %ld\n", s[0] + s[1] + s[2] + s[3],
           s[0], s[1], s[2], s[3]);
    printf("compared %ld, unknown %ld: error > estimate %ld, > 10 estimates %ld, worst %.3g (case %ld)\n", c->compared,
           c->unknown, c->low, c->far, c->error.value, c->error.number);
    print_remarks(c->remarks);
    printf("slowest %.3f s (case %ld); ledgers %ld, largest residual_z %.2g (case %ld); in batches %ld; faults %ld\n",
           c->slowest.value, c->slowest.number, c->ledgers, c->residual.value, c->residual.number, c->batched, faults);
}

int main(int argc, char **argv)
{
    static struct campaign c;
    const struct bench_method *method = argc > 3 && argc < 8 ? bench_method(argv[1]) : NULL;
    if (!method || !method->handle) {
        fprintf(stderr, "usage: extremes sync|euler|cvode COUNT SEED [FIRST [MAX_WORK [TIME_LIMIT]]]\n");
        return 2;
    }
    const int is_sync = method->handle == restitute_method_sync;
    const struct bench_method *other = bench_method(is_sync ? "cvode" : "sync"); /* NULL without the component cvode */
    if (is_sync) tolerances = fine_tolerances;
    restitute_options_init(&c.options);
    c.options.method = method->handle();
    c.options.max_work = argc > 5 ? strtod(argv[5], NULL) : 0.01;
    c.options.time_limit = argc > 6 ? strtod(argv[6], NULL) : INFINITY;
    c.seed = strtoull(argv[3], NULL, 10);
    c.every = is_sync ? 64 : 4; /* sync is the fast one */
    restitute_options second = c.options;
    if (other) second.method = other->handle();
    second.max_work = 0.1, second.time_limit = INFINITY;
    for (int k = 0; k < TOLERANCES; k++) {
        c.options.tolerance = tolerances[k], second.tolerance = tolerances[k] / 10;
        c.solver[k] = make_solver(&c.options);
        if (other) c.second[k] = make_solver(&second);
    }
    watch_signals();
    run(&c, argc > 4 ? strtol(argv[4], NULL, 10) : 0, strtol(argv[2], NULL, 10));
    report(&c);
    for (int k = 0; k < TOLERANCES; k++) {
        restitute_solver_destroy(c.solver[k]);
        restitute_solver_destroy(c.second[k]);
    }
    return faults > 0;
}
