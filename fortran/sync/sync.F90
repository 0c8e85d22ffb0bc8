! The method sync as one unit: compilers inline across the modules of one file, and its small functions are called so often
! that calls would cost as much as what they compute.
#include "collocation.f90"
#include "arms.f90"
#include "panel.f90"
#include "compression.f90"
#include "restitution.f90"
#include "normal.f90"
#include "contact_views.f90"
#include "piece.f90"
#include "front.f90"
#include "slip.f90"
#include "contact.f90"
#include "interface.f90"
