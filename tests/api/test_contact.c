/* What contact.h promises.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <float.h>

#include "../support/drive.h"
#include "../support/random.h"
#include "../support/sized.h"

static restitute_contact_law *standard_law(double poisson_ratio)
{
    restitute_material *material;
    const double tau[1] = {1}, g[1] = {2};
    assert_int_equal(restitute_material_prony(1, 0, 1, tau, g, poisson_ratio, &material, NULL), 0);
    restitute_contact_law *law = law_of(material, 8, 0);
    restitute_material_destroy(material);
    return law;
}

/* A contact in the middle of an oblique impact. */
static struct drive loaded(restitute_contact_law *law)
{
    struct drive d = drive_of(law, 1e-2, 0.3);
    drive_steps(&d, 20, 1e-4, 2e-5, 1e-5);
    return d;
}

static restitute_contact_law *law_with(double g_inf, double eta, size_t n, int elements, int frictionless, int with)
{
    const double tau[] = {0.02, 0.3, 4}, g[] = {2, 1, 0.5};
    restitute_material *material = solid_of(g_inf, eta, n, tau, g);
    restitute_contact_law *law;
    restitute_contact_law_options options;
    restitute_contact_law_options_init(&options);
    options.elements = elements, options.frictionless = frictionless, options.details = with & DETAILS;
    options.slip_cycles = with & SLIP_CYCLES;
    assert_int_equal(restitute_contact_law_create(material, &options, &law, NULL), 0);
    restitute_material_destroy(material);
    return law;
}

static size_t size_with(double g_inf, double eta, size_t n, int elements, int frictionless, int with)
{
    restitute_contact_law *law = law_with(g_inf, eta, n, elements, frictionless, with);
    const size_t size = restitute_contact_law_state_size(law);
    restitute_contact_law_destroy(law);
    return size;
}

static void states_hold_what_the_law_needs(void **unused)
{
    (void)unused;
    assert_int_equal(size_with(1, 0, 0, 8, 0, 0), 24); /* elastic: no memory of arms */
    assert_int_equal(size_with(1, 1, 0, 8, 0, 0), 32); /* Kelvin-Voigt */
    assert_int_equal(size_with(1, 0, 1, 8, 0, 0), 48); /* standard solid */
    assert_int_equal(size_with(0, 0, 1, 8, 0, 0), 56); /* Maxwell: the free surface too */
    assert_int_equal(size_with(1, 0, 3, 8, 0, 0), 96);
    assert_int_equal(size_with(1, 0, 1, 16, 0, 0), 88);
    assert_int_equal(size_with(1, 0, 0, 8, 1, 0), 8); /* elastic without friction: only the last force */
    assert_int_equal(size_with(1, 0, 1, 8, 1, 0), 16);
    assert_int_equal(size_with(1, 0, 1, 8, 0, DETAILS), 55);
    assert_int_equal(size_with(1, 0, 0, 8, 0, SLIP_CYCLES), 29);
    assert_int_equal(size_with(1, 0, 1, 8, 0, SLIP_CYCLES), 55);
    assert_int_equal(size_with(1, 0, 1, 8, 1, SLIP_CYCLES), 16);
    assert_int_equal(restitute_contact_law_state_size(NULL), 0);
}

static void refuse_options(size_t size, int deformable, int elements, int terms, const char *name)
{
    restitute_contact_law_options o;
    restitute_contact_law *law = NULL;
    restitute_error error;
    restitute_material *material = solid_of(1, 0, 0, NULL, NULL);
    restitute_contact_law_options_init(&o);
    o.struct_size += size, o.deformable = deformable, o.elements = elements, o.terms = terms;
    assert_true(restitute_contact_law_create(material, &o, &law, &error) < 0);
    CHECK(strstr(error.message, name) != NULL, "\"%s\" does not name %s", error.message, name);
    assert_null(law);
    restitute_material_destroy(material);
}

static void bad_options_are_named(void **unused)
{
    (void)unused;
    refuse_options(1, 1, 8, 4, "struct_size");
    refuse_options(0, 3, 8, 4, "deformable = 3: must be 1 or 2 bodies");
    refuse_options(0, 1, 12, 4, "elements = 12: must be 8, 16, 24 or 32");
    refuse_options(0, 1, 40, 4, "elements = 40");
    refuse_options(0, 1, 8, 0, "terms = 0");
    refuse_options(0, 1, 8, 9, "terms = 9");
    restitute_contact_law *law = NULL;
    assert_int_equal(restitute_contact_law_create(NULL, NULL, &law, NULL), RESTITUTE_ERROR_NULL);
}

