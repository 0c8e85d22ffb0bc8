! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: reads the material whose file is its argument, misses one, and
!> finds one by name. Exit status 0 if all is what it should be.
program consumer_files
  use, intrinsic :: iso_c_binding, only: c_double
  use restitute
  use restitute_files_module
  implicit none (type, external)
  type(restitute_material) :: material, warm
  type(restitute_material_info) :: info
  type(restitute_error) :: error
  character(len=1000) :: path
  real(c_double) :: shortest
  logical :: good
  call get_command_argument(1, path)
  info = restitute_material_info()
  good = restitute_material_read(path, material, info, error) == RESTITUTE_OK
  good = good .and. restitute_material_terms(material) > 1 .and. restitute_text(info%model) == "prony"
  good = good .and. info%density > 0
  print "(3a)", restitute_text(info%name), ": ", restitute_text(info%source)
  call restitute_material_destroy(material)
  good = good .and. restitute_material_read("missing.json", material, error=error) == RESTITUTE_ERROR_FILE
  good = good .and. index(restitute_message(error), "missing.json") > 0
  good = good .and. restitute_material_by_name("polyisobutylene", material, info, error) == RESTITUTE_OK
  good = good .and. restitute_material_at_temperature(material, info, 40.0_c_double, warm, error) == RESTITUTE_OK
  good = good .and. restitute_material_window(warm, shortest=shortest) == RESTITUTE_OK
  good = good .and. shortest < info%window(1)
  print "(a)", restitute_message(error)
  if (.not. good) error stop 1
end program consumer_files
