/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "pair_restitute.h"

#include "host.h"
#include "lammps_declarations.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace LAMMPS_NS;
using restitute_dem::Batch;
using restitute_dem::ContactModel;
using restitute_dem::Record;

PairRestitute::PairRestitute(LAMMPS *lmp) : Pair(lmp)
{
    restartinfo = 1;
    single_enable = 0; /* LAMMPS refuses commands that need the force of one pair without its memory */
    no_virial_fdotr_compute = 1;
    centroidstressflag = CENTROID_NOTAVAIL;
    finitecutflag = 1;
    nondefault_history_transfer = 1; /* a state is oriented by tags: the swap of two atoms copies it */
    nextra = 4;
    pvector = new double[nextra];
    history_id = "NEIGH_HISTORY_RESTITUTE"; /* by this name a restart file finds its fix */
    while (modify->get_fix_by_id(history_id) || modify->get_fix_by_id(history_id + "_DUMMY"))
        history_id += "_MORE";                        /* of pair_style hybrid */
    modify->add_fix(history_id + "_DUMMY all DUMMY"); /* keeps its position before fixes that migrate atoms */
}

PairRestitute::~PairRestitute()
{
    delete[] pvector;
    modify->delete_fix(histories ? history_id : history_id + "_DUMMY");
    if (!allocated) return;
    memory->destroy(setflag);
    memory->destroy(cutsq);
}

/* ---- input script */

void PairRestitute::settings(int narg, char **)
{
    if (narg) error->all(FLERR, "pair_style restitute: takes no arguments; they belong to pair_coeff");
}

void PairRestitute::allocate()
{
    width = atom->ntypes + 1;
    table.resize(width * width);
    memory->create(setflag, width, width, "restitute:setflag");
    memory->create(cutsq, width, width, "restitute:cutsq");
    std::fill_n(&setflag[0][0], width * width, 0);
    allocated = 1;
}

void PairRestitute::coeff(int narg, char **arg)
{
    int first_i, last_i, first_j, last_j;
    if (narg < 3) error->all(FLERR, "pair_coeff of restitute: needs two types, FILE and friction MU");
    if (!allocated) allocate();
    utils::bounds(FLERR, arg[0], 1, atom->ntypes, first_i, last_i, error);
    utils::bounds(FLERR, arg[1], 1, atom->ntypes, first_j, last_j, error);
    const Model made = make_model(lmp, "pair_coeff of restitute", arg + 2, arg + narg);
    if (first_i > last_j) error->all(FLERR, "pair_coeff of restitute: types {} {}: must ascend", arg[0], arg[1]);
    for (int i = first_i; i <= last_i; i++)
        for (int j = std::max(first_j, i); j <= last_j; j++) {
            model(i, j) = made;
            setflag[i][j] = 1;
        }
}

/* ---- before a run */

void PairRestitute::init_style()
{
    frozen = check_host(lmp, "pair_style restitute");
    neighbor->add_request(this, NeighConst::REQ_SIZE | NeighConst::REQ_HISTORY);
    check_restart();
    models.clear();
    for (const Model &its : table)
        if (its && std::find(models.begin(), models.end(), its) == models.end()) models.push_back(its);
    batches.clear();
    for (const Model &its : models) {
        its->record = Record();
        batches.push_back(its->make_batch());
    }
    std::fill_n(warned, restitute_dem::RATIOS, false);
    keep_history();
    /* write_restart makes the fix gather contacts from neighbor lists. That is right within a run,
     * for which compute() sets this to 1. Between runs the fix has the contacts already, and the
     * lists are of atoms in other places. */
    histories->restart_global = 0;
    check_tags();
    change_pages();
    find_largest_radii();
    reset_dt();
}

void PairRestitute::reset_dt()
{
    for (const Model &its : models)
        if (const char *problem = its->set_step(update->dt)) error->all(FLERR, "pair_style restitute: {}", problem);
}

void PairRestitute::check_restart()
{
    for (size_t k = 0; k < restarted.size(); k++)
        if (table[k] && restarted[k])
            check_law(lmp, fmt::format("pair_style restitute: types {} {}", k / width, k % width), restarted[k],
                      *table[k]);
    restarted.clear();
}

/* The fix of LAMMPS that carries the states of contacts through neighbor lists, processes and
 * restart files. */
