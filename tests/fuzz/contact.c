/* The contact law of DEM: any law and step; contacts that approach, stop, slide, turn, separate and
 * jump; states that were damaged; one and many.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/contact.h>

#include "fuzz.h"

enum { contacts = 5, steps = 200 };
static long steps_made;

static restitute_contact_law *any_law(struct bytes *b, const restitute_material *material)
{
    PREPARED(contact_law_options, o);
    restitute_contact_law *law = NULL;
    const int known = (int)take(b, 1);
    o.deformable = 1 + below(b, 2);
    o.elements = below(b, 8) ? 8 * (1 + below(b, 4)) : (int)take(b, 4);
    o.terms = below(b, 8) ? 1 + below(b, 8) : (int)take(b, 4);
    o.slip_cycles = known & 1;
    o.frictionless = (known & 6) == 6;
    o.details = known & 8;
    o.shortest = number(b, 1e-9, 1e-3);
    o.longest = number(b, 1e-3, 1e3);
    restitute_contact_law_options *given = sized(b, &o);
    const int status = CALL(restitute_contact_law_create, material, given, &law);
    CHECK((status < 0) == !law, "status %d", status);
    free(given);
    return law;
}

/* In its ranges, mostly: in units of radius and step. */
static restitute_contact_motion any_motion(struct bytes *b, double radius, double step)
{
    PREPARED(contact_motion, m);
    const int plain = below(b, 8);
    const double angle = plain ? 0.02 * below(b, 8) : number(b, 1e-3, 3);
    m.normal[1] = sin(isfinite(angle) ? angle : 0);
    m.normal[2] = cos(isfinite(angle) ? angle : 0);
    m.radius = radius;
    m.overlap = radius * signed_number(b, 1e-9, 0.5);
    if (plain && m.overlap < 0 && below(b, 4)) m.overlap = -m.overlap;
    for (int i = 0; i < 3; i++)
        m.velocity[i] = radius / step * signed_number(b, 1e-9, 0.05);
    m.spin = below(b, 2) ? 0 : signed_number(b, 1e-9, 1) / step;
    m.inverse_mass = below(b, 2) ? 0 : number(b, 1e-6, 1e6);
    m.inverse_tangential_mass = 3.5 * m.inverse_mass;
    m.friction = number(b, 1e-3, 10);
    return m;
}

/* Driven step by step alone (`state`), and with the others in one call (`many`). */
struct contact {
    double *state, *many, *before;
    restitute_contact_motion motion;
    double way[3]; /* of a step: along x, across, and closing, m */
    double lost[2];
    int status, damaged;
};

/* Goes on, begins another leg, or jumps anywhere. */
static void move(struct bytes *b, struct contact *c, double radius, double step)
{
    restitute_contact_motion *m = &c->motion;
    const double *n = m->normal, *way = c->way;
    const int kind = below(b, 32);
    if (kind == 0 || c->status < 0) {
        *m = any_motion(b, radius, step);
        return;
    }
    if (kind < 4) {
        for (int k = 0; k < 2; k++)
            c->way[k] = m->overlap * signed_number(b, 1e-3, 1);
        c->way[2] = kind == 1 ? 0 : 0.1 * m->overlap * signed_number(b, 1e-3, 1);
    }
    m->overlap += way[2];
    m->velocity[0] = way[0] / step;
    m->velocity[1] = (way[1] * n[2] + way[2] * n[1]) / step;
    m->velocity[2] = (way[2] * n[2] - way[1] * n[1]) / step;
}

static void check_force(const restitute_contact_force *f, double friction, int damaged)
{
    const double t = hypot(hypot(f->tangential[0], f->tangential[1]), f->tangential[2]);
    CHECK(isfinite(f->normal) && f->normal >= 0 && isfinite(t), "force %g, %g", f->normal, t);
    CHECK(damaged || t <= friction * f->normal * (1 + 1e-12), "%.17g > %g times %.17g", t, friction, f->normal);
}

/* Losses never fall; what a contact stores is not negative. */
static void check_details(const restitute_contact_law *law, double radius, struct contact *c)
{
    PREPARED(contact_details, d);
    if (CALL_FLAGS(restitute_contact_details_get, law, radius, c->state, &d) < 0 || c->damaged) return;
    CHECK(d.friction >= c->lost[0] && d.viscous >= c->lost[1], "losses %g %g after %g %g", d.friction, d.viscous,
          c->lost[0], c->lost[1]);
    CHECK(d.stored >= 0 && isfinite(d.stored + d.work + d.friction + d.viscous), "stored %g, work %g", d.stored,
          d.work);
    CHECK(d.stick_radius >= 0 && d.stick_radius <= d.contact_radius, "radii %g %g", d.contact_radius, d.stick_radius);
    c->lost[0] = d.friction, c->lost[1] = d.viscous;
}

