! SPDX-License-Identifier: BSD-3-Clause
!> The library restitute for Fortran: all that restitute.h declares, under the same names.
!>
!> restitute.h is the manual: units, ranges and examples hold here as they stand there. What differs:
!> - Optional arguments are optional here, where C passes NULL: error, ledger, history, result, ...
!> - Every function that can fail returns a status, RESTITUTE_OK = 0 or one of the constants; negative: failed.
!> - restitute_scene() gives a prepared scene, as restitute_scene_init does; likewise every struct that has a size.
!> - Materials, methods, solvers and plans are small types that hold a C address; assigning one copies the address, not the thing.
!> - Arrays know their size, texts are Fortran texts: restitute_message(error), restitute_method_name(result).
!>
!>     use restitute
!>     type(restitute_material) :: rubber
!>     type(restitute_scene) :: scene
!>     status = restitute_material_standard_solid(1e6_rk, 2e6_rk, 50.0_rk, 0.5_rk, rubber)   ! rk = restitute_real
!>     scene = restitute_scene()
!>     scene%material = rubber
!>     ...
!>     status = restitute_scene_pair(scene, ez, ex, error)
module restitute
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_int, c_int64_t, c_loc, &
                                         c_null_char, c_null_ptr, c_ptr, c_size_t
  implicit none (type, external)
  private
  public :: restitute_material, restitute_method, restitute_solver, restitute_plan, restitute_error
  public :: restitute_impact, restitute_impact_init
  public :: restitute_scene, restitute_scene_init
  public :: restitute_numbers, restitute_numbers_init
  public :: restitute_options, restitute_options_init
  public :: restitute_result, restitute_result_init
  public :: restitute_ledger, restitute_ledger_init
  public :: restitute_history, restitute_history_init
  public :: restitute_body, restitute_body_init
  public :: restitute_contact, restitute_contact_init
  public :: restitute_status_text, restitute_version, restitute_message, restitute_flag_text
  public :: restitute_material_prony, restitute_material_elastic, restitute_material_standard_solid
  public :: restitute_material_kelvin_voigt, restitute_material_maxwell, restitute_material_pair
  public :: restitute_material_dundurs, restitute_material_destroy, restitute_material_modulus
  public :: restitute_material_poisson_ratio, restitute_material_terms
  public :: restitute_scene_numbers, restitute_method_euler, restitute_method_sync, restitute_method_name
  public :: restitute_solver_create, restitute_solver_destroy, restitute_history_arrays
  public :: restitute_solve, restitute_solve_scene, restitute_collide
  public :: restitute_solve_many, restitute_solve_scenes
  public :: restitute_plan_create, restitute_plan_create_scene, restitute_plan_solve, restitute_plan_destroy
  public :: restitute_pair, restitute_scene_pair, restitute_critical_psi

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
    RESTITUTE_FLAG_COUPLED = 8

  !> Which bodies deform.
  integer(c_int), parameter, public :: RESTITUTE_ONE_BODY_DEFORMS = 1, RESTITUTE_BOTH_BODIES_DEFORM = 2

  !> What went wrong; restitute_message gives its text.
  type, bind(c) :: restitute_error
    integer(c_int) :: status = 0
    character(kind=c_char) :: message(256) = c_null_char
  end type restitute_error

  !> A linear-viscoelastic solid, made by a restitute_material_ function, released by restitute_material_destroy.
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

  !> One normal motion for many sliding speeds, made by restitute_plan_create or restitute_plan_create_scene, released by
  !> restitute_plan_destroy.
  type, bind(c) :: restitute_plan
    type(c_ptr) :: address = c_null_ptr
  end type restitute_plan

  !> One dimensionless impact: restitute_impact of the C header, prepared by restitute_impact() or restitute_impact_init.
  type, bind(c) :: restitute_impact
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: chi = 0, psi = 0, delta1 = 0, gamma = 0
    type(restitute_material) :: solid
  end type restitute_impact

  !> One impact in SI units: restitute_scene of the C header, prepared by restitute_scene() or restitute_scene_init.
  type, bind(c) :: restitute_scene
    integer(c_size_t) :: struct_size = 0
    type(restitute_material) :: material
    integer(c_int) :: deformable = 0
    real(c_double) :: radius1 = 0, mass1 = 0, radius2 = 0, mass2 = 0, inertia1 = 0, inertia2 = 0
    integer(c_int) :: rotation_blocked = 0
    real(c_double) :: friction = 0, normal_speed = 0, tangential_speed = 0, spin1 = 0, spin2 = 0, density = 0
  end type restitute_scene

  !> Dimensionless numbers and scales of a scene: restitute_numbers of the C header, prepared by restitute_numbers() or
  !> restitute_numbers_init.
  type, bind(c) :: restitute_numbers
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: chi = 0, psi = 0, delta1 = 0, gamma = 0, delta2 = 0, radius = 0, mass = 0, modulus = 0, &
      length_z = 0, length_x = 0, time = 0, force = 0
  end type restitute_numbers

  !> How to solve: restitute_options of the C header, prepared by restitute_options() or restitute_options_init.
  type, bind(c) :: restitute_options
    integer(c_size_t) :: struct_size = 0
    type(restitute_method) :: method
    real(c_double) :: tolerance = 0
    integer(c_int64_t) :: elements = 0
    real(c_double) :: time_step = 0
    integer(c_int64_t) :: max_updates = 0
    real(c_double) :: time_limit = 0
    real(c_double) :: speed_limit = 0, radius_limit = 0, displacement_limit = 0, dundurs_limit = 0
  end type restitute_options

  !> What came out: restitute_result of the C header, prepared by restitute_result() or restitute_result_init.
  type, bind(c) :: restitute_result
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: ez = 0, ex = 0, error_ez = 0, error_ex = 0, contact_time = 0, max_indentation = 0, &
      max_contact_radius = 0, max_normal_force = 0, merging_bound = 0
    integer(c_int64_t) :: terms_merged = 0, elements = 0, steps = 0
    real(c_double) :: element_spacing = 0, time_step = 0
    integer(c_int64_t) :: updates = 0
    real(c_double) :: speed_ratio = 0, radius_ratio = 0, displacement_ratio = 0, dundurs_beta = 0
    integer(c_int) :: flags = 0
    type(c_ptr) :: method = c_null_ptr
  end type restitute_result

  !> Where the energy went: restitute_ledger of the C header, prepared by restitute_ledger() or restitute_ledger_init.
  type, bind(c) :: restitute_ledger
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: rebound_z = 0, viscous_z = 0, left_z = 0, residual_z = 0, rebound_x = 0, friction_x = 0, &
      viscous_x = 0, left_x = 0, residual_x = 0
  end type restitute_ledger

  !> Time history, into arrays named by restitute_history_arrays: restitute_history of the C header, prepared by
  !> restitute_history() or restitute_history_init.
  type, bind(c) :: restitute_history
    integer(c_size_t) :: struct_size = 0
    integer(c_size_t) :: capacity = 0, count = 0
    type(c_ptr) :: time = c_null_ptr, indentation = c_null_ptr, contact_radius = c_null_ptr, &
      stick_radius = c_null_ptr, normal_force = c_null_ptr, tangential_force = c_null_ptr, &
      normal_velocity = c_null_ptr, tangential_velocity = c_null_ptr
  end type restitute_history

  !> A sphere or a plane: restitute_body of the C header, prepared by restitute_body() or restitute_body_init.
  type, bind(c) :: restitute_body
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: position(3) = 0, velocity(3) = 0, spin(3) = 0
    real(c_double) :: radius = 0, mass = 0, inertia = 0
    real(c_double) :: normal(3) = 0
  end type restitute_body

  !> What is between two bodies: restitute_contact of the C header, prepared by restitute_contact() or restitute_contact_init.
  type, bind(c) :: restitute_contact
    integer(c_size_t) :: struct_size = 0
    type(restitute_material) :: material
    integer(c_int) :: deformable = 0
    real(c_double) :: friction = 0, touch_gap = 0, density = 0
  end type restitute_contact

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
  interface restitute_contact
    module procedure new_contact
  end interface restitute_contact

  !> Name of a method, or of the method that gave a result.
  interface restitute_method_name
    module procedure name_of_method, name_of_result_method
  end interface restitute_method_name

  ! Functions of C that Fortran calls as they are.
  interface
    subroutine restitute_impact_init(impact) bind(c, name="restitute_impact_init")
      import :: restitute_impact
      implicit none (type, external)
      type(restitute_impact), intent(out) :: impact
    end subroutine restitute_impact_init

    subroutine restitute_scene_init(scene) bind(c, name="restitute_scene_init")
      import :: restitute_scene
      implicit none (type, external)
      type(restitute_scene), intent(out) :: scene
    end subroutine restitute_scene_init

    subroutine restitute_numbers_init(numbers) bind(c, name="restitute_numbers_init")
      import :: restitute_numbers
      implicit none (type, external)
      type(restitute_numbers), intent(out) :: numbers
    end subroutine restitute_numbers_init

    subroutine restitute_options_init(options) bind(c, name="restitute_options_init")
      import :: restitute_options
      implicit none (type, external)
      type(restitute_options), intent(out) :: options
    end subroutine restitute_options_init

    subroutine restitute_result_init(result) bind(c, name="restitute_result_init")
      import :: restitute_result
      implicit none (type, external)
      type(restitute_result), intent(out) :: result
    end subroutine restitute_result_init

    subroutine restitute_ledger_init(ledger) bind(c, name="restitute_ledger_init")
      import :: restitute_ledger
      implicit none (type, external)
      type(restitute_ledger), intent(out) :: ledger
    end subroutine restitute_ledger_init

    subroutine restitute_history_init(history) bind(c, name="restitute_history_init")
      import :: restitute_history
      implicit none (type, external)
      type(restitute_history), intent(out) :: history
    end subroutine restitute_history_init

    subroutine restitute_body_init(body) bind(c, name="restitute_body_init")
      import :: restitute_body
      implicit none (type, external)
      type(restitute_body), intent(out) :: body
    end subroutine restitute_body_init

    subroutine restitute_contact_init(contact) bind(c, name="restitute_contact_init")
      import :: restitute_contact
      implicit none (type, external)
      type(restitute_contact), intent(out) :: contact
    end subroutine restitute_contact_init

    function restitute_material_elastic(shear_modulus, poisson_ratio, material, error) result(status) &
      bind(c, name="restitute_material_elastic")
      import :: c_double, c_int, restitute_error, restitute_material
      implicit none (type, external)
      real(c_double), intent(in), value :: shear_modulus, poisson_ratio
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_material_elastic

    function restitute_material_standard_solid(modulus1, modulus2, viscosity, poisson_ratio, material, error) &
      result(status) bind(c, name="restitute_material_standard_solid")
      import :: c_double, c_int, restitute_error, restitute_material
      implicit none (type, external)
      real(c_double), intent(in), value :: modulus1, modulus2, viscosity, poisson_ratio
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_material_standard_solid

    function restitute_material_kelvin_voigt(modulus1, viscosity, poisson_ratio, material, error) result(status) &
      bind(c, name="restitute_material_kelvin_voigt")
      import :: c_double, c_int, restitute_error, restitute_material
      implicit none (type, external)
      real(c_double), intent(in), value :: modulus1, viscosity, poisson_ratio
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_material_kelvin_voigt

    function restitute_material_maxwell(modulus, viscosity, poisson_ratio, material, error) result(status) &
      bind(c, name="restitute_material_maxwell")
      import :: c_double, c_int, restitute_error, restitute_material
      implicit none (type, external)
      real(c_double), intent(in), value :: modulus, viscosity, poisson_ratio
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_material_maxwell

    function restitute_scene_numbers(scene, numbers, error) result(status) bind(c, name="restitute_scene_numbers")
      import :: c_int, restitute_error, restitute_numbers, restitute_scene
      implicit none (type, external)
      type(restitute_scene), intent(in) :: scene
      type(restitute_numbers), intent(inout) :: numbers
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_scene_numbers

    function c_solver_create(options, solver, error) result(status) bind(c, name="restitute_solver_create")
      import :: c_int, restitute_error, restitute_options, restitute_solver
      implicit none (type, external)
      type(restitute_options), intent(in), optional :: options
      type(restitute_solver), intent(inout) :: solver
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_solver_create

    function restitute_pair(chi, psi, delta1, gamma, ez, ex, error) result(status) bind(c, name="restitute_pair")
      import :: c_double, c_int, restitute_error
      implicit none (type, external)
      real(c_double), intent(in), value :: chi, psi, delta1, gamma
      real(c_double), intent(inout), optional :: ez, ex
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_pair

    function restitute_scene_pair(scene, ez, ex, error) result(status) bind(c, name="restitute_scene_pair")
      import :: c_double, c_int, restitute_error, restitute_scene
      implicit none (type, external)
      type(restitute_scene), intent(in) :: scene
      real(c_double), intent(inout), optional :: ez, ex
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_scene_pair

    pure function restitute_critical_psi(chi, ez) result(psi) bind(c, name="restitute_critical_psi")
      import :: c_double
      implicit none (type, external)
      real(c_double), intent(in), value :: chi, ez
      real(c_double) :: psi
    end function restitute_critical_psi
  end interface

  ! Functions of C that take or give addresses; the procedures below call them.
  interface
    function c_material_prony(equilibrium_modulus, parallel_viscosity, n_terms, relaxation_time, modulus, poisson_ratio, &
                              material, error) result(status) bind(c, name="restitute_material_prony")
      import :: c_double, c_int, c_size_t, restitute_error, restitute_material
      implicit none (type, external)
      real(c_double), intent(in), value :: equilibrium_modulus, parallel_viscosity, poisson_ratio
      integer(c_size_t), intent(in), value :: n_terms
      real(c_double), intent(in) :: relaxation_time(*), modulus(*)
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_material_prony

    function c_material_pair(material1, material2, pair, error) result(status) bind(c, name="restitute_material_pair")
      import :: c_int, c_ptr, restitute_error, restitute_material
      implicit none (type, external)
      type(c_ptr), intent(in), value :: material1, material2
      type(restitute_material), intent(inout) :: pair
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_material_pair

    function c_material_dundurs(material) result(beta) bind(c, name="restitute_material_dundurs")
      import :: c_double, c_ptr
      implicit none (type, external)
      type(c_ptr), intent(in), value :: material
      real(c_double) :: beta
    end function c_material_dundurs

    subroutine c_material_destroy(material) bind(c, name="restitute_material_destroy")
      import :: c_ptr
      implicit none (type, external)
      type(c_ptr), intent(in), value :: material
    end subroutine c_material_destroy

    function c_material_modulus(material, time) result(modulus) bind(c, name="restitute_material_modulus")
      import :: c_double, c_ptr
      implicit none (type, external)
      type(c_ptr), intent(in), value :: material
      real(c_double), intent(in), value :: time
      real(c_double) :: modulus
    end function c_material_modulus

    function c_material_poisson_ratio(material) result(nu) bind(c, name="restitute_material_poisson_ratio")
      import :: c_double, c_ptr
      implicit none (type, external)
      type(c_ptr), intent(in), value :: material
      real(c_double) :: nu
    end function c_material_poisson_ratio

    function c_material_terms(material) result(n) bind(c, name="restitute_material_terms")
      import :: c_ptr, c_size_t
      implicit none (type, external)
      type(c_ptr), intent(in), value :: material
      integer(c_size_t) :: n
    end function c_material_terms

    function c_method_euler() result(method) bind(c, name="restitute_method_euler")
      import :: c_ptr
      implicit none (type, external)
      type(c_ptr) :: method
    end function c_method_euler

    function c_method_sync() result(method) bind(c, name="restitute_method_sync")
      import :: c_ptr
      implicit none (type, external)
      type(c_ptr) :: method
    end function c_method_sync

    function c_method_name(method) result(name) bind(c, name="restitute_method_name")
      import :: c_ptr
      implicit none (type, external)
      type(c_ptr), intent(in), value :: method
      type(c_ptr) :: name
    end function c_method_name

    subroutine c_solver_destroy(solver) bind(c, name="restitute_solver_destroy")
      import :: c_ptr
      implicit none (type, external)
      type(c_ptr), intent(in), value :: solver
    end subroutine c_solver_destroy

    function c_solve(solver, impact, result, ledger, history, error) result(status) bind(c, name="restitute_solve")
      import :: c_int, c_ptr, restitute_error, restitute_history, restitute_impact, restitute_ledger, restitute_result
      implicit none (type, external)
      type(c_ptr), intent(in), value :: solver
      type(restitute_impact), intent(in) :: impact
      type(restitute_result), intent(inout), optional :: result
      type(restitute_ledger), intent(inout), optional :: ledger
      type(restitute_history), intent(inout), optional :: history
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_solve

    function c_solve_scene(solver, scene, result, ledger, history, error) result(status) &
      bind(c, name="restitute_solve_scene")
      import :: c_int, c_ptr, restitute_error, restitute_history, restitute_ledger, restitute_result, restitute_scene
      implicit none (type, external)
      type(c_ptr), intent(in), value :: solver
      type(restitute_scene), intent(in) :: scene
      type(restitute_result), intent(inout), optional :: result
      type(restitute_ledger), intent(inout), optional :: ledger
      type(restitute_history), intent(inout), optional :: history
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_solve_scene

    function c_solve_many(options, n, impacts, results, statuses, threads, error) result(status) &
      bind(c, name="restitute_solve_many")
      import :: c_int, c_size_t, restitute_error, restitute_impact, restitute_options, restitute_result
      implicit none (type, external)
      type(restitute_options), intent(in), optional :: options
      integer(c_size_t), intent(in), value :: n
      type(restitute_impact), intent(in) :: impacts(*)
      type(restitute_result), intent(inout), optional :: results(*)
      integer(c_int), intent(inout), optional :: statuses(*)
      integer(c_int), intent(in), value :: threads
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_solve_many

    function c_solve_scenes(options, n, scenes, results, statuses, threads, error) result(status) &
      bind(c, name="restitute_solve_scenes")
      import :: c_int, c_size_t, restitute_error, restitute_options, restitute_result, restitute_scene
      implicit none (type, external)
      type(restitute_options), intent(in), optional :: options
      integer(c_size_t), intent(in), value :: n
      type(restitute_scene), intent(in) :: scenes(*)
      type(restitute_result), intent(inout), optional :: results(*)
      integer(c_int), intent(inout), optional :: statuses(*)
      integer(c_int), intent(in), value :: threads
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_solve_scenes

    function c_plan_create(options, impact, plan, error) result(status) bind(c, name="restitute_plan_create")
      import :: c_int, restitute_error, restitute_impact, restitute_options, restitute_plan
      implicit none (type, external)
      type(restitute_options), intent(in), optional :: options
      type(restitute_impact), intent(in) :: impact
      type(restitute_plan), intent(inout) :: plan
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_plan_create

    function c_plan_create_scene(options, scene, plan, error) result(status) &
      bind(c, name="restitute_plan_create_scene")
      import :: c_int, restitute_error, restitute_options, restitute_plan, restitute_scene
      implicit none (type, external)
      type(restitute_options), intent(in), optional :: options
      type(restitute_scene), intent(in) :: scene
      type(restitute_plan), intent(inout) :: plan
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_plan_create_scene

    function c_plan_solve(plan, sliding, result, ledger, history, error) result(status) &
      bind(c, name="restitute_plan_solve")
      import :: c_double, c_int, c_ptr, restitute_error, restitute_history, restitute_ledger, restitute_result
      implicit none (type, external)
      type(c_ptr), intent(in), value :: plan
      real(c_double), intent(in), value :: sliding
      type(restitute_result), intent(inout), optional :: result
      type(restitute_ledger), intent(inout), optional :: ledger
      type(restitute_history), intent(inout), optional :: history
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_plan_solve

    subroutine c_plan_destroy(plan) bind(c, name="restitute_plan_destroy")
      import :: c_ptr
      implicit none (type, external)
      type(c_ptr), intent(in), value :: plan
    end subroutine c_plan_destroy

    function c_collide(solver, contact, first, second, result, error) result(status) bind(c, name="restitute_collide")
      import :: c_int, c_ptr, restitute_body, restitute_contact, restitute_error, restitute_result
      implicit none (type, external)
      type(c_ptr), intent(in), value :: solver
      type(restitute_contact), intent(in) :: contact
      type(restitute_body), intent(inout) :: first, second
      type(restitute_result), intent(inout), optional :: result
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_collide

    function c_status_text(status) result(text) bind(c, name="restitute_status_text")
      import :: c_int, c_ptr
      implicit none (type, external)
      integer(c_int), intent(in), value :: status
      type(c_ptr) :: text
    end function c_status_text

    function c_flag_text(flag) result(text) bind(c, name="restitute_flag_text")
      import :: c_int, c_ptr
      implicit none (type, external)
      integer(c_int), intent(in), value :: flag
      type(c_ptr) :: text
    end function c_flag_text

    function c_version() result(text) bind(c, name="restitute_version")
      import :: c_ptr
      implicit none (type, external)
      type(c_ptr) :: text
    end function c_version

    function c_text_length(text) result(length) bind(c, name="strlen")
      import :: c_ptr, c_size_t
      implicit none (type, external)
      type(c_ptr), intent(in), value :: text
      integer(c_size_t) :: length
    end function c_text_length
  end interface

