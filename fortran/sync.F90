! The method sync as one unit: compilers inline across the modules of one file, and its small functions are called so often
! that calls would cost more than what they compute.
!
! It is compiled for several vector widths, which all give the same bits: nothing is contracted or summed in another order.
! CMakeLists.txt gives the modules of each width names of their own; RST_WIDTH ends the names that C knows.
#ifndef RST_WIDTH
#define RST_WIDTH ""
#endif
#include "memory.f90"
#include "cubic.f90"
#include "sync_grid.f90"
#include "sync_guess.f90"
#include "sync_sweeps.f90"
#include "sync_loading.f90"
#include "sync_compression.f90"
#include "sync_restitution.f90"
#include "sync_levels.f90"
#include "sync_dense.f90"
#define POINTS rst_sync_points_8
#define ELIMINATION rst_sync_elimination_8
#define GOING rst_sync_going_8
#define COMING rst_sync_coming_8
#define FADING rst_sync_fading_8
#define CURVE rst_sync_curve_8
#define POINTS_DEGREE 8
#include "sync_points.f90"
#include "sync_elimination.f90"
#include "sync_going.f90"
#include "sync_coming.f90"
#include "sync_fading.f90"
#include "sync_curve.f90"
#undef POINTS
#undef ELIMINATION
#undef GOING
#undef COMING
#undef FADING
#undef CURVE
#undef POINTS_DEGREE
#define POINTS rst_sync_points_12
#define ELIMINATION rst_sync_elimination_12
#define GOING rst_sync_going_12
#define COMING rst_sync_coming_12
#define FADING rst_sync_fading_12
#define CURVE rst_sync_curve_12
#define POINTS_DEGREE 12
#include "sync_points.f90"
#include "sync_elimination.f90"
#include "sync_going.f90"
#include "sync_coming.f90"
#include "sync_fading.f90"
#include "sync_curve.f90"
#undef POINTS
#undef ELIMINATION
#undef GOING
#undef COMING
#undef FADING
#undef CURVE
#undef POINTS_DEGREE
#define POINTS rst_sync_points_16
#define ELIMINATION rst_sync_elimination_16
#define GOING rst_sync_going_16
#define COMING rst_sync_coming_16
#define FADING rst_sync_fading_16
#define CURVE rst_sync_curve_16
#define POINTS_DEGREE 16
#include "sync_points.f90"
#include "sync_elimination.f90"
#include "sync_going.f90"
#include "sync_coming.f90"
#include "sync_fading.f90"
#include "sync_curve.f90"
#include "sync_sample.f90"
#include "sync_elements.f90"
#include "sync_quadrature.f90"
#include "sync_ratio.f90"
#include "sync_edge.f90"
#include "sync_point.f90"
#include "sync_hinge.f90"
#include "sync_slack.f90"
#include "sync_sentinel.f90"
#include "sync_front.f90"
#include "sync_shear.f90"
#include "sync_interfaces.f90"
