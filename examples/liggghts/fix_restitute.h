/* fix restitute: the contact laws of a run of LIGGGHTS, the contacts of spheres and walls, the
 * report at the end. `pair_style gran model restitute` makes it; scripts read its numbers as
 * f_restitute.
 * SPDX-License-Identifier: GPL-2.0-or-later */
#ifdef FIX_CLASS
FixStyle(restitute, FixRestitute)
#else
#ifndef LMP_FIX_RESTITUTE_H
#define LMP_FIX_RESTITUTE_H

#include "contact_interface.h"
#include "fix.h"

#include "contact_model.h"

#include <memory>

namespace LAMMPS_NS
{

class FixRestitute : public Fix
{
  public:
    using Meeting = LIGGGHTS::ContactModels::SurfacesIntersectData; /* of sphere i with sphere j or a wall */

    FixRestitute(LAMMPS *lmp, int narg, char **arg);
    static FixRestitute *of(LAMMPS *lmp); /* NULL: there is none */
    int setmask() override;
    void init() override;
    void reset_dt() override;
    void end_of_step() override;
    void post_run() override;
    double compute_vector(int n) override;
    void write_restart(FILE *file) override;
    void restart(char *buffer) override;

    void read_laws();
    int history_size(bool is_wall) const; /* doubles of a contact */
    void make_long_history(class PairGran *pair);

    /* The force on sphere i. `history`: our doubles of the contact, `offset` behind the first ones
     * of the host. */
    void compute(const Meeting &met, int offset, double force[3]);

    /* The same for pairs of spheres in batches: those collected get their forces at the end of the
     * pass. begin_pass: false, if it must not be. */
    bool begin_pass(class PairGran *pair);
    void collect(const Meeting &met, int offset);
    void end_pass();

    double tangential[3] = {}; /* of the present contact: from the normal model for the tangential one */

  private:
    struct Law : restitute_dem::ContactModel {
        using ContactModel::ContactModel;
        std::unique_ptr<restitute_dem::Batch> batch = make_batch();
    };
    using Model = std::shared_ptr<Law>; /* shared by types with the same words */
    /* Behind the state of a contact: the step that computed it last, and at a wall the normal
     * then. */
    enum { LAST_STEP = 0, NORMAL = 1, NUMBERS_OF_PAIRS = 1, NUMBERS_OF_WALLS = 4 };

    [[noreturn]] void refuse(const std::string &what) const;
    std::string words_of(int i, int j) const;
    const Model &model(int i, int j) const;
    restitute_dem::Body sphere(int i) const;
    double density(int i) const;
    void order(int i, int j, double *history, restitute_dem::Batch &batch, int k) const;
    bool meet_sphere(int k, int n, bool moves, restitute_dem::Batch &batch) const;
    bool meet_wall(const Meeting &met, int offset, bool moves, restitute_dem::Batch &batch) const;
    bool follow_mesh(const Meeting &met, const restitute_contact_motion &now, int offset, double *history) const;
    void run(Law &law, bool moves) const;
    void compute_batch(Law &law);
    void apply(const restitute_dem::Batch &batch, int k) const;
    void stop(int i, int j, const std::string &problem) const;
    restitute_dem::Record own_record() const;
    restitute_dem::Record record() const; /* of all processes */
    void print(const std::string &text) const;

    std::vector<Model> table, models; /* of pairs of types; those that differ */
    int states = 0;                   /* doubles of a contact that are the law's */
    int frozen = 0;
    PairGran *host = nullptr; /* of the present pass */
    bool warned[restitute_dem::RATIOS] = {};
};

} // namespace LAMMPS_NS

#endif
#endif
