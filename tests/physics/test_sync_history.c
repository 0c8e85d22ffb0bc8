/* The history by the method sync: against Hertz, against the method euler, and against mechanics.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "../support/solids.h"

enum { most = 20000 };

struct track {
    size_t count;
    double time[most], depth[most], contact[most], stick[most], fz[most], fx[most], vz[most], vx[most];
};

static struct track sync_track, euler_track;
static struct solid all[solids];

static const double chi = 7.0 / 6;
static const double slidings[] = {0, 0.3, 0.7, 1.4, 2.5, 6};
enum { n_slidings = sizeof slidings / sizeof *slidings };

static int make(void **state)
{
    (void)state;
    make_solids(all);
    return 0;
}

static int destroy(void **state)
{
    (void)state;
    free_solids(all);
    return 0;
}

static restitute_result record(restitute_options options, restitute_impact impact, size_t capacity, struct track *track)
{
    restitute_solver *solver;
    restitute_result result;
    restitute_error error;
    restitute_history h;
    restitute_result_init(&result);
    restitute_history_init(&h);
    h.capacity = capacity;
    h.time = track->time, h.indentation = track->depth, h.contact_radius = track->contact;
    h.stick_radius = track->stick, h.normal_force = track->fz, h.tangential_force = track->fx;
    h.normal_velocity = track->vz, h.tangential_velocity = track->vx;
    CHECK(restitute_solver_create(&options, &solver, NULL) == RESTITUTE_OK, "solver");
    const int status = restitute_solve(solver, &impact, &result, NULL, &h, &error);
    CHECK(status >= 0, "%s", error.message);
    restitute_solver_destroy(solver);
    track->count = h.count;
    return result;
}

/* D'^2 = 1 - D^(5/2), F = (5/4) D^(3/2), a = sqrt(D), all of it symmetric in time. Cubics err by
 * h^4, their slopes by h^3; h: the longest of the steps, pi/2 times their mean. Measured: 0.4 h^3
 * in F, 0.25 h^4 in the energy, and the end of contact, where the sphere hardly pushes any more, to
 * 1e-8. Half as much again. A^2 of the rebound is D. */
static void elastic_impact_is_that_of_hertz(void **state)
{
    (void)state;
    for (int64_t n = 32; n <= 512; n *= 4) {
        const restitute_result r = record(sync_at(n), impact_of(chi, 0.5, 0, 1), most, &sync_track);
        const struct track *t = &sync_track;
        const double h = 1.6 * r.time_step, value = 3e-8 + 0.4 * pow(h, 4), slope = 3e-8 + 0.6 * pow(h, 3);
        CHECK_NEAR(r.contact_time, 2.9432751843, 1e-9 + 2 * pow((double)n, -4), "%d elements", (int)n);
        CHECK(t->count == most, "%zu samples", t->count); /* between points too */
        for (size_t i = 0; i < t->count; i++) {
            const double left = 1 - t->vz[i] * t->vz[i];
            CHECK_NEAR(pow(fmax(0, t->depth[i]), 2.5), left, value, "%d elements, sample %zu", (int)n, i);
            CHECK_NEAR(t->fz[i], 1.25 * pow(fmax(0, t->depth[i]), 1.5), slope, "%d elements, sample %zu", (int)n, i);
            CHECK_NEAR(t->contact[i] * t->contact[i], t->depth[i], value, "%d elements, sample %zu", (int)n, i);
            CHECK_NEAR(t->vz[i], -t->vz[t->count - 1 - i], value, "%d elements, sample %zu", (int)n, i);
        }
    }
}

static void samples_are_even_and_within_bounds(void **state)
{
    (void)state;
    for (int i = 0; i < solids; i++)
        for (int k = 0; k < n_slidings; k++) {
            const double psi = slidings[k];
            const restitute_result r = record(sync_at(150), impact_with(&all[i], chi, psi), 300, &sync_track);
            const struct track *t = &sync_track;
            const size_t last = t->count - 1;
            const char *name = all[i].name;
            CHECK(t->count == 300, "%s, psi %g: %zu samples", name, psi, t->count);
            CHECK(t->time[0] == 0 && t->depth[0] == 0 && t->vz[0] == 1 && t->contact[0] == 0, "%s, psi %g", name, psi);
            CHECK(t->vx[0] == (psi > 0 ? psi : 1), "%s, psi %g: U' starts at %g", name, psi, t->vx[0]);
            CHECK(t->time[last] == r.contact_time && t->contact[last] == 0 && t->fz[last] == 0 && t->fx[last] == 0,
                  "%s, psi %g: last", name, psi);
            /* the history is that of the run that gave the pair; velocities are known to 1e-13 */
            CHECK_NEAR(-t->vz[last], r.ez, 1e-13, "%s, psi %g", name, psi);
            CHECK_NEAR(t->vx[last], -r.ex * t->vx[0], 1e-13, "%s, psi %g", name, psi);
            for (size_t j = 1; j <= last; j++) {
                CHECK_NEAR(t->time[j], (double)j / (double)last * r.contact_time, 1e-14 * r.contact_time, "time");
                CHECK(t->stick[j] >= 0 && t->stick[j] <= t->contact[j], "%s, psi %g: sample %zu", name, psi, j);
                CHECK(t->contact[j] <= r.max_contact_radius && t->depth[j] <= r.max_indentation, "%s: %zu", name, j);
                if (psi > 0) CHECK(fabs(t->fx[j]) <= t->fz[j], "%s, psi %g: friction limit at %zu", name, psi, j);
                if (psi <= 0) CHECK(t->stick[j] == t->contact[j], "%s: slip at %zu of no slip", name, j);
                if (psi >= 6) CHECK(t->stick[j] == 0 && t->fx[j] == t->fz[j], "%s: stick at %zu in full slip", name, j);
            }
        }
}

