/* Failures inside the method `cvode`. Failures of CVODE are reported with its text, too many events
 * and endless runs with ours. Nothing is printed. The failures are provoked: a right-hand side
 * without a finite value, limits below those of a normal run.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cvode/solve.h"

#include "../support/cvode.h"

/* Standard output and standard error go to a file from capture() on; captured() undoes that and
 * tells how much was written. */
struct capture {
    FILE *file;
    int output, error;
};

static struct capture capture(void)
{
    fflush(NULL);
    struct capture c = {tmpfile(), dup(STDOUT_FILENO), dup(STDERR_FILENO)};
    CHECK(c.file && c.output >= 0 && c.error >= 0, "no file to capture in");
    dup2(fileno(c.file), STDOUT_FILENO);
    dup2(fileno(c.file), STDERR_FILENO);
    return c;
}

static long captured(struct capture *c)
{
    fflush(NULL);
    dup2(c->output, STDOUT_FILENO);
    dup2(c->error, STDERR_FILENO);
    close(c->output);
    close(c->error);
    fseek(c->file, 0, SEEK_END);
    const long written = ftell(c->file);
    fclose(c->file);
    return written;
}

/* y' = -y for a number of evaluations; after them it has no value. */
struct decay {
    long calls, most;
};

static int rates(void *owner, double t, const double *y, double *rate)
{
    struct decay *decay = owner;
    (void)t;
    rate[0] = -y[0];
    return ++decay->calls > decay->most;
}

static void roots(void *owner, double t, const double *y, double *value)
{
    (void)owner, (void)t;
    value[0] = y[0] - 0.5;
}

static void newton(void *owner, double gamma, const double *y, const double *b, double *x)
{
    (void)owner, (void)y;
    x[0] = b[0] / (1 + gamma);
}

static void weights(void *owner, const double *y, double *weight)
{
    (void)owner, (void)y;
    weight[0] = 1e8;
}

static struct integrator *decay_by(enum integrator_family family, struct decay *decay, char *text, int size,
                                   int *status)
{
    const struct integrator_system system = {.n_states = 1,
                                             .n_roots = 1,
                                             .family = family,
                                             .horizon = 1,
                                             .rates = rates,
                                             .roots = roots,
                                             .newton = newton,
                                             .weights = weights,
                                             .owner = decay};
    const double y = 1;
    struct integrator *integrator;
    *status = rst_integrator_create(&system, 0, &y, &integrator, text, size);
    return integrator;
}

/* Where it came to, and the last event on the way. */
struct course {
    enum integrator_return what;
    double t, y, event_time;
    int events;
};

/* Steps to t = 1 or to a failure. */
static struct course follow(struct integrator *integrator)
{
    struct course c = {.what = INTEGRATOR_STEP, .y = 1};
    for (int i = 0; i < 5000 && c.t < 1 && c.what != INTEGRATOR_FAILED; i++) {
        c.what = rst_integrator_advance(integrator, &c.t, &c.y);
        if (c.what == INTEGRATOR_EVENT) c.event_time = c.t;
        c.events += c.what == INTEGRATOR_EVENT;
    }
    return c;
}

static void failures_have_the_words_of_cvode_and_print_nothing(void **state)
{
    const enum integrator_family families[] = {INTEGRATOR_ADAMS, INTEGRATOR_BDF};
    (void)state;
    for (int i = 0; i < 2; i++) {
        long calls = 0;
        for (int k = 0; k < 3; k++) { /* all the way, almost, and nothing at all */
            struct decay decay = {0, k == 0 ? 100000 : k == 1 ? calls - 3 : 0};
            char text[200] = "", words[200];
            int status;
            struct course course = {.what = INTEGRATOR_FAILED};
            struct capture c = capture();
            struct integrator *integrator = decay_by(families[i], &decay, text, sizeof text, &status);
            if (integrator) course = follow(integrator);
            snprintf(words, sizeof words, "%s", integrator ? rst_integrator_text(integrator) : text);
            rst_integrator_destroy(integrator);
            const long written = captured(&c);
            if (k == 0) calls = decay.calls;
            CHECK(written == 0, "family %d, case %d: %ld bytes printed", i, k, written);
            CHECK(status == RESTITUTE_OK, "family %d, case %d: %d, %s", i, k, status, text);
            CHECK(course.what == (k == 0 ? INTEGRATOR_STEP : INTEGRATOR_FAILED), "family %d, case %d: %d at %g", i, k,
                  (int)course.what, course.t);
            CHECK(course.events == (k < 2), "family %d, case %d: %d events", i, k, course.events);
            /* the function falls through 0 at log 2; 1e-6: a hundred times the error of a step */
            if (k < 2) CHECK_NEAR(course.event_time, log(2), 1e-6, "family %d, case %d", i, k);
            if (k == 0) CHECK_NEAR(course.y, exp(-course.t), 1e-6, "family %d, at %g", i, course.t);
            if (k == 0) CHECK(strcmp(words, "no message") == 0, "%s", words);
            if (k > 0)
                CHECK(strstr(words, k == 1 ? "At t = " : "right-hand side"), "family %d, case %d: \"%s\"", i, k, words);
        }
    }
}

