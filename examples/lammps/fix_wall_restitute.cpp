/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "fix_wall_restitute.h"

#include "pair_restitute.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace FixConst;
using restitute_dem::Body;
using restitute_dem::Contact;
using restitute_dem::ContactModel;
using restitute_dem::Record;

static const double nowhere = 1e99; /* of the plane that there is not */

/* fix ID group wall/restitute FILE friction MU [...] SHAPE ARGUMENTS [shear AXIS V | wiggle AXIS AMPLITUDE PERIOD] */
FixWallRestitute::FixWallRestitute(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
    static const char *shapes[] = {"xplane", "yplane", "zplane", "zcylinder"};
    const auto is_shape = [&](const char *word) {
        return std::any_of(shapes, shapes + 4, [&](const char *shape) { return !strcmp(word, shape); });
    };
    char **place = std::find_if(arg + 3, arg + narg, is_shape);
    try {
        model = std::make_unique<ContactModel>(std::vector<std::string>(arg + 3, place),
                                               restitute_units(lmp, "fix wall/restitute"));
    } catch (const std::invalid_argument &problem) {
        error->all(FLERR, "fix wall/restitute: {}", problem.what());
    }
    if (place == arg + narg) error->all(FLERR, "fix wall/restitute: needs xplane, yplane, zplane or zcylinder");
    shape = (Shape)(std::find_if(shapes, shapes + 4, [&](const char *its) { return !strcmp(*place, its); }) - shapes);
    read_motion(read_shape((int)(place - arg) + 1, narg, arg), narg, arg);
    if (!atom->radius_flag || !atom->omega_flag || !atom->torque_flag)
        error->all(FLERR, "fix wall/restitute: needs atom_style sphere");
    if (shape == Z_CYLINDER ? domain->xperiodic || domain->yperiodic : domain->periodicity[shape])
        error->all(FLERR, "fix wall/restitute: the box is periodic across the wall");
    started = update->ntimestep;
    restart_peratom = restart_global = create_attribute = 1;
    vector_flag = extvector = 1;
    size_vector = 7;
    global_freq = 1;
    history_size = model->history_size();
    maxexchange = history_size;
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
    for (int i = 0; i < atom->nlocal; i++)
        set_arrays(i);
}

FixWallRestitute::~FixWallRestitute()
{
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
    memory->destroy(history);
}

int FixWallRestitute::read_shape(int iarg, int narg, char **arg)
{
    const int count = shape == Z_CYLINDER ? 1 : 2;
    double found[2] = {nowhere, nowhere};
    if (iarg + count > narg) error->all(FLERR, "fix wall/restitute: {} lacks its place", arg[iarg - 1]);
    for (int k = 0; k < count; k++)
        if (shape == Z_CYLINDER || strcmp(arg[iarg + k], "NULL") != 0)
            found[k] = utils::numeric(FLERR, arg[iarg + k], false, lmp);
    low = found[0] == nowhere ? -nowhere : found[0];
    high = found[1];
    return iarg + count;
}

void FixWallRestitute::read_motion(int iarg, int narg, char **arg)
{
    if (iarg == narg) return;
    const bool shears = !strcmp(arg[iarg], "shear"), wiggles = !strcmp(arg[iarg], "wiggle");
    if ((!shears && !wiggles) || iarg + (shears ? 3 : 4) != narg)
        error->all(FLERR, "fix wall/restitute: '{}': must be shear AXIS V or wiggle AXIS AMPLITUDE PERIOD", arg[iarg]);
    axis = arg[iarg + 1][0] - 'x';
    if (axis < 0 || axis > 2 || arg[iarg + 1][1]) error->all(FLERR, "fix wall/restitute: '{}': must be x, y or z", arg[iarg + 1]);
    if (shears && (shape == Z_CYLINDER ? axis != Z_PLANE : axis == (int)shape))
        error->all(FLERR, "fix wall/restitute: shear must be along the wall");
    if (shears) speed = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    if (wiggles) amplitude = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
    if (wiggles) period = utils::numeric(FLERR, arg[iarg + 3], false, lmp);
    if (wiggles && !(period > 0)) error->all(FLERR, "fix wall/restitute: the period must be > 0");
}

int FixWallRestitute::setmask()
{
    return POST_FORCE | POST_RUN;
}

void FixWallRestitute::init()
{
    frozen = restitute_frozen(lmp);
    model->record = Record();
    warned = false;
    reset_dt();
}

void FixWallRestitute::reset_dt()
{
    model->set_step(update->dt);
}

void FixWallRestitute::setup(int vflag)
{
    post_force(vflag);
}

/* ---------------------------------------------------------------------------------------------- a time step */

/* Velocities of spheres are those of the middle of the step; so is that of a wall that wiggles. */
void FixWallRestitute::move()
{
    if (axis < 0) return;
    velocity[axis] = speed;
    if (!(period > 0)) return;
    const double omega = 2 * 3.14159265358979323846 / period, time = (double)(update->ntimestep - started) * update->dt;
    shift[axis] = amplitude * (1 - cos(omega * time));
    velocity[axis] = amplitude * omega * sin(omega * (time - 0.5 * update->dt));
}

