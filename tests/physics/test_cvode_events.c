/* The events of the method `cvode` against instants that are known exactly.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/cvode.h"

static const double chi = 7.0 / 6;
static struct logged log_a, log_b;

/* Errors of the states are below the tolerance (test_cvode_truth.c); so are those of the instants
 * that they define, times the slope with which time follows, at most 2 in what is compared here. */
static const double tolerance = 1e-6, instant = 2e-6;

/* Elastic: D'^2 = 1 - D^(5/2), so with D^(5/2) = sin^2 p the time is (4/5) int_0^p sin^(-1/5); p =
 * u^5 makes that smooth. Simpson's rule with 2000 intervals. */
static double elastic_time(double depth)
{
    const int n = 2000;
    const double end = pow(asin(fmin(1, pow(depth, 1.25))), 0.2), h = end / n;
    double sum = 0;
    for (int i = 0; i <= n; i++) {
        const double u = i * h, p = pow(u, 5), ratio = u > 0 ? pow(p / sin(p), 0.2) : 1;
        sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * 4 * u * u * u * ratio;
    }
    return sum * h / 3;
}

static void elastic_entries_and_exits_are_those_of_hertz(void **state)
{
    (void)state;
    restitute_options options = cvode_to(tolerance);
    options.elements = 64;
    solve_logged(options, impact_of(chi, 0.5, 0, 1), &log_a);
    CHECK(count_events(&log_a, RESTITUTE_CVODE_EVENT_ENTRY) == 64, "%d",
          count_events(&log_a, RESTITUTE_CVODE_EVENT_ENTRY));
    CHECK(count_events(&log_a, RESTITUTE_CVODE_EVENT_EXIT) == 63, "%d",
          count_events(&log_a, RESTITUTE_CVODE_EVENT_EXIT));
    double last_entry = -1, last_exit = 2;
    for (size_t i = 0; i < log_a.events.count; i++) {
        const restitute_cvode_event *e = &log_a.event[i];
        if (e->kind != RESTITUTE_CVODE_EVENT_ENTRY && e->kind != RESTITUTE_CVODE_EVENT_EXIT) continue;
        const double x2 = e->position * e->position, t = elastic_time(x2);
        const double expected = e->kind == RESTITUTE_CVODE_EVENT_ENTRY ? t : 2.9432751843 - t;
        CHECK_NEAR(e->indentation, x2, instant, "D = X^2 at %g", e->position);
        /* time follows depth with 1/D', which grows towards the turning point */
        CHECK_NEAR(e->time, expected, instant / fabs(e->normal_velocity), "event %zu at %g", i, e->position);
        if (e->kind == RESTITUTE_CVODE_EVENT_ENTRY) {
            CHECK(e->position > last_entry, "entry %zu: not from the inside out", i);
            last_entry = e->position;
        } else {
            CHECK(e->position < last_exit, "exit %zu: the outermost does not leave first", i);
            last_exit = e->position;
        }
    }
    CHECK_NEAR(first_event(&log_a, RESTITUTE_CVODE_EVENT_CONTACT_END)->time, 2.9432751843, instant, "contact time");
    CHECK_NEAR(first_event(&log_a, RESTITUTE_CVODE_EVENT_TURN)->indentation, 1, instant, "largest indentation");
}

static void events_come_in_order_and_change_nothing(void **state)
{
    (void)state;
    solve_logged(cvode_to(1e-5), impact_of(chi, 0.8, 1, 0.5), &log_a);
    const struct solution s = solve_pair(cvode_to(1e-5), impact_of(chi, 0.8, 1, 0.5));
    CHECK(s.result.ez == log_a.result.ez && s.result.ex == log_a.result.ex, "%g %g", s.result.ez, log_a.result.ez);
    for (size_t i = 1; i < log_a.events.count; i++)
        CHECK(log_a.event[i].time >= log_a.event[i - 1].time, "event %zu", i);
    const restitute_cvode_event *last = &log_a.event[log_a.events.count - 1];
    CHECK(last->kind == RESTITUTE_CVODE_EVENT_CONTACT_END, "%s", restitute_cvode_event_text(last->kind));
    CHECK_NEAR(last->time, s.result.contact_time, 1e-5, "the end of contact");
    CHECK_NEAR(-last->normal_velocity, s.result.ez, 1e-5, "both are within the tolerance");
    /* one of the runs that the pair was extrapolated from: its own error is larger than that of the
     * pair */
    CHECK_NEAR(-last->tangential_velocity / 0.8, s.result.ex, 1e-3, "the run with most elements");
}

