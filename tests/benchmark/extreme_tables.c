/* Campaign: tables of random solids, and look-ups at all speeds (docs/records/extremes.md).
 *
 *     extreme_tables LOOKUPS SEED [FIRST [TABLES]]
 *
 * TABLES (default 100) tables, each with its share of the look-ups, in blocks that are looked up in
 * one call and, every tenth, one by one. At places within the range of a table the method sync
 * solves the impact as well, of the table's contact and of spheres of another size and friction.
 * Exit status 0: no fault, 1: faults, 2: usage.
 * SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#define PLAIN_CHECKS

#include "../support/result.h"
#include "../support/sync.h"
#include "../support/table.h"
#include "extremes.h"

enum { block = 1000, most_terms = 30, samples = 20 };

struct tally {
    long tables, missed, failed, lookups;
    long compared[2];      /* of the table's own contact, and of others */
    struct worst worst[2]; /* error over the stated one */
    struct remark remarks[most_remarks];
};

static restitute_material *draw_solid(uint64_t *random)
{
    double tau[most_terms], g[most_terms];
    const int kind = random_below(random, 5);
    const int terms = kind == 4 ? 2 + random_below(random, most_terms - 1) : kind >= 2;
    const double eta = kind == 1 || random_below(random, 4) == 0 ? random_log(random, 1, 1e5) : 0;
    for (int k = 0; k < terms; k++) {
        tau[k] = random_log(random, 1e-9, 1e3);
        g[k] = random_log(random, 1e3, 1e9);
    }
    restitute_material *material = NULL;
    restitute_material_prony(kind == 3 ? 0 : 1e6, kind == 0 ? 0 : eta, (size_t)terms, tau, g, random_in(random, 0, 0.5),
                             &material, NULL);
    return material;
}

static void check_block(const restitute_table *table, const restitute_table_contact *contact, uint64_t *random,
                        int alone)
{
    double normal[block], sliding[block], ez[block], ex[block];
    const int kind = random_below(random, 3);
    for (int i = 0; i < block; i++) {
        normal[i] = kind ? random_log(random, 1e-6, 1e4) : random_log(random, 1e-290, 1e100);
        sliding[i] = normal[i] * random_log(random, 1e-6, 1e3);
        if (kind == 0) sliding[i] = random_log(random, 1e-290, 1e100);
        if (i % 64 == 0) *(i % 128 ? &normal[i] : &sliding[i]) = 0;
        if (i % 2) sliding[i] = -sliding[i];
    }
    feclearexcept(FE_ALL_EXCEPT);
    const int status = restitute_table_pair_many(table, contact, block, normal, sliding, ez, ex, NULL);
    expect_no_exception("restitute_table_pair_many");
    EXPECT(status == 0, "status %d", status);
    for (int i = 0; i < block; i++) {
        EXPECT(is_pair(ez[i], ex[i]), "ez %.17g ex %.17g at %.17g, %.17g m/s", ez[i], ex[i], normal[i], sliding[i]);
        if (!alone) continue;
        const struct pair p = look_up_for(table, contact, normal[i], sliding[i]);
        EXPECT(p.ez == ez[i] && p.ex == ex[i], "alone %.17g %.17g, in a batch %.17g %.17g", p.ez, p.ex, ez[i], ex[i]);
    }
}

/* The stated error comes from checks at some places, so it may be exceeded a little at others.
 * Twice as much is a fault.
 * `contact`: of the scene, if it is not the one the table is for; NULL otherwise. */
