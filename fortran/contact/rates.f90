!> Springs and dashpots over one time step, exact for a velocity that is linear in it
!> (docs/contact.md), and the width of a new contact.
module rst_contact_rates
  use, intrinsic :: iso_c_binding, only: c_double
  use rst_motion_factors, only: elastic_contact_time
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, rates_type
  implicit none (type, external)
  private
  public :: set_rates, arm_of, velocity_response, largest_overlap, contact_time

contains

  !> One Maxwell arm over a step: what is left of its elongation; elongation by a unit displacement
  !> even over the step; by a unit change of velocity from the mean of the step to its end.
  elemental subroutine arm_of(step, tau, decay, gain, bend)
    real(dp), intent(in) :: step, tau
    real(dp), intent(out) :: decay, gain, bend
    real(dp), parameter :: series_below = 0.01_dp  !! there z^4/120 is rounding
    real(dp) :: z
    z = step/tau
    decay = exp(-z)
    if (z < series_below) then
      gain = 1 - z*(1/2.0_dp - z*(1/6.0_dp - z/24))
      bend = step*z*(1/6.0_dp - z*(1/12.0_dp - z/40))
    else
      gain = (1 - decay)/z
      bend = tau*(1 + decay - 2*gain)
    end if
  end subroutine arm_of

  pure subroutine set_rates(law, step, rates) bind(c, name="rst_law_rates")
    type(law_type), intent(in) :: law
    real(c_double), intent(in), value :: step
    type(rates_type), intent(inout) :: rates
    real(dp) :: stiffness
    integer(ip) :: k
    rates%step = step
    stiffness = law%g_inf + law%eta/step
    rates%viscosity = law%eta
    rates%decay = 0
    rates%gain = 0
    rates%bend = 0
    do k = 1, law%n_terms
      call arm_of(step, law%tau(k), rates%decay(k), rates%gain(k), rates%bend(k))
      if (law%tau(k) > step) rates%bend(k) = 0 ! slow arms are springs: their forces do not follow the velocity
      stiffness = stiffness + law%g(k)*rates%gain(k)
      rates%viscosity = rates%viscosity + law%g(k)*rates%bend(k)
    end do
    rates%compliance = 1/stiffness
  end subroutine set_rates

  !> Change of the velocity until the end of the step by a unit force against it; damping: force
  !> over velocity. Corrected so that a mere dashpot of any strength decays by exp(-damping dt/m) in
  !> a velocity-Verlet step.
  elemental function velocity_response(mobility, damping) result(response)
    real(dp), intent(in) :: mobility, damping  !! mobility: step/(2 m)
    real(dp) :: response, z, share
    z = 2*mobility*damping
    if (z < 1.0e-3_dp) then
      share = 0.5_dp + z/12
    else
      share = 1/(1 - exp(-z)) - 1/z
    end if
    response = 2*mobility*share/(1 + z*share)
  end function velocity_response

  !> Largest overlap to be expected from the speed of first touch: that of the elastic impact (24)
  !> with the mean modulus over 0.88 d/v, a fixed point. The contact radius is 0 to 6 % less (with a
  !> parallel dashpot +-3 %, its part is fitted).
  pure function largest_overlap(law, mass, speed, radius) result(d)
    type(law_type), intent(in) :: law
    real(c_double), intent(in), value :: mass, speed, radius
    real(c_double) :: d
    real(dp) :: g, z, time, energy
    real(dp), parameter :: share_of_time = 0.88_dp, share_of_dashpot = 0.735_dp
    integer(ip) :: i, k
    integer(ip), parameter :: iterations = 24  !! each takes 30 to 50 % off the error of log d, which starts below 20
    energy = (15*(mass*speed**2)/(8*law%normal*sqrt(radius)))**0.4_dp
    d = radius
    do i = 1, iterations
      time = share_of_time*d/speed
      g = law%g_inf + law%eta*(share_of_time/share_of_dashpot)/time
      do k = 1, law%n_terms
        z = time/law%tau(k)
        if (z > 1.0e-6_dp) then
          g = g + law%g(k)*(1 - exp(-z))/z
        else
          g = g + law%g(k)
        end if
      end do
      d = sqrt(d*(energy/g**0.4_dp)) ! not (./g)**0.4, which may underflow under a dashpot
    end do
  end function largest_overlap

  !> How long an impact at this speed lasts, about: as an elastic one of that overlap.
  pure function contact_time(law, mass, speed, radius) result(time) bind(c, name="rst_law_contact_time")
    type(law_type), intent(in) :: law
    real(c_double), intent(in), value :: mass, speed, radius
    real(c_double) :: time
    time = elastic_contact_time*largest_overlap(law, mass, speed, radius)/speed
  end function contact_time
end module rst_contact_rates
