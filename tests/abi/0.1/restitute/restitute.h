/** @file restitute.h
 *  Oblique impact of linear-viscoelastic spheres with friction: the core of
 *  `restitute`.
 *
 *  A sphere meets a half-space or another sphere. The library returns the restitution pair
 *
 *      ez = -(normal velocity after)/(normal velocity before)
 *      ex = -(tangential velocity of the contact point after)/(before)
 *
 *  with its error, and on request the history of the impact and where the energy went. The model is
 *  the Method of Dimensionality Reduction after Willert, Kusche and Popov, Facta Universitatis
 *  Mech. Eng. 15(2), 2017, "the paper"; its equation numbers stand in parentheses. It assumes a
 *  half-space, quasi-static material, short impact, one friction coefficient (Amontons-Coulomb), a
 *  constant Poisson ratio and the profile r^2/(2R).
 *
 *  Five lines:
 *
 *      restitute_material *rubber;                                    // G1, G2 in Pa, eta in Pa s
 *      restitute_material_standard_solid(1e6, 2e6, 50.0, 0.5, &rubber, NULL);
 *      restitute_scene scene; restitute_scene_init(&scene);
 *      scene.material = rubber; scene.radius1 = 0.01; scene.mass1 = 4e-3; scene.friction = 0.3;
 *      scene.normal_speed = 0.05; scene.tangential_speed = 0.03;                    // m/s
 *      double ez, ex; restitute_scene_pair(&scene, &ez, &ex, NULL);
 *
 *  Rules that hold for every function of every header, but for the exceptions at their end
 *  - What can fail returns a @ref restitute_status: 0 done, positive done with a remark, negative
 *    failed. A failed call leaves all its outputs untouched. Its last argument is an optional @ref
 *    restitute_error that names the offending value and its allowed range. Numbers in it have a
 *    decimal point, whatever the locale.
 *  - What returns a value (a number, a text, a method) cannot fail. For NULL or unknown input it
 *    returns 0, NaN, NULL or a text; its comment says which.
 *  - Arguments come in one order: the object, input, options, output, error. Arrays follow their
 *    length. Where the length may be 0, the arrays may then be NULL: object and options are checked
 *    and nothing else is done. Options that are NULL are the defaults; an output that is NULL is
 *    not wanted and not computed, unless it is all that the function is for.
 *  - Nothing is printed, nothing aborts, there is no global state.
 *  - Defaults add nothing: an elastic solid, one rigid body, no friction, no spin, one thread.
 *    What a struct needs beyond them is marked as required.
 *  - A struct whose first member is `struct_size` is prepared by its `_init` function, which sets
 *    all defaults. It may grow at its end in later versions: a program that was compiled with older
 *    headers keeps working, and what it does not know keeps its default. All
 *    structs of an array have one `struct_size`, that of the first, which is also their distance in
 *    bytes. Other structs never change.
 *  - Numbers have the ranges that stand beside them, wider than any system of units needs; what is
 *    outside is refused. Within them nothing overflows: no call raises FE_INVALID, FE_DIVBYZERO or
 *    FE_OVERFLOW, which hosts may trap.
 *  - Materials are immutable: any number of threads may share one. A solver or a plan belongs to
 *    one thread at a time.
 *  - SI units (m, kg, s, Pa, N, rad) with @ref restitute_scene; dimensionless with @ref
 *    restitute_impact.
 *  - Nothing is removed at once: a function is marked as deprecated, with what replaces it, for two
 *    minor versions before it goes.
 *
 *  Exceptions
 *  - Calls for many cases (`_many`) that return the failure of one case have filled the outputs of
 *    the others. A contact state that was corrupt before (contact.h) may have changed.
 *  - OpenMP, FFTW (bem.h) and SUNDIALS (cvode.h) can end the program where there is no memory or no
 *    thread left, and SUNDIALS may print then. Each header says when.
 *  - FFTW's planner (bem.h) and GSL's error handler (fit.h) are global states of the process.
 *  - GSL (fit.h) may raise floating-point exceptions.
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_RESTITUTE_H
#define RESTITUTE_RESTITUTE_H

#include <restitute/api.h>
#include <restitute/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------ errors, version */

/** Optional last argument: what went wrong, in one line, e.g. "friction = -0.1: must be >= 0 (inf:
 *  no slip)". */
typedef struct restitute_error {
    int status;        /**< the status returned, a @ref restitute_status */
    char message[256]; /**< names the value, the place and the allowed range. Of a call that is done
                            it has remarks: what misses the tolerance, model limits that are passed,
                            a faster method; empty if there are none */
} restitute_error; /* will never change */

/** Text of a status. Never NULL; unknown values give "unknown status". */
RESTITUTE_SINCE_0_1 const char *restitute_status_text(int status);

/** Version of the library in use, "major.minor.patch"; RESTITUTE_VERSION_MAJOR ... are those of the
 *  headers. */
RESTITUTE_SINCE_0_1 const char *restitute_version(void);

/* ------------------------------------------------------------------------------------ materials */

