! SPDX-License-Identifier: BSD-3-Clause
!> The loops over cells of a conjugate gradient method with bounds: K x = rhs where low < x < high,
!> residual >= 0 where x = high, <= 0 where x = low. The normal problem (Polonsky & Keer 1999) has
!> 0 <= p, the tangential one |tau| <= mu p. A cell is free where its residual can move it. Fields
!> are m x m cells in lines of length ld.
module rst_bem_bounded
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: clamp_start, free_residual, new_direction, take_step, add_scaled

contains

  !> x between its bounds.
  pure subroutine clamp_start(ld, m, low, high, x) bind(c, name="rst_bem_clamp")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), dimension(ld, m) :: low, high
    real(dp), intent(inout) :: x(ld, m)
    integer(ip) :: i, j
    do j = 1, m
      do i = 1, m
        x(i, j) = min(high(i, j), max(low(i, j), x(i, j)))
      end do
    end do
  end subroutine clamp_start

  !> r: the residual on free cells, 0 elsewhere. free: 1 and 0. changed: cells whose freedom
  !> changed.
  pure subroutine free_residual(ld, m, low, high, rhs, x, u, free, r, squares, count, changed) bind(c, name="rst_bem_free_residual")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), dimension(ld, m) :: low, high, rhs, x, u
    real(dp), intent(inout), dimension(ld, m) :: free, r
    real(dp), intent(out) :: squares, count, changed
    real(dp) :: e, f
    integer(ip) :: i, j
    squares = 0
    count = 0
    changed = 0
    do j = 1, m
      !$omp simd reduction(+:squares, count, changed) private(e, f)
      do i = 1, m
        e = rhs(i, j) - u(i, j)
        f = merge(1.0_dp, 0.0_dp, (x(i, j) > low(i, j) .or. e > 0) .and. (x(i, j) < high(i, j) .or. e < 0))
        changed = changed + abs(f - free(i, j))
        free(i, j) = f
        e = e*f
        r(i, j) = e
        squares = squares + e*e
        count = count + f
      end do
    end do
  end subroutine free_residual

  !> d = z + beta d on free cells, beta = r z/rz unless that is a restart (rz = 0). z comes from the
  !> preconditioner, on all cells.
  pure subroutine new_direction(ld, m, free, r, z, rz, d) bind(c, name="rst_bem_new_direction")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), dimension(ld, m) :: free, r, z
    real(dp), intent(inout) :: rz
    real(dp), intent(inout) :: d(ld, m)
    real(dp) :: product, beta
    integer(ip) :: i, j
    product = 0
    do j = 1, m
      !$omp simd reduction(+:product)
      do i = 1, m
        product = product + r(i, j)*z(i, j)
      end do
    end do
    beta = 0
    if (rz > 0) beta = product/rz
    rz = product
    do j = 1, m
      do i = 1, m
        d(i, j) = (z(i, j) + beta*d(i, j))*free(i, j)
      end do
    end do
  end subroutine new_direction

  !> x + alpha d between its bounds, alpha by the least energy along d. Where a bound stops it, d
  !> becomes the step over alpha.
  pure subroutine take_step(ld, m, low, high, r, kd, d, x, alpha, stopped) bind(c, name="rst_bem_take_step")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), dimension(ld, m) :: low, high, r, kd
    real(dp), intent(inout), dimension(ld, m) :: d, x
    real(dp), intent(out) :: alpha, stopped
    real(dp) :: rd, dkd, wanted, y, held
    integer(ip) :: i, j
    rd = 0
    dkd = 0
    do j = 1, m
      !$omp simd reduction(+:rd, dkd)
      do i = 1, m
        rd = rd + r(i, j)*d(i, j)
        dkd = dkd + d(i, j)*kd(i, j)
      end do
    end do
    stopped = 0
    alpha = 0
    if (.not. dkd > 0) return
    alpha = rd/dkd
    do j = 1, m
      !$omp simd reduction(+:stopped) private(wanted, y, held)
      do i = 1, m
        wanted = x(i, j) + alpha*d(i, j)
        y = min(high(i, j), max(low(i, j), wanted))
        held = merge(1.0_dp, 0.0_dp, y > wanted .or. y < wanted)
        stopped = stopped + held
        d(i, j) = merge((y - x(i, j))/alpha, d(i, j), held > 0)
        x(i, j) = y
      end do
    end do
  end subroutine take_step

  pure subroutine add_scaled(ld, m, a, y, x) bind(c, name="rst_bem_add_scaled")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), value :: a
    real(dp), intent(in) :: y(ld, m)
    real(dp), intent(inout) :: x(ld, m)
    integer(ip) :: i, j
    do j = 1, m
      do i = 1, m
        x(i, j) = x(i, j) + a*y(i, j)
      end do
    end do
  end subroutine add_scaled

end module rst_bem_bounded