/* An elastic impact with 40 elements, or one on a solid that is no number; `spoil` changes the
 * limits of the run. */
static int follow_impact(double modulus, void (*spoil)(struct run_setup *setup), struct run *run)
{
    const struct rst_problem problem = {.method = restitute_method_cvode(),
                                        .chi = 8,
                                        .psi = 0.5,
                                        .shear_speed = 0.5,
                                        .mode = RST_PARTIAL_SLIP,
                                        .solid = {.g_inf = modulus},
                                        .tolerance = 1e-4,
                                        .max_work = 10,
                                        .max_updates = 1000000000};
    struct run_setup setup = rst_cvode_setup(&problem);
    struct trace trace = {0};
    *run = (struct run){0};
    int status = rst_run_follow(run, &setup, &trace, NULL); /* the normal side */
    rst_run_release(run);
    if (!status) {
        setup.radius = sqrt(run->max_depth);
        setup.n_nodes = 40;
        spoil(&setup);
        *run = (struct run){0};
        status = rst_run_follow(run, &setup, &trace, NULL);
        rst_run_release(run);
    }
    rst_trace_release(&trace);
    return status;
}

static void spoil_nothing(struct run_setup *setup)
{
    (void)setup;
}

static void allow_no_event(struct run_setup *setup)
{
    setup->most_events = 0;
}

static void allow_thirty_steps(struct run_setup *setup)
{
    setup->most_steps = 30;
}

static void allow_little_work(struct run_setup *setup)
{
    setup->budget = 2000;
}

static void runs_without_end_are_ended_and_say_why(void **state)
{
    const struct {
        double modulus;
        void (*spoil)(struct run_setup *setup);
        int status;
        const char *words;
    } cases[] = {
        {1, spoil_nothing, RESTITUTE_OK, ""},
        {1, allow_no_event, RESTITUTE_ERROR_CONVERGENCE, "event storm"},
        {1, allow_thirty_steps, RESTITUTE_ERROR_CONVERGENCE, "more than 30 steps"},
        {1, allow_little_work, RESTITUTE_ERROR_TOO_MUCH_WORK, "max_work = 10:"},
        {NAN, spoil_nothing, RESTITUTE_ERROR_INTEGRATOR, "right-hand side"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct run run;
        struct capture c = capture();
        const int status = follow_impact(cases[i].modulus, cases[i].spoil, &run);
        const long written = captured(&c);
        CHECK(written == 0, "case %zu: %ld bytes printed", i, written);
        CHECK(status == cases[i].status, "case %zu: %d, %s", i, status, run.text);
        CHECK(strstr(run.text, cases[i].words) != NULL, "case %zu: \"%s\"", i, run.text);
        CHECK((status == RESTITUTE_OK) == run.ended, "case %zu", i);
    }
}

/* The result of a call: the status and the message. */
static void a_call_hands_on_the_words_of_cvode(void **state)
{
    const struct rst_problem problem = {.method = restitute_method_cvode(),
                                        .chi = 8,
                                        .psi = 0.5,
                                        .shear_speed = 0.5,
                                        .mode = RST_PARTIAL_SLIP,
                                        .solid = {.g_inf = NAN},
                                        .tolerance = 1e-4,
                                        .max_work = 10,
                                        .max_updates = 1000000000};
    struct cvode_memory memory = {.trace = {0}};
    struct rst_outcome outcome;
    restitute_error error = {.status = RESTITUTE_OK};
    (void)state;
    struct capture c = capture();
    const int status = rst_cvode_solve(&problem, &memory, 0, &outcome, &error);
    const long written = captured(&c);
    rst_trace_release(&memory.trace);
    CHECK(written == 0, "%ld bytes printed", written);
    CHECK(status == RESTITUTE_ERROR_INTEGRATOR && error.status == status, "%d: %s", status, error.message);
    CHECK(strstr(error.message, "right-hand side routine failed") != NULL, "\"%s\"", error.message);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(failures_have_the_words_of_cvode_and_print_nothing),
        cmocka_unit_test(runs_without_end_are_ended_and_say_why),
        cmocka_unit_test(a_call_hands_on_the_words_of_cvode),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
