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
using restitute_dem::Contact;
using restitute_dem::ContactModel;
using restitute_dem::Record;

void PairRestitute::compute(int eflag, int vflag)
{
    const Spheres spheres(atom, frozen);
    double **x = atom->x, *radius = atom->radius;
    ev_init(eflag, vflag);
    histories->restart_global = 1;
    beyond_contact = has_details; /* the fix keeps contacts that end when lists are made, for end_contact() */
    const double change = change_of_box();
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
                compute_contact(spheres, i, j, history);
            } else if (touched[jj]) {
                touched[jj] = 0;
                end_contact(i, j, history);
            }
        }
    }
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
void PairRestitute::compute_contact(const Spheres &spheres, int i, int j, double *history)
{
    const tagint *tag = atom->tag;
    const int first = tag[i] < tag[j] ? i : j, second = first == i ? j : i;
    Contact contact;
    double f[3];
    if (!touching(spheres.body(first), spheres.body(second), contact)) return;
    ContactModel &its = *model(atom->type[i], atom->type[j]);
    const char *problem;
    if (update->setupflag) {
        problem = its.repeat(contact, history, f);
    } else {
        const double density = history[0] == 0 ? std::max(spheres.density(i), spheres.density(j)) : 0;
        problem = its.advance(contact, density, is_counted(i, j), history, f, (double)tag[i] + tag[j]);
    }
    if (problem)
        error->one(FLERR, "restitute: atoms {} and {} at step {}: {}", tag[first], tag[second], update->ntimestep,
                   problem);
    apply(contact, f, first, second);
    if (const double *couple = its.couple(history)) apply_couple(couple, first, second);
}

/* Without newton the owner of j computes this contact, too. */
bool PairRestitute::is_counted(int i, int j) const
{
    return force->newton_pair || j < atom->nlocal || atom->tag[i] < atom->tag[j];
}

static void add_to(double *force, double *torque, double sign, const double *f, double arm, const double *turn)
{
    for (int i = 0; i < 3; i++) {
        force[i] += sign * f[i];
        torque[i] += arm * turn[i];
    }
}

void PairRestitute::apply(const Contact &c, const double f[3], int first, int second)
{
    const double *n = c.normal, *a = atom->x[first], *b = atom->x[second];
    const double turn[3] = {n[1] * f[2] - n[2] * f[1], n[2] * f[0] - n[0] * f[2], n[0] * f[1] - n[1] * f[0]};
    const bool all = force->newton_pair;
    if (all || first < atom->nlocal) add_to(atom->f[first], atom->torque[first], 1, f, c.arm1, turn);
    if (all || second < atom->nlocal) add_to(atom->f[second], atom->torque[second], -1, f, c.arm2, turn);
    if (evflag)
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

/* Numbers for `compute pair/local`: 1 to 12 as of LAMMPS's pair_style granular. The tangential force
 * on i and its length, the rolling torque on i and its length, the twisting torque, x_i - x_j; then
 * the contact radius, the stick radius, stored energy, losses to friction and viscous ones. */
double PairRestitute::single(int i, int j, int, int, double rsq, double, double, double &fforce)
{
    const Spheres spheres(atom, frozen);
    const double *history = history_of(i, j), *a = atom->x[i], *b = atom->x[j];
    const int first = atom->tag[i] < atom->tag[j] ? i : j, second = first == i ? j : i;
    const double sign = first == i ? 1 : -1;
    restitute_contact_force found = {};
    Contact contact;
    std::fill_n(svector, single_extra, 0.0);
    fforce = 0;
    if (!history || !touching(spheres.body(first), spheres.body(second), contact)) return 0;
    ContactModel &its = *model(atom->type[i], atom->type[j]);
    if (its.repeat(contact, history, found)) return 0;
    const double *n = contact.normal, *couple = its.couple(history);
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