/* The nearest point of the wall; false: infinitely far. */
bool FixWallRestitute::nearest(const double *x, double *point) const
{
    std::copy_n(x, 3, point);
    if (shape == Z_CYLINDER) {
        const double dx = x[0] - shift[0], dy = x[1] - shift[1], r = sqrt(dx * dx + dy * dy);
        if (r == 0) return false;
        point[0] = shift[0] + dx * low / r;
        point[1] = shift[1] + dy * low / r;
        return true;
    }
    const double a = low + shift[shape], b = high + shift[shape];
    point[shape] = x[shape] - a < b - x[shape] ? a : b;
    return std::fabs(point[shape]) < 0.5 * nowhere;
}

void FixWallRestitute::post_force(int)
{
    const Spheres spheres(atom, frozen);
    move();
    std::fill_n(force_on_wall, 3, 0.0);
    summed = false;
    for (int i = 0; i < atom->nlocal; i++)
        if (atom->mask[i] & groupbit) compute_contact(i, spheres.body(i), history[i][0] == 0 ? spheres.density(i) : 0);
    if (model->record.coarse == 0 || warned) return;
    warned = true;
    error->warning(FLERR, "restitute: a contact with a wall began at step {} that needs a time step of {:.3g} or less, not {:.3g}",
                   update->ntimestep, model->record.shortest, update->dt);
}

/* Body 1 is the sphere. */
void FixWallRestitute::compute_contact(int i, const Body &sphere, double density)
{
    static const double still[3] = {};
    double point[3], f[3];
    Contact c;
    if (!nearest(sphere.position, point) || !touching(sphere, {point, velocity, still, 0, 0}, c)) {
        if (history[i][0] != 0) set_arrays(i);
        return;
    }
    const char *problem =
        update->setupflag ? model->repeat(c, history[i], f) : model->advance(c, density, true, history[i], f);
    if (problem)
        error->one(FLERR, "fix wall/restitute {}: contact of atom {} at step {}: {}", id, atom->tag[i], update->ntimestep, problem);
    const double *n = c.normal;
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        atom->f[i][k] += f[k];
        atom->torque[i][k] += c.arm1 * (n[l] * f[m] - n[m] * f[l]);
        force_on_wall[k] -= f[k];
    }
}

/* ---------------------------------------------------------------------------------------------- what was met */

/* Force on the wall (3), steps of contacts, first touches, contacts beyond a/R and beyond v/c_s. */
double FixWallRestitute::compute_vector(int n)
{
    if (n < 3) {
        if (!summed) MPI_Allreduce(force_on_wall, force_on_all, 3, MPI_DOUBLE, MPI_SUM, world);
        summed = true;
        return force_on_all[n];
    }
    const Record all = restitute_sum(model->record, world);
    const double counts[] = {all.steps, all.contacts, all.wide, all.fast};
    return counts[n - 3];
}

void FixWallRestitute::post_run()
{
    const Record all = restitute_sum(model->record, world);
    if (comm->me == 0) utils::logmesg(lmp, "fix wall/restitute {}:\n{}", id, all.text());
}

/* ---------------------------------------------------------------------------------------------- memory */

void FixWallRestitute::grow_arrays(int nmax)
{
    memory->grow(history, nmax, history_size, "wall/restitute:history");
}

void FixWallRestitute::copy_arrays(int i, int j, int)
{
    std::copy_n(history[i], history_size, history[j]);
}

void FixWallRestitute::set_arrays(int i)
{
    std::fill_n(history[i], history_size, 0.0);
}

int FixWallRestitute::pack_exchange(int i, double *buffer)
{
    std::copy_n(history[i], history_size, buffer);
    return history_size;
}

int FixWallRestitute::unpack_exchange(int i, double *buffer)
{
    std::copy_n(buffer, history_size, history[i]);
    return history_size;
}

/* LAMMPS wants the length first, itself included. */
int FixWallRestitute::pack_restart(int i, double *buffer)
{
    buffer[0] = size_restart(i);
    std::copy_n(history[i], history_size, buffer + 1);
    return size_restart(i);
}

void FixWallRestitute::unpack_restart(int i, int nth)
{
    const double *values = atom->extra[i];
    for (int k = 0; k < nth; k++)
        values += (int)*values;
    std::copy_n(values + 1, history_size, history[i]);
}

int FixWallRestitute::size_restart(int)
{
    return history_size + 1;
}

int FixWallRestitute::maxsize_restart()
{
    return history_size + 1;
}

/* The law and the start of the motion. */
void FixWallRestitute::write_restart(FILE *file)
{
    const uint64_t values[] = {model->hash(), (uint64_t)started};
    const int size = sizeof values;
    if (comm->me) return;
    fwrite(&size, sizeof size, 1, file);
    fwrite(values, sizeof values, 1, file);
}

void FixWallRestitute::restart(char *buffer)
{
    uint64_t values[2];
    memcpy(values, buffer, sizeof values);
    started = (bigint)values[1];
    if (values[0] != model->hash())
        error->all(FLERR, "fix wall/restitute {}: the restart file was written with law {:016x}, this is {:016x} of '{}'", id,
                   values[0], model->hash(), model->words[0]);
}

double FixWallRestitute::memory_usage()
{
    return (double)atom->nmax * history_size * sizeof(double);
}