/* Also where the ledger is a run of its own, with fewer terms merged. */
static void events_are_those_of_the_pair(void **state)
{
    (void)state;
    PREPARED(ledger, ledger);
    const restitute_impact impact = impact_of(8.7442, 1.406e-3, 6.438e-5, 16.97);
    solve_logged(cvode_to(1e-3), impact, &log_a);
    solve_logged_with(cvode_to(1e-3), impact, &ledger, &log_b);
    CHECK_NEAR(ledger.friction_x, 0.8136, 0.01, "with the terms merged as for the pair it is 0.48");
    CHECK(log_a.events.count == log_b.events.count, "%zu, %zu events", log_a.events.count, log_b.events.count);
    for (size_t i = 0; i < log_a.events.count; i++)
        CHECK(log_a.event[i].time == log_b.event[i].time, "event %zu", i);
}

/* docs/theory.md, section 4: at D' = (2 chi - psi)/(2 chi - 1), everywhere at once, for any solid;
 * elastic: D from the energy. */
static void gross_slip_ends_once_and_everywhere(void **state)
{
    const double cases[][3] = {{1.5, 0, 1}, {2.5, 0, 1}, {2, 1, 1}, {1.5, 0.3, 0}, {2.6, 0.5, 0.1}};
    (void)state;
    for (int i = 0; i < 5; i++) {
        const double psi = cases[i][0], expected = (2 * chi - psi) / (2 * chi - 1);
        solve_logged(cvode_to(tolerance), impact_of(chi, psi, cases[i][1], cases[i][2]), &log_a);
        CHECK(count_events(&log_a, RESTITUTE_CVODE_EVENT_GROSS_SLIP_END) == 1, "case %d", i);
        const restitute_cvode_event *e = first_event(&log_a, RESTITUTE_CVODE_EVENT_GROSS_SLIP_END);
        CHECK_NEAR(e->normal_velocity, expected, instant, "case %d", i);
        CHECK_NEAR(e->tangential_velocity, expected, instant, "case %d: sliding has ended", i);
        CHECK(e->elements > 1, "case %d: %d", i, e->elements);
        if (cases[i][1] > 0) continue;
        const double depth = pow(1 - expected * expected, 0.4), t = elastic_time(depth);
        CHECK_NEAR(e->indentation, depth, instant, "case %d", i);
        CHECK_NEAR(e->time, expected > 0 ? t : 2.9432751843 - t, 2 * instant, "case %d", i);
    }
}

/* psi_c is exact (docs/theory.md, section 4): just below it gross slip ends, just above it does
 * not. */
static void gross_slip_lasts_from_the_critical_psi_on(void **state)
{
    (void)state;
    const struct solution s = solve_pair(cvode_to(1e-7), impact_of(chi, 10, 1, 1));
    const double critical = restitute_critical_psi(chi, s.result.ez);
    solve_logged(cvode_to(tolerance), impact_of(chi, critical * (1 - 1e-5), 1, 1), &log_a);
    solve_logged(cvode_to(tolerance), impact_of(chi, critical * (1 + 1e-5), 1, 1), &log_b);
    CHECK(count_events(&log_a, RESTITUTE_CVODE_EVENT_GROSS_SLIP_END) == 1, "below %.9g", critical);
    CHECK(count_events(&log_b, RESTITUTE_CVODE_EVENT_GROSS_SLIP_END) == 0, "above %.9g", critical);
    CHECK_NEAR(log_b.result.ex, 2 * chi * (1 + log_b.result.ez) / (critical * (1 + 1e-5)) - 1, 1e-14, "(27)");
}

/* Elastic: all elements that slip do so with U' - D' or U' + D', so they stick again together when
 * that vanishes. Edge slip begins when |U'| reaches D', for psi = 0.9 at D = 0.96 (two digits). */
