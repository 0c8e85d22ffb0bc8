/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "fix_wall_restitute.h"

#include "host.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using restitute_dem::Batch;
using restitute_dem::Record;

static const char *const shapes[] = {"xplane", "yplane", "zplane", "zcylinder"};
static const double nowhere = 1e99; /* of the plane that there is not */

/* fix ID group wall/restitute FILE friction MU [...] xplane|yplane|zplane LOW HIGH [shear AXIS V]
 *                                                    zcylinder RADIUS [shear z V] */
FixWallRestitute::FixWallRestitute(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
    char **end = arg + narg;
    char **place = std::find_first_of(arg + 3, end, shapes, shapes + 4, [](auto a, auto b) { return !strcmp(a, b); });
    model = make_model(lmp, "fix wall/restitute", arg + 3, place);
    if (place == end) error->all(FLERR, "fix wall/restitute: needs xplane, yplane, zplane or zcylinder");
    batch = model->make_batch();
    batch->label[0] = 1;
    batch->on_record[0] = true;
    shape = (Shape)(std::find(shapes, shapes + 4, std::string(*place)) - shapes);
    const int numbers = shape == Z_CYLINDER ? 1 : 2;
    if (end - place <= numbers) error->all(FLERR, "fix wall/restitute: {} needs a position", *place);
    const auto at = [&](int k) {
        return strcmp(place[k], "NULL") ? utils::numeric(FLERR, place[k], false, lmp) : nowhere;
    };
    low = at(1) == nowhere ? -nowhere : at(1);
    high = at(numbers);
    read_shear(place + numbers + 1, (int)(end - place) - numbers - 1);
    if (shape == Z_CYLINDER ? domain->xperiodic || domain->yperiodic : domain->periodicity[shape])
        error->all(FLERR, "fix wall/restitute: the box is periodic across the wall");
    restart_peratom = restart_global = create_attribute = vector_flag = extvector = global_freq = 1;
    size_vector = 7;
    maxexchange = history_size = model->history_size();
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
    for (int i = 0; i < atom->nlocal; i++)
        set_arrays(i);
    if (comm->me == 0) utils::logmesg(lmp, model->about());
}

FixWallRestitute::~FixWallRestitute()
{
    atom->delete_callback(id, Atom::GROW);
    atom->delete_callback(id, Atom::RESTART);
    memory->destroy(history);
}

void FixWallRestitute::read_shear(char **word, int words)
{
    if (words == 0) return;
    const std::string axis = words == 3 && !strcmp(word[0], "shear") ? word[1] : "";
    const int k = axis == "x" ? 0 : axis == "y" ? 1 : axis == "z" ? 2 : -1;
    if (k < 0 || (shape == Z_CYLINDER ? k != 2 : k == (int)shape))
        error->all(FLERR, "fix wall/restitute: '{}': must be shear AXIS V, with an axis along the wall", word[0]);
    velocity[k] = utils::numeric(FLERR, word[2], false, lmp);
}

int FixWallRestitute::setmask()
{
    return POST_FORCE | POST_RUN;
}

void FixWallRestitute::init()
{
    frozen = check_host(lmp, "fix wall/restitute");
    model->record = Record();
    std::fill_n(warned, restitute_dem::RATIOS, false);
    reset_dt();
}

void FixWallRestitute::setup(int vflag)
{
    post_force(vflag);
}

void FixWallRestitute::reset_dt()
{
    if (const char *problem = model->set_step(update->dt)) error->all(FLERR, "fix {} wall/restitute: {}", id, problem);
}

/* ---- a time step */

/* The nearest point of the wall; false: there is none. */
bool FixWallRestitute::nearest(const double *x, double *point) const
{
    std::copy_n(x, 3, point);
    if (shape != Z_CYLINDER) {
        point[shape] = x[shape] - low < high - x[shape] ? low : high;
        return std::fabs(point[shape]) < nowhere;
    }
    const double r = std::sqrt(x[0] * x[0] + x[1] * x[1]);
    for (int k = 0; k < 2; k++)
        point[k] *= low / r;
    return r > 0;
}

void FixWallRestitute::post_force(int)
{
    const Spheres spheres(atom, frozen);
    double point[3];
    std::fill_n(force_on_wall, 3, 0.0);
    for (int i = 0; i < atom->nlocal; i++) {
        if (!(atom->mask[i] & groupbit)) continue;
        const double *x = atom->x[i];
        const auto square = [&](int k) { return (point[k] - x[k]) * (point[k] - x[k]); };
        if (nearest(x, point) && square(0) + square(1) + square(2) < atom->radius[i] * atom->radius[i])
            compute_contact(i, spheres, point);
        else if (history[i][0] != 0)
            set_arrays(i);
    }
    warn(lmp, model->record, warned);
}

/* Body 1 is the sphere. */
void FixWallRestitute::compute_contact(int i, const Spheres &spheres, const double *point)
{
    static const double still[3] = {};
    const char *problem;
    Batch &b = *batch;
    if (!touching(spheres.body(i), {point, velocity, still, 0, 0}, b, 0)) return;
    b.n = 1;
    b.history[0] = history[i];
    b.density[0] = spheres.density(i);
    if ((update->setupflag ? model->repeat(b, &problem) : model->advance(b, &problem)) >= 0)
        error->one(FLERR, "restitute: atom {} and wall {} at step {}: {}", atom->tag[i], id, update->ntimestep,
                   problem);
    const double *n = b.motion[0].normal, *f = b.force[0], *couple = model->couple(history[i]);
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        atom->f[i][k] += f[k];
        atom->torque[i][k] += b.arm1[0] * (n[l] * f[m] - n[m] * f[l]);
        force_on_wall[k] -= f[k];
        if (couple) atom->torque[i][k] += couple[k];
    }
}

/* Force on the wall (3), steps of contacts, first touches, contacts beyond a/R and beyond v/c_s. */
double FixWallRestitute::compute_vector(int n)
{
    const Record &own = model->record;
    const double values[] = {force_on_wall[0], force_on_wall[1], force_on_wall[2], own.steps,
                             own.contacts,     own.beyond[0],    own.beyond[1]};
    double sum;
    MPI_Allreduce(&values[n], &sum, 1, MPI_DOUBLE, MPI_SUM, world);
    return sum;
}

void FixWallRestitute::post_run()
{
    const Record all = sum_of(model->record, world);
    if (comm->me == 0) utils::logmesg(lmp, "fix {} wall/restitute:\n{}", id, all.text(model->limits));
}

/* ---- states of contacts, one an atom */

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

void FixWallRestitute::write_restart(FILE *file)
{
    const uint64_t hash = model->hash();
    const int size = sizeof hash;
    if (comm->me) return;
    fwrite(&size, sizeof size, 1, file);
    fwrite(&hash, sizeof hash, 1, file);
}

void FixWallRestitute::restart(char *buffer)
{
    uint64_t hash;
    memcpy(&hash, buffer, sizeof hash);
    check_law(lmp, std::string("fix ") + id + " wall/restitute", hash, *model);
}

double FixWallRestitute::memory_usage()
{
    return (double)atom->nmax * history_size * sizeof(double);
}