/* Every refusal leaves state and force as they were. */
static void refuse_motion(struct drive *d, const char *name)
{
    restitute_error error;
    double before[most_state];
    const restitute_contact_force force = d->force;
    memcpy(before, d->state, sizeof before);
    const int status = restitute_contact_step(d->law, &d->rates, &d->motion, d->state, &d->force, &error);
    CHECK(status < 0 && status == error.status, "%s was accepted", name);
    CHECK(strstr(error.message, name) != NULL, "\"%s\" does not name %s", error.message, name);
    assert_memory_equal(before, d->state, sizeof before);
    assert_memory_equal(&force, &d->force, sizeof force);
}

static void bad_motion_is_named_and_changes_nothing(void **unused)
{
    (void)unused;
    restitute_contact_law *law = standard_law(0.5);
    struct drive d = loaded(law);
    const restitute_contact_motion good = d.motion;
    const double bad[] = {NAN, INFINITY, -INFINITY, 1e300, -1e300};
    for (int i = 0; i < 5; i++) {
        d.motion = good, d.motion.overlap = bad[i], refuse_motion(&d, "overlap");
        d.motion = good, d.motion.velocity[i % 3] = bad[i], refuse_motion(&d, "velocity");
        d.motion = good, d.motion.spin = bad[i], refuse_motion(&d, "spin");
        d.motion = good, d.motion.normal[i % 3] = bad[i], refuse_motion(&d, "normal");
        d.motion = good, d.motion.inverse_mass = bad[i], refuse_motion(&d, "inverse_mass");
        d.motion = good, d.motion.inverse_tangential_mass = bad[i], refuse_motion(&d, "inverse_tangential_mass");
        d.motion = good, d.motion.radius = bad[i], refuse_motion(&d, "radius");
        d.motion = good, d.motion.friction = bad[i], refuse_motion(&d, "friction");
    }
    d.motion = good, d.motion.overlap = 1.001, refuse_motion(&d, "overlap = 1.0009999999999999: must be in [-1, 1]");
    d.motion = good, d.motion.velocity[1] = -101, refuse_motion(&d, "velocity[1] = -101: must be in [-100, 100]");
    d.motion = good, d.motion.spin = 100.5, refuse_motion(&d, "spin = 100.5: must be in [-100, 100]");
    d.motion = good, d.motion.inverse_mass = -1, refuse_motion(&d, "motion.inverse_mass = -1: must be in [0, 2e+32]");
    d.motion = good, d.motion.inverse_tangential_mass = 0x1p120,
    refuse_motion(&d, "tangential_mass = 1.3292279957849159e+36");
    d.motion = good, d.motion.struct_size--, refuse_motion(&d, "struct_size");
    restitute_contact_law_destroy(law);
}

static void states_and_rates_of_another_law_are_refused(void **unused)
{
    (void)unused;
    restitute_contact_law *law = standard_law(0.5), *same = standard_law(0.5), *other = standard_law(0.3);
    assert_true(restitute_contact_law_hash(law) == restitute_contact_law_hash(same));
    assert_true(restitute_contact_law_hash(law) != restitute_contact_law_hash(other));
    struct drive d = loaded(law);
    restitute_contact_force force;
    d.law = same; /* as after a restart */
    drive_by(&d, 0, 0, 0);
    d.law = other;
    refuse_motion(&d, "rates");
    drive_set_step(&d, 1e-2);
    refuse_motion(&d, "state");
    d.rates.step = NAN;
    refuse_motion(&d, "rates.step = nan s: must be in [1e-60, 1e+60]");
    restitute_error error;
    const double up[3] = {0, 0, 1};
    assert_int_equal(restitute_contact_peek(other, up, d.state, &force, &error), RESTITUTE_ERROR_DOMAIN);
    restitute_contact_law_destroy(law);
    restitute_contact_law_destroy(same);
    restitute_contact_law_destroy(other);
}

