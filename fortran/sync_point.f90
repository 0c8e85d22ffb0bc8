!> The contact point of the method `sync` in a step from level to level: what answers a force, and what follows from it.
module rst_sync_point
  use rst_precision, only: dp, ip
  use rst_sync_levels, only: level_type
  use rst_sync_dense, only: trace_type, fade_in_step
  use rst_sync_elements, only: scene_type, term_type
  use rst_sync_quadrature, only: shortest_start
  implicit none (type, external)
  private
  public :: point_type, span_type, measure_span, note_span, slack_at

  !> Where the contact point is at a level, and the sums over the nodes that stick, 0 to front (module rst_sync_front).
  type :: point_type
    real(dp) :: time, shift, velocity
    real(dp) :: force, force_before(2)    !! S here and at the two levels before
    real(dp) :: step_before(2)            !! the steps that ended here and at the level before
    real(dp) :: slope                     !! of S, and of int_0^A f dX, at the end of gross slip
    real(dp) :: normal, normal_before(2)  !! int_0^A f dX here and at the two levels before
    real(dp) :: sinking, fresh            !! D' and f_0
    real(dp) :: weight, alpha             !! sums over the nodes that stick
    real(dp) :: side                      !! d; 0: all stick
    real(dp) :: slack, slack_before       !! y at the centre, here and at the level before; 0: not known
    integer(ip) :: level, known, front    !! known: how many steps were made, up to 3
    integer(ip) :: onset, turned          !! level from which on it slips on that side; how often that has changed
  end type point_type

  !> A step: responses of Q to the velocity at its start and at its end and to the bend of the velocity, and Q without the latter
  !> two; half_rate = 1/(2h). Of a slip velocity before, the share 1 - drop goes on.
  type :: span_type
    real(dp) :: h, half_rate, start_response, end_response, bend_response, base, drop
  end type span_type

contains

  !> The step to the next level: whole, or what gross slip has left of it.
  pure subroutine measure_span(m, scene, g, tau, level, trace, p, term, span)
    integer(ip), intent(in) :: m
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(m), tau(m)
    type(level_type), intent(in) :: level(0:1)
    type(trace_type), intent(in) :: trace(m)  !! at the end of the step
    type(point_type), intent(in) :: p
    type(term_type), intent(inout) :: term(m)
    type(span_type), intent(out) :: span
    type(trace_type) :: t
    real(dp) :: spring
    logical :: whole
    integer(ip) :: k
    whole = p%time <= level(0)%time
    span%h = level(1)%step
    if (.not. whole) span%h = level(1)%time - p%time
    span%half_rate = 0.5_dp/span%h
    spring = 0.5_dp*scene%g_inf*span%h
    span%start_response = spring
    span%end_response = spring + scene%eta
    span%bend_response = -spring*span%h**2*(1.0_dp/3.0_dp)
    span%base = spring*p%velocity + scene%g_inf*p%shift
    do k = 1, m
      t = trace(k)
      if (.not. whole) call fade_in_step(g(k), tau(k), span%h, t)
      term(k)%decay = t%decay
      term(k)%from_start = t%from_start
      term(k)%from_end = t%from_end
      term(k)%from_bend = t%from_bend
      span%start_response = span%start_response + t%from_start
      span%end_response = span%end_response + t%from_end
      span%bend_response = span%bend_response + t%from_bend
      term(k)%next_stress = t%decay*term(k)%stress + t%from_start*p%velocity
      span%base = span%base + term(k)%next_stress
      term(k)%beta_sum = t%decay*term(k)%beta_sum
      term(k)%age = t%decay*term(k)%age
    end do
    span%drop = 1
    if (span%start_response < span%end_response) span%drop = span%start_response/span%end_response
  end subroutine measure_span

  !> The contact point at the end of the step.
  pure subroutine note_span(m, scene, span, end, velocity, force, bend, p, term)
    integer(ip), intent(in) :: m
    type(scene_type), intent(in) :: scene
    type(span_type), intent(in) :: span
    type(level_type), intent(in) :: end
    real(dp), intent(in) :: velocity, force, bend
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    real(dp) :: half
    integer(ip) :: k
    half = 0.5_dp*span%h
    p%shift = ((p%shift + half*p%velocity) + half*velocity) - (span%h**3*(1.0_dp/6.0_dp))*bend
    do k = 1, m
      term(k)%stress = (term(k)%next_stress + term(k)%from_end*velocity) + term(k)%from_bend*bend
    end do
    p%velocity = velocity
    p%time = end%time
    p%sinking = end%velocity
    p%fresh = end%fresh
    if (span%h < shortest_start*end%step) p%known = -1 ! as if it had begun here: such differences are none
    p%known = min(3_ip, p%known + 1)
    p%step_before = [span%h, p%step_before(1)]
    p%force_before = [p%force, p%force_before(1)]
    p%force = force
    p%normal_before = [p%normal, p%normal_before(1)]
    p%normal = end%force
    p%slack_before = p%slack
    p%slack = slack_at(m, scene, p, term)
    p%level = p%level + 1
  end subroutine note_span

  !> y at the centre, which has nothing to remember; 0 as long as all sticks.
  pure function slack_at(m, scene, p, term) result(slack)
    integer(ip), intent(in) :: m
    type(scene_type), intent(in) :: scene
    type(point_type), intent(in) :: p
    type(term_type), intent(in) :: term(m)
    real(dp) :: slack
    integer(ip) :: k
    slack = 0
    if (.not. abs(p%side) > 0) return
    slack = scene%g_inf*p%shift + scene%eta*p%velocity
    do k = 1, m
      slack = slack + term(k)%stress
    end do
    slack = p%fresh + p%side*slack
  end function slack_at
end module rst_sync_point
