/* tangential restitute: the tangential part of the contacts of model restitute in LIGGGHTS.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifdef TANGENTIAL_MODEL
TANGENTIAL_MODEL(TANGENTIAL_RESTITUTE, restitute, 42)
#else
#ifndef TANGENTIAL_MODEL_RESTITUTE_H
#define TANGENTIAL_MODEL_RESTITUTE_H

#include "contact_models.h"
#include "error.h"
#include "tangential_model_base.h"

#include "fix_restitute.h"

namespace LIGGGHTS::ContactModels
{

template <> class TangentialModel<TANGENTIAL_RESTITUTE> : public TangentialModelBase
{
  public:
    TangentialModel(LAMMPS *lmp, IContactHistorySetup *host, ContactModelBase *c) : TangentialModelBase(lmp, host, c)
    {
        if (c->get_history_offset("restitute") < 0) error->all(FLERR, "tangential restitute: needs model restitute");
        c->add_history_offset("restitute tangential", 0);
    }

    void connectToProperties(PropertyRegistry &)
    {
        laws = FixRestitute::of(lmp);
    }

    void surfacesIntersect(const SurfacesIntersectData &contact, ForceData &i, ForceData &j)
    {
        const double *n = contact.en, *f = laws->tangential;
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            const double turn = n[m] * f[l] - n[l] * f[m]; /* of the arm 1 from either centre, along -n from i */
            i.delta_F[k] += f[k];
            j.delta_F[k] -= f[k];
            i.delta_torque[k] += contact.cri * turn;
            j.delta_torque[k] += contact.crj * turn;
        }
    }

    /* clang-format off */
    void registerSettings(Settings &) {}
    void postSettings(IContactHistorySetup *, ContactModelBase *) {}
    void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) {}
    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    /* clang-format on */

  private:
    FixRestitute *laws = nullptr;
};

} // namespace LIGGGHTS::ContactModels

#endif
#endif