/* Steps that are too long for a new contact are refused, and the state does not change. */
static void steps_too_long_are_refused(void **unused)
{
    (void)unused;
    restitute_contact_law *law = standard_law(0.5);
    restitute_error error;
    double limit, slower;
    const double mass = 1e-5;
    CHECK(restitute_contact_time_step_limit(law, mass, 1, 1e-3, &limit, &error) == 0, "%s", error.message);
    CHECK(restitute_contact_time_step_limit(law, mass, 1, 1e-4, &slower, &error) == 0, "%s", error.message);
    CHECK(slower > limit, "slower impacts last longer");
    for (int times = 1; times <= 10; times += 9) {
        struct drive d = drive_of(law, times * limit, 0.3);
        d.motion.inverse_mass = 1 / mass;
        d.motion.velocity[2] = 1e-3;
        d.motion.overlap = 1e-3 * times * limit;
        if (times == 1)
            assert_int_equal(restitute_contact_step(law, &d.rates, &d.motion, d.state, &d.force, &error), 0);
        else
            refuse_motion(&d, "less than ten steps");
    }
    assert_int_equal(restitute_contact_time_step_limit(law, 0, 1, 1, &limit, &error), RESTITUTE_ERROR_DOMAIN);
    restitute_contact_law_destroy(law);
    restitute_material *material = solid_of(1e30, 0, 0, NULL, NULL); /* the stiffest solid under the lightest sphere */
    law = law_of(material, 8, 0);
    assert_int_equal(restitute_contact_time_step_limit(law, 1e-60, 1e60, 1e-60, &limit, &error), 0);
    CHECK(limit > 0 && isfinite(limit), "limit %g", limit);
    restitute_contact_law_destroy(law);
    restitute_material_destroy(material);
}

/* Of an elastic impact it is d/v, d from (24). The limit is a fiftieth of the contact time of any
 * law. */
static void time_scale_is_the_largest_overlap_over_speed(void **unused)
{
    (void)unused;
    const double mass = 2.5, radius = 0.7, speed = 0.01;
    const double d0 = pow(15 * mass * speed * speed * 0.5 / (32 * sqrt(radius)), 0.4);
    double scale, limit;
    restitute_error error;
    for (size_t n = 0; n < 4; n++) {
        restitute_contact_law *law = law_with(1, n == 2 ? 0.1 : 0, n, 8, 0, 0);
        assert_int_equal(restitute_contact_time_scale(law, mass, radius, speed, &scale, NULL), 0);
        assert_int_equal(restitute_contact_time_step_limit(law, mass, radius, speed, &limit, NULL), 0);
        CHECK_NEAR(limit / (2.9432751843 * scale / 50), 1, 1e-10, "%zu terms: limit", n); /* digits of the number */
        if (n == 0) CHECK_NEAR(scale / (d0 / speed), 1, 1e-4, "elastic"); /* the fixed point is left at some 1e-5 */
        if (n > 0) CHECK(scale < d0 / speed, "%zu terms: %g s, a stiffer solid is slower", n, scale);
        assert_int_equal(restitute_contact_time_scale(law, mass, radius, 0, &scale, &error), RESTITUTE_ERROR_DOMAIN);
        CHECK(strstr(error.message, "speed (m/s) = 0") != NULL, "%s", error.message);
        restitute_contact_law_destroy(law);
    }
}

static void peek_repeats_the_last_force(void **unused)
{
    (void)unused;
    restitute_contact_law *law = standard_law(0.5);
    struct drive d = loaded(law);
    restitute_contact_force force;
    double before[most_state], none[most_state] = {0};
    memcpy(before, d.state, sizeof before);
    assert_int_equal(restitute_contact_peek(law, d.motion.normal, d.state, &force, NULL), 0);
    assert_memory_equal(&force, &d.force, sizeof force);
    assert_memory_equal(before, d.state, sizeof before);
    assert_int_equal(restitute_contact_peek(law, d.motion.normal, none, &force, NULL), 0);
    assert_true(force.normal <= 0 && fabs(force.tangential[0]) <= 0);
    restitute_contact_law_destroy(law);
}

