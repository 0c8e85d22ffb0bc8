/* fix wall/restitute: viscoelastic contacts of spheres with planes and with the inside of a
 * cylinder.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef LMP_FIX_WALL_RESTITUTE_H
#define LMP_FIX_WALL_RESTITUTE_H

#include "fix.h"

#include "contact_model.h"

#include <memory>

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
    enum Shape { X_PLANE, Y_PLANE, Z_PLANE, Z_CYLINDER };

    void read_shear(char **word, int words);
    bool nearest(const double *x, double *point) const;
    void compute_contact(int i, const class Spheres &spheres, const double *point);

    std::unique_ptr<restitute_dem::ContactModel> model;
    std::unique_ptr<restitute_dem::Batch> batch; /* of one contact */
    Shape shape;
    double low, high;        /* where the planes are; low: the radius of the cylinder */
    double velocity[3] = {}; /* of the wall, along itself */
    double **history = nullptr;
    double force_on_wall[3] = {};
    int history_size, frozen = 0;
    bool warned[restitute_dem::RATIOS] = {};
};

} // namespace LAMMPS_NS

#endif
