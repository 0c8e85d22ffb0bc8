! SPDX-License-Identifier: BSD-3-Clause
!> The normal side for the method `cvode`: rates of the sphere's motion and of the memory
!> (docs/sync.md, section 1).
!>
!> States are the depth D, its velocity and, a relaxation time, the stress of a term that follows
!> the sphere (M' = g D' - M/tau) and its integral over the elements in contact (P' = g A D' -
!> P/tau, compression only). Those of single elements follow: the one at X, entered at t_X, carries
!> M(s) - exp(-(s-t_X)/tau) M(t_X). In restitution the edge is where the whole stress vanishes,
!>
!>   G_inf (D - B) + sum_k [M_k(s) - E_k M_k(t_A)] + eta D' = 0,   E_k = exp(-(s-t_A)/tau_k),  B = A^2 = D(t_A),
!>
!> and the force is int_0^A f dX = (2/3) G_inf A^3 + sum_k E_k P_k(t_A). The edge is solved for, so
!> it is no state; since f(A) = 0 it does not appear in the derivatives of the force either: those
!> are A times G_inf, eta and 1.
module rst_cvode_contact
  use rst_cvode_types, only: scene_type, contact_type, state_depth, state_velocity, memory_at, loading_at
  use rst_motion_factors, only: mass_factor
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: normal_rates, past_of, hermite

