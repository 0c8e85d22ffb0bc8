/* Slip as a corrective contact, as the method `sync` has it (docs/sync.md): the front, and the
 * motion behind it.
 * SPDX-License-Identifier: BSD-3-Clause */
#include <string.h>

#include "../support/data.h"
#include "../support/sync_probe.h"

/* ---- front */

/* Cattaneo and Mindlin, oblique loading: D' = 1 and U' = beta < 1 up to D1, while all elements
 * stick; then D is constant and U increases to U1. With q = U1 - beta X^2 in stick c^2 = (D1 -
 * U1)/(1 - beta) and H = (2/3)(1 - beta) c^3. */
static void front_of_cattaneo_and_mindlin(void **state)
{
    (void)state;
    const double g = 1, rate = 0, d1 = 0.7;
    for (double beta = -0.4; beta < 0.9; beta += 0.4)
        for (int side = -1; side <= 1; side += 2)
            for (double load = 0.05; load < 1; load += 0.2) {
                /* d U1 goes from d beta d1, where all sticks, to d1, where all slips */
                const double b = side * beta, u1 = side * (b * d1 + load * (d1 - b * d1)), m[2] = {d1, u1};
                double out[4], c = sqrt((d1 - side * u1) / (1 - b));
                probe_front(1, &g, &rate, 0, beta, d1, d1, m, -1, side, out);
                /* the search ends where the stick margin is 1e-4, and continues linearly: the
                 * relative error of c is then about 1e-8, that of H at most 1e-12; the last Newton
                 * step is better than needed */
                CHECK_NEAR(out[0], c, 0.6e-7 * c, "c, beta = %g, side %d, load %g", beta, side, load);
                CHECK_NEAR(out[1], 2.0 / 3 * (1 - b) * c * c * c, 1e-14, "H, beta = %g, side %d, load %g", beta, side,
                           load);
                CHECK_NEAR(out[2], d1 - side * u1, 1e-15, "slack at the centre");
                CHECK(out[3] < 0, "no slack at the edge");
            }
    const double slack[2] = {d1, 0.1 * d1}, none[2] = {d1, 1.01 * d1};
    double out[4];
    probe_front(1, &g, &rate, 0, 0.3, d1, d1, slack, -1, 1,
                out); /* (y = D1 - U1 - (1 - beta) X^2 > 0 up to the edge) */
    CHECK_NEAR(out[0], sqrt(d1), 1e-15, "slack everywhere: the front is at the edge");
    CHECK_NEAR(out[1], 2.0 / 3 * 0.7 * pow(d1, 1.5) + sqrt(d1) * 0.2 * d1, 1e-14, "slack force of all of the contact");
    probe_front(1, &g, &rate, 0, 0.3, d1, d1, none, -1, 1, out);
    CHECK(out[0] == 0 && out[1] == 0, "slack nowhere");
}

/* int_0^dt exp(-rate (dt - t)) dt */
static double faded(double rate, double dt)
{
    return rate > 0 ? -expm1(-rate * dt) / rate : dt;
}

/* A solid with a spring, two arms and a dashpot, loaded at D' = 1 and U' = beta, then held in z and
 * driven in x with U' = w: the front against the slack of 20000 elements, each with its own
 * history. */
static void front_of_a_viscoelastic_solid_is_that_of_its_elements(void **state)
{
    (void)state;
    const double g[3] = {1, 0.8, 2}, rate[3] = {0, 1.5, 0.4}, eta = 0.03, beta = 0.2, loaded = 0.9;
    for (int side = -1; side <= 1; side += 2)
        for (double later = 0.1; later < 0.5; later += 0.1) {
            const double w = side * 1.2, r = -side * w, time = loaded + later;
            double m[6], out[4], sum = 0, c = 0;
            for (int k = 0; k < 3; k++) {
                double left = rate[k] > 0 ? exp(-rate[k] * later) : 1;
                m[k] = g[k] * left * faded(rate[k], loaded);
                m[3 + k] = beta * m[k] + g[k] * w * faded(rate[k], later);
            }
            probe_front(3, g, rate, eta, beta, loaded, time, m, r, side, out);
            const int n = 20000;
            const double dx = sqrt(loaded) / n;
            for (int i = 0; i < n; i++) {
                double x = (i + 0.5) * dx, y = eta * r;
                for (int k = 0; k < 3; k++) {
                    double left = rate[k] > 0 ? exp(-rate[k] * later) : 1;
                    y += g[k] *
                         ((1 - side * beta) * left * faded(rate[k], loaded - x * x) - side * w * faded(rate[k], later));
                }
                if (y <= 0) break;
                sum += y * dx;
                c = x + 0.5 * dx;
            }
            CHECK(c > 0.1 && c < 0.9, "partial slip: c = %g", c);
            /* elements are dx = 5e-5 wide: c to that, H to slope dx^2 = 1e-8; polynomials of a
             * record miss 1e-9 */
            CHECK_NEAR(out[0], c, dx, "stick radius, side %d, %g later", side, later);
            CHECK_NEAR(out[1], sum, 2e-8, "slack force, side %d, %g later", side, later);
        }
}

/* ---- tangential motion */

/* e_x of the recorded impacts that do not slip to the end; rows where elements stick again are not
 * for the front. */
