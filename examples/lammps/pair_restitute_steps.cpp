/* The time steps of pair_style restitute, and what it reports of contacts.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#include "pair_restitute.h"

#include "host.h"
#include "lammps_declarations.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using restitute_dem::Batch;
using restitute_dem::ContactModel;
using restitute_dem::Record;

/* Of the model of two types. */
int PairRestitute::number(int i, int j)
{
    return (int)(std::find(models.begin(), models.end(), model(i, j)) - models.begin());
}

static void prefetch(const double *place)
{
#ifdef __GNUC__
    __builtin_prefetch(place, 1);
#else
    (void)place;
#endif
}

void PairRestitute::compute(int eflag, int vflag)
{
    double **x = atom->x, *radius = atom->radius;
    ev_init(eflag, vflag);
    histories->restart_global = 1;
    beyond_contact = has_details; /* the fix keeps contacts that end when lists are made, for end_contact() */
    const double change = change_of_box();
    const bool several = models.size() > 1;
    for (const Model &its : models)
        its->drift = change;
    for (int ii = 0; ii < list->inum; ii++) {
        const int i = list->ilist[ii], *neighbors = list->firstneigh[i];
        int *touched = histories->firstflag[i];
        double *history = histories->firstvalue[i];
        check_radius(i);
        for (int jj = 0; jj < list->numneigh[i]; jj++, history += history_size) {
            const int j = neighbors[jj] & NEIGHMASK;
            const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
            const double sum = radius[i] + radius[j];
            if (dx * dx + dy * dy + dz * dz < sum * sum) {
                touched[jj] = 1;
                const int its = several ? number(atom->type[i], atom->type[j]) : 0;
                collect(*models[its], *batches[its], i, j, history);
            } else if (touched[jj]) {
                touched[jj] = 0;
                end_contact(i, j, history);
            }
        }
    }
    for (size_t k = 0; k < models.size(); k++)
        compute_batch(*models[k], *batches[k]);
    report_values();
    warn(lmp, record(), warned);
}

/* Largest change of a side or a tilt since the last step. Periodic images and the spheres that
 * `fix deform` maps move by as much, without velocities. With `remap v` they have them. Sides that
 * LAMMPS wraps around the spheres move no sphere. */
double PairRestitute::change_of_box()
{
    std::vector<double> now = {domain->prd[0], domain->prd[1], domain->prd[2], domain->xy, domain->xz, domain->yz};
    double change = 0;
    for (int k = 0; k < 3; k++)
        if (std::max(domain->boundary[k][0], domain->boundary[k][1]) >= 2) now[k] = 0;
    for (size_t k = 0; k < box.size(); k++)
        change = std::max(change, std::fabs(now[k] - box[k]));
    box = now;
    return domain->deform_vremap ? 0 : change;
}

/* LAMMPS may not find the contacts of a larger sphere. */
void PairRestitute::check_radius(int i)
{
    const double largest = largest_radius[atom->type[i]];
    if (atom->radius[i] > largest)
        error->one(
            FLERR,
            "restitute: atom {} at step {}: radius {:.6g}: must be at most {:.6g}, the largest of type {} when the "
            "run began, plus half of the skin under fix adapt. Begin a new run when radii have grown, or take a "
            "larger skin",
            atom->tag[i], update->ntimestep, atom->radius[i], largest, atom->type[i]);
}

/* The atom with the smaller tag is body 1: in every list, on every process. */
void PairRestitute::collect(ContactModel &its, Batch &b, int i, int j, double *history)
{
    const bool ordered = atom->tag[i] < atom->tag[j];
    b.first[b.n] = ordered ? i : j;
    b.second[b.n] = ordered ? j : i;
    b.history[b.n] = history;
    for (int k = 0; k < history_size; k += 8)
        prefetch(history + k);
    if (++b.n == Batch::SIZE) compute_batch(its, b);
}

/* Without newton the owner of the other sphere computes a contact, too. Then it counts where the
 * sphere with the smaller tag is. */
bool PairRestitute::is_counted(int i, int j) const
{
    if (force->newton_pair || std::max(i, j) < atom->nlocal) return true;
    return (atom->tag[i] < atom->tag[j] ? i : j) < atom->nlocal;
}

void PairRestitute::compute_batch(ContactModel &its, Batch &b)
{
    const Spheres spheres(atom, frozen);
    const char *problem;
    int n = 0;
    for (int k = 0; k < b.n; k++) {
        const int i = b.first[k], j = b.second[k];
        if (!touching(spheres.body(i), spheres.body(j), b, n)) continue;
        b.first[n] = i, b.second[n] = j;
        b.history[n] = b.history[k];
        b.label[n] = (double)atom->tag[i] + atom->tag[j];
        b.density[n] = b.history[k][0] == 0 ? std::max(spheres.density(i), spheres.density(j)) : 0;
        b.on_record[n++] = is_counted(i, j);
    }
    b.n = n;
    const int bad = update->setupflag ? its.repeat(b, &problem) : its.advance(b, &problem);
    if (bad >= 0)
        error->one(FLERR, "restitute: atoms {} and {} at step {}: {}", atom->tag[b.first[bad]],
                   atom->tag[b.second[bad]], update->ntimestep, problem);
    for (int k = 0; k < b.n; k++) {
        apply(b, k);
        if (b.resists) apply_couple(its.couple(b.history[k]), b.first[k], b.second[k]);
    }
    b.n = 0;
}

static void add_to(double *force, double *torque, double sign, const double *f, double arm, const double *turn)
{
    for (int i = 0; i < 3; i++) {
        force[i] += sign * f[i];
        torque[i] += arm * turn[i];
    }
}

