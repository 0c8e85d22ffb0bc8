/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "pair_restitute.h"

#include "lammps_declarations.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <map>
#include <stdexcept>

using namespace LAMMPS_NS;
using restitute_dem::Contact;
using restitute_dem::ContactModel;
using restitute_dem::Record;

restitute_dem::Units LAMMPS_NS::restitute_units(LAMMPS *lmp, const char *style)
{
    const std::string units = lmp->update->unit_style;
    if (units == "si") return {};
    if (units == "cgs") return {0.1, 1000};
    lmp->error->all(FLERR, "{}: units {}: must be si or cgs, since the files of materials are in Pa, s and kg/m^3", style,
                    units);
}

Record LAMMPS_NS::restitute_sum(const Record &record, MPI_Comm world)
{
    const double sums[] = {record.steps, record.contacts, record.wide, record.fast, record.coarse};
    const double largest[] = {record.deepest, record.fastest, -record.shortest};
    double s[5], l[3];
    MPI_Allreduce(sums, s, 5, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(largest, l, 3, MPI_DOUBLE, MPI_MAX, world);
    Record all;
    all.steps = s[0], all.contacts = s[1], all.wide = s[2], all.fast = s[3], all.coarse = s[4];
    all.deepest = l[0], all.fastest = l[1], all.shortest = -l[2];
    return all;
}

Spheres::Spheres(Atom *atom, int frozen)
    : x(atom->x), v(atom->v), omega(atom->omega), radius(atom->radius), mass(atom->rmass), mask(atom->mask), frozen(frozen)
{
}

restitute_dem::Body Spheres::body(int i) const
{
    return {x[i], v[i], omega[i], radius[i], mask[i] & frozen ? 0.0 : 1 / mass[i]};
}

double Spheres::density(int i) const
{
    return mass[i] / (4.0 / 3 * 3.14159265358979323846 * radius[i] * radius[i] * radius[i]);
}

int LAMMPS_NS::restitute_frozen(LAMMPS *lmp)
{
    const auto fixes = lmp->modify->get_fix_by_style("^freeze");
    return fixes.empty() ? 0 : fixes[0]->groupbit;
}

PairRestitute::PairRestitute(LAMMPS *lmp) : Pair(lmp)
{
    restartinfo = 1;
    no_virial_fdotr_compute = 1;
    centroidstressflag = CENTROID_NOTAVAIL;
    finitecutflag = 1;
    nondefault_history_transfer = 1; /* a state is oriented by tags: the swap of two atoms copies it */
    nextra = 4;
    pvector = new double[nextra];
    history_id = "NEIGH_HISTORY_RESTITUTE";
    while (modify->get_fix_by_id(history_id) || modify->get_fix_by_id(history_id + "_DUMMY"))
        history_id += "_MORE"; /* pair_style hybrid with several of us; a restart file finds its fix by this name */
    modify->add_fix(history_id + "_DUMMY all DUMMY"); /* takes the place that the histories' fix needs among the fixes */
}

PairRestitute::~PairRestitute()
{
    delete[] pvector;
    modify->delete_fix(histories ? history_id : history_id + "_DUMMY");
    if (!allocated) return;
    memory->destroy(setflag);
    memory->destroy(cutsq);
}

/* ---------------------------------------------------------------------------------------------- input script */

void PairRestitute::settings(int narg, char **)
{
    if (narg) error->all(FLERR, "pair_style restitute: takes no words; they belong to pair_coeff");
}

void PairRestitute::allocate()
{
    width = atom->ntypes + 1;
    types.resize(width * width);
    memory->create(setflag, width, width, "restitute:setflag");
    memory->create(cutsq, width, width, "restitute:cutsq");
    std::fill_n(&setflag[0][0], width * width, 0);
    allocated = 1;
}

std::shared_ptr<ContactModel> PairRestitute::read_model(const std::vector<std::string> &words)
{
    try {
        return std::make_shared<ContactModel>(words, restitute_units(lmp, "pair_style restitute"));
    } catch (const std::invalid_argument &problem) {
        error->all(FLERR, "pair_coeff of restitute: {}", problem.what());
    }
}

void PairRestitute::set(int i, int j, const std::shared_ptr<ContactModel> &model)
{
    of(i, j).model = model;
    setflag[std::min(i, j)][std::max(i, j)] = 1;
}

void PairRestitute::coeff(int narg, char **arg)
{
    int first_i, last_i, first_j, last_j, count = 0;
    if (narg < 3) error->all(FLERR, "pair_coeff of restitute: needs two types, FILE and friction MU");
    if (!allocated) allocate();
    utils::bounds(FLERR, arg[0], 1, atom->ntypes, first_i, last_i, error);
    utils::bounds(FLERR, arg[1], 1, atom->ntypes, first_j, last_j, error);
    const auto model = read_model({arg + 2, arg + narg});
    for (int i = first_i; i <= last_i; i++)
        for (int j = std::max(first_j, i); j <= last_j; j++, count++)
            set(i, j, model);
    if (!count) error->all(FLERR, "pair_coeff of restitute: no pair of types {} {}", arg[0], arg[1]);
}

/* ---------------------------------------------------------------------------------------------- before a run */

std::vector<ContactModel *> PairRestitute::models()
{
    std::vector<ContactModel *> found;
    for (const TypePair &pair : types)
        if (pair.model && std::find(found.begin(), found.end(), pair.model.get()) == found.end())
            found.push_back(pair.model.get());
    return found;
}

void PairRestitute::init_style()
{
    if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
        error->all(FLERR, "pair_style restitute: needs atom_style sphere");
    if (!comm->ghost_velocity) error->all(FLERR, "pair_style restitute: needs comm_modify vel yes");
    for (const Fix *fix : modify->get_fix_list())
        if (fix->rigid_flag) error->all(FLERR, "pair_style restitute: spheres of rigid bodies are not supported");
    neighbor->add_request(this, NeighConst::REQ_SIZE | NeighConst::REQ_HISTORY);
    keep_history();
    find_largest_radii();
    for (ContactModel *model : models())
        model->record = Record();
    frozen = restitute_frozen(lmp);
    warned = false;
    reset_dt();
}

void PairRestitute::reset_dt()
{
    for (ContactModel *model : models())
        model->set_step(update->dt);
}

/* The fix of LAMMPS that carries the state of every contact through neighbor lists, processes and restart files. */
void PairRestitute::keep_history()
{
    int size = 0;
    for (const ContactModel *model : models())
        size = std::max(size, model->history_size());
    if (!histories) {
        histories = static_cast<FixNeighHistory *>(
            modify->replace_fix(history_id + "_DUMMY", history_id + " all NEIGH_HISTORY " + std::to_string(size), 1));
        histories->pair = this;
        history_size = size;
    }
    if (size > history_size)
        error->all(FLERR, "pair_coeff of restitute: contacts need {} numbers now, but the runs before kept {}", size,
                   history_size);
}

/* Of each type, those that are poured or deposited later included. */
void PairRestitute::find_largest_radii()
{
    std::vector<double> own(atom->ntypes + 1, 0.0);
    for (int i = 0; i < atom->nlocal; i++)
        own[atom->type[i]] = std::max(own[atom->type[i]], atom->radius[i]);
    for (const char *style : {"^pour", "^deposit"})
        for (Fix *fix : modify->get_fix_by_style(style))
            for (int type = 1; type <= atom->ntypes; type++) {
                int its = type;
                if (const void *radius = fix->extract("radius", its))
                    own[type] = std::max(own[type], *static_cast<const double *>(radius));
            }
    largest_radius.resize(own.size());
    MPI_Allreduce(own.data(), largest_radius.data(), (int)own.size(), MPI_DOUBLE, MPI_MAX, world);
}

double PairRestitute::init_one(int i, int j)
{
    const TypePair &pair = of(i, j);
    if (!pair.model)
        error->all(FLERR, "pair_coeff of restitute: none for types {} {}; two materials meet with 'partner FILE'", i, j);
    if (pair.restarted && pair.restarted != pair.model->hash())
        error->all(FLERR,
                   "pair_style restitute: types {} {}: the restart file was written with law {:016x}, this is {:016x} of '{}'",
                   i, j, pair.restarted, pair.model->hash(), pair.model->words[0]);
    return largest_radius[i] + largest_radius[j];
}

/* ---------------------------------------------------------------------------------------------- a time step */

void PairRestitute::compute(int eflag, int vflag)
{
    const Spheres spheres(atom, frozen);
    double **x = atom->x, *radius = atom->radius;
    ev_init(eflag, vflag);
    for (int ii = 0; ii < list->inum; ii++) {
        const int i = list->ilist[ii], *neighbors = list->firstneigh[i];
        int *touched = histories->firstflag[i];
        double *history = histories->firstvalue[i];
        for (int jj = 0; jj < list->numneigh[i]; jj++, history += history_size) {
            const int j = neighbors[jj] & NEIGHMASK;
            const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
            const double sum = radius[i] + radius[j];
            if (dx * dx + dy * dy + dz * dz < sum * sum) {
                touched[jj] = 1;
                compute_contact(spheres, i, j, history);
            } else if (touched[jj]) {
                touched[jj] = 0;
                std::fill_n(history, history_size, 0.0);
            }
        }
    }
    update_record();
}

/* The atom with the smaller tag is body 1: in every list, on every process. */
void PairRestitute::compute_contact(const Spheres &spheres, int i, int j, double *history)
{
    const tagint *tag = atom->tag;
    const int first = tag[i] < tag[j] ? i : j, second = first == i ? j : i;
    Contact contact;
    double force[3];
    if (!touching(spheres.body(first), spheres.body(second), contact)) return;
    ContactModel &model = *of(atom->type[i], atom->type[j]).model;
    const char *problem;
    if (update->setupflag) {
        problem = model.repeat(contact, history, force);
    } else {
        const double density = history[0] == 0 ? std::max(spheres.density(i), spheres.density(j)) : 0;
        const bool twice = j >= atom->nlocal && !this->force->newton_pair; /* the owner of j computes this contact, too */
        problem = model.advance(contact, density, !twice || first == i, history, force);
    }
    if (problem)
        error->one(FLERR, "restitute: contact of atoms {} and {} at step {}: {}", tag[first], tag[second],
                   update->ntimestep, problem);
    apply(contact, force, first, second);
}

static void add_to(double *force, double *torque, const double *f, double sign, const double *turn, double arm)
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
    const int own = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
    if (first < own) add_to(atom->f[first], atom->torque[first], f, 1, turn, c.arm1);
    if (second < own) add_to(atom->f[second], atom->torque[second], f, -1, turn, c.arm2);
    if (evflag)
        ev_tally_xyz(first, second, atom->nlocal, force->newton_pair, 0, 0, f[0], f[1], f[2], a[0] - b[0], a[1] - b[1],
                     a[2] - b[2]);
}

