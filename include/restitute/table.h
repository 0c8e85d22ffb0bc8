/** @file table.h
 *  Component `table` of restitute: restitution pairs in nanoseconds, with a known error.
 *
 *  Link restitute::table. It needs the core alone. A table is built in memory, for one contact (one material, one
 *  friction coefficient; any speeds and angles) or for ranges of the dimensionless numbers, and then answers
 *
 *      (normal speed, tangential speed)  ->  (ez, ex)
 *
 *  without allocation, lock or error number, from any number of threads at once. Files of tables: table_files.h.
 *
 *  Five lines:
 *
 *      restitute_table_family family; restitute_table_family_init(&family);
 *      family.scene = &scene;                                  // material, radius1, mass1, friction: see restitute.h
 *      family.speed[0] = 1e-4; family.speed[1] = 10;           // m/s
 *      restitute_table *table; restitute_table_build(&family, NULL, &table, NULL);
 *      restitute_table_value pair; restitute_table_pair(table, 0.5, 0.2, &pair);           // pair.ez, pair.ex
 *
 *  What is tabulated (THEORY 9): ez over the speed; ex over the speed and psi, in one panel [0, 1] that starts sticking
 *  and one [1, psi_c] that starts slipping. From psi_c on the contact slips to the end and ex is its closed form (27);
 *  nothing is stored there. The table is continuous everywhere, at psi = 1, psi_c and all seams to rounding (that of single precision in a table with axes of
 *  delta1 and gamma), and
 *  0 <= ez <= 1, |ex| <= 1 always. It is verified while it is built: half way between the points that it was built from, and in
 *  the middles of 24 of its cells (in a table with axes of delta1 and gamma at arbitrary places in every cell), it is compared with impacts solved
 *  afresh, and the largest difference is kept with it (@ref restitute_table_info).
 *
 *  Limits
 *  - Below the lowest and above the highest speed (delta1, gamma, chi) of the table the number is taken as that of the end:
 *    ez is constant there and ex depends on psi alone. psi itself has no ends.
 *  - v_n -> 0 with v_t > 0: psi -> infinity, ex = -1. v_t = 0: psi = 0, the no-slip value, also with v_n = 0.
 *  - friction 0: ex = -1, even with v_t = 0. Friction infinity: psi = 0, ex is the no-slip value.
 *
 *  The rules of restitute.h hold: every function returns a @ref restitute_status, a failed call leaves its outputs
 *  untouched, nothing is printed. Tables are immutable and may be shared by threads; a builder belongs to one thread at a time.
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

/* ---------------------------------------------------------------------------------------------------------- build */

/** Which impacts a table is for: those of one contact, or of ranges of the dimensionless numbers.
 *
 *  With `scene`: material, radii, masses, inertias, friction are the scene's; its speeds and spins are not used. The
 *  other members are then not used but `speed`. One table also serves all other sizes of the spheres, see @ref restitute_table_contact.
 *
 *  Without: standard solids and their limits, by ranges of chi, delta1 and gamma; a range whose ends are equal is no axis.
 *  An elastic scene or range (delta1 = 0 or gamma = infinity at both ends) needs no axis for the speed either. */
typedef struct restitute_table_family {
    size_t struct_size;           /**< set by @ref restitute_table_family_init */
    const restitute_scene *scene; /**< the contact; NULL (default): the ranges below. Not used after the build */
    double speed[2];              /**< m/s, lowest and highest normal speed; 1e-50 <= lowest <= highest <= 1e12,
                                     highest/lowest up to 1e15; default 1e-4, 100 */
    double chi[2];                /**< in [1/3, 1000]; default 7/6, 7/6 */
    double delta1[2];             /**< > 0 or both 0, up to 1e6, highest/lowest up to 1e12; default 1e-3, 100 */
    double gamma[2];              /**< > 0, up to 1e6, highest/lowest up to 1e12; or both 0 (Kelvin-Voigt) or both
                                     infinity (elastic); default 1, 1 */
} restitute_table_family;

/** Prepare with the defaults named above. */
RESTITUTE_API void restitute_table_family_init(restitute_table_family *family);

