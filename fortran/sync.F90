! The method sync as one unit: compilers inline across the modules of one file, and its small functions are called so often
! that calls would cost more than what they compute.
#include "memory.f90"
#include "cubic.f90"
#include "sync_levels.f90"
#include "sync_dense.f90"
#include "sync_elements.f90"
#include "sync_quadrature.f90"
#include "sync_edge.f90"
#include "sync_point.f90"
#include "sync_hinge.f90"
#include "sync_front.f90"
#include "sync_shear.f90"
