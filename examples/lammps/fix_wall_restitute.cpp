/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "fix_wall_restitute.h"

#include "host.h"

#include "comm.h"
#include "error.h"
#include "memory.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;
using restitute_dem::Contact;
using restitute_dem::Record;

/* fix ID group wall/restitute FILE friction MU [...]
 *     xplane|yplane|zplane LOW HIGH  or  xcylinder|ycylinder|zcylinder RADIUS  or  region ID
 *     [shear AXIS V | move AXIS V | wiggle AXIS AMPLITUDE PERIOD]  [contacts] */
FixWallRestitute::FixWallRestitute(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
    char **end = arg + narg, **word = std::find_if(arg + 3, end, names_wall);
    model = make_model(lmp, "fix wall/restitute", arg + 3, word);
    if (word == end)
        error->all(FLERR,
                   "fix wall/restitute: needs xplane, yplane, zplane, xcylinder, ycylinder, zcylinder or region");
    shape = make_wall(lmp, word, end);
    peratom_flag = word != end && !strcmp(*word, "contacts");
    if (word + peratom_flag != end)
        error->all(FLERR,
                   "fix wall/restitute: '{}': must be one of shear, move, wiggle (a region has its own motion), then "
                   "contacts",
                   word[peratom_flag]);
    size_peratom_cols = 8;
    restart_peratom = restart_global = create_attribute = vector_flag = extvector = global_freq = peratom_freq = 1;
    virial_global_flag = virial_peratom_flag = 1;
    size_vector = 7;
    history_size = model->history_size();
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
    memory->destroy(array_atom);
}

int FixWallRestitute::setmask()
{
    return POST_FORCE | POST_RUN;
}

void FixWallRestitute::init()
{
    frozen = check_host(lmp, "fix wall/restitute");
    shape->init();
    maxexchange = 1 + shape->faces() * history_size;
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

void FixWallRestitute::post_force(int vflag)
{
    const Spheres spheres(atom, frozen);
    double f[3];
    if (!update->setupflag) time += update->dt;
    shape->place(time, update->dt);
    v_init(vflag);
    std::fill_n(force_on_wall, 3, 0.0);
    for (int i = 0; i < atom->nlocal; i++) {
        double largest = 0;
        if (peratom_flag) std::fill_n(array_atom[i], size_peratom_cols, 0.0);
        if (!(atom->mask[i] & groupbit)) continue;
        find_touches(i, spheres);
        if (!update->setupflag) forget_others(i);
        for (const Touch &touch : touches) {
            compute_contact(i, spheres, touch, f);
            apply(i, touch, f);
            if (peratom_flag) show(i, touch, f, largest);
        }
    }
    warn(lmp, model->record, warned);
}

/* Body 1 is the sphere. The effective radius is that of a sphere on one of the mean curvature of
 * the wall. */
void FixWallRestitute::find_touches(int i, const Spheres &spheres)
{
    const double radius = atom->radius[i];
    points.clear();
    touches.clear();
    shape->touch(atom->x[i], radius, points);
    for (const WallPoint &point : points) {
        Touch touch = {point, {}};
        if (!touching(spheres.body(i), {point.position, point.velocity, point.spin, 0, 0}, touch.contact)) continue;
        const double flatter = 1 + radius * point.curvature;
        if (!(flatter > 0))
            error->one(FLERR,
                       "restitute: atom {} and wall {} at step {}: radius {:.6g}: must be below the radius of "
                       "curvature of the wall, {:.6g}",
                       atom->tag[i], id, update->ntimestep, radius, -1 / point.curvature);
        touch.contact.radius /= flatter;
        touches.push_back(touch);
    }
}

/* Of a contact; NULL: it is new. */
double *FixWallRestitute::find_history(int i, int label)
{
    for (size_t k = 0; k < histories[i].size(); k += history_size)
        if (std::fabs(histories[i][k]) == label) return &histories[i][k];
    return nullptr;
}

/* Deletes the histories of contacts that have ended. */
void FixWallRestitute::forget_others(int i)
{
    std::vector<double> &all = histories[i];
    for (size_t k = 0; k < all.size();) {
        const auto is_its = [&](const Touch &touch) { return touch.point.label == std::fabs(all[k]); };
        if (std::any_of(touches.begin(), touches.end(), is_its))
            k += history_size;
        else
            all.erase(all.begin() + k, all.begin() + k + history_size);
    }
}

/* The force on the sphere. */
void FixWallRestitute::compute_contact(int i, const Spheres &spheres, const Touch &touch, double f[3])
{
    const int label = touch.point.label;
    const char *problem = nullptr;
    double *history = find_history(i, label);
    if (update->setupflag) {
        std::fill_n(f, 3, 0.0);
        if (history) problem = model->repeat(touch.contact, history, f);
    } else {
        if (!history) {
            histories[i].resize(histories[i].size() + history_size);
            history = &histories[i].back() + 1 - history_size;
        }
        problem = model->advance(touch.contact, spheres.density(i), true, history, f, label);
    }
    if (problem)
        error->one(FLERR, "restitute: atom {} and wall {} at step {}: {}", atom->tag[i], id, update->ntimestep,
                   problem);
}

void FixWallRestitute::apply(int i, const Touch &touch, const double f[3])
{
    const double *n = touch.contact.normal, *x = atom->x[i], *point = touch.point.position;
    const double r[3] = {x[0] - point[0], x[1] - point[1], x[2] - point[2]};
    double virial[6] = {r[0] * f[0], r[1] * f[1], r[2] * f[2], r[0] * f[1], r[0] * f[2], r[1] * f[2]};
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        atom->f[i][k] += f[k];
        atom->torque[i][k] += touch.contact.arm1 * (n[l] * f[m] - n[m] * f[l]);
        force_on_wall[k] -= f[k];
    }
    if (vflag_either) v_tally(i, virial);
}

