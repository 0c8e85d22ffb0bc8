/* restituteplugin.so: registers pair_style restitute and fix wall/restitute with LAMMPS.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#include "fix_wall_restitute.h"
#include "lammps_declarations.h"
#include "pair_restitute.h"

#include "error.h"
#include "lammps.h"

using namespace LAMMPS_NS;

static void *create_pair(void *lammps)
{
    return new PairRestitute(static_cast<LAMMPS *>(lammps));
}

static void *create_fix(void *lammps, int narg, char **arg)
{
    return new FixWallRestitute(static_cast<LAMMPS *>(lammps), narg, arg);
}

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *host, void *handle, void *registrar)
{
    auto *lammps = static_cast<LAMMPS *>(host);
    auto add = reinterpret_cast<restitute_plugin_register>(registrar);
    if (RESTITUTE_LAMMPS_VERSION && lammps->num_ver != RESTITUTE_LAMMPS_VERSION)
        lammps->error->all(FLERR, "restitute: made for LAMMPS {}, not {}: compile the plugin with the sources of that",
                           RESTITUTE_LAMMPS_VERSION, lammps->num_ver);
    restitute_plugin plugin = {};
    plugin.version = lammps->version;
    plugin.author = "the authors of restitute";
    plugin.handle = handle;
    plugin.style = "pair";
    plugin.name = "restitute";
    plugin.info = "pair_style restitute";
    plugin.creator.pair = create_pair;
    add(&plugin, lammps);
    plugin.style = "fix";
    plugin.name = "wall/restitute";
    plugin.info = "fix wall/restitute";
    plugin.creator.fix = create_fix;
    add(&plugin, lammps);
}
