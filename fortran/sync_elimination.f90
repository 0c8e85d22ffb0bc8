!> Linear equations and guesses for values at the points of one degree (module rst_sync_points_*), from sweep to sweep.
module ELIMINATION
  use rst_precision, only: dp, ip
  use POINTS, only: p
  implicit none (type, external)
  private
  public :: solve_again, accelerate

  real(dp), parameter :: boldest = 2, least_bold = 0.5_dp

contains

  !> Equations (A + x) f = r, for an x that changes little from sweep to sweep: the factors of A + x are kept and made again only after
  !> x has changed by more than the part kept_within; what it changed since is taken from the solution before. x_kept: that of the factors, 0 if there are none. f:
  !> before, and after.
  pure subroutine solve_again(a, x, r, kept_within, x_kept, factors, f)
    real(dp), intent(in) :: a(0:p, 0:p), x, r(0:p), kept_within
    real(dp), intent(inout) :: x_kept, factors(0:p, 0:p), f(0:p)
    real(dp) :: rest(0:p)
    integer(ip) :: j, l
    if (.not. abs(x - x_kept) < kept_within*x) then
      x_kept = x
      call factorise(a, x, factors)
    end if
    rest = r - (x - x_kept)*f
    do j = 0, p
      do l = j + 1, p
        rest(l) = rest(l) - factors(l, j)*rest(j)
      end do
    end do
    do j = p, 0, -1
      f(j) = rest(j)*factors(j, j)
      do l = 0, j - 1
        rest(l) = rest(l) - factors(l, j)*f(j)
      end do
    end do
  end subroutine solve_again

  !> The triangular factors of A + x, rows in the order in which they come; of the diagonal the inverse.
  pure subroutine factorise(a, x, factors)
    real(dp), intent(in) :: a(0:p, 0:p), x
    real(dp), intent(out) :: factors(0:p, 0:p)
    integer(ip) :: i, j, l
    factors = a
    do j = 0, p
      factors(j, j) = factors(j, j) + x
    end do
    do j = 0, p
      factors(j, j) = 1/factors(j, j)
      do l = j + 1, p
        factors(l, j) = factors(l, j)*factors(j, j)
      end do
      do i = j + 1, p
        do l = j + 1, p
          factors(l, i) = factors(l, i) - factors(l, j)*factors(j, i)
        end do
      end do
    end do
  end subroutine factorise

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
