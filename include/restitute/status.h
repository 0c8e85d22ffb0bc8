/** @file status.h
 *  Every status that a `restitute` function can return, with its text, in one list.
 *
 *  Zero: done. Positive: done, with a remark; the outputs are valid. Negative: failed; the outputs
 *  are untouched. Values are never reused.
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_STATUS_H
#define RESTITUTE_STATUS_H

/** X(name, value, text) */
#define RESTITUTE_STATUS_LIST(X)                                                                   \
    X(OK, 0, "done")                                                                               \
    X(NO_REBOUND, 1, "the sphere sinks in and never rebounds (ez = 0, contact time infinite)")     \
    X(TOLERANCE_NOT_REACHED, 2, "the estimated error is above the requested tolerance")            \
    X(ERROR_NULL, -1, "a required argument is NULL")                                               \
    X(ERROR_STRUCT_SIZE, -2,                                                                       \
      "a struct was not prepared by its init function or belongs to another version")              \
    X(ERROR_DOMAIN, -3, "a value lies outside its allowed range")                                  \
    X(ERROR_MEMORY, -4, "out of memory")                                                           \
    X(ERROR_UNSTABLE_STEP, -5, "the requested time step cannot be stable")                         \
    X(ERROR_TOO_MUCH_WORK, -6, "the impact needs more work than max_work or time_limit allow")     \
    X(ERROR_FILE, -7, "a file cannot be read or written")                                          \
    X(ERROR_FORMAT, -8, "a file does not have the expected form")                                  \
    X(ERROR_INTERNAL, -9, "an internal check failed; please report it")                            \
    X(ERROR_INTEGRATOR, -10, "the ODE integrator failed; see the message")                         \
    X(ERROR_INTERRUPTED, -11, "interrupted by the caller")                                         \
    X(ERROR_CONVERGENCE, -12, "an iteration did not converge")

#define RESTITUTE_STATUS_ENUM(name, value, text) RESTITUTE_##name = (value),
/** Status of a call; see @ref RESTITUTE_STATUS_LIST for the texts. */
typedef enum restitute_status { RESTITUTE_STATUS_LIST(RESTITUTE_STATUS_ENUM) } restitute_status;
#undef RESTITUTE_STATUS_ENUM

#endif
