!> The Maxwell arms of the solid on a panel of collocation.
!>
!> An arm of the modulus g that relaxes at the rate 1/tau has the stress y with y' = g v - rate y
!> for the velocity v. The spring G_inf is an arm with the rate 0, so that the solid is a dashpot
!> eta and arms, and no formula has a case for any of them.
module rst_arms
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, integral, differential, shifted_inverse, applied
  implicit none (type, external)
  private
  public :: respond, respond_all, answer_of, advance

contains

  !> The stress at the points of a panel is kernel(:, 0)*y_0 + matmul(kernel(:, 1:), g*span*v).
  !> span: time per x at the points, so that time passes as int span dx. The arm is taken
  !> implicitly, at any rate.
  pure subroutine respond(rate, span, kernel, fails)
    real(dp), intent(in) :: rate, span(stages)
    real(dp), intent(out) :: kernel(stages, 0:stages)
    logical, intent(out) :: fails
    fails = .false.
    kernel(:, 0) = 1
    kernel(:, 1:) = integral
    if (.not. rate > 0) return
    kernel(:, 1:) = shifted_inverse(rate*span)
    kernel(:, 0) = applied(kernel(:, 1:), sum(differential, dim=2))
    fails = .not. all(abs(kernel(:, 0)) <= huge(1.0_dp))
  end subroutine respond

  !> All arms.
  subroutine respond_all(rate, span, kernel, fails)
    real(dp), intent(in) :: span(stages)
    real(dp), pointer, contiguous, intent(in) :: rate(:), kernel(:, :, :)
    logical, intent(out) :: fails
    integer(ip) :: k
    fails = .false.
    do k = 1, size(rate, kind=ip)
      call respond(rate(k), span, kernel(:, :, k), fails)
      if (fails) return
    end do
  end subroutine respond_all

  !> How the stress of an element answers to its velocity.
  subroutine answer_of(eta, g, span, kernel, answer)
    real(dp), intent(in) :: eta, span(stages)
    real(dp), pointer, contiguous, intent(in) :: g(:), kernel(:, :, :)
    real(dp), intent(out) :: answer(stages, stages)
    integer(ip) :: j, k
    answer = 0
    do k = 1, size(g, kind=ip)
      do j = 1, stages
        answer(:, j) = answer(:, j) + kernel(:, j, k)*(g(k)*span(j))
      end do
    end do
    do j = 1, stages
      answer(j, j) = answer(j, j) + eta
    end do
  end subroutine answer_of

  !> The stresses of all arms at the points, from those at the start, y(0, :), and the velocity v.
  !> (Pointers, here and above, since compilers would copy components of derived types.)
  subroutine advance(g, span, kernel, v, y)
    real(dp), intent(in) :: span(stages), v(stages)
    real(dp), pointer, contiguous, intent(in) :: g(:), kernel(:, :, :), y(:, :)
    integer(ip) :: k
    do k = 1, size(g, kind=ip)
      y(1:stages, k) = kernel(:, 0, k)*y(0, k) + applied(kernel(:, 1:, k), g(k)*span*v)
    end do
  end subroutine advance
end module rst_arms
