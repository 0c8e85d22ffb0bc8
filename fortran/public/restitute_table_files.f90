! SPDX-License-Identifier: BSD-3-Clause
!> The component table_files for Fortran: all that table_files.h declares, under the same names.
!> table_files.h is the manual, and the rules of the module restitute hold. Link
!> restitute::fortran_table_files.
!>
!>     status = restitute_table_write(table, "rubber.h5", error)
!>     status = restitute_table_read("rubber.h5", table, error)
!>
!> Blanks at the end of a path are not part of it.
module restitute_table_files_module
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_ptr
  use restitute, only: restitute_error
  use restitute_table_module, only: restitute_table
  implicit none (type, external)
  private
  public :: restitute_table_write, restitute_table_read

  interface
    integer(c_int) function c_write(table, path, error) bind(c, name="restitute_table_write")
      import
      type(c_ptr), value :: table
      character(kind=c_char), intent(in) :: path(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_write

    integer(c_int) function c_read(path, table, error) bind(c, name="restitute_table_read")
      import
      character(kind=c_char), intent(in) :: path(*)
      type(restitute_table), intent(inout) :: table
      type(restitute_error), intent(inout), optional :: error
    end function c_read
  end interface

contains

  integer(c_int) function restitute_table_write(table, path, error) result(status)
    type(restitute_table), intent(in) :: table
    character(len=*), intent(in) :: path
    type(restitute_error), intent(inout), optional :: error
    status = c_write(table%address, trim(path)//c_null_char, error)
  end function restitute_table_write

  integer(c_int) function restitute_table_read(path, table, error) result(status)
    character(len=*), intent(in) :: path
    type(restitute_table), intent(inout) :: table
    type(restitute_error), intent(inout), optional :: error
    status = c_read(trim(path)//c_null_char, table, error)
  end function restitute_table_read
end module restitute_table_files_module
