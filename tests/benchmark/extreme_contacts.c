/* Campaign: the contact law on random drives of random solids (docs/records/extremes.md).
 *
 *     extreme_contacts STEPS SEED [FIRST]
 *
 * A case is a law and twelve contacts of it. Each makes every step twice, alone and with the others
 * in one call, which must give the same. The drives approach, stop, slide, turn and separate at
 * random, at scales from 1e-12 to 1e12 m, s and Pa. Exit status 0: no fault, 1: faults, 2: usage.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#include <restitute/contact.h>

#include "../support/remarks.h"
#include "extremes.h"

enum { contacts = 12, most_terms = 30, most_state = 1600 };

/* What a contact did; work by the trapezoid, J. */
struct contact {
    double *state, *twin;
    restitute_contact_force force;
    double work, largest, lost[2];
};

struct tally {
    long laws, reduced, unmade, steps, refused;
    double off, worst_off; /* energies beside work, over both and force times size */
    long worst_case, ledgers;
    struct remark remarks[most_remarks];
};

static restitute_material *draw_solid(uint64_t *random, double modulus, double time)
{
    double tau[most_terms], g[most_terms];
    restitute_material *material = NULL;
    const int few = random_below(random, 4), many = 1 + random_below(random, most_terms);
    const int terms = random_below(random, 4) ? few : many;
    const int flows = terms > 0 && random_below(random, 4) == 0, dashpot = random_below(random, 3) == 0;
    const double eta = modulus * time * random_log(random, 1e-6, 1e6);
    for (int k = 0; k < terms; k++) {
        tau[k] = time * random_log(random, 1e-6, 1e6);
        g[k] = modulus * random_log(random, 1e-3, 1e3);
    }
    restitute_material_prony(flows ? 0 : modulus, dashpot ? eta : 0, (size_t)terms, tau, g, random_in(random, 0, 0.5),
                             &material, NULL);
    return material;
}

static restitute_contact_law *draw_law(struct tally *t, uint64_t *random, restitute_contact_law_options *o, double step)
{
    static const int elements[] = {8, 8, 8, 16, 24, 32};
    const double modulus = random_log(random, 1e-12, 1e12);
    restitute_material *material = draw_solid(random, modulus, step * random_log(random, 1, 1e3));
    restitute_contact_law *law = NULL;
    restitute_error error = {0};
    restitute_contact_law_options_init(o);
    o->elements = elements[random_below(random, 6)];
    o->terms = 1 + random_below(random, 8);
    o->slip_cycles = random_below(random, 3) == 0;
    o->frictionless = random_below(random, 6) == 0;
    o->details = random_below(random, 2);
    o->shortest = step, o->longest = 1e3 * step;
    const int status = restitute_contact_law_create(material, o, &law, &error);
    t->laws++;
    t->reduced += status == RESTITUTE_TOLERANCE_NOT_REACHED;
    t->unmade += status < 0;
    EXPECT(status <= 0 || status == RESTITUTE_TOLERANCE_NOT_REACHED, "status %d", status);
    EXPECT(status == RESTITUTE_OK || error.message[0], "a law without a message");
    restitute_material_destroy(material);
    return law;
}

/* What a leg of a drive does in a step: approach, stop, slide far or separate. */
static void draw_leg(uint64_t *random, double way[3], double size, int leg)
{
    way[2] = leg == 1 ? 0 : size * random_in(random, leg == 0 ? 0 : -1, 1);
    for (int k = 0; k < 2; k++)
        way[k] = leg == 0 ? 0 : size * random_in(random, -1, 1) * (leg == 2 ? 100 : 1);
}

static void move(uint64_t *random, restitute_contact_motion *m, const double way[3], double step)
{
    double *n = m->normal, length = 0;
    if (random_below(random, 50) == 0) {
        for (int k = 0; k < 3; k++)
            n[k] += random_in(random, -0.01, 0.01), length += n[k] * n[k];
        for (int k = 0; k < 3; k++)
            n[k] /= sqrt(length);
    }
    m->overlap += way[2];
    const double along = way[0] * n[0] + way[1] * n[1]; /* the slide stays in the plane */
    for (int k = 0; k < 3; k++)
        m->velocity[k] = ((k < 2 ? way[k] : 0) - along * n[k] + way[2] * n[k]) / step;
}

static void check_force(const restitute_contact_force *f, double friction)
{
    const double *t = f->tangential, size = hypot(hypot(t[0], t[1]), t[2]);
    EXPECT(f->normal >= 0 && isfinite(f->normal), "normal force %g", f->normal);
    EXPECT(size <= friction * f->normal * (1 + 1e-12), "tangential force %g of %g", size, friction * f->normal);
}

/* Losses never fall; what a contact stores is not negative. */
static void check_details(const restitute_contact_law *law, double radius, struct contact *c)
{
    restitute_contact_details e;
    restitute_contact_details_init(&e);
    EXPECT(restitute_contact_details_get(law, radius, c->state, &e, NULL) == 0, "no details");
    EXPECT(e.friction >= c->lost[0] && e.viscous >= c->lost[1] && isfinite(e.friction + e.viscous),
           "losses %g %g after %g %g", e.friction, e.viscous, c->lost[0], c->lost[1]);
    EXPECT(e.stored >= 0 && isfinite(e.stored) && isfinite(e.work), "stored %g, work %g", e.stored, e.work);
    EXPECT(e.contact_radius >= 0 && e.stick_radius >= 0 && e.stick_radius <= e.contact_radius, "radii %g %g",
           e.contact_radius, e.stick_radius);
    c->lost[0] = e.friction, c->lost[1] = e.viscous;
}

