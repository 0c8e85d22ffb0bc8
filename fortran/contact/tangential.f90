!> The tangential problem of a step: every element sticks or is returned radially to its friction
!> limit, in two dimensions (docs/contact.md). Outside the contact the limit is zero, so the same
!> rule relaxes it.
module rst_contact_tangential
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, rates_type, motion_type, most_nodes, lanes
  use rst_contact_grid, only: weight
  use rst_contact_rates, only: velocity_response
  use rst_contact_normal, only: normal_type
  implicit none (type, external)
  private
  public :: shear

  real(dp), parameter :: fastest = 1.0e80_dp  !! m/s: squares of viscous forces are not to overflow

  !> Force densities in units of law%tangential.
  type :: shear_type
    real(dp) :: limit(most_nodes)    !! friction limit
    real(dp) :: trial(most_nodes, 2) !! if all sticks
    real(dp) :: q(most_nodes, 2)     !! within the limit
    real(dp) :: excess(most_nodes)   !! part of the trial force beyond the limit
    real(dp) :: at_rim(2), limit_at_rim
    real(dp) :: total(2)             !! integral of q over the contact radius, in grid widths
  end type shear_type

contains

  pure subroutine shear(law, rates, motion, displacement, width, contact, u, w, force, friction)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    type(motion_type), intent(in) :: motion
    real(dp), intent(in) :: displacement(2), width
    type(normal_type), intent(in) :: contact
    real(dp), intent(inout) :: u(law%n, 2), w(law%n, law%n_terms, 2)
    real(dp), intent(out) :: force(2)  !! the force on body 1 is the opposite
    real(dp), intent(out) :: friction  !! energy lost in the step
    type(shear_type) :: s
    real(dp) :: scale, sticking, change(2)
    integer(ip) :: d, j, k, last

    last = contact%last
    scale = law%tangential*width
    do j = 1, law%n, lanes
      call stick(law, displacement, law%eta/rates%step, contact%touch(j), contact%decay(j, 1), contact%gain(j, 1), u(j, 1), &
                 w(j, 1, 1), s%trial(j, 1))
    end do
    call slip_where_beyond(law, rates, motion%friction, displacement/rates%step, contact, w, s)
    if (rates%viscosity > 0 .and. last > 0) then
      sticking = sum(law%weight(1:last), mask=.not. s%excess(1:last) > 0)
      if (.not. s%excess(last) > 0) sticking = sticking + contact%inner + contact%outer
      change = within(-velocity_response(motion%mobility(2), scale*sticking*rates%viscosity)*scale*s%total, fastest)
      do d = 1, 2
        do k = 1, law%n_terms
          w(:, k, d) = w(:, k, d) + rates%bend(k)*change(d)*contact%touch(1:law%n)
        end do
        s%trial(1:law%n, d) = s%trial(1:law%n, d) + rates%viscosity*change(d)*contact%touch(1:law%n)
      end do
      call slip_where_beyond(law, rates, motion%friction, displacement/rates%step + change, contact, w, s)
    end if
    force = within(scale*s%total, motion%friction*contact%force) ! kink corrections may exceed the limit
    friction = 0
    if (law%accounts /= 0 .and. last > 0) friction = scale*lost(law, rates%compliance, contact, s)
    do j = 1, law%n, lanes
      call spring_back(law, rates, s%excess(j), s%trial(j, 1), u(j, 1), w(j, 1, 1))
    end do
  end subroutine shear

  !> Eight elements, if nothing slips.
  pure subroutine stick(law, displacement, eta_over_step, touch, decay, gain, u, w, trial)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: displacement(2), eta_over_step
    real(dp), intent(in) :: touch(lanes), decay(most_nodes, law%n_terms), gain(most_nodes, law%n_terms)
    real(dp), intent(inout) :: u(law%n, 2), w(law%n, law%n_terms, 2), trial(most_nodes, 2)
    real(dp) :: viscous(2)
    integer(ip) :: i, k
    viscous = eta_over_step*displacement
    !$omp simd
    do i = 1, lanes
      u(i, 1) = u(i, 1) + touch(i)*displacement(1)
      u(i, 2) = u(i, 2) + touch(i)*displacement(2)
      trial(i, 1) = law%g_inf*u(i, 1) + merge(viscous(1), 0.0_dp, touch(i) > 0)
      trial(i, 2) = law%g_inf*u(i, 2) + merge(viscous(2), 0.0_dp, touch(i) > 0)
    end do
    do k = 1, law%n_terms
      !$omp simd
      do i = 1, lanes
        w(i, k, 1) = decay(i, k)*w(i, k, 1) + gain(i, k)*(touch(i)*displacement(1))
        w(i, k, 2) = decay(i, k)*w(i, k, 2) + gain(i, k)*(touch(i)*displacement(2))
        trial(i, 1) = trial(i, 1) + law%g(k)*w(i, k, 1)
        trial(i, 2) = trial(i, 2) + law%g(k)*w(i, k, 2)
      end do
    end do
  end subroutine stick

  !> Eight elements: displacements are reduced where the force exceeds the limit.
  pure subroutine spring_back(law, rates, excess, trial, u, w)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: excess(lanes), trial(most_nodes, 2)
    real(dp), intent(inout) :: u(law%n, 2), w(law%n, law%n_terms, 2)
    real(dp) :: back(lanes, 2)
    integer(ip) :: i, k
    !$omp simd
    do i = 1, lanes
      back(i, 1) = excess(i)*trial(i, 1)*rates%compliance
      back(i, 2) = excess(i)*trial(i, 2)*rates%compliance
      u(i, 1) = u(i, 1) - back(i, 1)
      u(i, 2) = u(i, 2) - back(i, 2)
    end do
    do k = 1, law%n_terms
      !$omp simd
      do i = 1, lanes
        w(i, k, 1) = w(i, k, 1) - rates%gain(k)*back(i, 1)
        w(i, k, 2) = w(i, k, 2) - rates%gain(k)*back(i, 2)
      end do
    end do
  end subroutine spring_back

  !> Forces within the limits of friction, and their integral.
  pure subroutine slip_where_beyond(law, rates, friction, velocity, contact, w, s)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: friction, velocity(2)
    type(normal_type), intent(in) :: contact
    real(dp), intent(in) :: w(law%n, law%n_terms, 2)
    type(shear_type), intent(inout) :: s
    real(dp) :: ratio, q, kept, total_x, total_y, stuck
    integer(ip) :: first, j
    ratio = friction*law%normal/law%tangential
    s%limit_at_rim = ratio*contact%at_rim
    total_x = 0
    total_y = 0
    stuck = 0
    do first = 1, law%n, lanes
      !$omp simd private(q, kept) reduction(+: total_x, total_y, stuck)
      do j = first, first + lanes - 1
        s%limit(j) = ratio*contact%f(j)
        q = sqrt(s%trial(j, 1)**2 + s%trial(j, 2)**2)
        kept = s%limit(j)/max(q, s%limit(j), tiny(kept))
        s%excess(j) = 1 - kept
        s%q(j, 1) = s%trial(j, 1)*kept
        s%q(j, 2) = s%trial(j, 2)*kept
        total_x = total_x + law%weight(j)*s%q(j, 1)
        total_y = total_y + law%weight(j)*s%q(j, 2)
        stuck = stuck + law%bit(j)*merge(0.0_dp, 1.0_dp, s%excess(j) > 0)
      end do
    end do
    s%total = [total_x, total_y]
    if (contact%last == 0) return
    call hold_rim(law, rates, velocity, contact, w, s)
    s%total = s%total + contact%inner*s%q(contact%last, :) + contact%outer*s%at_rim
    call add_kinks(law, contact%last, int(stuck, ip), s)
    if (contact%last > 1) call add_kink_at_rim(law, contact, s)
  end subroutine slip_where_beyond

  !> The force density at the edge: where w rises from zero there (module rst_contact_normal), that
  !> of the last element by as much; else the same part of the limit.
  pure subroutine hold_rim(law, rates, velocity, contact, w, s)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: velocity(2)
    type(normal_type), intent(in) :: contact
    real(dp), intent(in) :: w(law%n, law%n_terms, 2)
    type(shear_type), intent(inout) :: s
    real(dp) :: q(2), slipped(2), size
    integer(ip) :: k, last
    s%at_rim = 0
    last = contact%last
    if (.not. contact%at_rim > 0) return
    q = law%eta*velocity
    slipped = s%excess(last)*s%trial(last, :)*rates%compliance
    do k = 1, law%n_terms
      q = q + law%g(k)*contact%rim_ratio(k)*(w(last, k, :) - rates%gain(k)*slipped)
    end do
    if (.not. law%eta > 0 .and. .not. contact%rim_ratio(1) > 0) &
      q = s%q(last, :)*(s%limit_at_rim/max(s%limit(last), tiny(1.0_dp)))
    size = sqrt(q(1)**2 + q(2)**2)
    if (size > s%limit_at_rim) q = q*(s%limit_at_rim/size)
    s%at_rim = q
  end subroutine hold_rim

  !> Kink correction: the error of the integral where stick changes to slip between two elements.
  !> `stuck` has a bit for every element that sticks.
  pure subroutine add_kinks(law, last, stuck, s)
    type(law_type), intent(in) :: law
    integer(ip), intent(in) :: last, stuck
    type(shear_type), intent(inout) :: s
    real(dp) :: direction(2), weight
    integer(ip) :: turns, inside, outside, behind
    turns = iand(ieor(stuck, shiftr(stuck, 1)), shiftl(1_ip, last - 1) - 1)
    do while (turns /= 0)
      inside = trailz(turns) + 1 ! the element before the change
      turns = iand(turns, turns - 1)
      outside = inside + 1
      weight = law%outwards(inside)
      if (.not. btest(stuck, inside - 1)) then ! slip within, stick without
        outside = inside
        inside = inside + 1
        weight = law%weight(inside) - law%outwards(inside)
      end if
      behind = 2*inside - outside
      if (behind < 1 .or. behind > last .or. .not. s%limit(outside) > 0) cycle
      direction = s%q(outside, :)/s%limit(outside)
      s%total = s%total + direction*lacking(law, s, inside, behind, law%y(outside), weight, direction)
    end do
  end subroutine add_kinks

  !> The same if the last elements stick and slip begins between them and the edge.
  pure subroutine add_kink_at_rim(law, contact, s)
    type(law_type), intent(in) :: law
    type(normal_type), intent(in) :: contact
    type(shear_type), intent(inout) :: s
    real(dp) :: beyond(2), size, more, reach
    integer(ip) :: last
    last = contact%last
    reach = (contact%edge**2 - law%y(last))*law%per_cell(last)
    if (s%excess(last) > 0 .or. .not. reach > 0) return
    beyond = s%q(last, :) + reach*(s%q(last, :) - s%q(last - 1, :))
    size = sqrt(beyond(1)**2 + beyond(2)**2)
    if (size <= s%limit_at_rim) return
    beyond = beyond/size
    more = lacking(law, s, last, last - 1, contact%edge**2, contact%inner + law%outwards(last), beyond)
    if (more > 0) s%total = s%total + more*beyond + contact%outer*(s%limit_at_rim*beyond - s%at_rim)
  end subroutine add_kink_at_rim

  !> Slip begins between `inside`, which sticks as its neighbour `behind` does, and `outside`, which
  !> slips in `direction`: there the margin limit - q, extrapolated from the sticking side, is zero.
  !> In the quadrature the margin falls to zero at y = `outside`, so it has the weight
  !> `weight_inside`.
  pure function lacking(law, s, inside, behind, outside, weight_inside, direction)
    type(law_type), intent(in) :: law
    type(shear_type), intent(in) :: s
    integer(ip), intent(in) :: inside, behind
    real(dp), intent(in) :: outside, weight_inside, direction(2)
    real(dp) :: lacking, margin, change, y
    lacking = 0
    margin = s%limit(inside) - dot_product(direction, s%q(inside, :))
    change = s%limit(behind) - dot_product(direction, s%q(behind, :)) - margin
    if (s%excess(behind) > 0 .or. .not. margin > 0 .or. .not. change > 0) return
    y = law%y(inside) + margin*(law%y(inside) - law%y(behind))/change
    if ((outside - y)*(outside - law%y(inside)) <= 0 .or. y <= 0) return
    lacking = margin*(weight_inside - weight(law%x(inside), sqrt(y)))
  end function lacking

  !> The vector, cut to the length `limit` if it is longer; exactly zero if `limit` is.
  pure function within(vector, limit)
    real(dp), intent(in) :: vector(2), limit
    real(dp), parameter :: small = 1.0e-60_dp, rounding = 1.0e-15_dp
    real(dp) :: within(2), larger, size
    within = vector
    if (sum((small*vector)**2) < (small*limit)**2*(1 + rounding)) return ! saves divisions; squares are not to overflow
    larger = max(abs(vector(1)), abs(vector(2)))
    if (.not. larger > 0) return
    size = sqrt((vector(1)/larger)**2 + (vector(2)/larger)**2)
    if (larger*size > limit) within = vector/larger*(limit/size)
  end function within

  !> Integral of the friction limit times the slip, over the compliance of the elements.
  pure function lost(law, compliance, contact, s)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: compliance
    type(normal_type), intent(in) :: contact
    type(shear_type), intent(in) :: s
    real(dp) :: lost
    integer(ip) :: j, last
    last = contact%last
    lost = s%excess(last)*dot_product(contact%inner*s%q(last, :) + contact%outer*s%at_rim, compliance*s%trial(last, :))
    do j = 1, last
      lost = lost + law%weight(j)*s%excess(j)*dot_product(s%q(j, :), compliance*s%trial(j, :))
    end do
  end function lost
end module rst_contact_tangential
