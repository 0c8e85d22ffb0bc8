! SPDX-License-Identifier: BSD-3-Clause
!> The functions of restitute.h. Users get them from the module restitute.
module restitute_core_module
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_loc, c_null_ptr, c_ptr, c_size_t
  use restitute_texts_module, only: check_length, text_at
  use restitute_types_module
  implicit none (type, external)
  private
  public :: restitute_status_text, restitute_flag_text, restitute_version
  public :: restitute_material_prony, restitute_material_elastic, restitute_material_standard_solid
  public :: restitute_material_kelvin_voigt, restitute_material_maxwell, restitute_material_effective
  public :: restitute_material_dundurs, restitute_material_destroy, restitute_material_modulus
  public :: restitute_material_poisson_ratio, restitute_material_terms, restitute_material_series
  public :: restitute_material_set_window, restitute_material_window, restitute_material_shifted
  public :: restitute_scene_numbers, restitute_method_euler, restitute_method_sync, restitute_method_name
  public :: restitute_solver_create, restitute_solver_destroy, restitute_history_arrays
  public :: restitute_solve, restitute_solve_scene, restitute_solve_many, restitute_solve_scene_many
  public :: restitute_plan_create, restitute_plan_create_scene, restitute_plan_solve, restitute_plan_destroy
  public :: restitute_collide, restitute_pair, restitute_scene_pair, restitute_critical_psi

  !> Name of a method, or of the method that gave a result.
  interface restitute_method_name
    module procedure name_of_method, name_of_result_method
  end interface restitute_method_name

  ! Functions of C that Fortran calls as they are.
  interface
    integer(c_int) function restitute_material_elastic(shear_modulus, poisson_ratio, material, error) &
      bind(c, name="restitute_material_elastic")
      import
      real(c_double), value :: shear_modulus, poisson_ratio
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
    end function restitute_material_elastic

    integer(c_int) function restitute_material_standard_solid(modulus1, modulus2, viscosity, poisson_ratio, material, &
                                                              error) bind(c, name="restitute_material_standard_solid")
      import
      real(c_double), value :: modulus1, modulus2, viscosity, poisson_ratio
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
    end function restitute_material_standard_solid

    integer(c_int) function restitute_material_kelvin_voigt(modulus1, viscosity, poisson_ratio, material, error) &
      bind(c, name="restitute_material_kelvin_voigt")
      import
      real(c_double), value :: modulus1, viscosity, poisson_ratio
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
    end function restitute_material_kelvin_voigt

    integer(c_int) function restitute_material_maxwell(modulus, viscosity, poisson_ratio, material, error) &
      bind(c, name="restitute_material_maxwell")
      import
      real(c_double), value :: modulus, viscosity, poisson_ratio
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
    end function restitute_material_maxwell

    integer(c_int) function restitute_scene_numbers(scene, numbers, error) bind(c, name="restitute_scene_numbers")
      import
      type(restitute_scene), intent(in) :: scene
      type(restitute_numbers), intent(inout) :: numbers
      type(restitute_error), intent(inout), optional :: error
    end function restitute_scene_numbers

    integer(c_int) function restitute_solver_create(options, solver, error) bind(c, name="restitute_solver_create")
      import
      type(restitute_options), intent(in), optional :: options
      type(restitute_solver), intent(inout) :: solver
      type(restitute_error), intent(inout), optional :: error
    end function restitute_solver_create

    integer(c_int) function restitute_plan_create(impact, options, plan, error) bind(c, name="restitute_plan_create")
      import
      type(restitute_impact), intent(in) :: impact
      type(restitute_options), intent(in), optional :: options
      type(restitute_plan), intent(inout) :: plan
      type(restitute_error), intent(inout), optional :: error
    end function restitute_plan_create

    integer(c_int) function restitute_plan_create_scene(scene, options, plan, error) &
      bind(c, name="restitute_plan_create_scene")
      import
      type(restitute_scene), intent(in) :: scene
      type(restitute_options), intent(in), optional :: options
      type(restitute_plan), intent(inout) :: plan
      type(restitute_error), intent(inout), optional :: error
    end function restitute_plan_create_scene

    integer(c_int) function restitute_pair(chi, psi, delta1, gamma, ez, ex, error) bind(c, name="restitute_pair")
      import
      real(c_double), value :: chi, psi, delta1, gamma
      real(c_double), intent(inout), optional :: ez, ex
      type(restitute_error), intent(inout), optional :: error
    end function restitute_pair

    integer(c_int) function restitute_scene_pair(scene, ez, ex, error) bind(c, name="restitute_scene_pair")
      import
      type(restitute_scene), intent(in) :: scene
      real(c_double), intent(inout), optional :: ez, ex
      type(restitute_error), intent(inout), optional :: error
    end function restitute_scene_pair

    pure real(c_double) function restitute_critical_psi(chi, ez) bind(c, name="restitute_critical_psi")
      import
      real(c_double), value :: chi, ez
    end function restitute_critical_psi
  end interface

  ! Functions of C that take or give addresses; the procedures below call them.
  interface
    integer(c_int) function c_material_prony(equilibrium_modulus, parallel_viscosity, n_terms, relaxation_time, &
                                             modulus, poisson_ratio, material, error) &
      bind(c, name="restitute_material_prony")
      import
      real(c_double), value :: equilibrium_modulus, parallel_viscosity, poisson_ratio
      integer(c_size_t), value :: n_terms
      real(c_double), intent(in) :: relaxation_time(*), modulus(*)
      type(restitute_material), intent(inout) :: material
      type(restitute_error), intent(inout), optional :: error
    end function c_material_prony

    integer(c_int) function c_material_effective(material1, material2, effective, error) &
      bind(c, name="restitute_material_effective")
      import
      type(c_ptr), value :: material1, material2
      type(restitute_material), intent(inout) :: effective
      type(restitute_error), intent(inout), optional :: error
    end function c_material_effective

    real(c_double) function c_material_dundurs(material) bind(c, name="restitute_material_dundurs")
      import
      type(c_ptr), value :: material
    end function c_material_dundurs

    subroutine c_material_destroy(material) bind(c, name="restitute_material_destroy")
      import
      type(c_ptr), value :: material
    end subroutine c_material_destroy

    real(c_double) function c_material_modulus(material, time) bind(c, name="restitute_material_modulus")
      import
      type(c_ptr), value :: material
      real(c_double), value :: time
    end function c_material_modulus

    real(c_double) function c_material_poisson_ratio(material) bind(c, name="restitute_material_poisson_ratio")
      import
      type(c_ptr), value :: material
    end function c_material_poisson_ratio

    integer(c_size_t) function c_material_terms(material) bind(c, name="restitute_material_terms")
      import
      type(c_ptr), value :: material
    end function c_material_terms

    integer(c_int) function c_material_series(material, equilibrium_modulus, parallel_viscosity, relaxation_time, &
                                              modulus, error) bind(c, name="restitute_material_series")
      import
      type(c_ptr), value :: material
      real(c_double), intent(inout), optional :: equilibrium_modulus, parallel_viscosity, relaxation_time(*), modulus(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_material_series

    integer(c_int) function c_material_set_window(material, shortest, longest, error) &
      bind(c, name="restitute_material_set_window")
      import
      type(c_ptr), value :: material
      real(c_double), value :: shortest, longest
      type(restitute_error), intent(inout), optional :: error
    end function c_material_set_window

    integer(c_int) function c_material_window(material, shortest, longest, error) &
      bind(c, name="restitute_material_window")
      import
      type(c_ptr), value :: material
      real(c_double), intent(inout), optional :: shortest, longest
      type(restitute_error), intent(inout), optional :: error
    end function c_material_window

    integer(c_int) function c_material_shifted(material, time_shift, shifted, error) &
      bind(c, name="restitute_material_shifted")
      import
      type(c_ptr), value :: material
      real(c_double), value :: time_shift
      type(restitute_material), intent(inout) :: shifted
      type(restitute_error), intent(inout), optional :: error
    end function c_material_shifted

    type(c_ptr) function c_method_euler() bind(c, name="restitute_method_euler")
      import
    end function c_method_euler

    type(c_ptr) function c_method_sync() bind(c, name="restitute_method_sync")
      import
    end function c_method_sync

    type(c_ptr) function c_method_name(method) bind(c, name="restitute_method_name")
      import
      type(c_ptr), value :: method
    end function c_method_name

    subroutine c_solver_destroy(solver) bind(c, name="restitute_solver_destroy")
      import
      type(c_ptr), value :: solver
    end subroutine c_solver_destroy

    integer(c_int) function c_solve(solver, impact, result, ledger, history, error) bind(c, name="restitute_solve")
      import
      type(c_ptr), value :: solver
      type(restitute_impact), intent(in) :: impact
      type(restitute_result), intent(inout), optional :: result
      type(restitute_ledger), intent(inout), optional :: ledger
      type(restitute_history), intent(inout), optional :: history
      type(restitute_error), intent(inout), optional :: error
    end function c_solve

    integer(c_int) function c_solve_scene(solver, scene, result, ledger, history, error) &
      bind(c, name="restitute_solve_scene")
      import
      type(c_ptr), value :: solver
      type(restitute_scene), intent(in) :: scene
      type(restitute_result), intent(inout), optional :: result
      type(restitute_ledger), intent(inout), optional :: ledger
      type(restitute_history), intent(inout), optional :: history
      type(restitute_error), intent(inout), optional :: error
    end function c_solve_scene

    integer(c_int) function c_solve_many(n, impacts, options, results, statuses, error) &
      bind(c, name="restitute_solve_many")
      import
      integer(c_size_t), value :: n
      type(restitute_impact), intent(in) :: impacts(*)
      type(restitute_options), intent(in), optional :: options
      type(restitute_result), intent(inout), optional :: results(*)
      integer(c_int), intent(inout), optional :: statuses(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_solve_many

    integer(c_int) function c_solve_scene_many(n, scenes, options, results, statuses, error) &
      bind(c, name="restitute_solve_scene_many")
      import
      integer(c_size_t), value :: n
      type(restitute_scene), intent(in) :: scenes(*)
      type(restitute_options), intent(in), optional :: options
      type(restitute_result), intent(inout), optional :: results(*)
      integer(c_int), intent(inout), optional :: statuses(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_solve_scene_many

    integer(c_int) function c_plan_solve(plan, sliding, result, ledger, history, error) &
      bind(c, name="restitute_plan_solve")
      import
      type(c_ptr), value :: plan
      real(c_double), value :: sliding
      type(restitute_result), intent(inout), optional :: result
      type(restitute_ledger), intent(inout), optional :: ledger
      type(restitute_history), intent(inout), optional :: history
      type(restitute_error), intent(inout), optional :: error
    end function c_plan_solve

    subroutine c_plan_destroy(plan) bind(c, name="restitute_plan_destroy")
      import
      type(c_ptr), value :: plan
    end subroutine c_plan_destroy

    integer(c_int) function c_collide(solver, collision, first, second, result, error) bind(c, name="restitute_collide")
      import
      type(c_ptr), value :: solver
      type(restitute_collision), intent(in) :: collision
      type(restitute_body), intent(inout) :: first, second
      type(restitute_result), intent(inout), optional :: result
      type(restitute_error), intent(inout), optional :: error
    end function c_collide

    type(c_ptr) function c_status_text(status) bind(c, name="restitute_status_text")
      import
      integer(c_int), value :: status
    end function c_status_text

    type(c_ptr) function c_flag_text(flag) bind(c, name="restitute_flag_text")
      import
      integer(c_int), value :: flag
    end function c_flag_text

    type(c_ptr) function c_version() bind(c, name="restitute_version")
      import
    end function c_version
  end interface

contains

  function restitute_status_text(status) result(text)
    integer(c_int), intent(in) :: status
    character(len=:), allocatable :: text
    text = text_at(c_status_text(status))
  end function restitute_status_text

  function restitute_flag_text(flag) result(text)
    integer(c_int), intent(in) :: flag
    character(len=:), allocatable :: text
    text = text_at(c_flag_text(flag))
  end function restitute_flag_text

  function restitute_version() result(text)
    character(len=:), allocatable :: text
    text = text_at(c_version())
  end function restitute_version

  ! ---- materials

  integer(c_int) function restitute_material_prony(equilibrium_modulus, parallel_viscosity, relaxation_time, modulus, &
                                                   poisson_ratio, material, error) result(status)
    real(c_double), intent(in) :: equilibrium_modulus, parallel_viscosity, relaxation_time(:), modulus(:), poisson_ratio
    type(restitute_material), intent(inout) :: material
    type(restitute_error), intent(inout), optional :: error
    integer(c_size_t) :: n
    n = size(modulus, kind=c_size_t)
    status = RESTITUTE_OK
    call check_length("relaxation_time", relaxation_time, "modulus", n, status, error)
    if (status == RESTITUTE_OK) status = c_material_prony(equilibrium_modulus, parallel_viscosity, n, relaxation_time, &
                                                          modulus, poisson_ratio, material, error)
  end function restitute_material_prony

  integer(c_int) function restitute_material_effective(material1, material2, effective, error) result(status)
    type(restitute_material), intent(in) :: material1, material2
    type(restitute_material), intent(inout) :: effective
    type(restitute_error), intent(inout), optional :: error
    status = c_material_effective(material1%address, material2%address, effective, error)
  end function restitute_material_effective

  real(c_double) function restitute_material_dundurs(material) result(beta)
    type(restitute_material), intent(in) :: material
    beta = c_material_dundurs(material%address)
  end function restitute_material_dundurs

  subroutine restitute_material_destroy(material)
    type(restitute_material), intent(inout) :: material
    call c_material_destroy(material%address)
    material%address = c_null_ptr
  end subroutine restitute_material_destroy

  real(c_double) function restitute_material_modulus(material, time) result(modulus)
    type(restitute_material), intent(in) :: material
    real(c_double), intent(in) :: time
    modulus = c_material_modulus(material%address, time)
  end function restitute_material_modulus

  real(c_double) function restitute_material_poisson_ratio(material) result(nu)
    type(restitute_material), intent(in) :: material
    nu = c_material_poisson_ratio(material%address)
  end function restitute_material_poisson_ratio

  integer(c_size_t) function restitute_material_terms(material) result(n)
    type(restitute_material), intent(in) :: material
    n = c_material_terms(material%address)
  end function restitute_material_terms

  !> The arrays are made as long as the series.
  integer(c_int) function restitute_material_series(material, equilibrium_modulus, parallel_viscosity, &
                                                    relaxation_time, modulus, error) result(status)
    type(restitute_material), intent(in) :: material
    real(c_double), intent(inout), optional :: equilibrium_modulus, parallel_viscosity
    real(c_double), allocatable, intent(inout), optional :: relaxation_time(:), modulus(:)
    type(restitute_error), intent(inout), optional :: error
    real(c_double), allocatable :: tau(:), g(:)
    integer(c_size_t) :: n
    integer :: failed
    n = restitute_material_terms(material)
    status = RESTITUTE_ERROR_MEMORY
    allocate (tau(n), g(n), stat=failed)
    if (failed /= 0) return
    status = c_material_series(material%address, equilibrium_modulus, parallel_viscosity, tau, g, error)
    if (status < 0) return
    if (present(relaxation_time)) call move_alloc(tau, relaxation_time)
    if (present(modulus)) call move_alloc(g, modulus)
  end function restitute_material_series

  integer(c_int) function restitute_material_set_window(material, shortest, longest, error) result(status)
    type(restitute_material), intent(in) :: material
    real(c_double), intent(in) :: shortest, longest
    type(restitute_error), intent(inout), optional :: error
    status = c_material_set_window(material%address, shortest, longest, error)
  end function restitute_material_set_window

  integer(c_int) function restitute_material_window(material, shortest, longest, error) result(status)
    type(restitute_material), intent(in) :: material
    real(c_double), intent(inout), optional :: shortest, longest
    type(restitute_error), intent(inout), optional :: error
    status = c_material_window(material%address, shortest, longest, error)
  end function restitute_material_window

  integer(c_int) function restitute_material_shifted(material, time_shift, shifted, error) result(status)
    type(restitute_material), intent(in) :: material
    real(c_double), intent(in) :: time_shift
    type(restitute_material), intent(inout) :: shifted
    type(restitute_error), intent(inout), optional :: error
    status = c_material_shifted(material%address, time_shift, shifted, error)
  end function restitute_material_shifted

  ! ---- methods and solvers

  type(restitute_method) function restitute_method_euler() result(method)
    method%address = c_method_euler()
  end function restitute_method_euler

  type(restitute_method) function restitute_method_sync() result(method)
    method%address = c_method_sync()
  end function restitute_method_sync

  function name_of_method(method) result(name)
    type(restitute_method), intent(in) :: method
    character(len=:), allocatable :: name
    name = text_at(c_method_name(method%address))
  end function name_of_method

  function name_of_result_method(result) result(name)
    type(restitute_result), intent(in) :: result
    character(len=:), allocatable :: name
    name = text_at(result%method)
  end function name_of_result_method

  subroutine restitute_solver_destroy(solver)
    type(restitute_solver), intent(inout) :: solver
    call c_solver_destroy(solver%address)
    solver%address = c_null_ptr
  end subroutine restitute_solver_destroy

  ! ---- solutions

  integer(c_int) function restitute_solve(solver, impact, result, ledger, history, error) result(status)
    type(restitute_solver), intent(in) :: solver
    type(restitute_impact), intent(in) :: impact
    type(restitute_result), intent(inout), optional :: result
    type(restitute_ledger), intent(inout), optional :: ledger
    type(restitute_history), intent(inout), optional :: history
    type(restitute_error), intent(inout), optional :: error
    status = c_solve(solver%address, impact, result, ledger, history, error)
  end function restitute_solve

  integer(c_int) function restitute_solve_scene(solver, scene, result, ledger, history, error) result(status)
    type(restitute_solver), intent(in) :: solver
    type(restitute_scene), intent(in) :: scene
    type(restitute_result), intent(inout), optional :: result
    type(restitute_ledger), intent(inout), optional :: ledger
    type(restitute_history), intent(inout), optional :: history
    type(restitute_error), intent(inout), optional :: error
    status = c_solve_scene(solver%address, scene, result, ledger, history, error)
  end function restitute_solve_scene

  !> As many impacts as the array has; messages count them from 0, as C does.
  integer(c_int) function restitute_solve_many(impacts, options, results, statuses, error) result(status)
    type(restitute_impact), intent(in) :: impacts(:)
    type(restitute_options), intent(in), optional :: options
    type(restitute_result), intent(inout), optional :: results(:)
    integer(c_int), intent(inout), optional :: statuses(:)
    type(restitute_error), intent(inout), optional :: error
    integer(c_size_t) :: n
    n = size(impacts, kind=c_size_t)
    status = RESTITUTE_OK
    call check_length("results", results, "impacts", n, status, error)
    call check_length("statuses", statuses, "impacts", n, status, error)
    if (status == RESTITUTE_OK) status = c_solve_many(n, impacts, options, results, statuses, error)
  end function restitute_solve_many

  !> As many scenes as the array has; messages count them from 0, as C does.
  integer(c_int) function restitute_solve_scene_many(scenes, options, results, statuses, error) result(status)
    type(restitute_scene), intent(in) :: scenes(:)
    type(restitute_options), intent(in), optional :: options
    type(restitute_result), intent(inout), optional :: results(:)
    integer(c_int), intent(inout), optional :: statuses(:)
    type(restitute_error), intent(inout), optional :: error
    integer(c_size_t) :: n
    n = size(scenes, kind=c_size_t)
    status = RESTITUTE_OK
    call check_length("results", results, "scenes", n, status, error)
    call check_length("statuses", statuses, "scenes", n, status, error)
    if (status == RESTITUTE_OK) status = c_solve_scene_many(n, scenes, options, results, statuses, error)
  end function restitute_solve_scene_many

  !> Sliding: psi, or the speed of the contact point of a scene.
  integer(c_int) function restitute_plan_solve(plan, sliding, result, ledger, history, error) result(status)
    type(restitute_plan), intent(in) :: plan
    real(c_double), intent(in) :: sliding
    type(restitute_result), intent(inout), optional :: result
    type(restitute_ledger), intent(inout), optional :: ledger
    type(restitute_history), intent(inout), optional :: history
    type(restitute_error), intent(inout), optional :: error
    status = c_plan_solve(plan%address, sliding, result, ledger, history, error)
  end function restitute_plan_solve

  subroutine restitute_plan_destroy(plan)
    type(restitute_plan), intent(inout) :: plan
    call c_plan_destroy(plan%address)
    plan%address = c_null_ptr
  end subroutine restitute_plan_destroy

  integer(c_int) function restitute_collide(solver, collision, first, second, result, error) result(status)
    type(restitute_solver), intent(in) :: solver
    type(restitute_collision), intent(in) :: collision
    type(restitute_body), intent(inout) :: first, second
    type(restitute_result), intent(inout), optional :: result
    type(restitute_error), intent(inout), optional :: error
    status = c_collide(solver%address, collision, first, second, result, error)
  end function restitute_collide

  !> A history that goes into the arrays given, which are targets that live as long as it is used;
  !> its capacity is the length of the shortest.
  subroutine restitute_history_arrays(history, time, indentation, contact_radius, stick_radius, normal_force, &
                                      tangential_force, normal_velocity, tangential_velocity)
    type(restitute_history), intent(out) :: history
    real(c_double), pointer, contiguous, intent(in), optional, dimension(:) :: time, indentation, contact_radius, &
      stick_radius, normal_force, tangential_force, normal_velocity, tangential_velocity
    history = restitute_history()
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
      real(c_double), pointer, contiguous, intent(in), optional :: array(:)
      type(c_ptr), intent(inout) :: place
      if (.not. present(array)) return
      if (size(array) > 0) place = c_loc(array(1))
      history%capacity = min(history%capacity, size(array, kind=c_size_t))
    end subroutine give
  end subroutine restitute_history_arrays
end module restitute_core_module