/** A linear-viscoelastic solid, its shear relaxation modulus and Poisson ratio:
 *
 *      G(t) = G_inf + sum_k G_k exp(-t/tau_k) + eta_inf delta(t)
 *
 *  Immutable after creation, shared freely by threads, destroyed by @ref
 *  restitute_material_destroy. */
typedef struct restitute_material restitute_material;

/** General solid: a Prony series, with a dashpot in parallel if wanted (theory.md, 1). All the
 *  others are cases of it.
 *
 *  @param equilibrium_modulus  G_inf, Pa, in [1e-30, 1e30] or 0
 *  @param parallel_viscosity   eta_inf, Pa s, in [1e-60, 1e60] or 0
 *  @param n_terms              number of terms, any; 0 is allowed
 *  @param relaxation_time      tau_k, s, in [1e-30, 1e30], no two alike, any order; n_terms values,
 *                              copied
 *  @param modulus              G_k, Pa, in [1e-30, 1e30]; n_terms values, copied
 *  @param poisson_ratio        nu, in [0, 0.5]
 *  @param material             the new material
 *  @param error                optional
 *  @return ERROR_DOMAIN also if nothing resists at all (G_inf, eta_inf and n_terms all zero);
 *          ERROR_NULL; ERROR_MEMORY
 *
 *      const double tau[] = {1e-4, 1e-2}, g[] = {5e6, 1e6};
 *      restitute_material_prony(1e6, 0.0, 2, tau, g, 0.5, &material, &error); */
RESTITUTE_SINCE_0_1 int restitute_material_prony(double equilibrium_modulus,
    double parallel_viscosity, size_t n_terms, const double *relaxation_time, const double *modulus,
    double poisson_ratio, restitute_material **material, restitute_error *error);

/** Elastic solid of shear modulus G (Pa). Moduli, viscosities and times of all solids have the
 *  ranges named above. */
RESTITUTE_SINCE_0_1 int restitute_material_elastic(double shear_modulus, double poisson_ratio,
    restitute_material **material, restitute_error *error);

/** Standard solid (1): spring G1 parallel to a spring G2 and a dashpot eta in series; tau = eta/G2.
 *  @param modulus1   G1, Pa          @param modulus2  G2, Pa          @param viscosity  eta, Pa
 *  s */
RESTITUTE_SINCE_0_1 int restitute_material_standard_solid(double modulus1, double modulus2,
    double viscosity, double poisson_ratio, restitute_material **material, restitute_error *error);

/** Kelvin-Voigt solid (2): spring G1 (Pa) parallel to a dashpot eta (Pa s). */
RESTITUTE_SINCE_0_1 int restitute_material_kelvin_voigt(double modulus1, double viscosity,
    double poisson_ratio, restitute_material **material, restitute_error *error);

/** Maxwell body: spring G (Pa) in series with a dashpot eta (Pa s); tau = eta/G. It may never
 *  rebound. */
RESTITUTE_SINCE_0_1 int restitute_material_maxwell(double modulus, double viscosity,
    double poisson_ratio, restitute_material **material, restitute_error *error);

/** The effective solid of two bodies of unlike materials, for a @ref restitute_scene in which one
 *  body deforms.
 *
 *  Compliances add (theory.md, 10): with E_i = 2 G_i/(1-nu_i), the two chains in series are turned
 *  back into one Prony series. The normal and the tangential problem of a pair may be coupled, which
 *  the model neglects, as usual. Dundurs' constant says how much:
 *
 *      beta = ((1-2nu1)/G1 - (1-2nu2)/G2)/(2((1-nu1)/G1 + (1-nu2)/G2)),
 *
 *  see @ref restitute_material_dundurs; a rigid partner has 1/G = 0. The model is exact where beta is 0 all the time: if both
 *  bodies are incompressible, or if (1-2nu1)/G1 = (1-2nu2)/G2. The Poisson ratio of the effective
 *  solid is the one that has its ratio of tangential to normal stiffness, 2(1-nu)/(2-nu) = G_x/E_z
 *  with 1/G_x = sum (2-nu_i)/(4 G_i) and 1/E_z = sum 1/E_i. If nu1 = nu2, it is nu1. Where that
 *  ratio or beta changes with time, the instantaneous moduli are taken.
 *
 *  The work grows as the square of the number of terms: 1000 with 1000 take half a second.
 *
 *  @param material1,material2  any but effective ones; may be the same
 *  @param effective            the new solid, to be destroyed like any material
 *  @return ERROR_DOMAIN also if the solid leaves the ranges of a material, which takes moduli some
 *          60 decades apart
 *
 *      restitute_material_effective(steel, glass, &effective, &error);
 *      scene.material = effective; scene.deformable = RESTITUTE_ONE_BODY_DEFORMS; */
RESTITUTE_SINCE_0_1 int restitute_material_effective(const restitute_material *material1,
    const restitute_material *material2, restitute_material **effective, restitute_error *error);

/** Dundurs' beta of an effective solid, in [-1/2, 1/2]; 0 for a material by itself; NaN for
 *  NULL. */
RESTITUTE_SINCE_0_1 double restitute_material_dundurs(const restitute_material *material);

