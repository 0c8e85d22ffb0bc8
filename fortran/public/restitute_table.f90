! SPDX-License-Identifier: BSD-3-Clause
!> The component table for Fortran: all that table.h declares, under the same names. table.h is the
!> manual, and the rules of the module restitute hold. Link restitute::fortran_table.
!>
!>     use restitute
!>     use restitute_table_module
!>     type(restitute_table) :: table
!>     status = restitute_table_build(scene, table=table, error=error)
!>     status = restitute_table_pair(table, normal_speed=v, sliding_speed=u, ez=ez, ex=ex)
!>     call restitute_table_destroy(table)
!>
!> A restitute_table_contact between the table and the speeds asks for another contact than the
!> table's own.
module restitute_table_module
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_funloc, c_funptr, c_int, c_int64_t, c_loc, &
    c_null_char, c_null_funptr, c_null_ptr, c_ptr, c_size_t, c_sizeof
  use restitute, only: restitute_body, restitute_error, restitute_material, restitute_scene, RESTITUTE_OK
  use restitute_texts_module, only: check_length
  implicit none (type, external)
  private
  public :: restitute_table, restitute_table_options, restitute_table_contact, restitute_table_info
  public :: restitute_table_data
  public :: restitute_table_build, restitute_table_build_many, restitute_table_destroy, restitute_table_progress
  public :: restitute_table_interrupted
  public :: restitute_table_contact_set, restitute_table_pair, restitute_table_pair_many, restitute_table_collide
  public :: restitute_table_flags, restitute_table_describe, restitute_table_data_get, restitute_table_create
  public :: restitute_table_arrays, restitute_table_arrays_set

  !> An immutable table, made by restitute_table_build, released by restitute_table_destroy.
  type, bind(c) :: restitute_table
    type(c_ptr) :: address = c_null_ptr
  end type restitute_table

  !> How to build; interrupted = c_funloc(a restitute_table_interrupted).
  type, bind(c) :: restitute_table_options
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: speed(2) = 0, tolerance = 0
    integer(c_int) :: threads = 0
    integer(c_int64_t) :: max_impacts = 0
    real(c_double) :: time_limit = 0, speed_limit = 0, radius_limit = 0, displacement_limit = 0, &
      dundurs_limit = 0
    type(c_funptr) :: interrupted = c_null_funptr
    type(c_ptr) :: interrupted_data = c_null_ptr
  end type restitute_table_options

  !> Another contact that a table serves, filled by restitute_table_contact_set.
  type, bind(c) :: restitute_table_contact
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: speed_factor = 0, psi_factor = 0, radius = 0, mass = 0, strain_factors(4) = 0, &
      dundurs_beta = 0, touch_gap = 0
  end type restitute_table_contact

  !> What a table says of itself; restitute_text(info%version) is a Fortran text.
  type, bind(c) :: restitute_table_info
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: speed(2) = 0, chi = 0, gamma = 0, delta1(2) = 0, friction = 0, radius = 0, mass = 0, &
      tolerance = 0, error_ez = 0, error_ex = 0, rebound_speed = 0, fast_speed = 0, large_contact_speed = 0, &
      long_slide_speed = 0
    integer(c_int64_t) :: impacts = 0, checks = 0, speeds = 0, stick_cells = 0, slip_cells = 0
    integer(c_size_t) :: bytes = 0
    character(kind=c_char) :: version(32) = c_null_char
  end type restitute_table_info

  !> All of a table in plain numbers; its arrays by restitute_table_arrays and
  !> restitute_table_arrays_set.
  type, bind(c) :: restitute_table_data
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: low = 0, high = 0, tolerance = 0, error_ez = 0, error_ex = 0
    integer(c_int64_t) :: impacts = 0, checks = 0
    character(kind=c_char) :: version(32) = c_null_char
    real(c_double) :: chi = 0, gamma = 0, delta1 = 0, psi_factor = 0, duration = 0, friction = 0, radius = 0, &
      mass = 0, poisson_ratio = 0, equilibrium_modulus = 0, parallel_viscosity = 0, density = 0, dundurs_beta = 0, &
      shortest = 0, longest = 0, speed_limit = 0, radius_limit = 0, displacement_limit = 0, dundurs_limit = 0
    integer(c_int64_t) :: terms = 0, speeds = 0, stick_cells = 0, slip_cells = 0
    type(c_ptr) :: relaxation_time = c_null_ptr, modulus = c_null_ptr, speed = c_null_ptr, ez = c_null_ptr, &
      strain = c_null_ptr, ex = c_null_ptr
  end type restitute_table_data

  interface restitute_table_options
    module procedure new_table_options
  end interface restitute_table_options
  interface restitute_table_contact
    module procedure new_table_contact
  end interface restitute_table_contact
  interface restitute_table_info
    module procedure new_table_info
  end interface restitute_table_info
  interface restitute_table_data
    module procedure new_table_data
  end interface restitute_table_data

  abstract interface
    !> Called when a table is finished: done of count.
    subroutine restitute_table_progress(data, done, count) bind(c)
      import
      type(c_ptr), value :: data
      integer(c_size_t), value :: done, count
    end subroutine restitute_table_progress
    !> Nonzero: stop. Data is options%interrupted_data.
    integer(c_int) function restitute_table_interrupted(data) bind(c)
      import
      type(c_ptr), value :: data
    end function restitute_table_interrupted
  end interface

  interface
    subroutine init_table_options(value, size) bind(c, name="restitute_table_options_init_sized")
      import
      type(restitute_table_options), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_table_options

    subroutine init_table_contact(value, size) bind(c, name="restitute_table_contact_init_sized")
      import
      type(restitute_table_contact), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_table_contact

    subroutine init_table_info(value, size) bind(c, name="restitute_table_info_init_sized")
      import
      type(restitute_table_info), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_table_info

    subroutine init_table_data(value, size) bind(c, name="restitute_table_data_init_sized")
      import
      type(restitute_table_data), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_table_data

    integer(c_int) function restitute_table_build(scene, options, table, error) bind(c, name="restitute_table_build")
      import
      type(restitute_scene), intent(in) :: scene
      type(restitute_table_options), intent(in), optional :: options
      type(restitute_table), intent(inout) :: table
      type(restitute_error), intent(inout), optional :: error
    end function restitute_table_build

    integer(c_int) function restitute_table_create(data, table, error) bind(c, name="restitute_table_create")
      import
      type(restitute_table_data), intent(in) :: data
      type(restitute_table), intent(inout) :: table
      type(restitute_error), intent(inout), optional :: error
    end function restitute_table_create

    integer(c_int) function c_build_many(count, materials, scene, options, progress, data, tables, error) &
      bind(c, name="restitute_table_build_many")
      import
      integer(c_size_t), value :: count
      type(restitute_material), intent(in) :: materials(*)
      type(restitute_scene), intent(in) :: scene
      type(restitute_table_options), intent(in), optional :: options
      type(c_funptr), value :: progress
      type(c_ptr), value :: data
      type(restitute_table), intent(inout) :: tables(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_build_many

    subroutine c_destroy(table) bind(c, name="restitute_table_destroy")
      import
      type(c_ptr), value :: table
    end subroutine c_destroy

    integer(c_int) function c_contact_set(table, scene, contact, error) bind(c, name="restitute_table_contact_set")
      import
      type(c_ptr), value :: table
      type(restitute_scene), intent(in) :: scene
      type(restitute_table_contact), intent(inout) :: contact
      type(restitute_error), intent(inout), optional :: error
    end function c_contact_set

    integer(c_int) function c_pair(table, contact, normal_speed, sliding_speed, ez, ex, error) &
      bind(c, name="restitute_table_pair")
      import
      type(c_ptr), value :: table
      type(restitute_table_contact), intent(in), optional :: contact
      real(c_double), value :: normal_speed, sliding_speed
      real(c_double), intent(inout), optional :: ez, ex
      type(restitute_error), intent(inout), optional :: error
    end function c_pair

    integer(c_int) function c_pair_many(table, contact, n, normal_speeds, sliding_speeds, ez, ex, error) &
      bind(c, name="restitute_table_pair_many")
      import
      type(c_ptr), value :: table
      type(restitute_table_contact), intent(in), optional :: contact
      integer(c_size_t), value :: n
      real(c_double), intent(in) :: normal_speeds(*), sliding_speeds(*)
      real(c_double), intent(inout), optional :: ez(*), ex(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_pair_many

    integer(c_int) function c_collide(table, contact, first, second, ez, ex, error) &
      bind(c, name="restitute_table_collide")
      import
      type(c_ptr), value :: table
      type(restitute_table_contact), intent(in), optional :: contact
      type(restitute_body), intent(inout) :: first, second
      real(c_double), intent(inout), optional :: ez, ex
      type(restitute_error), intent(inout), optional :: error
    end function c_collide

    integer(c_int) function c_flags(table, contact, normal_speed, sliding_speed, flags, error) &
      bind(c, name="restitute_table_flags")
      import
      type(c_ptr), value :: table
      type(restitute_table_contact), intent(in), optional :: contact
      real(c_double), value :: normal_speed, sliding_speed
      integer(c_int), intent(inout) :: flags
      type(restitute_error), intent(inout), optional :: error
    end function c_flags

    integer(c_int) function c_describe(table, info, error) bind(c, name="restitute_table_describe")
      import
      type(c_ptr), value :: table
      type(restitute_table_info), intent(inout) :: info
      type(restitute_error), intent(inout), optional :: error
    end function c_describe

    integer(c_int) function c_data_get(table, data, error) bind(c, name="restitute_table_data_get")
      import
      type(c_ptr), value :: table
      type(restitute_table_data), intent(inout) :: data
      type(restitute_error), intent(inout), optional :: error
    end function c_data_get
  end interface

contains

  type(restitute_table_options) function new_table_options() result(new)
    call init_table_options(new, c_sizeof(new))
  end function new_table_options

  type(restitute_table_contact) function new_table_contact() result(new)
    call init_table_contact(new, c_sizeof(new))
  end function new_table_contact

  type(restitute_table_info) function new_table_info() result(new)
    call init_table_info(new, c_sizeof(new))
  end function new_table_info

  type(restitute_table_data) function new_table_data() result(new)
    call init_table_data(new, c_sizeof(new))
  end function new_table_data

  !> Tables of all pairs of the materials: that of i <= j is tables(j*(j - 1)/2 + i). Data is given
  !> to progress.
  integer(c_int) function restitute_table_build_many(materials, scene, options, progress, data, tables, error) &
    result(status)
    type(restitute_material), intent(in) :: materials(:)
    type(restitute_scene), intent(in) :: scene
    type(restitute_table_options), intent(in), optional :: options
    procedure(restitute_table_progress), optional :: progress
    type(c_ptr), intent(in), optional :: data
    type(restitute_table), intent(inout) :: tables(:)
    type(restitute_error), intent(inout), optional :: error
    integer(c_size_t) :: n
    type(c_funptr) :: callback
    type(c_ptr) :: its_data
    n = size(materials, kind=c_size_t)
    callback = c_null_funptr
    its_data = c_null_ptr
    if (present(progress)) callback = c_funloc(progress)
    if (present(data)) its_data = data
    status = RESTITUTE_OK
    call check_length("tables", tables, "there are pairs of materials", n*(n + 1)/2, status, error)
    if (status == RESTITUTE_OK) status = c_build_many(n, materials, scene, options, callback, its_data, tables, error)
  end function restitute_table_build_many

  subroutine restitute_table_destroy(table)
    type(restitute_table), intent(inout) :: table
    call c_destroy(table%address)
    table%address = c_null_ptr
  end subroutine restitute_table_destroy

  integer(c_int) function restitute_table_contact_set(table, scene, contact, error) result(status)
    type(restitute_table), intent(in) :: table
    type(restitute_scene), intent(in) :: scene
    type(restitute_table_contact), intent(inout) :: contact
    type(restitute_error), intent(inout), optional :: error
    status = c_contact_set(table%address, scene, contact, error)
  end function restitute_table_contact_set

  integer(c_int) function restitute_table_pair(table, contact, normal_speed, sliding_speed, ez, ex, error) &
    result(status)
    type(restitute_table), intent(in) :: table
    type(restitute_table_contact), intent(in), optional :: contact
    real(c_double), intent(in) :: normal_speed, sliding_speed
    real(c_double), intent(inout), optional :: ez, ex
    type(restitute_error), intent(inout), optional :: error
    status = c_pair(table%address, contact, normal_speed, sliding_speed, ez, ex, error)
  end function restitute_table_pair

  integer(c_int) function restitute_table_pair_many(table, contact, normal_speeds, sliding_speeds, ez, ex, error) &
    result(status)
    type(restitute_table), intent(in) :: table
    type(restitute_table_contact), intent(in), optional :: contact
    real(c_double), intent(in) :: normal_speeds(:), sliding_speeds(:)
    real(c_double), intent(inout), optional :: ez(:), ex(:)
    type(restitute_error), intent(inout), optional :: error
    integer(c_size_t) :: n
    n = size(normal_speeds, kind=c_size_t)
    status = RESTITUTE_OK
    call check_length("sliding_speeds", sliding_speeds, "normal_speeds", n, status, error)
    call check_length("ez", ez, "normal_speeds", n, status, error)
    call check_length("ex", ex, "normal_speeds", n, status, error)
    if (status == RESTITUTE_OK) status = c_pair_many(table%address, contact, n, normal_speeds, sliding_speeds, &
                                                     ez, ex, error)
  end function restitute_table_pair_many

  integer(c_int) function restitute_table_collide(table, contact, first, second, ez, ex, error) result(status)
    type(restitute_table), intent(in) :: table
    type(restitute_table_contact), intent(in), optional :: contact
    type(restitute_body), intent(inout) :: first, second
    real(c_double), intent(inout), optional :: ez, ex
    type(restitute_error), intent(inout), optional :: error
    status = c_collide(table%address, contact, first, second, ez, ex, error)
  end function restitute_table_collide

  integer(c_int) function restitute_table_flags(table, contact, normal_speed, sliding_speed, flags, error) &
    result(status)
    type(restitute_table), intent(in) :: table
    type(restitute_table_contact), intent(in), optional :: contact
    real(c_double), intent(in) :: normal_speed, sliding_speed
    integer(c_int), intent(inout) :: flags
    type(restitute_error), intent(inout), optional :: error
    status = c_flags(table%address, contact, normal_speed, sliding_speed, flags, error)
  end function restitute_table_flags

  integer(c_int) function restitute_table_describe(table, info, error) result(status)
    type(restitute_table), intent(in) :: table
    type(restitute_table_info), intent(inout) :: info
    type(restitute_error), intent(inout), optional :: error
    status = c_describe(table%address, info, error)
  end function restitute_table_describe

  integer(c_int) function restitute_table_data_get(table, data, error) result(status)
    type(restitute_table), intent(in) :: table
    type(restitute_table_data), intent(inout) :: data
    type(restitute_error), intent(inout), optional :: error
    status = c_data_get(table%address, data, error)
  end function restitute_table_data_get

  !> The arrays of a table, which live as long as it does, in Fortran's order: ez(2, speeds), ex(4,
  !> places of psi, speeds).
  subroutine restitute_table_arrays(data, relaxation_time, modulus, speed, ez, strain, ex)
    type(restitute_table_data), intent(in) :: data
    real(c_double), pointer, intent(out), optional :: relaxation_time(:), modulus(:), speed(:), ez(:, :), &
      strain(:, :), ex(:, :, :)
    if (present(relaxation_time)) call c_f_pointer(data%relaxation_time, relaxation_time, [data%terms])
    if (present(modulus)) call c_f_pointer(data%modulus, modulus, [data%terms])
    if (present(speed)) call c_f_pointer(data%speed, speed, [data%speeds])
    if (present(ez)) call c_f_pointer(data%ez, ez, [2_c_int64_t, data%speeds])
    if (present(strain)) call c_f_pointer(data%strain, strain, [4_c_int64_t, data%speeds])
    if (present(ex)) call c_f_pointer(data%ex, ex, [4_c_int64_t, data%stick_cells + data%slip_cells + 2, data%speeds])
  end subroutine restitute_table_arrays

  !> Data that have these arrays, for restitute_table_create: targets that live until then, with
  !> stick_cells cells of psi up to 1. Arrays that do not fit each other are not taken;
  !> restitute_table_create says that they are missing.
  subroutine restitute_table_arrays_set(data, stick_cells, relaxation_time, modulus, speed, ez, strain, ex)
    type(restitute_table_data), intent(inout) :: data
    integer, intent(in) :: stick_cells
    real(c_double), pointer, contiguous, intent(in) :: relaxation_time(:), modulus(:), speed(:), ez(:, :), &
      strain(:, :), ex(:, :, :)
    integer :: n
    n = size(speed)
    data%terms = size(modulus)
    data%speeds = n
    data%stick_cells = stick_cells
    data%slip_cells = size(ex, 2) - 2 - stick_cells
    data%relaxation_time = place(relaxation_time, size(relaxation_time) == size(modulus))
    data%modulus = place(modulus, .true.)
    data%speed = place(speed, .true.)
    data%ez = place(ez, all(shape(ez) == [2, n]))
    data%strain = place(strain, all(shape(strain) == [4, n]))
    data%ex = place(ex, size(ex, 1) == 4 .and. size(ex, 3) == n)
  contains
    type(c_ptr) function place(array, fits)
      real(c_double), intent(in), target :: array(*)
      logical, intent(in) :: fits
      place = c_null_ptr
      if (fits) place = c_loc(array)
    end function place
  end subroutine restitute_table_arrays_set
end module restitute_table_module
