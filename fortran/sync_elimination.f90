!> Linear equations and guesses for values at the points of one degree (module rst_sync_points_*), from sweep to sweep.
module ELIMINATION
  use rst_precision, only: dp, ip
  use POINTS, only: p
  implicit none (type, external)
  private
  public :: solve_again, steps_type, accelerate

  integer(ip), parameter :: most = p + 1 !! equations
  real(dp), parameter :: boldest = 2, least_bold = 0.5_dp
  real(dp), parameter :: alike = 1.0e-4_dp !! of two steps, the square of the sine between them

  !> The last steps of a sequence and where they led, the latest first.
  type :: steps_type
    integer(ip) :: count = 0
    real(dp) :: step(0:p, 2) = 0, led_to(0:p, 2) = 0
  end type steps_type

contains

  !> Equations (A + x) f = r, for an x that changes little from sweep to sweep: the inverse of A + x is kept and made again only
  !> after x has changed by more than the part kept_within; what it changed since is taken from the solution before. x_kept: that of
  !> the inverse, 0 if there is none. f: before, and after.
  pure subroutine solve_again(n, a, x, r, kept_within, x_kept, inverse, f)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: a(n, n), x, r(n), kept_within
    real(dp), intent(inout) :: x_kept, inverse(n, n), f(n)
    real(dp) :: rest(most), others(most)
    integer(ip) :: j, l
    if (.not. abs(x - x_kept) < kept_within*x) then
      x_kept = x
      call invert(n, a, x, inverse)
    end if
    rest(:n) = r - (x - x_kept)*f
    f = 0
    others = 0 ! see moments of the modules rst_sync_going_*
    do j = 1, n - 1, 2
      !$omp simd
      do l = 1, n
        f(l) = f(l) + inverse(l, j)*rest(j)
        others(l) = others(l) + inverse(l, j + 1)*rest(j + 1)
      end do
    end do
    if (modulo(n, 2_ip) == 1) f = f + inverse(:, n)*rest(n)
    f = f + others(:n)
  end subroutine solve_again

  !> The inverse of A + x by the elimination of Gauss and Jordan, rows in the order in which they come: whole columns at a time,
  !> which suit vectors better than triangular factors.
  pure subroutine invert(n, a, x, inverse)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: a(n, n), x
    real(dp), intent(out) :: inverse(n, n)
    real(dp) :: column(most), pivot, part
    integer(ip) :: i, j, l
    inverse = a
    do j = 1, n
      pivot = 1/(inverse(j, j) + x)
      column(:n) = inverse(:, j)
      column(j) = 0
      inverse(:, j) = 0
      inverse(j, j) = 1
      do i = 1, n
        part = inverse(j, i)*pivot
        !$omp simd
        do l = 1, n
          inverse(l, i) = inverse(l, i) - column(l)*part
        end do
        inverse(j, i) = part
      end do
    end do
  end subroutine invert

  !> The next guess x of a sequence, of which the step `step` was found at x: where, as if it were linear, the steps before would
  !> have led to the least step (Anderson's mixing of depth two, or one where these are alike).
  pure subroutine accelerate(step, before, x)
    real(dp), intent(in) :: step(0:p)
    type(steps_type), intent(inout) :: before
    real(dp), intent(inout) :: x(0:p)
    real(dp) :: first(0:p), second(0:p), next(0:p), part(2)
    next = x + step
    if (before%count > 0) then
      first = step - before%step(:, 1)
      second = 0
      if (before%count > 1) second = before%step(:, 1) - before%step(:, 2)
      part = parts_of(step, first, second)
      if (before%count > 1) next = next - part(2)*(before%led_to(:, 1) - before%led_to(:, 2))
      next = next - part(1)*(x + step - before%led_to(:, 1))
    end if
    before%count = before%count + 1
    before%step(:, 2) = before%step(:, 1)
    before%led_to(:, 2) = before%led_to(:, 1)
    before%step(:, 1) = step
    before%led_to(:, 1) = x + step
    x = next
  end subroutine accelerate

  !> The sum of `first` and `second` that is nearest to `step`.
  pure function parts_of(step, first, second) result(part)
    real(dp), intent(in) :: step(0:p), first(0:p), second(0:p)
    real(dp) :: part(2), a11, a12, a22, b1, b2, determinant
    integer(ip) :: l
    a11 = tiny(1.0_dp)
    a12 = 0
    a22 = 0
    b1 = 0
    b2 = 0
    do l = 0, p
      a11 = a11 + first(l)*first(l)
      a12 = a12 + first(l)*second(l)
      a22 = a22 + second(l)*second(l)
      b1 = b1 + first(l)*step(l)
      b2 = b2 + second(l)*step(l)
    end do
    part = [max(-boldest, min(b1/a11, least_bold)), 0.0_dp]
    determinant = a11*a22 - a12*a12
    if (.not. determinant > alike*a11*a22) return
    if (max(abs(b1*a22 - b2*a12), abs(a11*b2 - a12*b1)) > boldest*determinant) return
    part = [b1*a22 - b2*a12, a11*b2 - a12*b1]*(1/determinant)
  end function parts_of
end module ELIMINATION
