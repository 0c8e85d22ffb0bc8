! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: every kind of call of the module. Exit status 0 if all is what it
!> should be.
program consumer
  use restitute
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  logical :: good
  good = no_slip_is_right()
  good = rubber_ball_rebounds() .and. good
  good = materials_are_right() .and. good
  good = batches_are_right() .and. good
  good = other_method_is_right() .and. good
  good = plans_are_right() .and. good
  if (.not. good) error stop 1

contains

  !> The default is an impact without friction; psi = 0: it never slips.
  function no_slip() result(impact)
    type(restitute_impact) :: impact
    impact = restitute_impact()
    impact%psi = 0
  end function no_slip

  !> An elastic no-slip impact of a solid incompressible sphere rebounds with ex = 0.10397 (no-slip
  !> limit of the literature); the default tolerance is 1e-3.
  function no_slip_is_right() result(good)
    logical :: good
    type(restitute_solver) :: solver
    type(restitute_result) :: result
    good = restitute_solver_create(solver=solver) == RESTITUTE_OK
    result = restitute_result()
    good = good .and. restitute_solve(solver, no_slip(), result) == RESTITUTE_OK
    good = good .and. restitute_method_name(result) == restitute_method_name(restitute_method_euler())
    good = good .and. abs(result%ez - 1) < 1e-3_rk .and. abs(result%ex - 0.10397_rk) < 1e-3_rk
    call restitute_solver_destroy(solver)
    print "(3a, 2f8.5)", "restitute ", restitute_version(), ", elastic without slip:", result%ez, result%ex
  end function no_slip_is_right

  !> The same limit by the precise method, to the five digits in which it is published; it takes no
  !> time step, and says so.
  function other_method_is_right() result(good)
    logical :: good
    type(restitute_solver) :: solver
    type(restitute_options) :: options
    type(restitute_result) :: result
    type(restitute_error) :: error
    options = restitute_options()
    options%method = restitute_method_sync()
    options%tolerance = 1e-7_rk
    options%time_step = 1e-2_rk
    good = restitute_solver_create(options, solver, error) == RESTITUTE_ERROR_DOMAIN
    good = good .and. index(restitute_message(error), "time_step = 0.01: must be 0 with the method sync") == 1
    options%time_step = 0
    good = good .and. restitute_solver_create(options, solver) == RESTITUTE_OK
    result = restitute_result()
    good = good .and. restitute_solve(solver, no_slip(), result) == RESTITUTE_OK
    good = good .and. restitute_method_name(result) == "sync" .and. result%error_ez <= 1e-7_rk
    good = good .and. abs(result%ex - 0.10397_rk) < 5.1e-6_rk .and. abs(result%ez - 1) < 1e-7_rk
    call restitute_solver_destroy(solver)
  end function other_method_is_right

  !> With every optional output, and a refused scene, whose message must name the value.
  function rubber_ball_rebounds() result(good)
    logical :: good
    type(restitute_material) :: rubber
    type(restitute_options) :: options
    type(restitute_solver) :: solver
    type(restitute_scene) :: scene
    type(restitute_result) :: result
    type(restitute_ledger) :: ledger
    type(restitute_history) :: history
    type(restitute_error) :: error
    real(rk), target :: time(20), force(20)
    good = restitute_material_standard_solid(1e6_rk, 2e6_rk, 50.0_rk, 0.5_rk, rubber) == RESTITUTE_OK
    options = restitute_options()
    options%tolerance = 1e-2_rk
    good = good .and. restitute_solver_create(options, solver, error) == RESTITUTE_OK
    result = restitute_result()
    ledger = restitute_ledger()
    call restitute_history_arrays(history, time=time, normal_force=force)
    scene = restitute_scene()
    scene%material = rubber
    scene%radius1 = 0.01_rk
    scene%mass1 = 4e-3_rk
    scene%friction = 0.3_rk
    scene%tangential_speed = 1
    scene%normal_speed = -2
    good = good .and. restitute_solve_scene(solver, scene, result, error=error) == RESTITUTE_ERROR_DOMAIN
    good = good .and. index(restitute_message(error), "normal_speed (m/s) = -2") > 0
    print "(2a)", "refused: ", restitute_message(error)
    scene%normal_speed = 2
    good = good .and. restitute_solve_scene(solver, scene, result, ledger, history, error) == RESTITUTE_OK
    ! it is soft for that speed: what the model is strained by is named
    good = good .and. index(restitute_message(error), "limit") > 0
    good = good .and. history%count == 20 .and. all(time(2:) > time(:19))
    good = good .and. maxval(force) > 0 .and. ledger%rebound_z > 0 .and. result%ez > 0 .and. result%ez < 1
    print "(a, 2f8.4, i4, a)", "rubber ball:", result%ez, result%ex, history%count, " samples"
    call restitute_solver_destroy(solver)
    call restitute_material_destroy(rubber)
  end function rubber_ball_rebounds

  !> Arrays with a stride, arrays of unlike length, and a pair, whose modulus at a time is that of
  !> the series.
  function materials_are_right() result(good)
    logical :: good
    real(rk), parameter :: table(2, 2) = reshape([1e-4_rk, 5e6_rk, 1e-2_rk, 1e6_rk], [2, 2])
    type(restitute_material) :: polymer, pair
    type(restitute_error) :: error
    real(rk) :: expected, at_rest
    real(rk), allocatable :: tau(:), modulus(:)
    good = restitute_material_prony(0.0_rk, 0.0_rk, table(1, :), table(2, :1), 0.5_rk, polymer, error) == &
      RESTITUTE_ERROR_DOMAIN
    good = good .and. index(restitute_message(error), "relaxation_time") > 0
    good = good .and. restitute_material_prony(1e6_rk, 0.0_rk, table(1, :), table(2, :), 0.5_rk, polymer) == 0
    good = good .and. restitute_material_terms(polymer) == 2
    good = good .and. restitute_material_series(polymer, at_rest, relaxation_time=tau, modulus=modulus) == RESTITUTE_OK
    ! What was given, to the bit: no difference.
    good = good .and. .not. any(abs([at_rest, tau, modulus] - [1e6_rk, table(1, :), table(2, :)]) > 0)
    expected = 1e6_rk + 5e6_rk*exp(-10.0_rk) + 1e6_rk*exp(-0.1_rk)
    ! Rounding of three terms and two exponentials.
    good = good .and. abs(restitute_material_modulus(polymer, 1e-3_rk)/expected - 1) < 1e-14_rk
    ! A solid in series with itself has half the modulus. The root finder of the series leaves a few
    ! digits of rounding.
    good = good .and. restitute_material_effective(polymer, polymer, pair) == RESTITUTE_OK
    good = good .and. abs(restitute_material_modulus(pair, 1e-3_rk)/expected - 0.5_rk) < 1e-10_rk
    good = good .and. abs(restitute_material_dundurs(pair)) < epsilon(1.0_rk)
    call restitute_material_destroy(pair)
    call restitute_material_destroy(polymer)
    call restitute_material_destroy(polymer) ! a second time does no harm
  end function materials_are_right

  !> Every second element of an array, the results of single calls, a refused case, and lengths that
  !> do not fit.
  function batches_are_right() result(good)
    logical :: good
    integer, parameter :: n = 6
    type(restitute_impact) :: impacts(2*n)
    type(restitute_options) :: options
    type(restitute_scene) :: scenes(n)
    type(restitute_material) :: rubber
    type(restitute_result) :: results(n), single
    type(restitute_solver) :: solver
    type(restitute_error) :: error
    integer :: k, statuses(n), status
    do k = 1, n
      impacts(2*k - 1:2*k) = restitute_impact()
      impacts(2*k)%psi = 0.5_rk*k
      results(k) = restitute_result()
    end do
    good = restitute_solve_many(impacts(2::2), results=results, error=error) == RESTITUTE_OK
    good = good .and. restitute_solver_create(solver=solver) == RESTITUTE_OK
    single = restitute_result()
    do k = 1, n
      status = restitute_solve(solver, impacts(2*k), single)
      ! The same bits: a difference of 0, not a small one.
      good = good .and. status == RESTITUTE_OK .and. .not. abs(single%ex - results(k)%ex) > 0
    end do
    call restitute_solver_destroy(solver)

    good = good .and. restitute_material_elastic(1e6_rk, 0.5_rk, rubber) == RESTITUTE_OK
    do k = 1, n
      scenes(k) = restitute_scene()
      scenes(k)%material = rubber
      scenes(k)%radius1 = 0.01_rk
      scenes(k)%mass1 = 4e-3_rk
      scenes(k)%normal_speed = k - 4
    end do
    options = restitute_options()
    options%threads = 2
    status = restitute_solve_scene_many(scenes, options, results, statuses, error)
    good = good .and. status == RESTITUTE_ERROR_DOMAIN .and. all(statuses(:4) == status) .and. all(statuses(5:) == 0)
    good = good .and. index(restitute_message(error), "scenes[0]: normal_speed (m/s) = -3") == 1
    status = restitute_solve_scene_many(scenes, options, results(2:), error=error)
    good = good .and. status == RESTITUTE_ERROR_DOMAIN
    good = good .and. restitute_message(error) == "results: must have as many values as scenes, 6; has 5"
    status = restitute_solve_many(impacts, statuses=statuses, error=error)
    good = good .and. status == RESTITUTE_ERROR_DOMAIN .and. index(restitute_message(error), "statuses: ") == 1
    call restitute_material_destroy(rubber)
  end function batches_are_right

  !> A plan gives the bits of single calls, of an impact and of a scene.
  function plans_are_right() result(good)
    logical :: good
    type(restitute_material) :: rubber
    type(restitute_options) :: options
    type(restitute_solver) :: solver
    type(restitute_plan) :: plan
    type(restitute_impact) :: impact
    type(restitute_scene) :: scene
    type(restitute_result) :: result, single
    type(restitute_error) :: error
    integer :: k
    options = restitute_options()
    options%method = restitute_method_sync()
    impact = restitute_impact()
    result = restitute_result()
    single = restitute_result()
    good = restitute_solver_create(options, solver) == RESTITUTE_OK
    good = good .and. restitute_plan_create(impact, options, plan) == RESTITUTE_OK
    do k = 0, 4
      impact%psi = 0.7_rk*k
      good = good .and. restitute_solve(solver, impact, single) == RESTITUTE_OK
      good = good .and. restitute_plan_solve(plan, impact%psi, result) == RESTITUTE_OK
      good = good .and. .not. abs(result%ex - single%ex) > 0
    end do
    good = good .and. restitute_plan_solve(plan, -1.0_rk, result, error=error) == RESTITUTE_ERROR_DOMAIN
    good = good .and. index(restitute_message(error), "psi = -1") == 1
    call restitute_plan_destroy(plan)

    good = good .and. restitute_material_kelvin_voigt(1e6_rk, 50.0_rk, 0.5_rk, rubber) == RESTITUTE_OK
    scene = restitute_scene()
    scene%material = rubber
    scene%radius1 = 0.01_rk
    scene%mass1 = 4e-3_rk
    scene%friction = 0.3_rk
    good = good .and. restitute_plan_create_scene(scene, options, plan) == RESTITUTE_ERROR_DOMAIN
    scene%normal_speed = 1
    good = good .and. restitute_plan_create_scene(scene, options, plan) == RESTITUTE_OK
    good = good .and. restitute_plan_solve(plan, 0.5_rk, result) == RESTITUTE_OK
    scene%tangential_speed = 0.5_rk
    good = good .and. restitute_solve_scene(solver, scene, single) == RESTITUTE_OK
    good = good .and. .not. abs(result%ex - single%ex) > 0
    call restitute_plan_destroy(plan)
    call restitute_plan_destroy(plan)
    call restitute_solver_destroy(solver)
    call restitute_material_destroy(rubber)
  end function plans_are_right
end program consumer
