!> Relaxation modulus G(t) = G_inf + sum_k g_k exp(-t/tau_k) + eta delta(t) and its one-step update.
!>
!> All solids of the library have this form: elastic (no terms), standard solid (1), Kelvin-Voigt
!> (2) (no terms, eta > 0), Maxwell (G_inf = 0), Prony. The state of a term is its stress y_k = g_k
!> w_k, not the elongation w_k: the stress keeps a limit for tau -> 0 at constant g tau, the
!> elongation does not.
module rst_relaxation
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: relaxation_modulus, step_coefficients, step_stiffness, largest_stable_step

contains

  !> G(t) for t > 0 (the delta has passed).
  pure function relaxation_modulus(t, g_inf, n_terms, g, tau) result(modulus) bind(c, name="rst_relaxation_modulus")
    real(dp), intent(in), value :: t, g_inf
    integer(ip), intent(in), value :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp) :: modulus
    real(dp), parameter :: nothing_left = 1000  !! exp(-1000) = 0
    integer(ip) :: k
    modulus = g_inf
    do k = 1, n_terms
      modulus = modulus + g(k)*exp(-min(t, nothing_left*tau(k))/tau(k))  ! any t: t/tau alone could overflow
    end do
  end function relaxation_modulus

  !> Backward Euler of y' = g u' - y/tau over a step h, which is (12): y <- decay y + gain du.
  pure subroutine step_coefficients(h, n_terms, g, tau, decay, gain) bind(c, name="rst_step_coefficients")
    real(dp), intent(in), value :: h
    integer(ip), intent(in), value :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp), intent(out) :: decay(n_terms), gain(n_terms)
    integer(ip) :: k
    do k = 1, n_terms
      decay(k) = tau(k)/(tau(k) + h)
      gain(k) = g(k)*decay(k)
    end do
  end subroutine step_coefficients

  !> Stiffness with which the material answers an oscillation of period 2h, the fastest that a step
  !> h can show. At z = -1 a term y <- a y + b du has the stiffness 2b/(1+a) = 2 g tau/(2 tau + h),
  !> a dashpot 2 eta/h.
  pure function step_stiffness(h, g_inf, eta, n_terms, g, tau) result(stiffness)
    real(dp), intent(in) :: h, g_inf, eta
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp) :: stiffness
    integer(ip) :: k
    stiffness = g_inf + 2*eta/h
    do k = 1, n_terms
      stiffness = stiffness + 2*g(k)*tau(k)/(2*tau(k) + h)
    end do
  end function step_stiffness

  !> Largest step at which the explicitly coupled sphere does not oscillate with growing amplitude.
  !>
  !> For position-first Euler, v <- v - h K f, the characteristic polynomial (z-1)^2 + h^2 K z
  !> [g_inf + sum b (z-1)/(z-a)] passes z = -1 at h^2 K step_stiffness(h) = 4 (elastic: h omega = 2;
  !> Kelvin-Voigt: h K eta = 2, docs/theory.md, section 4). The left side grows with h: bisection in
  !> log h.
  pure function largest_stable_step(coupling, g_inf, eta, n_terms, g, tau) result(h) bind(c, name="rst_largest_stable_step")
    real(dp), intent(in), value :: coupling, g_inf, eta  !! coupling K: velocity change per unit of time and stiffness
    integer(ip), intent(in), value :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp) :: h
    real(dp) :: low, high
    integer(ip) :: i
    low = 1.0e-30_dp
    high = 1.0e30_dp
    do i = 1, 80
      h = sqrt(low)*sqrt(high)
      if (coupling*h*h*step_stiffness(h, g_inf, eta, n_terms, g, tau) < 4) then
        low = h
      else
        high = h
      end if
    end do
    h = low
  end function largest_stable_step
end module rst_relaxation
