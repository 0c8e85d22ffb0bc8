/** @file cvode.h
 *  The method `cvode` of `restitute`: the impact as an ordinary differential equation, integrated
 *  by SUNDIALS CVODE with adaptive order and step, and the log of its events.
 *
 *  What is integrated is the motion of the sphere and the dashpots of the foundation. Those of
 *  single elements are eliminated exactly: an element that sticks and one that slips follow from
 *  the sphere's states between the instants at which they change, and those are found by CVODE's
 *  rootfinding. See docs/cvode.md.
 *
 *      restitute_options options; restitute_options_init(&options);
 *      options.method = restitute_method_cvode();
 *      options.tolerance = 1e-6;
 *      restitute_solver *solver; restitute_solver_create(&options, &solver, &error);
 *
 *  then restitute_solve() and all the rest of restitute.h. A @ref restitute_cvode_recorder keeps
 *  the events as well. The rules of restitute.h hold here too. Link with restitute::cvode (CMake)
 *  or restitute-cvode (pkg-config).
 *
 *  A failure of CVODE itself is ERROR_INTEGRATOR with CVODE's words in the message. The method
 *  chooses its steps: `time_step` must be 0. `elements` gives the number of elements over the
 *  largest contact radius, 4 to 16384; half as many are run for the error estimate. CVODE allocates
 *  its own memory in every call. Where there is none left, that is ERROR_MEMORY. Out of memory, two
 *  functions of SUNDIALS 6.4 misbehave: SUNContext_Create crashes where the table of its logger is
 *  missing, and CVodeCreate writes to standard error.
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_CVODE_H
#define RESTITUTE_CVODE_H

#include <restitute/restitute.h>

#ifdef __cplusplus
extern "C" {
#endif

/** `cvode`: Adams' formulas, or the backward differentiation formulas where the solid is stiff
 *  against the contact time. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_method_cvode(void);

/** `cvode-bdf`: backward differentiation formulas always. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_method_cvode_bdf(void);

/** `cvode-adams`: Adams' formulas always; a stiff solid then costs steps, or more of them than are
 *  allowed. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_method_cvode_adams(void);

/** Version of SUNDIALS that this library was compiled with, e.g. "6.4.1". */
RESTITUTE_SINCE_0_1 const char *restitute_cvode_sundials_version(void);

/** Kinds of events. X(name, value, word) */
#define RESTITUTE_CVODE_EVENT_LIST(X)                                                              \
    X(ENTRY, 1, "entry")                   /* the edge passes an element on its way out */         \
    X(EXIT, 2, "exit")                     /* and on its way back */                               \
    X(GROSS_SLIP_END, 3, "gross-slip-end") /* all elements stick at once */                        \
    X(STICK_TO_SLIP, 4, "stick-to-slip")   /* one element, or several at the same instant */       \
    X(SLIP_TO_STICK, 5, "slip-to-stick")   /* likewise */                                          \
    X(TURN, 6, "turn")                     /* largest indentation */                               \
    X(CONTACT_END, 7, "contact-end")       /* the last element leaves */

#define RESTITUTE_CVODE_EVENT_ENUM(name, value, word) RESTITUTE_CVODE_EVENT_##name = (value),
/** What happens, see @ref RESTITUTE_CVODE_EVENT_LIST. */
typedef enum restitute_cvode_event_kind {
    RESTITUTE_CVODE_EVENT_LIST(RESTITUTE_CVODE_EVENT_ENUM)
} restitute_cvode_event_kind;
#undef RESTITUTE_CVODE_EVENT_ENUM

/** Word for a kind, e.g. "stick-to-slip"; "unknown event" for others. */
RESTITUTE_SINCE_0_1 const char *restitute_cvode_event_text(int kind);

/** One event. Units as in @ref restitute_history: T, d0, a_el, and U' for the tangential velocity,
 *  or SI. This struct will never change. */
