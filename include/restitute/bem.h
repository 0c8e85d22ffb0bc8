/** @file bem.h
 *  Component `bem` of restitute: the impact by boundary elements in three dimensions, to check the
 *  foundation models.
 *
 *  Link restitute::bem, a library of its own: it needs FFTW, which is under the GNU General Public
 *  License, so a program that links restitute::bem and is passed on falls under that licence. The
 *  core and the other components do not need it.
 *
 *  The method takes the place of any other in restitute_options.method; input, result and units are
 *  those of restitute.h:
 *
 *      restitute_options options; restitute_options_init(&options);
 *      options.method = restitute_method_bem();
 *      restitute_solver *solver; restitute_solver_create(&options, &solver, &error);
 *      restitute_solve(solver, &impact, &result, NULL, NULL, &error);
 *
 *  It shares with the other methods the definition of the problem and nothing else: influence
 *  functions of the incompressible half-space on a square grid (18), convolution by fast Fourier
 *  transforms, the pressure and then the traction of each step by conjugate gradients with bounds,
 *  the solid in creep form (19),(20). The choice of box and step is its own.
 *
 *  - options.elements: cells over the largest contact radius, 4 to 2000; the grid is about 2.1
 *    times as many cells wide: 29, 60 and 122 give 64 x 64, 128 x 128 and 256 x 256 cells. 0:
 *    chosen by the tolerance.
 *  - options.time_step: as elsewhere, below half the contact time; 0 with given elements: a 200th
 *    of the contact time, with `bem-paper` as small a part of it as is stable.
 *  - options.tolerance: cells and steps are doubled, from 15 cells over the radius, until the
 *    estimate meets it. The limit is options.max_work: grids above it are not started, so the
 *    default of 10 ends at 120 cells. 1e-3 takes 0.06 s where much of the contact slips (psi from
 *    0.5 on), 0.3 s at psi = 0.01 and 2 s without slip; 1e-4 takes 3 s with psi from 0.5 on. In
 *    the corner of chi = 4 and next to no slip 1e-3 takes 240 cells, 20 s and max_work = 30; 1e-4
 *    is out of reach for psi below 0.5.
 *  - The result is extrapolated from two runs, the second with half the cells and twice the step;
 *    the estimates are what that changed, and a part for the grid (docs/bem.md).
 *  - A sphere that sinks in for good has NO_REBOUND, ez = 0 and an infinite contact time: it is
 *    slower than the larger of 1e-5 and a hundredth of the tolerance, and the solid has no
 *    equilibrium modulus.
 *  - A solid whose instantaneous compliance is next to nothing, below a 200th of what a step
 *    relaxes (a standard solid with gamma/delta1 below 3e-5 or so), makes the steps ring: e_z is
 *    off by up to 0.1, the estimate says so, and smaller steps help slowly. Take `sync`.
 *  - Poisson's ratio enters by chi and psi alone, as in the other methods; the kernel is that of nu
 *    = 1/2.
 *  - A solid without instantaneous modulus (Kelvin-Voigt, or any parallel viscosity) is refused
 *    with ERROR_DOMAIN: its pressure would be infinite at the rim of a contact that grows. Give a
 *    Prony term with a short relaxation time instead.
 *  - Threads: solvers in several threads are safe beside each other; a solver works in one. They
 *    plan transforms, now and then, in any call of restitute_solve, and FFTW's planner is one for
 *    the process: a program that itself makes or destroys FFTW plans in another thread meanwhile
 *    must call fftw_make_planner_thread_safe() (libfftw3_threads) before the first of either. That
 *    covers the plans of this component too.
 *  - Where there is no memory left this component returns ERROR_MEMORY, but FFTW ends the program
 *    when there is none for what it allocates itself, in its planner and in some transforms.
 *  - In the ledger, the viscous parts are the work on the surface less what else it went to.
 *
 *  SPDX-License-Identifier: BSD-3-Clause (this file and the component's source)
 */
#ifndef RESTITUTE_BEM_H
#define RESTITUTE_BEM_H

#include <restitute/restitute.h>

#ifdef __cplusplus
extern "C" {
#endif

/** `bem`: second order in the step, bound-constrained friction, traction along x alone. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_method_bem(void);

/** `bem-paper`: as in section 4 of the paper, explicit Euler steps and a sticking set that shrinks
 *  until no cell of it passes the friction limit. First order in the step: for comparison. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_method_bem_paper(void);

/** A method `bem` that keeps fields of the impact. */
typedef struct restitute_bem_recorder restitute_bem_recorder;

/** The contact at one time. Arrays of cells x cells values, x running first, lines of the grid one
 *  after the other, the first contact point in the middle; they live until the recorder's next
 *  impact or its end. Dimensionless (T; a_el; G_r d0/a_el, over mu for the traction), whatever the
 *  input. */
typedef struct restitute_bem_snapshot {
    size_t struct_size;     /**< set by @ref restitute_bem_snapshot_init */
    double time;
    double spacing;         /**< of the grid */
    size_t cells;           /**< along each side */
    const double *pressure; /**< 0 outside of the contact */
    const double *traction; /**< along x, on the partner */
    const double *stick;    /**< 1 sticks, 0 slips or not in contact */
} restitute_bem_snapshot;

RESTITUTE_INIT(RESTITUTE_SINCE_0_1, bem_snapshot)

/** @param count     snapshots of an impact, 1 to 1000, evenly spaced over the contact without its
 *                   ends
 *  @param recorder  for @ref restitute_bem_recorder_destroy. One thread at a time, like the solver
 *                   that uses it
 *
 *      restitute_bem_recorder_create(9, &recorder, &error);
 *      options.method = restitute_bem_recorder_method(recorder);
 *      ... restitute_solve(solver, &impact, &result, NULL, &history, &error); // needs a history
 *      restitute_bem_recorder_get(recorder, 4, &snapshot, &error);             // the middle */
RESTITUTE_SINCE_0_1 int restitute_bem_recorder_create(size_t count,
    restitute_bem_recorder **recorder, restitute_error *error);

/** Release; NULL is allowed. No solver that uses its method may be called any more. */
RESTITUTE_SINCE_0_1 void restitute_bem_recorder_destroy(restitute_bem_recorder *recorder);

/** The method, for restitute_options; lives as long as the recorder. NULL for NULL. */
RESTITUTE_SINCE_0_1 const restitute_method *restitute_bem_recorder_method(
    const restitute_bem_recorder *recorder);

/** Snapshots that the last impact with a history left: `count`, or fewer if it had fewer steps; 0
 *  before. A call whose input is refused leaves those of the impact before it. */
RESTITUTE_SINCE_0_1 size_t restitute_bem_recorder_count(const restitute_bem_recorder *recorder);

/** @param index     0 to the number of snapshots - 1
 *  @param snapshot  prepared by @ref restitute_bem_snapshot_init */
RESTITUTE_SINCE_0_1 int restitute_bem_recorder_get(const restitute_bem_recorder *recorder,
    size_t index, restitute_bem_snapshot *snapshot, restitute_error *error);

#ifdef __cplusplus
}
#endif

#endif
