/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "pair_restitute.h"

#include "host.h"
#include "lammps_declarations.h"

#include "comm.h"
#include "compute.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace LAMMPS_NS;
using restitute_dem::ContactModel;
using restitute_dem::Record;

PairRestitute::PairRestitute(LAMMPS *lmp) : Pair(lmp)
{
    restartinfo = 1;
    single_enable = 1;
    no_virial_fdotr_compute = 1;
    centroidstressflag = CENTROID_NOTAVAIL;
    finitecutflag = 1;
    nondefault_history_transfer = 1; /* a state is oriented by tags: the swap of two atoms copies it */
    nextra = 7;
    pvector = new double[nextra];
    single_extra = 17;
    svector = new double[single_extra];
    warn_of_suffix(lmp, "pair_style restitute");
    history_id = "NEIGH_HISTORY_RESTITUTE"; /* by this name a restart file finds its fix */
    while (modify->get_fix_by_id(history_id) || modify->get_fix_by_id(history_id + "_DUMMY"))
        history_id += "_MORE";                        /* of pair_style hybrid */
    modify->add_fix(history_id + "_DUMMY all DUMMY"); /* keeps its position before fixes that migrate atoms */
}

PairRestitute::~PairRestitute()
{
    delete[] pvector;
    delete[] svector;
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
    check_computes();
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
    has_details = std::any_of(models.begin(), models.end(), [](const Model &its) { return its->has_details; });
    beyond_contact = 0; /* until compute(): some computes refuse anything else */
    shrink_pages();
    keep_history();
    /* write_restart makes the fix gather contacts from neighbor lists. That is right within a run,
     * for which compute() sets this to 1. Between runs the fix has the contacts already, and the
     * lists are of atoms in other places. */
    histories->restart_global = 0;
    check_tags();
    change_pages();
    find_largest_radii();
    reset_dt();
    report_limits();
}

/* These take forces of pairs along the line between the centers only. */
void PairRestitute::check_computes()
{
    for (const char *style :
         {"^group/group", "^stress/mop", "^stress/cartesian", "^stress/cylinder", "^stress/spherical"})
        for (const Compute *found : modify->get_compute_by_style(style))
            error->all(FLERR, "pair_style restitute: compute {} {}: is not supported, it leaves out tangential forces",
                       found->id, found->style);
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
    histories = static_cast<FixNeighHistory *>(modify->replace_fix(history_id + "_DUMMY", fix, 0)); /* 0: no suffix */
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

/* The default, 100000, reserves 80 MB for a standard solid. LAMMPS demands ten times `one`. */
void PairRestitute::shrink_pages()
{
    if (neighbor->pgsize == 100000) neighbor->pgsize = std::min(neighbor->pgsize, 10 * neighbor->oneatom);
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

/* For impacts of the lightest spheres of each two types. */
void PairRestitute::report_limits()
{
    std::vector<double> mass, radius;
    find_lightest(lmp, mass, radius);
    for (int i = 1; i < width; i++)
        for (int j = i; j < width; j++)
            if (const Model &its = model(i, j))
                report_limit(lmp, fmt::format("types {} {}, radii {:.6g} and {:.6g}", i, j, radius[i], radius[j]), *its,
                             1 / (1 / mass[i] + 1 / mass[j]), 1 / (1 / radius[i] + 1 / radius[j]));
}

double PairRestitute::init_one(int i, int j)
{
    if (!model(i, j))
        error->all(FLERR, "pair_coeff of restitute: none for types {} {}; two materials take 'partner FILE'", i, j);
    return largest_radius[i] + largest_radius[j];
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
