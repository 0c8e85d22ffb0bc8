/* librestitute_liggghts.so, preloaded into LIGGGHTS: registers model restitute, tangential
 * restitute and fix restitute. If they are built into LIGGGHTS, its build registers them, and this
 * file is not needed.
 * SPDX-License-Identifier: GPL-2.0-or-later */
/* These first: the headers of LIGGGHTS do not include all that they use. */
#include "comm.h"
#include "fix_insert_stream.h"
#include "global_properties.h"

#include "contact_models.h"
#include "fix_wall_gran_base.h"
#include "modify.h"
#include "pair_gran_base.h"

#include "fix_restitute.h"

using namespace LAMMPS_NS;
using namespace LIGGGHTS;
using namespace LIGGGHTS::ContactModels;

/* The map of the fix styles is private in Modify. An explicit instantiation may name private
 * members. */
using FixStyles = std::map<std::string, Fix *(*)(LAMMPS *, int, char **)> *;
FixStyles styles_of(Modify *modify);
template <FixStyles Modify::*styles> struct Open {
    friend FixStyles styles_of(Modify *modify)
    {
        return modify->*styles;
    }
};
template struct Open<&Modify::fix_map>;

static Fix *create_fix(LAMMPS *lmp, int narg, char **arg)
{
    return new FixRestitute(lmp, narg, arg);
}

template <typename Model>
static PairStyles::IGranularPairStyle *create_pair(LAMMPS *lmp, PairGran *parent, const int64_t hash)
{
    (*styles_of(lmp->modify))["restitute"] = create_fix;
    return new PairStyles::Granular<Model>(lmp, parent, hash);
}

template <typename Model> static Walls::IGranularWall *create_wall(LAMMPS *lmp, FixWallGran *parent, const int64_t hash)
{
    return new Walls::Granular<Model>(lmp, parent, hash);
}

template <int ROLLING> static void add_style()
{
    using Style = GranStyle<RESTITUTE, TANGENTIAL_RESTITUTE, COHESION_OFF, ROLLING, SURFACE_DEFAULT>;
    using Model = ContactModel<Style>;
    PairStyles::Factory::instance().addStyle("gran", Style::HASHCODE, create_pair<Model>);
    Walls::Factory::instance().addStyle("gran", Style::HASHCODE, create_wall<Model>);
}

static const bool registered = []() {
    Factory::instance().addNormalModel("restitute", RESTITUTE);
    Factory::instance().addTangentialModel("restitute", TANGENTIAL_RESTITUTE);
    add_style<ROLLING_OFF>();
    add_style<ROLLING_CDT>();
    return true;
}();
