/** @file table.h
 *  Component `table` of restitute: restitution pairs in some ten nanoseconds, with a verified
 *  error.
 *
 *  Link restitute::table. It needs the core alone. A table is built in memory for one contact: one
 *  material, one friction coefficient. It serves all speeds and angles; for solid spheres it serves
 *  all sizes and other friction coefficients, see @ref restitute_table_contact_set. It then answers
 *
 *      (normal speed, sliding speed)  ->  (ez, ex)
 *
 *  without allocation or lock and without errno, from any number of threads at once. Files of
 *  tables: table_files.h.
 *
 *  Five lines:
 *
 *      restitute_scene scene; ...                            // material, radius1, mass1, friction
 *      restitute_table *table; restitute_table_build(&scene, NULL, &table, &error);
 *      double ez, ex;
 *      restitute_table_pair(table, NULL, 0.5, 0.2, &ez, &ex, &error);
 *      restitute_table_destroy(table);
 *
 *  What is tabulated: ez over the speed; ex over the speed and psi, in one panel [0, 1] and one [1,
 *  psi_c]. From psi_c on the contact slips to the end and ex is its closed form (27). Between nodes
 *  there are cubics with continuous first derivatives within a panel. The table is continuous
 *  everywhere, at psi = 1 and psi_c to rounding, and 0 <= ez <= 1, |ex| <= 1 always. It is verified
 *  while it is built: at places between the nodes it is compared with impacts solved afresh.
 *
 *  Limits
 *  - Below the lowest and above the highest speed of the table the solid answers as at that end,
 *    with its delta1: ez is constant there and ex depends on psi alone. psi itself has no ends.
 *  - v_n -> 0 with v_t > 0: psi -> infinity, ex = -1. v_t = 0: psi = 0, the no-slip value, also
 *    with v_n = 0.
 *  - friction 0: ex = -1, even with v_t = 0. Friction infinity: psi = 0, ex is the no-slip value.
 *
 *  The rules of restitute.h hold. Tables are immutable and may be shared by threads.
 *
 *  SPDX-License-Identifier: BSD-3-Clause
 */
#ifndef RESTITUTE_TABLE_H
#define RESTITUTE_TABLE_H

#include <restitute/restitute.h>