static void elastic_elements_stick_again_together(void **state)
{
    (void)state;
    solve_logged(cvode_to(1e-5), impact_of(8.42, 1.087, 0, 1), &log_a);
    const int times = count_events(&log_a, RESTITUTE_CVODE_EVENT_SLIP_TO_STICK);
    CHECK(times > 0 && times <= 4, "%d times", times);
    for (size_t i = 0; i < log_a.events.count; i++) {
        const restitute_cvode_event *e = &log_a.event[i];
        if (e->kind != RESTITUTE_CVODE_EVENT_SLIP_TO_STICK) continue;
        CHECK(e->elements > 1, "%d elements", e->elements);
        CHECK_NEAR(fabs(e->tangential_velocity), fabs(e->normal_velocity), 1e-5, "event %zu", i);
    }
    solve_logged(cvode_to(1e-5), impact_of(chi, 0.9, 0, 1), &log_a);
    CHECK_NEAR(first_event(&log_a, RESTITUTE_CVODE_EVENT_STICK_TO_SLIP)->indentation, 0.96, 0.01,
               "edge slip, at the first element behind the edge");
}

/* In SI units: the same events, scaled. */
static void events_of_a_scene_have_units(void **state)
{
    restitute_material *solid;
    restitute_scene scene;
    restitute_numbers numbers;
    restitute_error error;
    const restitute_options options = cvode_to(1e-4);
    const struct recording r = record_with(options);
    (void)state;
    CHECK(restitute_material_standard_solid(1e6, 2e6, 50, 0.5, &solid, &error) == 0, "%s", error.message);
    restitute_scene_init(&scene);
    scene.material = solid, scene.radius1 = 0.01, scene.mass1 = 4e-3, scene.friction = 0.3;
    scene.normal_speed = 2, scene.tangential_speed = 1;
    restitute_numbers_init(&numbers);
    CHECK(restitute_scene_numbers(&scene, &numbers, &error) == 0, "%s", error.message);
    restitute_cvode_events_init(&log_a.events);
    log_a.events.event = log_a.event;
    log_a.events.capacity = most_events;
    CHECK(restitute_solve_scene(r.solver, &scene, NULL, NULL, NULL, &error) == 0, "%s", error.message);
    CHECK(restitute_cvode_recorder_events(r.recorder, &log_a.events, &error) == 0, "%s", error.message);
    end_recording(&r);
    solve_logged(options, impact_of(numbers.chi, numbers.psi, numbers.delta1, numbers.gamma), &log_b);
    CHECK(log_a.events.count == log_b.events.count, "%zu, %zu", log_a.events.count, log_b.events.count);
    for (size_t i = 0; i < log_a.events.count; i++) {
        const restitute_cvode_event *a = &log_a.event[i], *b = &log_b.event[i];
        CHECK(a->kind == b->kind, "event %zu", i);
        /* the numbers come by other roads, which rounding tells apart; CVODE's steps make more of
         * it */
        CHECK_NEAR(a->time / numbers.time, b->time, 1e-6, "event %zu", i);
        CHECK_NEAR(a->position / numbers.length_x, b->position, 1e-6, "event %zu", i);
        CHECK_NEAR(a->indentation / numbers.length_z, b->indentation, 1e-6, "event %zu", i);
        CHECK_NEAR(a->normal_velocity / 2, b->normal_velocity, 1e-6, "event %zu", i);
        CHECK_NEAR(a->tangential_velocity * numbers.psi, b->tangential_velocity, 1e-6, "event %zu", i);
    }
    restitute_material_destroy(solid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_entries_and_exits_are_those_of_hertz),
        cmocka_unit_test(events_come_in_order_and_change_nothing),
        cmocka_unit_test(events_are_those_of_the_pair),
        cmocka_unit_test(gross_slip_ends_once_and_everywhere),
        cmocka_unit_test(gross_slip_lasts_from_the_critical_psi_on),
        cmocka_unit_test(elastic_elements_stick_again_together),
        cmocka_unit_test(events_of_a_scene_have_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