static void close_ledger(struct tally *t, const restitute_contact_law *law, double radius, const struct contact *c,
                         double size)
{
    restitute_contact_details e;
    restitute_contact_details_init(&e);
    restitute_contact_details_get(law, radius, c->state, &e, NULL);
    const double sum = e.stored + e.friction + e.viscous, scale = sum + c->largest * size;
    if (!(scale > 0)) return;
    const double off = fabs(sum - e.work) / scale;
    t->ledgers++;
    t->off += off;
    if (off > t->worst_off) t->worst_off = off, t->worst_case = current;
}

static int same(const double *a, const double *b, int n)
{
    for (int k = 0; k < n; k++)
        if (a[k] != b[k]) return 0; /* the sign of a zero may differ; NaN differs */
    return 1;
}

/* One step of all contacts, each alone and all in one call. Returns how many were refused. */
static int step_all(struct tally *t, const restitute_contact_law *law, const restitute_contact_rates *rates,
                    const restitute_contact_motion *motion, struct contact *c, int details)
{
    double *twins[contacts];
    restitute_contact_force batch[contacts];
    restitute_error error = {0};
    int statuses[contacts], refused = 0;
    const int size = (int)restitute_contact_law_state_size(law);
    for (int k = 0; k < contacts; k++)
        twins[k] = c[k].twin, batch[k] = c[k].force;
    feclearexcept(FE_ALL_EXCEPT);
    restitute_contact_step_many(law, rates, contacts, motion, twins, batch, statuses, NULL);
    for (int k = 0; k < contacts; k++) {
        const int status = restitute_contact_step(law, rates, &motion[k], c[k].state, &c[k].force, &error);
        t->steps++;
        EXPECT(status == statuses[k], "status %d, in a batch %d", status, statuses[k]);
        EXPECT(same(c[k].state, c[k].twin, size) && same(&batch[k].normal, &c[k].force.normal, 4),
               "contact %d differs in a batch: %.17g, %.17g N", k, c[k].force.normal, batch[k].normal);
        if (status) add_remark(t->remarks, status, error.message), refused++;
        if (status) continue;
        check_force(&c[k].force, motion[k].friction);
        c[k].largest = fmax(c[k].largest, c[k].force.normal);
        if (details) check_details(law, motion[k].radius, &c[k]);
    }
    expect_no_exception("restitute_contact_step");
    return refused;
}

static void drive(struct tally *t, uint64_t *random, long most)
{
    static double states[2 * contacts][most_state];
    struct contact c[contacts] = {{0}};
    restitute_contact_motion motion[contacts];
    restitute_contact_rates rates;
    restitute_contact_law_options options;
    const double step = random_log(random, 1e-12, 1e12), radius = random_log(random, 1e-12, 1e12);
    restitute_contact_law *law = draw_law(t, random, &options, step);
    if (!law) return;
    const double size = radius * random_log(random, 1e-9, 1e-3);
    EXPECT(restitute_contact_law_state_size(law) <= most_state, "a state of %zu",
           restitute_contact_law_state_size(law));
    memset(states, 0, sizeof states);
    for (int k = 0; k < contacts; k++) {
        c[k].state = states[2 * k], c[k].twin = states[2 * k + 1];
        restitute_contact_motion_init(&motion[k]);
        motion[k].radius = radius;
        motion[k].friction = random_below(random, 8) ? random_log(random, 1e-3, 10) : 0;
    }
    restitute_contact_rates_init(&rates);
    EXPECT(restitute_contact_rates_set(law, step, &rates, NULL) == 0, "no rates");
    double way[contacts][3];
    int refused = 0;
    for (long n = 0; n < most && !refused; n++) {
        for (int k = 0; k < contacts; k++) {
            if (n % 20 == 0) draw_leg(random, way[k], 0.05 * size, n == 0 ? 0 : random_below(random, 4));
            move(random, &motion[k], way[k], step);
        }
        refused = step_all(t, law, &rates, motion, c, options.details);
    }
    t->refused += refused;
    for (int k = 0; k < contacts && options.details; k++)
        close_ledger(t, law, radius, &c[k], size);
    restitute_contact_law_destroy(law);
}

int main(int argc, char **argv)
{
    static struct tally t;
    if (argc < 3 || argc > 4) return fprintf(stderr, "usage: extreme_contacts STEPS SEED [FIRST]\n"), 2;
    const long steps = strtol(argv[1], NULL, 10), first = argc > 3 ? strtol(argv[3], NULL, 10) : 0;
    const uint64_t seed = strtoull(argv[2], NULL, 10);
    watch_signals();
    for (current = first; t.steps < steps; current++) {
        uint64_t random = random_of(seed, current);
        alarm(60);
        drive(&t, &random, 200);
    }
    printf("%ld laws (%ld reduced beyond 20 %%, %ld refused), %ld steps alone and as many in batches, %ld refused\n",
           t.laws, t.reduced, t.unmade, t.steps, t.refused);
    for (int k = 0; k < most_remarks; k++)
        if (t.remarks[k].count > 0)
            printf("%8ld times status %d: %s\n", t.remarks[k].count, t.remarks[k].status, t.remarks[k].text);
    printf("%ld ledgers, off by %.3g in the mean, %.3g at most (case %ld); faults %ld\n", t.ledgers,
           t.ledgers ? t.off / (double)t.ledgers : 0, t.worst_off, t.worst_case, faults);
    free_remarks(t.remarks);
    return faults > 0;
}
