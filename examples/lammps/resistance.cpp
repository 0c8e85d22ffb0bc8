/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "resistance.h"

#include <algorithm>
#include <cmath>

namespace restitute_dem
{

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = a[j] * b[k] - a[k] * b[j];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A vector that was tangential in the last step, with its length (Luding, eq. 17). */
static void lay_into_plane(const double normal[3], double v[3])
{
    const double along = dot(v, normal), before = std::sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] -= along * normal[i];
    const double after = std::sqrt(dot(v, v));
    for (int i = 0; i < 3 && after > 0; i++)
        v[i] *= before / after;
}

/* The force after a step of n components. Beyond the limit the slider moves until the spring and
 * the dashpot give the limit (Luding, eq. 20). The force keeps its sign then: `twisting` of LAMMPS
 * takes that of the rate, and so jumps by twice the limit when the normal force falls below what
 * the spring holds and the spheres turn back. */
static void respond(const Slider &s, double limit, double step, int n, const double *rate, double *moved, double *force)
{
    double square = 0;
    for (int i = 0; i < n; i++) {
        moved[i] += step * rate[i];
        force[i] = -s.stiffness * moved[i] - s.damping * rate[i];
        square += force[i] * force[i];
    }
    if (square <= limit * limit) return;
    const double shrink = limit / std::sqrt(square);
    for (int i = 0; i < n; i++) {
        force[i] *= shrink;
        if (s.stiffness > 0) moved[i] = -(force[i] + s.damping * rate[i]) / s.stiffness;
    }
}

void Resistance::advance(const Turning &t, double *history) const
{
    const double *n = t.normal, a = t.contact_radius;
    double *couple = history, *rolled = history + 3, *angle = history + 6;
    std::fill_n(couple, 3, 0.0);
    if (rolls) {
        double velocity[3], force[3];
        lay_into_plane(n, rolled);
        cross(t.spin, n, velocity);
        for (double &v : velocity)
            v *= t.radius;
        respond(rolling, rolling.friction * t.normal_force, t.step, 3, velocity, rolled, force);
        cross(n, force, couple);
        for (int i = 0; i < 3; i++)
            couple[i] *= t.radius;
    }
    if (twists) {
        Slider its = twisting;
        if (is_marshall) /* eqs. 32, 33 */
            its = {0.5 * tangential.stiffness * a * a * a, 0.5 * tangential.damping * a * a * a,
                   2.0 / 3 * a * tangential.friction};
        const double rate = dot(t.spin, n);
        double moment;
        respond(its, its.friction * t.normal_force, t.step, 1, &rate, angle, &moment);
        for (int i = 0; i < 3; i++)
            couple[i] += moment * n[i];
    }
}

} // namespace restitute_dem
