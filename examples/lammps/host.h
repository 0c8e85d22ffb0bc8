/* Common code of the pair style and the wall: their interface to LAMMPS.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef RESTITUTE_HOST_H
#define RESTITUTE_HOST_H

#include "contact_model.h"

#include "atom.h"
#include "pointers.h"

#include <memory>

namespace LAMMPS_NS
{

/* The spheres of a process as bodies of a contact, for as long as their arrays stay where they
 * are. */
class Spheres
{
  public:
    Spheres(const Atom *atom, int frozen)
        : x(atom->x), v(atom->v), omega(atom->omega), radius(atom->radius), mass(atom->rmass), mask(atom->mask),
          frozen(frozen)
    {
    }
    restitute_dem::Body body(int i) const
    {
        return {x[i], v[i], omega[i], radius[i], mask[i] & frozen ? 0.0 : 1 / mass[i]};
    }
    double density(int i) const
    {
        return mass[i] / (4.18879020478639098 * radius[i] * radius[i] * radius[i]);
    }

  private:
    double **x, **v, **omega, *radius, *mass;
    int *mask, frozen;
};

/* A model from the arguments of a command; `who` is its name in messages. */
std::unique_ptr<restitute_dem::ContactModel> make_model(LAMMPS *lmp, const char *who, char **first, char **last);

/* Stops if LAMMPS is not set up for contacts of single spheres. Returns the bit of the group of fix
 * freeze, or 0. */
int check_host(LAMMPS *lmp, const char *who);

/* Stops if a restart file was written with another law. */
void check_law(LAMMPS *lmp, const std::string &who, uint64_t written, const restitute_dem::ContactModel &model);

/* Warns once of contacts that begin too fast for the time step, and once of those that begin with a
 * deep overlap. */
void warn(LAMMPS *lmp, const restitute_dem::Record &record, bool warned[restitute_dem::RATIOS]);

/* Warns if a suffix, as of `-sf omp`, asks for a variant of a style. There are none. */
void warn_of_suffix(LAMMPS *lmp, const char *who);

/* Of each type the mass of the lightest sphere that is there, and its radius. Infinity: there is
 * none. */
void find_lightest(LAMMPS *lmp, std::vector<double> &mass, std::vector<double> &radius);

/* If the law has the word `speed`: prints the limit of the time step for an impact at that speed,
 * and warns if the step is longer. Effective mass and radius. Nothing if they are not finite. */
void report_limit(LAMMPS *lmp, const std::string &who, const restitute_dem::ContactModel &model, double mass,
                  double radius);

/* The record of all processes. */
restitute_dem::Record sum_of(const restitute_dem::Record &record, MPI_Comm world);

} // namespace LAMMPS_NS

#endif