/** Release a material; NULL is allowed. No solver call that uses it may still run. */
RESTITUTE_SINCE_0_1 void restitute_material_destroy(restitute_material *material);

/** G(t), Pa, at time t > 0 (s) after a unit shear step; NaN for a NULL material or t not > 0. */
RESTITUTE_SINCE_0_1 double restitute_material_modulus(const restitute_material *material,
    double time);

/** Poisson ratio nu; NaN for NULL. */
RESTITUTE_SINCE_0_1 double restitute_material_poisson_ratio(const restitute_material *material);

/** Number of Prony terms; 0 for NULL. */
RESTITUTE_SINCE_0_1 size_t restitute_material_terms(const restitute_material *material);

/** The Prony series of a material, as @ref restitute_material_prony takes it. Any output may be
 *  NULL: not wanted.
 *
 *  @param relaxation_time,modulus  restitute_material_terms(material) values each, tau ascending
 *  @return OK, ERROR_NULL
 *
 *      restitute_material_series(material, &g_inf, &eta_inf, tau, g, &error); */
RESTITUTE_SINCE_0_1 int restitute_material_series(const restitute_material *material,
    double *equilibrium_modulus, double *parallel_viscosity, double *relaxation_time,
    double *modulus, restitute_error *error);

/** Set the window of contact times (s) for which the material was measured; (0, infinity) after
 *  creation. An impact in SI units whose contact time is outside of it gets the flag UNMEASURED: its
 *  result extrapolates. A contact of time t is half a sine of the angular frequency pi/t: data at
 *  frequencies omega are of contact times pi/omega, data at times t after a step of pi t. The
 *  material must not be in use elsewhere.
 *
 *  @param shortest,longest  0 <= shortest < longest; infinity allowed
 *  @return OK, ERROR_DOMAIN, ERROR_NULL
 *
 *      restitute_material_set_window(rubber, 1e-5, 1e2, &error); */
RESTITUTE_SINCE_0_1 int restitute_material_set_window(restitute_material *material, double shortest,
    double longest, restitute_error *error);

/** The window of a material. That of an effective solid is the time that both windows share; if
 *  they share none, shortest > longest.
 *
 *  @param shortest,longest  either may be NULL: not wanted
 *  @return OK, ERROR_NULL */
RESTITUTE_SINCE_0_1 int restitute_material_window(const restitute_material *material,
    double *shortest, double *longest, restitute_error *error);

/** The same solid with all relaxation times, viscosities and the window times `time_shift`: the a_T
 *  of another temperature.
 *
 *  @param time_shift  in [1e-100, 1e100]
 *  @param shifted     the new solid, to be destroyed like any material
 *  @return ERROR_DOMAIN also if it leaves the ranges of @ref restitute_material_prony; ERROR_NULL,
 *          ERROR_MEMORY
 *
 *      restitute_material_shifted(rubber, 0.1, &warm_rubber, &error); // ten times as fast */
RESTITUTE_SINCE_0_1 int restitute_material_shifted(const restitute_material *material,
    double time_shift, restitute_material **shifted, restitute_error *error);

/* ---------------------------------------------------------------------------- what is to happen */

/** One impact in dimensionless numbers (22),(23). Indentations in d0 = a_el^2/R, contact radii in
 *  a_el by (24), times in T = d0/v_z0, tangential displacements in d0 mu (2-nu)/(2-2nu).
 *
 *      chi    = (1-nu)/(2-nu) (1 + m R^2/J)                 7/6: solid incompressible sphere
 *      psi    = (2-2nu)/(2-nu) |v_x0 + R w0|/(mu v_z0)      0: no slip (mu -> infinity)
 *      delta1 = eta sqrt(a_el/(G1 m (1-nu)))                0: elastic
 *      gamma  = G1/G2                                       0: Kelvin-Voigt, infinity: elastic
 *
 *  (25)'s delta2, formed like delta1 with G2 under the root and the same a_el, is delta1
 *  sqrt(gamma). */
typedef struct restitute_impact {
    size_t struct_size;                 /**< set by @ref restitute_impact_init */
    double chi;                         /**< in [1/3, 1000]; default 7/6 */
    double psi;                         /**< in [0, 1e12] or infinity; values within 1e-12 of 0 or 1
                                             count as 0 or 1; default infinity: no friction */
    double delta1;                      /**< in [0, 1e12], below 1e-50 taken as 0; default 0:
                                             elastic; not used with `material` */
    double gamma;                       /**< in [0, infinity], below 1e-50 taken as 0, above 1e50 as
                                             infinity; default infinity; not used with `material` */
    const restitute_material *material; /**< optional, any solid instead of (delta1, gamma): its
                                             moduli stand for G/G_r, its times for t/T; G_r is your
                                             choice here, a_el and T are formed with it; its nu is
                                             not used. A parallel
                                             viscosity stronger than delta1 = 1e12 is refused, here
                                             and in a scene */
} restitute_impact;

/** Prepare with the defaults named above: an elastic impact without friction. */
RESTITUTE_INIT(RESTITUTE_SINCE_0_1, impact)

