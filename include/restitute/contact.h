/** @file contact.h
 *  The contact force of soft-sphere DEM: a viscoelastic contact with friction, its memory, and no
 *  allocation in a step.
 *
 *  The law is the foundation of the Method of Dimensionality Reduction (docs/contact.md). A DEM
 *  impact with it has the pair (ez, ex) of @ref restitute_solve_scene: with the default elements
 *  and a step of @ref restitute_contact_time_step_limit, within 0.01 in 99 % of random impacts. A
 *  contact may also rest, slide in any direction, turn and be loaded again. Link
 *  restitute::contact (CMake) or restitute-contact (pkg-config). No other library is needed.
 *
 *  In short:
 *
 *      restitute_contact_law *law;
 *      restitute_contact_rates rates; restitute_contact_rates_init(&rates);
 *      restitute_contact_law_create(rubber, &options, &law, &error);
 *      restitute_contact_rates_set(law, dt, &rates, &error);            // once for a time step
 *      double state[48] = {0};                        // restitute_contact_law_state_size(law)
 *      restitute_contact_step(law, &rates, &motion, state, &force, &error);
 *
 *  What the host does: it keeps the state from the first overlap until the bodies separate and then
 *  drops it; it orders the two bodies of a contact once and for all (by tag, say), since the state
 *  is not symmetric; it moves contacts between processes by copying the state. Rolling and twisting
 *  resistance are the host's.
 *
 *  Units: SI, or any other consistent ones. Directions as in docs/conventions.md: the normal points
 *  from body 1 into body 2, and relative motion is 1 minus 2. Statuses, errors and threads as in
 *  restitute.h. A law is immutable and shared freely.
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_CONTACT_H
#define RESTITUTE_CONTACT_H

#include <restitute/restitute.h>

#ifdef __cplusplus
extern "C" {
#endif

/* -------------------------------------------------------------------------------------- the law */

/** A contact law of a material. */
typedef struct restitute_contact_law restitute_contact_law;

/** What a law is made of besides the material. */
typedef struct restitute_contact_law_options {
    size_t struct_size; /**< set by @ref restitute_contact_law_options_init */
    int deformable;     /**< a @ref restitute_deformable; default ONE_BODY_DEFORMS: of `material`;
                             the other is rigid, the wall, say. Two spheres of one material take
                             BOTH_BODIES_DEFORM */
    int elements;       /**< 8 (default), 16, 24 or 32: the error falls with the square, cost and
                             memory grow */
    int terms;          /**< most Prony terms kept, 1 to 8; default 4. A material with more is
                             reduced to so many, which meet G(t) from `shortest` to `longest` */
    int slip_cycles;    /**< nonzero: the law remembers where slip turned, so that cycles far below
                             gross slip lose what they should (docs/contact.md, Accuracy); 5 more
                             doubles and 2 more for each term, and up to twice the time; default
                             0 */
    /** s, 1e-60 <= shortest < longest <= 1e60: the time step of the host and the longest contact
     *  time of interest. Required if terms are reduced, else not read; default 0 */
    double shortest;
    double longest;     /**< see `shortest` */
    int frictionless;   /**< nonzero: no tangential force, no states for it; default 0 */
    int details;        /**< nonzero: seven more doubles a contact and up to twice the time, for
                             @ref restitute_contact_details_get; default 0 */
} restitute_contact_law_options;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, contact_law_options)

/** Make a law.
 *
 *  A reduced series has an error, the `error_bound` of @ref restitute_contact_law_series. The error
 *  of ez is up to a third of it (docs/contact.md). From 20 % on the call returns
 *  TOLERANCE_NOT_REACHED, with a law, and `error` says by how much G(t) is missed. Beyond 50 % it
 *  is refused.
 *
 *  @param material  any; may be destroyed after the call
 *  @param options   NULL for the defaults
 *  @return OK, TOLERANCE_NOT_REACHED, ERROR_NULL, ERROR_STRUCT_SIZE, ERROR_MEMORY, ERROR_DOMAIN:
 *          also if terms must be reduced but `shortest` and `longest` are not given, or the law
 *          misses more than 50 % of G(t), or nothing is left of G(t) at `longest` */
RESTITUTE_SINCE_0_1 int restitute_contact_law_create(const restitute_material *material,
    const restitute_contact_law_options *options, restitute_contact_law **law,
    restitute_error *error);

