/* fix restitute: the contacts of a time step.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#include "fix_restitute.h"

#include "atom.h"
#include "error.h"
#include "fix_contact_history_mesh.h"
#include "fix_mesh_surface.h"
#include "force.h"
#include "pair_gran.h"
#include "tri_mesh.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using restitute_dem::Batch;
using restitute_dem::Body;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Body FixRestitute::sphere(int i) const
{
    return {atom->x[i], atom->v[i], atom->omega[i], atom->radius[i], atom->mask[i] & frozen ? 0 : 1 / atom->rmass[i]};
}

double FixRestitute::density(int i) const
{
    return atom->rmass[i] / (4.1887902047863910 * std::pow(atom->radius[i], 3));
}

/* The force on sphere i of one contact. */
void FixRestitute::compute(const Meeting &met, int offset, double f[3])
{
    const bool moves = met.computeflag && met.shearupdate;
    Law &law = *model(met.itype, met.jtype);
    Batch &b = *law.batch;
    double *history = met.contact_history + offset;
    std::fill_n(f, 3, 0.0);
    if (met.is_wall) {
        if (!meet_wall(met, offset, moves, b)) return;
    } else {
        order(met.i, met.j, history, b, 0);
        if (!meet_sphere(0, 0, moves, b)) return;
    }
    b.n = 1;
    run(law, moves);
    b.n = 0;
    if (met.computeflag) history[states + LAST_STEP] = update->ntimestep;
    if (met.computeflag && met.is_wall) std::copy_n(b.motion[0].normal, 3, history + states + NORMAL);
    for (int k = 0; k < 3; k++)
        f[k] = b.first[0] == met.i ? b.force[0][k] : -b.force[0][k];
}

void FixRestitute::run(Law &law, bool moves) const
{
    const char *problem;
    Batch &b = *law.batch;
    const int bad = moves ? law.advance(b, &problem) : law.repeat(b, &problem);
    if (bad >= 0) stop(b.first[bad], b.second[bad], problem);
}

/* `j`: a sphere, or minus the type of a wall. */
void FixRestitute::stop(int i, int j, const std::string &problem) const
{
    const std::string its = j < 0 ? "a wall of type " + std::to_string(-j) : std::to_string(atom->tag[j]);
    const std::string text = "restitute: sphere " + std::to_string(atom->tag[i]) + " and " + its + " at step " +
                             std::to_string(update->ntimestep) + ": " + problem;
    fprintf(stderr, "ERROR: %s\n", text.c_str()); /* what LIGGGHTS prints is lost when it aborts */
    error->one(FLERR, text.c_str());
}

/* ---- spheres */

/* Body 1 is the sphere with the smaller tag: in every list, on every process. */
void FixRestitute::order(int i, int j, double *history, Batch &b, int k) const
{
    const bool ordered = atom->tag[i] < atom->tag[j];
    b.first[k] = ordered ? i : j;
    b.second[k] = ordered ? j : i;
    b.history[k] = history;
}

/* The n-th motion of a batch from its k-th contact, k >= n. False: they are apart. LIGGGHTS does
 * not report when two spheres separate, and keeps the history while they are neighbors. The stored
 * step shows it. */
bool FixRestitute::meet_sphere(int k, int n, bool moves, Batch &b) const
{
    const int i = b.first[k], j = b.second[k];
    double *history = b.history[k];
    if (!touching(sphere(i), sphere(j), b, n)) return false;
    if (moves && history[states + LAST_STEP] != update->ntimestep - 1) std::fill_n(history, states, 0.0);
    b.first[n] = i, b.second[n] = j;
    b.history[n] = history;
    b.label[n] = 1;
    b.density[n] = history[0] == 0 ? std::max(density(i), density(j)) : 0;
    b.on_record[n] = i < atom->nlocal; /* the owner of the other one computes the contact, too */
    return true;
}

/* ---- spheres, many at once */

/* May forces wait for the end of a pass? Then LIGGGHTS finds none of a pair when it asks for it.
 * Rolling friction and cohesion need them in the same call, and so do fixes and computes that store
 * forces of contacts. `compute pair/gran/local` does not: it has a pass of its own. */
bool FixRestitute::begin_pass(PairGran *pair)
{
    host = pair;
    std::fill_n(tangential, 3, 0.0);
    return pair->computeflag() && pair->shearupdate() && pair->contact_match("rolling_friction", "off") &&
           pair->contact_match("cohesion", "off") && !pair->storeContactForces() && !pair->storeContactForcesStress() &&
           !pair->store_sum_normal_force();
}

static void prefetch(const double *place)
{
#ifdef __GNUC__
    __builtin_prefetch(place, 1);
#else
    (void)place;
#endif
}

void FixRestitute::collect(const Meeting &met, int offset)
{
    Law &law = *model(met.itype, met.jtype);
    Batch &b = *law.batch;
    double *history = met.contact_history + offset;
    for (int k = 0; k < states + NUMBERS_OF_PAIRS; k += 8)
        prefetch(history + k);
    order(met.i, met.j, history, b, b.n);
    if (++b.n == Batch::SIZE) compute_batch(law);
}

void FixRestitute::end_pass()
{
    for (const Model &its : models)
        compute_batch(*its);
}

void FixRestitute::compute_batch(Law &law)
{
    Batch &b = *law.batch;
    int n = 0;
    for (int k = 0; k < b.n; k++)
        n += meet_sphere(k, n, true, b);
    b.n = n;
    run(law, true);
    for (int k = 0; k < n; k++) {
        b.history[k][states + LAST_STEP] = update->ntimestep;
        apply(b, k);
    }
    b.n = 0;
}