void PairRestitute::apply(const Batch &batch, int k)
{
    const int first = batch.first[k], second = batch.second[k];
    const double *n = batch.motion[k].normal, *f = batch.force[k];
    const double turn[3] = {n[1] * f[2] - n[2] * f[1], n[2] * f[0] - n[0] * f[2], n[0] * f[1] - n[1] * f[0]};
    const bool all = force->newton_pair;
    if (all || first < atom->nlocal) add_to(atom->f[first], atom->torque[first], 1, f, batch.arm1[k], turn);
    if (all || second < atom->nlocal) add_to(atom->f[second], atom->torque[second], -1, f, batch.arm2[k], turn);
    if (!evflag) return;
    const double *a = atom->x[first], *b = atom->x[second];
    ev_tally_xyz(first, second, atom->nlocal, all, 0, 0, f[0], f[1], f[2], a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

void PairRestitute::apply_couple(const double couple[3], int first, int second)
{
    const bool all = force->newton_pair;
    for (int k = 0; k < 3; k++) {
        if (all || first < atom->nlocal) atom->torque[first][k] += couple[k];
        if (all || second < atom->nlocal) atom->torque[second][k] -= couple[k];
    }
}

/* ---- reports */

restitute_contact_details PairRestitute::details(int i, int j, const double *history)
{
    const double *radius = atom->radius;
    return model(atom->type[i], atom->type[j])->details(radius[i] * radius[j] / (radius[i] + radius[j]), history);
}

/* What springs still store when bodies separate is lost as they relax. */
void PairRestitute::end_contact(int i, int j, double *history)
{
    if (has_details && is_counted(i, j)) {
        const auto its = details(i, j, history);
        ended_friction += its.friction;
        ended_viscous += its.stored + its.viscous;
    }
    std::fill_n(history, history_size, 0.0);
}

/* For `compute ID all pair restitute`. Energies only in steps in which LAMMPS asks for them. */
void PairRestitute::report_values()
{
    const Record own = record();
    double stored = 0, friction = ended_friction, viscous = ended_viscous;
    for (int ii = 0; ii < list->inum && has_details && eflag_global; ii++) {
        const int i = list->ilist[ii], *touched = histories->firstflag[i];
        for (int jj = 0; jj < list->numneigh[i]; jj++) {
            const int j = list->firstneigh[i][jj] & NEIGHMASK;
            if (!touched[jj] || !is_counted(i, j)) continue;
            const auto its = details(i, j, histories->firstvalue[i] + jj * history_size);
            stored += its.stored, friction += its.friction, viscous += its.viscous;
        }
    }
    const double values[] = {
        own.steps, own.contacts, own.beyond[restitute_dem::RADIUS], own.beyond[restitute_dem::SPEED], stored,
        friction,  viscous};
    std::copy_n(values, nextra, pvector);
}

/* NULL: the spheres do not touch. */
const double *PairRestitute::history_of(int i, int j) const
{
    for (const auto &[a, b] : {std::make_pair(i, j), std::make_pair(j, i)}) {
        if (!list || !histories || a >= std::min(histories->nlocal_neigh, atom->nlocal)) continue;
        for (int jj = 0; jj < list->numneigh[a]; jj++)
            if ((list->firstneigh[a][jj] & NEIGHMASK) == b && histories->firstflag[a][jj])
                return histories->firstvalue[a] + jj * history_size;
    }
    return nullptr;
}

/* Numbers for `compute pair/local`: 1 to 12 as of LAMMPS's pair_style granular. The tangential
 * force on i and its length, the rolling torque on i and its length, the twisting torque, x_i -
 * x_j; then the contact radius, the stick radius, stored energy, losses to friction and viscous
 * ones. */
double PairRestitute::single(int i, int j, int, int, double rsq, double, double, double &fforce)
{
    const Spheres spheres(atom, frozen);
    const double *history = history_of(i, j), *a = atom->x[i], *b = atom->x[j];
    const int first = atom->tag[i] < atom->tag[j] ? i : j, second = first == i ? j : i;
    const double sign = first == i ? 1 : -1;
    restitute_contact_force found = {};
    std::fill_n(svector, single_extra, 0.0);
    fforce = 0;
    if (!history) return 0;
    const int law = number(atom->type[i], atom->type[j]);
    ContactModel &its = *models[law];
    Batch &batch = *batches[law]; /* empty between steps */
    const double *n = batch.motion[0].normal, *couple = its.couple(history);
    if (!touching(spheres.body(first), spheres.body(second), batch, 0) || !its.peek(n, history, found)) return 0;
    const double twist = couple ? couple[0] * n[0] + couple[1] * n[1] + couple[2] * n[2] : 0;
    for (int k = 0; k < 3; k++) {
        svector[k] = sign * found.tangential[k];
        svector[4 + k] = couple ? sign * (couple[k] - twist * n[k]) : 0;
        svector[9 + k] = a[k] - b[k];
    }
    svector[3] = std::hypot(svector[0], svector[1], svector[2]);
    svector[7] = std::hypot(svector[4], svector[5], svector[6]);
    svector[8] = -twist; /* about x_i - x_j */
    const auto kept = details(i, j, history);
    const double rest[] = {kept.contact_radius, kept.stick_radius, kept.stored, kept.friction, kept.viscous};
    std::copy_n(rest, 5, svector + 12);
    fforce = found.normal / std::sqrt(rsq);
    return 0;
}

Record PairRestitute::record() const
{
    Record own;
    for (const Model &its : models)
        own.add(its->record);
    return own;
}

/* The limits shown are those of the first law. */
void PairRestitute::finish()
{
    const Record all = sum_of(record(), world);
    if (comm->me == 0) utils::logmesg(lmp, all.text(models[0]->limits));
}
