/* Impacts, scenes in SI units and two bodies in space, with any numbers, structs and options: one,
 * many, a plan, a history.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifdef RESTITUTE_WITH_CVODE
#include <restitute/cvode.h>
#endif

#include <time.h>

#include "../support/history.h"
#include "fuzz.h"

enum { most_cases = 3, samples = 5 };

/* At most some tenths of a second: `max_work` and `time_limit` that allow more are lowered. */
static restitute_options any_options(struct bytes *b)
{
    PREPARED(options, o);
    const int kind = below(b, 8), known = below(b, 16);
    if (kind < 4) o.method = restitute_method_sync();
#ifdef RESTITUTE_WITH_CVODE
    if (kind == 4) o.method = restitute_method_cvode();
#endif
    if (kind == 5) o.method = NULL;
    o.tolerance = number(b, 1e-6, 0.1);
    if (known & 1) o.elements = below(b, 8) ? (int64_t)take(b, 1) : (int64_t)take(b, 8);
    if (known & 2) o.time_step = number(b, 1e-4, 1);
    if (known & 4) o.threads = below(b, 4) - 1;
    if (known & 8) o.speed_limit = number(b, 1e-3, 1);
    o.max_work = number(b, 1e-6, 1e-2);
    o.time_limit = number(b, 1e-3, 0.1);
    if (o.max_work > 1e-2) o.max_work = 1e-2;
    if (o.time_limit > 0.1 || o.time_limit == 0) o.time_limit = 0.1;
    return o;
}

static restitute_impact any_impact(struct bytes *b, const restitute_material *material)
{
    PREPARED(impact, impact);
    impact.chi = number(b, 1.0 / 3, 1000);
    impact.psi = number(b, 1e-3, 100);
    impact.delta1 = number(b, 1e-3, 1e3);
    impact.gamma = number(b, 1e-3, 1e3);
    if (below(b, 2)) impact.material = material;
    return impact;
}

static restitute_scene any_scene(struct bytes *b, const restitute_material *material)
{
    PREPARED(scene, s);
    const int known = (int)take(b, 1);
    if (below(b, 16)) s.material = material;
    s.deformable = below(b, 8) ? 1 + below(b, 2) : (int)take(b, 4);
    s.radius1 = number(b, 1e-6, 10);
    s.mass1 = number(b, 1e-12, 1e6);
    if (known & 1) s.radius2 = number(b, 1e-6, 10);
    if (known & 1) s.mass2 = number(b, 1e-12, 1e6);
    if (known & 2) s.inertia1 = number(b, 1e-20, 1e6);
    if (known & 4) s.inertia2 = number(b, 1e-20, 1e6);
    s.rotation_blocked = (known & 8) != 0;
    s.friction = number(b, 1e-3, 10);
    s.normal_speed = number(b, 1e-6, 1e3);
    s.tangential_speed = signed_number(b, 1e-6, 1e3);
    if (known & 16) s.spin1 = signed_number(b, 1e-3, 1e6);
    if (known & 32) s.spin2 = signed_number(b, 1e-3, 1e6);
    if (known & 64) s.wave_density = number(b, 1e-3, 1e5);
    return s;
}

/* A result, and its copy from before the call. */
struct watched {
    restitute_result *result, before;
    clock_t begin;
};

static struct watched watch(struct bytes *b)
{
    struct watched w;
    restitute_result_init(&w.before);
    memset((char *)&w.before + sizeof(size_t), 0x5a, sizeof w.before - sizeof(size_t));
    w.result = sized(b, &w.before);
    w.begin = clock();
    return w;
}

/* Sanitizers take up to ten times as long as the limit of a tenth of a second. */
static void look_at(struct watched *w, int status)
{
    const double took = (double)(clock() - w->begin) / CLOCKS_PER_SEC;
    const restitute_result *r = w->result;
    const int whole = r->struct_size == sizeof *r;
    CHECK(took < 5, "took %g s; %s", took, fuzz_error.message);
    CHECK(whole || status < 0, "struct_size %zu", r->struct_size);
    CHECK(status >= 0 || !whole || memcmp(r, &w->before, sizeof *r) == 0, "a failed call wrote its result");
    CHECK(status < 0 || !fault_of(r, status), "%s: ez %g, ex %g, time %g", fault_of(r, status), r->ez, r->ex,
          r->contact_time);
    free(w->result);
}

static void one(struct bytes *b, restitute_solver *solver, const restitute_impact *impact, const restitute_scene *scene)
{
    double room[history_columns][samples];
    PREPARED(history, history);
    PREPARED(ledger, ledger);
    PREPARED(numbers, n);
    const size_t capacity = below(b, 4) ? samples : (size_t)take(b, 1) % (samples + 1);
    const int wanted = (int)take(b, 1), asked = below(b, 8);
    memset(room, 0xff, sizeof room); /* NaN */
    set_columns(&history, samples, room[0], wanted);
    history.capacity = capacity;
    void *given = asked & 4 ? sized(b, scene) : sized(b, impact);
    restitute_history *kept = asked & 2 ? sized(b, &history) : NULL;
    restitute_ledger *parts = asked & 1 ? &ledger : NULL;
    struct watched w = watch(b);
    const int status = asked & 4 ? CALL(restitute_solve_scene, solver, given, w.result, parts, kept)
                                 : CALL(restitute_solve, solver, given, w.result, parts, kept);
    look_at(&w, status);
    CHECK(status < 0 || !parts || isfinite(ledger.residual_z + ledger.residual_x), "ledger");
    if (status >= 0 && kept) {
        CHECK(kept->count >= 1 && kept->count <= history.capacity, "%zu samples", kept->count);
        for (int i = 0; i < history_columns; i++)
            for (size_t k = 0; k < kept->count && wanted >> i & 1; k++)
                CHECK(isfinite(room[i][k]), "array %d, sample %zu: %g", i, k, room[i][k]);
    }
    if (asked & 4 && CALL(restitute_scene_numbers, given, &n) == RESTITUTE_OK)
        CHECK(n.chi >= 0.3333 && n.psi >= 0 && n.length_z > 0 && n.time > 0 && isfinite(n.force), "chi %g", n.chi);
    free(given);
    free(kept);
}

