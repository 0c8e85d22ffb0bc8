! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: an impact by boundary elements, and its middle. Exit status 0 if all is
!> what it should be.
program consumer_bem
  use restitute
  use restitute_bem_module
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_bem_recorder) :: recorder
  type(restitute_bem_snapshot) :: snapshot
  type(restitute_options) :: options
  type(restitute_solver) :: solver
  type(restitute_impact) :: impact
  type(restitute_result) :: result
  type(restitute_history) :: history
  type(restitute_error) :: error
  real(rk), target :: force(11)
  real(rk), pointer :: pressure(:, :), stick(:, :)
  integer :: middle
  logical :: good
  good = restitute_bem_recorder_create(1_restitute_size, recorder, error) == RESTITUTE_OK
  options = restitute_options()
  options%method = restitute_bem_recorder_method(recorder)
  options%elements = 8
  good = good .and. restitute_solver_create(options, solver, error) == RESTITUTE_OK
  impact = restitute_impact()
  impact%psi = 1
  result = restitute_result()
  call restitute_history_arrays(history, normal_force=force)
  good = good .and. restitute_solve(solver, impact, result, history=history, error=error) >= RESTITUTE_OK
  good = good .and. restitute_bem_recorder_count(recorder) == 1 .and. restitute_method_name(result) == "bem"
  snapshot = restitute_bem_snapshot()
  good = good .and. restitute_bem_recorder_get(recorder, 0_restitute_size, snapshot, error) == RESTITUTE_OK
  call restitute_bem_fields(snapshot, pressure, stick=stick)
  middle = int(snapshot%cells)/2
  good = good .and. size(pressure, 1) == snapshot%cells .and. maxval(pressure) > 0
  ! The largest pressure is in the middle, within a cell; nothing sticks outside of the contact.
  good = good .and. all(abs(maxloc(pressure) - middle - 1) <= 1) .and. .not. any(stick > 0 .and. .not. pressure > 0)
  print "(a, i0, a)", "bem: ", snapshot%cells, " cells along a side"
  call restitute_solver_destroy(solver)
  call restitute_bem_recorder_destroy(recorder)
  if (.not. good) error stop 1
end program consumer_bem
