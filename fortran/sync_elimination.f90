!> Linear equations and guesses for values at the points of one degree (module rst_sync_points_*), from sweep to sweep.
module ELIMINATION
  use rst_precision, only: dp, ip
  use POINTS, only: p
  implicit none (type, external)
  private
  public :: solve_again, accelerate

  real(dp), parameter :: boldest = 2, least_bold = 0.5_dp

contains

  !> Equations (A + x) f = r, for an x that changes little from sweep to sweep: the inverse of A + x is kept and made again only
  !> after x has changed by more than the part kept_within; what it changed since is taken from the solution before. x_kept: that of
  !> the inverse, 0 if there is none. f: before, and after.
  pure subroutine solve_again(a, x, r, kept_within, x_kept, inverse, f)
    real(dp), intent(in) :: a(0:p, 0:p), x, r(0:p), kept_within
    real(dp), intent(inout) :: x_kept, inverse(0:p, 0:p), f(0:p)
    real(dp) :: rest(0:p), others(0:p)
    integer(ip) :: j, l
    if (.not. abs(x - x_kept) < kept_within*x) then
      x_kept = x
      call invert(a, x, inverse)
    end if
    rest = r - (x - x_kept)*f
    f = inverse(:, 0)*rest(0)
    others = 0 ! see moments of the modules rst_sync_going_*
    do j = 1, p, 2
      !$omp simd
      do l = 0, p
        f(l) = f(l) + inverse(l, j)*rest(j)
        others(l) = others(l) + inverse(l, j + 1)*rest(j + 1)
      end do
    end do
    f = f + others
  end subroutine solve_again

  !> The inverse of A + x by the elimination of Gauss and Jordan, rows in the order in which they come: whole columns at a time, which
  !> suit vectors better than triangular factors.
  pure subroutine invert(a, x, inverse)
    real(dp), intent(in) :: a(0:p, 0:p), x
    real(dp), intent(out) :: inverse(0:p, 0:p)
    real(dp) :: column(0:p), pivot, part
    integer(ip) :: i, j, l
    inverse = a
    do j = 0, p
      pivot = 1/(inverse(j, j) + x)
      column = inverse(:, j)
      column(j) = 0
      inverse(:, j) = 0
      inverse(j, j) = 1
      do i = 0, p
        part = inverse(j, i)*pivot
        !$omp simd
        do l = 0, p
          inverse(l, i) = inverse(l, i) - column(l)*part
        end do
        inverse(j, i) = part
      end do
    end do
  end subroutine invert

  !> The next guess x of a sequence, of which the step `step` was found at x: as if steps fell by one factor, which the step before,
  !> from x_before, tells (Anderson's mixing of depth one).
  pure subroutine accelerate(first, step, step_before, x_before, x)
    logical, intent(in) :: first
    real(dp), intent(in) :: step(0:p)
    real(dp), intent(inout) :: step_before(0:p), x_before(0:p), x(0:p)
    real(dp) :: next(0:p), part, square
    integer(ip) :: l
    next = x + step
    if (.not. first) then
      part = 0
      square = tiny(1.0_dp)
      do l = 0, p
        part = part + step(l)*(step(l) - step_before(l))
        square = square + (step(l) - step_before(l))**2
      end do
      part = max(-boldest, min(part/square, least_bold))
      next = next - part*(next - (x_before + step_before))
    end if
    x_before = x
    step_before = step
    x = next
  end subroutine accelerate
end module ELIMINATION
