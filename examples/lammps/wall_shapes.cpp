/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "wall_shapes.h"

#include "wall_region.h"

#include "domain.h"
#include "error.h"
#include "lammps.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

using namespace LAMMPS_NS;

static const char *const names[] = {"xplane", "yplane", "zplane", "xcylinder", "ycylinder", "zcylinder", "region"};
static const double nowhere = 1e99; /* of the plane that there is not */
static const double pi = 3.14159265358979323846;

void WallMotion::place(double time, double step)
{
    const double rate = pi / period;
    displacement = speed * time + 2 * amplitude * std::pow(std::sin(rate * time), 2);
    velocity = speed + 2 * amplitude * std::sin(rate * (2 * time - step)) * std::sin(rate * step) / step;
}

/* A wall that moves along an axis without turning. */
class MovingShape : public WallShape
{
  public:
    MovingShape(const WallMotion &motion) : motion(motion)
    {
    }
    void place(double time, double step) override
    {
        motion.place(time, step);
    }

  protected:
    WallPoint point_near(const double *x, int label) const
    {
        WallPoint point = {label, {x[0], x[1], x[2]}, {}, {}, 0};
        point.velocity[motion.axis] = motion.velocity;
        return point;
    }
    double moved(int axis) const
    {
        return axis == motion.axis ? motion.displacement : 0;
    }
    WallMotion motion;
};

/* Two planes across an axis. */
class Planes : public MovingShape
{
  public:
    Planes(const WallMotion &motion, int axis, double low, double high)
        : MovingShape(motion), axis(axis), places{low, high}
    {
    }
    int faces() const override
    {
        return 2;
    }
    void touch(const double *x, double distance, std::vector<WallPoint> &points) override
    {
        for (int k = 0; k < 2; k++) {
            const double place = places[k] + moved(axis);
            if (!(std::fabs(x[axis] - place) < distance)) continue;
            points.push_back(point_near(x, k + 1));
            points.back().position[axis] = place;
        }
    }

  private:
    int axis;
    double places[2];
};

/* A cylinder about an axis. Its mean curvature is half of 1/radius, see WallPoint. */
class Cylinder : public MovingShape
{
  public:
    Cylinder(const WallMotion &motion, int axis, double radius) : MovingShape(motion), axis(axis), radius(radius)
    {
    }
    int faces() const override
    {
        return 1;
    }
    void touch(const double *x, double distance, std::vector<WallPoint> &points) override
    {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        const double da = x[a] - moved(a), db = x[b] - moved(b), r = std::sqrt(da * da + db * db);
        if (r == 0 || !(std::fabs(radius - r) < distance)) return;
        WallPoint point = point_near(x, 1);
        point.position[a] = moved(a) + da * (radius / r);
        point.position[b] = moved(b) + db * (radius / r);
        point.curvature = (r < radius ? -0.5 : 0.5) / radius;
        points.push_back(point);
    }

  private:
    int axis;
    double radius;
};

/* ---- words of a script */

bool LAMMPS_NS::names_wall(const char *word)
{
    return std::find(std::begin(names), std::end(names), std::string(word)) != std::end(names);
}

/* The words of one wall, read one after the other. */
class Words
{
  public:
    Words(LAMMPS *lmp, char **&word, char **end) : lmp(lmp), word(word), end(end)
    {
    }
    bool take(const char *wanted)
    {
        if (word == end || strcmp(*word, wanted)) return false;
        word++;
        return true;
    }
    const char *next(const char *after, const char *what)
    {
        if (word == end) lmp->error->all(FLERR, "fix wall/restitute: {} needs {}", after, what);
        return *word++;
    }
    double number(const char *after, const char *what)
    {
        return utils::numeric(FLERR, next(after, what), false, lmp);
    }
    int axis(const char *after)
    {
        const std::string name = next(after, "an axis");
        if (name != "x" && name != "y" && name != "z")
            lmp->error->all(FLERR, "fix wall/restitute: {} '{}': the axis must be x, y or z", after, name);
        return name[0] - 'x';
    }

  private:
    LAMMPS *lmp;
    char **&word, **end;
};

/* shear AXIS V | move AXIS V | wiggle AXIS AMPLITUDE PERIOD. `across`: axes that are not along the
 * wall. */
static WallMotion read_motion(LAMMPS *lmp, Words &words, const bool across[3])
{
    WallMotion motion;
    if (words.take("shear")) {
        motion.axis = words.axis("shear");
        motion.speed = words.number("shear", "a speed");
        if (across[motion.axis])
            lmp->error->all(FLERR,
                            "fix wall/restitute: shear {}: must be along the wall; 'move {} V' moves it across itself",
                            "xyz"[motion.axis], "xyz"[motion.axis]);
    } else if (words.take("move")) {
        motion.axis = words.axis("move");
        motion.speed = words.number("move", "a speed");
    } else if (words.take("wiggle")) {
        motion.axis = words.axis("wiggle");
        motion.amplitude = words.number("wiggle", "an amplitude");
        motion.period = words.number("wiggle", "a period");
        if (!(motion.period > 0))
            lmp->error->all(FLERR, "fix wall/restitute: wiggle period {}: must be positive", motion.period);
    }
    return motion;
}

static double read_place(LAMMPS *lmp, Words &words, const char *name, double none)
{
    const char *word = words.next(name, "two positions, numbers or NULL");
    return strcmp(word, "NULL") ? utils::numeric(FLERR, word, false, lmp) : none;
}

std::unique_ptr<WallShape> LAMMPS_NS::make_wall(LAMMPS *lmp, char **&word, char **end)
{
    const char *name = *word;
    Words words(lmp, ++word, end);
    const int kind = (int)(std::find(std::begin(names), std::end(names), std::string(name)) - names), axis = kind % 3;
    if (kind == 6) return std::make_unique<RegionWall>(lmp, words.next(name, "the ID of a region"));
    const bool plane = kind < 3;
    bool across[3];
    for (int k = 0; k < 3; k++) {
        across[k] = plane == (k == axis);
        if (across[k] && lmp->domain->periodicity[k])
            lmp->error->all(FLERR, "fix wall/restitute: {}: the box is periodic across the wall", name);
    }
    if (plane) {
        const double low = read_place(lmp, words, name, -nowhere), high = read_place(lmp, words, name, nowhere);
        if (!(low < high))
            lmp->error->all(FLERR, "fix wall/restitute: {} {} {}: low must be below high", name, low, high);
        return std::make_unique<Planes>(read_motion(lmp, words, across), axis, low, high);
    }
    const double radius = words.number(name, "a radius");
    if (!(radius > 0)) lmp->error->all(FLERR, "fix wall/restitute: {} {}: the radius must be positive", name, radius);
    return std::make_unique<Cylinder>(read_motion(lmp, words, across), axis, radius);
}
