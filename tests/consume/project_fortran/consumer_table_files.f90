! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: writes a table to its argument and reads it again. Exit status 0 if all
!> is what it should be.
program consumer_table_files
  use restitute
  use restitute_table_module
  use restitute_table_files_module
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_material) :: steel
  type(restitute_scene) :: scene
  type(restitute_table_options) :: options
  type(restitute_table) :: table, copy
  type(restitute_error) :: error
  character(len=1000) :: path
  real(rk) :: pair(2), again(2)
  integer :: status
  logical :: good
  call get_command_argument(1, path)
  good = restitute_material_elastic(8e10_rk, 0.3_rk, steel) == RESTITUTE_OK
  scene = restitute_scene()
  scene%material = steel
  scene%radius1 = 0.01_rk
  scene%mass1 = 0.03_rk
  scene%friction = 0.2_rk
  options = restitute_table_options()
  options%tolerance = 1e-2_rk
  good = good .and. restitute_table_build(scene, options, table, error) == RESTITUTE_OK
  good = good .and. restitute_table_write(table, path, error) == RESTITUTE_OK
  good = good .and. restitute_table_read(path, copy, error) == RESTITUTE_OK
  status = restitute_table_pair(table, normal_speed=1.0_rk, sliding_speed=0.5_rk, ez=pair(1), ex=pair(2))
  good = good .and. status == 0
  status = restitute_table_pair(copy, normal_speed=1.0_rk, sliding_speed=0.5_rk, ez=again(1), ex=again(2))
  good = good .and. status == 0
  good = good .and. .not. any(abs(again - pair) > 0) ! the same bits
  call restitute_table_destroy(copy)
  good = good .and. restitute_table_read("missing.h5", copy, error) == RESTITUTE_ERROR_FILE
  print "(2a)", "refused: ", restitute_message(error)
  call restitute_table_destroy(table)
  call restitute_material_destroy(steel)
  if (.not. good) error stop 1
end program consumer_table_files