static void plan(struct bytes *b, const restitute_impact *impact, const restitute_options *options)
{
    restitute_plan *made = NULL;
    restitute_impact *given = sized(b, impact);
    const int status = CALL(restitute_plan_create, given, options, &made);
    CHECK((status < 0) == !made, "status %d", status);
    for (int i = 0; i < 2 && made; i++) {
        struct watched w = watch(b);
        look_at(&w, CALL(restitute_plan_solve, made, number(b, 1e-2, 10), w.result, NULL, NULL));
    }
    restitute_plan_destroy(made);
    free(given);
}

static void many(struct bytes *b, const restitute_material *material, const restitute_options *options)
{
    restitute_impact impact[most_cases];
    restitute_result result[most_cases];
    int statuses[most_cases], sizes_differ = !below(b, 8);
    const size_t n = (size_t)below(b, most_cases + 1);
    for (size_t i = 0; i < n; i++) {
        impact[i] = any_impact(b, material);
        restitute_result_init(&result[i]);
        result[i].ez = -7;
        statuses[i] = 7;
        if (sizes_differ) impact[i].struct_size = (size_t)take(b, 1);
    }
    const int status = CALL_FLAGS(restitute_solve_many, n, impact, options, result, statuses);
    int flags = status == RESTITUTE_ERROR_DOMAIN ? 0 : fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
    for (size_t i = 0; i < n; i++) {
        if (statuses[i] == RESTITUTE_ERROR_DOMAIN) flags = 0;
        if (statuses[i] == 7 || statuses[i] < 0)
            CHECK(status < 0 && result[i].ez == -7, "case %zu was written", i);
        else
            CHECK(is_pair(result[i].ez, result[i].ex), "pair %.17g, %.17g", result[i].ez, result[i].ex);
    }
    CHECK(!flags, "flags %x, %s", (unsigned)flags, fuzz_error.message);
}

static restitute_body any_body(struct bytes *b)
{
    PREPARED(body, body);
    for (int i = 0; i < 3; i++) {
        body.velocity[i] = signed_number(b, 1e-3, 10);
        body.spin[i] = below(b, 2) ? 0 : signed_number(b, 1e-3, 1e6);
        body.normal[i] = below(b, 2) ? 0 : signed_number(b, 1e-3, 1);
    }
    body.radius = below(b, 4) ? number(b, 1e-4, 1) : INFINITY;
    body.mass = below(b, 4) ? number(b, 1e-9, 10) : INFINITY;
    if (!below(b, 4)) body.inertia = number(b, 1e-15, 1);
    return body;
}

/* Mostly at touch along x. */
static void collide(struct bytes *b, restitute_solver *solver, const restitute_material *material)
{
    PREPARED(collision, c);
    restitute_body body[2] = {any_body(b), any_body(b)};
    c.material = material;
    c.deformable = 1 + below(b, 2);
    c.friction = number(b, 1e-3, 10);
    if (!below(b, 4)) c.touch_gap = number(b, 1e-9, 1);
    body[1].position[0] = 0;
    for (int i = 0; i < 2; i++)
        body[1].position[0] += isinf(body[i].radius) ? 0 : body[i].radius;
    if (!below(b, 8)) body[1].position[0] = signed_number(b, 1e-4, 1);
    restitute_body *first = sized(b, &body[0]), *second = sized(b, &body[1]);
    restitute_collision *given = sized(b, &c);
    struct watched w = watch(b);
    const int whole = first->struct_size == sizeof *first && second->struct_size == sizeof *second;
    const int status = CALL(restitute_collide, solver, given, first, second, w.result);
    look_at(&w, status);
    CHECK(whole || status < 0, "struct_size %zu, %zu", first->struct_size, second->struct_size);
    CHECK(!whole || status >= 0 || !(memcmp(first, body, sizeof *first) || memcmp(second, body + 1, sizeof *second)),
          "a failed call wrote");
    for (int i = 0; i < 3 && status >= 0; i++)
        CHECK(isfinite(first->velocity[i] + second->velocity[i]), "velocity along axis %d", i);
    free(first);
    free(second);
    free(given);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bytes b = {data, size};
    const int kind = below(&b, 8);
    const restitute_options all = any_options(&b);
    restitute_options *options = sized(&b, &all);
    restitute_material *material = below(&b, 4) ? any_material(&b) : NULL;
    const restitute_impact impact = any_impact(&b, material);
    const restitute_scene scene = any_scene(&b, material);
    restitute_solver *solver = NULL;
    const int status = CALL(restitute_solver_create, options, &solver);
    CHECK((status < 0) == !solver, "status %d", status);
    if (kind == 0) plan(&b, &impact, options);
    if (kind == 1) many(&b, material, options);
    if (kind > 5 && solver) collide(&b, solver, material);
    if (kind > 1 && kind < 6 && solver) one(&b, solver, &impact, &scene);
    restitute_solver_destroy(solver);
    restitute_material_destroy(material);
    free(options);
    return 0;
}