/** How to build. */
typedef struct restitute_table_options {
    size_t struct_size; /**< set by @ref restitute_table_options_init */
    double tolerance;   /**< largest absolute error of ez and of ex, in [1e-7, 0.1]; default 1e-5 */
    int threads; /**< in [0, 1024]; 0: as many as OpenMP offers; default 1. The table has the same bits for all. OpenMP ends a
                    program whose threads it cannot start, and hangs in a child (fork) of one that used them; 1 never enters it */
    int64_t max_impacts; /**< most impacts that may be solved, > 0; default 2e7. A build that reaches it gives its best
                            with TOLERANCE_NOT_REACHED, or ERROR_TOO_MUCH_WORK if there is none yet */
} restitute_table_options;

/** Prepare with the defaults named above. */
RESTITUTE_API void restitute_table_options_init(restitute_table_options *options);

/** Build a table. For one contact over six decades of speed at the default tolerance some hundred to some ten thousand impacts are
 *  solved: a tenth of a second to two seconds on one core. Solids with nu = 1/2 take the fewest. At a tolerance of 1e-4 or 1e-3 it is less.
 *
 *  @param options  NULL: the defaults
 *  @param table    the new table
 *  @param error    optional
 *  @return OK; TOLERANCE_NOT_REACHED: a table whose verified error is above the tolerance (a solid that does not rebound
 *          at low speeds has a kink in ez(v)); ERROR_DOMAIN, ERROR_NULL, ERROR_MEMORY, ERROR_STRUCT_SIZE,
 *          ERROR_TOO_MUCH_WORK, and what the solver may return for an impact */
RESTITUTE_API int restitute_table_build(const restitute_table_family *family, const restitute_table_options *options,
                                        restitute_table **table, restitute_error *error);

/** Release a table; NULL is allowed. No call that uses it may still run. */
RESTITUTE_API void restitute_table_destroy(restitute_table *table);

/* -------------------------------------------------------------------------------------------------------- look up */

/** A restitution pair. This struct will never change. */
typedef struct restitute_table_value {
    double ez, ex; /**< as in @ref restitute_result */
} restitute_table_value;

/** Derivatives of a pair, those of the table's own interpolation. At seams those of one side; 0 by the speed
 *  outside the table's range; those of ex are 0 where ex is kept at its bounds |ex| = 1. This struct will never change. */
typedef struct restitute_table_slope {
    double ez_normal;     /**< d ez/d v_n, s/m */
    double ex_normal;     /**< d ex/d v_n at constant v_t, s/m */
    double ex_tangential; /**< d ex/d |v_t|, s/m */
} restitute_table_slope;

/** The pair of an impact, from the table of one contact.
 *
 *  @param normal_speed      m/s, approaching, in [0, 1e100]; what is below 1e-280 counts as 0
 *  @param tangential_speed  m/s, of the contact point (v_x0 + R w0: spin included), in [-1e100, 1e100]; its sign does not
 *                           matter
 *  @return OK; ERROR_DOMAIN for a speed out of its range or a table without a contact; ERROR_NULL
 *
 *      restitute_table_value pair;
 *      restitute_table_pair(table, 0.5, -0.2, &pair);      // normal speed after: 0.5 pair.ez; sliding after: 0.2 pair.ex */
RESTITUTE_API int restitute_table_pair(const restitute_table *table, double normal_speed, double tangential_speed,
                                       restitute_table_value *pair);

/** Another contact that a table serves: what turns its speeds into the table's numbers.
 *
 *  For a table of one contact: same material (or two like bodies of it), friction and chi free to differ as follows: chi must be the table's,
 *  friction may be any. Solid spheres of one material have the same chi whatever their sizes, with walls and with each other. The impact sees size by
 *  the contact's duration alone, so that a size is a factor on the speed. For a table of ranges: any contact of a standard solid or
 *  one of its limits.
 *
 *  Filled by @ref restitute_table_contact_of; read-only and free to copy. */