static void add_to(double *force, double *torque, double sign, const double *f, double arm, const double *turn)
{
    for (int k = 0; k < 3; k++) {
        force[k] += sign * f[k];
        torque[k] += arm * turn[k];
    }
}

/* As LIGGGHTS does after each contact, see Granular::compute_force in its pair_gran_base.h. */
void FixRestitute::apply(const Batch &b, int k) const
{
    const int i = b.first[k], j = b.second[k], all = force->newton_pair;
    const double *n = b.motion[k].normal, *f = b.force[k], *x = atom->x[i], *y = atom->x[j];
    const double turn[3] = {n[1] * f[2] - n[2] * f[1], n[2] * f[0] - n[0] * f[2], n[0] * f[1] - n[1] * f[0]};
    const double relax_i = host->relax(i), relax_j = host->relax(j);
    if (all || i < atom->nlocal) add_to(atom->f[i], atom->torque[i], relax_i, f, relax_i * b.arm1[k], turn);
    if (all || j < atom->nlocal) add_to(atom->f[j], atom->torque[j], -relax_j, f, relax_j * b.arm2[k], turn);
    if (host->evflag)
        host->ev_tally_xyz(i, j, atom->nlocal, all, 0, 0, f[0], f[1], f[2], x[0] - y[0], x[1] - y[1], x[2] - y[2]);
}

/* ---- walls */

/* Is the point of contact the nearest of the mesh around it, not only of its triangle? LIGGGHTS
 * computes a second contact with a convex edge. It is not a separate one: its point is on the first
 * triangle, too. */
static bool is_nearest(const FixRestitute::Meeting &met, double *center, const restitute_contact_motion &now)
{
    TriMesh *mesh = met.mesh;
    double face[3], point[3], unused[3], bary[3];
    int sign;
    mesh->surfaceNorm(met.j, face);
    if (std::fabs(dot(face, now.normal)) > 1 - 1e-12) return true; /* not on an edge */
    for (int k = 0; k < 3; k++)
        point[k] = center[k] + (met.radi - now.overlap) * now.normal[k];
    const double rounding = 1e-12 * met.radi;
    for (int k = 0; k < mesh->nNeighs(met.j); k++) {
        const int other = mesh->map(mesh->neighFaces(met.j, k), 0);
        const auto distance = [&](double *from) {
            return mesh->resolveTriSphereContactBary(met.i, other, 0, from, unused, bary, sign, false);
        };
        if (other >= 0 && distance(point) < rounding && distance(center) < met.radi - now.overlap - rounding)
            return false;
    }
    return true;
}

/* The first motion of a batch; body 1 is the sphere. False: they are apart, or another triangle of
 * the mesh has the contact. */
bool FixRestitute::meet_wall(const Meeting &met, int offset, bool moves, Batch &b) const
{
    static const double still[3] = {};
    double point[3], *x = atom->x[met.i], *history = met.contact_history + offset;
    restitute_contact_motion &now = b.motion[0];
    for (int k = 0; k < 3; k++)
        point[k] = x[k] - met.delta[k];
    if (!touching(sphere(met.i), {point, met.v_j, still, 0, 0}, b, 0)) return false;
    if (met.mesh && !is_nearest(met, x, now)) return false;
    b.first[0] = met.i, b.second[0] = -met.jtype;
    b.history[0] = history;
    b.label[0] = 1;
    b.on_record[0] = true;
    if (!moves) return true;
    if (history[states + LAST_STEP] != update->ntimestep - 1) std::fill_n(history, states, 0.0);
    if (met.mesh && !follow_mesh(met, now, offset, history)) return false;
    const double *before = history + states + NORMAL;
    /* 2.6 degrees; the law itself follows smaller turns */
    if (history[0] != 0 && dot(before, now.normal) < 0.999)
        if (const char *problem = model(met.itype, met.jtype)->turn(before, now.normal, history))
            stop(met.i, -met.jtype, problem);
    b.density[0] = history[0] == 0 ? density(met.i) : 0;
    return true;
}

/* Several triangles of a mesh at one sphere:
 * - On an edge both triangles may claim the sphere, with one normal. The first takes the contact.
 * - When a sphere slides over an edge, its memory is that of the triangle that it leaves. A contact
 *   that begins with a deeper overlap than one step can give takes this memory: that of the contact
 *   of the last step with the nearest normal. Between triangles of one plane LIGGGHTS itself passes it.
 * Returns false if another triangle has the contact. */
bool FixRestitute::follow_mesh(const Meeting &met, const restitute_contact_motion &now, int offset,
                               double *history) const
{
    FixContactHistoryMesh *contacts = met.fix_mesh->contactHistory();
    const double in_a_step = update->dt * std::max(0.0, dot(now.velocity, now.normal));
    const bool begins_deep = history[0] == 0 && now.overlap > 2 * in_a_step;
    double nearest = 0.5; /* 60 degrees */
    for (int k = 0; k < contacts->nneighs(met.i); k++) {
        const double *other = contacts->contacthistory(met.i, k) + offset;
        if (contacts->partner(met.i, k) < 0 || other == history || other[0] == 0) continue;
        const double along = dot(other + states + NORMAL, now.normal), last = other[states + LAST_STEP];
        if (last == update->ntimestep && along > 1 - 1e-10) {
            std::fill_n(history, states, 0.0);
            return false;
        }
        if (!begins_deep || last != update->ntimestep - 1 || along < nearest) continue;
        nearest = along;
        std::copy_n(other, states + NUMBERS_OF_WALLS, history);
    }
    return true;
}
