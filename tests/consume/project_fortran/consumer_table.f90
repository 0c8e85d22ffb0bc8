! SPDX-License-Identifier: BSD-3-Clause
!> A Fortran user's program: a table, its look-ups, its numbers and a table made of them. Exit
!> status 0 if all is what it should be.
program consumer_table
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_ptr
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use restitute
  use restitute_table_module
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_material) :: rubber
  type(restitute_scene) :: scene
  type(restitute_table_options) :: options
  type(restitute_table) :: table, copy, tables(3)
  type(restitute_table_contact) :: small
  type(restitute_table_info) :: info
  type(restitute_table_data) :: data
  type(restitute_body) :: ball, floor
  type(restitute_error) :: error
  real(rk), pointer, contiguous :: tau(:), modulus(:), speed(:), on_speed(:, :), strain(:, :), on_psi(:, :, :)
  real(rk) :: ez, ex, other(2), many(2, 3)
  real(rk), parameter :: speeds(3) = [0.1_rk, 0.5_rk, 2.0_rk], slides(3) = [0.0_rk, 0.2_rk, -3.0_rk]
  integer :: status, k, flags
  integer, target :: finished(2)
  logical :: good

  good = restitute_material_standard_solid(1e6_rk, 2e6_rk, 50.0_rk, 0.5_rk, rubber) == RESTITUTE_OK
  scene = restitute_scene()
  scene%material = rubber
  scene%radius1 = 0.01_rk
  scene%mass1 = 4e-3_rk
  scene%friction = 0.3_rk
  options = restitute_table_options()
  options%tolerance = 1e-3_rk
  options%speed = [1e-2_rk, 10.0_rk]
  good = good .and. restitute_table_build(scene, options, table, error) == RESTITUTE_OK
  info = restitute_table_info()
  good = good .and. restitute_table_describe(table, info, error) == RESTITUTE_OK
  good = good .and. info%error_ex <= 1e-3_rk .and. restitute_text(info%version) == restitute_version()

  ! Many places, one place, and the same for a contact that is the table's own.
  small = restitute_table_contact()
  good = good .and. restitute_table_contact_set(table, scene, small, error) == RESTITUTE_OK
  status = restitute_table_pair_many(table, normal_speeds=speeds, sliding_speeds=slides, ez=many(1, :), &
                                     ex=many(2, :), error=error)
  good = good .and. status == RESTITUTE_OK
  do k = 1, 3
    good = good .and. restitute_table_pair(table, normal_speed=speeds(k), sliding_speed=slides(k), ez=ez, ex=ex) == 0
    good = good .and. restitute_table_pair(table, small, speeds(k), slides(k), other(1), other(2)) == RESTITUTE_OK
    ! The same bits of many, as table.h says; the factors of the other contact are 1 but for
    ! rounding
    good = good .and. .not. any(abs(many(:, k) - [ez, ex]) > 0) .and. all(abs(other - [ez, ex]) < 1e-12_rk)
  end do
  good = good .and. restitute_table_pair_many(table, small, speeds, slides, ez=many(1, :), error=error) == RESTITUTE_OK
  status = restitute_table_pair_many(table, normal_speeds=speeds, sliding_speeds=slides(:2), error=error)
  good = good .and. status == RESTITUTE_ERROR_DOMAIN
  good = good .and. restitute_message(error) == "sliding_speeds: must have as many values as normal_speeds, 3; has 2"
  good = good .and. restitute_table_flags(table, normal_speed=10.0_rk, sliding_speed=0.0_rk, flags=flags) == 0
  good = good .and. restitute_table_flags(table, small, 10.0_rk, 0.0_rk, flags, error) == RESTITUTE_OK
  good = good .and. iand(flags, RESTITUTE_FLAG_LARGE_CONTACT) /= 0

  ball = restitute_body()
  ball%radius = 0.01_rk
  ball%mass = 4e-3_rk
  ball%position = [0.0_rk, 0.0_rk, 0.01_rk]
  ball%velocity = [0.2_rk, 0.0_rk, -0.5_rk]
  floor = restitute_body()
  floor%radius = ieee_value(1.0_rk, ieee_positive_inf)
  floor%normal = [0, 0, 1]
  good = good .and. restitute_table_collide(table, first=ball, second=floor, ez=ez, ex=ex, error=error) == RESTITUTE_OK
  good = good .and. abs(ball%velocity(3) - 0.5_rk*ez) < 1e-14_rk .and. abs(ez - many(1, 2)) < 1e-12_rk

  ! The numbers make the same table; arrays that do not fit make none.
  data = restitute_table_data()
  good = good .and. restitute_table_data_get(table, data, error) == RESTITUTE_OK
  call restitute_table_arrays(data, tau, modulus, speed, on_speed, strain, on_psi)
  good = good .and. size(tau) == 1 .and. size(speed) == info%speeds .and. size(on_psi, 1) == 4
  good = good .and. abs(speed(1) - data%low) < 1e-15_rk .and. all(on_speed(1, :) >= 0) .and. all(on_speed(1, :) <= 1)
  call restitute_table_arrays_set(data, int(info%stick_cells), tau, modulus, speed, on_speed, strain, on_psi)
  good = good .and. data%slip_cells == info%slip_cells .and. restitute_table_create(data, copy, error) == RESTITUTE_OK
  status = restitute_table_pair(copy, normal_speed=0.5_rk, sliding_speed=0.2_rk, ez=ez, ex=ex)
  good = good .and. status == RESTITUTE_OK
  good = good .and. .not. any(abs([ez, ex] - many(:, 2)) > 0)
  call restitute_table_destroy(copy)
  call restitute_table_arrays_set(data, int(info%stick_cells), tau, modulus, speed, on_speed, on_speed, on_psi)
  good = good .and. restitute_table_create(data, copy, error) == RESTITUTE_ERROR_NULL
  good = good .and. restitute_message(error) == "data.strain is NULL"

  status = restitute_table_build_many([rubber, rubber], scene, options, tables=tables(2:), error=error)
  good = good .and. status == RESTITUTE_ERROR_DOMAIN
  options%tolerance = 1e-2_rk
  finished = 0
  status = restitute_table_build_many([rubber, rubber], scene, options, count_finished, c_loc(finished), tables, error)
  good = good .and. status == RESTITUTE_OK
  good = good .and. all(finished == 3)
  good = good .and. restitute_table_pair(tables(2), normal_speed=0.5_rk, sliding_speed=0.2_rk, ex=ex) == RESTITUTE_OK
  print "(2a, f7.4, a, f7.4)", "table of restitute ", restitute_text(info%version), many(1, 2), ",", many(2, 2)
  do k = 1, 3
    call restitute_table_destroy(tables(k))
  end do
  call restitute_table_destroy(table)
  call restitute_table_destroy(table)
  call restitute_material_destroy(rubber)
  if (.not. good) error stop 1

contains

  !> Progress: how many calls there were in their order, and of how many tables they told.
  subroutine count_finished(data, done, count) bind(c)
    type(c_ptr), value :: data
    integer(restitute_size), value :: done, count
    integer, pointer :: seen(:)
    call c_f_pointer(data, seen, [2])
    if (done == seen(1) + 1) seen(1) = seen(1) + 1
    seen(2) = int(count)
  end subroutine count_finished
end program consumer_table