/** Which bodies deform; the default is one everywhere. With both, they are of the same material, in
 *  series: G_eff(t) = G(t)/2. Two unlike materials are one effective solid (@ref
 *  restitute_material_effective) and ONE_BODY_DEFORMS. */
typedef enum restitute_deformable {
    RESTITUTE_ONE_BODY_DEFORMS = 1,  /**< the other is rigid; it does not matter which */
    RESTITUTE_BOTH_BODIES_DEFORM = 2 /**< both are of `material` */
} restitute_deformable;

/** One impact in SI units: sphere 1 against a wall (radius2 and mass2 infinite) or against sphere
 *  2.
 *
 *  Signs: the sphere moves with tangential_speed along x; a spin is positive if it adds to the
 *  velocity of the contact point along +x, tangential_speed + radius1*spin1 + radius2*spin2: spin1 >
 *  0 moves the surface of sphere 1 at the contact along +x, spin2 > 0 that of sphere 2 along -x.
 *  Spheres that turn the same way about the same axis have equal signs. With tangential_speed > 0
 *  backspin is negative. All speeds are relative (1 minus 2). Radii, masses and speeds are in [1e-50, 1e50]. */
typedef struct restitute_scene {
    size_t struct_size;                 /**< set by @ref restitute_scene_init */
    const restitute_material *material; /**< required; default NULL */
    int deformable;                     /**< a @ref restitute_deformable; default ONE_BODY_DEFORMS
                                             */
    double radius1, mass1;              /**< m, kg; required, default 0 */
    double radius2, mass2;              /**< m, kg; infinity allowed; default infinity: a wall */
    double inertia1, inertia2;          /**< kg m^2, in [1e-150, 1e150]; default 0 stands for a
                                             solid sphere, (2/5) m R^2. inertia2 must be 0 for a
                                             wall; of a sphere with infinite mass2, which is held
                                             fast, it is not used */
    int rotation_blocked;               /**< nonzero: the spheres cannot rotate; default 0 */
    double friction;                    /**< mu, 0 or >= 1e-30, infinity allowed (no slip); default
                                             0 */
    double normal_speed;                /**< m/s, approaching; required, default 0 */
    double tangential_speed;            /**< m/s, of the centres, of any sign or 0; default 0. With
                                             the spins it is up to 1e50, too */
    double spin1, spin2;                /**< rad/s, see above, up to 1e100; default 0. spin2 must be
                                             0 for a wall */
    double wave_density;                /**< kg/m^3 of what deforms, for its wave speed, in [1e-100,
                                             1e100]; default 0: that of the denser sphere */
} restitute_scene;

/** Prepare with the defaults named above: a wall, one rigid body, no friction, no spin. */
RESTITUTE_INIT(RESTITUTE_SINCE_0_1, scene)

/** What a scene is in dimensionless numbers, and the scales that lead back to SI.
 *
 *  The reference modulus G_r of the scales is G_inf of the effective solid if that is > 0 (it is G1
 *  in (24)); with G_inf = 0 it is sum G_k, and for a mere dashpot the modulus that makes
 *  eta/(G_r T) = 1. */
typedef struct restitute_numbers {
    size_t struct_size;        /**< set by @ref restitute_numbers_init */
    double chi, psi;           /**< (22); psi is 0 for mu = infinity or no tangential speed,
                                    infinity for mu = 0 */
    double delta1, gamma;      /**< (23) for elastic, standard, Kelvin-Voigt solids; NaN for any
                                    other */
    double delta2;             /**< delta1 sqrt(gamma); NaN likewise */
    double radius, mass;       /**< effective R (m) and m (kg) of the pair */
    double modulus;            /**< G_r, Pa, of the effective solid */
    double length_z, length_x; /**< d0 and a_el, m (24) */
    double time;               /**< T = d0/v_z0, s */
    double force;              /**< m v_z0^2/d0, N */
    double density;            /**< kg/m^3, for the wave speed: wave_density or that of the denser
                                    sphere */
    double dundurs_beta;       /**< of the two bodies, see @ref restitute_material_effective:
                                    (1-2nu)/(2-2nu) where one is rigid, 0 where both are of one
                                    material */
} restitute_numbers;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, numbers)

/** Dimensionless numbers and scales of a scene (22)-(24), docs/theory.md, sections 2 and 10.
 *  Nothing is solved.
 *
 *      restitute_numbers numbers; restitute_numbers_init(&numbers);
 *      restitute_scene_numbers(&scene, &numbers, &error);              // numbers.delta1, ... */
RESTITUTE_SINCE_0_1 int restitute_scene_numbers(const restitute_scene *scene,
    restitute_numbers *numbers, restitute_error *error);

/* ----------------------------------------------------------------------------- how it is solved */

/** A way to solve the impact. Methods of other components come from their headers. */
typedef struct restitute_method restitute_method;

/** `euler`, the default: the paper's foundation and explicit Euler, first order. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_method_euler(void);

/** `sync`: collocation over the angle of the contact's edge, with slip as a second contact
 *  (docs/sync.md). Elements are stepped only where what slips sticks again, and for a ledger. The
 *  fast and precise one, for tables, batches and tolerances below 1e-3. It chooses its steps
 *  itself: `time_step` must be 0. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_method_sync(void);

/** Name of a method, e.g. "euler"; "" for NULL. */
RESTITUTE_SINCE_0_1 const char *restitute_method_name(const restitute_method *method);