void PairRestitute::keep_history()
{
    int size = 0;
    for (const Model &its : models)
        size = std::max(size, its->history_size());
    if (size > history_size && histories)
        error->all(FLERR, "pair_coeff of restitute: contacts need {} numbers now, {} in the runs before", size,
                   history_size);
    if (histories) return;
    const std::string fix = history_id + " all NEIGH_HISTORY " + std::to_string(size);
    histories = static_cast<FixNeighHistory *>(modify->replace_fix(history_id + "_DUMMY", fix, 1));
    histories->pair = this;
    history_size = size;
    page = neighbor->pgsize, one = neighbor->oneatom;
    for (const Model &its : models)
        if (comm->me == 0) utils::logmesg(lmp, its->about());
}

/* A contact is labelled with the sum of the tags of its spheres. The fix keeps the tag of the
 * partner, and forgets the contact when a command gives the spheres other tags. */
void PairRestitute::check_tags()
{
    std::vector<double> kept; /* of a sphere: how many partners, and of each its tag and the history */
    for (int i = 0; i < atom->nlocal; i++) {
        kept.resize(histories->size_restart(i));
        const int size = histories->pack_exchange(i, kept.data());
        for (int k = 1; k < size; k += 1 + history_size) {
            const double partner = kept[k] < 1 ? (double)ubuf(kept[k]).i : kept[k]; /* as new LAMMPS packs it, or old */
            if (kept[k + 1] != 0 && std::fabs(kept[k + 1]) != atom->tag[i] + partner)
                error->one(FLERR,
                           "pair_style restitute: atom {} had another ID when it touched its neighbors last. Contacts "
                           "are identified by IDs: do not use reset_atoms id, and use delete_atoms with 'compress no'",
                           atom->tag[i]);
        }
    }
}

/* The fix drops its pages, and the contacts in them, when `neigh_modify page` or `one` has
 * changed. */
void PairRestitute::change_pages()
{
    if (page == neighbor->pgsize && one == neighbor->oneatom) return;
    if (neighbor->pgsize < 10 * neighbor->oneatom)
        error->all(FLERR, "pair_style restitute: neigh_modify page {}: must be at least ten times 'one', {}",
                   neighbor->pgsize, neighbor->oneatom);
    std::vector<double> kept;
    for (int i = 0; i < atom->nlocal; i++) {
        const size_t start = kept.size();
        kept.resize(start + histories->size_restart(i));
        kept.resize(start + histories->pack_exchange(i, &kept[start]));
        if (kept[start] > neighbor->oneatom)
            error->one(FLERR,
                       "pair_style restitute: neigh_modify one {}: must be at least {:.0f}, as many as atom {} touches",
                       neighbor->oneatom, kept[start], atom->tag[i]);
    }
    page = neighbor->pgsize, one = neighbor->oneatom;
    histories->init();
    size_t next = 0;
    for (int i = 0; i < atom->nlocal; i++)
        next += histories->unpack_exchange(i, &kept[next]);
}

/* Of each type. Fixes that create spheres, such as pour and deposit, answer extract("radius",
 * type). Under `fix adapt` spheres may grow by half of the skin: LAMMPS looks for neighbors only as
 * far as the cutoffs of init_one() say. */
void PairRestitute::find_largest_radii()
{
    std::vector<double> own(width, 0.0);
    for (int i = 0; i < atom->nlocal; i++)
        own[atom->type[i]] = std::max(own[atom->type[i]], atom->radius[i]);
    for (Fix *fix : modify->get_fix_list())
        for (int type = 1; type < width; type++) {
            int its = type;
            if (const void *radius = fix->extract("radius", its))
                own[type] = std::max(own[type], *static_cast<const double *>(radius));
        }
    largest_radius.resize(width);
    MPI_Allreduce(own.data(), largest_radius.data(), width, MPI_DOUBLE, MPI_MAX, world);
    if (!modify->get_fix_by_style("^adapt").empty())
        for (double &radius : largest_radius)
            radius += 0.5 * neighbor->skin;
}

double PairRestitute::init_one(int i, int j)
{
    if (!model(i, j))
        error->all(FLERR, "pair_coeff of restitute: none for types {} {}; two materials take 'partner FILE'", i, j);
    return largest_radius[i] + largest_radius[j];
}

