! SPDX-License-Identifier: BSD-3-Clause
!> The component files for Fortran: all that files.h declares, under the same names. files.h is the
!> manual, and the rules of the module restitute hold. Link restitute::fortran_files.
!>
!>     type(restitute_material_info) :: info
!>     info = restitute_material_info()
!>     status = restitute_material_read("polyisobutylene.json", material, info, error)
!>     print *, restitute_text(info%name), info%density
!>     status = restitute_material_by_name("polyisobutylene", material, info, error)
!>
!> Blanks at the end of a path or a name are not part of it.
module restitute_files_module
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_int64_t, c_null_char, c_ptr, c_size_t, c_sizeof
  use restitute, only: restitute_error, restitute_material
  implicit none (type, external)
  private
  public :: restitute_material_info, restitute_material_read, restitute_material_by_name
  public :: restitute_material_at_temperature

  !> What a material file says beside the solid itself.
  type, bind(c) :: restitute_material_info
    integer(c_size_t) :: struct_size = 0
    character(kind=c_char) :: name(128) = c_null_char, source(512) = c_null_char, model(32) = c_null_char
    real(c_double) :: density = 0
    integer(c_int64_t) :: fingerprint = 0
    real(c_double) :: temperature = 0, wlf_c1 = 0, wlf_c2 = 0, wlf_reference = 0, &
      wlf_range(2) = 0, window(2) = 0, viscosity = 0
  end type restitute_material_info

  interface restitute_material_info
    module procedure new_material_info
  end interface restitute_material_info

  interface
    subroutine init_material_info(value, size) bind(c, name="restitute_material_info_init_sized")
      import
      type(restitute_material_info), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_material_info

    integer(c_int) function c_read(path, material, info, error) bind(c, name="restitute_material_read")
      import
      character(kind=c_char), intent(in) :: path(*)
      type(restitute_material), intent(inout) :: material
      type(restitute_material_info), intent(inout), optional :: info
      type(restitute_error), intent(inout), optional :: error
    end function c_read

    integer(c_int) function c_by_name(name, material, info, error) bind(c, name="restitute_material_by_name")
      import
      character(kind=c_char), intent(in) :: name(*)
      type(restitute_material), intent(inout) :: material
      type(restitute_material_info), intent(inout), optional :: info
      type(restitute_error), intent(inout), optional :: error
    end function c_by_name

    integer(c_int) function c_at_temperature(material, info, temperature, shifted, error) &
      bind(c, name="restitute_material_at_temperature")
      import
      type(c_ptr), value :: material
      type(restitute_material_info), intent(in) :: info
      real(c_double), value :: temperature
      type(restitute_material), intent(inout) :: shifted
      type(restitute_error), intent(inout), optional :: error
    end function c_at_temperature
  end interface

contains

  type(restitute_material_info) function new_material_info() result(new)
    call init_material_info(new, c_sizeof(new))
  end function new_material_info

  integer(c_int) function restitute_material_read(path, material, info, error) result(status)
    character(len=*), intent(in) :: path
    type(restitute_material), intent(inout) :: material
    type(restitute_material_info), intent(inout), optional :: info
    type(restitute_error), intent(inout), optional :: error
    status = c_read(trim(path)//c_null_char, material, info, error)
  end function restitute_material_read

  integer(c_int) function restitute_material_by_name(name, material, info, error) result(status)
    character(len=*), intent(in) :: name
    type(restitute_material), intent(inout) :: material
    type(restitute_material_info), intent(inout), optional :: info
    type(restitute_error), intent(inout), optional :: error
    status = c_by_name(trim(name)//c_null_char, material, info, error)
  end function restitute_material_by_name

  integer(c_int) function restitute_material_at_temperature(material, info, temperature, shifted, error) result(status)
    type(restitute_material), intent(in) :: material
    type(restitute_material_info), intent(in) :: info
    real(c_double), intent(in) :: temperature
    type(restitute_material), intent(inout) :: shifted
    type(restitute_error), intent(inout), optional :: error
    status = c_at_temperature(material%address, info, temperature, shifted, error)
  end function restitute_material_at_temperature
end module restitute_files_module
