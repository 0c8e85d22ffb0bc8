! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: reads the material whose file is its argument, and misses one. Exit
!> status 0 if all is what it should be.
program consumer_files
  use restitute
  use restitute_files_module
  implicit none (type, external)
  type(restitute_material) :: material
  type(restitute_material_info) :: info
  type(restitute_error) :: error
  character(len=1000) :: path
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
  if (.not. good) error stop 1
end program consumer_files
