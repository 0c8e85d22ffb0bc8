/* pair_style restitute: viscoelastic contacts of spheres in LAMMPS.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef LMP_PAIR_RESTITUTE_H
#define LMP_PAIR_RESTITUTE_H

#include "pair.h"

#include "contact_model.h"

#include <memory>

namespace LAMMPS_NS
{

class PairRestitute : public Pair
{
  public:
    PairRestitute(LAMMPS *lmp);
    ~PairRestitute() override;
    void settings(int narg, char **arg) override;
    void coeff(int narg, char **arg) override;
    void init_style() override;
    double init_one(int i, int j) override;
    void reset_dt() override;
    void compute(int eflag, int vflag) override;
    double single(int i, int j, int, int, double rsq, double, double, double &fforce) override;
    void finish() override;
    void write_restart(FILE *file) override;
    void read_restart(FILE *file) override;
    void transfer_history(double *source, double *target, int, int) override;

  private:
    using Model = std::shared_ptr<restitute_dem::ContactModel>; /* shared by the type pairs that one command sets */

    Model &model(int i, int j)
    {
        return table[(i < j ? i : j) * width + (i < j ? j : i)];
    }
    void allocate();
    void check_computes();
    void check_restart();
    void keep_history();
    void check_tags();
    void shrink_pages();
    void change_pages();
    void find_largest_radii();
    void report_limits();
    void check_radius(int i);
    double change_of_box();
    int number(int i, int j);
    void collect(restitute_dem::ContactModel &its, restitute_dem::Batch &batch, int i, int j, double *history);
    void compute_batch(restitute_dem::ContactModel &its, restitute_dem::Batch &batch);
    void apply(const restitute_dem::Batch &batch, int k);
    void apply_couple(const double couple[3], int first, int second);
    bool is_counted(int i, int j) const;
    restitute_contact_details details(int i, int j, const double *history);
    void end_contact(int i, int j, double *history);
    void report_values();
    const double *history_of(int i, int j) const;
    restitute_dem::Record record() const;

    int width = 0; /* of the table */
    std::vector<Model> table, models;
    std::vector<std::unique_ptr<restitute_dem::Batch>> batches; /* of the models */
    std::vector<uint64_t> restarted; /* hashes of the laws in the restart file; empty: none, or checked */
    std::vector<double> largest_radius, box;
    class FixNeighHistory *histories = nullptr;
    std::string history_id;
    int history_size = 0, frozen = 0;
    int page = 0, one = 0; /* of neigh_modify, for which the fix has made its pages */
    bool warned[restitute_dem::RATIOS] = {};
    bool has_details = false;
    double ended_friction = 0, ended_viscous = 0; /* energies lost in contacts that have ended */
};

} // namespace LAMMPS_NS

#endif
