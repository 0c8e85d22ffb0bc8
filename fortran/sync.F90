! The method sync as one unit: compilers inline across the modules of one file, and its small functions are called so often
! that calls would cost more than what they compute.
!
! It is compiled for several vector widths, which all give the same bits: nothing is contracted or summed in another order.
! CMakeLists.txt gives the modules of each width names of their own; RST_WIDTH ends the names that C knows.
#ifndef RST_WIDTH
#define RST_WIDTH ""
#endif
#include "bounded.f90"
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
#include "sync_elements.f90"
#include "sync_quadrature.f90"
#include "sync_edge.f90"
#include "sync_point.f90"
#include "sync_hinge.f90"
#include "sync_slack.f90"
#include "sync_sentinel.f90"
#include "sync_front.f90"
#include "sync_shear.f90"
#include "sync_interfaces.f90"
