! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: a modulus from the contact times of an elastic ball, in one call and in
!> pieces, and a series of one term from its moduli. Exit status 0 if all is what it should be.
program consumer_fit
  use, intrinsic :: iso_c_binding, only: c_associated, c_funloc, c_int, c_ptr
  use restitute
  use restitute_fit_module
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_fit_point) :: points(4)
  type(restitute_fit_options) :: options
  type(restitute_fit_result) :: result, again
  type(restitute_dma_result) :: series
  type(restitute_fitter) :: fitter
  type(restitute_scene), target :: drops(4)
  type(restitute_error) :: error
  real(rk) :: done, x(9), times(4)
  integer :: i, status
  logical :: good
  do i = 1, size(points) ! contact times fall with speed^(-1/5)
    drops(i) = restitute_scene()
    drops(i)%radius1 = 0.005_rk
    drops(i)%mass1 = 0.004_rk
    drops(i)%normal_speed = 0.1_rk*i
    points(i) = restitute_fit_point(drops(i))
    points(i)%contact_time = 3e-3_rk*real(i, rk)**(-0.2_rk)
  end do
  options = restitute_fit_options()
  options%model = RESTITUTE_FIT_MODEL_ELASTIC
  result = restitute_fit_result()
  again = restitute_fit_result()
  series = restitute_dma_result()
  good = restitute_fit(points, options, result, error) == RESTITUTE_OK
  good = good .and. restitute_text(result%name(:, 1)) == "modulus_pa" .and. result%high(1) < 1.01_rk*result%low(1)
  good = good .and. restitute_fitter_create(points, options, fitter, error) == RESTITUTE_OK
  done = 0
  do while (good .and. done < 1)
    good = restitute_fitter_run(fitter, done, error) == RESTITUTE_OK
  end do
  good = good .and. restitute_fitter_result(fitter, again, error) == RESTITUTE_OK
  good = good .and. again%value(1) <= result%value(1) .and. again%value(1) >= result%value(1)
  good = good .and. restitute_fitter_values(fitter, contact_time=times(2:), error=error) == RESTITUTE_ERROR_DOMAIN
  good = good .and. restitute_message(error) == "contact_time: must have as many values as there are points, 4; has 3"
  ! The times follow the law of an elastic solid; the forward model is within 1e-5 of it (fit.h).
  good = good .and. restitute_fitter_values(fitter, contact_time=times, error=error) == RESTITUTE_OK
  good = good .and. all(abs(times/points%contact_time - 1) < 2e-5_rk)
  call restitute_fitter_destroy(fitter)
  options%interrupted = c_funloc(stop_now)
  good = good .and. restitute_fit(points, options, again, error) == RESTITUTE_ERROR_INTERRUPTED
  points(2)%ez = 1.5_rk
  good = good .and. restitute_fit(points, options, again, error) == RESTITUTE_ERROR_DOMAIN
  good = good .and. index(restitute_message(error), "points[1].ez = 1.5") == 1
  x = [(10.0_rk**(0.5_rk*(i - 5)), i=1, 9)]
  status = restitute_dma_fit(x/6.283185307179586_rk, x**2/(1 + x**2), x/(1 + x**2), result=series)
  good = good .and. status == RESTITUTE_OK
  good = good .and. series%terms == 1 .and. abs(series%relaxation_time(1) - 1) < 1e-3_rk
  print "(2a, es12.4, a, es12.4)", restitute_text(result%name(:, 1)), " =", result%value(1), ", tau =", &
    series%relaxation_time(1)
  call restitute_material_destroy(result%material)
  call restitute_material_destroy(again%material)
  call restitute_material_destroy(series%material)
  if (.not. good) error stop 1

contains

  !> Stops at once; nothing was given to it.
  integer(c_int) function stop_now(data) bind(c)
    type(c_ptr), value :: data
    stop_now = merge(0_c_int, 1_c_int, c_associated(data))
  end function stop_now
end program consumer_fit
