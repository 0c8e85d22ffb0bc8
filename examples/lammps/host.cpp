/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "host.h"

#include "comm.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace LAMMPS_NS;
using restitute_dem::ContactModel;
using restitute_dem::Record;

std::unique_ptr<ContactModel> LAMMPS_NS::make_model(LAMMPS *lmp, const char *who, char **first, char **last)
{
    const std::string units = lmp->update->unit_style;
    if (units != "si" && units != "cgs")
        lmp->error->all(FLERR, "{}: units {}: must be si or cgs, since files of materials are in Pa, s and kg/m^3", who,
                        units);
    try {
        return std::make_unique<ContactModel>(std::vector<std::string>(first, last),
                                              units == "si" ? restitute_dem::Units{1, 1}
                                                            : restitute_dem::Units{0.1, 1000});
    } catch (const std::invalid_argument &problem) {
        lmp->error->all(FLERR, "{}: {}", who, problem.what());
    }
}

int LAMMPS_NS::check_host(LAMMPS *lmp, const char *who)
{
    const Atom *atom = lmp->atom;
    int frozen = 0;
    if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
        lmp->error->all(FLERR, "{}: needs atom_style sphere", who);
    if (!lmp->comm->ghost_velocity) lmp->error->all(FLERR, "{}: needs comm_modify vel yes", who);
    if (lmp->update->whichflag == 2) lmp->error->all(FLERR, "{}: its contacts need time steps, not a minimizer", who);
    if (utils::strmatch(lmp->update->integrate_style, "^respa"))
        lmp->error->all(FLERR, "{}: needs run_style verlet", who);
    for (const Fix *fix : lmp->modify->get_fix_list()) {
        if (fix->rigid_flag) lmp->error->all(FLERR, "{}: spheres of rigid bodies are not supported", who);
        if (utils::strmatch(fix->style, "^freeze")) frozen |= fix->groupbit;
    }
    return frozen;
}

void LAMMPS_NS::check_law(LAMMPS *lmp, const std::string &who, uint64_t written, const ContactModel &model)
{
    if (written != model.hash())
        lmp->error->all(FLERR, "{}: the restart file was written with law {:016x}, not with this one of '{}', {:016x}",
                        who, written, model.words[0], model.hash());
}

void LAMMPS_NS::warn(LAMMPS *lmp, const Record &record, bool warned[restitute_dem::RATIOS])
{
    for (const auto which : {restitute_dem::STEP, restitute_dem::DEPTH}) {
        if (warned[which] || record.beyond[which] == 0) continue;
        warned[which] = true;
        lmp->error->warning(FLERR, record.warning(which, lmp->update->ntimestep));
    }
}

void LAMMPS_NS::warn_of_suffix(LAMMPS *lmp, const char *who)
{
    if (!lmp->suffix_enable || !lmp->suffix || lmp->comm->me) return;
    lmp->error->warning(FLERR, "{}: has no variant for suffix {}; it runs on one thread of each process", who,
                        lmp->suffix);
}

void LAMMPS_NS::find_lightest(LAMMPS *lmp, std::vector<double> &mass, std::vector<double> &radius)
{
    const Atom *atom = lmp->atom;
    const int width = atom->ntypes + 1;
    const auto none = std::numeric_limits<double>::infinity();
    std::vector<double> own(width, none);
    mass.resize(width), radius.resize(width);
    for (int i = 0; i < atom->nlocal; i++)
        own[atom->type[i]] = std::min(own[atom->type[i]], atom->rmass[i]);
    MPI_Allreduce(own.data(), mass.data(), width, MPI_DOUBLE, MPI_MIN, lmp->world);
    std::fill(own.begin(), own.end(), none);
    for (int i = 0; i < atom->nlocal; i++)
        if (const int type = atom->type[i]; atom->rmass[i] == mass[type])
            own[type] = std::min(own[type], atom->radius[i]);
    MPI_Allreduce(own.data(), radius.data(), width, MPI_DOUBLE, MPI_MIN, lmp->world);
}

void LAMMPS_NS::report_limit(LAMMPS *lmp, const std::string &who, const ContactModel &model, double mass, double radius)
{
    if (model.speed == 0 || !std::isfinite(mass) || !std::isfinite(radius) || lmp->comm->me) return;
    const double limit = model.step_limit(mass, radius, model.speed), step = lmp->update->dt;
    utils::logmesg(lmp, "restitute: {}, speed {:.6g}: time step at most {:.4g}\n", who, model.speed, limit);
    if (step > limit)
        lmp->error->warning(FLERR,
                            "restitute: {}: the time step {:.6g} is longer than {:.4g}, the limit for speed {:.6g}",
                            who, step, limit, model.speed);
}

Record LAMMPS_NS::sum_of(const Record &record, MPI_Comm world)
{
    using restitute_dem::RATIOS;
    Record all;
    MPI_Allreduce(&record.steps, &all.steps, 1, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(&record.contacts, &all.contacts, 1, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(record.beyond, all.beyond, RATIOS, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(record.largest, all.largest, RATIOS, MPI_DOUBLE, MPI_MAX, world);
    return all;
}