/* As LAMMPS's `contacts`: 1, force on the sphere (3), contact point (3), radius. Of several contacts
 * the forces are added, and the point is that of the largest. */
void FixWallRestitute::show(int i, const Touch &touch, const double f[3], double &largest)
{
    double *row = array_atom[i];
    const double square = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
    row[0] = 1;
    row[7] = atom->radius[i];
    for (int k = 0; k < 3; k++)
        row[1 + k] += f[k];
    if (square < largest) return;
    largest = square;
    std::copy_n(touch.point.position, 3, row + 4);
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

/* ---- histories of contacts */

void FixWallRestitute::grow_arrays(int nmax)
{
    histories.resize(nmax);
    if (peratom_flag) memory->grow(array_atom, nmax, size_peratom_cols, "wall/restitute:array_atom");
}

void FixWallRestitute::copy_arrays(int i, int j, int)
{
    histories[j] = histories[i];
}

void FixWallRestitute::set_arrays(int i)
{
    histories[i].clear();
    if (peratom_flag) std::fill_n(array_atom[i], size_peratom_cols, 0.0);
}

/* How many numbers follow, and these. */
int FixWallRestitute::pack_exchange(int i, double *buffer)
{
    buffer[0] = (double)histories[i].size();
    std::copy(histories[i].begin(), histories[i].end(), buffer + 1);
    return 1 + (int)histories[i].size();
}

int FixWallRestitute::unpack_exchange(int i, double *buffer)
{
    histories[i].assign(buffer + 1, buffer + 1 + (int)buffer[0]);
    return 1 + (int)buffer[0];
}

/* LAMMPS wants the length first, itself included. */
int FixWallRestitute::pack_restart(int i, double *buffer)
{
    buffer[0] = size_restart(i);
    std::copy(histories[i].begin(), histories[i].end(), buffer + 1);
    return size_restart(i);
}

void FixWallRestitute::unpack_restart(int i, int nth)
{
    const double *values = atom->extra[i];
    for (int k = 0; k < nth; k++)
        values += (int)*values;
    histories[i].assign(values + 1, values + (int)*values);
}

int FixWallRestitute::size_restart(int i)
{
    return 1 + (int)histories[i].size();
}

int FixWallRestitute::maxsize_restart()
{
    return 1 + shape->faces() * history_size;
}

struct FixState {
    uint64_t hash;
    double time;
};

void FixWallRestitute::write_restart(FILE *file)
{
    const FixState state = {model->hash(), time};
    const int size = sizeof state;
    if (comm->me) return;
    fwrite(&size, sizeof size, 1, file);
    fwrite(&state, sizeof state, 1, file);
}

void FixWallRestitute::restart(char *buffer)
{
    FixState state;
    memcpy(&state, buffer, sizeof state);
    check_law(lmp, std::string("fix ") + id + " wall/restitute", state.hash, *model);
    time = state.time;
}

double FixWallRestitute::memory_usage()
{
    double bytes = 0;
    for (const std::vector<double> &its : histories)
        bytes += (double)(sizeof its + its.capacity() * sizeof(double));
    return bytes;
}
