! SPDX-License-Identifier: BSD-3-Clause
!> The library restitute for Fortran: all that restitute.h declares, under the same names.
!>
!> restitute.h is the manual: units, ranges and examples hold here as they stand there. Differences,
!> here and in the modules of the components, restitute_table_module and so on:
!> - Arguments that may be NULL in C are optional: options, result, ledger, history, error. Their
!>   order is that of C. What follows an argument that is left out is named:
!>   restitute_solver_create(solver=solver).
!> - Every function that can fail returns a status: RESTITUTE_OK = 0 or another constant; negative:
!>   failed.
!> - restitute_scene() gives a prepared scene, as restitute_scene_init does in C; likewise every
!>   struct that has a size.
!> - Materials, methods, solvers and plans are small types that hold an address of C. Assigning one
!>   copies the address, not the thing. What is destroyed is empty then and may be destroyed again.
!> - Arrays know their size: the numbers of values that C wants beside them are left out.
!> - Texts are Fortran texts: restitute_message(error), restitute_method_name(result),
!>   restitute_text(info%name).
!> - The constants RESTITUTE_VERSION_MAJOR, ... are those of C's preprocessor and are not here.
!>
!>     use restitute
!>     integer, parameter :: rk = restitute_real
!>     type(restitute_material) :: rubber
!>     type(restitute_scene) :: scene
!>     status = restitute_material_standard_solid(1e6_rk, 2e6_rk, 50.0_rk, 0.5_rk, rubber)
!>     scene = restitute_scene()
!>     scene%material = rubber
!>     ...
!>     status = restitute_scene_pair(scene, ez, ex, error)
module restitute
  use restitute_core_module
  use restitute_texts_module, only: restitute_message, restitute_text
  use restitute_types_module
  implicit none (type, external)
end module restitute