/* ---- a time step */

/* Of the model of two types. */
int PairRestitute::number(int i, int j)
{
    return (int)(std::find(models.begin(), models.end(), model(i, j)) - models.begin());
}

static void prefetch(const double *place)
{
#ifdef __GNUC__
    __builtin_prefetch(place, 1);
#else
    (void)place;
#endif
}

void PairRestitute::compute(int eflag, int vflag)
{
    const Spheres spheres(atom, frozen);
    double **x = atom->x, *radius = atom->radius;
    ev_init(eflag, vflag);
    histories->restart_global = 1;
    const double change = change_of_box();
    const bool several = models.size() > 1;
    for (const Model &its : models)
        its->drift = change;
    for (int ii = 0; ii < list->inum; ii++) {
        const int i = list->ilist[ii], *neighbors = list->firstneigh[i];
        int *touched = histories->firstflag[i];
        double *history = histories->firstvalue[i];
        check_radius(i);
        for (int jj = 0; jj < list->numneigh[i]; jj++, history += history_size) {
            const int j = neighbors[jj] & NEIGHMASK;
            const double dx = x[i][0] - x[j][0], dy = x[i][1] - x[j][1], dz = x[i][2] - x[j][2];
            const double sum = radius[i] + radius[j];
            if (dx * dx + dy * dy + dz * dz < sum * sum) {
                touched[jj] = 1;
                const int its = several ? number(atom->type[i], atom->type[j]) : 0;
                collect(*models[its], *batches[its], i, j, history);
            } else if (touched[jj]) {
                touched[jj] = 0;
                std::fill_n(history, history_size, 0.0);
            }
        }
    }
    for (size_t k = 0; k < models.size(); k++)
        compute_batch(*models[k], *batches[k]);
    const Record own = record(); /* for `compute ID all pair restitute` */
    const double values[] = {own.steps, own.contacts, own.beyond[restitute_dem::RADIUS],
                             own.beyond[restitute_dem::SPEED]};
    std::copy_n(values, nextra, pvector);
    warn(lmp, own, warned);
}

/* Largest change of a side or a tilt since the last step. Periodic images and the spheres that
 * `fix deform` maps move by as much, without velocities. With `remap v` they have them. Sides that
 * LAMMPS wraps around the spheres move no sphere. */
double PairRestitute::change_of_box()
{
    std::vector<double> now = {domain->prd[0], domain->prd[1], domain->prd[2], domain->xy, domain->xz, domain->yz};
    double change = 0;
    for (int k = 0; k < 3; k++)
        if (std::max(domain->boundary[k][0], domain->boundary[k][1]) >= 2) now[k] = 0;
    for (size_t k = 0; k < box.size(); k++)
        change = std::max(change, std::fabs(now[k] - box[k]));
    box = now;
    return domain->deform_vremap ? 0 : change;
}

/* LAMMPS may not find the contacts of a larger sphere. */
void PairRestitute::check_radius(int i)
{
    const double largest = largest_radius[atom->type[i]];
    if (atom->radius[i] > largest)
        error->one(
            FLERR,
            "restitute: atom {} at step {}: radius {:.6g}: must be at most {:.6g}, the largest of type {} when the "
            "run began, plus half of the skin under fix adapt. Begin a new run when radii have grown, or take a "
            "larger skin",
            atom->tag[i], update->ntimestep, atom->radius[i], largest, atom->type[i]);
}

/* The atom with the smaller tag is body 1: in every list, on every process. */
void PairRestitute::collect(ContactModel &its, Batch &b, int i, int j, double *history)
{
    const bool ordered = atom->tag[i] < atom->tag[j];
    b.first[b.n] = ordered ? i : j;
    b.second[b.n] = ordered ? j : i;
    b.history[b.n] = history;
    for (int k = 0; k < history_size; k += 8)
        prefetch(history + k);
    if (++b.n == Batch::SIZE) compute_batch(its, b);
}