contains

  !> Rates of the normal states and where the contact is. knot: time, depth, velocity during the
  !> compression, memory: M and P then; both are read in restitution alone. `near`: where the search
  !> starts, kept between calls.
  subroutine normal_rates(scene, g, tau, knot, memory, near, t, y, rate, contact) bind(c, name="rst_cvode_normal_rates")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    real(dp), intent(in) :: knot(3, scene%n_knots), memory(2*scene%n_terms, scene%n_knots)
    integer(ip), intent(inout) :: near
    real(dp), intent(in), value :: t
    real(dp), intent(in) :: y(scene%n_states)
    real(dp), intent(inout) :: rate(scene%n_states)
    type(contact_type), intent(out) :: contact
    real(dp) :: velocity
    integer(ip) :: k, m, p

    velocity = y(state_velocity)
    if (scene%restitution /= 0) then
      call unloading(scene, g, tau, knot, memory, near, t, y, contact)
    else
      call loading(scene, y, contact)
    end if
    rate(state_depth) = velocity
    rate(state_velocity) = -mass_factor*contact%force
    do k = 1, scene%n_terms
      m = memory_at(k)
      p = loading_at(scene, k)
      rate(m) = g(k)*velocity - y(m)/tau(k)
      rate(p) = 0
      if (scene%restitution == 0) rate(p) = g(k)*contact%radius*velocity - y(p)/tau(k)
    end do
  end subroutine normal_rates

  !> Compression: A = sqrt(D) and the force is the sum of the states.
  pure subroutine loading(scene, y, contact)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: y(scene%n_states)
    type(contact_type), intent(out) :: contact
    integer(ip) :: k
    contact%square = y(state_depth)
    contact%radius = sqrt(max(contact%square, 0.0_dp))
    contact%force = 2.0_dp/3.0_dp*scene%g_inf*contact%radius**3 + scene%eta*contact%radius*y(state_velocity)
    do k = 1, scene%n_terms
      contact%force = contact%force + y(loading_at(scene, k))
    end do
  end subroutine loading

  !> Restitution: find the edge. The force follows from the state of the compression when the edge
  !> was at the same place.
  subroutine unloading(scene, g, tau, knot, memory, near, t, y, contact)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    real(dp), intent(in) :: knot(3, scene%n_knots), memory(2*scene%n_terms, scene%n_knots)
    integer(ip), intent(inout) :: near
    real(dp), intent(in) :: t, y(scene%n_states)
    type(contact_type), intent(out) :: contact
    real(dp) :: entered, depth, residual, stiffness, weight(4), past
    integer(ip) :: k, j

    call bracket(scene, g, tau, knot, memory, t, y, near)
    call edge_time(scene, g, tau, knot, memory, near, t, y, entered)
    call balance(scene, g, tau, knot, memory, near, t, y, entered, depth, residual, stiffness)
    ! a completely relaxed solid loses contact at once: not farther than the width of the contact
    past = residual/max(stiffness, abs(residual)/knot(2, scene%n_knots), tiny(1.0_dp))
    contact%square = depth + past
    contact%radius = sqrt(max(contact%square, 0.0_dp))
    contact%force = 0
    if (contact%square <= 0) return
    contact%force = 2.0_dp/3.0_dp*scene%g_inf*contact%radius**3
    call weights(scene, knot, near, entered, j, weight)
    do k = 1, scene%n_terms
      past = dot_product(weight, memory(scene%n_terms + k, j:j + 3))
      contact%force = contact%force + exp(-max(t - entered, 0.0_dp)/tau(k))*past
    end do
  end subroutine unloading

  !> The residual of the edge condition for an edge that was passed at time `entered` of the
  !> interval near, near + 1; the depth at that time and the stiffness of an element of that age.
  pure subroutine balance(scene, g, tau, knot, memory, near, t, y, entered, depth, residual, stiffness)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    real(dp), intent(in) :: knot(3, scene%n_knots), memory(2*scene%n_terms, scene%n_knots)
    integer(ip), intent(in) :: near
    real(dp), intent(in) :: t, y(scene%n_states), entered
    real(dp), intent(out) :: depth, residual, stiffness
    real(dp) :: weight(4), faded, slope
    integer(ip) :: k, j
    call hermite(knot(:, near), knot(:, near + 1), entered, depth, slope)
    residual = scene%g_inf*(y(state_depth) - depth) + scene%eta*y(state_velocity)
    stiffness = scene%g_inf
    if (scene%n_terms == 0) return
    call weights(scene, knot, near, entered, j, weight)
    do k = 1, scene%n_terms
      faded = exp(-max(t - entered, 0.0_dp)/tau(k))  ! this run may have turned before the one that left the knots
      residual = residual + y(memory_at(k)) - faded*dot_product(weight, memory(k, j:j + 3))
      stiffness = stiffness + g(k)*faded
    end do
  end subroutine balance

  !> Move `near` to the interval in which the residual changes sign, or to the first or the last
  !> one.
  pure subroutine bracket(scene, g, tau, knot, memory, t, y, near)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    real(dp), intent(in) :: knot(3, scene%n_knots), memory(2*scene%n_terms, scene%n_knots)
    real(dp), intent(in) :: t, y(scene%n_states)
    integer(ip), intent(inout) :: near
    real(dp) :: depth, residual, stiffness
    near = max(1_ip, min(near, scene%n_knots - 1))
    do while (near > 1)
      call balance(scene, g, tau, knot, memory, near, t, y, knot(1, near), depth, residual, stiffness)
      if (residual >= 0) exit
      near = near - 1
    end do
    do while (near < scene%n_knots - 1)
      call balance(scene, g, tau, knot, memory, near, t, y, knot(1, near + 1), depth, residual, stiffness)
      if (residual < 0) exit
      near = near + 1
    end do
  end subroutine bracket

  !> The time when the depth was that of the present edge: Newton's method, kept inside the
  !> interval.
  pure subroutine edge_time(scene, g, tau, knot, memory, near, t, y, entered)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    real(dp), intent(in) :: knot(3, scene%n_knots), memory(2*scene%n_terms, scene%n_knots)
    integer(ip), intent(in) :: near
    real(dp), intent(in) :: t, y(scene%n_states)
    real(dp), intent(out) :: entered
    real(dp) :: low, high, depth, residual, stiffness, slope, next
    integer(ip) :: i
    low = knot(1, near)
    high = knot(1, near + 1)
    entered = low
    do i = 1, 60
      call balance(scene, g, tau, knot, memory, near, t, y, entered, depth, residual, stiffness)
      if (residual >= 0) low = entered
      if (residual < 0) high = entered
      call hermite(knot(:, near), knot(:, near + 1), entered, depth, slope)
      slope = stiffness*slope
      next = 0.5_dp*(low + high)
      if (slope > 0) next = entered + residual/slope
      if (next > high .and. i == 1) next = high
      if (next < low .or. next > high) next = 0.5_dp*(low + high)
      if (abs(next - entered) <= 4*epsilon(1.0_dp)*knot(1, near + 1)) return
      entered = next
      ! one Newton step in B removes the remaining residual up to its square
      if (abs(residual) <= 1.0e-9_dp*stiffness*depth) return
    end do
  end subroutine edge_time

  !> M and P of the compression at a time.
  subroutine past_of(scene, knot, memory, t, past) bind(c, name="rst_cvode_past")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: knot(3, scene%n_knots), memory(2*scene%n_terms, scene%n_knots)
    real(dp), intent(in), value :: t
    real(dp), intent(out) :: past(2*scene%n_terms)
    real(dp) :: weight(4)
    integer(ip) :: low, high, middle, j, k
    low = 1
    high = scene%n_knots
    do while (high - low > 1)
      middle = (low + high)/2
      if (knot(1, middle) <= t) then
        low = middle
      else
        high = middle
      end if
    end do
    call weights(scene, knot, low, t, j, weight)
    do k = 1, 2*scene%n_terms
      past(k) = dot_product(weight, memory(k, j:j + 3))
    end do
  end subroutine past_of

  !> Lagrange's cubic through four knots around an interval; it needs no slope of a term that
  !> relaxes at once.
  pure subroutine weights(scene, knot, near, t, first, weight)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: knot(3, scene%n_knots), t
    integer(ip), intent(in) :: near
    integer(ip), intent(out) :: first
    real(dp), intent(out) :: weight(4)
    integer(ip) :: i, j
    first = max(1_ip, min(near - 1, scene%n_knots - 3))
    do i = 1, 4
      weight(i) = 1
      do j = 1, 4
        if (j /= i) weight(i) = weight(i)*(t - knot(1, first + j - 1))/(knot(1, first + i - 1) - knot(1, first + j - 1))
      end do
    end do
  end subroutine weights

  !> Hermite's cubic through depth and velocity at both ends, and its slope.
  pure subroutine hermite(before, after, t, depth, slope) bind(c, name="rst_cvode_hermite")
    real(dp), intent(in) :: before(3), after(3)
    real(dp), intent(in), value :: t
    real(dp), intent(out) :: depth, slope
    real(dp) :: h, x, a, b
    h = after(1) - before(1)
    x = (t - before(1))/h
    a = 3*(after(2) - before(2)) - h*(2*before(3) + after(3))
    b = 2*(before(2) - after(2)) + h*(before(3) + after(3))
    depth = before(2) + x*(h*before(3) + x*(a + x*b))
    slope = before(3) + x*(2*a + 3*x*b)/h
  end subroutine hermite
end module rst_cvode_contact
