! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: contacts of a law in one step, by themselves and together. Exit status
!> 0 if all is what it should be.
program consumer_contact
  use restitute
  use restitute_contact_module
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_material) :: rubber
  type(restitute_contact_law_options) :: options
  type(restitute_contact_law) :: law
  type(restitute_contact_rates) :: rates
  type(restitute_contact_motion) :: motions(2)
  type(restitute_contact_force) :: force, forces(2)
  type(restitute_contact_details) :: details
  type(restitute_error) :: error
  real(rk), allocatable :: tau(:), modulus(:), state(:), states(:, :)
  real(rk) :: limit, scale, bound
  integer :: status, statuses(2), k
  logical :: good

  good = restitute_material_standard_solid(1e6_rk, 2e6_rk, 50.0_rk, 0.5_rk, rubber) == RESTITUTE_OK
  options = restitute_contact_law_options()
  options%details = 1
  good = good .and. restitute_contact_law_create(rubber, options, law, error) == RESTITUTE_OK
  call restitute_material_destroy(rubber)
  status = restitute_contact_law_series(law, relaxation_time=tau, modulus=modulus, error_bound=bound)
  good = good .and. status == RESTITUTE_OK
  ! eta/G2 within rounding, and nothing was left out.
  good = good .and. size(tau) == 1 .and. abs(tau(1) - 25e-6_rk) < 1e-18_rk .and. abs(modulus(1) - 2e6_rk) < 1e-6_rk
  good = good .and. .not. bound > 0 .and. restitute_contact_law_hash(law) /= 0
  good = good .and. restitute_contact_time_step_limit(law, 4e-3_rk, 0.01_rk, 1.0_rk, limit, error) == RESTITUTE_OK
  good = good .and. restitute_contact_time_scale(law, 4e-3_rk, 0.01_rk, 1.0_rk, scale, error) == RESTITUTE_OK
  good = good .and. abs(50*limit/scale - 2.9433_rk) < 1e-3_rk ! an impact in units of its time scale
  rates = restitute_contact_rates()
  good = good .and. restitute_contact_rates_set(law, limit, rates, error) == RESTITUTE_OK
  good = good .and. rates%step >= limit

  motions = restitute_contact_motion()
  motions%overlap = limit
  do k = 1, 2
    motions(k)%normal = [0, 0, 1]
    motions(k)%velocity = [0.0_rk, 0.1_rk*k, 1.0_rk]
  end do
  motions%radius = 0.01_rk
  motions%friction = 0.3_rk
  allocate (states(restitute_contact_law_state_size(law), 2), source=0.0_rk)
  good = good .and. restitute_contact_step_many(law, rates, motions, states, forces, statuses, error) == RESTITUTE_OK
  state = 0*states(:, 2)
  good = good .and. restitute_contact_step(law, rates, motions(2), state, force, error) == RESTITUTE_OK
  ! The same bits, by itself and together.
  good = good .and. .not. any(abs(state - states(:, 2)) > 0) .and. .not. abs(force%normal - forces(2)%normal) > 0
  good = good .and. force%normal > 0 .and. all(statuses == 0) .and. forces(2)%tangential(2) < forces(1)%tangential(2)
  good = good .and. restitute_contact_peek(law, motions(2)%normal, state, force, error) == RESTITUTE_OK
  details = restitute_contact_details()
  good = good .and. restitute_contact_details_get(law, 0.01_rk, state, details, error) == RESTITUTE_OK
  good = good .and. details%stored > 0 .and. details%contact_radius > 0
  good = good .and. restitute_contact_turn(law, [0.0_rk, 0.0_rk, 1.0_rk], [1.0_rk, 0.0_rk, 0.0_rk], state, error) == 0

  good = good .and. restitute_contact_step(law, rates, motions(1), state(2:), force, error) == RESTITUTE_ERROR_DOMAIN
  good = good .and. index(restitute_message(error), "state: must have as many values as") == 1
  status = restitute_contact_step_many(law, rates, motions, states(:, :1), forces, error=error)
  good = good .and. status == RESTITUTE_ERROR_DOMAIN
  print "(a, i0, a, es10.3, a)", "state of ", size(state), ", force ", force%normal, " N"
  call restitute_contact_law_destroy(law)
  deallocate (tau, modulus, state, states) ! a program's own live on to its end, which looks like a leak
  if (.not. good) error stop 1
end program consumer_contact
