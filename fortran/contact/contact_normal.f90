!> The normal problem of a step: every element either follows the profile of the sphere or, where that would pull, its own free
!> surface (docs/contact.md). Entry, exit and re-entry on a surface that has not relaxed are one line, without flags.
module rst_contact_normal
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, rates_type, motion_type, most_nodes, most_terms, lanes
  use rst_contact_grid, only: weight, integral
  use rst_contact_rates, only: arm_of, relief
  implicit none (type, external)
  private
  public :: normal_type, press, strain

  !> What the tangential problem needs.
  type :: normal_type
    integer(ip) :: last              !! outermost element in contact; 0: none
    logical :: entered               !! some element has entered in this step
    real(dp) :: f(most_nodes)        !! force density in units of law%normal
    real(dp) :: part(most_nodes)     !! of the step in contact, 0 outside
    real(dp) :: edge                 !! contact radius in grid widths
    real(dp) :: inner, outer         !! weights of the last, cut cell: of the last element (beside its law%weight), of the rim
    real(dp) :: at_rim               !! f at the rim
    real(dp) :: rise(most_terms)     !! w at the rim over that of the last element
    real(dp) :: force
  end type normal_type

contains

  pure subroutine press(law, rates, motion, overlap_before, width, state, contact)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    type(motion_type), intent(in) :: motion
    real(dp), intent(in) :: overlap_before, width
    real(dp), intent(inout) :: state(*)
    type(normal_type), intent(out) :: contact
    real(dp) :: change, rim, carried
    call follow_profile(law, rates, motion, law%n, law%n_terms, width**2/motion%radius, overlap_before, state(law%at%w_z), &
                        state(law%at%u_z), contact)
    call close_rim(law, motion, motion%velocity, width, state(law%at%w_z), state(law%at%u_z), contact)
    if (.not. rates%drag > 0 .or. contact%last == 0) return
    rim = width*contact%edge ! the equilibrium spring carries what does not accelerate, such as a weight at rest
    carried = law%normal*law%g_inf*rim*(motion%overlap - rim**2/(3*motion%radius))
    change = -relief(motion%mobility(1), law%normal*rim*rates%drag)*(contact%force - carried)
    call feel_end_velocity(law, rates, change, law%n, law%n_terms, state(law%at%w_z), state(law%at%u_z), contact)
    call close_rim(law, motion, motion%velocity + change, width, state(law%at%w_z), state(law%at%u_z), contact)
  end subroutine press

  !> All elements over the step. An element enters where the profile reaches its free surface, which is where its force is zero.
  pure subroutine follow_profile(law, rates, motion, n, n_terms, scale, overlap_before, w, surface, contact)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    type(motion_type), intent(in) :: motion
    integer(ip), intent(in) :: n, n_terms
    real(dp), intent(in) :: scale, overlap_before  !! scale: width^2/R
    real(dp), intent(inout) :: w(n, n_terms), surface(n)
    type(normal_type), intent(inout) :: contact
    real(dp), dimension(most_nodes) :: before, pressed, move
    real(dp), dimension(lanes) :: held, pull
    real(dp) :: free, y, gap, missed
    integer(ip) :: first, i, j, k

    missed = 0
    do first = 0, n - 1, lanes
      held = 0
      pull = 0
      do k = 1, n_terms
        do i = 1, lanes
          held(i) = held(i) + law%g(k)*w(first + i, k)
          pull(i) = pull(i) + (law%g(k)*rates%decay(k))*w(first + i, k)
        end do
      end do
      if (law%surface /= 0) then
        before(first + 1:first + lanes) = surface(first + 1:first + lanes)
      else
        do i = 1, lanes
          before(first + i) = max(overlap_before - law%y(first + i)*scale, -held(i)*law%softness)
        end do
      end if
      !$omp simd private(y, free, gap, j) reduction(+: missed)
      do i = 1, lanes
        j = first + i
        y = law%y(j)*scale
        gap = (overlap_before - y) - before(j)
        free = -(law%g_inf*before(j) + pull(i))*rates%softness
        move(j) = (motion%overlap - y) - before(j)
        pressed(j) = move(j) - free
        contact%part(j) = merge(1.0_dp, 0.0_dp, pressed(j) > 0)
        move(j) = max(move(j), free)
        missed = missed + min(gap, 0.0_dp)*contact%part(j)
        contact%f(j) = law%g_inf*(before(j) + move(j)) + law%eta*motion%velocity
      end do
    end do
    contact%entered = missed < 0
    if (contact%entered) call enter(law, n, overlap_before, scale, before, pressed, contact%part)
    do k = 1, n_terms
      call strain(law, rates, k, n, contact%entered, contact%part, move, w(:, k), contact%f)
    end do
    if (law%surface /= 0) surface = before(1:n) + move(1:n)
    do first = 0, n - 1, lanes
      do j = first + 1, first + lanes
        contact%f(j) = merge(max(contact%f(j), 0.0_dp), 0.0_dp, contact%part(j) > 0)
      end do
    end do
    contact%last = n
    do while (contact%last > 0)
      if (contact%part(contact%last) > 0) exit
      contact%last = contact%last - 1
    end do
  end subroutine follow_profile

  !> The part of the step for which elements that have entered in it are in contact.
  pure subroutine enter(law, n, overlap_before, scale, before, pressed, part)
    type(law_type), intent(in) :: law
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: overlap_before, scale, before(n), pressed(n)
    real(dp), intent(inout) :: part(n)
    real(dp), parameter :: least = 1.0e-9_dp
    real(dp) :: gap
    integer(ip) :: j
    do j = 1, n
      gap = overlap_before - law%y(j)*scale - before(j)
      if (part(j) > 0 .and. gap < 0) part(j) = max(least, pressed(j)/(pressed(j) - gap))
    end do
  end subroutine enter

  !> One arm of all elements, and its force; those that have entered in the step have had less time.
  pure subroutine strain(law, rates, k, n, entered, part, move, w, f)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    integer(ip), intent(in) :: k, n
    logical, intent(in) :: entered
    real(dp), intent(in) :: part(n), move(n)
    real(dp), intent(inout) :: w(n), f(n)
    real(dp) :: decay, gain, bend
    integer(ip) :: first, j
    if (entered) then
      do j = 1, n
        decay = rates%decay(k)
        gain = rates%gain(k)
        if (part(j) > 0 .and. part(j) < 1) call arm_of(part(j)*rates%step, law%tau(k), decay, gain, bend)
        w(j) = decay*w(j) + gain*move(j)
        f(j) = f(j) + law%g(k)*w(j)
      end do
    else
      do first = 0, n - 1, lanes
        do j = first + 1, first + lanes
          w(j) = rates%decay(k)*w(j) + rates%gain(k)*move(j)
          f(j) = f(j) + law%g(k)*w(j)
        end do
      end do
    end if
  end subroutine strain

  !> The viscous force at the velocity of the end of the step. An element that this would make pull springs back at once.
  pure subroutine feel_end_velocity(law, rates, change, n, n_terms, w, surface, contact)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    real(dp), intent(in) :: change
    integer(ip), intent(in) :: n, n_terms
    real(dp), intent(inout) :: w(n, n_terms), surface(n)
    type(normal_type), intent(inout) :: contact
    real(dp) :: back
    integer(ip) :: j, k
    do j = 1, contact%last
      if (.not. contact%part(j) > 0) cycle
      contact%f(j) = contact%f(j) + rates%drag*change
      back = 0
      if (contact%f(j) <= 0) then
        back = -contact%f(j)*rates%softness
        contact%f(j) = 0
        contact%part(j) = 0
      end if
      do k = 1, n_terms
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
    real(dp) :: scale, edge, beyond, slope, fall
    integer(ip) :: last
    contact%force = 0
    contact%at_rim = 0
    contact%rise = 0
    last = contact%last
    if (last == 0) return
    scale = width**2/motion%radius
    beyond = law%y(last)*scale ! y of the last element, of the next one, slope of f between the last two
    slope = 0
    if (last > 1) slope = (contact%f(last - 1) - contact%f(last))/((law%y(last) - law%y(last - 1))*scale)
    if (motion%velocity > 0 .and. is_virgin(law, last + 1, w, surface)) then
      edge = motion%overlap
      call rise_at_rim(law, velocity, edge - beyond, w, contact)
    else
      edge = motion%overlap
      fall = merge(slope, law%g_inf, slope > 0)
      if (contact%f(last) < fall*(edge - beyond)) then
        edge = beyond + contact%f(last)/fall
      else if (last > 1) then
        contact%at_rim = max(0.0_dp, contact%f(last) - slope*(edge - beyond))
      end if
    end if
    if (last < law%n .and. edge > law%y(last + 1)*scale) then
      edge = law%y(last + 1)*scale
      if (.not. contact%at_rim > 0 .and. last > 1) contact%at_rim = max(0.0_dp, contact%f(last) - slope*(edge - beyond))
    end if
    contact%edge = sqrt(max(edge/scale, law%y(last)))
    contact%inner = weight(law%x(last), contact%edge) - law%outwards(last)
    contact%outer = weight(contact%edge, law%x(last))
    contact%force = law%normal*width*(integral(law, contact%f) + contact%inner*contact%f(last) + contact%outer*contact%at_rim)
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

  !> A contact that grows: behind the rim elongations rise within tau times the velocity, which may be less than a cell:
  !> w ~ 1 - exp(-z), z from the rim in tau v. The value at the rim is the one whose linear interpolation has the integral of that
  !> over the cell, 2/(1 - exp(-z)) - 2/z - 1 of w at the last element, within 0.007. Its z is known from w there, which is the part
  !> q = (1 - exp(-z))/z of the width of the cell: so a contact that stops to grow does not forget how fast it did.
  pure subroutine rise_at_rim(law, velocity, cell, w, contact)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: velocity, cell, w(law%n, law%n_terms)
    type(normal_type), intent(inout) :: contact
    real(dp) :: q
    integer(ip) :: k
    contact%at_rim = law%eta*velocity
    do k = 1, law%n_terms
      q = max(0.0_dp, min(w(contact%last, k), cell))/max(cell, tiny(cell))
      contact%rise(k) = (1 - q)/(1 + q*(1 + q*(2.83_dp - 1.83_dp*q)))
      contact%at_rim = contact%at_rim + law%g(k)*w(contact%last, k)*contact%rise(k)
    end do
    contact%at_rim = max(0.0_dp, contact%at_rim)
  end subroutine rise_at_rim
end module rst_contact_normal