/* Alone; beside what it gave among many. */
static void step_alone(struct bytes *b, const restitute_contact_law *law, const restitute_contact_rates *rates,
                       struct contact *c, const restitute_contact_force *batch, int status)
{
    restitute_contact_force force = {0}, again;
    const double *f = &force.normal, *g = &batch->normal;
    const size_t size = restitute_contact_law_state_size(law);
    memcpy(c->before, c->state, size * sizeof(double));
    restitute_contact_motion *given = below(b, 16) ? NULL : sized(b, &c->motion);
    if (given && given->struct_size != sizeof *given)
        CHECK(CALL(restitute_contact_step, law, rates, given, c->state, &force) < 0, "struct_size");
    free(given);
    c->status = CALL_IF(!c->damaged, restitute_contact_step, law, rates, &c->motion, c->state, &force);
    CHECK(c->status == status, "%d alone, %d of many", c->status, status);
    for (size_t i = 0; i < size; i++) /* but for the sign of a zero, and NaN where there was damage */
        CHECK(c->state[i] == c->many[i] || c->damaged, "state %zu: %.17g alone, %.17g of many", i, c->state[i],
              c->many[i]);
    if (c->status < 0) {
        CHECK(c->damaged || memcmp(c->before, c->state, size * sizeof(double)) == 0, "a failed step wrote; %s",
              fuzz_error.message);
        return;
    }
    steps_made++;
    check_force(&force, c->motion.friction, c->damaged);
    for (int j = 0; j < 4; j++)
        CHECK(f[j] == g[j], "%.17g alone, %.17g of many", f[j], g[j]);
    check_details(law, c->motion.radius, c);
    if (CALL_FLAGS(restitute_contact_peek, law, c->motion.normal, c->state, &again) == 0) check_force(&again, 0, 1);
}

static void run(struct bytes *b, const restitute_contact_law *law, const restitute_contact_rates *rates)
{
    struct contact c[contacts] = {{0}};
    double *many[contacts];
    const double radius = number(b, 1e-12, 1e12);
    const size_t n = (size_t)(1 + below(b, contacts)), size = restitute_contact_law_state_size(law);
    const int is_damaged = below(b, 4) == 0; /* at times, the first state */
    for (size_t i = 0; i < n; i++) {         /* a block each: the address sanitizer sees what writes beyond */
        c[i].state = calloc(size, sizeof(double)), c[i].before = calloc(size, sizeof(double));
        c[i].many = many[i] = calloc(size, sizeof(double));
        c[i].status = -1;
    }
    for (int k = 0; k < steps && b->left; k++) {
        restitute_contact_motion motion[contacts];
        restitute_contact_force batch[contacts];
        int statuses[contacts];
        const int odd = below(b, 64);
        if (odd == 0 && is_damaged) { /* the same in both */
            const size_t place = (size_t)take(b, 2) % size;
            c[0].state[place] = c[0].many[place] = signed_number(b, 1e-9, 1e9);
            c[0].damaged = 1;
        }
        for (size_t i = 0; i < n; i++) {
            move(b, &c[i], radius, rates->step);
            motion[i] = c[i].motion;
        }
        CALL_IF(!c[0].damaged, restitute_contact_step_many, law, rates, n, motion, many, batch, statuses);
        for (size_t i = 0; i < n; i++)
            step_alone(b, law, rates, &c[i], &batch[i], statuses[i]);
        if (odd == 1) CALL_FLAGS(restitute_contact_turn, law, motion[0].normal, motion[n - 1].normal, c[0].state);
        memcpy(many[0], c[0].state, size * sizeof(double));
    }
    for (size_t i = 0; i < n; i++)
        free(c[i].state), free(c[i].many), free(c[i].before);
}

__attribute__((destructor)) static void say_steps(void)
{
    printf("%ld steps alone, and in batches\n", steps_made);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bytes b = {data, size};
    restitute_material *material = any_material(&b);
    restitute_contact_law *law = material ? any_law(&b, material) : NULL;
    restitute_material_destroy(material);
    if (!law) return 0;
    PREPARED(contact_rates, rates);
    double limit;
    int status = CALL(restitute_contact_time_step_limit, law, number(&b, 1e-9, 10), number(&b, 1e-6, 10),
                      number(&b, 1e-3, 10), &limit);
    if (status < 0) limit = 1e-6;
    CHECK(limit > 0 && isfinite(limit), "limit %g s", limit);
    const double step = below(&b, 2) ? limit * number(&b, 1e-3, 10) : number(&b, 1e-12, 1e12);
    status = CALL(restitute_contact_rates_set, law, step, &rates);
    CHECK((status == RESTITUTE_OK) == (step >= 1e-60 && step <= 1e60), "step %g s: %d", step, status);
    if (status == RESTITUTE_OK) run(&b, law, &rates);
    restitute_contact_law_destroy(law);
    return 0;
}
