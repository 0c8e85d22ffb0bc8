/* pair_style restitute: viscoelastic contacts of spheres in LAMMPS.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef LMP_PAIR_RESTITUTE_H
#define LMP_PAIR_RESTITUTE_H

#include "pair.h"

#include "contact_model.h"

#include <memory>

namespace LAMMPS_NS
{

/* Units of LAMMPS in SI; ends the run with the reason where they are none that a material can be told in. */
restitute_dem::Units restitute_units(LAMMPS *lmp, const char *style);

/* The sum over all processes. */
restitute_dem::Record restitute_sum(const restitute_dem::Record &record, MPI_Comm world);

/* The spheres of this process as bodies of a contact, for as long as their arrays stay where they are. */
class Spheres
{
  public:
    Spheres(class Atom *atom, int frozen); /* frozen: bit of the group that nothing moves */
    restitute_dem::Body body(int i) const;
    double density(int i) const;

  private:
    double **x, **v, **omega, *radius, *mass;
    int *mask, frozen;
};

/* The bit of the group of fix freeze, or 0. */
int restitute_frozen(LAMMPS *lmp);

class PairRestitute : public Pair
{
  public:
    PairRestitute(LAMMPS *lmp);
    ~PairRestitute() override;
    void compute(int eflag, int vflag) override;
    void finish() override;
    void settings(int narg, char **arg) override;
    void coeff(int narg, char **arg) override;
    void init_style() override;
    double init_one(int i, int j) override;
    void reset_dt() override;
    void write_restart(FILE *file) override;
    void read_restart(FILE *file) override;
    void transfer_history(double *source, double *target, int, int) override;

  private:
    struct TypePair {
        std::shared_ptr<restitute_dem::ContactModel> model; /* of type pairs that one command sets */
        uint64_t restarted = 0;                             /* hash of the law in the restart file */
    };

    TypePair &of(int i, int j) { return types[(i < j ? i : j) * width + (i < j ? j : i)]; }
    std::vector<restitute_dem::ContactModel *> models();
    void allocate();
    void set(int i, int j, const std::shared_ptr<restitute_dem::ContactModel> &model);
    std::shared_ptr<restitute_dem::ContactModel> read_model(const std::vector<std::string> &words);
    void find_largest_radii();
    void keep_history();
    void compute_contact(const Spheres &spheres, int i, int j, double *history);
    restitute_dem::Record record();
    void update_record();
    void apply(const restitute_dem::Contact &contact, const double force[3], int first, int second);

    std::vector<TypePair> types;
    std::vector<double> largest_radius;
    class FixNeighHistory *histories = nullptr;
    std::string history_id;
    int width = 0, history_size = 0, frozen = 0;
    bool warned = false;
};

} // namespace LAMMPS_NS

#endif