/** Release a law; NULL is allowed. */
RESTITUTE_SINCE_0_1 void restitute_contact_law_destroy(restitute_contact_law *law);

/** Doubles of the state of one contact: 8 + elements x (2 with friction + terms x (1, 3 with
 *  friction) + 1 with a parallel dashpot or without equilibrium modulus) + 5 + 2 terms with slip
 *  cycles + 7 with details. With 8 elements and friction: elastic 24, Kelvin-Voigt 32, standard
 *  solid 48. 0 for NULL. */
RESTITUTE_SINCE_0_1 size_t restitute_contact_law_state_size(const restitute_contact_law *law);

/** A number that two laws share if they are the same, for restart files; 0 for NULL. A state
 *  carries 24 bits of it. */
RESTITUTE_SINCE_0_1 uint64_t restitute_contact_law_hash(const restitute_contact_law *law);

/** The Prony series that the law computes with, as @ref restitute_material_series: of the material,
 *  before the halving for two deformable bodies. Arrays of 8; any output may be NULL.
 *
 *  @param n_terms  number of terms
 *  @param error_bound  largest |G_law(t) - G(t)|/G(t) from `shortest` to `longest`, and that of the
 *                      integral of G up to `shortest`; 0 if all terms were kept */
RESTITUTE_SINCE_0_1 int restitute_contact_law_series(const restitute_contact_law *law,
    double *equilibrium_modulus, double *parallel_viscosity, size_t *n_terms,
    double *relaxation_time, double *modulus, double *error_bound, restitute_error *error);

/** Time scale of an impact: largest overlap over speed. An elastic impact lasts 2.943 of it, of
 *  which it approaches for half. It falls with speed^(-1/5). Mass, radius and speed are in [1e-60,
 *  1e60].
 *
 *  @param mass    effective, 1/(1/m1 + 1/m2)        @param radius  effective, 1/(1/R1 + 1/R2)
 *  @param speed   normal                            @param scale   s */
RESTITUTE_SINCE_0_1 int restitute_contact_time_scale(const restitute_contact_law *law, double mass,
    double radius, double speed, double *scale, restitute_error *error);

/** Largest time step that is safe for impacts of this speed: a fiftieth of the contact time.
 *  Arguments as of @ref restitute_contact_time_scale.
 *
 *  @param limit  s */
RESTITUTE_SINCE_0_1 int restitute_contact_time_step_limit(const restitute_contact_law *law,
    double mass, double radius, double speed, double *limit, restitute_error *error);

/* --------------------------------------------------------------------------------------- a step */

/** What depends on the time step alone. Made by @ref restitute_contact_rates_set, read by the
 *  steps. */
typedef struct restitute_contact_rates {
    size_t struct_size; /**< set by @ref restitute_contact_rates_init */
    double step;        /**< s */
    uint64_t law;       /**< hash of the law they are of */
    double values[50];  /**< the law's own */
} restitute_contact_rates;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, contact_rates)

/** Rates of a law for a time step, s, in [1e-60, 1e60]; to be made again when the step changes. */
RESTITUTE_SINCE_0_1 int restitute_contact_rates_set(const restitute_contact_law *law, double step,
    restitute_contact_rates *rates, restitute_error *error);

/** The motion of two bodies in contact over one time step. What has no other default is 0. */
typedef struct restitute_contact_motion {
    size_t struct_size;             /**< set by @ref restitute_contact_motion_init */
    double overlap;                 /**< m, at the end of the step, at most radius; <= 0: apart */
    double normal[3];               /**< unit vector from body 1 into body 2, at the end of the
                                         step; default (0, 0, 1) */
    double velocity[3];             /**< m/s, of the surface of body 1 at the contact, relative to
                                         that of body 2, mean of the step (velocity Verlet: at its
                                         middle). Its part along `normal` closes the contact. Each
                                         at most radius/step either way */
    double spin;                    /**< rad/s, mean of the angular velocities of the two bodies
                                         about `normal`, (spin1 + spin2) . normal/2: the tangential
                                         force turns with the bodies. At most 1/step either way */
    double inverse_mass;            /**< 1/kg, 1/m1 + 1/m2, in [0, 2e30/step]; 0: forces do not
                                         change the motion */
    double inverse_tangential_mass; /**< 1/kg, 1/m1 + R1^2/J1 + 1/m2 + R2^2/J2, in the same range;
                                         of solid spheres 3.5 `inverse_mass` */
    double radius;                  /**< m, effective, in [1e-15, 1e15]; required, default 0 */
    double friction;                /**< coefficient, in [0, 1e6]; default 0 */
} restitute_contact_motion;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, contact_motion)

