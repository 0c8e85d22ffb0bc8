/* The surface of a region of LAMMPS as a wall.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef RESTITUTE_WALL_REGION_H
#define RESTITUTE_WALL_REGION_H

#include "wall_shapes.h"

#include <string>

namespace LAMMPS_NS
{

class LAMMPS;
class Region;

class RegionWall : public WallShape
{
  public:
    RegionWall(LAMMPS *lmp, const char *name);
    void init() override;
    void place(double time, double step) override;
    void touch(const double *x, double distance, std::vector<WallPoint> &points) override;
    int faces() const override
    {
        return all_faces;
    }

  private:
    /* A region that is no union or intersection. Only these have a place and motion of their
     * own. */
    struct Part {
        Region *region;
        int first_label;
        double now[4], before[4]; /* a point that moves with it, and its angle: after this step and before */
    };

    void add_parts(Region *region);
    void collect(Region *region, bool flip, const double *x, double distance, std::vector<WallPoint> &points);
    void add_point(const Part &part, int n, const double *x, double distance, std::vector<WallPoint> &points) const;
    void set_velocity(const Part &part, int n, const double *middle, WallPoint &point) const;

    LAMMPS *lmp;
    std::string name;
    Region *region = nullptr;
    std::vector<Part> parts;
    int all_faces = 0;
    double step = 1;
};

} // namespace LAMMPS_NS

#endif
