!> The Maxwell arms of the solid on a panel of collocation.
!>
!> An arm of the modulus g that relaxes at the rate 1/tau has the stress y with y' = g v - rate y for the velocity v. The spring
!> G_inf is an arm with the rate 0, so that the solid is a dashpot eta and arms, and no formula has a case for any of them.
module rst_arms
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, integral, solve_linear
  implicit none (type, external)
  private
  public :: solid_type, respond

  !> Twin of `struct sync_solid` in C; the moduli and rates of the arms are arrays beside it.
  type, bind(c) :: solid_type
    real(dp) :: eta
    integer(ip) :: n_arms
  end type solid_type

contains

  !> The stress at the points of a panel is decay*y_0 + matmul(kernel, g*span*v). span: time per x at the points, so that time passes
  !> as int span dx. The arm is taken implicitly, at any rate.
  pure subroutine respond(rate, span, kernel, decay, fails)
    real(dp), intent(in) :: rate, span(stages)
    real(dp), intent(out) :: kernel(stages, stages), decay(stages)
    logical, intent(out) :: fails
    real(dp) :: a(stages, stages), b(stages, stages + 1)
    integer(ip) :: j
    fails = .false.
    kernel = integral
    decay = 1
    if (.not. rate > 0) return
    do j = 1, stages
      a(:, j) = integral(:, j)*(rate*span(j))
      a(j, j) = 1 + a(j, j)
    end do
    b(:, 1:stages) = integral
    b(:, stages + 1) = 1
    call solve_linear(stages, stages + 1, a, b, fails)
    kernel = b(:, 1:stages)
    decay = b(:, stages + 1)
  end subroutine respond
end module rst_arms