/* ---------------------------------------------------------------------------------------------- what was met */

Record PairRestitute::record()
{
    Record own;
    for (const ContactModel *model : models())
        own.add(model->record);
    return own;
}

/* For `compute ID all pair restitute`, and a warning while the run can still be stopped. */
void PairRestitute::update_record()
{
    const Record own = record();
    pvector[0] = own.steps;
    pvector[1] = own.contacts;
    pvector[2] = own.wide;
    pvector[3] = own.fast;
    if (own.coarse == 0 || warned) return;
    warned = true;
    error->warning(FLERR, "restitute: a contact began at step {} that needs a time step of {:.3g} or less, not {:.3g}",
                   update->ntimestep, own.shortest, update->dt);
}

void PairRestitute::finish()
{
    const Record all = restitute_sum(record(), world);
    if (comm->me == 0) utils::logmesg(lmp, all.text());
}

/* ---------------------------------------------------------------------------------------------- restart files */

/* The states of contacts are in the part of the fix that keeps them. */
void PairRestitute::transfer_history(double *source, double *target, int, int)
{
    std::copy_n(source, history_size, target);
}

/* Of each pair of types the words and the hash of the law, or no words. */
void PairRestitute::write_restart(FILE *file)
{
    for (int i = 1; i < width; i++)
        for (int j = i; j < width; j++) {
            const ContactModel *model = of(i, j).model.get();
            const uint64_t hash = model ? model->hash() : 0;
            std::string line;
            if (model)
                for (const std::string &word : model->words)
                    line += word + '\n';
            const int length = (int)line.size();
            fwrite(&length, sizeof length, 1, file);
            fwrite(line.data(), 1, line.size(), file);
            fwrite(&hash, sizeof hash, 1, file);
        }
}