#ifdef __cplusplus
extern "C" {
#endif

/** An immutable table, destroyed by @ref restitute_table_destroy. */
typedef struct restitute_table restitute_table;

/* ---------------------------------------------------------------------------------------- build */

/** How to build. */
typedef struct restitute_table_options {
    size_t struct_size;  /**< set by @ref restitute_table_options_init */
    double speed[2];     /**< m/s, lowest and highest normal speed; 1e-50 <= lowest <= highest <=
                              1e12, highest/lowest up to 1e15; default 1e-4, 100 */
    double tolerance;    /**< largest absolute error of ez and ex, in [1e-7, 0.1]; default 1e-5 */
    int threads;         /**< in [0, 1024]; 0: as many as OpenMP offers; default 1. The table has
                              the same bits for all, unless time_limit ends it. OpenMP ends a
                              program whose threads it cannot start, and hangs in a child (fork) of
                              one that used them; 1 never enters it */
    int64_t max_impacts; /**< refinement ends at 0.8 of so many impacts, > 0; default 12000. Checks
                              add a tenth at 12000 and double the count at some hundred. The build
                              gives its best then, with TOLERANCE_NOT_REACHED, or
                              ERROR_TOO_MUCH_WORK if the first columns take more */
    double time_limit;   /**< refinement ends likewise at 0.8 of so many seconds of elapsed time, >
                              0, default 20; infinity: no limit. A table that it ends depends on the
                              machine. Its stated errors hold */
    /** as in @ref restitute_options, with the same defaults */
    double speed_limit, radius_limit, displacement_limit, dundurs_limit;
    /** asked at every speed before its impacts are solved, from any thread of the build; nonzero
     *  ends the call with ERROR_INTERRUPTED. NULL (default): nobody is asked */
    int (*interrupted)(void *data);
    void *interrupted_data; /**< is handed to it */
} restitute_table_options;

/** Prepare with the defaults named above. */
RESTITUTE_INIT(RESTITUTE_SINCE_0_1, table_options)

/** Build a table of one contact. Over six decades of speed at the default tolerance it takes some
 *  hundred to ten thousand impacts: hundredths of a second to seconds on one core.
 *
 *  @param scene    material, radii, masses, inertias and friction are used; speeds and spins are
 *                  not
 *  @param options  NULL: the defaults
 *  @param table    the new table
 *  @param error    optional; its message says if contact times leave the window of the material,
 *                  @ref restitute_material_set_window
 *  @return OK; TOLERANCE_NOT_REACHED: a table whose verified error is above the tolerance;
 *          ERROR_DOMAIN, ERROR_NULL, ERROR_MEMORY, ERROR_STRUCT_SIZE, ERROR_TOO_MUCH_WORK,
 *          ERROR_INTERRUPTED, and what the solver may return for an impact */
RESTITUTE_SINCE_0_1 int restitute_table_build(const restitute_scene *scene,
    const restitute_table_options *options, restitute_table **table, restitute_error *error);

/** Called when a table is finished: `done` of `count`. Calls come one at a time, but from any
 *  thread. */
typedef void (*restitute_table_progress)(void *data, size_t done, size_t count);

/** Build the tables of all pairs of some materials, several at once by `options->threads`.
 *
 *  Each table has the bits that @ref restitute_table_build gives it. A material with itself: both
 *  bodies deform; with another one: @ref restitute_material_effective.
 *
 *  @param count      number of materials, in [1, 1000]
 *  @param materials  `count` materials
 *  @param scene      all but `material` and `deformable` is used
 *  @param progress   optional; `data` is given to it
 *  @param tables     count (count + 1)/2 tables; that of materials i <= j is
 *                    tables[j (j + 1)/2 + i]
 *  @return OK; TOLERANCE_NOT_REACHED if any table misses it; if any fails, the first failure, and
 *          no table is made: those after it are not begun any more
 *
 *      restitute_table *tables[3];                                            // 00, 01, 11
 *      restitute_table_build_many(2, materials, &scene, NULL, NULL, NULL, tables, &error); */
RESTITUTE_SINCE_0_1 int restitute_table_build_many(size_t count,
    const restitute_material *const *materials, const restitute_scene *scene,
    const restitute_table_options *options, restitute_table_progress progress, void *data,
    restitute_table **tables, restitute_error *error);

/** Release a table; NULL is allowed. No call that uses it may still run. */
RESTITUTE_SINCE_0_1 void restitute_table_destroy(restitute_table *table);

/* -------------------------------------------------------------------------------------- look up */

/** Another contact that a table serves: what turns its speeds into the table's numbers.
 *
 *  Filled by @ref restitute_table_contact_set; read-only but for `touch_gap`. */
typedef struct restitute_table_contact {
    size_t struct_size;  /**< set by @ref restitute_table_contact_init */
    double speed_factor; /**< speed in the table over speed of this contact; default 0: not set,
                              refused */
    double psi_factor;   /**< psi v_n/|v_t| (22); 0: no slip, infinity: no friction */
    double radius, mass; /**< m, kg: effective ones (docs/theory.md, section 10) of this contact */
    double strain_factors[4]; /**< of this contact over the table's, at the speed in the table: of
                                   v_z/c_s, a_max/R, d_max/a_max, and of the contact time over the
                                   relaxation times */
    double dundurs_beta; /**< of this contact */
    double touch_gap;    /**< as in @ref restitute_collision; default 1e-6 */
} restitute_table_contact;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, table_contact)

/** Fill `contact` from a scene; its speeds and spins are not used.
 *
 *  A table serves every contact of its material with its chi. The friction may be any, but 0 with a
 *  table made for friction 0, which knows nothing of slip. The impact sees size through its
 *  duration alone, so a size is a factor on the speed; solid spheres of one
 *  material have the same chi whatever their sizes, with walls and with each other. The same holds
 *  for the material at another temperature: all its relaxation times may be longer by one factor,
 *  and all its moduli larger by one factor.
 *
 *  @return OK; ERROR_DOMAIN for a scene that the table does not serve; ERROR_NULL,
 *          ERROR_STRUCT_SIZE, ERROR_MEMORY
 *
 *      scene.radius1 = 0.002; scene.mass1 = 3.3e-5;
 *      restitute_table_contact small; restitute_table_contact_init(&small);
 *      restitute_table_contact_set(table, &scene, &small, &error); */
RESTITUTE_SINCE_0_1 int restitute_table_contact_set(const restitute_table *table,
    const restitute_scene *scene, restitute_table_contact *contact, restitute_error *error);

