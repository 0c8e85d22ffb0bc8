/* SPDX-License-Identifier: GPL-2.0-or-later */
#include "fix_restitute.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_contact_history.h"
#include "force.h"
#include "input.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_gran.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace FixConst;
using restitute_dem::Record;

FixRestitute::FixRestitute(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
    nevery = restart_global = vector_flag = extvector = global_freq = 1;
    size_vector = 4;
    read_laws();
}

FixRestitute *FixRestitute::of(LAMMPS *lmp)
{
    return static_cast<FixRestitute *>(lmp->modify->find_fix_style_strict("restitute", 0));
}

int FixRestitute::setmask()
{
    return END_OF_STEP | POST_RUN;
}

int FixRestitute::history_size(bool is_wall) const
{
    return states + (is_wall ? NUMBERS_OF_WALLS : NUMBERS_OF_PAIRS);
}

const FixRestitute::Model &FixRestitute::model(int i, int j) const
{
    return table[std::min(i, j) * (atom->ntypes + 1) + std::max(i, j)];
}

void FixRestitute::refuse(const std::string &what) const
{
    static std::string text; /* LIGGGHTS prints it when this function has been left */
    text = "model restitute: " + what;
    error->all(FLERR, text.c_str());
    throw; /* never: error->all ends the run */
}

void FixRestitute::print(const std::string &text) const
{
    for (FILE *file : {screen, logfile})
        if (comm->me == 0 && file) fputs(text.c_str(), file);
}

/* ---- input script */

static std::string types(int i, int j)
{
    return "types " + std::to_string(i) + " " + std::to_string(j);
}

/* Of the variable restitute_I_J or else restitute; variables in it are replaced. "": there is
 * neither. */
std::string FixRestitute::words_of(int i, int j) const
{
    std::string name = "restitute_" + std::to_string(i) + "_" + std::to_string(j);
    if (input->variable->find(&name[0]) < 0) name = "restitute";
    const char *found = input->variable->find(&name[0]) < 0 ? nullptr : input->variable->retrieve(&name[0]);
    if (!found) return "";
    int size = (int)strlen(found) + 1, work_size = size;
    auto line = (char *)memory->smalloc(size, "restitute:line"), work = (char *)memory->smalloc(size, "restitute:work");
    strcpy(line, found);
    input->substitute(line, work, size, work_size, 0);
    const std::string words = line;
    memory->sfree(line);
    memory->sfree(work);
    return words;
}

void FixRestitute::read_laws()
{
    const std::string units = update->unit_style;
    if (units != "si" && units != "cgs")
        refuse("units " + units + ": must be si or cgs, since files of materials are in Pa, s and kg/m^3");
    const restitute_dem::Units in_si = units == "si" ? restitute_dem::Units{1, 1} : restitute_dem::Units{0.1, 1000};
    const int width = atom->ntypes + 1;
    std::map<std::string, Model> made;
    table.assign(width * width, nullptr);
    models.clear();
    for (int i = 1; i < width; i++)
        for (int j = i; j < width; j++) {
            const std::string line = words_of(i, j);
            if (line == "") continue;
            std::istringstream stream(line);
            const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
            Model &its = made[line];
            try {
                if (!its) models.push_back(its = std::make_shared<Law>(words, in_si));
            } catch (const std::invalid_argument &problem) {
                refuse(types(i, j) + ": " + problem.what());
            }
            if (its->has_resistance() || its->speed != 0)
                refuse(types(i, j) + ": rolling, twisting and speed are for LAMMPS; take rolling_friction cdt here");
            table[i * width + j] = its;
        }
    if (models.empty())
        refuse("no law: before the pair_style comes, for example, variable restitute string \"bead.json friction 0.5\" "
               "for all types, restitute_1_2 for types 1 and 2");
    states = 0;
    for (const Model &its : models) {
        states = std::max(states, its->history_size());
        print(its->about());
    }
}

/* ---- before a run */

/* The fix of PairGran is private. An explicit instantiation may name private members. */
template <FixContactHistory *PairGran::*member> struct Open {
    friend void give_history(PairGran *pair, FixContactHistory *history)
    {
        pair->*member = history;
    }
};
template struct Open<&PairGran::fix_history>;
void give_history(PairGran *pair, FixContactHistory *history);

/* PairGran makes the fix with its contacts' histories itself, but writes their length into three
 * characters. */
void FixRestitute::make_long_history(PairGran *pair)
{
    const int size = pair->dnum_pair();
    if (size < 100) return;
    const std::string length = std::to_string(size);
    std::vector<const char *> words = {"contacthistory", "all", "contacthistory", length.c_str()};
    for (int k = 0; k < size; k++)
        words.insert(words.end(), {"restitute", "0"});
    modify->add_fix((int)words.size(), const_cast<char **>(words.data()));
    give_history(pair, static_cast<FixContactHistory *>(modify->find_fix_style_strict("contacthistory", 0)));
}

