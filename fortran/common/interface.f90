!> The procedures of this folder that C calls, under their C names. Arguments are described where
!> they are computed.
module rst_common_interface
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use rst_relaxation, only: relaxation_modulus, step_coefficients, largest_stable_step
  use rst_dimensionless, only: elastic_contact_radius, tangential_mass_ratio, sliding_ratio, damping_modulus, critical_psi, &
                               theta_from_delta1
  use rst_merging, only: merge_terms
  use rst_series, only: chain_type, series_chain
  use rst_profile, only: plane_profile
  use rst_look_ahead, only: likely_depth, scout_compression, recoverable_energy
  use rst_motion_factors, only: mass_factor, elastic_contact_time
  implicit none (type, external)
  private
contains

  pure function rst_mass_factor() result(factor) bind(c, name="rst_mass_factor")
    real(c_double) :: factor
    factor = mass_factor
  end function rst_mass_factor

  pure function rst_elastic_contact_time() result(time) bind(c, name="rst_elastic_contact_time")
    real(c_double) :: time
    time = elastic_contact_time
  end function rst_elastic_contact_time

  pure function rst_relaxation_modulus(t, g_inf, n_terms, g, tau) result(modulus) bind(c, name="rst_relaxation_modulus")
    real(c_double), intent(in), value :: t, g_inf
    integer(c_int64_t), intent(in), value :: n_terms
    real(c_double), intent(in) :: g(n_terms), tau(n_terms)
    real(c_double) :: modulus
    modulus = relaxation_modulus(t, g_inf, n_terms, g, tau)
  end function rst_relaxation_modulus

  pure subroutine rst_step_coefficients(h, n_terms, g, tau, decay, gain) bind(c, name="rst_step_coefficients")
    real(c_double), intent(in), value :: h
    integer(c_int64_t), intent(in), value :: n_terms
    real(c_double), intent(in) :: g(n_terms), tau(n_terms)
    real(c_double), intent(out) :: decay(n_terms), gain(n_terms)
    call step_coefficients(h, n_terms, g, tau, decay, gain)
  end subroutine rst_step_coefficients

  pure function rst_largest_stable_step(coupling, g_inf, eta, n_terms, g, tau) result(h) &
    bind(c, name="rst_largest_stable_step")
    real(c_double), intent(in), value :: coupling, g_inf, eta
    integer(c_int64_t), intent(in), value :: n_terms
    real(c_double), intent(in) :: g(n_terms), tau(n_terms)
    real(c_double) :: h
    h = largest_stable_step(coupling, g_inf, eta, n_terms, g, tau)
  end function rst_largest_stable_step

  pure function rst_elastic_contact_radius(m, r, speed, g, nu) result(a_el) bind(c, name="rst_elastic_contact_radius")
    real(c_double), intent(in), value :: m, r, speed, g, nu
    real(c_double) :: a_el
    a_el = elastic_contact_radius(m, r, speed, g, nu)
  end function rst_elastic_contact_radius

  pure function rst_tangential_mass_ratio(m, inverse_tangential_mass, nu) result(chi) &
    bind(c, name="rst_tangential_mass_ratio")
    real(c_double), intent(in), value :: m, inverse_tangential_mass, nu
    real(c_double) :: chi
    chi = tangential_mass_ratio(m, inverse_tangential_mass, nu)
  end function rst_tangential_mass_ratio

  pure function rst_sliding_ratio(sliding_speed, friction, normal_speed, nu) result(psi) bind(c, name="rst_sliding_ratio")
    real(c_double), intent(in), value :: sliding_speed, friction, normal_speed, nu
    real(c_double) :: psi
    psi = sliding_ratio(sliding_speed, friction, normal_speed, nu)
  end function rst_sliding_ratio

  pure function rst_damping_modulus(m, r, speed, eta, nu) result(g) bind(c, name="rst_damping_modulus")
    real(c_double), intent(in), value :: m, r, speed, eta, nu
    real(c_double) :: g
    g = damping_modulus(m, r, speed, eta, nu)
  end function rst_damping_modulus

  pure function rst_theta_from_delta1(delta1) result(theta) bind(c, name="rst_theta_from_delta1")
    real(c_double), intent(in), value :: delta1
    real(c_double) :: theta
    theta = theta_from_delta1(delta1)
  end function rst_theta_from_delta1

  pure function rst_critical_psi(chi, ez) result(psi_c) bind(c, name="rst_critical_psi")
    real(c_double), intent(in), value :: chi, ez
    real(c_double) :: psi_c
    psi_c = critical_psi(chi, ez)
  end function rst_critical_psi

  pure function rst_plane_profile(x, radius) result(height) bind(c, name="rst_plane_profile")
    real(c_double), intent(in), value :: x, radius
    real(c_double) :: height
    height = plane_profile(x, radius)
  end function rst_plane_profile

  pure subroutine rst_merge_terms(share, window, depth, allowed, g_inf, eta, n_terms, g, tau, slow_rate, fast_bound) &
    bind(c, name="rst_merge_terms")
    real(c_double), intent(in), value :: share, window, depth, allowed
    real(c_double), intent(inout) :: g_inf, eta
    integer(c_int64_t), intent(inout) :: n_terms
    real(c_double), intent(inout) :: g(n_terms), tau(n_terms)
    real(c_double), intent(out) :: slow_rate, fast_bound
    call merge_terms(share, window, depth, allowed, g_inf, eta, n_terms, g, tau, slow_rate, fast_bound)
  end subroutine rst_merge_terms

  pure subroutine rst_series_chain(a, m_a, tau_a, b, m_b, tau_b, times, from_a, from_b, pair, m, tau) &
    bind(c, name="rst_series_chain")
    type(chain_type), intent(in) :: a, b
    real(c_double), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n)
    real(c_double), intent(out) :: times(a%n + b%n)
    integer(c_int64_t), intent(out) :: from_a(a%n + b%n), from_b(a%n + b%n)
    type(chain_type), intent(out) :: pair
    real(c_double), intent(out) :: m(a%n + b%n + 1), tau(a%n + b%n + 1)
    call series_chain(a, m_a, tau_a, b, m_b, tau_b, times, from_a, from_b, pair, m, tau)
  end subroutine rst_series_chain

  pure subroutine rst_scout_compression(g_inf, eta, n_terms, g, tau, can_sink, rest_speed, stress, depth, time, force, sinks) &
    bind(c, name="rst_scout_compression")
    real(c_double), intent(in), value :: g_inf, eta, rest_speed
    integer(c_int64_t), intent(in), value :: n_terms, can_sink
    real(c_double), intent(in) :: g(n_terms), tau(n_terms)
    real(c_double), intent(out) :: stress(n_terms), depth, time, force
    integer(c_int64_t), intent(out) :: sinks
    call scout_compression(g_inf, eta, n_terms, g, tau, can_sink, rest_speed, stress, depth, time, force, sinks)
  end subroutine rst_scout_compression

  pure function rst_likely_depth(g_inf, eta, n_terms, g, tau) result(depth) bind(c, name="rst_likely_depth")
    real(c_double), intent(in), value :: g_inf, eta
    integer(c_int64_t), intent(in), value :: n_terms
    real(c_double), intent(in) :: g(n_terms), tau(n_terms)
    real(c_double) :: depth
    depth = likely_depth(g_inf, eta, n_terms, g, tau)
  end function rst_likely_depth

  pure function rst_recoverable_energy(depth, g_inf, n_terms, g, stress) result(energy) bind(c, name="rst_recoverable_energy")
    real(c_double), intent(in), value :: depth, g_inf
    integer(c_int64_t), intent(in), value :: n_terms
    real(c_double), intent(in) :: g(n_terms), stress(n_terms)
    real(c_double) :: energy
    energy = recoverable_energy(depth, g_inf, n_terms, g, stress)
  end function rst_recoverable_energy
end module rst_common_interface
