/* The curves of docs/figures/sync-panels.svg: one impact as the method `sync` sees it, in the plane
 * of time and radius.
 *
 *     sync_panels curves   s, A, c a line; empty lines between pieces
 *     sync_panels points   s, A of the points of the panels and, third, 1 at an end of a panel
 *     sync_panels angles   s, A where a panel of the compression ends, and where the edge is back there; empty lines between
 *
 * SPDX-License-Identifier: BSD-3-Clause */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/kernels.h"
#include "sync/kernels.h"

enum { arms = 2, room = 64, samples = 24 };

/* gross slip until the contact sticks, stick, slip from the edge, gross slip */
static const double chi = 7.0 / 6, psi = 1.4, delta1 = 0.8, gamma_ = 1.5;

static struct sync_panel panel[room];
static struct sync_record record[room];
static struct sync_piece piece[room];
static double memory[rst_points * arms * room], loading[rst_points * arms * room],
    corrective[rst_values * rst_points * arms * room];
static double kernel[rst_stages * rst_points * arms * room], entry[2 * rst_stages * arms],
    room_of_piece[(rst_stages + 3) * rst_points * arms];

static double at(double x, const double y[rst_points])
{
    double weight[rst_points];
    rst_sync_weights_at(x, weight);
    return rst_value_of(weight, y);
}

static void print_curves(const struct sync_store *store)
{
    const double start = panel[piece[0].panel - 1].from +
                         piece[0].from * (panel[piece[0].panel - 1].to - panel[piece[0].panel - 1].from);
    for (int64_t p = 0; p < piece[0].panel; p++) /* gross slip */
        for (int i = 0; i <= samples; i++) {
            double x = fmin(1, (start - panel[p].from) / (panel[p].to - panel[p].from)) * i / samples;
            printf("%.6g %.6g 0\n", at(x, panel[p].time), at(x, panel[p].radius));
        }
    for (int64_t p = 0; p < store->n_pieces; p++) {
        const struct sync_piece *on = &piece[p];
        for (int i = 0; i <= samples; i++) {
            double y = (double)i / samples, left = on->rooted ? (1 - y) * (1 - y) : 1 - y;
            double x = on->to - (on->to - on->from) * left;
            const struct sync_panel *of = &panel[on->panel - 1];
            printf("%.6g %.6g %.6g\n", at(x, of->time), at(x, of->radius), fmax(0, at(y, on->stick_radius)));
        }
    }
}

static void print_points(const struct sync_normal *normal)
{
    for (int64_t p = 0; p < normal->n_panels; p++)
        for (int i = 0; i < rst_points; i++)
            printf("%.6g %.6g %d\n", panel[p].time[i], panel[p].radius[i], i == rst_stages);
}

static void print_angles(const struct sync_normal *normal)
{
    for (int64_t p = 0; p < normal->n_compression; p++)
        for (int64_t q = normal->n_compression; q < normal->n_panels; q++)
            if (fabs(panel[q].from - panel[p].to) < 1e-12)
                printf("%.6g %.6g\n%.6g %.6g\n\n", panel[p].time[rst_stages], panel[p].radius[rst_stages],
                       panel[q].time[0], panel[q].radius[0]);
}

int main(int argc, char **argv)
{
    const double theta = sqrt(32.0 / 15) * delta1;
    double g[arms] = {1, 1 / gamma_}, rate[arms] = {0, 1 / (gamma_ * theta)}, velocity;
    int64_t found;
    const struct sync_normal_control control = {/* four panels a phase, none of them halved */
                                                .roughness = 1e30,
                                                .stop_speed = 1e-9,
                                                .halvings = 2,
                                                .capacity = room};
    const struct sync_contact contact = {.chi = chi, .psi = psi, .roughness = 1e-3, .noise = 1e-8,
                                         .closeness = 1e-12, .stress = 1, .mode = RST_GROSS_SLIP};
    struct sync_normal normal = {.n_arms = arms,
                                 .scale = sqrt(0.4 * 0.84), /* about r of the largest indentation */
                                 .closeness = 1e-12,
                                 .g = g,
                                 .rate = rate,
                                 .panel = panel,
                                 .memory = memory,
                                 .loading = loading,
                                 .kernel = kernel,
                                 .entry = entry};
    struct sync_store store = {
        .capacity = room, .record = record, .piece = piece, .corrective = corrective, .room = room_of_piece};
    rst_follow_normal(&control, &normal, &found);
    if (found != RST_REBOUNDS) return 1;
    rst_follow_contact(&normal, &contact, &store, &velocity, &found);
    if (found != RST_SOLVED) return 1;
    if (argc == 2 && strcmp(argv[1], "curves") == 0)
        print_curves(&store);
    else if (argc == 2 && strcmp(argv[1], "points") == 0)
        print_points(&normal);
    else if (argc == 2 && strcmp(argv[1], "angles") == 0)
        print_angles(&normal);
    else
        return 2;
    return 0;
}
