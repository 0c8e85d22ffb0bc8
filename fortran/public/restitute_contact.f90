! SPDX-License-Identifier: BSD-3-Clause
!> The component contact for Fortran: all that contact.h declares, under the same names. contact.h
!> is the manual, and the rules of the module restitute hold. Link restitute::fortran_contact.
!>
!>     use restitute
!>     use restitute_contact_module
!>     type(restitute_contact_law) :: law
!>     type(restitute_contact_rates) :: rates
!>     type(restitute_contact_motion) :: motion
!>     type(restitute_contact_force) :: force
!>     real(rk), allocatable :: state(:)
!>     status = restitute_contact_law_create(rubber, law=law, error=error)
!>     rates = restitute_contact_rates()
!>     status = restitute_contact_rates_set(law, step, rates, error)          ! once a time step
!>     allocate (state(restitute_contact_law_state_size(law)), source=0.0_rk) ! zeros: a new contact
!>     motion = restitute_contact_motion()
!>     status = restitute_contact_step(law, rates, motion, state, force, error)
module restitute_contact_module
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t, c_loc, c_null_ptr, c_ptr, c_size_t, c_sizeof
  use restitute, only: restitute_error, restitute_material, RESTITUTE_OK
  use restitute_texts_module, only: check_length, check_number
  implicit none (type, external)
  private
  public :: restitute_contact_law, restitute_contact_law_options, restitute_contact_rates, restitute_contact_motion
  public :: restitute_contact_force, restitute_contact_details
  public :: restitute_contact_law_create, restitute_contact_law_destroy, restitute_contact_law_state_size
  public :: restitute_contact_law_hash, restitute_contact_law_series, restitute_contact_time_scale
  public :: restitute_contact_time_step_limit, restitute_contact_rates_set, restitute_contact_step
  public :: restitute_contact_step_many, restitute_contact_peek, restitute_contact_details_get, restitute_contact_turn

  !> A contact law of a material, made by restitute_contact_law_create, released by
  !> restitute_contact_law_destroy.
  type, bind(c) :: restitute_contact_law
    type(c_ptr) :: address = c_null_ptr
  end type restitute_contact_law

  !> What a law is made of besides the material.
  type, bind(c) :: restitute_contact_law_options
    integer(c_size_t) :: struct_size = 0
    integer(c_int) :: deformable = 0, elements = 0, terms = 0, slip_cycles = 0
    real(c_double) :: shortest = 0, longest = 0
    integer(c_int) :: frictionless = 0, details = 0
  end type restitute_contact_law_options

  !> What depends on the time step alone.
  type, bind(c) :: restitute_contact_rates
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: step = 0
    integer(c_int64_t) :: law = 0
    real(c_double) :: values(50) = 0
  end type restitute_contact_rates

  !> The motion of two bodies in contact over one time step.
  type, bind(c) :: restitute_contact_motion
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: overlap = 0, normal(3) = 0, velocity(3) = 0, spin = 0, inverse_mass = 0, &
      inverse_tangential_mass = 0, radius = 0, friction = 0
  end type restitute_contact_motion

  !> Force on body 1.
  type, bind(c) :: restitute_contact_force
    real(c_double) :: normal = 0, tangential(3) = 0
  end type restitute_contact_force

  !> What a contact has done since it began, and how it is now.
  type, bind(c) :: restitute_contact_details
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: contact_radius = 0, stick_radius = 0, work = 0, stored = 0, friction = 0, viscous = 0, &
      friction_power = 0, viscous_power = 0
  end type restitute_contact_details

  interface restitute_contact_law_options
    module procedure new_contact_law_options
  end interface restitute_contact_law_options
  interface restitute_contact_rates
    module procedure new_contact_rates
  end interface restitute_contact_rates
  interface restitute_contact_motion
    module procedure new_contact_motion
  end interface restitute_contact_motion
  interface restitute_contact_details
    module procedure new_contact_details
  end interface restitute_contact_details

  interface
    subroutine init_contact_law_options(value, size) bind(c, name="restitute_contact_law_options_init_sized")
      import
      type(restitute_contact_law_options), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_contact_law_options

    subroutine init_contact_rates(value, size) bind(c, name="restitute_contact_rates_init_sized")
      import
      type(restitute_contact_rates), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_contact_rates

    subroutine init_contact_motion(value, size) bind(c, name="restitute_contact_motion_init_sized")
      import
      type(restitute_contact_motion), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_contact_motion

    subroutine init_contact_details(value, size) bind(c, name="restitute_contact_details_init_sized")
      import
      type(restitute_contact_details), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_contact_details

    integer(c_int) function c_law_create(material, options, law, error) bind(c, name="restitute_contact_law_create")
      import
      type(c_ptr), value :: material
      type(restitute_contact_law_options), intent(in), optional :: options
      type(restitute_contact_law), intent(inout) :: law
      type(restitute_error), intent(inout), optional :: error
    end function c_law_create

    subroutine c_law_destroy(law) bind(c, name="restitute_contact_law_destroy")
      import
      type(c_ptr), value :: law
    end subroutine c_law_destroy

    integer(c_size_t) function c_law_state_size(law) bind(c, name="restitute_contact_law_state_size")
      import
      type(c_ptr), value :: law
    end function c_law_state_size

    integer(c_int64_t) function c_law_hash(law) bind(c, name="restitute_contact_law_hash")
      import
      type(c_ptr), value :: law
    end function c_law_hash

    integer(c_int) function c_law_series(law, equilibrium_modulus, parallel_viscosity, n_terms, relaxation_time, &
                                         modulus, error_bound, error) bind(c, name="restitute_contact_law_series")
      import
      type(c_ptr), value :: law
      real(c_double), intent(inout), optional :: equilibrium_modulus, parallel_viscosity, error_bound
      real(c_double), intent(inout), optional :: relaxation_time(*), modulus(*)
      integer(c_size_t), intent(inout), optional :: n_terms
      type(restitute_error), intent(inout), optional :: error
    end function c_law_series

    integer(c_int) function c_time_scale(law, mass, radius, speed, scale, error) &
      bind(c, name="restitute_contact_time_scale")
      import
      type(c_ptr), value :: law
      real(c_double), value :: mass, radius, speed
      real(c_double), intent(inout) :: scale
      type(restitute_error), intent(inout), optional :: error
    end function c_time_scale

    integer(c_int) function c_time_step_limit(law, mass, radius, speed, limit, error) &
      bind(c, name="restitute_contact_time_step_limit")
      import
      type(c_ptr), value :: law
      real(c_double), value :: mass, radius, speed
      real(c_double), intent(inout) :: limit
      type(restitute_error), intent(inout), optional :: error
    end function c_time_step_limit

    integer(c_int) function c_rates_set(law, step, rates, error) bind(c, name="restitute_contact_rates_set")
      import
      type(c_ptr), value :: law
      real(c_double), value :: step
      type(restitute_contact_rates), intent(inout) :: rates
      type(restitute_error), intent(inout), optional :: error
    end function c_rates_set

    integer(c_int) function c_step(law, rates, motion, state, force, error) bind(c, name="restitute_contact_step")
      import
      type(c_ptr), value :: law
      type(restitute_contact_rates), intent(in) :: rates
      type(restitute_contact_motion), intent(in) :: motion
      real(c_double), intent(inout) :: state(*)
      type(restitute_contact_force), intent(inout) :: force
      type(restitute_error), intent(inout), optional :: error
    end function c_step

    integer(c_int) function c_step_many(law, rates, n, motions, states, forces, statuses, error) &
      bind(c, name="restitute_contact_step_many")
      import
      type(c_ptr), value :: law
      type(restitute_contact_rates), intent(in) :: rates
      integer(c_size_t), value :: n
      type(restitute_contact_motion), intent(in) :: motions(*)
      type(c_ptr), intent(in) :: states(*)
      type(restitute_contact_force), intent(inout) :: forces(*)
      integer(c_int), intent(inout), optional :: statuses(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_step_many

    integer(c_int) function c_peek(law, normal, state, force, error) bind(c, name="restitute_contact_peek")
      import
      type(c_ptr), value :: law
      real(c_double), intent(in) :: normal(3), state(*)
      type(restitute_contact_force), intent(inout) :: force
      type(restitute_error), intent(inout), optional :: error
    end function c_peek

    integer(c_int) function c_details_get(law, radius, state, details, error) &
      bind(c, name="restitute_contact_details_get")
      import
      type(c_ptr), value :: law
      real(c_double), value :: radius
      real(c_double), intent(in) :: state(*)
      type(restitute_contact_details), intent(inout) :: details
      type(restitute_error), intent(inout), optional :: error
    end function c_details_get

    integer(c_int) function c_turn(law, from, to, state, error) bind(c, name="restitute_contact_turn")
      import
      type(c_ptr), value :: law
      real(c_double), intent(in) :: from(3), to(3)
      real(c_double), intent(inout) :: state(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_turn
  end interface

contains

  type(restitute_contact_law_options) function new_contact_law_options() result(new)
    call init_contact_law_options(new, c_sizeof(new))
  end function new_contact_law_options

  type(restitute_contact_rates) function new_contact_rates() result(new)
    call init_contact_rates(new, c_sizeof(new))
  end function new_contact_rates

  type(restitute_contact_motion) function new_contact_motion() result(new)
    call init_contact_motion(new, c_sizeof(new))
  end function new_contact_motion

  type(restitute_contact_details) function new_contact_details() result(new)
    call init_contact_details(new, c_sizeof(new))
  end function new_contact_details

  integer(c_int) function restitute_contact_law_create(material, options, law, error) result(status)
    type(restitute_material), intent(in) :: material
    type(restitute_contact_law_options), intent(in), optional :: options
    type(restitute_contact_law), intent(inout) :: law
    type(restitute_error), intent(inout), optional :: error
    status = c_law_create(material%address, options, law, error)
  end function restitute_contact_law_create

  subroutine restitute_contact_law_destroy(law)
    type(restitute_contact_law), intent(inout) :: law
    call c_law_destroy(law%address)
    law%address = c_null_ptr
  end subroutine restitute_contact_law_destroy

  integer(c_size_t) function restitute_contact_law_state_size(law) result(doubles)
    type(restitute_contact_law), intent(in) :: law
    doubles = c_law_state_size(law%address)
  end function restitute_contact_law_state_size

  integer(c_int64_t) function restitute_contact_law_hash(law) result(hash)
    type(restitute_contact_law), intent(in) :: law
    hash = c_law_hash(law%address)
  end function restitute_contact_law_hash

  !> The arrays are made as long as the series.
  integer(c_int) function restitute_contact_law_series(law, equilibrium_modulus, parallel_viscosity, relaxation_time, &
                                                       modulus, error_bound, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    real(c_double), intent(inout), optional :: equilibrium_modulus, parallel_viscosity, error_bound
    real(c_double), allocatable, intent(inout), optional :: relaxation_time(:), modulus(:)
    type(restitute_error), intent(inout), optional :: error
    real(c_double) :: tau(8), g(8)
    integer(c_size_t) :: n
    status = c_law_series(law%address, equilibrium_modulus, parallel_viscosity, n, tau, g, error_bound, error)
    if (status < 0) return
    if (present(relaxation_time)) relaxation_time = tau(:n)
    if (present(modulus)) modulus = g(:n)
  end function restitute_contact_law_series

  integer(c_int) function restitute_contact_time_scale(law, mass, radius, speed, scale, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    real(c_double), intent(in) :: mass, radius, speed
    real(c_double), intent(inout) :: scale
    type(restitute_error), intent(inout), optional :: error
    status = c_time_scale(law%address, mass, radius, speed, scale, error)
  end function restitute_contact_time_scale

  integer(c_int) function restitute_contact_time_step_limit(law, mass, radius, speed, limit, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    real(c_double), intent(in) :: mass, radius, speed
    real(c_double), intent(inout) :: limit
    type(restitute_error), intent(inout), optional :: error
    status = c_time_step_limit(law%address, mass, radius, speed, limit, error)
  end function restitute_contact_time_step_limit

  integer(c_int) function restitute_contact_rates_set(law, step, rates, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    real(c_double), intent(in) :: step
    type(restitute_contact_rates), intent(inout) :: rates
    type(restitute_error), intent(inout), optional :: error
    status = c_rates_set(law%address, step, rates, error)
  end function restitute_contact_rates_set

  !> The state may be longer than restitute_contact_law_state_size(law), not shorter; so everywhere
  !> below.
  integer(c_int) function restitute_contact_step(law, rates, motion, state, force, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    type(restitute_contact_rates), intent(in) :: rates
    type(restitute_contact_motion), intent(in) :: motion
    real(c_double), contiguous, intent(inout) :: state(:)
    type(restitute_contact_force), intent(inout) :: force
    type(restitute_error), intent(inout), optional :: error
    status = room_in(law, size(state, kind=c_size_t), error)
    if (status == RESTITUTE_OK) status = c_step(law%address, rates, motion, state, force, error)
  end function restitute_contact_step

  !> As many contacts as there are motions; that of motions(i) has states(:, i).
  integer(c_int) function restitute_contact_step_many(law, rates, motions, states, forces, statuses, error) &
    result(status)
    type(restitute_contact_law), intent(in) :: law
    type(restitute_contact_rates), intent(in) :: rates
    type(restitute_contact_motion), contiguous, intent(in) :: motions(:)
    real(c_double), contiguous, target, intent(inout) :: states(:, :)
    type(restitute_contact_force), contiguous, intent(inout) :: forces(:)
    integer(c_int), intent(inout), optional :: statuses(:)
    type(restitute_error), intent(inout), optional :: error
    type(c_ptr) :: places(size(motions))
    integer(c_size_t) :: n, i
    n = size(motions, kind=c_size_t)
    status = room_in(law, size(states, 1, c_size_t), error)
    call check_number("states(1, :)", size(states, 2, c_size_t), "motions", n, status, error)
    call check_length("forces", forces, "motions", n, status, error)
    call check_length("statuses", statuses, "motions", n, status, error)
    if (status /= RESTITUTE_OK) return
    do i = 1, n
      places(i) = c_loc(states(1, i))
    end do
    status = c_step_many(law%address, rates, n, motions, places, forces, statuses, error)
  end function restitute_contact_step_many

  integer(c_int) function restitute_contact_peek(law, normal, state, force, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    real(c_double), intent(in) :: normal(3)
    real(c_double), contiguous, intent(in) :: state(:)
    type(restitute_contact_force), intent(inout) :: force
    type(restitute_error), intent(inout), optional :: error
    status = room_in(law, size(state, kind=c_size_t), error)
    if (status == RESTITUTE_OK) status = c_peek(law%address, normal, state, force, error)
  end function restitute_contact_peek

  integer(c_int) function restitute_contact_details_get(law, radius, state, details, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    real(c_double), intent(in) :: radius
    real(c_double), contiguous, intent(in) :: state(:)
    type(restitute_contact_details), intent(inout) :: details
    type(restitute_error), intent(inout), optional :: error
    status = room_in(law, size(state, kind=c_size_t), error)
    if (status == RESTITUTE_OK) status = c_details_get(law%address, radius, state, details, error)
  end function restitute_contact_details_get

  integer(c_int) function restitute_contact_turn(law, from, to, state, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    real(c_double), intent(in) :: from(3), to(3)
    real(c_double), contiguous, intent(inout) :: state(:)
    type(restitute_error), intent(inout), optional :: error
    status = room_in(law, size(state, kind=c_size_t), error)
    if (status == RESTITUTE_OK) status = c_turn(law%address, from, to, state, error)
  end function restitute_contact_turn

  !> Whether a state of so many doubles is long enough for the law.
  integer(c_int) function room_in(law, doubles, error) result(status)
    type(restitute_contact_law), intent(in) :: law
    integer(c_size_t), intent(in) :: doubles
    type(restitute_error), intent(inout), optional :: error
    integer(c_size_t) :: needed
    status = RESTITUTE_OK
    needed = c_law_state_size(law%address)
    if (doubles >= needed) return
    call check_number("state", doubles, "restitute_contact_law_state_size says", needed, status, error)
  end function room_in
end module restitute_contact_module