static void recorded_tangential_motions_are_met(void **state)
{
    (void)state;
    struct truth rows[truth_rows];
    int partial = 0, solved = 0;
    read_truth(rows);
    for (int i = 0; i < truth_rows; i++) {
        const struct solid s = solid_of(rows[i].delta1, rows[i].gamma);
        const double critical = 2 * rows[i].chi > 1 ? 2 * rows[i].chi * (1 + rows[i].ez) - rows[i].ez : 1;
        int64_t counts[2], n_pieces;
        double velocity;
        if (rows[i].psi >= critical) continue;
        partial++;
        assert_int_equal(probe_normal(s.eta, s.n, s.g, s.rate, rows[i].max_indentation, 3, 1e-6, counts), 0);
        if (probe_contact(rows[i].chi, rows[i].psi, 1e-6 * fmin(1, rows[i].psi), &velocity, &n_pieces) != 0) continue;
        solved++;
        /* polynomials that miss 1e-6 of U' on some piece, and what the row itself may be wrong
         * by */
        CHECK_NEAR(-velocity / rows[i].psi, rows[i].ex, 2e-6 + rows[i].err_ex, "row %d", i);
    }
    /* that of chi = 3.127 */
    CHECK(solved == partial - 1, "%d of %d rows solved by a front", solved, partial);
}

/* A foundation of elements with prescribed velocities, and one arm parallel to the spring. */
enum { elements = 600, substeps = 40 };

struct foundation {
    double g[2], rate[2], y[2][2][elements]; /* stress of arm k in z and x */
    double x2[elements], dx;
};

/* One step of the length h with velocities that are linear in it; the sphere is at the depths d0
 * and d1. The force in x, and in *stuck the length of what sticks. */
static double drive(struct foundation *f, double h, double d0, double d1, const double v0[2], const double v1[2],
                    double *stuck)
{
    double total = 0;
    *stuck = 0;
    for (int j = 0; j < elements; j++) {
        if (f->x2[j] >= fmax(d0, d1) && d1 >= d0) break;
        /* an element that is reached within the step has moved since then */
        const double part = f->x2[j] > d0 && d1 > d0 ? (d1 - f->x2[j]) / (d1 - d0) : 1, t = part * h;
        double force[2] = {0, 0}, gain = 0;
        for (int k = 0; k < 2; k++) {
            const double fade = exp(-f->rate[k] * t), a = faded(f->rate[k], t) / t;
            gain += f->g[k] * a;
            for (int i = 0; i < 2; i++) {
                const double mean = v1[i] - 0.5 * part * (v1[i] - v0[i]);
                f->y[k][i][j] = fade * f->y[k][i][j] + f->g[k] * a * t * mean;
                force[i] += f->y[k][i][j];
            }
        }
        if (force[0] <= 0 && d1 < d0) { /* left: it would have to pull; the arms behind it do not matter any more */
            for (int k = 0; k < 2; k++)
                f->y[k][0][j] = f->y[k][1][j] = -1e30 * (k == 0);
            continue;
        }
        const double excess = force[1] - fmax(-force[0], fmin(force[0], force[1]));
        for (int k = 0; k < 2; k++) /* slip takes the excess off, arm by arm as the step answers */
            f->y[k][1][j] -= excess * f->g[k] * (faded(f->rate[k], t) / t) / gain;
        total += (force[1] - excess) * f->dx;
        if (!(fabs(excess) > 0)) *stuck += f->dx;
    }
    return total;
}

/* S and the stick radius behind the front, compared with elements without a front. These have the
 * computed D' and U', and each slips when its trial force exceeds its friction limit. */
static void front_is_that_of_a_foundation(void **state)
{
    (void)state;
    const struct solid s = solid_of(0.8, 1.5);
    static struct foundation f;
    int64_t counts[2], n_pieces, panel, rooted;
    double velocity, range[2], before[6], now[6], old[3], new[3], stuck = 0, worst_s = 0, worst_c = 0, force = 0;
    int compared = 0;
    assert_int_equal(normal(s, 0.84, 4, counts), 0);
    assert_int_equal(probe_contact(7.0 / 6, 0.6, 1e-4, &velocity, &n_pieces), 0);
    f = (struct foundation){.g = {s.g[0], s.g[1]}, .rate = {s.rate[0], s.rate[1]}};
    probe_motion(counts[0], 1, now);
    f.dx = now[RADIUS] / elements;
    for (int j = 0; j < elements; j++)
        f.x2[j] = pow((j + 0.5) * f.dx, 2);
    probe_motion(1, 0, before);
    for (int64_t i = 1; i <= n_pieces; i++) {
        probe_piece(i, 0, &panel, range, &rooted, old);
        for (int n = 1; n <= substeps; n++) {
            const double y = (double)n / substeps, left = rooted ? (1 - y) * (1 - y) : 1 - y;
            probe_piece(i, y, &panel, range, &rooted, new);
            probe_motion(panel, range[1] - (range[1] - range[0]) * left, now);
            force = drive(&f, now[TIME] - before[TIME], before[DEPTH], now[DEPTH], (double[]){before[VELOCITY], old[0]},
                          (double[]){now[VELOCITY], new[0]}, &stuck);
            memcpy(before, now, sizeof now);
            memcpy(old, new, sizeof new);
        }
        worst_s = fmax(worst_s, fabs(force - new[1]));
        worst_c = fmax(worst_c, fabs(stuck - new[2]));
        compared += new[2] > 0.05 && new[2] < 0.95 * now[RADIUS];
    }
    CHECK(compared > 5, "%d pieces end with a front within the contact", compared);
    /* elements are 1.5e-3 wide, so that the rim, where f falls to 0, counts for slope*dx^2 = 5e-6,
     * and so do those that change from stick to slip; the steps count for as much */
    CHECK(worst_s < 1e-5, "S off by %g", worst_s);
    CHECK(worst_c < f.dx, "stick radius off by %g, elements are %g wide", worst_c, f.dx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(front_of_cattaneo_and_mindlin),
        cmocka_unit_test(front_of_a_viscoelastic_solid_is_that_of_its_elements),
        cmocka_unit_test(recorded_tangential_motions_are_met),
        cmocka_unit_test(front_is_that_of_a_foundation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
