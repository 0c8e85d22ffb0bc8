/* model restitute: viscoelastic contacts of spheres in LIGGGHTS, normal part. It goes with
 * tangential restitute.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifdef NORMAL_MODEL
NORMAL_MODEL(RESTITUTE, restitute, 42)
#else
#ifndef NORMAL_MODEL_RESTITUTE_H
#define NORMAL_MODEL_RESTITUTE_H

#include "contact_models.h"
#include "error.h"
#include "force.h"
#include "modify.h"
#include "normal_model_base.h"

#include "fix_restitute.h"

namespace LIGGGHTS::ContactModels
{

template <> class NormalModel<RESTITUTE> : public NormalModelBase
{
  public:
    NormalModel(LAMMPS *lmp, IContactHistorySetup *hsetup, ContactModelBase *c) : NormalModelBase(lmp, hsetup, c)
    {
        c->add_history_offset("restitute", 0);
    }

    void postSettings(IContactHistorySetup *host, ContactModelBase *c)
    {
        if (c->get_history_offset("restitute tangential") < 0)
            error->all(FLERR, "model restitute: needs tangential restitute");
        laws = FixRestitute::of(lmp);
        if (!c->is_wall()) {
            const char *words[] = {"restitute", "all", "restitute"};
            if (laws)
                laws->read_laws();
            else
                modify->add_fix(3, const_cast<char **>(words));
            laws = FixRestitute::of(lmp);
        }
        if (!laws) error->all(FLERR, "wall/gran model restitute: must come after pair_style gran model restitute");
        size = laws->history_size(c->is_wall());
        for (int k = 0; k < size; k++) { /* "0": a state has an order by tags, LIGGGHTS must not change its sign */
            const int place = host->add_history_value("restitute_" + std::to_string(k), "0");
            if (k == 0) offset = place;
        }
        is_wall = c->is_wall();
        if (is_wall) return;
        pair = static_cast<PairGran *>(host);
        laws->make_long_history(pair);
    }

    void connectToProperties(PropertyRegistry &)
    {
        laws = FixRestitute::of(lmp);
        if (!laws || size == 0) error->all(FLERR, "model restitute: give the pair_style again after read_restart");
        if (laws->history_size(is_wall) > size)
            error->all(FLERR, "model restitute: its laws have changed, give the walls again after the pair_style");
        if (force->cg_active()) error->cg(FLERR, "model restitute");
    }

    void surfacesIntersect(SurfacesIntersectData &contact, ForceData &i, ForceData &j)
    {
        double f[3];
        if (contact.contact_flags) *contact.contact_flags |= CONTACT_NORMAL_MODEL;
        if (waits) return laws->collect(contact, offset);
        laws->compute(contact, offset, f);
        contact.Fn = f[0] * contact.en[0] + f[1] * contact.en[1] + f[2] * contact.en[2];
        contact.kn = contact.deltan > 0 ? contact.Fn / contact.deltan : 0; /* for rolling friction */
        contact.kt = contact.gamman = contact.gammat = 0;
        for (int k = 0; k < 3; k++) {
            laws->tangential[k] = f[k] - contact.Fn * contact.en[k];
            i.delta_F[k] += contact.Fn * contact.en[k];
            j.delta_F[k] -= contact.Fn * contact.en[k];
        }
    }

    /* clang-format off */
    void registerSettings(Settings &) {}
    double stressStrainExponent() { return 1.5; }
    void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) {}
    /* clang-format on */

    /* LIGGGHTS calls these two for pairs only, not for walls. */
    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &)
    {
        waits = laws->begin_pass(pair);
    }

    void endPass(SurfacesIntersectData &, ForceData &, ForceData &)
    {
        if (waits) laws->end_pass();
    }

  private:
    FixRestitute *laws = nullptr;
    PairGran *pair = nullptr; /* NULL at a wall */
    int offset = 0, size = 0;
    bool is_wall = false, waits = false;
};

} // namespace LIGGGHTS::ContactModels

#endif
#endif
