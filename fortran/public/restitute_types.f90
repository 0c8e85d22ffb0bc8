! SPDX-License-Identifier: BSD-3-Clause
!> Kinds, constants, handles and structs of restitute.h, with their constructors. Users get them
!> from the module restitute.
module restitute_types_module
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_int64_t, c_null_char, c_null_ptr, c_ptr, &
    c_size_t, c_sizeof
  implicit none (type, external)
  private
  public :: restitute_material, restitute_method, restitute_solver, restitute_plan, restitute_error
  public :: restitute_impact, restitute_scene, restitute_numbers, restitute_options, restitute_result, restitute_ledger
  public :: restitute_history, restitute_body, restitute_collision

  !> Kinds of all numbers that go in and out.
  integer, parameter, public :: restitute_real = c_double, restitute_long = c_int64_t, restitute_size = c_size_t

  !> Statuses, see restitute_status_text.
  integer(c_int), parameter, public :: &
    RESTITUTE_OK = 0, &
    RESTITUTE_NO_REBOUND = 1, &
    RESTITUTE_TOLERANCE_NOT_REACHED = 2, &
    RESTITUTE_ERROR_NULL = -1, &
    RESTITUTE_ERROR_STRUCT_SIZE = -2, &
    RESTITUTE_ERROR_DOMAIN = -3, &
    RESTITUTE_ERROR_MEMORY = -4, &
    RESTITUTE_ERROR_UNSTABLE_STEP = -5, &
    RESTITUTE_ERROR_TOO_MUCH_WORK = -6, &
    RESTITUTE_ERROR_FILE = -7, &
    RESTITUTE_ERROR_FORMAT = -8, &
    RESTITUTE_ERROR_INTERNAL = -9, &
    RESTITUTE_ERROR_INTEGRATOR = -10, &
    RESTITUTE_ERROR_INTERRUPTED = -11, &
    RESTITUTE_ERROR_CONVERGENCE = -12

  !> Bits of restitute_result%flags, see restitute_flag_text.
  integer(c_int), parameter, public :: &
    RESTITUTE_FLAG_FAST = 1, &
    RESTITUTE_FLAG_LARGE_CONTACT = 2, &
    RESTITUTE_FLAG_LONG_SLIDE = 4, &
    RESTITUTE_FLAG_COUPLED = 8, &
    RESTITUTE_FLAG_UNMEASURED = 16

  !> Which bodies deform.
  integer(c_int), parameter, public :: RESTITUTE_ONE_BODY_DEFORMS = 1, RESTITUTE_BOTH_BODIES_DEFORM = 2

  !> What went wrong; restitute_message gives its text.
  type, bind(c) :: restitute_error
    integer(c_int) :: status = 0
    character(kind=c_char) :: message(256) = c_null_char
  end type restitute_error

  !> A linear-viscoelastic solid, made by a restitute_material_ function, released by
  !> restitute_material_destroy.
  type, bind(c) :: restitute_material
    type(c_ptr) :: address = c_null_ptr
  end type restitute_material

  !> A way to solve the impact, as restitute_method_euler() gives it.
  type, bind(c) :: restitute_method
    type(c_ptr) :: address = c_null_ptr
  end type restitute_method

  !> Options and workspace, made by restitute_solver_create, released by restitute_solver_destroy.
  type, bind(c) :: restitute_solver
    type(c_ptr) :: address = c_null_ptr
  end type restitute_solver

  !> One normal motion for many sliding speeds, made by restitute_plan_create, released by
  !> restitute_plan_destroy.
  type, bind(c) :: restitute_plan
    type(c_ptr) :: address = c_null_ptr
  end type restitute_plan

  !> One dimensionless impact.
  type, bind(c) :: restitute_impact
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: chi = 0, psi = 0, delta1 = 0, gamma = 0
    type(restitute_material) :: material
  end type restitute_impact

  !> One impact in SI units.
  type, bind(c) :: restitute_scene
    integer(c_size_t) :: struct_size = 0
    type(restitute_material) :: material
    integer(c_int) :: deformable = 0
    real(c_double) :: radius1 = 0, mass1 = 0, radius2 = 0, mass2 = 0, inertia1 = 0, inertia2 = 0
    integer(c_int) :: rotation_blocked = 0
    real(c_double) :: friction = 0, normal_speed = 0, tangential_speed = 0, spin1 = 0, spin2 = 0, wave_density = 0
  end type restitute_scene

  !> Dimensionless numbers and scales of a scene.
  type, bind(c) :: restitute_numbers
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: chi = 0, psi = 0, delta1 = 0, gamma = 0, delta2 = 0, radius = 0, mass = 0, modulus = 0, &
      length_z = 0, length_x = 0, time = 0, force = 0, density = 0, dundurs_beta = 0
  end type restitute_numbers

  !> How to solve.
  type, bind(c) :: restitute_options
    integer(c_size_t) :: struct_size = 0
    type(restitute_method) :: method
    real(c_double) :: tolerance = 0
    integer(c_int64_t) :: elements = 0
    real(c_double) :: time_step = 0
    integer(c_int) :: threads = 0
    real(c_double) :: max_work = 0, time_limit = 0
    real(c_double) :: speed_limit = 0, radius_limit = 0, displacement_limit = 0, dundurs_limit = 0
  end type restitute_options

  !> What came out; restitute_method_name(result) is the name of its method.
  type, bind(c) :: restitute_result
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: ez = 0, ex = 0, error_ez = 0, error_ex = 0, contact_time = 0, max_indentation = 0, &
      max_contact_radius = 0, max_normal_force = 0, merging_bound = 0
    integer(c_int64_t) :: terms_merged = 0, elements = 0, steps = 0
    real(c_double) :: element_spacing = 0, time_step = 0, work = 0
    real(c_double) :: speed_ratio = 0, radius_ratio = 0, displacement_ratio = 0, dundurs_beta = 0
    integer(c_int) :: flags = 0
    type(c_ptr) :: method = c_null_ptr
  end type restitute_result

  !> Where the energy went.
  type, bind(c) :: restitute_ledger
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: rebound_z = 0, viscous_z = 0, left_z = 0, residual_z = 0, rebound_x = 0, friction_x = 0, &
      viscous_x = 0, left_x = 0, residual_x = 0
  end type restitute_ledger

  !> Time history, into arrays named by restitute_history_arrays.
  type, bind(c) :: restitute_history
    integer(c_size_t) :: struct_size = 0
    integer(c_size_t) :: capacity = 0, count = 0
    type(c_ptr) :: time = c_null_ptr, indentation = c_null_ptr, contact_radius = c_null_ptr, &
      stick_radius = c_null_ptr, normal_force = c_null_ptr, tangential_force = c_null_ptr, &
      normal_velocity = c_null_ptr, tangential_velocity = c_null_ptr
  end type restitute_history

  !> A sphere or a plane.
  type, bind(c) :: restitute_body
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: position(3) = 0, velocity(3) = 0, spin(3) = 0
    real(c_double) :: radius = 0, mass = 0, inertia = 0
    real(c_double) :: normal(3) = 0
  end type restitute_body

  !> What is between two bodies that collide.
  type, bind(c) :: restitute_collision
    integer(c_size_t) :: struct_size = 0
    type(restitute_material) :: material
    integer(c_int) :: deformable = 0
    real(c_double) :: friction = 0, touch_gap = 0, wave_density = 0
  end type restitute_collision

  ! Constructors: restitute_scene() is a scene with the defaults of restitute.h.
  interface restitute_impact
    module procedure new_impact
  end interface restitute_impact
  interface restitute_scene
    module procedure new_scene
  end interface restitute_scene
  interface restitute_numbers
    module procedure new_numbers
  end interface restitute_numbers
  interface restitute_options
    module procedure new_options
  end interface restitute_options
  interface restitute_result
    module procedure new_result
  end interface restitute_result
  interface restitute_ledger
    module procedure new_ledger
  end interface restitute_ledger
  interface restitute_history
    module procedure new_history
  end interface restitute_history
  interface restitute_body
    module procedure new_body
  end interface restitute_body
  interface restitute_collision
    module procedure new_collision
  end interface restitute_collision

  interface
    subroutine init_impact(value, size) bind(c, name="restitute_impact_init_sized")
      import
      type(restitute_impact), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_impact

    subroutine init_scene(value, size) bind(c, name="restitute_scene_init_sized")
      import
      type(restitute_scene), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_scene

    subroutine init_numbers(value, size) bind(c, name="restitute_numbers_init_sized")
      import
      type(restitute_numbers), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_numbers

    subroutine init_options(value, size) bind(c, name="restitute_options_init_sized")
      import
      type(restitute_options), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_options

    subroutine init_result(value, size) bind(c, name="restitute_result_init_sized")
      import
      type(restitute_result), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_result

    subroutine init_ledger(value, size) bind(c, name="restitute_ledger_init_sized")
      import
      type(restitute_ledger), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_ledger

    subroutine init_history(value, size) bind(c, name="restitute_history_init_sized")
      import
      type(restitute_history), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_history

    subroutine init_body(value, size) bind(c, name="restitute_body_init_sized")
      import
      type(restitute_body), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_body

    subroutine init_collision(value, size) bind(c, name="restitute_collision_init_sized")
      import
      type(restitute_collision), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_collision
  end interface

contains

  type(restitute_impact) function new_impact() result(new)
    call init_impact(new, c_sizeof(new))
  end function new_impact

  type(restitute_scene) function new_scene() result(new)
    call init_scene(new, c_sizeof(new))
  end function new_scene

  type(restitute_numbers) function new_numbers() result(new)
    call init_numbers(new, c_sizeof(new))
  end function new_numbers

  type(restitute_options) function new_options() result(new)
    call init_options(new, c_sizeof(new))
  end function new_options

  type(restitute_result) function new_result() result(new)
    call init_result(new, c_sizeof(new))
  end function new_result

  type(restitute_ledger) function new_ledger() result(new)
    call init_ledger(new, c_sizeof(new))
  end function new_ledger

  type(restitute_history) function new_history() result(new)
    call init_history(new, c_sizeof(new))
  end function new_history

  type(restitute_body) function new_body() result(new)
    call init_body(new, c_sizeof(new))
  end function new_body

  type(restitute_collision) function new_collision() result(new)
    call init_collision(new, c_sizeof(new))
  end function new_collision
end module restitute_types_module
