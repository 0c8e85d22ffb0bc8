!> The history of an impact by the method `sync`: what its levels say, continued between them.
!>
!> At a level depth, velocities and forces are known, and forces are accelerations: depth and velocities are Hermite's cubics
!> between levels, and a force is the slope of the cubic of its velocity. The edge is sqrt(D) while the contact grows; later
!> A^2 is a cubic too, with the rate of THEORY 4.11. The stick radius is a part of the contact radius that changes
!> linearly. Before the contact sticks for the first time, and without friction, x follows from z (THEORY 4.1).
module rst_sync_record
  use rst_precision, only: dp, ip
  use rst_sync_levels, only: level_type, node_type
  use rst_sync_dense, only: trace_type
  use rst_sync_elements, only: scene_type, shear_type, step_type, term_type, columns
  use rst_sync_edge, only: stick_radius
  use rst_sync_shear, only: start_shear, advance_shear
  use rst_cubic, only: cubic_type, cubic_between, cubic_value, cubic_slope
  implicit none (type, external)
  private
  public :: knot_type, sample_type, trace_shear, edge_rates, sample_impact

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp

  !> The contact point at a level, or where the contact sticks for the first time. stick: stick over contact radius.
  !> Twin of `struct sync_knot` in C.
  type, bind(c) :: knot_type
    real(dp) :: time, velocity, force, stick
  end type knot_type

  !> Twin of `struct rst_sample` in C; shear_velocity is U'.
  type, bind(c) :: sample_type
    real(dp) :: time, indentation, contact_radius, stick_radius, normal_force, shear_force, velocity, shear_velocity
  end type sample_type

