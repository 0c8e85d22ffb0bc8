!> The Maxwell arms of the solid on a panel of collocation.
!>
!> An arm of the modulus g that relaxes at the rate 1/tau has the stress y with y' = g v - rate y for the velocity v. The spring
!> G_inf is an arm with the rate 0, so that the solid is a dashpot eta and arms, and no formula has a case for any of them.
module rst_arms
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, integral, differential, shifted_inverse, applied
  implicit none (type, external)
  private
  public :: solid_type, respond, respond_all, advance

  !> The first members of `struct sync_normal` in C; the moduli and rates of the arms are arrays beside it.
  type, bind(c) :: solid_type
    real(dp) :: eta
    integer(ip) :: n_arms
  end type solid_type

contains

  !> The stress at the points of a panel is decay*y_0 + matmul(kernel, g*span*v). span: time per x at the points, so that time
  !> passes as int span dx. The arm is taken implicitly, at any rate.
  pure subroutine respond(rate, span, kernel, decay, fails)
    real(dp), intent(in) :: rate, span(stages)
    real(dp), intent(out) :: kernel(stages, stages), decay(stages)
    logical, intent(out) :: fails
    fails = .false.
    kernel = integral
    decay = 1
    if (.not. rate > 0) return
    kernel = shifted_inverse(rate*span)
    decay = applied(kernel, sum(differential, dim=2))
    fails = .not. all(abs(decay) <= huge(1.0_dp))
  end subroutine respond

  !> That of all arms, and answer: how the stress of an element answers to its velocity. (Pointers, here and below, since
  !> compilers would copy components of derived types.)
  subroutine respond_all(eta, g, rate, span, kernel, decay, answer, fails)
    real(dp), intent(in) :: eta, span(stages)
    real(dp), pointer, contiguous, intent(in) :: g(:), rate(:), kernel(:, :, :), decay(:, :)
    real(dp), intent(out) :: answer(stages, stages)
    logical, intent(out) :: fails
    integer(ip) :: j, k
    answer = 0
    fails = .false.
    do k = 1, size(g, kind=ip)
      call respond(rate(k), span, kernel(:, :, k), decay(:, k), fails)
      if (fails) return
      do j = 1, stages
        answer(:, j) = answer(:, j) + kernel(:, j, k)*(g(k)*span(j))
      end do
    end do
    do j = 1, stages
      answer(j, j) = answer(j, j) + eta
    end do
  end subroutine respond_all

  !> The stresses of all arms at the points, from those at the start, y(0, :), and the velocity v.
  subroutine advance(g, span, kernel, decay, v, y)
    real(dp), intent(in) :: span(stages), v(stages)
    real(dp), pointer, contiguous, intent(in) :: g(:), kernel(:, :, :), decay(:, :), y(:, :)
    integer(ip) :: k
    do k = 1, size(g, kind=ip)
      y(1:stages, k) = decay(:, k)*y(0, k) + applied(kernel(:, :, k), g(k)*span*v)
    end do
  end subroutine advance
end module rst_arms