/** How to solve. With the defaults, elements and step are refined until the error estimate meets
 *  `tolerance`. */
typedef struct restitute_options {
    size_t struct_size;             /**< set by @ref restitute_options_init */
    const restitute_method *method; /**< default @ref restitute_method_euler */
    double tolerance;               /**< absolute error of ez and of ex, in [1e-8, 0.1]; default
                                         1e-3. OK means that the estimates meet it. They are no
                                         bounds: see docs/records/accuracy.md for true errors */
    int64_t elements;               /**< elements over the largest contact radius, 4 to 1e6; 0
                                         (default): chosen. For `sync` points of collocation: 24,
                                         48, 96, ... or 1536, the largest of them that is not above
                                         the given number, or 24; there are more where panels are
                                         halved. `cvode` takes up to 16384. For the estimate of a
                                         coarse resolution `euler` and `sync` make finer runs, which
                                         take about the work of a default call */
    double time_step;               /**< in T (@ref restitute_impact) or s (@ref restitute_scene),
                                         in [1e-100, 1e100]; 0 (default): chosen. A step that cannot
                                         be stable is refused with the largest that is */
    int threads;                    /**< of @ref restitute_solve_many alone, in [0, 1024]; default
                                         1. 0: as many as OpenMP offers (OMP_NUM_THREADS). Never
                                         more than cases; always the calling thread alone where the
                                         library was built without OpenMP. OpenMP ends a program
                                         whose threads it cannot start, and hangs in a child (fork)
                                         of one that used them; 1 never enters it */
    double max_work;                /**< most work that a call may spend, in nominal seconds, > 0,
                                         infinity allowed; default 10. It is counted (@ref
                                         restitute_result.work), not measured: a nominal second
                                         takes about one second of a core of the year 2020, and the
                                         same call ends at the same place on every machine, if
                                         time_limit is infinite. A ledger comes on top, with up to
                                         three times as much. A call that reaches it before the
                                         tolerance, or whose next refinement would, returns its
                                         best with TOLERANCE_NOT_REACHED */
    double time_limit;              /**< processor time that an impact may take, in s, >= 0. From
                                         0.1 s on it is kept within a factor of two; a history,
                                         events and a ledger come on top. 0 (default): 1 s, or no
                                         limit if `elements` or `time_step` is given or the method
                                         is `bem`. infinity: no limit. A call that reaches it, or
                                         whose next refinement would, returns its best with
                                         TOLERANCE_NOT_REACHED. That best depends on the machine;
                                         with max_work it does not */
    double speed_limit;             /**< flag FAST above this v_z0/c_s; >= 0, default 0.1 */
    double radius_limit;            /**< flag LARGE_CONTACT above this a_max/R; >= 0, default 0.1 */
    double displacement_limit;      /**< flag LONG_SLIDE above this tangential travel over a_max; >=
                                         0, default 0.3 */
    double dundurs_limit;           /**< flag COUPLED above this |beta| of an impact with friction;
                                         >= 0, default 0.1 */
} restitute_options;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, options)

/** Options and workspace. With `sync` the room for usual impacts is made at creation; otherwise a
 *  solver does not allocate any more after its first calls of a kind. One thread at a time. */
typedef struct restitute_solver restitute_solver;

/** @param options NULL for the defaults, else copied */
RESTITUTE_SINCE_0_1 int restitute_solver_create(const restitute_options *options,
    restitute_solver **solver, restitute_error *error);
/** Release a solver; NULL is allowed. */
RESTITUTE_SINCE_0_1 void restitute_solver_destroy(restitute_solver *solver);

/* -------------------------------------------------------------------------------------- results */

/** Assumptions of the model that a result strains, bits of restitute_result.flags (theory.md, 11).
 *  X(name, bit, text) */
#define RESTITUTE_FLAG_LIST(X)                                                                     \
    X(FAST, 1, "the speed is not small against the shear wave speed: waves carry energy away")     \
    X(LARGE_CONTACT, 2,                                                                            \
      "the contact is not small against the sphere: the half-space model overrates the depth")     \
    X(LONG_SLIDE, 4,                                                                               \
      "the sphere slides far during the contact: it is not axisymmetric any more")                 \
    X(COUPLED, 8,                                                                                  \
      "the bodies are elastically unlike: the model neglects that normal and tangential "          \
      "problem are coupled")                                                                       \
    X(UNMEASURED, 16,                                                                              \
      "the contact time is outside the window of times in which the material was measured")

#define RESTITUTE_FLAG_ENUM(name, bit, text) RESTITUTE_FLAG_##name = (bit),
/** One bit a strained assumption, see @ref RESTITUTE_FLAG_LIST. */
typedef enum restitute_flag { RESTITUTE_FLAG_LIST(RESTITUTE_FLAG_ENUM) } restitute_flag;
#undef RESTITUTE_FLAG_ENUM

