/* What restitute/cvode.h promises apart from the physics: refusals, untouched outputs, work,
 * history.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <stdlib.h>
#include <string.h>

#include "../support/comma_locale.h"
#include "../support/cvode.h"
#include "../support/history.h"
#include "../support/time_limit.h"

static restitute_solver *make(restitute_options options)
{
    restitute_solver *solver;
    restitute_error error;
    CHECK(restitute_solver_create(&options, &solver, &error) == RESTITUTE_OK, "%s", error.message);
    return solver;
}

/* The call fails with this status and a message that holds `word`, and the result stays as it
 * was. */
static void refused(restitute_solver *solver, restitute_impact impact, int status, const char *word)
{
    restitute_result result, before;
    restitute_error error;
    memset(&result, 7, sizeof result);
    restitute_result_init(&result);
    memcpy(&before, &result, sizeof result);
    const int found = restitute_solve(solver, &impact, &result, NULL, NULL, &error);
    CHECK(found == status, "%d and not %d: %s", found, status, error.message);
    CHECK(strstr(error.message, word) != NULL, "\"%s\" is not in \"%s\"", word, error.message);
    CHECK(memcmp(&result, &before, sizeof result) == 0, "the result was touched: %s", error.message);
}

static void failures_touch_nothing(void **state)
{
    restitute_options options = cvode_to(1e-5);
    (void)state;
    restitute_solver *solver = make(options);
    refused(solver, impact_of(7.0 / 6, -1, 1, 1), RESTITUTE_ERROR_DOMAIN, "psi");
    refused(solver, impact_of(7.0 / 6, NAN, 1, 1), RESTITUTE_ERROR_DOMAIN, "psi");
    refused(solver, impact_of(0, 1, 1, 1), RESTITUTE_ERROR_DOMAIN, "chi");
    restitute_solver_destroy(solver);
    options.max_work = 1e-5; /* less than one run of the normal side and its elements */
    solver = make(options);
    refused(solver, impact_of(7.0 / 6, 0.5, 1, 1), RESTITUTE_ERROR_TOO_MUCH_WORK, "max_work");
    restitute_solver_destroy(solver);
    options = cvode_to(1e-5);
    options.elements = 100000;
    solver = make(options);
    refused(solver, impact_of(7.0 / 6, 0.5, 1, 1), RESTITUTE_ERROR_DOMAIN, "16384");
    restitute_solver_destroy(solver);
    options = cvode_to(1e-5);
    options.method = restitute_method_cvode_adams();
    solver = make(options);
    refused(solver, impact_of(7.0 / 6, 0.5, 0.1, 1e-3), RESTITUTE_ERROR_UNSTABLE_STEP, "cvode-bdf");
    restitute_solver_destroy(solver);
}

/* Elements are doubled while the estimate is above nine tenths of the tolerance. The status says
 * whether it is above the tolerance. */
static void status_follows_the_reported_estimate(void **state)
{
    int reached = 0, missed = 0;
    (void)state;
    for (double tolerance = 3e-5; tolerance < 3e-4; tolerance *= 1.03) {
        restitute_options options = cvode_to(tolerance);
        options.elements = 32;
        const struct solution s = solve_pair(options, impact_of(7.0 / 6, 0.7, 0.1, 1));
        const int met = s.result.error_ez <= tolerance && s.result.error_ex <= tolerance;
        CHECK(s.status == (met ? RESTITUTE_OK : RESTITUTE_TOLERANCE_NOT_REACHED), "status %d: %g and %g of %g",
              s.status, s.result.error_ez, s.result.error_ex, tolerance);
        reached += met;
        missed += !met;
    }
    CHECK(reached > 9 && missed > 9, "%d, %d", reached, missed);
}

/* What max_work allows is given, with an estimate that holds, and the message names the number that
 * was set. 1e-6: the error of the reference; elements are as many as fit, and no more than were
 * asked for. */