/* U'' = -2 chi fx and D'' = -fz: sums by the trapezoidal rule are as good as forces at a thousand
 * samples, h^2/12 times their third derivatives; at first touch a dashpot's force begins as
 * sqrt(t), which costs h^(3/2). */
static void forces_are_what_changes_the_velocities(void **state)
{
    (void)state;
    for (int i = 0; i < solids; i++)
        for (int k = 0; k < n_slidings; k++) {
            record(sync_at(512), impact_with(&all[i], chi, slidings[k]), most, &sync_track);
            const struct track *t = &sync_track;
            double z = 0, x = 0;
            for (size_t j = 1; j < t->count; j++) {
                const double h = t->time[j] - t->time[j - 1];
                z += 0.5 * h * (t->fz[j] + t->fz[j - 1]);
                x += 0.5 * h * (t->fx[j] + t->fx[j - 1]);
                CHECK_NEAR(t->vz[j], 1 - z, 2e-4, "%s, psi %g: z at %g", all[i].name, slidings[k], t->time[j]);
                CHECK_NEAR(t->vx[j], t->vx[0] - 2 * chi * x, 4e-4, "%s, psi %g: x at %g", all[i].name, slidings[k],
                           t->time[j]);
            }
        }
}

/* A value of evenly spaced samples at any time within them. */
static double between(const struct track *t, const double *values, double time)
{
    const double position = time / t->time[t->count - 1] * (double)(t->count - 1);
    const size_t i = (size_t)fmin(fmax(position, 0), (double)(t->count - 2));
    return values[i] + (values[i + 1] - values[i]) * (position - (double)i);
}

/* How far a value is from those that the samples have within `slack` of a time. */
static double beside(const struct track *t, const double *values, double time, double slack, double value)
{
    const double end = t->time[t->count - 1];
    double low = between(t, values, time), high = low;
    for (int i = -4; i <= 4; i++) {
        const double there = between(t, values, fmin(end, fmax(0, time + i * slack / 4)));
        low = fmin(low, there);
        high = fmax(high, there);
    }
    return fmax(0, fmax(low - value, value - high));
}

/* Compared with euler at a tolerance of 3e-4, which is the error of its velocities after a step;
 * its indentation is better. Its dashpots lag by a step. Without slip its last elements lose their
 * force one by one: two per cent of the largest force. Its radii are those of whole elements, or
 * extrapolated from two elements, some steps late: two elements, four steps. */
static void samples_are_those_of_euler(void **state)
{
    (void)state;
    for (int i = 0; i < solids; i++)
        for (int k = 0; k < n_slidings; k++) {
            const double psi = slidings[k];
            const char *name = all[i].name;
            const restitute_impact impact = impact_with(&all[i], chi, psi);
            const restitute_result e = record(to_tolerance(3e-4), impact, most, &euler_track);
            record(sync_at(512), impact, most, &sync_track);
            const struct track *t = &euler_track, *s = &sync_track;
            const double end = fmin(t->time[t->count - 1], s->time[s->count - 1]);
            const double speed = 6e-4 + e.max_normal_force * e.time_step, force = 0.02 * e.max_normal_force;
            const double radius = 2 * e.element_spacing, slack = 4 * e.time_step;
            for (size_t j = 0; j < t->count && t->time[j] <= end; j++) {
                const double at = t->time[j];
                CHECK_NEAR(between(s, s->depth, at), t->depth[j], 6e-4, "%s, psi %g, time %g", name, psi, at);
                CHECK_NEAR(between(s, s->vz, at), t->vz[j], speed, "%s, psi %g, time %g", name, psi, at);
                CHECK_NEAR(between(s, s->vx, at), t->vx[j], 2 * chi * speed, "%s, psi %g, time %g", name, psi, at);
                CHECK_NEAR(between(s, s->fz, at), t->fz[j], force, "%s, psi %g, time %g", name, psi, at);
                CHECK_NEAR(between(s, s->fx, at), t->fx[j], force, "%s, psi %g, time %g", name, psi, at);
                CHECK_NEAR(beside(s, s->contact, at, slack, t->contact[j]), 0, radius, "%s, psi %g: contact at %g",
                           name, psi, at);
                CHECK_NEAR(beside(s, s->stick, at, slack, t->stick[j]), 0, radius, "%s, psi %g: stick at %g", name, psi,
                           at);
            }
        }
}

/* No end of contact that samples could be spread to: first touch alone. */
static void a_sphere_that_sinks_in_has_one_sample(void **state)
{
    (void)state;
    const double time = 0.15, modulus = 1;
    restitute_material *putty = solid_of(0, 0, 1, &time, &modulus);
    restitute_options options = default_options();
    options.method = restitute_method_sync();
    record(options, impact_on(putty, chi, 0.5), 100, &sync_track);
    const struct track *t = &sync_track;
    CHECK(t->count == 1 && t->time[0] == 0 && t->depth[0] == 0 && t->vz[0] == 1 && t->vx[0] == 0.5, "%zu samples",
          t->count);
    restitute_material_destroy(putty);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_impact_is_that_of_hertz),        cmocka_unit_test(samples_are_even_and_within_bounds),
        cmocka_unit_test(forces_are_what_changes_the_velocities), cmocka_unit_test(samples_are_those_of_euler),
        cmocka_unit_test(a_sphere_that_sinks_in_has_one_sample),
    };
    return cmocka_run_group_tests(tests, make, destroy);
}