void PairRestitute::compute_batch(ContactModel &its, Batch &b)
{
    const Spheres spheres(atom, frozen);
    const char *problem;
    int n = 0;
    for (int k = 0; k < b.n; k++) {
        const int i = b.first[k], j = b.second[k];
        if (!touching(spheres.body(i), spheres.body(j), b, n)) continue;
        const bool twice = std::max(i, j) >= atom->nlocal && !force->newton_pair; /* the owner of the other, too */
        b.first[n] = i, b.second[n] = j;
        b.history[n] = b.history[k];
        b.label[n] = (double)atom->tag[i] + atom->tag[j];
        b.density[n] = b.history[k][0] == 0 ? std::max(spheres.density(i), spheres.density(j)) : 0;
        b.on_record[n++] = !twice || i < atom->nlocal;
    }
    b.n = n;
    const int bad = update->setupflag ? its.repeat(b, &problem) : its.advance(b, &problem);
    if (bad >= 0)
        error->one(FLERR, "restitute: atoms {} and {} at step {}: {}", atom->tag[b.first[bad]],
                   atom->tag[b.second[bad]], update->ntimestep, problem);
    for (int k = 0; k < b.n; k++)
        apply(b, k);
    b.n = 0;
}

static void add_to(double *force, double *torque, double sign, const double *f, double arm, const double *turn)
{
    for (int i = 0; i < 3; i++) {
        force[i] += sign * f[i];
        torque[i] += arm * turn[i];
    }
}

void PairRestitute::apply(const Batch &batch, int k)
{
    const int first = batch.first[k], second = batch.second[k];
    const double *n = batch.motion[k].normal, *f = batch.force[k];
    const double turn[3] = {n[1] * f[2] - n[2] * f[1], n[2] * f[0] - n[0] * f[2], n[0] * f[1] - n[1] * f[0]};
    const bool all = force->newton_pair;
    if (all || first < atom->nlocal) add_to(atom->f[first], atom->torque[first], 1, f, batch.arm1[k], turn);
    if (all || second < atom->nlocal) add_to(atom->f[second], atom->torque[second], -1, f, batch.arm2[k], turn);
    if (!evflag) return;
    const double *a = atom->x[first], *b = atom->x[second];
    ev_tally_xyz(first, second, atom->nlocal, all, 0, 0, f[0], f[1], f[2], a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Record PairRestitute::record() const
{
    Record own;
    for (const Model &its : models)
        own.add(its->record);
    return own;
}

/* The limits shown are those of the first law. */
void PairRestitute::finish()
{
    const Record all = sum_of(record(), world);
    if (comm->me == 0) utils::logmesg(lmp, all.text(models[0]->limits));
}

/* ---- restart files */

void PairRestitute::transfer_history(double *source, double *target, int, int)
{
    std::copy_n(source, history_size, target);
}

/* For each pair of types the arguments, one a line, and the hash of the law. The fix writes the
 * states of contacts. */
void PairRestitute::write_restart(FILE *file)
{
    for (const Model &its : table) {
        const uint64_t hash = its ? its->hash() : 0;
        std::string line;
        if (its)
            for (const std::string &word : its->words)
                line += word + '\n';
        const int length = (int)line.size();
        fwrite(&length, sizeof length, 1, file);
        fwrite(line.data(), 1, line.size(), file);
        fwrite(&hash, sizeof hash, 1, file);
    }
}

/* What the first process reads, for all. */
static void read_bytes(LAMMPS *lmp, FILE *file, void *bytes, int count)
{
    if (lmp->comm->me == 0 && count) utils::sfread(FLERR, bytes, 1, count, file, nullptr, lmp->error);
    MPI_Bcast(bytes, count, MPI_BYTE, 0, lmp->world);
}

void PairRestitute::read_restart(FILE *file)
{
    std::map<std::string, Model> made;
    allocate();
    restarted.resize(table.size());
    for (size_t k = 0; k < table.size(); k++) {
        int length;
        read_bytes(lmp, file, &length, sizeof length);
        std::string line(length, ' ');
        read_bytes(lmp, file, &line[0], length);
        read_bytes(lmp, file, &restarted[k], sizeof restarted[k]);
        if (length == 0) continue;
        auto words = utils::split_lines(line);
        std::vector<char *> pointers;
        for (std::string &word : words)
            pointers.push_back(&word[0]);
        Model &its = made[line];
        if (!its)
            its = make_model(lmp, "restart of pair_style restitute", pointers.data(), pointers.data() + words.size());
        table[k] = its;
        setflag[k / width][k % width] = 1;
    }
}