/** Force on body 1; on body 2 the opposite. This struct will never change. */
typedef struct restitute_contact_force {
    double normal;        /**< N, >= 0, along -normal */
    double tangential[3]; /**< N; at most friction times `normal` (within rounding), exactly zero
                               where that is */
} restitute_contact_force;

/** Advance a contact by a step.
 *
 *  @param state  of the caller, restitute_contact_law_state_size(law) doubles; all zeros is a new
 *                contact
 *  @return ERROR_NULL, ERROR_STRUCT_SIZE; ERROR_DOMAIN: a value out of its range; rates or state of
 *          another law, or a damaged state; a new contact of less than ten steps; a normal that has
 *          turned too far since the last step (some 60 degrees), see @ref restitute_contact_turn.
 *          State and force are untouched then. Also ERROR_DOMAIN: a corrupt state, whose force is
 *          negative or not finite; the state is spoilt then, `force` is untouched. A state that is
 *          damaged elsewhere may pass */
RESTITUTE_SINCE_0_1 int restitute_contact_step(const restitute_contact_law *law,
    const restitute_contact_rates *rates, const restitute_contact_motion *motion, double *state,
    restitute_contact_force *force, restitute_error *error);

/** Advance n contacts of one law; n may be 0. About twice as fast as n single steps if most of
 *  them go on from the step before, with the same bits but for the sign of a zero.
 *
 *  @param states    n states, each as in @ref restitute_contact_step and no two of them the same
 *  @param statuses  optional: n statuses. A contact that fails stops no other
 *  @return OK, or the status of the first contact that failed, named in `error`, e.g. "motions[7]:
 *          motion.friction = -1: must be in [0, 1e+06]". A call that is refused as a whole
 *          (ERROR_NULL, also of any state; ERROR_STRUCT_SIZE of rates or any motion; rates of
 *          another law) touches nothing */
RESTITUTE_SINCE_0_1 int restitute_contact_step_many(const restitute_contact_law *law,
    const restitute_contact_rates *rates, size_t n, const restitute_contact_motion *motions,
    double *const *states, restitute_contact_force *forces, int *statuses,
    restitute_error *error);

/** The force of the last step again, without advancing; zero for a new contact. For hosts that
 *  evaluate forces at set-up.
 *
 *  @param normal  unit vector of now */
RESTITUTE_SINCE_0_1 int restitute_contact_peek(const restitute_contact_law *law,
    const double normal[3], const double *state, restitute_contact_force *force,
    restitute_error *error);

/** What a contact has done since it began, and how it is now. */
typedef struct restitute_contact_details {
    size_t struct_size;    /**< set by @ref restitute_contact_details_init */
    double contact_radius; /**< m */
    double stick_radius;   /**< m, without slip up to there; 0: all slips */
    double work;           /**< J, of the two bodies on the contact, by the trapezoidal rule */
    double stored;         /**< J, in springs; those outside the contact that have not relaxed yet
                                are included */
    double friction;       /**< J, lost to slip; never falls */
    double viscous;        /**< J, lost in dashpots; never falls. work = stored + friction +
                                viscous, see docs/contact.md, Losses */
    double friction_power; /**< W, lost to slip in the last step */
    double viscous_power;  /**< W, lost in dashpots in the last step */
} restitute_contact_details;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, contact_details)

/** Radii, energies and powers of a contact; of a law made with `details`. All are 0 for a new
 *  contact.
 *
 *  @param radius  effective, m, as in the motion */
RESTITUTE_SINCE_0_1 int restitute_contact_details_get(const restitute_contact_law *law,
    double radius, const double *state, restitute_contact_details *details,
    restitute_error *error);

/** Turn the memory of a contact with a normal that jumps, as when a sphere slides onto the next
 *  triangle of a mesh.
 *
 *  @param from,to  unit vectors */
RESTITUTE_SINCE_0_1 int restitute_contact_turn(const restitute_contact_law *law,
    const double from[3], const double to[3], double *state, restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