/** The pair of an impact.
 *
 *  @param contact        NULL: the table's own
 *  @param normal_speed   m/s, approaching, in [0, 1e100]; what is below 1e-280 counts as 0
 *  @param sliding_speed  m/s, of the contact point (v_x0 + R w0: spin included; that of a scene is
 *                        of the centres), in [-1e100, 1e100]; its sign does not matter
 *  @param ez,ex          either may be NULL: not wanted
 *  @return OK; ERROR_DOMAIN for a speed out of its range; ERROR_NULL, ERROR_STRUCT_SIZE
 *
 *      restitute_table_pair(table, NULL, 0.5, -0.2, &ez, &ex, &error); // then 0.5 ez, 0.2 ex */
RESTITUTE_SINCE_0_1 int restitute_table_pair(const restitute_table *table,
    const restitute_table_contact *contact, double normal_speed, double sliding_speed, double *ez,
    double *ex, restitute_error *error);

/** Many pairs; each has the bits that @ref restitute_table_pair gives it. The calling thread does
 *  all.
 *
 *  @param contact         NULL: the table's own
 *  @param n               number of impacts; 0 is allowed
 *  @param normal_speeds   n values
 *  @param sliding_speeds  n values
 *  @param ez,ex           n values each, may be the arrays of the speeds; NULL: not wanted
 *  @return OK; ERROR_DOMAIN if any speed is out of its range: nothing is written then, and `error`
 *          names the first; ERROR_NULL, ERROR_STRUCT_SIZE */
RESTITUTE_SINCE_0_1 int restitute_table_pair_many(const restitute_table *table,
    const restitute_table_contact *contact, size_t n, const double *normal_speeds,
    const double *sliding_speeds, double *ez, double *ex, restitute_error *error);

/** One impact of two bodies, by the table: what @ref restitute_collide does, with the pair from the
 *  table.
 *
 *  The bodies may have any size; their chi must be the table's. Positions and speeds are checked as
 *  there; positions stay. What deforms is what the table was built for: one body, unless its scene
 *  said both. A size is a factor on the speed, for solid spheres size^-5: half the size is 32 times
 *  the speed in the table. Where that leaves the table's range its end is taken, and the message of
 *  `error` has that remark. So build for speeds that cover the sizes.
 *
 *  @param contact       NULL: the table's own. Its size is not used, that of the bodies is
 *  @param first,second  in: before, out: after the impact. One may be a plane
 *  @param ez,ex         optional: the pair
 *  @return OK; ERROR_DOMAIN also for bodies that do not touch or that separate; ERROR_NULL,
 *          ERROR_STRUCT_SIZE
 *
 *      restitute_table_collide(table, NULL, &ball, &floor, NULL, NULL, &error); */
RESTITUTE_SINCE_0_1 int restitute_table_collide(const restitute_table *table,
    const restitute_table_contact *contact, restitute_body *first, restitute_body *second,
    double *ez, double *ex, restitute_error *error);

/** Which limits of the model an impact passes: the flags of a solver's @ref restitute_result, but
 *  within some hundredths of a limit, since ratios between nodes are interpolated.
 *
 *  @param contact        NULL: the table's own
 *  @param flags          bits of @ref restitute_flag, by the limits of the options the table was
 *                        built with and the window of its material, which shifts with its times.
 *                        Outside the table's range those of its ends
 *  @return OK; ERROR_DOMAIN for a speed out of its range; ERROR_NULL, ERROR_STRUCT_SIZE
 *
 *      restitute_table_flags(table, &small, 0.5, -0.2, &flags, &error); */
RESTITUTE_SINCE_0_1 int restitute_table_flags(const restitute_table *table,
    const restitute_table_contact *contact, double normal_speed, double sliding_speed, int *flags,
    restitute_error *error);

/* ------------------------------------------------------------------------------ what a table is */

