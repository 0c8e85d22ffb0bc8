/* What a state tells, and the turn of a state with a normal that jumps.
 * SPDX-License-Identifier: BSD-3-Clause */
#include "base/sized.h"
#include "base/status.h"
#include "contact/law.h"

RST_DEFAULTS(contact_details, 0)

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = a[j] * b[k] - a[k] * b[j];
    }
}

/* Nothing is NULL (`other` is called `name`), and the state is one of this law. */
static int check(const restitute_contact_law *law, const double *state, const void *other, const char *name,
                 restitute_error *error)
{
    if (!law || !state || !other)
        return rst_report(error, RESTITUTE_ERROR_NULL, "%s is NULL", !law ? "law" : !state ? "state" : name);
    return rst_check_state(law, state, error);
}

int restitute_contact_peek(const restitute_contact_law *law, const double normal[3], const double *state,
                           restitute_contact_force *force, restitute_error *error)
{
    int status = check(law, state, force, "force", error);
    if (!status) status = rst_check_unit(normal, "normal", error);
    if (status) return status;
    const double *axis = state + at_axis, x = state[at_force + 1], y = state[at_force + 2];
    double other[3];
    cross(normal, axis, other);
    status = rst_give_force(state[at_force], -(x * axis[0] + y * other[0]), -(x * axis[1] + y * other[1]),
                            -(x * axis[2] + y * other[2]), force, error);
    return status ? status : rst_done(error);
}

/* A tangential vector after the smallest rotation that turns one normal into another. */
int restitute_contact_turn(const restitute_contact_law *law, const double from[3], const double to[3], double *state,
                           restitute_error *error)
{
    int status = check(law, state, law, "law", error);
    if (!status) status = rst_check_unit(from, "from", error);
    if (!status) status = rst_check_unit(to, "to", error);
    if (status) return status;
    double *axis = state + at_axis, about[3], across[3];
    const double cosine = from[0] * to[0] + from[1] * to[1] + from[2] * to[2];
    cross(from, to, about);
    cross(about, axis, across);
    const double along = about[0] * axis[0] + about[1] * axis[1] + about[2] * axis[2];
    for (int i = 0; i < 3 && 1 + cosine > 1e-12; i++) /* opposite: half a turn about the vector itself */
        axis[i] = cosine * axis[i] + across[i] + about[i] * (along / (1 + cosine));
    return rst_done(error);
}

/* int (1/2) p^2 dx by Simpson's rule, p linear in y between elements; a contact that ends between
 * two elements ends at its edge. */
static double squared(const struct rst_law *law, double edge, const double *p)
{
    double integral = 0;
    for (int j = 0; j < law->at.n; j++) {
        const double last = j + 1 < law->at.n ? p[j + 1] : 0, x = law->x[j];
        const double to = edge > x && last == 0 ? fmin(edge, law->x[j + 1]) : law->x[j + 1];
        const double middle = p[j] + (last - p[j]) * (3 * x + to) / (4 * (x + to));
        integral += (to - x) * (p[j] * p[j] + 4 * middle * middle + last * last) / 12;
    }
    return integral;
}

/* int (1/2) (G_inf u^2 + sum g w^2) dx of all directions. */
static double stored_energy(const struct rst_law *law, double radius, const double *state)
{
    const int n = law->at.n, directions = 1 + 2 * law->at.slips;
    const double width = state[at_width], overlap = state[at_overlap], *w = state + at_arrays;
    if (!(width > 0)) return 0;
    const double edge = sqrt(fmax(0, overlap) * radius) / width, *u = state + rst_at_u(law->at);
    double free[rst_most_nodes], energy = 0;
    for (int j = 0; j < n; j++) {
        double held = 0;
        for (int k = 0; k < law->at.terms; k++)
            held += law->g[k] * w[k * n + j];
        free[j] = fmax(overlap - law->y[j] * width * width / radius, -held * law->compliance);
    }
    for (int d = 0; d < directions; d++) {
        double sum = law->g_inf * squared(law, edge, d == 0 && !law->at.surface ? free : u);
        if (d > 0 || law->at.surface) u += n;
        for (int k = 0; k < law->at.terms; k++, w += n)
            sum += law->g[k] * squared(law, edge, w);
        energy += sum * (d > 0 ? law->tangential : law->normal);
    }
    return energy * width;
}

int restitute_contact_details_get(const restitute_contact_law *law, double radius, const double *state,
                                  restitute_contact_details *details, restitute_error *error)
{
    int status = check(law, state, details, "details", error);
    if (!status) status = RST_CHECK(contact_details, details, error);
    if (!status) status = rst_check_range(radius, RST_LEAST_RADIUS, RST_LARGEST_RADIUS, "radius (m)", error);
    if (status) return status;
    if (!law->kernel.at.details) return rst_report(error, RESTITUTE_ERROR_DOMAIN, "law: was made without details");
    const double *kept = state + rst_at_details(law->kernel.at);
    const restitute_contact_details found = {.struct_size = sizeof found,
                                             .contact_radius = kept[5],
                                             .stick_radius = kept[6],
                                             .work = kept[0],
                                             .stored = stored_energy(&law->kernel, radius, state),
                                             .friction = kept[1],
                                             .viscous = kept[2],
                                             .friction_power = kept[3],
                                             .viscous_power = kept[4]};
    RST_GIVE(&found, details);
    return rst_done(error);
}