/** Text of one flag; "unknown flag" for what is no single known bit. */
RESTITUTE_SINCE_0_1 const char *restitute_flag_text(int flag);

/** What came out. Units: T, d0, a_el, m v_z0^2/d0 after @ref restitute_solve; SI after @ref
 *  restitute_solve_scene. */
typedef struct restitute_result {
    size_t struct_size;        /**< set by @ref restitute_result_init */
    double ez, ex;             /**< restitution pair. ex > 0 if the contact point turns back, as in
                                    (26). ex = -1 without friction (mu = 0). With psi = 0 it is the
                                    value without slip */
    double error_ez, error_ex; /**< estimated absolute errors of ez and ex, the merging of terms
                                    included */
    double contact_time;       /**< T or s; infinity with NO_REBOUND, and of `sync` where ez is less
                                    than 0.01 tolerance (not NO_REBOUND if G_inf > 0) */
    double max_indentation;    /**< d0 or m; with NO_REBOUND where the sphere was given up */
    double max_contact_radius; /**< a_el or m */
    double max_normal_force;   /**< m v_z0^2/d0 or N */
    double merging_bound;      /**< bound on the change of ez and ex by merged relaxation times,
                                    docs/theory.md */
    int64_t terms_merged;      /**< relaxation times that were merged: too fast or too slow to
                                    matter */
    int64_t elements, steps;   /**< of the run that gave the pair: elements over the largest radius,
                                    time steps; of `sync`, if no elements were stepped, its points
                                    of collocation, up to that radius and in the whole contact */
    double element_spacing;    /**< dx: a_el or m */
    double time_step;          /**< T or s */
    double work;               /**< spent, all runs for the pair together, in nominal seconds; see
                                    restitute_options.max_work */
    double speed_ratio;        /**< v_z0/c_s, c_s = sqrt(G(T)/density); NaN for a dimensionless
                                    impact */
    double radius_ratio;       /**< a_max/R; NaN likewise */
    double displacement_ratio; /**< |sliding speed| d_max/v_z0 over a_max; NaN likewise */
    double dundurs_beta;       /**< of the two bodies, as in @ref restitute_numbers; 0 for a
                                    dimensionless impact */
    int flags;                 /**< bits of @ref restitute_flag: which of these pass the limits of
                                    the options */
    const char *method;        /**< its name; a string that lives as long as the library */
} restitute_result;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, result)

/** Where the energy went (docs/theory.md, section 8), as fractions of the energy that came in: of
 *  (1/2) m v_z0^2 in z, and of the energy of the contact point's tangential motion in x. Each
 *  account adds up to 1 - residual. Where slip is as short as the relaxation of terms that are
 *  merged for the pair, friction, viscous and left are those of a run with fewer terms merged:
 *  merging then moved 0.006 at most among them (method sync, 3000 impacts). If that run passes
 *  max_work or time_limit, or misses the tolerance, they are those of the pair's run, and a remark
 *  says so: merged terms moved up to 0.4 among them. With psi below an eighth of the tolerance, and
 *  where slip is known less exactly than what it changes, slip is left out: then left has what
 *  friction takes. With given elements or time_step euler does not follow slip that is shorter than
 *  its steps. */
typedef struct restitute_ledger {
    size_t struct_size;                  /**< set by @ref restitute_ledger_init */
    double rebound_z, viscous_z, left_z; /**< kinetic after; dissipated in contact; left in the
                                              foundation */
    double residual_z;                   /**< what the method loses: 1 - the three; of first order
                                              in the step (method sync: of second). In x it is
                                              larger at small psi, as its unit is psi^2 */
    double rebound_x, friction_x, viscous_x, left_x;
    double residual_x;
} restitute_ledger;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, ledger)

/** Time history, into arrays of the caller; a NULL array is not wanted. Samples are evenly spaced,
 *  first touch and the end of contact included; of a sphere that sinks in (NO_REBOUND) the method
 *  sync gives first touch alone. Units as in @ref restitute_result. In the dimensionless case the
 *  tangential velocity is U' (theory.md, 2), for psi = 0 or infinity over its value at first touch,
 *  and the tangential force is in units of mu m v_z0^2/d0. In SI the tangential velocity is positive
 *  along the incoming sliding, and the force if it brakes that. */
typedef struct restitute_history {
    size_t struct_size;          /**< set by @ref restitute_history_init */
    size_t capacity;             /**< length of every array given, in [2, 1e9]; required, default
                                      0 */
    size_t count;                /**< out: samples written; with the methods euler and bem not more
                                      than steps and one */
    double *time;
    double *indentation;
    double *contact_radius;
    double *stick_radius;        /**< 0 in gross slip; the contact radius if all sticks */
    double *normal_force;
    double *tangential_force;    /**< on the contact point, braking positive */
    double *normal_velocity;     /**< positive into the partner */
    double *tangential_velocity; /**< of the contact point */
} restitute_history;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, history)