/* A state that gives no finite force is found, whether it is advanced or asked for it. */
static void corrupt_states_are_refused(void **unused)
{
    (void)unused;
    restitute_contact_law *law = standard_law(0.5);
    struct drive d = loaded(law);
    restitute_contact_force force = d.force;
    restitute_error error;
    d.state[5] = NAN; /* the normal force */
    assert_int_equal(restitute_contact_peek(law, d.motion.normal, d.state, &force, &error), RESTITUTE_ERROR_DOMAIN);
    assert_non_null(strstr(error.message, "corrupt"));
    d.state[32] = NAN; /* a tangential displacement */
    assert_int_equal(restitute_contact_step(law, &d.rates, &d.motion, d.state, &force, &error), RESTITUTE_ERROR_DOMAIN);
    assert_non_null(strstr(error.message, "corrupt"));
    assert_memory_equal(&force, &d.force, sizeof force);
    restitute_contact_law_destroy(law);
}

/* Bodies that only come near leave a new contact as it is: all zeros. */
static void bodies_apart_are_no_contact(void **unused)
{
    (void)unused;
    restitute_contact_law *law = standard_law(0.5);
    struct drive d = drive_of(law, 1e-2, 0.3);
    const double none[most_state] = {0};
    d.motion.overlap = -1e-5;
    drive_by(&d, 1e-6, 1e-3, 0);
    assert_memory_equal(d.state, none, sizeof none);
    restitute_contact_law_destroy(law);
}

/* A contact that begins with the smallest possible overlap grows like any other. */
static void least_overlap_spoils_nothing(void **unused)
{
    (void)unused;
    restitute_contact_law *law = standard_law(0.5);
    struct drive d = drive_of(law, 1e-2, 0.3);
    d.motion.radius = 1e-3;
    drive_by(&d, 5e-324, 0, 0);
    drive_by(&d, 1e-6, 1e-7, 0);
    assert_true(d.force.normal > 0 && d.force.tangential[0] < 0);
    restitute_contact_law_destroy(law);
}

/* ---- batches */

enum { most_contacts = 17, all_refusals = 13 };

/* Contacts of one law, by single steps and in batches. States of the batch lie in a larger array,
 * in another order. */
struct crowd {
    const restitute_contact_law *law;
    restitute_contact_rates rates;
    restitute_contact_motion motion[most_contacts];
    double single[most_contacts][most_state], *state[most_contacts], pool[most_contacts * (most_state + 3)];
    restitute_contact_force one[most_contacts], many[most_contacts];
    double other[most_state], young[most_state], corrupt[most_state]; /* of refused contacts */
};

static void assemble(struct crowd *c, restitute_contact_law *law, restitute_contact_law *other)
{
    const struct drive here = loaded(law), there = loaded(other);
    memset(c, 0, sizeof *c);
    c->law = law, c->rates = here.rates;
    memcpy(c->other, there.state, sizeof c->other);
    memcpy(c->corrupt, here.state, sizeof c->corrupt);
    for (size_t k = 8; k < restitute_contact_law_state_size(law); k++)
        c->corrupt[k] = NAN;
    c->corrupt[4] = NAN; /* all but the mark of the law and the tangential axis */
    for (int i = 0; i < most_contacts; i++) {
        c->motion[i] = here.motion;
        c->state[i] = c->pool + i * 5 % most_contacts * (most_state + 3);
    }
}

/* Approach at 1e-4 m/s and faster retreat, again and again, of some contacts later. Two thirds have
 * a mass that stops within some 1e-5 m, a part of the largest overlap, so that grids are outgrown.
 * One rests after the retreat, so that its grid shrinks. */
enum { resting = 4 };

static void move_contact(restitute_contact_motion *m, int i, int step)
{
    const int phase = (step + 150 - 9 * i) % 260;
    const double v = phase < 200 ? 1e-4 : i == resting && phase >= 240 ? 0 : -3e-4;
    const double turn = i % 4 == 1 ? 0.01 * step : 0, c = cos(turn), s = sin(turn), x = 3e-5 * sin(0.1 * step + i);
    if (step == 0) m->overlap = i % 6 == 5 ? -0.5 : -1e-7 * i; /* -0.5: apart for good */
    m->overlap += 1e-2 * v;
    m->normal[0] = s, m->normal[2] = c;
    m->velocity[0] = v * s + x * c, m->velocity[1] = 1e-5 * cos(0.3 * step), m->velocity[2] = v * c - x * s;
    m->spin = 0.1 * (i % 3);
    m->inverse_mass = i % 3 == 0 ? 0 : 1e-8 / (32.0 / 15 / 0.5 * pow(1e-5, 2.5)) / i;
    m->inverse_tangential_mass = 3.5 * m->inverse_mass;
}

