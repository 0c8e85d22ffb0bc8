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
using restitute_dem::Batch;
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
    batch = model->make_batch();
    std::fill_n(batch->on_record, Batch::SIZE, true);
    size_peratom_cols = 8;
    restart_peratom = restart_global = create_attribute = vector_flag = extvector = global_freq = peratom_freq = 1;
    virial_global_flag = virial_peratom_flag = 1;
    energy_global_flag = scalar_flag = extscalar = 1;
    size_vector = 10;
    history_size = model->history_size() + 1;
    grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
    atom->add_callback(Atom::RESTART);
    for (int i = 0; i < atom->nlocal; i++)
        set_arrays(i);
    if (comm->me == 0) utils::logmesg(lmp, model->about());
    warn_of_suffix(lmp, "fix wall/restitute");
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
    if (thermo_energy && !model->has_details)
        error->all(FLERR, "fix {} wall/restitute: fix_modify energy yes: needs the words 'details yes' of the law", id);
    reset_dt();
    std::vector<double> mass, radius;
    find_lightest(lmp, mass, radius);
    for (int type = 1; type <= atom->ntypes; type++)
        report_limit(lmp, fmt::format("wall {}, type {}, radius {:.6g}", id, type, radius[type]), *model, mass[type],
                     radius[type]);
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
    if (!update->setupflag) time += update->dt;
    shape->place(time, update->dt);
    v_init(vflag);
    std::fill_n(force_on_wall, 3, 0.0);
    if (peratom_flag && atom->nlocal) std::fill_n(array_atom[0], atom->nlocal * size_peratom_cols, 0.0);
    for (int i = 0; i < atom->nlocal; i++)
        if (atom->mask[i] & groupbit) collect(i);
    compute_batch();
    warn(lmp, model->record, warned);
}

/* Adds the contacts of a sphere to the batch, all of them to the same one. */
void FixWallRestitute::collect(int i)
{
    Batch &b = *batch;
    const Spheres spheres(atom, frozen);
    points.clear();
    shape->touch(atom->x[i], atom->radius[i], points);
    if (points.empty() && histories[i].empty()) return;
    if ((int)points.size() > Batch::SIZE)
        error->one(FLERR, "restitute: atom {} and wall {} at step {}: touches {} faces: must be at most {}",
                   atom->tag[i], id, update->ntimestep, points.size(), (int)Batch::SIZE);
    if (b.n + (int)points.size() > Batch::SIZE) compute_batch();
    int last = b.n; /* body 1 is the sphere */
    for (const WallPoint &point : points) {
        if (!touching(spheres.body(i), {point.position, point.velocity, point.spin, 0, 0}, b, last)) continue;
        b.motion[last].radius = effective_radius(i, point);
        b.first[last] = i;
        b.label[last] = point.label;
        b.density[last] = spheres.density(i);
        std::copy_n(point.position, 3, places[last++]);
    }
    find_histories(i, last);
}

/* As of a sphere on one of the mean curvature of the wall. */
double FixWallRestitute::effective_radius(int i, const WallPoint &point) const
{
    const double radius = atom->radius[i], flatter = 1 + radius * point.curvature;
    if (!(flatter > 0))
        error->one(FLERR,
                   "restitute: atom {} and wall {} at step {}: radius {:.6g}: must be below the radius of curvature of "
                   "the wall, {:.6g}",
                   atom->tag[i], id, update->ntimestep, radius, -1 / point.curvature);
    return radius / flatter;
}

/* Of the contacts of a sphere, which are in the batch up to `last`. Histories of others have
 * ended. */