contains

  function new_impact() result(impact)
    type(restitute_impact) :: impact
    call restitute_impact_init(impact)
  end function new_impact

  function new_scene() result(scene)
    type(restitute_scene) :: scene
    call restitute_scene_init(scene)
  end function new_scene

  function new_numbers() result(numbers)
    type(restitute_numbers) :: numbers
    call restitute_numbers_init(numbers)
  end function new_numbers

  function new_options() result(options)
    type(restitute_options) :: options
    call restitute_options_init(options)
  end function new_options

  function new_result() result(result)
    type(restitute_result) :: result
    call restitute_result_init(result)
  end function new_result

  function new_ledger() result(ledger)
    type(restitute_ledger) :: ledger
    call restitute_ledger_init(ledger)
  end function new_ledger

  function new_history() result(history)
    type(restitute_history) :: history
    call restitute_history_init(history)
  end function new_history

  function new_body() result(body)
    type(restitute_body) :: body
    call restitute_body_init(body)
  end function new_body

  function new_contact() result(contact)
    type(restitute_contact) :: contact
    call restitute_contact_init(contact)
  end function new_contact

  ! --------------------------------------------------------------------------------------------------------- texts

  !> A Fortran text from one of C that ends with a null character; empty for a null address.
  function fortran_text(address) result(text)
    type(c_ptr), intent(in) :: address
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    text = ""
    if (.not. c_associated(address)) return
    call c_f_pointer(address, letters, [c_text_length(address)])
    text = joined(letters)
  end function fortran_text

  pure function joined(letters) result(text)
    character(kind=c_char), intent(in) :: letters(:)
    character(len=size(letters)) :: text
    integer :: k
    do k = 1, size(letters)
      text(k:k) = letters(k)
    end do
  end function joined

  !> What went wrong in one line; empty when done.
  pure function restitute_message(error) result(text)
    type(restitute_error), intent(in) :: error
    character(len=:), allocatable :: text
    integer :: length
    length = findloc(error%message, c_null_char, dim=1) - 1
    if (length < 0) length = size(error%message)
    text = joined(error%message(:length))
  end function restitute_message

  function restitute_status_text(status) result(text)
    integer(c_int), intent(in) :: status
    character(len=:), allocatable :: text
    text = fortran_text(c_status_text(status))
  end function restitute_status_text

  function restitute_flag_text(flag) result(text)
    integer(c_int), intent(in) :: flag
    character(len=:), allocatable :: text
    text = fortran_text(c_flag_text(flag))
  end function restitute_flag_text

  function restitute_version() result(text)
    character(len=:), allocatable :: text
    text = fortran_text(c_version())
  end function restitute_version

  ! ----------------------------------------------------------------------------------------------------- materials

  !> A Prony series of as many terms as the two arrays have values.
  function restitute_material_prony(equilibrium_modulus, parallel_viscosity, relaxation_time, modulus, poisson_ratio, &
                                    material, error) result(status)
    real(c_double), intent(in) :: equilibrium_modulus, parallel_viscosity, relaxation_time(:), modulus(:), poisson_ratio
    type(restitute_material), intent(inout) :: material
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    character(len=80) :: message
    if (size(relaxation_time) == size(modulus)) then
      status = c_material_prony(equilibrium_modulus, parallel_viscosity, size(modulus, kind=c_size_t), &
                                relaxation_time, modulus, poisson_ratio, material, error)
      return
    end if
    status = RESTITUTE_ERROR_DOMAIN
    if (.not. present(error)) return
    write (message, "(2(a, i0))") "relaxation_time: must have as many values as modulus, ", size(modulus), &
      "; has ", size(relaxation_time)
    call set_error(error, status, trim(message))
  end function restitute_material_prony

  pure subroutine set_error(error, status, text)
    type(restitute_error), intent(out) :: error
    integer(c_int), intent(in) :: status
    character(len=*), intent(in) :: text
    integer :: k
    error%status = status
    do k = 1, min(len(text), size(error%message) - 1)
      error%message(k) = text(k:k)
    end do
  end subroutine set_error

  function restitute_material_pair(material1, material2, pair, error) result(status)
    type(restitute_material), intent(in) :: material1, material2
    type(restitute_material), intent(inout) :: pair
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_material_pair(material1%address, material2%address, pair, error)
  end function restitute_material_pair

  function restitute_material_dundurs(material) result(beta)
    type(restitute_material), intent(in) :: material
    real(c_double) :: beta
    beta = c_material_dundurs(material%address)
  end function restitute_material_dundurs

  !> Release a material; the variable is empty after it and may be released again.
  subroutine restitute_material_destroy(material)
    type(restitute_material), intent(inout) :: material
    call c_material_destroy(material%address)
    material%address = c_null_ptr
  end subroutine restitute_material_destroy

  function restitute_material_modulus(material, time) result(modulus)
    type(restitute_material), intent(in) :: material
    real(c_double), intent(in) :: time
    real(c_double) :: modulus
    modulus = c_material_modulus(material%address, time)
  end function restitute_material_modulus

  function restitute_material_poisson_ratio(material) result(nu)
    type(restitute_material), intent(in) :: material
    real(c_double) :: nu
    nu = c_material_poisson_ratio(material%address)
  end function restitute_material_poisson_ratio

  function restitute_material_terms(material) result(n)
    type(restitute_material), intent(in) :: material
    integer(c_size_t) :: n
    n = c_material_terms(material%address)
  end function restitute_material_terms

  ! ------------------------------------------------------------------------------------------- methods and solvers

  function restitute_method_euler() result(method)
    type(restitute_method) :: method
    method%address = c_method_euler()
  end function restitute_method_euler

  function restitute_method_sync() result(method)
    type(restitute_method) :: method
    method%address = c_method_sync()
  end function restitute_method_sync

  function name_of_method(method) result(name)
    type(restitute_method), intent(in) :: method
    character(len=:), allocatable :: name
    name = fortran_text(c_method_name(method%address))
  end function name_of_method

  function name_of_result_method(result) result(name)
    type(restitute_result), intent(in) :: result
    character(len=:), allocatable :: name
    name = fortran_text(result%method)
  end function name_of_result_method

  function restitute_solver_create(solver, options, error) result(status)
    type(restitute_solver), intent(inout) :: solver
    type(restitute_options), intent(in), optional :: options
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_solver_create(options, solver, error)
  end function restitute_solver_create

  !> Release a solver; the variable is empty after it and may be released again.
  subroutine restitute_solver_destroy(solver)
    type(restitute_solver), intent(inout) :: solver
    call c_solver_destroy(solver%address)
    solver%address = c_null_ptr
  end subroutine restitute_solver_destroy

  ! ----------------------------------------------------------------------------------------------------- solutions

  function restitute_solve(solver, impact, result, ledger, history, error) result(status)
    type(restitute_solver), intent(in) :: solver
    type(restitute_impact), intent(in) :: impact
    type(restitute_result), intent(inout), optional :: result
    type(restitute_ledger), intent(inout), optional :: ledger
    type(restitute_history), intent(inout), optional :: history
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_solve(solver%address, impact, result, ledger, history, error)
  end function restitute_solve

  function restitute_solve_scene(solver, scene, result, ledger, history, error) result(status)
    type(restitute_solver), intent(in) :: solver
    type(restitute_scene), intent(in) :: scene
    type(restitute_result), intent(inout), optional :: result
    type(restitute_ledger), intent(inout), optional :: ledger
    type(restitute_history), intent(inout), optional :: history
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_solve_scene(solver%address, scene, result, ledger, history, error)
  end function restitute_solve_scene

  !> As many impacts as the array has, by several threads; messages count them from 0, as C does.
  function restitute_solve_many(impacts, results, statuses, options, threads, error) result(status)
    type(restitute_impact), intent(in) :: impacts(:)
    type(restitute_result), intent(inout), optional :: results(:)
    integer(c_int), intent(inout), optional :: statuses(:)
    type(restitute_options), intent(in), optional :: options
    integer(c_int), intent(in), optional :: threads
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = check_lengths("impacts", size(impacts), results, statuses, error)
    if (status /= RESTITUTE_OK) return
    status = c_solve_many(options, size(impacts, kind=c_size_t), impacts, results, statuses, threads_of(threads), error)
  end function restitute_solve_many

  !> As many scenes as the array has; otherwise like restitute_solve_many.
  function restitute_solve_scenes(scenes, results, statuses, options, threads, error) result(status)
    type(restitute_scene), intent(in) :: scenes(:)
    type(restitute_result), intent(inout), optional :: results(:)
    integer(c_int), intent(inout), optional :: statuses(:)
    type(restitute_options), intent(in), optional :: options
    integer(c_int), intent(in), optional :: threads
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = check_lengths("scenes", size(scenes), results, statuses, error)
    if (status /= RESTITUTE_OK) return
    status = c_solve_scenes(options, size(scenes, kind=c_size_t), scenes, results, statuses, threads_of(threads), error)
  end function restitute_solve_scenes

  !> Absent: all.
  pure function threads_of(threads) result(number)
    integer(c_int), intent(in), optional :: threads
    integer(c_int) :: number
    number = 0
    if (present(threads)) number = threads
  end function threads_of

  !> Results and statuses must be as many as the cases.
  function check_lengths(cases, n, results, statuses, error) result(status)
    character(len=*), intent(in) :: cases
    integer, intent(in) :: n
    type(restitute_result), intent(in), optional :: results(:)
    integer(c_int), intent(in), optional :: statuses(:)
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = RESTITUTE_OK
    if (present(results)) call compare("results", size(results))
    if (present(statuses)) call compare("statuses", size(statuses))
  contains
    subroutine compare(name, length)
      character(len=*), intent(in) :: name
      integer, intent(in) :: length
      character(len=80) :: message
      if (length == n .or. status /= RESTITUTE_OK) return
      status = RESTITUTE_ERROR_DOMAIN
      if (.not. present(error)) return
      write (message, "(4a, i0, a, i0)") name, ": must have as many values as ", cases, ", ", n, "; has ", length
      call set_error(error, status, trim(message))
    end subroutine compare
  end function check_lengths

  !> A plan for a dimensionless impact of any psi.
  function restitute_plan_create(impact, plan, options, error) result(status)
    type(restitute_impact), intent(in) :: impact
    type(restitute_plan), intent(inout) :: plan
    type(restitute_options), intent(in), optional :: options
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_plan_create(options, impact, plan, error)
  end function restitute_plan_create

  !> A plan for a scene, sliding at any speed.
  function restitute_plan_create_scene(scene, plan, options, error) result(status)
    type(restitute_scene), intent(in) :: scene
    type(restitute_plan), intent(inout) :: plan
    type(restitute_options), intent(in), optional :: options
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_plan_create_scene(options, scene, plan, error)
  end function restitute_plan_create_scene

  !> Sliding: psi, or the speed of the contact point of a scene.
  function restitute_plan_solve(plan, sliding, result, ledger, history, error) result(status)
    type(restitute_plan), intent(in) :: plan
    real(c_double), intent(in) :: sliding
    type(restitute_result), intent(inout), optional :: result
    type(restitute_ledger), intent(inout), optional :: ledger
    type(restitute_history), intent(inout), optional :: history
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_plan_solve(plan%address, sliding, result, ledger, history, error)
  end function restitute_plan_solve

  !> Release a plan; the variable is empty after it and may be released again.
  subroutine restitute_plan_destroy(plan)
    type(restitute_plan), intent(inout) :: plan
    call c_plan_destroy(plan%address)
    plan%address = c_null_ptr
  end subroutine restitute_plan_destroy

  function restitute_collide(solver, contact, first, second, result, error) result(status)
    type(restitute_solver), intent(in) :: solver
    type(restitute_contact), intent(in) :: contact
    type(restitute_body), intent(inout) :: first, second
    type(restitute_result), intent(inout), optional :: result
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_collide(solver%address, contact, first, second, result, error)
  end function restitute_collide

  !> A history that goes into the arrays given; capacity is the length of the shortest. They must be targets that live
  !> as long as the history is used. An array with a stride is refused: the capacity is then 0, which no solver takes.
  subroutine restitute_history_arrays(history, time, indentation, contact_radius, stick_radius, normal_force, &
                                      tangential_force, normal_velocity, tangential_velocity)
    type(restitute_history), intent(out) :: history
    real(c_double), intent(in), optional, target, dimension(:) :: time, indentation, contact_radius, &
      stick_radius, normal_force, tangential_force, normal_velocity, tangential_velocity
    call restitute_history_init(history)
    history%capacity = huge(history%capacity)
    call give(time, history%time)
    call give(indentation, history%indentation)
    call give(contact_radius, history%contact_radius)
    call give(stick_radius, history%stick_radius)
    call give(normal_force, history%normal_force)
    call give(tangential_force, history%tangential_force)
    call give(normal_velocity, history%normal_velocity)
    call give(tangential_velocity, history%tangential_velocity)
    if (history%capacity == huge(history%capacity)) history%capacity = 0
  contains
    subroutine give(array, place)
      real(c_double), intent(in), optional, target :: array(:)
      type(c_ptr), intent(inout) :: place
      if (.not. present(array)) return
      place = c_null_ptr
      if (.not. is_contiguous(array)) then ! C could not fill it: the solver refuses a capacity of 0
        history%capacity = 0
        return
      end if
      if (size(array) > 0) place = c_loc(array(1))
      history%capacity = min(history%capacity, size(array, kind=c_size_t))
    end subroutine give
  end subroutine restitute_history_arrays
end module restitute
