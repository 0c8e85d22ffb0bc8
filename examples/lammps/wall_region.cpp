/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "wall_region.h"

#include "domain.h"
#include "error.h"
#include "lammps.h"
#include "modify.h"
#include "region.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

/* The axis of a region that rotates is a protected member. */
struct RegionAxis : Region {
    static const double *direction(const Region &region)
    {
        return region.*(&RegionAxis::runit);
    }
    static const double *origin(const Region &region)
    {
        return region.*(&RegionAxis::point);
    }
};

static bool is_composite(const Region *region)
{
    return !strcmp(region->style, "union") || !strcmp(region->style, "intersect");
}

RegionWall::RegionWall(LAMMPS *lmp, const char *name) : lmp(lmp), name(name)
{
    init();
}

/* A script may define the region anew between runs. */
void RegionWall::init()
{
    region = lmp->domain->get_region_by_id(name);
    if (!region) lmp->error->all(FLERR, "fix wall/restitute: region {} does not exist", name);
    parts.clear();
    all_faces = 0;
    add_parts(region);
}

void RegionWall::add_parts(Region *region)
{
    if (is_composite(region)) {
        for (int k = 0; k < region->nregion; k++)
            add_parts(region->reglist[k]);
        return;
    }
    const auto same = [&](const Part &part) { return part.region == region; };
    if (std::any_of(parts.begin(), parts.end(), same)) return;
    if (region->varshape && strcmp(region->style, "sphere") && strcmp(region->style, "cylinder"))
        lmp->error->all(FLERR,
                        "fix wall/restitute: region {}: LAMMPS has no velocity of the surface of a {} with variable "
                        "dimensions; move it with the words move and rotate of the region",
                        region->id, region->style);
    parts.push_back({region, 1 + all_faces, {}, {}});
    all_faces += region->cmax;
}

/* ---- a time step */

/* Variables of the region may depend on computes. */
void RegionWall::place(double, double dt)
{
    const auto moves = [](const Part &part) { return part.region->dynamic_check(); };
    step = dt;
    if (std::none_of(parts.begin(), parts.end(), moves)) return;
    lmp->modify->clearstep_compute();
    for (Part &part : parts) {
        Region &its = *part.region;
        its.prematch();
        if (its.varshape) its.set_velocity();
        const double *origin = RegionAxis::origin(its), moved[] = {its.dx, its.dy, its.dz};
        std::copy_n(part.now, 4, part.before);
        for (int k = 0; k < 3; k++)
            part.now[k] = its.varshape ? its.xcenter[k] : its.rotateflag ? origin[k] + moved[k] : moved[k];
        part.now[3] = its.rotateflag ? its.theta : 0;
    }
    lmp->modify->addstep_compute(lmp->update->ntimestep + 1);
}

/* Is a place in the region, or in its complement (`flip`)? LAMMPS's Region::match() moves a
 * union with the motion of one of its parts. */
static bool contains(Region *region, bool flip, const double *x)
{
    if (!is_composite(region)) return region->openflag || (region->match(x[0], x[1], x[2]) != 0) != flip;
    const auto has = [&](Region *part) { return contains(part, false, x); };
    Region **first = region->reglist, **last = first + region->nregion;
    const bool inside = *region->style == 'u' ? std::any_of(first, last, has) : std::all_of(first, last, has);
    return (inside == (region->interior != 0)) != flip;
}

void RegionWall::touch(const double *x, double distance, std::vector<WallPoint> &points)
{
    const size_t before = points.size();
    collect(region, false, x, distance, points);
    if (points.size() > before && !contains(region, false, x)) points.resize(before);
}

/* LAMMPS looks between an ellipsoid and one whose axes are shorter or longer by as much as it is
 * told to look. Where they are oblique to the surface that is less far: by a fifth for axes of 1 to
 * 4. */