contains

  !> Follow the contact point from where it first sticks to the end.
  subroutine trace_shear(scene, g, tau, level, trace, node, body, beta, faded, term, n_knots, knot)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(out) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    integer(ip), intent(out) :: n_knots
    type(knot_type), intent(out) :: knot(0:2*scene%n)
    type(shear_type) :: state
    integer(ip) :: i
    call start_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
    knot(0) = knot_type(state%time, state%velocity, state%force, 1.0_dp)
    i = 0
    do while (state%level < 2*scene%n)
      call advance_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
      i = i + 1
      knot(i) = knot_type(state%time, state%velocity, state%force, stick_share(scene, level, trace, node, body, beta, faded, term, &
                                                                               state))
    end do
    knot(i)%stick = knot(i - 1)%stick  ! of nothing
    n_knots = i + 1
  end subroutine trace_shear

  !> Stick radius over contact radius at the level reached. While the edge sticks as it moves out, all does unless slip begins
  !> further in.
  pure function stick_share(scene, level, trace, node, body, beta, faded, term, state) result(share)
    type(scene_type), intent(in) :: scene
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(in), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(in) :: term(scene%n_terms)
    type(shear_type), intent(in) :: state
    real(dp) :: share
    type(step_type) :: step
    integer(ip) :: l, edge
    l = state%level
    edge = min(l, 2*scene%n - l)
    share = 1
    if (edge == 0 .or. scene%no_slip /= 0) return
    if (l <= scene%n .and. state%front >= edge - 1 .and. abs(state%velocity) <= level(l)%velocity) return
    step%f = level(l)%fresh
    step%q = scene%g_inf*state%shift + scene%eta*state%velocity + sum(term%stress)
    step%n_terms = scene%n_terms
    step%last = edge - 1
    share = stick_radius(scene, edge, node, trace, term, step, body, beta, faded, state)/node(edge)%radius
    share = max(0.0_dp, min(1.0_dp, share))
  end function stick_share

  !> d(A^2)/ds at the levels n to 2n (THEORY 4.11).
  pure subroutine edge_rates(scene, g, tau, level, trace, rate)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    real(dp), intent(out) :: rate(scene%n:2*scene%n)
    real(dp) :: slope, modulus
    integer(ip) :: l, j, k
    do l = scene%n, 2*scene%n
      j = 2*scene%n - l
      slope = scene%g_inf*level(l)%velocity - scene%eta*mass_factor*level(l)%force
      modulus = scene%g_inf
      do k = 1, scene%n_terms
        slope = slope + g(k)*level(l)%velocity - (trace(k, l)%memory - trace(k, l)%fade*trace(k, j)%memory)/tau(k)
        modulus = modulus + g(k)*trace(k, l)%fade
      end do
      rate(l) = slope/max(modulus, 1.0e-100_dp)
    end do
  end subroutine edge_rates

  !> The impact at a time between the levels l and l+1. Forces are those over X > 0 times 15/8. slides: /= 0 if it slips before
  !> it sticks.
  pure subroutine sample_impact(scene, slides, level, node, rate, n_knots, knot, l, i, time, sample)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: slides, n_knots, l
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(in) :: rate(scene%n:2*scene%n), time
    type(knot_type), intent(in) :: knot(0:2*scene%n)
    integer(ip), intent(in) :: i  !! time is between the knots i and i+1, -1: before all of them
    type(sample_type), intent(out) :: sample
    type(cubic_type) :: depth, velocity
    real(dp) :: h, t, pull0, pull1
    h = level(l + 1)%step
    t = time - level(l)%time
    if (l == 2*scene%n - 1 .and. time >= level(l + 1)%time) t = h
    pull0 = -mass_factor*level(l)%force
    pull1 = -mass_factor*level(l + 1)%force
    depth = cubic_between(h, level(l)%depth, level(l + 1)%depth, level(l)%velocity, level(l + 1)%velocity)
    velocity = cubic_between(h, level(l)%velocity, level(l + 1)%velocity, pull0, pull1)
    sample%time = time
    sample%indentation = min(cubic_value(depth, t), level(scene%n)%depth)
    sample%velocity = cubic_value(velocity, t)
    sample%normal_force = max(0.0_dp, -cubic_slope(velocity, t))
    if (l < scene%n) then
      sample%contact_radius = sqrt(max(0.0_dp, sample%indentation))
    else
      sample%contact_radius = edge_between(h, t, node(2*scene%n - l)%radius, node(2*scene%n - l - 1)%radius, rate(l), &
                                           rate(l + 1))
    end if
    if (i >= 0) then
      call sample_shear(scene, n_knots, knot, i, sample)
    else
      sample%stick_radius = 0
      sample%shear_force = merge(sample%normal_force, 0.0_dp, slides /= 0)
      sample%shear_velocity = scene%psi
      if (slides /= 0) sample%shear_velocity = scene%psi - 2*scene%chi*(1 - sample%velocity)
    end if
  end subroutine sample_impact

  !> Slopes beyond three times the mean one would let the cubic turn back.
  pure function edge_between(h, t, a0, a1, rate0, rate1) result(a)
    real(dp), intent(in) :: h, t, a0, a1, rate0, rate1
    real(dp) :: a, steepest
    steepest = 3*(a1*a1 - a0*a0)/h
    a = cubic_value(cubic_between(h, a0*a0, a1*a1, max(steepest, min(0.0_dp, rate0)), max(steepest, min(0.0_dp, rate1))), t)
    a = sqrt(max(a1*a1, min(a0*a0, a)))
  end function edge_between

  pure subroutine sample_shear(scene, n_knots, knot, i, sample)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: n_knots, i
    type(knot_type), intent(in) :: knot(0:n_knots - 1)
    type(sample_type), intent(inout) :: sample
    type(cubic_type) :: velocity
    real(dp) :: h, t, push
    push = -2*mass_factor*scene%chi
    h = knot(i + 1)%time - knot(i)%time
    t = max(0.0_dp, sample%time - knot(i)%time)
    if (i == n_knots - 2 .and. sample%time >= knot(i + 1)%time) t = h
    velocity = cubic_between(h, knot(i)%velocity, knot(i + 1)%velocity, push*knot(i)%force, push*knot(i + 1)%force)
    sample%shear_velocity = cubic_value(velocity, t)
    sample%shear_force = -cubic_slope(velocity, t)/(2*scene%chi)
    if (scene%no_slip == 0) sample%shear_force = max(-sample%normal_force, min(sample%normal_force, sample%shear_force))
    sample%stick_radius = sample%contact_radius*(knot(i)%stick + (knot(i + 1)%stick - knot(i)%stick)*t/h)
  end subroutine sample_shear
end module rst_sync_record