typedef struct restitute_table_contact {
    size_t struct_size;  /**< set by @ref restitute_table_contact_init */
    double speed_factor; /**< speed in the table over speed of this contact (table of one contact) */
    double psi_factor;   /**< psi v_n/|v_t| (22); 0: no slip, infinity: no friction */
    double chi, gamma;   /**< (22), (23); used by tables of ranges */
    double delta1;       /**< (23) at 1 m/s; it goes with the fifth root of the speed; used by tables of ranges */
} restitute_table_contact;

/** Prepare as the table's own contact. */
RESTITUTE_API void restitute_table_contact_init(restitute_table_contact *contact);

/** Fill `contact` from a scene; its speeds and spins are not used.
 *
 *  @return OK; ERROR_DOMAIN for a scene that the table does not serve (another material or chi; a solid without delta1 and gamma); ERROR_NULL,
 *          ERROR_STRUCT_SIZE
 *
 *      scene.radius1 = 0.002; scene.mass1 = 3.3e-5;
 *      restitute_table_contact small; restitute_table_contact_init(&small);
 *      restitute_table_contact_of(table, &scene, &small, &error); */
RESTITUTE_API int restitute_table_contact_of(const restitute_table *table, const restitute_scene *scene,
                                             restitute_table_contact *contact, restitute_error *error);

/** The pair of an impact of another contact, and its derivatives.
 *
 *  @param contact  NULL: the table's own
 *  @param slope    optional, NULL: not wanted; at speeds below 1e-100 m/s that at 0
 *  @return as @ref restitute_table_pair */
RESTITUTE_API int restitute_table_pair_of(const restitute_table *table, const restitute_table_contact *contact,
                                          double normal_speed, double tangential_speed, restitute_table_value *pair,
                                          restitute_table_slope *slope);

/** Many pairs; each has the bits that @ref restitute_table_pair_of gives it. The calling thread does all.
 *
 *  @param contact            NULL: the table's own
 *  @param n                  number of impacts; 0 is allowed
 *  @param normal_speeds      n values
 *  @param tangential_speeds  n values
 *  @param ez,ex              n values each; either may be NULL: not wanted
 *  @return OK; ERROR_DOMAIN if any speed is out of its range: nothing is written then; ERROR_NULL */
RESTITUTE_API int restitute_table_pairs(const restitute_table *table, const restitute_table_contact *contact, size_t n,
                                        const double *normal_speeds, const double *tangential_speeds, double *ez,
                                        double *ex);

/** The pair by dimensionless numbers, from a table of ranges.
 *
 *  @param chi,delta1,gamma  >= 0, infinity allowed; outside the table's ranges its ends are taken
 *  @param psi               in [0, infinity]
 *  @return OK; ERROR_DOMAIN for a number out of its range or a table of one contact; ERROR_NULL
 *
 *      restitute_table_numbers_pair(table, 7.0/6, 2.0, 1.0, 0.5, &pair); */
RESTITUTE_API int restitute_table_numbers_pair(const restitute_table *table, double chi, double psi, double delta1,
                                               double gamma, restitute_table_value *pair);

/** Many pairs by dimensionless numbers; each has the bits that @ref restitute_table_numbers_pair gives it. The calling thread does all. From a
 *  table with axes of delta1 and gamma that is faster than one after the other, the more the larger the table: waits for memory are shared.
 *
 *  @param n                     number of impacts; 0 is allowed
 *  @param chi,psi,delta1,gamma  n values each, as @ref restitute_table_numbers_pair takes them
 *  @param ez,ex                 n values each; either may be NULL: not wanted
 *  @return OK; ERROR_DOMAIN if any number is out of its range, or for a table of one contact: nothing is written then; ERROR_NULL
 *
 *      double chi[2] = {1.2, 0.9}, psi[2] = {2, 0}, delta1[2] = {1, 0.3}, gamma[2] = {0.5, 0.5}, ez[2], ex[2];
 *      restitute_table_numbers_pairs(table, 2, chi, psi, delta1, gamma, ez, ex); */