/* A line of the first process, for all. */
static std::string read_line(LAMMPS *lmp, FILE *file, uint64_t *hash)
{
    const bool reads = lmp->comm->me == 0;
    int length = 0;
    if (reads) utils::sfread(FLERR, &length, sizeof length, 1, file, nullptr, lmp->error);
    MPI_Bcast(&length, 1, MPI_INT, 0, lmp->world);
    std::string line(length, ' ');
    if (reads && length) utils::sfread(FLERR, &line[0], 1, length, file, nullptr, lmp->error);
    if (reads) utils::sfread(FLERR, hash, sizeof *hash, 1, file, nullptr, lmp->error);
    MPI_Bcast(&line[0], length, MPI_CHAR, 0, lmp->world);
    MPI_Bcast(hash, sizeof *hash, MPI_BYTE, 0, lmp->world);
    return line;
}

void PairRestitute::read_restart(FILE *file)
{
    std::map<std::string, std::shared_ptr<ContactModel>> read;
    allocate();
    for (int i = 1; i < width; i++)
        for (int j = i; j < width; j++) {
            const std::string line = read_line(lmp, file, &of(i, j).restarted);
            if (line == "") continue;
            auto &model = read[line];
            if (!model) model = read_model(utils::split_lines(line));
            set(i, j, model);
        }
}
