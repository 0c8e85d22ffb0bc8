!> The tangential problem of a step: every element sticks or is brought back radially onto its friction limit, in two dimensions
!> (docs/contact.md). Outside the contact the limit is zero: the same line lets it relax.
module rst_contact_tangential
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, rates_type, motion_type, most_nodes, lanes
  use rst_contact_grid, only: weight, integral
  use rst_contact_rates, only: relief
  use rst_contact_normal, only: normal_type, strain
  implicit none (type, external)
  private
  public :: shear

  !> Force densities in units of law%tangential.
  type :: shear_type
    real(dp) :: limit(most_nodes)    !! friction limit
    real(dp) :: trial(most_nodes, 2) !! if all sticks
    real(dp) :: q(most_nodes, 2)     !! within the limit
    real(dp) :: excess(most_nodes)   !! part of the trial force beyond the limit
    real(dp) :: at_rim(2), limit_at_rim
  end type shear_type

contains

  pure subroutine shear(law, rates, motion, displacement, width, contact, state, force, friction)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    type(motion_type), intent(in) :: motion
    real(dp), intent(in) :: displacement(2), width
    type(normal_type), intent(in) :: contact
    real(dp), intent(inout) :: state(*)
    real(dp), intent(out) :: force(2)  !! that body 1 feels is the opposite
    real(dp), intent(out) :: friction  !! energy lost in the step
    type(shear_type) :: s
    real(dp) :: ratio, sticking, change(2)

    ratio = motion%friction*law%normal/law%tangential
    s%limit_at_rim = ratio*contact%at_rim
    call stick(law, rates, displacement(1), law%n, law%n_terms, contact, state(law%at%u_x), state(law%at%w_x), s%trial(:, 1))
    call stick(law, rates, displacement(2), law%n, law%n_terms, contact, state(law%at%u_y), state(law%at%w_y), s%trial(:, 2))
    call limit_by_friction(law%n, ratio, contact%f, s)
    call hold_rim(law, rates, displacement/rates%step, contact, state(law%at%w_x), state(law%at%w_y), s)
    force = law%tangential*width*summed(law, contact, s)
    if (rates%drag > 0 .and. contact%last > 0) then
      sticking = sum(law%weight(1:contact%last), mask=.not. s%excess(1:contact%last) > 0)
      if (.not. s%excess(contact%last) > 0) sticking = sticking + contact%inner + contact%outer
      change = -relief(motion%mobility(2), law%tangential*width*sticking*rates%drag)*force
      call feel_end_velocity(rates, change(1), law%n, law%n_terms, contact, state(law%at%w_x), s%trial(:, 1))
      call feel_end_velocity(rates, change(2), law%n, law%n_terms, contact, state(law%at%w_y), s%trial(:, 2))
      call limit_by_friction(law%n, ratio, contact%f, s)
      call hold_rim(law, rates, displacement/rates%step + change, contact, state(law%at%w_x), state(law%at%w_y), s)
      force = law%tangential*width*summed(law, contact, s)
    end if
    friction = 0
    if (law%accounts /= 0) friction = law%tangential*width*rates%softness*lost(law, contact, s)
    call slip(rates, law%n, law%n_terms, s%excess, s%trial(:, 1), state(law%at%u_x), state(law%at%w_x))
    call slip(rates, law%n, law%n_terms, s%excess, s%trial(:, 2), state(law%at%u_y), state(law%at%w_y))
  end subroutine shear

  !> One direction, if nothing slips.
  pure subroutine stick(law, rates, displacement, n, n_terms, contact, u, w, trial)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: displacement
    integer(ip), intent(in) :: n, n_terms
    type(normal_type), intent(in) :: contact
    real(dp), intent(inout) :: u(n), w(n, n_terms)
    real(dp), intent(out) :: trial(n)
    real(dp) :: move(most_nodes), viscous
    integer(ip) :: first, j, k
    viscous = law%eta*displacement/rates%step
    do first = 0, n - 1, lanes
      do j = first + 1, first + lanes
        move(j) = contact%part(j)*displacement
        u(j) = u(j) + move(j)
        trial(j) = law%g_inf*u(j) + merge(viscous, 0.0_dp, contact%part(j) > 0)
      end do
    end do
    do k = 1, n_terms
      call strain(law, rates, k, n, contact%entered, contact%part, move, w(:, k), trial)
    end do
  end subroutine stick

  !> The viscous force at the velocity of the end of the step.
  pure subroutine feel_end_velocity(rates, change, n, n_terms, contact, w, trial)
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: change
    integer(ip), intent(in) :: n, n_terms
    type(normal_type), intent(in) :: contact
    real(dp), intent(inout) :: w(n, n_terms), trial(n)
    integer(ip) :: k
    do k = 1, n_terms
      w(:, k) = w(:, k) + rates%bend(k)*change*contact%part(1:n)
    end do
    trial = trial + rates%drag*change*contact%part(1:n)
  end subroutine feel_end_velocity

  pure subroutine limit_by_friction(n, ratio, f, s)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: ratio, f(*)
    type(shear_type), intent(inout) :: s
    real(dp), parameter :: least = 1.0e-300_dp
    real(dp) :: q
    integer(ip) :: first, j
    do first = 0, n - 1, lanes
      !$omp simd private(q)
      do j = first + 1, first + lanes
        s%limit(j) = ratio*f(j)
        q = sqrt(s%trial(j, 1)**2 + s%trial(j, 2)**2)
        s%excess(j) = max(q - s%limit(j), 0.0_dp)/(q + least)
        s%q(j, 1) = s%trial(j, 1)*(1 - s%excess(j))
        s%q(j, 2) = s%trial(j, 2)*(1 - s%excess(j))
      end do
    end do
  end subroutine limit_by_friction

  !> What is beyond the limit springs back.
  pure subroutine slip(rates, n, n_terms, excess, trial, u, w)
    type(rates_type), intent(in) :: rates
    integer(ip), intent(in) :: n, n_terms
    real(dp), intent(in) :: excess(n), trial(n)
    real(dp), intent(inout) :: u(n), w(n, n_terms)
    real(dp) :: back(most_nodes)
    integer(ip) :: first, j, k
    do first = 0, n - 1, lanes
      do j = first + 1, first + lanes
        back(j) = excess(j)*trial(j)*rates%softness
        u(j) = u(j) - back(j)
      end do
    end do
    do k = 1, n_terms
      do first = 0, n - 1, lanes
        do j = first + 1, first + lanes
          w(j, k) = w(j, k) - rates%gain(k)*back(j)
        end do
      end do
    end do
  end subroutine slip

  !> Integral of the friction limit times the slip, over the softness of the elements.
  pure function lost(law, contact, s)
    type(law_type), intent(in) :: law
    type(normal_type), intent(in) :: contact
    type(shear_type), intent(in) :: s
    real(dp) :: lost
    integer(ip) :: j, last
    lost = 0
    last = contact%last
    if (last == 0) return
    do j = 1, last
      lost = lost + law%weight(j)*s%excess(j)*dot_product(s%q(j, :), s%trial(j, :))
    end do
    lost = lost + s%excess(last)*dot_product(contact%inner*s%q(last, :) + contact%outer*s%at_rim, s%trial(last, :))
  end function lost

  !> The force density at the rim: where w rises from zero there (module rst_contact_normal), that of the last element by as much;
  !> else the same part of the limit.
  pure subroutine hold_rim(law, rates, velocity, contact, w_x, w_y, s)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: velocity(2)
    type(normal_type), intent(in) :: contact
    real(dp), intent(in) :: w_x(law%n, law%n_terms), w_y(law%n, law%n_terms)
    type(shear_type), intent(inout) :: s
    real(dp) :: q(2), slipped(2), size
    integer(ip) :: k, last
    s%at_rim = 0
    last = contact%last
    if (last == 0 .or. .not. contact%at_rim > 0) return
    q = law%eta*velocity
    slipped = s%excess(last)*s%trial(last, :)*rates%softness
    do k = 1, law%n_terms
      q = q + law%g(k)*contact%rise(k)*([w_x(last, k), w_y(last, k)] - rates%gain(k)*slipped)
    end do
    if (.not. law%eta > 0 .and. .not. contact%rise(1) > 0) q = s%q(last, :)*(s%limit_at_rim/max(s%limit(last), tiny(1.0_dp)))
    size = sqrt(q(1)**2 + q(2)**2)
    if (size > s%limit_at_rim) q = q*(s%limit_at_rim/size)
    s%at_rim = q
  end subroutine hold_rim

  !> Integral over the contact radius, with the kinks where stick turns to slip between two elements.
  pure function summed(law, contact, s) result(total)
    type(law_type), intent(in) :: law
    type(normal_type), intent(in) :: contact
    type(shear_type), intent(in) :: s
    real(dp) :: total(2)
    integer(ip) :: j, last
    total = 0
    last = contact%last
    if (last == 0) return
    total = [integral(law, s%q(:, 1)), integral(law, s%q(:, 2))] + contact%inner*s%q(last, :) + contact%outer*s%at_rim
    do j = 1, last - 1
      if (s%excess(j) > 0 .and. .not. s%excess(j + 1) > 0) then
        if (j + 2 <= last) call add_kink(law, s, j + 1, j + 2, j, total)
      else if (s%excess(j + 1) > 0 .and. .not. s%excess(j) > 0) then
        if (j > 1) call add_kink(law, s, j, j - 1, j + 1, total)
      end if
    end do
    if (last > 1) call add_kink_at_rim(law, contact, s, last, total)
  end function summed

  !> Slip begins between `inside`, which sticks as its neighbour `behind` does, and `outside`, which slips: there the margin
  !> limit - q, extrapolated from the sticking side, is zero. The quadrature took it to fall to zero at `outside`.
  pure subroutine add_kink(law, s, inside, behind, outside, total)
    type(law_type), intent(in) :: law
    type(shear_type), intent(in) :: s
    integer(ip), intent(in) :: inside, behind, outside
    real(dp), intent(inout) :: total(2)
    real(dp) :: direction(2), margin(2), kink
    if (s%excess(behind) > 0 .or. .not. s%limit(outside) > 0) return
    direction = s%q(outside, :)/s%limit(outside)
    margin = [s%limit(inside) - dot_product(direction, s%q(inside, :)), s%limit(behind) - dot_product(direction, s%q(behind, :))]
    if (.not. margin(1) > 0 .or. margin(2) <= margin(1)) return
    kink = law%y(inside) + margin(1)*(law%y(inside) - law%y(behind))/(margin(2) - margin(1))
    if ((law%y(outside) - kink)*(law%y(outside) - law%y(inside)) <= 0 .or. kink <= 0) return
    total = total + direction*margin(1)*(weight(law%x(inside), law%x(outside)) - weight(law%x(inside), sqrt(kink)))
  end subroutine add_kink

  !> Likewise if all elements stick and slip begins between the last one and the rim.
  pure subroutine add_kink_at_rim(law, contact, s, last, total)
    type(law_type), intent(in) :: law
    type(normal_type), intent(in) :: contact
    type(shear_type), intent(in) :: s
    integer(ip), intent(in) :: last
    real(dp), intent(inout) :: total(2)
    real(dp) :: beyond(2), direction(2), margin(2), size, kink, reach
    if (s%excess(last) > 0 .or. s%excess(last - 1) > 0 .or. contact%edge <= law%x(last)) return
    reach = (contact%edge**2 - law%y(last))/(law%y(last) - law%y(last - 1))
    beyond = s%q(last, :) + reach*(s%q(last, :) - s%q(last - 1, :))
    size = sqrt(beyond(1)**2 + beyond(2)**2)
    if (size <= s%limit_at_rim) return
    direction = beyond/size
    margin = [s%limit(last) - dot_product(direction, s%q(last, :)), s%limit(last - 1) - dot_product(direction, s%q(last - 1, :))]
    if (.not. margin(1) > 0 .or. margin(2) <= margin(1)) return
    kink = law%y(last) + margin(1)*(law%y(last) - law%y(last - 1))/(margin(2) - margin(1))
    if (kink >= contact%edge**2) return
    total = total + direction*margin(1)*(contact%inner + law%outwards(last) - weight(law%x(last), sqrt(kink))) &
            + contact%outer*(s%limit_at_rim*direction - s%at_rim)
  end subroutine add_kink_at_rim
end module rst_contact_tangential
