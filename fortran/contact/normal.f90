!> The normal problem of a step: every element follows the profile of the sphere or, where its force
!> would be tensile, its free surface (docs/contact.md). This one rule covers entry, exit and
!> re-entry on a surface that has not relaxed.
module rst_contact_normal
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, rates_type, motion_type, most_nodes, most_terms, lanes
  use rst_contact_rates, only: arm_of, velocity_response
  implicit none (type, external)
  private
  public :: normal_type, press

  !> Input of the tangential problem.
  type :: normal_type
    integer(ip) :: last              !! outermost element in contact; 0: none
    real(dp) :: f(most_nodes)        !! force density in units of law%normal
    real(dp) :: touch(most_nodes)    !! part of the step in contact, 0 outside
    real(dp) :: decay(most_nodes, most_terms), gain(most_nodes, most_terms) !! of the arms: entered elements had less time
    real(dp) :: edge                 !! contact radius in grid widths
    real(dp) :: inner, outer         !! weights in the last, cut cell: of the last element (added to law%weight), of the edge
    real(dp) :: at_rim               !! f at the edge
    real(dp) :: rim_ratio(most_terms) !! w at the edge over that of the last element
    real(dp) :: force
  end type normal_type

contains

  pure subroutine press(law, rates, motion, overlap_before, width, w, surface, contact)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    type(motion_type), intent(in) :: motion
    real(dp), intent(in) :: overlap_before, width
    real(dp), intent(inout) :: w(law%n, law%n_terms), surface(law%n)
    type(normal_type), intent(out) :: contact
    real(dp) :: scale, change, rim, carried
    integer(ip) :: first
    scale = width**2/motion%radius
    do first = 1, law%n, lanes
      call follow_profile(law, rates, motion, overlap_before, scale, first, w, surface, contact)
    end do
    contact%last = law%n
    do while (contact%last > 0)
      if (contact%touch(contact%last) > 0) exit
      contact%last = contact%last - 1
    end do
    call close_rim(law, motion, motion%velocity, width, w, surface, contact)
    if (.not. rates%viscosity > 0 .or. contact%last == 0) return
    rim = width*contact%edge ! the equilibrium spring may carry a static load, such as a weight at rest
    carried = law%normal*law%g_inf*rim*(motion%overlap - rim**2/(3*motion%radius))
    change = -velocity_response(motion%mobility(1), law%normal*rim*rates%viscosity)*(contact%force - carried)
    call feel_end_velocity(law, rates, change, w, surface, contact)
    call close_rim(law, motion, motion%velocity + change, width, w, surface, contact)
  end subroutine press

  !> Eight elements over the step. An element enters where the profile reaches its free surface,
  !> which is where its force is zero.
  pure subroutine follow_profile(law, rates, motion, overlap_before, scale, first, w, surface, contact)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    type(motion_type), intent(in) :: motion
    real(dp), intent(in) :: overlap_before, scale  !! scale: width^2/R
    integer(ip), intent(in) :: first
    real(dp), intent(inout) :: w(law%n, law%n_terms), surface(law%n)
    type(normal_type), intent(inout) :: contact
    real(dp), dimension(lanes) :: before, held, pull, pressed, gap, move, f
    real(dp) :: entered
    integer(ip) :: i, j, k

    j = first - 1
    held = 0
    pull = 0
    do k = 1, law%n_terms
      !$omp simd
      do i = 1, lanes
        held(i) = held(i) + law%g(k)*w(j + i, k)
        pull(i) = pull(i) + law%g(k)*rates%decay(k)*w(j + i, k)
        contact%decay(j + i, k) = rates%decay(k)
        contact%gain(j + i, k) = rates%gain(k)
      end do
    end do
    !$omp simd
    do i = 1, lanes
      before(i) = max(overlap_before - law%y(j + i)*scale, -held(i)*law%compliance)
    end do
    if (law%surface /= 0) before = surface(first:j + lanes)
    entered = 0
    !$omp simd reduction(+: entered)
    do i = 1, lanes
      move(i) = -(law%g_inf*before(i) + pull(i))*rates%compliance ! of the free surface
      gap(i) = (overlap_before - law%y(j + i)*scale) - before(i)
      pressed(i) = (motion%overlap - law%y(j + i)*scale) - before(i) - move(i)
      contact%touch(j + i) = merge(1.0_dp, 0.0_dp, pressed(i) > 0)
      move(i) = move(i) + max(pressed(i), 0.0_dp)
      entered = entered + min(gap(i), 0.0_dp)*contact%touch(j + i)
      f(i) = law%g_inf*(before(i) + move(i)) + law%eta*motion%velocity
    end do
    do i = 1, merge(lanes, 0_ip, entered < 0)
      if (gap(i) < 0 .and. pressed(i) > 0) call enter(law, rates, pressed(i)/(pressed(i) - gap(i)), j + i, contact)
    end do
    do k = 1, law%n_terms
      !$omp simd
      do i = 1, lanes
        w(j + i, k) = contact%decay(j + i, k)*w(j + i, k) + contact%gain(j + i, k)*move(i)
        f(i) = f(i) + law%g(k)*w(j + i, k)
      end do
    end do
    if (law%surface /= 0) surface(first:j + lanes) = before + move
    !$omp simd
    do i = 1, lanes
      contact%f(j + i) = merge(max(f(i), 0.0_dp), 0.0_dp, pressed(i) > 0)
    end do
  end subroutine follow_profile

  !> An element that was reached within the step: its arms have had only a part of it.
  pure subroutine enter(law, rates, part, j, contact)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: part
    integer(ip), intent(in) :: j
    type(normal_type), intent(inout) :: contact
    real(dp), parameter :: least = 1.0e-9_dp
    real(dp) :: bend
    integer(ip) :: k
    contact%touch(j) = max(least, part)
    do k = 1, law%n_terms
      call arm_of(contact%touch(j)*rates%step, law%tau(k), contact%decay(j, k), contact%gain(j, k), bend)
    end do
  end subroutine enter

  !> The viscous force at the velocity of the end of the step. An element whose force this makes
  !> tensile leaves the contact at once.
  pure subroutine feel_end_velocity(law, rates, change, w, surface, contact)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: change
    real(dp), intent(inout) :: w(law%n, law%n_terms), surface(law%n)
    type(normal_type), intent(inout) :: contact
    real(dp) :: back
    integer(ip) :: j, k
    do j = 1, contact%last
      if (.not. contact%touch(j) > 0) cycle
      contact%f(j) = contact%f(j) + rates%viscosity*change
      back = max(0.0_dp, -contact%f(j))*rates%compliance
      if (.not. contact%f(j) > 0) contact%touch(j) = 0
      contact%f(j) = max(0.0_dp, contact%f(j))
      do k = 1, law%n_terms
        w(j, k) = w(j, k) + rates%bend(k)*change + rates%gain(k)*back
      end do
      if (law%surface /= 0) surface(j) = surface(j) + back
    end do
    do while (contact%last > 0)
      if (contact%f(contact%last) > 0) exit
      contact%last = contact%last - 1
    end do
  end subroutine feel_end_velocity

  !> Where the contact ends beyond its last element, f there, and the whole force.
  pure subroutine close_rim(law, motion, velocity, width, w, surface, contact)
    type(law_type), intent(in) :: law
    type(motion_type), intent(in) :: motion
    real(dp), intent(in) :: velocity, width
    real(dp), intent(in) :: w(law%n, law%n_terms), surface(law%n)
    type(normal_type), intent(inout) :: contact
    real(dp) :: y, edge, slope, fall, third, total
    integer(ip) :: last, j
    contact%force = 0
    contact%at_rim = 0
    last = contact%last
    if (last == 0) return
    contact%rim_ratio = 0
    y = law%y(last)
    edge = motion%overlap*motion%radius/width**2 ! places are in y of the grid
    slope = 0 ! of f between the last two elements
    if (last > 1) slope = (contact%f(last - 1) - contact%f(last))*law%per_cell(last)
    if (motion%velocity > 0 .and. is_virgin(law, last + 1, w, surface)) then
      call rise_at_rim(law, velocity, (edge - y)*width**2/motion%radius, w, contact)
    else
      fall = merge(slope, law%g_inf*width**2/motion%radius, slope > 0)
      if (contact%f(last) < fall*(edge - y)) then
        edge = y + contact%f(last)/fall
      else if (last > 1) then
        contact%at_rim = max(0.0_dp, contact%f(last) - slope*(edge - y))
      end if
    end if
    if (last < law%n .and. edge > law%y(last + 1)) then
      edge = law%y(last + 1)
      if (.not. contact%at_rim > 0 .and. last > 1) contact%at_rim = max(0.0_dp, contact%f(last) - slope*(edge - y))
    end if
    contact%edge = sqrt(max(edge, y))
    third = 0
    if (contact%edge > law%x(last)) third = (contact%edge - law%x(last))/(3*(contact%edge + law%x(last)))
    contact%inner = third*(2*contact%edge + law%x(last)) - law%outwards(last)
    contact%outer = third*(2*law%x(last) + contact%edge)
    total = 0
    !$omp simd reduction(+: total)
    do j = 1, law%n
      total = total + law%weight(j)*contact%f(j)
    end do
    contact%force = law%normal*width*(total + contact%inner*contact%f(last) + contact%outer*contact%at_rim)
  end subroutine close_rim

  !> No element from there on has ever been touched.
  pure function is_virgin(law, j, w, surface)
    type(law_type), intent(in) :: law
    integer(ip), intent(in) :: j
    real(dp), intent(in) :: w(law%n, law%n_terms), surface(law%n)
    logical :: is_virgin
    integer(ip) :: k
    is_virgin = .true.
    if (j > law%n) return
    do k = 1, law%n_terms
      if (abs(w(j, k)) > 0) is_virgin = .false.
    end do
    if (law%surface /= 0) is_virgin = is_virgin .and. .not. abs(surface(j)) > 0
  end function is_virgin

  !> A growing contact: behind its edge elongations rise over a length of tau times the velocity,
  !> which may be less than a cell: w ~ 1 - exp(-z), with z from the edge in units of tau v. The
  !> value at the edge is chosen so that linear interpolation has the same integral over the cell,
  !> 2/(1 - exp(-z)) - 2/z - 1 of w at the last element, within 0.007. Its z is known from w there,
  !> which is the part q = (1 - exp(-z))/z of the width of the cell: so the rate of growth is not
  !> lost when a contact stops growing.
  pure subroutine rise_at_rim(law, velocity, cell, w, contact)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: velocity, cell, w(law%n, law%n_terms)
    type(normal_type), intent(inout) :: contact
    real(dp) :: q
    integer(ip) :: k
    contact%at_rim = law%eta*velocity
    do k = 1, law%n_terms
      q = max(0.0_dp, min(w(contact%last, k), cell))/max(cell, tiny(cell))
      contact%rim_ratio(k) = (1 - q)/(1 + q*(1 + q*(2.83_dp - 1.83_dp*q)))
      contact%at_rim = contact%at_rim + law%g(k)*w(contact%last, k)*contact%rim_ratio(k)
    end do
    contact%at_rim = max(0.0_dp, contact%at_rim)
  end subroutine rise_at_rim
end module rst_contact_normal
