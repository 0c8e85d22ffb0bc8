/* fix wall/restitute: viscoelastic contacts of spheres with planes, cylinders and regions.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef LMP_FIX_WALL_RESTITUTE_H
#define LMP_FIX_WALL_RESTITUTE_H

#include "fix.h"

#include "contact_model.h"
#include "wall_shapes.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS
{

class FixWallRestitute : public Fix
{
  public:
    FixWallRestitute(LAMMPS *lmp, int narg, char **arg);
    ~FixWallRestitute() override;
    int setmask() override;
    void init() override;
    void setup(int vflag) override;
    void reset_dt() override;
    void post_force(int vflag) override;
    void post_run() override;
    double compute_scalar() override;
    double compute_vector(int n) override;

    void grow_arrays(int nmax) override;
    void copy_arrays(int i, int j, int) override;
    void set_arrays(int i) override;
    int pack_exchange(int i, double *buffer) override;
    int unpack_exchange(int i, double *buffer) override;
    int pack_restart(int i, double *buffer) override;
    void unpack_restart(int i, int nth) override;
    int size_restart(int i) override;
    int maxsize_restart() override;
    void write_restart(FILE *file) override;
    void restart(char *buffer) override;
    double memory_usage() override;

  private:
    void collect(int i);
    double effective_radius(int i, const WallPoint &point) const;
    void find_histories(int i, int last);
    void compute_batch();
    void apply(int of_batch);
    void show();
    restitute_contact_details details(const double *history);
    void sum_energies(double sum[3]);

    std::unique_ptr<restitute_dem::ContactModel> model;
    std::unique_ptr<restitute_dem::Batch> batch;
    double places[restitute_dem::Batch::SIZE][3]; /* of the wall, where the contacts of the batch are */
    std::unique_ptr<WallShape> shape;
    double time = 0;                            /* of this wall, which moves from its start */
    std::vector<std::vector<double>> histories; /* of each atom: those of its contacts, one after the other */
    std::vector<WallPoint> points;              /* of one sphere */
    double force_on_wall[3] = {}, ended_friction = 0, ended_viscous = 0;
    int history_size; /* of a contact: as of the model, then its effective radius */
    int frozen = 0;
    bool warned[restitute_dem::RATIOS] = {};
};

} // namespace LAMMPS_NS

#endif