/* Each kind of refusal, the last only with friction: without it a corrupt state has no force.
 * Returns the state to step. */
static double *spoil(struct crowd *c, int kind, int i, restitute_contact_motion *m, double *state)
{
    memset(c->young, 0, sizeof c->young);
    switch (kind) {
    case 0:
        m->overlap = NAN;
        break;
    case 1:
        m->overlap = 1.1;
        break;
    case 2:
        m->velocity[i % 3] = 101;
        break; /* radius/step = 100 m/s */
    case 3:
        m->spin = -101;
        break;
    case 4:
        m->inverse_mass = -1;
        break;
    case 5:
        m->inverse_tangential_mass = INFINITY;
        break;
    case 6:
        m->radius = 0;
        break;
    case 7:
        m->friction = -1;
        break;
    case 8:
        m->normal[1] = 0.1;
        break;
    case 9:
        return c->other;
    case 10: /* too few steps: 1 m/s, stopped within 3e-3 m, a third of a step */
        m->overlap = 1e-3, m->velocity[2] = 1, m->inverse_mass = 1e6, m->normal[0] = 0, m->normal[2] = 1;
        return c->young;
    case 11: /* turned by more than 60 degrees */
        memcpy(c->young, c->corrupt, sizeof c->young);
        for (int k = 0; k < 3; k++)
            m->normal[k] = c->young[1 + k];
        return c->young;
    default:
        return c->corrupt;
    }
    return state;
}

/* Steps all contacts once; the contact `bad` is refused, -1: none. */
static void step_crowd(struct crowd *c, int n, int step, int bad, int kind)
{
    const size_t size = sizeof(double) * restitute_contact_law_state_size(c->law);
    restitute_contact_motion motion[most_contacts];
    double *states[most_contacts], before[most_state], *refused = NULL;
    int statuses[most_contacts];
    restitute_error error;
    for (int i = 0; i < n; i++) {
        move_contact(&c->motion[i], i, step);
        motion[i] = c->motion[i];
        states[i] = i == bad ? refused = spoil(c, kind, i, &motion[i], c->state[i]) : c->state[i];
        const int status =
            i == bad ? 0 : restitute_contact_step(c->law, &c->rates, &motion[i], c->single[i], &c->one[i], &error);
        CHECK(!status, "contact %d in step %d: %s", i, step, error.message);
    }
    if (refused) memcpy(before, refused, size);
    const int status =
        restitute_contact_step_many(c->law, &c->rates, (size_t)n, motion, states, c->many, statuses, &error);
    CHECK(status == (refused ? RESTITUTE_ERROR_DOMAIN : 0), "step %d, refusal %d: status %d", step, kind, status);
    if (refused) {
        char words[40];
        snprintf(words, sizeof words, "motions[%d]: ", bad);
        CHECK(strncmp(error.message, words, strlen(words)) == 0, "refusal %d: \"%s\"", kind, error.message);
        CHECK(refused == c->corrupt || memcmp(before, refused, size) == 0, "refusal %d changes the state", kind);
    }
    for (int i = 0; i < n; i++) {
        CHECK(statuses[i] == (i == bad ? status : 0), "contact %d in step %d: status %d", i, step, statuses[i]);
        CHECK(memcmp(&c->one[i], &c->many[i], sizeof c->one[i]) == 0, "contact %d of %d in step %d: force", i, n, step);
        CHECK(memcmp(c->single[i], c->state[i], size) == 0, "contact %d of %d in step %d: state", i, n, step);
    }
}

/* Contacts are refused in each way while the others go on. Returns how many grids have shrunk. */
static int compare_crowd(restitute_contact_law *law, restitute_contact_law *other, int refusals)
{
    static struct crowd c;
    static const int counts[] = {1, 7, 8, 9, most_contacts};
    int shrunk = 0;
    for (size_t count = 0; count < sizeof counts / sizeof *counts; count++) {
        const int n = counts[count];
        const size_t size = restitute_contact_law_state_size(law);
        int kind = 0;
        assemble(&c, law, other);
        for (int i = 0; i < most_contacts; i++)
            for (size_t k = size; k < most_state; k++)
                c.state[i][k] = 7;
        for (int step = 0; step < 600; step++) {
            const int bad = step % 4 == 3 ? step / 4 % n : -1;
            const double width = c.single[resting][0];
            if (bad >= 0) kind = (kind + 1) % refusals;
            step_crowd(&c, n, step, bad, kind);
            shrunk += c.single[resting][0] < width;
        }
        for (int i = 0; i < n; i++)
            for (size_t k = size; k < most_state; k++)
                CHECK(!(fabs(c.state[i][k] - 7) > 0), "contact %d: state[%zu] is beyond the end", i, k);
    }
    return shrunk;
}