RESTITUTE_API int restitute_table_numbers_pairs(const restitute_table *table, size_t n, const double *chi,
                                                const double *psi, const double *delta1, const double *gamma,
                                                double *ez, double *ex);

/* ------------------------------------------------------------------------------------------------ what a table is */

/** What a table says of itself. */
typedef struct restitute_table_info {
    size_t struct_size;         /**< set by @ref restitute_table_info_init */
    int of_contact;             /**< nonzero: a table of one contact; 0: of ranges */
    double speed[2];            /**< m/s, the range covered; NaN for a table of ranges */
    double chi[2];              /**< the range covered; both alike: no axis */
    double delta1[2], gamma[2]; /**< likewise; NaN for the contact of a solid that has none */
    double friction;            /**< of the contact; NaN for a table of ranges */
    double radius, mass;        /**< m, kg: effective ones of the contact; NaN for a table of ranges */
    double tolerance;           /**< as requested */
    double error_ez,
        error_ex;     /**< verified: largest difference at the points checked, and what the solver leaves open */
    int64_t impacts;  /**< solved for the table, those of the checks included */
    int64_t checks;   /**< points at which it was compared with a solved impact */
    int64_t nodes[4]; /**< values stored along speed (or delta1), gamma, chi and psi; 1: no axis. Of a table
                         with axes of delta1 and gamma: cells of ex, coefficients of each; places of chi and of psi in it */
    size_t bytes;     /**< of memory that the table takes */
    char version[32]; /**< of the library that built it */
} restitute_table_info;

RESTITUTE_API void restitute_table_info_init(restitute_table_info *info);

/** @return OK, ERROR_NULL, ERROR_STRUCT_SIZE
 *
 *      restitute_table_info info; restitute_table_info_init(&info);
 *      restitute_table_describe(table, &info, &error);          // info.error_ex */
RESTITUTE_API int restitute_table_describe(const restitute_table *table, restitute_table_info *info,
                                           restitute_error *error);

/* -------------------------------------------------------------------------------------------------- build in steps */

/** A build that goes on step by step, for progress, interruption and resumption. */
typedef struct restitute_table_builder restitute_table_builder;

/** @param options  NULL: the defaults; copied, like all that `family` names
 *  @return as @ref restitute_table_build; nothing is solved yet */
RESTITUTE_API int restitute_table_builder_create(const restitute_table_family *family,
                                                 const restitute_table_options *options,
                                                 restitute_table_builder **builder, restitute_error *error);

/** Release a builder; NULL is allowed. */
RESTITUTE_API void restitute_table_builder_destroy(restitute_table_builder *builder);

/** Solve some more impacts. The table does not depend on how the build is divided.
 *
 *  @param impacts  about how many, > 0
 *  @param table    set when the build is finished; otherwise untouched: let it be NULL before the first call
 *  @return as @ref restitute_table_build; OK also if more calls are needed. A call that failed, for want of memory say,
 *          may be made again: nothing that was solved is lost
 *
 *      restitute_table *table = NULL;
 *      while (!table && !interrupted && status >= 0)
 *          status = restitute_table_builder_run(builder, 1000, &table, &error); */
RESTITUTE_API int restitute_table_builder_run(restitute_table_builder *builder, size_t impacts, restitute_table **table,
                                              restitute_error *error);

/** Impacts solved so far, and how many there will be as far as is known by now. 0 for NULL. */
RESTITUTE_API int64_t restitute_table_builder_solved(const restitute_table_builder *builder);
RESTITUTE_API int64_t restitute_table_builder_expected(const restitute_table_builder *builder);

/** Results of the impacts solved so far, four numbers each (ez, ex and their estimated errors) in the order in which they
 *  were asked for: all that is needed to go on later. They live until the next call that changes the builder.
 *
 *  @param count  number of impacts; 0 for NULL */
RESTITUTE_API const double *restitute_table_builder_journal(const restitute_table_builder *builder, size_t *count);

/** Give a new builder of the same family and options the journal of another; it then goes on from there to the same table.
 *
 *  @param journal  4 count numbers, copied
 *  @return OK; ERROR_DOMAIN for a builder that has run already, or numbers that are no results; ERROR_NULL, ERROR_MEMORY */