static double reach(const Region *region, double distance)
{
    return strcmp(region->style, "ellipsoid") ? distance : 2 * distance;
}

/* The surface of a union is that of its parts, as far as no other part covers it. That of an
 * intersection is as far as all other parts contain it. A region seen from outside is its
 * complement: the union becomes an intersection of complements. */
void RegionWall::collect(Region *region, bool flip, const double *x, double distance, std::vector<WallPoint> &points)
{
    if (!is_composite(region)) {
        const auto same = [&](const Part &part) { return part.region == region; };
        const Part &part = *std::find_if(parts.begin(), parts.end(), same);
        region->interior ^= (int)flip;
        const int n = region->surface(x[0], x[1], x[2], reach(region, distance));
        region->interior ^= (int)flip;
        for (int k = 0; k < n; k++)
            if (region->contact[k].r < distance) add_point(part, k, x, distance, points);
        return;
    }
    const bool inside = (region->interior != 0) != flip, joins = (*region->style == 'u') == inside;
    for (int k = 0; k < region->nregion; k++) {
        const size_t start = points.size();
        collect(region->reglist[k], !inside, x, distance, points);
        const auto hidden = [&](const WallPoint &point) {
            for (int l = 0; l < region->nregion; l++) {
                Region *other = region->reglist[l];
                if (l == k || (joins && other->openflag)) continue;
                if (contains(other, !inside, point.position) == joins) return true;
            }
            return false;
        };
        points.erase(std::remove_if(points.begin() + start, points.end(), hidden), points.end());
    }
}

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* LAMMPS's radius is that of the mean curvature of a sphere and of a cylinder, for which it is
 * twice its radius, and 0 for flat faces. For an ellipsoid it is not set. For a cone it does not
 * depend on its angle, and has the wrong sign outside: both count as flat. */
static double curvature(const Region &region, const Region::Contact &contact)
{
    const bool is_known = !strcmp(region.style, "sphere") || !strcmp(region.style, "cylinder");
    return is_known && contact.radius != 0 ? 1 / contact.radius : 0;
}

void RegionWall::add_point(const Part &part, int n, const double *x, double distance,
                           std::vector<WallPoint> &points) const
{
    const Region::Contact &c = part.region->contact[n];
    const double to_middle = c.r > 0 ? 0.5 * (distance - c.r) / c.r : 0, away[] = {c.delx, c.dely, c.delz};
    double middle[3]; /* half-way through the overlap, where the force acts */
    WallPoint point = {};
    point.label = part.first_label + c.iwall;
    point.curvature = curvature(*part.region, c);
    for (int k = 0; k < 3; k++) {
        point.position[k] = x[k] - away[k];
        middle[k] = point.position[k] - to_middle * away[k];
    }
    if (part.region->dynamic_check()) set_velocity(part, n, middle, point);
    points.push_back(point);
}

/* Mean over the step of the velocity of the material that is now in the middle of the contact.
 * LAMMPS's Region::velocity_contact() has the velocity at the end of a step, not of parts of a
 * union, and for an axis that is no unit vector a wrong one. */
void RegionWall::set_velocity(const Part &part, int n, const double *middle, WallPoint &point) const
{
    Region &its = *part.region;
    double arm[3], turn[3], *v = point.velocity, *spin = point.spin;
    for (int k = 0; k < 3; k++) {
        v[k] = (part.now[k] - part.before[k]) / step;
        arm[k] = middle[k] - part.now[k];
        if (its.rotateflag) spin[k] = RegionAxis::direction(its)[k] * (part.now[3] - part.before[3]) / step;
    }
    cross(spin, arm, turn);
    for (int k = 0; k < 3; k++)
        v[k] += turn[k];
    cross(spin, turn, arm);
    for (int k = 0; k < 3; k++)
        v[k] -= 0.5 * step * arm[k];
    if (its.varshape && its.contact[n].varflag) its.velocity_contact_shape(v, point.position);
}