void FixRestitute::init()
{
    if (update->whichflag == 2) refuse("its contacts need time steps, not a minimizer");
    if (strcmp(update->integrate_style, "verlet")) refuse("needs run_style verlet");
    for (int k = 0; k < modify->nfix; k++)
        if (modify->fix[k]->rigid_flag || !strncmp(modify->fix[k]->style, "multisphere", 11))
            refuse("spheres of rigid bodies are not supported");
    for (int i = 1; i <= atom->ntypes; i++)
        for (int j = i; j <= atom->ntypes; j++)
            if (!model(i, j)) refuse("no law for " + types(i, j) + "; two materials take 'partner FILE'");
    const long page = (long)neighbor->oneatom * history_size(true);
    if (page > neighbor->pgsize)
        refuse("neigh_modify one " + std::to_string(neighbor->oneatom) + " needs page " + std::to_string(page) +
               " or more, for " + std::to_string(history_size(true)) + " numbers a contact");
    const PairGran *pair = static_cast<PairGran *>(force->pair_match("gran", 1));
    frozen = pair ? pair->freeze_group_bit() : 0;
    std::fill_n(warned, restitute_dem::RATIOS, false);
    for (const Model &its : models)
        its->record = Record();
    reset_dt();
}

void FixRestitute::reset_dt()
{
    for (const Model &its : models)
        if (const char *problem = its->set_step(update->dt)) refuse(problem);
}

/* ---- record of a run */

void FixRestitute::end_of_step()
{
    const Record own = own_record();
    for (const auto which : {restitute_dem::STEP, restitute_dem::DEPTH}) {
        if (warned[which] || own.beyond[which] == 0) continue;
        warned[which] = true;
        const std::string text = own.warning(which, update->ntimestep);
        if (comm->me == 0)
            error->warning(FLERR, text.c_str());
        else
            fprintf(stderr, "WARNING: %s\n", text.c_str()); /* LIGGGHTS gives other processes no screen */
    }
}

Record FixRestitute::own_record() const
{
    Record own;
    for (const Model &its : models)
        own.add(its->record);
    return own;
}

Record FixRestitute::record() const
{
    using restitute_dem::RATIOS;
    const Record own = own_record();
    Record all;
    MPI_Allreduce(&own.steps, &all.steps, 1, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(&own.contacts, &all.contacts, 1, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(own.beyond, all.beyond, RATIOS, MPI_DOUBLE, MPI_SUM, world);
    MPI_Allreduce(own.largest, all.largest, RATIOS, MPI_DOUBLE, MPI_MAX, world);
    return all;
}

/* The limits shown are those of the first law. After `neigh_modify page` or `one` LIGGGHTS treats
 * every run as the first one with it: it makes new neighbor lists and loses the histories in the
 * old ones. Setting both values again prevents this. */
void FixRestitute::post_run()
{
    std::string page = std::to_string(neighbor->pgsize), one = std::to_string(neighbor->oneatom);
    char page_word[] = "page", one_word[] = "one", *words[] = {page_word, &page[0], one_word, &one[0]};
    neighbor->modify_params(4, words);
    print(record().text(models[0]->limits));
}

/* Steps of contacts, first touches, contacts beyond a/R and beyond v/c_s. */
double FixRestitute::compute_vector(int n)
{
    const Record all = record();
    const double values[] = {all.steps, all.contacts, all.beyond[restitute_dem::RADIUS],
                             all.beyond[restitute_dem::SPEED]};
    return values[n];
}

/* ---- restarts */

/* The hashes of the laws of all pairs of types; LIGGGHTS writes the states of contacts. */
void FixRestitute::write_restart(FILE *file)
{
    std::vector<uint64_t> hashes;
    for (const Model &its : table)
        hashes.push_back(its ? its->hash() : 0);
    const int size = (int)(hashes.size() * sizeof hashes[0]);
    if (comm->me) return;
    fwrite(&size, sizeof size, 1, file);
    fwrite(hashes.data(), 1, size, file);
}

void FixRestitute::restart(char *buffer)
{
    for (int i = 1; i <= atom->ntypes; i++)
        for (int j = i; j <= atom->ntypes; j++) {
            uint64_t hash;
            memcpy(&hash, buffer + (i * (atom->ntypes + 1) + j) * sizeof hash, sizeof hash);
            if (model(i, j) && hash != model(i, j)->hash())
                refuse(types(i, j) + ": the restart file was written with another law than this one of '" +
                       model(i, j)->words[0] + "'");
        }
}