typedef struct restitute_cvode_event {
    double time;
    double position;            /**< distance of the element from the axis; of several the
                                     outermost; contact radius for the others */
    double indentation;
    double normal_velocity;     /**< positive into the partner */
    double tangential_velocity; /**< of the contact point */
    int kind;                   /**< a @ref restitute_cvode_event_kind */
    int elements;               /**< how many elements it happens to at that instant */
} restitute_cvode_event;

/** The events of one impact, in order of time. */
typedef struct restitute_cvode_events {
    size_t struct_size;           /**< set by @ref restitute_cvode_events_init */
    size_t capacity;              /**< length of `event`; may be 0, to learn the number */
    size_t count;                 /**< out: events that there are; the first `capacity` of them are
                                       written */
    restitute_cvode_event *event; /**< array of the caller; NULL only with capacity 0 */
} restitute_cvode_events;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, cvode_events)

/** Work behind an impact, all its runs together but the one that fills the log: what a
 *  work-precision report wants. */
typedef struct restitute_cvode_work {
    size_t struct_size; /**< set by @ref restitute_cvode_work_init */
    int64_t steps;      /**< of CVODE */
    int64_t restarts;   /**< re-initialisations, after non-smooth points */
    int64_t rates;      /**< evaluations of the right-hand side */
    int64_t events;     /**< found by rootfinding */
    int64_t stiff;      /**< 1: backward differentiation, 0: Adams */
} restitute_cvode_work;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, cvode_work)

/** One of the methods above that keeps the events and the work of the last impact. */
typedef struct restitute_cvode_recorder restitute_cvode_recorder;

/** @param method    one of the methods above; NULL: `cvode`
 *  @param recorder  for @ref restitute_cvode_recorder_destroy. One thread at a time, like the
 *                   solver that uses it
 *  @return OK, ERROR_NULL, ERROR_MEMORY; ERROR_DOMAIN for another method
 *
 *      restitute_cvode_recorder_create(NULL, &recorder, &error);
 *      options.method = restitute_cvode_recorder_method(recorder);
 *      ... restitute_solve(solver, &impact, &result, NULL, NULL, &error);
 *      restitute_cvode_event list[1000];
 *      restitute_cvode_events events; restitute_cvode_events_init(&events);
 *      events.event = list; events.capacity = 1000;
 *      restitute_cvode_recorder_events(recorder, &events, &error);
 *      for (size_t i = 0; i < events.count && i < 1000; i++)
 *          printf("%g %s\n", list[i].time, restitute_cvode_event_text(list[i].kind)); */
RESTITUTE_SINCE_0_1 int restitute_cvode_recorder_create(const restitute_method *method,
    restitute_cvode_recorder **recorder, restitute_error *error);

/** Release; NULL is allowed. No solver that uses its method may be called any more. */
RESTITUTE_SINCE_0_1 void restitute_cvode_recorder_destroy(restitute_cvode_recorder *recorder);

/** The method, for restitute_options; lives as long as the recorder. NULL for NULL. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_cvode_recorder_method(
    const restitute_cvode_recorder *recorder);

/** Events of the last impact that the method began, those of the run that gave the pair, in the
 *  units of that impact. A call whose input is refused begins none. Of a sphere that sinks in
 *  (NO_REBOUND) there are the events up to where it is given up. Of an impact that failed there are
 *  none.
 *
 *  @return OK; ERROR_DOMAIN before an impact; ERROR_NULL, ERROR_STRUCT_SIZE */
RESTITUTE_SINCE_0_1 int restitute_cvode_recorder_events(const restitute_cvode_recorder *recorder,
    restitute_cvode_events *events, restitute_error *error);

/** Work of the last impact that the method began.
 *
 *  @return OK; ERROR_DOMAIN before an impact; ERROR_NULL, ERROR_STRUCT_SIZE */
RESTITUTE_SINCE_0_1 int restitute_cvode_recorder_work(const restitute_cvode_recorder *recorder,
    restitute_cvode_work *work, restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