static void max_work_ends_with_the_best_result(void **state)
{
    const restitute_impact impact = impact_of(8, 0.5, 0, 1);
    const double ex = solve_pair(cvode_to(1e-6), impact).result.ex;
    double last_error = INFINITY;
    (void)state;
    for (int i = 0; i < 5; i++) {
        restitute_options options = cvode_to(1e-6);
        restitute_result r;
        restitute_error error;
        char named[60];
        restitute_result_init(&r);
        options.max_work = 1.0001e-3 * pow(3, i);
        options.elements = i == 3 ? 400 : 0;
        restitute_solver *solver = make(options);
        const int status = restitute_solve(solver, &impact, &r, NULL, NULL, &error);
        CHECK(status == RESTITUTE_TOLERANCE_NOT_REACHED, "%g: %d, %s", options.max_work, status, error.message);
        snprintf(named, sizeof named, "max_work = %g:", options.max_work);
        CHECK(strstr(error.message, named) != NULL, "\"%s\" is not in \"%s\"", named, error.message);
        CHECK(r.work <= options.max_work * 1.01, "%g of %g", r.work,
              options.max_work); /* looked at after a step, so the last one may pass it */
        CHECK(r.error_ex < last_error && (i != 3 || r.elements < 400), "%lld elements, %g", (long long)r.elements,
              r.error_ex);
        CHECK_NEAR(r.ex, ex, r.error_ex + 1e-6, "%lld elements", (long long)r.elements);
        last_error = r.error_ex;
        restitute_solver_destroy(solver);
    }
}

/* The tolerance is the caller's, though slip that is left out takes a part of it. Numbers have a
 * point in every locale. */
static void limits_are_named_as_the_caller_gave_them(void **state)
{
    static const char *const names[][2] = {{"max_work = 1.5e-06: ", "too little for the normal motion"},
                                           {"tolerance = 1e-08: ", "max_work = 0.01: "}};
    const restitute_impact impact = impact_of(7.0 / 6, 1e-9, 1, 1);
    (void)state;
    for (int i = 0; i < 2; i++) {
        restitute_options options = cvode_to(1e-8);
        restitute_error error;
        options.max_work = i ? 1e-2 : 1.5e-6;
        restitute_solver *solver = make(options);
        set_comma_locale();
        restitute_solve(solver, &impact, NULL, NULL, NULL, &error);
        setlocale(LC_ALL, "C"); /* before anything can fail */
        CHECK(strstr(error.message, names[i][0]) && strstr(error.message, names[i][1]), "%s", error.message);
        restitute_solver_destroy(solver);
    }
}

/* Without a limit: a minute. */
static void time_limit_ends_with_the_best_result(void **state)
{
    (void)state;
    check_time_limit(cvode_to(1e-6),
                     impact_of(388.75154582840514, 26.42748466847636, 1.8011568930709814, 0.049585286428120476), 0.5,
                     0.0002665);
}

