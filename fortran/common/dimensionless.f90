!> Scales and dimensionless numbers of an impact, (22)-(25), docs/theory.md, sections 2 and 10.
module rst_dimensionless
  use rst_precision, only: dp
  implicit none (type, external)
  private
  public :: elastic_contact_radius, tangential_mass_ratio, sliding_ratio, damping_modulus, critical_psi
  public :: theta_from_delta1

contains

  !> a_el (24): largest contact radius of the elastic impact with shear modulus g, pair mass m and
  !> radius r.
  pure function elastic_contact_radius(m, r, speed, g, nu) result(a_el) bind(c, name="rst_elastic_contact_radius")
    real(dp), intent(in), value :: m, r, speed, g, nu
    real(dp) :: a_el
    ! fifth roots are taken one by one: the product of the bases leaves the range of a double for
    ! grains of 1 nm
    a_el = (15*(1 - nu)/32)**0.2_dp*m**0.2_dp*speed**0.4_dp*r**0.4_dp/g**0.2_dp
  end function elastic_contact_radius

  !> chi (22) for two bodies: m times the sum of 1/m_i + R_i^2/J_i, times (1-nu)/(2-nu).
  pure function tangential_mass_ratio(m, inverse_tangential_mass, nu) result(chi) bind(c, name="rst_tangential_mass_ratio")
    real(dp), intent(in), value :: m, inverse_tangential_mass, nu
    real(dp) :: chi
    chi = (1 - nu)/(2 - nu)*m*inverse_tangential_mass
  end function tangential_mass_ratio

  !> psi (22): sliding speed over mu v_z0, times (2-2nu)/(2-nu). Infinite friction gives 0.
  pure function sliding_ratio(sliding_speed, friction, normal_speed, nu) result(psi) bind(c, name="rst_sliding_ratio")
    real(dp), intent(in), value :: sliding_speed, friction, normal_speed, nu
    real(dp) :: psi
    psi = (2 - 2*nu)/(2 - nu)*abs(sliding_speed)/normal_speed/friction
  end function sliding_ratio

  !> Reference modulus at which a mere dashpot has theta = eta/(G T) = 1. T = a_el^2/(R v) and a_el
  !> ~ G^(-1/5), so theta ~ G^(-3/5).
  pure function damping_modulus(m, r, speed, eta, nu) result(g) bind(c, name="rst_damping_modulus")
    real(dp), intent(in), value :: m, r, speed, eta, nu
    real(dp) :: g
    real(dp) :: time_at_unit_modulus
    time_at_unit_modulus = elastic_contact_radius(m, r, speed, 1.0_dp, nu)**2/(r*speed)
    g = (eta/time_at_unit_modulus)**(5.0_dp/3.0_dp)
  end function damping_modulus

  !> theta = eta/(G1 T) = sqrt(32/15) delta1 (23).
  pure function theta_from_delta1(delta1) result(theta) bind(c, name="rst_theta_from_delta1")
    real(dp), intent(in), value :: delta1
    real(dp) :: theta
    theta = sqrt(32.0_dp/15.0_dp)*delta1
  end function theta_from_delta1

  !> psi_c (31), an identity (docs/theory.md, section 4): from it on the contact slips to the end.
  pure function critical_psi(chi, ez) result(psi_c) bind(c, name="rst_critical_psi")
    real(dp), intent(in), value :: chi, ez
    real(dp) :: psi_c
    psi_c = max(1.0_dp, 2*chi*(1 + ez) - ez)
  end function critical_psi
end module rst_dimensionless
