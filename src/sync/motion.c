/* The normal motion at several resolutions (motion.h).
 * SPDX-License-Identifier: BSD-3-Clause */
#include "sync/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sync/tuning.h"

static void release(struct rst_own_memory *own)
{
    struct rst_motion *motion = (struct rst_motion *)own;
    for (int i = 0; i <= rst_most_halvings; i++)
        free(motion->run[i].room);
    free(motion->arms);
    free(motion->store_room);
    free(motion->walk_room);
    free(motion);
}

struct rst_motion *rst_motion_of(struct rst_workspace *workspace)
{
    return rst_own_memory_of(workspace, sizeof(struct rst_motion), release);
}

/* The arms of a solid: the spring G_inf, if there is one, and the terms. */
static int64_t spread_arms(const struct rst_solid *s, double *g, double *rate)
{
    int64_t n = 0;
    if (s->g_inf > 0 || (s->n_terms == 0 && !(s->eta > 0))) {
        g[n] = s->g_inf;
        rate[n++] = 0;
    }
    for (int64_t k = 0; k < s->n_terms; k++) {
        g[n] = s->g[k];
        rate[n++] = 1 / s->tau[k];
    }
    return n;
}

/* Arms of the solid held, then those of the solid asked for: g and rate of each. */
static int make_arms(struct rst_motion *motion, int64_t most)
{
    size_t size = (size_t)(4 * motion->most_arms);
    if (most <= motion->most_arms) return 0;
    if (rst_make_room(&motion->arms, &size, (size_t)(4 * most))) return 1;
    motion->most_arms = most;
    motion->n_arms = -1; /* of no solid */
    return 0;
}

int rst_motion_begin(struct rst_motion *motion, const struct rst_problem *problem, int first, int keep)
{
    const struct rst_solid *s = &problem->solid;
    if (make_arms(motion, s->n_terms + 1)) return 1;
    double *held = motion->arms, *asked = motion->arms + 2 * motion->most_arms;
    const int64_t n = spread_arms(s, asked, asked + motion->most_arms);
    const size_t bytes = (size_t)n * sizeof(double);
    const double share = problem->mode == RST_FRICTIONLESS ? 1 : fmin(1, problem->shear_speed / (2 * problem->chi));
    const double stop_speed = fmax(rst_slowest, rst_rest_part * problem->tolerance * share);
    const int same = keep && first == motion->first && n == motion->n_arms && motion->eta == s->eta &&
                     memcmp(held, asked, bytes) == 0 &&
                     memcmp(held + motion->most_arms, asked + motion->most_arms, bytes) == 0;
    motion->stop_speed = stop_speed;
    if (same) return 0;
    memcpy(held, asked, bytes);
    memcpy(held + motion->most_arms, asked + motion->most_arms, bytes);
    motion->first = first;
    motion->n_arms = n;
    motion->eta = s->eta;
    motion->scale = sqrt(0.4 * rst_likely_depth(s->g_inf, s->eta, s->n_terms, s->g, s->tau));
    for (int i = 0; i <= rst_most_halvings; i++)
        motion->run[i].found = RST_NOT_SOLVED;
    return 0;
}

double rst_roughness(int halvings)
{
    return fmax(rst_least_panel_roughness, rst_first_roughness * pow(rst_roughness_falls, halvings - 1));
}

double rst_piece_roughness(const struct rst_problem *problem, int halvings)
{
    if (problem->elements > 0) return rst_roughness(halvings) * sqrt(fmax(1, problem->chi));
    return fmin(rst_roughness(halvings), rst_piece_part * problem->tolerance);
}

static int64_t first_capacity(int halvings)
{
    return (int64_t)rst_first_panels << halvings;
}

/* Panels, M_k, P_k, how arms respond on the panels, and what the restitution needs besides. */
static int lay_out(const struct rst_motion *motion, struct rst_run *run, int64_t capacity, double roughness)
{
    const size_t n = (size_t)motion->n_arms, c = (size_t)capacity, points = rst_points * n * c;
    const size_t panels = c * sizeof(struct sync_panel) / sizeof(double), kernels = rst_stages * points;
    if (rst_make_room(&run->room, &run->room_size, panels + 2 * points + kernels + 2 * rst_stages * n + 1)) return 1;
    run->capacity = capacity;
    run->normal = (struct sync_normal){.eta = motion->eta,
                                       .n_arms = motion->n_arms,
                                       .scale = motion->scale,
                                       .closeness = fmax(rst_least_closeness, rst_closeness * roughness),
                                       .g = motion->arms,
                                       .rate = motion->arms + motion->most_arms,
                                       .panel = (struct sync_panel *)run->room,
                                       .memory = run->room + panels,
                                       .loading = run->room + panels + points,
                                       .kernel = run->room + panels + 2 * points,
                                       .entry = run->room + panels + 2 * points + kernels};
    return 0;
}

/* A sphere that comes back would come back with any lower stop speed, and with a higher one as long
 * as it is faster than that in its rebound and up to its last panel before the turning point
 * (docs/sync.md, section 9). */
static double same_up_to(const struct rst_run *run, double stop_speed)
{
    const struct sync_normal *n = &run->normal;
    const double last = n->panel[n->n_compression - 1].velocity[0];
    const double rebound = -n->panel[n->n_panels - 1].velocity[rst_stages];
    return fmax(stop_speed, fmin(last, rebound));
}