static void arguments_are_checked(void **state)
{
    struct recording r = record_with(cvode_to(1e-3));
    const restitute_impact impact = impact_of(7.0 / 6, 0.5, 1, 1);
    restitute_cvode_recorder *none = NULL;
    restitute_cvode_events events;
    restitute_cvode_work work;
    restitute_error error;
    restitute_options options = cvode_to(1e-3);
    (void)state;
    restitute_cvode_events_init(&events);
    restitute_cvode_work_init(&work);
    CHECK(restitute_cvode_recorder_create(NULL, NULL, &error) == RESTITUTE_ERROR_NULL, "recorder");
    CHECK(restitute_cvode_recorder_create(restitute_method_sync(), &none, &error) == RESTITUTE_ERROR_DOMAIN && !none,
          "%s", error.message);
    CHECK(restitute_cvode_recorder_method(NULL) == NULL, "method of none");
    CHECK(restitute_cvode_recorder_events(NULL, &events, &error) == RESTITUTE_ERROR_NULL, "recorder");
    CHECK(restitute_cvode_recorder_events(r.recorder, NULL, &error) == RESTITUTE_ERROR_NULL, "events");
    CHECK(restitute_cvode_recorder_events(r.recorder, &events, &error) == RESTITUTE_ERROR_DOMAIN, "no impact yet");
    CHECK(restitute_cvode_recorder_work(r.recorder, &work, &error) == RESTITUTE_ERROR_DOMAIN, "no impact yet");
    CHECK(restitute_solve(r.solver, &impact, NULL, NULL, NULL, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(restitute_cvode_recorder_work(r.recorder, NULL, &error) == RESTITUTE_ERROR_NULL, "work");
    CHECK(restitute_cvode_recorder_work(r.recorder, &work, &error) == RESTITUTE_OK, "%s", error.message);
    CHECK(work.steps > 0 && work.rates >= work.steps && work.events > 0 && work.restarts > 0 && !work.stiff,
          "%lld steps", (long long)work.steps);
    events.capacity = 3;
    CHECK(restitute_cvode_recorder_events(r.recorder, &events, &error) == RESTITUTE_ERROR_NULL, "array");
    end_recording(&r);
    options.time_step = 0.1;
    CHECK(restitute_solver_create(&options, &r.solver, &error) == RESTITUTE_ERROR_DOMAIN, "time_step");
    CHECK(strcmp(restitute_cvode_event_text(RESTITUTE_CVODE_EVENT_STICK_TO_SLIP), "stick-to-slip") == 0, "text");
    CHECK(strcmp(restitute_cvode_event_text(99), "unknown event") == 0, "text");
}

/* capacity 0 tells how many there are; a short array gets the first ones. Of an impact that failed
 * there are none; one whose input was refused was none. */
static void events_may_be_counted_first(void **state)
{
    const struct recording r = record_with(cvode_to(1e-3));
    restitute_impact impact = impact_of(7.0 / 6, 0.5, 1, 1);
    restitute_cvode_events events;
    restitute_cvode_event few[3] = {{0}};
    restitute_error error;
    (void)state;
    restitute_cvode_events_init(&events);
    CHECK(restitute_solve(r.solver, &impact, NULL, NULL, NULL, &error) == 0, "%s", error.message);
    CHECK(restitute_cvode_recorder_events(r.recorder, &events, &error) == 0, "%s", error.message);
    const size_t count = events.count;
    CHECK(count > 10, "%zu", count);
    events.event = few;
    events.capacity = 2;
    CHECK(restitute_cvode_recorder_events(r.recorder, &events, &error) == 0, "%s", error.message);
    CHECK(events.count == count && few[1].kind == RESTITUTE_CVODE_EVENT_ENTRY && few[2].kind == 0, "%zu", events.count);
    impact.chi = -1;
    CHECK(restitute_solve(r.solver, &impact, NULL, NULL, NULL, NULL) == RESTITUTE_ERROR_DOMAIN, "chi");
    CHECK(restitute_cvode_recorder_events(r.recorder, &events, &error) == 0 && events.count == count, "%zu",
          events.count);
    impact.chi = 7.0 / 6;
    end_recording(&r);
    restitute_options little = cvode_to(1e-3);
    little.max_work = 1e-5;
    const struct recording failing = record_with(little);
    CHECK(restitute_solve(failing.solver, &impact, NULL, NULL, NULL, &error) < 0, "it had enough");
    CHECK(restitute_cvode_recorder_events(failing.recorder, &events, &error) == 0 && events.count == 0, "%zu events",
          events.count);
    end_recording(&failing);
}

/* Work depends on the scene: no tangential work without friction or in slip to the end, fewer steps
 * for a larger tolerance. */
static void scenes_leave_out_what_they_do_not_need(void **state)
{
    const double psi[] = {0.5, 9};
    restitute_cvode_work work[2];
    restitute_error error;
    (void)state;
    for (int i = 0; i < 2; i++) {
        const struct recording r = record_with(cvode_to(1e-5));
        restitute_impact impact = impact_of(7.0 / 6, psi[i], 0, 1);
        CHECK(restitute_solve(r.solver, &impact, NULL, NULL, NULL, &error) == 0, "%s", error.message);
        restitute_cvode_work_init(&work[i]);
        CHECK(restitute_cvode_recorder_work(r.recorder, &work[i], &error) == 0, "%s", error.message);
        end_recording(&r);
    }
    CHECK(work[1].events <= 4, "slip to the end: turn and end of two runs, and no more: %lld",
          (long long)work[1].events);
    CHECK(work[0].events > 20 && work[0].rates > 2 * work[1].rates, "%lld", (long long)work[0].rates);
}

/* Evenly spaced from first touch to the end, as restitute.h says; the end is the pair's. There are
 * more samples than steps. */
static void history_ends_with_the_pair(void **state)
{
    enum { samples = 500 };
    static double a[8][samples];
    restitute_solver *solver = make(cvode_to(1e-5));
    const double psi[] = {0, 0.7, 1.8, 9};
    (void)state;
    for (int i = 0; i < 4; i++) {
        restitute_impact impact = impact_of(7.0 / 6, psi[i], 1, 1);
        restitute_result result;
        restitute_history h;
        restitute_error error;
        restitute_result_init(&result);
        restitute_history_init(&h);
        set_columns(&h, samples, a[0], all_columns);
        CHECK(restitute_solve(solver, &impact, &result, NULL, &h, &error) == 0, "%s", error.message);
        CHECK(h.count == samples && result.steps < samples / 2, "%zu of %lld steps", h.count, (long long)result.steps);
        for (int k = 0; k < samples; k++) {
            CHECK_NEAR(a[0][k], k * result.contact_time / (samples - 1), 1e-5, "sample %d", k);
            CHECK(a[3][k] <= a[2][k] && a[4][k] >= -1e-6, "sample %d: %g of %g, force %g", k, a[3][k], a[2][k],
                  a[4][k]);
            if (psi[i] > 0) CHECK(fabs(a[5][k]) <= a[4][k] + 1e-6, "sample %d: more than friction gives", k);
        }
        const double scale = psi[i] > 0 ? psi[i] : 1;
        CHECK_NEAR(-a[6][samples - 1], result.ez, 1e-5, "psi %g", psi[i]);
        CHECK_NEAR(-a[7][samples - 1] / scale, result.ex, 1e-3, "psi %g: not extrapolated", psi[i]);
    }
    restitute_solver_destroy(solver);
}

static void an_infinite_psi_is_no_friction(void **state)
{
    (void)state;
    const struct solution s = solve_pair(cvode_to(1e-4), impact_of(7.0 / 6, INFINITY, 1, 1));
    CHECK(s.result.ex == -1 && s.result.error_ex == 0, "%g +- %g", s.result.ex, s.result.error_ex);
}

/* A Maxwell body with a short tau (docs/theory.md, section 6); nothing is left to slide with 2 chi
 * > 1. */
static void sinking_spheres_are_told(void **state)
{
    const double tau[] = {0.2}, g[] = {1};
    (void)state;
    restitute_material *maxwell = solid_of(0, 0, 1, tau, g);
    const struct solution s = solve_pair(cvode_to(1e-4), impact_on(maxwell, 7.0 / 6, 0.5));
    CHECK(s.status == RESTITUTE_NO_REBOUND, "status %d", s.status);
    CHECK(s.result.ez == 0 && s.result.ex == 0 && isinf(s.result.contact_time), "%g %g", s.result.ez, s.result.ex);
    /* a rebound slower than a hundredth of the tolerance counts as none */
    CHECK_NEAR(s.result.error_ez, 1e-6, 1e-15, "the threshold");
    CHECK(s.result.error_ex >= 1e-6 && s.result.error_ex < 1e-4, "%g", s.result.error_ex);
    restitute_solver *solver = make(cvode_to(1e-4));
    refused(solver, impact_on(maxwell, 0.4, 0.5), RESTITUTE_ERROR_DOMAIN, "euler or sync");
    refused(solver, impact_on(maxwell, 0.4, 0), RESTITUTE_ERROR_DOMAIN, "euler or sync");
    restitute_solver_destroy(solver);
    restitute_material_destroy(maxwell);
}

/* A solver gives the same results for any order of the impacts. */
static void a_solver_keeps_nothing_of_the_last_impact(void **state)
{
    restitute_solver *solver = make(cvode_to(1e-4));
    const restitute_impact one = impact_of(7.0 / 6, 0.5, 1, 1), other = impact_of(2, 0.3, 0.1, 0);
    restitute_result first, again;
    restitute_error error;
    (void)state;
    restitute_result_init(&first);
    restitute_result_init(&again);
    CHECK(restitute_solve(solver, &one, &first, NULL, NULL, &error) == 0, "%s", error.message);
    CHECK(restitute_solve(solver, &other, &again, NULL, NULL, &error) == 0, "%s", error.message);
    CHECK(restitute_solve(solver, &one, &again, NULL, NULL, &error) == 0, "%s", error.message);
    CHECK(first.ez == again.ez && first.ex == again.ex, "%.17g %.17g", first.ex, again.ex);
    restitute_solver_destroy(solver);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(failures_touch_nothing),
        cmocka_unit_test(status_follows_the_reported_estimate),
        cmocka_unit_test(max_work_ends_with_the_best_result),
        cmocka_unit_test(limits_are_named_as_the_caller_gave_them),
        cmocka_unit_test(time_limit_ends_with_the_best_result),
        cmocka_unit_test(arguments_are_checked),
        cmocka_unit_test(events_may_be_counted_first),
        cmocka_unit_test(scenes_leave_out_what_they_do_not_need),
        cmocka_unit_test(history_ends_with_the_pair),
        cmocka_unit_test(an_infinite_psi_is_no_friction),
        cmocka_unit_test(sinking_spheres_are_told),
        cmocka_unit_test(a_solver_keeps_nothing_of_the_last_impact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