RESTITUTE_API int restitute_table_builder_restore(restitute_table_builder *builder, const double *journal, size_t count,
                                                  restitute_error *error);

/* ------------------------------------------------------------------------------------------------- all of a table */

/** All of a table in plain numbers, to send or to store it (table_files.h does). Speed and gamma are divided by octaves:
 *  `parts` cells in each (a power of 2), as wide as each other, from `low` to `high`, which are seams; a cell has four nodes, evenly
 *  spaced, those at its ends shared. psi: `stick_cells` such cells of psi from 0 to 1, then `slip_cells` of r(y) = sqrt(y + c^2) - c, c = 1/64, from y = 0
 *  to 1/2, then as many of r(1 - y); y = (psi - 1)/(psi_c - 1).
 *
 *  In a cell values are products of cubics through its nodes. In a table of speed (or delta1) and psi alone with 1/2 < chi <= 2 and a slip side they are
 *  cubics of 1/(1 + ez), and of ex - (2 chi (1 + ez)/max(1, psi) - 1): psi_c - 1 = (2 chi - 1)(1 + ez) is then found without a division. */
typedef struct restitute_table_data {
    size_t struct_size; /**< set by @ref restitute_table_data_init */
    int64_t of_contact; /**< nonzero: of one contact; then the first axis is the speed (m/s), else delta1 */
    double range[3][2]; /**< as requested: speed or delta1, gamma, chi */
    double tolerance, error_ez, error_ex;
    int64_t impacts, checks;
    char version[32]; /**< of the library that built it */

    double psi_factor, own_chi, own_gamma, own_delta1; /**< of the contact, see @ref restitute_table_contact */
    double duration;                                   /**< T of the contact at 1 m/s, s */
    double friction, radius, mass;                     /**< of the contact; m, kg: effective ones */
    double modulus_factor;                             /**< 1/2 if both bodies deform, else 1 */
    double poisson_ratio, equilibrium_modulus, parallel_viscosity; /**< of its material; Pa, Pa s */
    int64_t terms;
    const double *relaxation_time, *modulus; /**< s, Pa; `terms` values each */

    double low[2], high[2];          /**< ends of the axes of speed (or delta1) and gamma; both alike: one node */
    int64_t parts[2];                /**< cells an octave; 0: one node */
    double chi_low, chi_high;        /**< ends of chi */
    int64_t chi_cells;               /**< even cells of chi, with a cubic each; 0: one node */
    int64_t stick_cells, slip_cells; /**< 0: one node of psi */
    int64_t nodes[4]; /**< out: nodes of speed, gamma, chi, psi. In: not used, see @ref restitute_table_data_nodes */
    const double *ez; /**< [speed][gamma]; with cells: [cell of ez][17 coefficients] */
    const double *ex; /**< [speed][gamma][psi][chi]: ex itself for psi <= 1, beyond it ex - (2 chi (1 + ez)/psi - 1);
                         with cells: NULL */

    /** @name Cells
     *  A table with axes of delta1 and gamma is divided by two trees of cells, one for ex and one for ez. w = delta1 h takes the place
     *  of delta1; h is gamma^0.56 (1 + gamma)^0.44 at 4 nodes of each octave of gamma, evenly spaced from end to end, and between them
     *  their cubic. A root is an octave of gamma, 2^w_width of log2 w, all of chi, and a sheet of psi: 0 is psi from 0 to 1, 1 to 4 are
     *  quarters of t, 0 at psi = 1 and 1 at psi_c: r(y) is 2 r(1/2) t up to t = 1/2, and r(1 - y) is 2 r(1/2) (1 - t) beyond. The roots of ez
     *  have neither chi nor psi.
     *
     *  In a cell a value is the sum of coefficients times products of functions of u, from 0 to 1 along each axis: in log2 w, in gamma
     *  itself, in chi, in psi or t. A function belongs to one of five places, u = 0, 1/4, 1/2, 3/4, 1: 1 - u, (4/3) p (2 u - 1) (4 u - 3),
     *  p = 4 u (1 - u), (4/3) p (2 u - 1) (4 u - 1), u. Which places a coefficient is of, see
     *  @ref restitute_table_cell_functions; those of ez are the 17 in which chi and psi have place 0, in the same order. Leaves do
     *  not overlap; a build leaves out what no delta1 of its range reaches.
     *  @{ */
    int64_t cells;         /**< of ex; 0: another table, without all that follows. With cells `parts` is 1, 1; nodes are
                              `cells`, coefficients of a cell: 136 (50 without a range of chi), and places of chi and psi: 5
                              (1), 5; cells of chi and psi are not used */
    int64_t rebound_cells; /**< of ez */
    int64_t w_width, w_first, w_roots; /**< w_roots <= 2047 roots along w, the first from log2 w = w_first 2^w_width on */
    int64_t chain_length, chain[32];   /**< along what a root of ex is halved, time after time: 0 w, 1 chi, 2 psi. Those
                                          of ez: always w, up to 12 times */
    const int64_t *leaves, /**< [cell][7]: octave of gamma, root of w, sheet of psi; depth, path; level, part. The
                              cell is what `depth` halvings leave: bit (depth - 1 - d) of the path tells
                              which half halving d takes, 0 the lower one; and of the octave of gamma part `part` of 2^level */
        *rebound_leaves;   /**< [cell of ez][7]: likewise, sheet 0 */
    const float *ex_cells; /**< [cell][coefficient] of ex for psi <= 1, beyond it of psi ex - y ez */
    /** @} */
} restitute_table_data;