/* The same bits as one by one, in any order, of any number, and beside contacts that are
 * refused. */
static void many_steps_are_single_steps(void **unused)
{
    static const struct {
        double g_inf, eta;
        size_t n;
        int elements, frictionless, with;
    } kinds[] = {{1, 0, 0, 8, 0, 0},    {1, 0.02, 0, 8, 0, 0}, {1, 0, 1, 8, 0, 0},  {1, 0, 3, 8, 0, 0},
                 {0, 0, 1, 8, 0, 1},    {1, 0, 1, 8, 1, 0},    {1, 0, 0, 8, 1, 1},  {1, 0, 3, 8, 0, 1},
                 {1, 0.02, 2, 8, 0, 1}, {1, 0, 1, 16, 0, 0},   {1, 0, 0, 32, 0, 1}, {0, 0.02, 3, 32, 0, 1},
                 {1, 0, 0, 8, 0, 2},    {1, 0.02, 3, 16, 0, 3}};
    (void)unused;
    restitute_contact_law *other = standard_law(0.3);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        restitute_contact_law *law =
            law_with(kinds[i].g_inf, kinds[i].eta, kinds[i].n, kinds[i].elements, kinds[i].frictionless, kinds[i].with);
        const int shrunk = compare_crowd(law, other, kinds[i].frictionless ? all_refusals - 1 : all_refusals);
        const int recovers_at_once = kinds[i].n == 0 && !(kinds[i].eta > 0);
        CHECK(shrunk > 0 || !recovers_at_once, "kind %zu: no grid has shrunk", i);
        restitute_contact_law_destroy(law);
    }
    restitute_contact_law_destroy(other);
}

/* ... and write nothing. */
static void batches_are_refused_as_a_whole(void **unused)
{
    (void)unused;
    enum { n = 3 };
    restitute_contact_law *law = standard_law(0.5), *other = standard_law(0.3);
    struct drive d = loaded(law), before = d, foreign = loaded(other);
    double more[most_state] = {0}, *states[n] = {d.state, more, NULL}, *good[n] = {more, d.state, foreign.state};
    restitute_contact_motion motions[n] = {d.motion, d.motion, d.motion};
    restitute_contact_force forces[n] = {d.force, d.force, d.force};
    int statuses[n] = {7, 7, 7};
    restitute_error error;
    assert_int_equal(restitute_contact_step_many(law, &d.rates, 0, NULL, NULL, NULL, NULL, &error), 0);
    assert_int_equal(restitute_contact_step_many(NULL, &d.rates, 0, NULL, NULL, NULL, NULL, &error),
                     RESTITUTE_ERROR_NULL);
    assert_int_equal(restitute_contact_step_many(law, &d.rates, n, motions, NULL, forces, statuses, &error),
                     RESTITUTE_ERROR_NULL);
    assert_string_equal(error.message, "states is NULL");
    assert_int_equal(restitute_contact_step_many(law, &d.rates, n, motions, states, forces, statuses, &error),
                     RESTITUTE_ERROR_NULL);
    assert_string_equal(error.message, "states[2] is NULL");
    assert_int_equal(restitute_contact_step_many(law, &foreign.rates, n, motions, good, forces, statuses, &error),
                     RESTITUTE_ERROR_DOMAIN);
    motions[2].struct_size += 8;
    assert_int_equal(restitute_contact_step_many(law, &d.rates, n, motions, good, forces, statuses, &error),
                     RESTITUTE_ERROR_STRUCT_SIZE);
    CHECK(strncmp(error.message, "motions[2].struct_size", 22) == 0, "%s", error.message);
    assert_memory_equal(&d, &before, sizeof d);
    for (int i = 0; i < n; i++) {
        assert_int_equal(statuses[i], 7);
        assert_memory_equal(&forces[i], &d.force, sizeof d.force);
    }
    restitute_contact_law_destroy(law);
    restitute_contact_law_destroy(other);
}