/** Solve one dimensionless impact.
 *
 *  @param ledger,history,error  optional, NULL: not wanted
 *  @return OK, NO_REBOUND, TOLERANCE_NOT_REACHED or an error; see @ref RESTITUTE_STATUS_LIST
 *
 *      restitute_impact impact; restitute_impact_init(&impact);
 *      impact.psi = 2; impact.delta1 = 1; impact.gamma = 1;
 *      restitute_result result; restitute_result_init(&result);
 *      int status = restitute_solve(solver, &impact, &result, NULL, NULL, &error); */
RESTITUTE_SINCE_0_1 int restitute_solve(restitute_solver *solver, const restitute_impact *impact,
    restitute_result *result, restitute_ledger *ledger, restitute_history *history,
    restitute_error *error);

/** Solve one impact in SI units; otherwise like @ref restitute_solve. */
RESTITUTE_SINCE_0_1 int restitute_solve_scene(restitute_solver *solver,
    const restitute_scene *scene, restitute_result *result, restitute_ledger *ledger,
    restitute_history *history, restitute_error *error);

/* --------------------------------------------------------------------------------- many impacts */

/** Solve many dimensionless impacts, by several threads. Every case gives the bits that @ref
 *  restitute_solve gives it, whatever the number of threads, unless time_limit ends it.
 *
 *  With the method `sync` cases that follow each other and differ in psi alone share their normal
 *  motion, as in a @ref restitute_plan.
 *
 *  A case that fails stops no other: its result stays as it was, those of the others are filled,
 *  though the call returns the failure. To get the message of a failed case, solve that case alone.
 *  A long batch that is to show progress or to be stopped goes in pieces: a call costs no more than
 *  one solver a thread.
 *
 *  @param n         number of cases; 0 is allowed
 *  @param impacts   n cases, each prepared by @ref restitute_impact_init
 *  @param options   for all cases, with the number of threads; NULL: the defaults
 *  @param results   optional: n results, each prepared by @ref restitute_result_init
 *  @param statuses  optional: n statuses, one a case
 *  @param error     optional: of the case that gave the return value, e.g. "impacts[17]: psi = -1:
 *                   must be in [0, 1e+12] or inf"
 *  @return OK if all cases are OK; else the status of the first failed case by index; if none
 *          failed, that of the first with a remark. A call that is refused as a whole (ERROR_NULL,
 *          ERROR_MEMORY, ERROR_DOMAIN of options, ERROR_STRUCT_SIZE of options or of any impact or
 *          result) touches nothing, neither results nor statuses
 *
 *      restitute_impact impacts[100]; restitute_result results[100]; int statuses[100];
 *      for (int i = 0; i < 100; i++) {
 *          restitute_impact_init(&impacts[i]); restitute_result_init(&results[i]);
 *          impacts[i].psi = 0.1*i;
 *      }
 *      int status = restitute_solve_many(100, impacts, NULL, results, statuses, &error); */
RESTITUTE_SINCE_0_1 int restitute_solve_many(size_t n, const restitute_impact *impacts,
    const restitute_options *options, restitute_result *results, int *statuses,
    restitute_error *error);

/** Solve many impacts in SI units, of any materials; otherwise like @ref restitute_solve_many
 *  ("scenes[17]: ..."). */
RESTITUTE_SINCE_0_1 int restitute_solve_scene_many(size_t n, const restitute_scene *scenes,
    const restitute_options *options, restitute_result *results, int *statuses,
    restitute_error *error);

/* --------------------------------------------------------------- one solid, many sliding speeds */

/** The normal motion of one impact, for any number of sliding speeds.
 *
 *  The normal motion is independent of sliding. With the method `sync` a plan solves it once, at
 *  each resolution that a call needs. Every further call has the tangential motion alone to solve,
 *  which is half of the work. With other methods each call solves the whole impact.
 *
 *  Every call gives the status, the message and the bits that @ref restitute_solve gives this
 *  impact; `work` counts what was solved before as if it were solved again. One thread at a time,
 *  as a solver. */
typedef struct restitute_plan restitute_plan;

/** A plan for a dimensionless impact of any psi.
 *
 *  @param impact   its psi is not used; copied, but `material` is to outlive the plan
 *  @param options  NULL: the defaults with the method `sync`; copied
 *  @param plan     the new plan, to be destroyed by @ref restitute_plan_destroy
 *  @return OK or an error: what @ref restitute_solver_create or @ref restitute_solve refuses is
 *          refused here
 *
 *      restitute_plan *plan;
 *      restitute_plan_create(&impact, NULL, &plan, &error);
 *      for (int i = 0; i < n; i++)
 *          restitute_plan_solve(plan, psi[i], &result[i], NULL, NULL, &error);
 *      restitute_plan_destroy(plan); */
RESTITUTE_SINCE_0_1 int restitute_plan_create(const restitute_impact *impact,
    const restitute_options *options, restitute_plan **plan, restitute_error *error);

/** A plan for a scene in SI units, sliding at any speed; otherwise like @ref restitute_plan_create.
 *
 *  @param scene  its tangential_speed and spins are not used; copied, but `material` is to outlive
 *                the plan */
RESTITUTE_SINCE_0_1 int restitute_plan_create_scene(const restitute_scene *scene,
    const restitute_options *options, restitute_plan **plan, restitute_error *error);