RESTITUTE_API void restitute_table_data_init(restitute_table_data *data);

/** A view of a table; its pointers live as long as the table.
 *  @return OK, ERROR_NULL, ERROR_STRUCT_SIZE */
RESTITUTE_API int restitute_table_to_data(const restitute_table *table, restitute_table_data *data,
                                          restitute_error *error);

/** The numbers of nodes that follow from axes, chi and cells.
 *  @return OK; ERROR_DOMAIN for numbers that no table has; ERROR_NULL, ERROR_STRUCT_SIZE */
RESTITUTE_API int restitute_table_data_nodes(const restitute_table_data *data, int64_t nodes[4],
                                             restitute_error *error);

/** A table from such numbers, copied: with the same bits it looks up the same.
 *  @return OK; ERROR_DOMAIN for numbers that no table has; ERROR_NULL, ERROR_STRUCT_SIZE, ERROR_MEMORY */
RESTITUTE_API int restitute_table_from_data(const restitute_table_data *data, restitute_table **table,
                                            restitute_error *error);

/** The places of an axis's nodes: 0 speed (m/s) or delta1, 1 gamma, 2 chi, 3 psi, where those beyond psi = 1 are given as 1 + y.
 *  @param places  restitute_table_data.nodes[axis] values
 *  @return OK, ERROR_NULL, ERROR_DOMAIN; also for a table with cells */
RESTITUTE_API int restitute_table_nodes(const restitute_table *table, int axis, double *places);

/** What a cell holds at its nodes, for a table with cells.
 *  @param cell   of ex, from 0 on
 *  @param nodes  restitute_table_data.nodes[1] rows of delta1, gamma, chi, psi, ez, ex. Some delta1 and gamma are beyond the range, as cells
 *                are; within it a lookup gives the same
 *  @return OK, ERROR_NULL, ERROR_DOMAIN */
RESTITUTE_API int restitute_table_cell_nodes(const restitute_table *table, int64_t cell, double (*nodes)[6]);

/** Which functions the coefficients of ex belong to.
 *  @param places  restitute_table_data.nodes[1] rows: of w, gamma, chi, psi; 0 to 4 for u = 0, 1/4, 1/2, 3/4, 1
 *  @return OK, ERROR_NULL, ERROR_DOMAIN for a table without cells */
RESTITUTE_API int restitute_table_cell_functions(const restitute_table *table, int64_t (*places)[4]);

#ifdef __cplusplus
}
#endif

#endif
