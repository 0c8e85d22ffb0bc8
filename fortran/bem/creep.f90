! SPDX-License-Identifier: BSD-3-Clause
!> From relaxation to creep. The modulus G(t) = G_inf + sum_k g_k exp(-t/tau_k) has the compliance
!>   J(t) = J_0 + sum_k J_k (1 - exp(-t/lambda_k)) + flow t,
!> with the transforms' product 1. With a_k = 1/tau_k the retardation rates x are the zeros of the
!> secular equation
!>   G_inf + sum_k g_k x/(x - a_k) = 0:
!> one between 0 and the smallest a if G_inf > 0 (else a flow term takes its place) and one between
!> each two neighbouring a; the left side falls in each interval, so bisection finds them. J_k =
!> 1/sum_i g_i (a_i/x_k) (x_k/(a_i - x_k))^2, all of order 1 where rates are extreme.
module rst_bem_creep
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: creep_of_relaxation

contains

  !> tau falls or rises, no two alike. n_creep <= n; lambda falls.
  pure subroutine creep_of_relaxation(g_inf, n, g, tau, instantaneous, flow, n_creep, compliance, lambda) &
    bind(c, name="rst_bem_creep_form")
    real(dp), intent(in), value :: g_inf
    integer(ip), intent(in), value :: n
    real(dp), intent(in) :: g(n), tau(n)
    real(dp), intent(out) :: instantaneous, flow, compliance(n), lambda(n)
    integer(ip), intent(out) :: n_creep
    real(dp) :: above, below
    integer(ip) :: k
    instantaneous = 1/(g_inf + sum(g))
    flow = 0
    if (n > 0 .and. g_inf <= 0) flow = 1/sum(g*tau)
    n_creep = 0
    do k = 1, n
      above = 1/tau(k)
      below = next_rate(n, tau, above)
      if (below <= 0 .and. g_inf <= 0) cycle
      n_creep = n_creep + 1
      call find_root(g_inf, n, g, tau, below, above, compliance(n_creep), lambda(n_creep))
    end do
  end subroutine creep_of_relaxation

  !> The largest relaxation rate below this one; 0 if there is none.
  pure function next_rate(n, tau, above) result(below)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: tau(n), above
    real(dp) :: below
    integer(ip) :: k
    below = 0
    do k = 1, n
      if (1/tau(k) < above) below = max(below, 1/tau(k))
    end do
  end function next_rate

  !> The zero between two neighbouring rates, sought as a distance from the nearer one, so that a_i
  !> - x keeps its digits.
  pure subroutine find_root(g_inf, n, g, tau, below, above, compliance, lambda)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: g_inf, g(n), tau(n), below, above
    real(dp), intent(out) :: compliance, lambda
    real(dp) :: origin, sign_of, near, far, middle, rate, value
    integer(ip) :: i
    middle = (above - below)/2
    origin = merge(above, below, secular(g_inf, n, g, tau, below, middle) > 0)
    sign_of = merge(-1.0_dp, 1.0_dp, origin >= above)
    near = 0
    far = middle
    do i = 1, 1200 ! a distance may be as small as the smallest number; each step halves the exponent or the interval
      middle = merge(sqrt(near)*sqrt(far), (near + far)/2, near > 0 .and. far > 2*near)
      if (near <= 0) middle = far*1e-3_dp
      if (middle <= near .or. middle >= far) exit
      value = secular(g_inf, n, g, tau, origin, sign_of*middle)
      ! the function falls with x: positive beyond a pole below, negative before a pole above
      if (value*sign_of > 0) then
        near = middle
      else
        far = middle
      end if
    end do
    rate = origin + sign_of*middle
    lambda = 1/rate
    value = 0
    do i = 1, n
      value = value + g(i)*((1/tau(i))/rate)*(rate/((1/tau(i) - origin) - sign_of*middle))**2
    end do
    compliance = 1/value
  end subroutine find_root

  !> The left side of the secular equation at x = origin + distance.
  pure function secular(g_inf, n, g, tau, origin, distance) result(value)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: g_inf, g(n), tau(n), origin, distance
    real(dp) :: value
    integer(ip) :: k
    value = g_inf
    do k = 1, n
      value = value + g(k)*(origin + distance)/((origin - 1/tau(k)) + distance)
    end do
  end function secular

end module rst_bem_creep