/* In an array the size of the first is the distance to the next. So the whole call is refused. */
static void structs_of_other_sizes_are_refused(void **unused)
{
    static _Alignas(double) unsigned char place[guarded_bytes];
    const void *given = place;
    restitute_contact_law *law = standard_law(0.5), *none = NULL;
    restitute_material *material = solid_of(1, 0, 0, NULL, NULL);
    struct drive d = loaded(law), before = d;
    double other[most_state] = {0};
    double *states[] = {d.state, other};
    int statuses[2] = {7, 7};
    restitute_error e;
    (void)unused;
    CHECK_SIZES(contact_law_options, details, place, &e, restitute_contact_law_create(material, given, &none, &e));
    assert_null(none);
    CHECK_SIZES(contact_rates, values, place, &e, restitute_contact_rates_set(law, 1e-2, (void *)place, &e));
    CHECK_SIZES(contact_rates, values, place, &e, restitute_contact_step(law, given, &d.motion, d.state, &d.force, &e));
    CHECK_SIZES(contact_motion, friction, place, &e,
                restitute_contact_step(law, &d.rates, given, d.state, &d.force, &e));
    CHECK_SIZES(contact_motion, friction, place, &e,
                restitute_contact_step_many(law, &d.rates, 2, given, states, &d.force, statuses, &e));
    CHECK_SIZES(contact_details, viscous_power, place, &e,
                restitute_contact_details_get(law, 1, d.state, (void *)place, &e));
    CHECK(statuses[0] == 7 && statuses[1] == 7 && memcmp(&d, &before, sizeof d) == 0, "a refused call has written");
    restitute_contact_law_destroy(law);
    restitute_material_destroy(material);
}

/* Any bits for any number: a status or finite forces, and then a finite state. */
static void no_input_makes_what_is_not_a_number(void **unused)
{
    (void)unused;
    restitute_contact_law *law = standard_law(0.4);
    uint64_t seed = 3;
    long done = 0;
    for (int i = 0; i < 200000; i++) {
        struct drive d = drive_of(law, 1e-2, 0.3);
        double *values = &d.motion.overlap;
        if (i % 2) d = loaded(law);
        const int wild = i % 4 < 2;
        for (int k = 0; k < 12; k++) {
            const int is_normal = k >= 1 && k <= 3;
            if (is_normal || random_below(&seed, 3)) continue;
            double value;
            const uint64_t bits = random_bits(&seed);
            memcpy(&value, &bits, sizeof value);
            values[k] = wild ? value : random_log(&seed, 1e-30, 1) * (random_below(&seed, 2) ? 1 : -1);
        }
        if (restitute_contact_step(law, &d.rates, &d.motion, d.state, &d.force, NULL)) continue;
        done++;
        CHECK(isfinite(d.force.normal) && isfinite(d.force.tangential[0]) && isfinite(d.force.tangential[2]), "case %d",
              i);
        for (size_t k = 0; k < restitute_contact_law_state_size(law); k++)
            CHECK(isfinite(d.state[k]), "case %d: state[%zu] = %g", i, k, d.state[k]);
    }
    CHECK(done > 10000, "only %ld cases were accepted", done);
    restitute_contact_law_destroy(law);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(states_hold_what_the_law_needs),
        cmocka_unit_test(bad_options_are_named),
        cmocka_unit_test(bad_motion_is_named_and_changes_nothing),
        cmocka_unit_test(states_and_rates_of_another_law_are_refused),
        cmocka_unit_test(steps_too_long_are_refused),
        cmocka_unit_test(time_scale_is_the_largest_overlap_over_speed),
        cmocka_unit_test(peek_repeats_the_last_force),
        cmocka_unit_test(corrupt_states_are_refused),
        cmocka_unit_test(bodies_apart_are_no_contact),
        cmocka_unit_test(least_overlap_spoils_nothing),
        cmocka_unit_test(many_steps_are_single_steps),
        cmocka_unit_test(batches_are_refused_as_a_whole),
        cmocka_unit_test(structs_of_other_sizes_are_refused),
        cmocka_unit_test(no_input_makes_what_is_not_a_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