/** What a table says of itself. Speeds are normal speeds in m/s. */
typedef struct restitute_table_info {
    size_t struct_size;              /**< set by @ref restitute_table_info_init */
    double speed[2];                 /**< the range covered */
    double chi;                      /**< (22) */
    double gamma, delta1[2];         /**< (23); delta1 at the ends of the range; NaN for a solid
                                          that has none */
    double friction;                 /**< of the contact */
    double radius, mass;             /**< m, kg: effective ones of the contact */
    double tolerance;                /**< as requested */
    double error_ez, error_ex;       /**< verified: bounds of the errors, from the checks */
    double rebound_speed;            /**< up to it the sphere sinks in and ez = 0; 0: it rebounds
                                          everywhere */
    double fast_speed;               /**< from it on v_z/c_s passes its limit; infinity: nowhere in
                                          the range */
    double large_contact_speed;      /**< from it on a_max/R passes its limit; likewise */
    double long_slide_speed;         /**< from it on the slide passes its limit at 45 degrees;
                                          likewise */
    int64_t impacts;                 /**< solved for the table, those of the checks included */
    int64_t checks;                  /**< places at which it was compared with a solved impact */
    int64_t speeds;                  /**< nodes along the speed */
    int64_t stick_cells, slip_cells; /**< cells of psi in [0, 1] and [1, psi_c] */
    size_t bytes;                    /**< of memory that the table takes */
    char version[32];                /**< of the library that built it */
} restitute_table_info;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, table_info)

/** @return OK, ERROR_NULL, ERROR_STRUCT_SIZE
 *
 *      restitute_table_info info; restitute_table_info_init(&info);
 *      restitute_table_describe(table, &info, &error);          // info.error_ex */
RESTITUTE_SINCE_0_1 int restitute_table_describe(const restitute_table *table,
    restitute_table_info *info, restitute_error *error);

/* --------------------------------------------------------------------------- numbers of a table */

/** All of a table in plain numbers, for those who store it elsewhere (table_files.h does) or draw
 *  it. @ref restitute_table_create requires all of them.
 *
 *  Nodes are products of speeds and of places of psi. The axis of speed is s(v), log2(v) within
 *  7e-7; cells may have any width, and two equal speeds are a seam. psi has two panels of even
 *  cells: psi itself from 0 to 1, then t(y) from 0 to 1, y = (psi - 1)/(psi_c - 1); see
 *  table_files.h. At a node stand g and its derivatives: g = e_x up to psi = 1, and g = psi e_x - y
 *  e_z beyond, which is 0 at psi_c. */
typedef struct restitute_table_data {
    size_t struct_size;                      /**< set by @ref restitute_table_data_init */
    double low, high;                        /**< m/s, range of normal speeds */
    double tolerance, error_ez, error_ex;
    int64_t impacts, checks;
    char version[32];                        /**< of the library that built it */

    double chi, gamma, delta1;               /**< of the contact; delta1 at 1 m/s; gamma and delta1
                                                  are NaN for solids without */
    double psi_factor;                       /**< psi v_n/|v_t| */
    double duration;                         /**< T at 1 m/s, s (22) */
    double friction, radius, mass;           /**< m, kg: effective */
    double poisson_ratio, equilibrium_modulus, parallel_viscosity;
    double density, dundurs_beta;            /**< see @ref restitute_numbers */
    double shortest, longest;                /**< s, the window of the material */
    double speed_limit, radius_limit, displacement_limit, dundurs_limit; /**< see @ref
                                                  restitute_options */
    int64_t terms;                           /**< in [0, 1e6] */

    int64_t speeds, stick_cells, slip_cells;
    const double *relaxation_time, *modulus; /**< [terms]; s, Pa */
    const double *speed;                     /**< [speeds], m/s, ascending */
    const double *ez;                        /**< [speeds][2]: e_z, de_z/ds */
    const double *strain;                    /**< [speeds][4]: v_z/c_s, a_max/R, d_max/a_max,
                                                  contact time, s */
    const double *ex;                        /**< [speeds][stick_cells + 1 + slip_cells + 1][4]: g,
                                                  dg/ds, dg/dp, d2g/ds dp; p counts cells of psi */
} restitute_table_data;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, table_data)

/** The numbers of a table. The arrays belong to it and live as long as it does.
 *
 *  @return OK, ERROR_NULL, ERROR_STRUCT_SIZE */
RESTITUTE_SINCE_0_1 int restitute_table_data_get(const restitute_table *table,
    restitute_table_data *data, restitute_error *error);

/** A table of such numbers, copied. It looks up the bits that the one they came from does.
 *
 *  @return OK; ERROR_DOMAIN: no table has them, and `error` says which; ERROR_NULL,
 *          ERROR_STRUCT_SIZE, ERROR_MEMORY */
RESTITUTE_SINCE_0_1 int restitute_table_create(const restitute_table_data *data,
    restitute_table **table, restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
