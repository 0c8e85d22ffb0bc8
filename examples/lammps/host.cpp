/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "host.h"

#include "comm.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "update.h"

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
