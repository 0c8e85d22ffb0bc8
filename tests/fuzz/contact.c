/* The contact law of DEM: any law, step and motion, states that were damaged, one and many.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <restitute/contact.h>

#include "fuzz.h"

enum { contacts = 5, steps = 12 };

static restitute_contact_law *any_law(struct bytes *b, const restitute_material *material)
{
    restitute_contact_law_options o;
    restitute_contact_law *law = NULL;
    restitute_contact_law_options_init(&o);
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
    REQUIRE((status < 0) == !law, "status %d", status);
    free(given);
    return law;
}

/* In its ranges, mostly: in units of radius and step. */
static restitute_contact_motion any_motion(struct bytes *b, double radius, double step)
{
    restitute_contact_motion m;
    restitute_contact_motion_init(&m);
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

static void check_force(const restitute_contact_force *f, double friction, int damaged)
{
    const double t = hypot(hypot(f->tangential[0], f->tangential[1]), f->tangential[2]);
    REQUIRE(isfinite(f->normal) && f->normal >= 0 && isfinite(t), "force %g, %g", f->normal, t);
    REQUIRE(damaged || t <= friction * f->normal * (1 + 1e-9), "%.17g > %g times %.17g", t, friction, f->normal);
}

static void run(struct bytes *b, const restitute_contact_law *law, const restitute_contact_rates *rates)
{
    const size_t size = restitute_contact_law_state_size(law), bytes = size * sizeof(double);
    const double radius = number(b, 1e-6, 10);
    double *state[contacts], *many[contacts], *before = malloc(bytes);
    int damaged = 0;
    const size_t n = (size_t)(1 + below(b, contacts));
    for (size_t i = 0; i < n; i++) {
        state[i] = calloc(size, sizeof(double));
        many[i] = calloc(size, sizeof(double));
    }
    for (int k = 0; k < steps && b->left; k++) {
        restitute_contact_motion motion[contacts];
        restitute_contact_force force[contacts], batch[contacts];
        int statuses[contacts], odd = below(b, 16);
        if (odd == 0) { /* damage, the same in both */
            const size_t place = (size_t)take(b, 2) % size;
            const double value = signed_number(b, 1e-9, 1e9);
            state[0][place] = many[0][place] = value;
            damaged = 1;
        }
        memset(batch, 0x5a, sizeof batch);
        for (size_t i = 0; i < n; i++)
            motion[i] = any_motion(b, radius, rates->step);
        damaged ? CALL_FLAGS(restitute_contact_step_many, law, rates, n, motion, many, batch, statuses)
                : CALL(restitute_contact_step_many, law, rates, n, motion, many, batch, statuses);
        for (size_t i = 0; i < n; i++) {
            memset(&force[i], 0x5a, sizeof force[i]);
            memcpy(before, state[i], bytes);
            restitute_contact_motion *given = i ? NULL : sized(b, &motion[i]);
            if (given && given->struct_size != sizeof *given)
                REQUIRE(CALL(restitute_contact_step, law, rates, given, state[i], &force[i]) < 0, "struct_size");
            free(given);
            const restitute_contact_motion *m = &motion[i];
            const int status = damaged ? CALL_FLAGS(restitute_contact_step, law, rates, m, state[i], &force[i])
                                       : CALL(restitute_contact_step, law, rates, m, state[i], &force[i]);
            REQUIRE(status == statuses[i], "contact %zu: %d alone, %d of many", i, status, statuses[i]);
            if (status < 0)
                REQUIRE(damaged || memcmp(before, state[i], bytes) == 0, "a failed step wrote; %s", fuzz_error.message);
            else
                check_force(&force[i], m->friction, damaged && i == 0);
            const double *f = &force[i].normal, *g = &batch[i].normal;
            for (int j = 0; j < 4; j++) /* but for the sign of a zero */
                REQUIRE(status < 0 || f[j] == g[j], "contact %zu: %.17g alone, %.17g of many", i, f[j], g[j]);
        }
        restitute_contact_details d;
        restitute_contact_force again;
        restitute_contact_details_init(&d);
        if (CALL_FLAGS(restitute_contact_details_get, law, radius, state[0], &d) == 0)
            REQUIRE(damaged || (d.contact_radius >= 0 && d.stick_radius >= 0 && d.friction >= 0 && d.viscous >= 0 &&
                                isfinite(d.work + d.stored)),
                    "losses %g, %g", d.friction, d.viscous);
        if (CALL_FLAGS(restitute_contact_peek, law, motion[0].normal, state[0], &again) == 0) check_force(&again, 0, 1);
        if (odd == 1) CALL_FLAGS(restitute_contact_turn, law, motion[0].normal, motion[n - 1].normal, state[0]);
        memcpy(many[0], state[0], bytes);
    }
    for (size_t i = 0; i < n; i++) {
        free(state[i]);
        free(many[i]);
    }
    free(before);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bytes b = {data, size};
    restitute_material *material = any_material(&b);
    restitute_contact_law *law = material ? any_law(&b, material) : NULL;
    restitute_material_destroy(material);
    if (!law) return 0;
    restitute_contact_rates rates;
    double limit;
    restitute_contact_rates_init(&rates);
    int status = CALL(restitute_contact_time_step_limit, law, number(&b, 1e-9, 10), number(&b, 1e-6, 10),
                      number(&b, 1e-3, 10), &limit);
    if (status < 0) limit = 1e-6;
    REQUIRE(limit > 0 && isfinite(limit), "limit %g s", limit);
    const double step = below(&b, 2) ? limit * number(&b, 1e-3, 10) : number(&b, 1e-9, 1e-3);
    status = CALL(restitute_contact_rates_set, law, step, &rates);
    REQUIRE((status == RESTITUTE_OK) == (step >= 1e-60 && step <= 1e60), "step %g s: %d", step, status);
    if (status == RESTITUTE_OK) run(&b, law, &rates);
    restitute_contact_law_destroy(law);
    return 0;
}
