/* All outputs of a call that solves, for the tests of allocation failures.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef TEST_OUTPUTS_H
#define TEST_OUTPUTS_H

#include "failing_allocator.h"
#include "history.h"

enum { samples = 20 };

/* Each at first as its init function leaves it. */
struct outputs {
    restitute_result result;
    restitute_ledger ledger;
    restitute_history history;
    double array[8][samples];
};

static inline void prepare(struct outputs *o, struct outputs *fresh)
{
    memset(o, 0, sizeof *o); /* the padding too */
    restitute_result_init(&o->result);
    restitute_ledger_init(&o->ledger);
    restitute_history_init(&o->history);
    set_columns(&o->history, samples, o->array[0], all_columns);
    memcpy(fresh, o, sizeof *o);
}

/* Of a subject, the function `name`, whose call solves and puts its outputs into `o`: the result,
 * and what is WANTED. */
#define SOLVES(name, call)                                                                                             \
    static int name(struct given *given)                                                                               \
    {                                                                                                                  \
        struct outputs o, fresh;                                                                                       \
        int status;                                                                                                    \
        prepare(&o, &fresh);                                                                                           \
        ARMED(status, call);                                                                                           \
        return give_outputs(status, &o, &fresh, given);                                                                \
    }
static int all_outputs; /* or not those that are WANTED */
#define WANTED(output) (all_outputs ? &o.output : NULL)

static inline int give_outputs(int status, const struct outputs *o, const struct outputs *fresh, struct given *given)
{
    CHECK(status >= 0 || memcmp(o, fresh, sizeof *o) == 0, "outputs touched");
    if (status < 0) return status;
    const restitute_result *r = &o->result;
    const double numbers[] = {r->ez,
                              r->ex,
                              r->error_ez,
                              r->error_ex,
                              r->contact_time,
                              r->max_normal_force,
                              (double)r->steps,
                              (double)r->terms_merged,
                              o->ledger.viscous_z,
                              o->ledger.friction_x,
                              o->ledger.residual_x,
                              (double)o->history.count};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        give(given, numbers[i]);
    for (int i = 0; i < 8; i++)
        for (size_t k = 0; k < o->history.count; k++)
            give(given, o->array[i][k]);
    return status;
}

#endif
