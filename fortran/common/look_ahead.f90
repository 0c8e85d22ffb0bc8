!> The compression phase without elements (docs/sync.md, section 1): its depth and its duration.
!>
!> While the contact grows, P_k = int_0^A y_k dX obeys P_k' = g_k A D' - P_k/tau_k with A = sqrt(D),
!> and the force per unit of dX is (2/3) G_inf D^(3/2) + eta A D' + sum P_k. One state for each
!> relaxation time, without elements.
module rst_look_ahead
  use rst_motion_factors, only: mass_factor
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: likely_depth, scout_compression, recoverable_energy

  real(dp), parameter :: growth = 0.01_dp  !! steps grow with the elapsed time: every decade takes the same number

contains

  !> Largest indentation, roughly (a few per cent): the energy balance with the modulus at that age,
  !> 1 = D^(5/2) (G_inf + sum g_k/(1 + 0.8 D/tau_k) + (5/4) eta/D), which is exact in the elastic
  !> and the viscous limit. The iteration starts from a scale of the solid, so that scaled moduli
  !> give the same steps.
  pure function likely_depth(g_inf, eta, n_terms, g, tau) result(depth) bind(c, name="rst_likely_depth")
    real(dp), intent(in), value :: g_inf, eta
    integer(ip), intent(in), value :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp) :: depth, modulus, factor
    integer(ip) :: i, k
    modulus = g_inf
    if (.not. g_inf > 0) modulus = sum(g)
    depth = (1.25_dp*max(eta, tiny(1.0_dp)))**(-2.0_dp/3.0_dp)
    if (modulus > 0) depth = modulus**(-0.4_dp)
    do i = 1, 100
      modulus = g_inf + 1.25_dp*eta/depth
      do k = 1, n_terms
        modulus = modulus + g(k)/(1 + 0.8_dp*depth/tau(k))
      end do
      factor = 1/sqrt(modulus*depth*depth*sqrt(depth))
      depth = depth*factor
      if (abs(factor - 1) < 0.01_dp) exit
    end do
  end function likely_depth

  !> Follow the compression with steps of 1 % of the time elapsed, all forces implicit in the
  !> velocity, so that no relaxation time, however short, limits the step. About 1 % accurate: it
  !> sizes the foundation and its steps.
  !>
  !> `stress` is workspace for n_terms values. `sinks` is 1 when the kinetic energy plus the energy
  !> in the foundation is below rest_speed**2: such a sphere rebounds more slowly than rest_speed,
  !> if at all (docs/theory.md, section 6).
  pure subroutine scout_compression(g_inf, eta, n_terms, g, tau, can_sink, rest_speed, stress, depth, time, force, sinks) &
    bind(c, name="rst_scout_compression")
    real(dp), intent(in), value :: g_inf, eta, rest_speed
    integer(ip), intent(in), value :: n_terms, can_sink
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp), intent(out) :: stress(n_terms), depth, time
    real(dp), intent(out) :: force  !! the largest, int f dX
    integer(ip), intent(out) :: sinks
    real(dp) :: velocity, h, radius, push, admittance, next
    integer(ip) :: step, k

    sinks = 0
    force = 0
    velocity = 1
    time = first_step(g_inf, eta, n_terms, g)
    depth = time
    stress = 0
    do step = 1, 20000
      h = growth*time
      radius = sqrt(depth)
      push = g_inf*(2.0_dp/3.0_dp)*depth*radius
      admittance = radius*(eta + g_inf*h)
      do k = 1, n_terms
        push = push + stress(k)*tau(k)/(tau(k) + h)
        admittance = admittance + radius*h*g(k)*tau(k)/(tau(k) + h)
      end do
      next = (velocity - mass_factor*h*push)/(1 + mass_factor*h*admittance)
      force = max(force, (velocity - next)/(mass_factor*h))
      if (next <= 0) then  ! the turning point lies within this step
        h = h*velocity/(velocity - next)
        depth = depth + 0.5_dp*h*velocity
        time = time + h
        return
      end if
      do k = 1, n_terms
        stress(k) = (stress(k) + h*g(k)*radius*next)*tau(k)/(tau(k) + h)
      end do
      velocity = next
      depth = depth + h*velocity
      time = time + h
      if (can_sink == 0 .or. velocity >= rest_speed) cycle
      if (velocity**2 + recoverable_energy(depth, g_inf, n_terms, g, stress) < rest_speed**2) then
        sinks = 1
        return
      end if
    end do
    sinks = can_sink
  end subroutine scout_compression

  !> A time so short that the force has not yet changed the velocity by 1e-8.
  pure function first_step(g_inf, eta, n_terms, g) result(time)
    real(dp), intent(in) :: g_inf, eta
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms)
    real(dp) :: time
    real(dp), parameter :: small = 1.0e-8_dp
    ! elastic: velocity change (1/2) G t^(5/2); dashpot: (5/4) eta t^(3/2)
    time = min((small/(g_inf + sum(g) + tiny(1.0_dp)))**0.4_dp, &
               (small/(eta + tiny(1.0_dp)))**(2.0_dp/3.0_dp), 1.0_dp)
  end function first_step

  !> Upper bound of the energy in the springs, in units of the impact energy. With y_k at the centre
  !> at most twice its mean P/A over the contact, (15/8) sum 2 P^2/(g A) covers the parabolic
  !> profile (exact factor 6/5).
  pure function recoverable_energy(depth, g_inf, n_terms, g, stress) result(energy) bind(c, name="rst_recoverable_energy")
    real(dp), intent(in), value :: depth, g_inf
    integer(ip), intent(in), value :: n_terms
    real(dp), intent(in) :: g(n_terms), stress(n_terms)
    real(dp) :: energy
    integer(ip) :: k
    energy = g_inf*(8.0_dp/15.0_dp)*depth**2*sqrt(depth)
    do k = 1, n_terms
      if (g(k) > 0) energy = energy + 2*stress(k)**2/(g(k)*sqrt(depth))
    end do
    energy = mass_factor*energy
  end function recoverable_energy
end module rst_look_ahead