static int is_solved(const struct rst_run *run, double stop_speed)
{
    if (run->found == RST_NOT_SOLVED || run->found == RST_LACKS_ROOM) return 0;
    return run->found == RST_REBOUNDS ? stop_speed <= run->stop_speed : stop_speed == run->stop_speed;
}

/* The run that this one will be compared with. */
static const struct sync_normal *coarser_than(const struct rst_motion *motion, int halvings)
{
    if (halvings == 0) return NULL;
    const struct rst_run *run = &motion->run[halvings - 1];
    return run->found == RST_REBOUNDS || run->found == RST_STOPS ? &run->normal : NULL;
}

const struct rst_run *rst_motion_run(struct rst_motion *motion, int halvings, int64_t most)
{
    struct rst_run *run = &motion->run[halvings];
    if (is_solved(run, motion->stop_speed)) return run;
    const struct sync_normal *coarser = coarser_than(motion, halvings);
    for (int64_t capacity = run->capacity > 0 ? run->capacity : first_capacity(halvings);; capacity *= 2) {
        const int64_t allowed = capacity < most ? capacity : most;
        const struct sync_normal_control control = {.roughness = rst_roughness(halvings),
                                                    .stop_speed = motion->stop_speed,
                                                    .halvings = halvings,
                                                    .capacity = allowed,
                                                    .n_coarse = coarser ? coarser->n_panels : 0,
                                                    .n_coarse_compression = coarser ? coarser->n_compression : 0,
                                                    .coarse = coarser ? coarser->panel : NULL};
        run->found = RST_NOT_SOLVED;
        if (lay_out(motion, run, capacity, control.roughness)) return NULL;
        rst_follow_normal(&control, &run->normal, &run->found);
        if (run->found != RST_LACKS_ROOM || allowed == most) break;
        if (allowed < rst_most_panels) continue;
        run->found = RST_DOES_NOT_CONVERGE;
        break;
    }
    run->stop_speed = motion->stop_speed;
    if (run->found == RST_REBOUNDS) run->stop_speed = same_up_to(run, motion->stop_speed);
    return run;
}

static int lay_out_store(struct rst_motion *motion, int64_t capacity)
{
    const size_t n = (size_t)motion->n_arms, c = (size_t)capacity, points = rst_points * n * c;
    const size_t records = c * sizeof(struct sync_record) / sizeof(double);
    const size_t pieces = c * sizeof(struct sync_piece) / sizeof(double);
    struct sync_store *s = &motion->store;
    if (rst_make_room(&motion->store_room, &motion->store_size,
                      records + pieces + rst_values * points + (rst_stages + 3) * rst_points * n + 1))
        return 1;
    double *next = motion->store_room;
    s->capacity = capacity;
    s->record = (struct sync_record *)next;
    s->piece = (struct sync_piece *)(next += records);
    s->corrective = next += pieces;
    s->room = next + rst_values * points;
    return 0;
}

int rst_motion_reserve(struct rst_motion *motion, int from, int to, int64_t arms)
{
    int fails = make_arms(motion, arms);
    motion->n_arms = arms;
    for (int i = from; i <= to && !fails; i++)
        fails = lay_out(motion, &motion->run[i], first_capacity(i), 1);
    if (!fails) fails = lay_out_store(motion, first_capacity(to) + rst_first_pieces);
    motion->n_arms = -1; /* of no solid */
    return fails;
}

/* Largest force over largest radius: solids of other units have other stresses. */
static double usual_stress(const struct sync_normal *normal)
{
    double force = 0;
    for (int64_t p = 0; p < normal->n_compression; p++)
        force = fmax(force, normal->panel[p].force[rst_stages]);
    return force / normal->panel[normal->n_compression - 1].radius[rst_stages];
}

int rst_motion_contact(struct rst_motion *motion, const struct rst_run *run, const struct rst_problem *problem,
                       int halvings, int64_t most, double *velocity, int64_t *found)
{
    const double scale = fmin(1, problem->shear_speed);
    const double roughness = problem->elements > 0 ? rst_roughness(halvings) : rst_piece_roughness(problem, halvings);
    const double closeness = fmax(rst_least_closeness, rst_piece_closeness * roughness);
    const double swings = sqrt(fmax(1, problem->chi)); /* U' swings so much faster than D', and takes errors with it */
    const struct sync_contact contact = {.chi = problem->chi,
                                         .psi = problem->shear_speed,
                                         .roughness = fmax(rst_least_roughness, roughness * scale / swings),
                                         .noise = rst_noise * rst_roughness(halvings),
                                         .closeness = closeness * scale,
                                         .stress = usual_stress(&run->normal),
                                         .mode = problem->mode};
    motion->store.n_trials = (int64_t)fmin(rst_trials_of_piece * (double)most, 1e18);
    for (int64_t capacity = 2 * run->normal.n_panels + rst_first_pieces;; capacity *= 2) {
        if (lay_out_store(motion, capacity)) return 1;
        if (capacity > most) motion->store.capacity = most;
        rst_follow_contact(&run->normal, &contact, &motion->store, velocity, found);
        if (*found != RST_LACKS_PIECES || capacity >= most || motion->store.n_trials <= 0) return 0;
        if (most < INT64_MAX && rst_time_left(problem) <= 0) return 0; /* a history has no limits */
    }
}
