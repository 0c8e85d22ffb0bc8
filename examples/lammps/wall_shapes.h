/* Where a wall is nearest to a sphere, and how it moves there: planes and cylinders. Regions are in
 * wall_region.h.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef RESTITUTE_WALL_SHAPES_H
#define RESTITUTE_WALL_SHAPES_H

#include <memory>
#include <vector>

namespace LAMMPS_NS
{

/* A point where the wall is near. */
struct WallPoint {
    int label;                   /* > 0, of the face: identifies the contact from step to step */
    double position[3];          /* at the end of the step */
    double velocity[3], spin[3]; /* of the material of the wall, mean of the step */
    double curvature;            /* mean of the two principal ones; negative if the wall is concave */
};

class WallShape
{
  public:
    virtual ~WallShape() = default;
    virtual void init()
    {
    } /* before a run */
    /* To the place at the end of a step; `time` since the wall was made. */
    virtual void place(double time, double step) = 0;
    /* Appends the points nearer to x than `distance`, at most one a face. */
    virtual void touch(const double *x, double distance, std::vector<WallPoint> &points) = 0;
    virtual int faces() const = 0;
};

/* Motion of a wall without rotation, along one axis: with constant speed, or as LAMMPS's `wiggle`,
 * A - A cos(2 pi t/period). Mean velocity of the step: then the contact moves as in the frame of
 * the wall. */
struct WallMotion {
    int axis = 0;
    double speed = 0, amplitude = 0, period = 1;
    double displacement = 0, velocity = 0; /* now */
    void place(double time, double step);
};

/* Reads the words of a wall, from its shape on, up to the first that is not its own, to which
 * `word` then points. */
std::unique_ptr<WallShape> make_wall(class LAMMPS *lmp, char **&word, char **end);

/* Is this the first word of a wall? */
bool names_wall(const char *word);

} // namespace LAMMPS_NS

#endif