void FixWallRestitute::find_histories(int i, int last)
{
    Batch &b = *batch;
    std::vector<double> &all = histories[i];
    const double *labels = b.label + b.n, *end = b.label + last;
    for (size_t k = all.size(); k > 0;) {
        k -= history_size;
        if (std::find(labels, end, std::fabs(all[k])) != end) continue;
        const restitute_contact_details its = details(&all[k]);
        ended_friction += its.friction;
        ended_viscous += its.stored + its.viscous; /* springs relax */
        all.erase(all.begin() + k, all.begin() + k + history_size);
    }
    const auto find = [&](double label) {
        size_t k = 0;
        while (k < all.size() && std::fabs(all[k]) != label)
            k += history_size;
        return k;
    };
    size_t place[Batch::SIZE];
    for (int k = b.n; k < last; k++) {
        place[k] = find(b.label[k]);
        if (place[k] == all.size()) all.resize(all.size() + history_size);
    }
    for (int k = b.n; k < last; k++) {
        b.history[k] = &all[place[k]];
        b.history[k][history_size - 1] = b.motion[k].radius;
    }
    b.n = last;
}

void FixWallRestitute::compute_batch()
{
    Batch &b = *batch;
    const char *problem;
    const int bad = update->setupflag ? model->repeat(b, &problem) : model->advance(b, &problem);
    if (bad >= 0)
        error->one(FLERR, "restitute: atom {} and wall {} at step {}: {}", atom->tag[b.first[bad]], id,
                   update->ntimestep, problem);
    for (int k = 0; k < b.n; k++)
        apply(k);
    if (peratom_flag) show();
    b.n = 0;
}

void FixWallRestitute::apply(int of_batch)
{
    const int i = batch->first[of_batch];
    const double *n = batch->motion[of_batch].normal, *f = batch->force[of_batch], *x = atom->x[i],
                 *at = places[of_batch];
    const double *couple = model->couple(batch->history[of_batch]);
    const double r[3] = {x[0] - at[0], x[1] - at[1], x[2] - at[2]};
    double virial[6] = {r[0] * f[0], r[1] * f[1], r[2] * f[2], r[0] * f[1], r[0] * f[2], r[1] * f[2]};
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        atom->f[i][k] += f[k];
        atom->torque[i][k] += batch->arm1[of_batch] * (n[l] * f[m] - n[m] * f[l]);
        force_on_wall[k] -= f[k];
        if (couple) atom->torque[i][k] += couple[k];
    }
    if (vflag_either) v_tally(i, virial);
}

/* As LAMMPS's `contacts`: 1, force on the sphere (3), contact point (3), radius. Of several
 * contacts the forces are added, and the point is that of the largest. */
void FixWallRestitute::show()
{
    const Batch &b = *batch;
    double largest = 0;
    for (int k = 0; k < b.n; k++) {
        const double *f = b.force[k], square = f[0] * f[0] + f[1] * f[1] + f[2] * f[2];
        double *row = array_atom[b.first[k]];
        if (k == 0 || b.first[k] != b.first[k - 1]) largest = 0;
        row[0] = 1;
        row[7] = atom->radius[b.first[k]];
        for (int l = 0; l < 3; l++)
            row[1 + l] += f[l];
        if (square < largest) continue;
        largest = square;
        std::copy_n(places[k], 3, row + 4);
    }
}

/* ---- reports */

restitute_contact_details FixWallRestitute::details(const double *history)
{
    return model->details(history[history_size - 1], history);
}

/* Stored, lost to friction, lost in dashpots; of this process. */
void FixWallRestitute::sum_energies(double sum[3])
{
    const double ended[] = {0, ended_friction, ended_viscous};
    std::copy_n(ended, 3, sum);
    for (int i = 0; i < atom->nlocal && model->has_details; i++)
        for (size_t k = 0; k < histories[i].size(); k += history_size) {
            const restitute_contact_details its = details(&histories[i][k]);
            sum[0] += its.stored, sum[1] += its.friction, sum[2] += its.viscous;
        }
}

/* The stored energy, for `fix_modify energy`. */
double FixWallRestitute::compute_scalar()
{
    return compute_vector(7);
}

/* Force on the wall (3), steps of contacts, first touches, contacts beyond a/R and beyond v/c_s,
 * energies (3). */
double FixWallRestitute::compute_vector(int n)
{
    const Record &own = model->record;
    double values[] = {force_on_wall[0],
                       force_on_wall[1],
                       force_on_wall[2],
                       own.steps,
                       own.contacts,
                       own.beyond[0],
                       own.beyond[1],
                       0,
                       0,
                       0};
    double sum;
    if (n >= 7) sum_energies(values + 7);
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