static void check_errors(struct tally *t, const restitute_table *table, restitute_scene scene,
                         const restitute_table_contact *contact, uint64_t *random)
{
    const int other = contact != NULL;
    const double speed_factor = other ? contact->speed_factor : 1;
    const restitute_table_info info = describe(table);
    restitute_options options = sync_to(fmax(1e-8, info.tolerance / 10));
    options.max_work = 0.1;
    restitute_solver *solver = make_solver(&options);
    for (int i = 0; i < samples; i++) {
        PREPARED(result, r);
        scene.normal_speed = random_log(random, info.speed[0], info.speed[1]) / speed_factor;
        scene.tangential_speed = scene.normal_speed * random_log(random, 1e-3, 10);
        const int status = restitute_solve_scene(solver, &scene, &r, NULL, NULL, NULL);
        const struct pair p = look_up_for(table, contact, scene.normal_speed, scene.tangential_speed);
        if (status != RESTITUTE_OK && status != RESTITUTE_NO_REBOUND) continue;
        const double ratio =
            fmax((fabs(p.ez - r.ez) - r.error_ez) / info.error_ez, (fabs(p.ex - r.ex) - r.error_ex) / info.error_ex);
        t->compared[other]++;
        keep_worst(&t->worst[other], ratio);
        EXPECT(ratio <= 2, "%s at %.17g, %.17g m/s: ez %.9g ex %.9g, sync %.9g %.9g, stated errors %.2g %.2g",
               other ? "another contact" : "", scene.normal_speed, scene.tangential_speed, p.ez, p.ex, r.ez, r.ex,
               info.error_ez, info.error_ex);
    }
    restitute_solver_destroy(solver);
}

static void run_table(struct tally *t, uint64_t *random, long lookups)
{
    static const double tolerances[] = {1e-2, 1e-3, 1e-4};
    restitute_material *material = draw_solid(random);
    PREPARED(table_options, options);
    PREPARED(scene, scene);
    restitute_error error = {0};
    restitute_table *table = NULL;
    scene.material = material;
    scene.radius1 = random_log(random, 1e-4, 1e-1);
    scene.mass1 = 4e3 * scene.radius1 * scene.radius1 * scene.radius1 * random_log(random, 0.1, 10);
    scene.friction = random_below(random, 8) ? random_log(random, 1e-2, 3) : random_below(random, 2) ? 0 : INFINITY;
    scene.rotation_blocked = random_below(random, 6) == 0;
    scene.deformable = 1 + random_below(random, 2);
    options.tolerance = tolerances[random_below(random, 3)];
    options.max_impacts = 3000;
    alarm(300);
    const int status = restitute_table_build(&scene, &options, &table, &error);
    t->tables++;
    t->missed += status == RESTITUTE_TOLERANCE_NOT_REACHED;
    t->failed += status < 0;
    EXPECT(status == RESTITUTE_OK || error.message[0], "status %d without a message", status);
    if (status) add_remark(t->remarks, status, error.message);
    if (table) {
        PREPARED(table_contact, contact);
        restitute_scene other = scene;
        if (scene.friction > 0 && scene.friction < INFINITY) other.friction = random_log(random, 1e-3, 10);
        check_errors(t, table, scene, NULL, random);
        other.radius1 *= random_log(random, 0.1, 10);
        other.mass1 *= random_log(random, 0.1, 10);
        EXPECT(restitute_table_contact_set(table, &other, &contact, &error) == 0, "%s", error.message);
        check_errors(t, table, other, &contact, random);
        for (long n = 0; n < lookups; n += block, t->lookups += block)
            check_block(table, n % (2 * block) ? &contact : NULL, random, n % (10 * block) == 0);
    }
    alarm(0);
    restitute_table_destroy(table);
    restitute_material_destroy(material);
}

int main(int argc, char **argv)
{
    static struct tally t;
    if (argc < 3 || argc > 5) return fprintf(stderr, "usage: extreme_tables LOOKUPS SEED [FIRST [TABLES]]\n"), 2;
    const long first = argc > 3 ? strtol(argv[3], NULL, 10) : 0, tables = argc > 4 ? strtol(argv[4], NULL, 10) : 100;
    const long lookups = strtol(argv[1], NULL, 10) / tables;
    const uint64_t seed = strtoull(argv[2], NULL, 10);
    watch_signals();
    for (current = first; current < first + tables; current++) {
        uint64_t random = random_of(seed, current);
        run_table(&t, &random, lookups);
    }
    printf(
        "%ld tables (%ld above their tolerance, %ld failed), %ld look-ups, %ld compared with sync: at most %.3g of the "
        "stated error (case %ld), %ld for another contact: %.3g (case %ld); faults %ld\n",
        t.tables, t.missed, t.failed, t.lookups, t.compared[0], t.worst[0].value, t.worst[0].number, t.compared[1],
        t.worst[1].value, t.worst[1].number, faults);
    print_remarks(t.remarks);
    return faults > 0;
}