/** Solve the impact of a plan.
 *
 *  @param sliding  of a plan for an impact: psi. Of a plan for a scene: the speed at which the
 *                  contact point slides before the impact, m/s, tangential_speed + radius1*spin1 +
 *                  radius2*spin2. Either in its range above
 *  @param result,ledger,history,error  optional, as in @ref restitute_solve, in the units of the
 *          plan
 *  @return as @ref restitute_solve */
RESTITUTE_SINCE_0_1 int restitute_plan_solve(restitute_plan *plan, double sliding,
    restitute_result *result, restitute_ledger *ledger, restitute_history *history,
    restitute_error *error);

/** Release a plan; NULL is allowed. */
RESTITUTE_SINCE_0_1 void restitute_plan_destroy(restitute_plan *plan);

/* -------------------------------------------------------------------------- two bodies in space */

/** A sphere, or a plane that nothing moves, in any frame of reference. SI units; ranges are those
 *  of a scene. */
typedef struct restitute_body {
    size_t struct_size; /**< set by @ref restitute_body_init */
    double position[3]; /**< m, of the centre; of any point of a plane; each up to 1e100 */
    double velocity[3]; /**< m/s, of the centre; of the plane, which keeps it */
    double spin[3];     /**< rad/s, right-handed about the axes; not used for a plane */
    double radius;      /**< m; infinity: a plane; required, default 0 */
    double mass;        /**< kg; infinity: a sphere held fast; not used for a plane; required,
                             default 0 */
    double inertia;     /**< kg m^2; default 0 stands for a solid sphere */
    double normal[3];   /**< of a plane: points out of it, of length 1e-100 to 1e100; required for a
                             plane, default 0; not used for a sphere */
} restitute_body;

/** Prepare a body at rest at the origin. */
RESTITUTE_INIT(RESTITUTE_SINCE_0_1, body)

/** What is between two bodies that collide. */
typedef struct restitute_collision {
    size_t struct_size;                 /**< set by @ref restitute_collision_init */
    const restitute_material *material; /**< required; default NULL */
    int deformable;                     /**< a @ref restitute_deformable; default ONE_BODY_DEFORMS
                                             */
    double friction;                    /**< mu, as in @ref restitute_scene; default 0 */
    double touch_gap;                   /**< how far apart, over the sum of the radii (the one
                                             radius with a plane), bodies still touch; in [0, 1],
                                             default 1e-6. Overlaps up to a tenth are touch, too */
    double wave_density;                /**< kg/m^3, as in @ref restitute_scene; default 0 */
} restitute_collision;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, collision)

/** One impact of two bodies: `first` and `second` get the velocities and spins that they have after
 *  it; positions stay.
 *
 *  The impact is in the plane of the normal and of the sliding direction; what twists about the
 *  normal is untouched. Linear and angular momentum are conserved to rounding (a plane and a body
 *  held fast take what they get); angular momentum for bodies that touch: with a gap or an overlap
 *  it misses gap times the tangential impulse, since each body is struck at its radius.
 *
 *  @param first,second  in: before, out: after the impact. One may be a plane
 *  @param result        optional: the pair, its errors, ratios and flags, in SI units
 *  @return ERROR_DOMAIN also for bodies that do not touch or that separate
 *
 *      restitute_body ball, floor; restitute_collision collision;    // each by its init function
 *      floor.radius = INFINITY; floor.normal[2] = 1;
 *      ball.radius = 0.01; ball.mass = 4e-3; ball.position[2] = 0.01;
 *      ball.velocity[0] = 0.1; ball.velocity[2] = -0.2;
 *      collision.material = rubber; collision.friction = 0.3;
 *      restitute_collide(solver, &collision, &ball, &floor, NULL, &error);   // ball: after it */
RESTITUTE_SINCE_0_1 int restitute_collide(restitute_solver *solver,
    const restitute_collision *collision, restitute_body *first, restitute_body *second,
    restitute_result *result, restitute_error *error);

/** One call: the pair of a dimensionless impact with default options; allocates and frees a solver.
 *
 *      double ez, ex;
 *      restitute_pair(7.0/6, 2.0, 1.0, 1.0, &ez, &ex, NULL);      // chi, psi, delta1, gamma */
RESTITUTE_SINCE_0_1 int restitute_pair(double chi, double psi, double delta1, double gamma,
    double *ez, double *ex, restitute_error *error);

/** One call: the pair of a scene with default options. Model limits that it passes stand in the
 *  message of `error`. */
RESTITUTE_SINCE_0_1 int restitute_scene_pair(const restitute_scene *scene, double *ez, double *ex,
    restitute_error *error);

/** psi_c = 2 chi (1 + ez) - ez (1 if 2 chi <= 1): from it on the contact slips to the end (31),
 *  exactly (theory.md, 4), and ex = 2 chi (1 + ez)/psi - 1 (27). NaN if chi is not > 0 or ez is not
 *  in [0, 1]. */
RESTITUTE_SINCE_0_1 double restitute_critical_psi(double chi, double ez);

#ifdef __cplusplus
}
#endif

#endif
