! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: an impact with its events. Exit status 0 if all is what it should be.
program consumer_cvode
  use restitute
  use restitute_cvode_module
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_cvode_recorder) :: recorder
  type(restitute_cvode_event), allocatable :: events(:)
  type(restitute_cvode_work) :: work
  type(restitute_options) :: options
  type(restitute_solver) :: solver
  type(restitute_impact) :: impact
  type(restitute_result) :: result
  type(restitute_error) :: error
  logical :: good
  good = restitute_cvode_recorder_create(restitute_method_cvode_bdf(), recorder, error) == RESTITUTE_OK
  good = good .and. restitute_cvode_recorder_events(recorder, events, error) == RESTITUTE_ERROR_DOMAIN
  good = good .and. .not. allocated(events)
  call restitute_cvode_recorder_destroy(recorder)
  good = good .and. restitute_cvode_recorder_create(recorder=recorder, error=error) == RESTITUTE_OK
  options = restitute_options()
  options%method = restitute_cvode_recorder_method(recorder)
  impact = restitute_impact()
  impact%psi = 1.5_rk
  result = restitute_result()
  good = good .and. restitute_solver_create(options, solver, error) == RESTITUTE_OK
  good = good .and. restitute_solve(solver, impact, result, error=error) == RESTITUTE_OK
  good = good .and. restitute_cvode_recorder_events(recorder, events, error) == RESTITUTE_OK
  work = restitute_cvode_work()
  good = good .and. restitute_cvode_recorder_work(recorder, work, error) == RESTITUTE_OK
  good = good .and. work%steps > 0 .and. size(events) > 2 .and. all(events(2:)%time >= events(:size(events) - 1)%time)
  good = good .and. count(events%kind == RESTITUTE_CVODE_EVENT_TURN) == 1
  good = good .and. restitute_cvode_event_text(events(size(events))%kind) == "contact-end"
  print "(3a, i0, a)", "SUNDIALS ", restitute_cvode_sundials_version(), ", ", size(events), " events"
  call restitute_solver_destroy(solver)
  call restitute_cvode_recorder_destroy(recorder)
  deallocate (events) ! a program's own live on to its end, which looks like a leak
  if (.not. good) error stop 1
end program consumer_cvode
