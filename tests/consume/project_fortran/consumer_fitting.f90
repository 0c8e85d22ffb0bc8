! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: a modulus from the contact times of an elastic ball, in one call and in
!> pieces, and a series of one term from its moduli. Exit status 0 if all is what it should be.
program consumer_fitting
  use, intrinsic :: iso_c_binding, only: c_ptr, c_sizeof
  use restitute
  use restitute_fitting
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_fit_point) :: points(4)
  type(restitute_fit_options) :: options
  type(restitute_fit_result) :: result, again
  type(restitute_dma_options) :: dma
  type(restitute_dma_result) :: series
  type(c_ptr) :: fitter
  type(restitute_error) :: error
  real(rk) :: done, x(9)
  integer :: i
  logical :: good
  do i = 1, size(points) ! contact times fall with speed^(-1/5)
    call restitute_fit_point_init(points(i))
    points(i)%scene%radius1 = 0.005_rk
    points(i)%scene%mass1 = 0.004_rk
    points(i)%scene%normal_speed = 0.1_rk * i
    points(i)%contact_time = 3e-3_rk * real(i, rk)**(-0.2_rk)
  end do
  call restitute_fit_options_init(options)
  options%model = RESTITUTE_FIT_ELASTIC
  call restitute_fit_result_init(result)
  call restitute_fit_result_init(again)
  call restitute_dma_result_init(series)
  call restitute_dma_options_init(dma)
  good = same_size(c_sizeof(points(1)), points(1)%struct_size) .and. same_size(c_sizeof(options), options%struct_size) &
    .and. same_size(c_sizeof(result), result%struct_size) .and. same_size(c_sizeof(series), series%struct_size) &
    .and. same_size(c_sizeof(dma), dma%struct_size)
  good = good .and. restitute_fit(points, result, options, error) == RESTITUTE_OK
  good = good .and. restitute_fit_name(result, 1) == "modulus_pa" .and. result%high(1) < 1.01_rk * result%low(1)
  good = good .and. restitute_fitter_create(points, fitter, options, error) == RESTITUTE_OK
  done = 0
  do while (good .and. done < 1)
    good = restitute_fitter_run(fitter, done, error) == RESTITUTE_OK
  end do
  good = good .and. restitute_fitter_result(fitter, again, error) == RESTITUTE_OK
  good = good .and. again%value(1) <= result%value(1) .and. again%value(1) >= result%value(1)
  call restitute_fitter_destroy(fitter)
  points(2)%ez = 1.5_rk
  good = good .and. restitute_fit(points, again, options, error) == RESTITUTE_ERROR_DOMAIN
  good = good .and. index(restitute_message(error), "points[1].ez = 1.5") == 1
  x = [(10.0_rk**(0.5_rk * (i - 5)), i = 1, 9)]
  good = good .and. restitute_dma_fit(x / 6.283185307179586_rk, x**2 / (1 + x**2), x / (1 + x**2), series) == RESTITUTE_OK
  good = good .and. series%terms == 1 .and. abs(series%relaxation_time(1) - 1) < 1e-3_rk
  print "(2a, es12.4, a, es12.4)", restitute_fit_name(result, 1), " =", result%value(1), ", tau =", series%relaxation_time(1)
  call restitute_material_destroy(result%material)
  call restitute_material_destroy(again%material)
  call restitute_material_destroy(series%material)
  if (.not. good) error stop 1
contains
  !> The struct of C is as large: its init function wrote its size.
  pure function same_size(here, in_c) result(same)
    integer(restitute_size), intent(in) :: here, in_c
    logical :: same
    same = here == in_c
  end function same_size
end program consumer_fitting
