!> Equations (A + x) f = r for a small matrix A and numbers x that change little from sweep to sweep: the inverse is kept, and made
!> again only after x has changed; what changed since is taken from the solution before.
module rst_sync_elimination
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: solve_again, accelerate

  real(dp), parameter :: kept_within = 0.04_dp !! of x
  real(dp), parameter :: boldest = 2

contains

  !> kept: x of the inverse and the inverse; the former 0 if there is none. f: before, and after.
  pure subroutine solve_again(n, a, x, r, kept, f)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: a(n, n), x, r(n)
    real(dp), intent(inout) :: kept(0:n*n), f(n)
    real(dp) :: right(n)
    integer(ip) :: i, l
    if (.not. abs(x - kept(0)) < kept_within*x) then
      kept(0) = x
      call invert(n, a, x, kept(1:))
    end if
    !$omp simd
    do l = 1, n
      right(l) = r(l) - (x - kept(0))*f(l)
    end do
    f = 0
    do i = 1, n
      !$omp simd
      do l = 1, n
        f(l) = f(l) + kept((i - 1)*n + l)*right(i)
      end do
    end do
  end subroutine solve_again

  !> The next guess x of a sequence, of which the step `step` was found at x: as if the steps fell by one factor, which the step before,
  !> from x_before, tells (Anderson's mixing of depth one). first: there was none.
  pure subroutine accelerate(n, first, step, step_before, x_before, x)
    integer(ip), intent(in) :: n
    logical, intent(in) :: first
    real(dp), intent(in) :: step(n)
    real(dp), intent(inout) :: step_before(n), x_before(n), x(n)
    real(dp) :: here(n), part, square
    integer(ip) :: l
    here = x
    part = 0
    if (.not. first) then
      square = tiny(1.0_dp)
      do l = 1, n
        part = part + step(l)*(step(l) - step_before(l))
        square = square + (step(l) - step_before(l))**2
      end do
      part = max(-boldest, min(part/square, 0.5_dp))
      !$omp simd
      do l = 1, n
        x(l) = x(l) + step(l) - part*(x(l) + step(l) - (x_before(l) + step_before(l)))
      end do
    else
      x = x + step
    end if
    x_before = here
    step_before = step
  end subroutine accelerate

  !> By elimination in the order in which rows come.

  pure subroutine invert(n, matrix, x, a)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: matrix(n, n), x
    real(dp), intent(out) :: a(n, n)
    real(dp) :: column(n), pivot
    integer(ip) :: i, j, l
    a = matrix
    do j = 1, n
      a(j, j) = a(j, j) + x
    end do
    do j = 1, n
      pivot = 1/a(j, j)
      column = a(:, j)
      column(j) = 0
      a(:, j) = 0
      a(j, j) = 1
      do i = 1, n
        a(j, i) = a(j, i)*pivot
        !$omp simd
        do l = 1, n
          a(l, i) = a(l, i) - column(l)*a(j, i)
        end do
      end do
    end do
  end subroutine invert
end module rst_sync_elimination
