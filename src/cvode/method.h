/* A method of this component: what the core sees, and what it does not.
 * SPDX-License-Identifier: BSD-3-Clause */
#ifndef RST_CVODE_METHOD_H
#define RST_CVODE_METHOD_H

#include <restitute/cvode.h>

#include "base/method.h"
#include "cvode/integrator.h"
#include "cvode/log.h"

/* What a recorder keeps of the last impact. */
struct cvode_record {
    struct event_log log;
    struct rst_units units; /* of that impact */
    double shear_speed;     /* of it: U' to which units.shear_velocity belongs */
    restitute_cvode_work work;
};

struct cvode_method {
    struct restitute_method base;         /* first: the core's pointer is one to the whole */
    const enum integrator_family *family; /* NULL: chosen by the scene */
    struct cvode_record *record;          /* NULL: nothing is kept */
};

static inline const struct cvode_method *rst_cvode_method_of(const struct rst_problem *problem)
{
    return (const struct cvode_method *)problem->method;
}

#endif
