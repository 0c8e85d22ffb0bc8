! SPDX-License-Identifier: BSD-3-Clause
!> The component bem for Fortran: all that bem.h declares, under the same names. bem.h is the
!> manual, and the rules of the module restitute hold. Link restitute::fortran_bem; it brings FFTW,
!> which is under the GPL.
!>
!>     use restitute
!>     use restitute_bem_module
!>     options%method = restitute_method_bem()
module restitute_bem_module
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_int, c_null_ptr, c_ptr, c_size_t, c_sizeof
  use restitute, only: restitute_error, restitute_method
  implicit none (type, external)
  private
  public :: restitute_bem_snapshot, restitute_bem_recorder
  public :: restitute_method_bem, restitute_method_bem_paper
  public :: restitute_bem_recorder_create, restitute_bem_recorder_destroy, restitute_bem_recorder_method
  public :: restitute_bem_recorder_count, restitute_bem_recorder_get, restitute_bem_fields

  !> The contact at one time; its arrays by restitute_bem_fields.
  type, bind(c) :: restitute_bem_snapshot
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: time = 0, spacing = 0
    integer(c_size_t) :: cells = 0
    type(c_ptr) :: pressure = c_null_ptr, traction = c_null_ptr, stick = c_null_ptr
  end type restitute_bem_snapshot

  !> A method that keeps fields of the impact, made by restitute_bem_recorder_create, released by
  !> _destroy.
  type, bind(c) :: restitute_bem_recorder
    type(c_ptr) :: address = c_null_ptr
  end type restitute_bem_recorder

  interface restitute_bem_snapshot
    module procedure new_bem_snapshot
  end interface restitute_bem_snapshot

  interface
    subroutine init_bem_snapshot(value, size) bind(c, name="restitute_bem_snapshot_init_sized")
      import
      type(restitute_bem_snapshot), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_bem_snapshot

    type(c_ptr) function c_bem() bind(c, name="restitute_method_bem")
      import
    end function c_bem

    type(c_ptr) function c_bem_paper() bind(c, name="restitute_method_bem_paper")
      import
    end function c_bem_paper

    integer(c_int) function restitute_bem_recorder_create(count, recorder, error) &
      bind(c, name="restitute_bem_recorder_create")
      import
      integer(c_size_t), value :: count
      type(restitute_bem_recorder), intent(inout) :: recorder
      type(restitute_error), intent(inout), optional :: error
    end function restitute_bem_recorder_create

    subroutine c_destroy(recorder) bind(c, name="restitute_bem_recorder_destroy")
      import
      type(c_ptr), value :: recorder
    end subroutine c_destroy

    type(c_ptr) function c_method(recorder) bind(c, name="restitute_bem_recorder_method")
      import
      type(c_ptr), value :: recorder
    end function c_method

    integer(c_size_t) function c_count(recorder) bind(c, name="restitute_bem_recorder_count")
      import
      type(c_ptr), value :: recorder
    end function c_count

    integer(c_int) function c_get(recorder, index, snapshot, error) bind(c, name="restitute_bem_recorder_get")
      import
      type(c_ptr), value :: recorder
      integer(c_size_t), value :: index
      type(restitute_bem_snapshot), intent(inout) :: snapshot
      type(restitute_error), intent(inout), optional :: error
    end function c_get
  end interface

contains

  type(restitute_bem_snapshot) function new_bem_snapshot() result(new)
    call init_bem_snapshot(new, c_sizeof(new))
  end function new_bem_snapshot

  type(restitute_method) function restitute_method_bem() result(method)
    method%address = c_bem()
  end function restitute_method_bem

  type(restitute_method) function restitute_method_bem_paper() result(method)
    method%address = c_bem_paper()
  end function restitute_method_bem_paper

  subroutine restitute_bem_recorder_destroy(recorder)
    type(restitute_bem_recorder), intent(inout) :: recorder
    call c_destroy(recorder%address)
    recorder%address = c_null_ptr
  end subroutine restitute_bem_recorder_destroy

  type(restitute_method) function restitute_bem_recorder_method(recorder) result(method)
    type(restitute_bem_recorder), intent(in) :: recorder
    method%address = c_method(recorder%address)
  end function restitute_bem_recorder_method

  integer(c_size_t) function restitute_bem_recorder_count(recorder) result(count)
    type(restitute_bem_recorder), intent(in) :: recorder
    count = c_count(recorder%address)
  end function restitute_bem_recorder_count

  !> Index counts from 0, as in C.
  integer(c_int) function restitute_bem_recorder_get(recorder, index, snapshot, error) result(status)
    type(restitute_bem_recorder), intent(in) :: recorder
    integer(c_size_t), intent(in) :: index
    type(restitute_bem_snapshot), intent(inout) :: snapshot
    type(restitute_error), intent(inout), optional :: error
    status = c_get(recorder%address, index, snapshot, error)
  end function restitute_bem_recorder_get

  !> The fields of a snapshot, the first index along the sliding; they live until the recorder's
  !> next impact or its end.
  subroutine restitute_bem_fields(snapshot, pressure, traction, stick)
    type(restitute_bem_snapshot), intent(in) :: snapshot
    real(c_double), pointer, intent(out), optional :: pressure(:, :), traction(:, :), stick(:, :)
    integer(c_size_t) :: grid(2)
    grid = snapshot%cells
    if (present(pressure)) call c_f_pointer(snapshot%pressure, pressure, grid)
    if (present(traction)) call c_f_pointer(snapshot%traction, traction, grid)
    if (present(stick)) call c_f_pointer(snapshot%stick, stick, grid)
  end subroutine restitute_bem_fields
end module restitute_bem_module
