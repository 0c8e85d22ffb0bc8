!> The tangential problem of the method `sync` behind one front, without stepping elements.
!>
!> In most impacts all that is in contact sticks at first; then slip sets in at the edge, in one direction, and its front moves
!> inwards until all slips or contact ends. An element that sticks has q = Q - alpha - sum_k e_k beta_k with what it was given at
!> its entry and e_k = exp(-(s-t_X)/tau_k) (module rst_sync_shear); one that slips has q = -d f, d = 1 or -1. So with the slack
!>   y = f + d q = f_0 + d Q - (G_inf X^2 + d alpha) - sum_k e_k (M_k + d beta_k),   f_0 = f + G_inf X^2 of an unfading element,
!> smooth in X and zero at the front c, S = int q dX = d (H - int f dX) with H = int_0^c y dX. Sums over the nodes that stick give
!> it, and a node is taken off them when the front passes. From the onset of slip on, alpha and beta stand for G_inf X^2 + d alpha
!> and M_k + d beta_k.
!>
!> Slip velocities, over d, are highest for the element that slipped last: relaxation functions are convex in logarithm, so
!> what an element has gone through before it slipped fades the more slowly the older it is. That element, the sentinel, is
!> stepped, and as long as it goes on slipping, all do. If it does not, `holds` is false: elements have to be stepped.
!>
!> Of term_type, beta_sum is over the nodes that stick, age of the node front + 1, and faded_sum is beta of the sentinel.
module rst_sync_front
  use rst_precision, only: dp, ip
  use rst_sync_levels, only: level_type, node_type, mass_factor
  use rst_sync_dense, only: trace_type
  use rst_sync_elements, only: scene_type, shear_type, term_type
  use rst_sync_quadrature, only: friction_impulse, full_friction, choose_weights, cubic_weights, weighed_in_time, &
                                 explicit_below, most_trials
  use rst_sync_edge, only: weight_of
  use rst_sync_point, only: point_type, span_type, measure_span, note_span
  use rst_sync_hinge, only: hinge, root_left_out
  use rst_sync_slack, only: add_up, speak_of_slack, unseen_force, slacks, pass_node, turn_round
  use rst_sync_sentinel, only: guard_type, step_guard, slips_on
  implicit none (type, external)
  private
  public :: follow_front

  real(dp), parameter :: close_enough = 1.0e-13_dp !! of a force over that of the normal one, where there are more
  !> Part of the slack at the start of a step below which the end of stick, where H has a root, is near.
  real(dp), parameter :: end_is_near = 0.85_dp

  !> Steps from the onset of slip to the end of stick, below which elements, which find kinks within steps, are more accurate; when
  !> slip has turned round, which it does within a step.
  integer(ip), parameter :: fewest_steps = 4, fewest_after_turn = 8

  !> How U' at the end of a step follows from S there: rest - kick S, kick = push weight(0). timely: weights for the part 1 - reach
  !> of the force.
  type :: rule_type
    real(dp) :: push, rest, kick, weight(0:3), timely(0:3), reach, feedback
  end type rule_type

  !> At the end of a step: velocity, its bend in the step, y at the centre, S.
  type :: end_type
    real(dp) :: velocity, bend, slack, force
  end type end_type

contains

  !> From the first stick, at `state`, to the end; state%velocity is U' then, if `holds`.
  subroutine follow_front(scene, g, tau, level, trace, node, term, alpha, beta, state, holds)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    type(term_type), intent(inout) :: term(scene%n_terms)
    real(dp), intent(out) :: alpha(0:scene%n), beta(scene%n_terms, 0:scene%n)  !! of the nodes at their entry
    type(shear_type), intent(inout) :: state
    logical, intent(out) :: holds
    select case (scene%n_terms) ! compilers make code for none and one
    case (0)
      call walk(0_ip, scene, g, tau, level, trace, node, term, alpha, beta, state, holds)
    case (1)
      call walk(1_ip, scene, g, tau, level, trace, node, term, alpha, beta, state, holds)
    case default
      call walk(scene%n_terms, scene, g, tau, level, trace, node, term, alpha, beta, state, holds)
    end select
  end subroutine follow_front

  subroutine walk(m, scene, g, tau, level, trace, node, term, alpha, beta, state, holds)
    integer(ip), intent(in) :: m
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(m), tau(m)
    type(trace_type), intent(in) :: trace(m, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    type(term_type), intent(inout) :: term(m)
    real(dp), intent(out) :: alpha(0:scene%n), beta(m, 0:scene%n)
    type(shear_type), intent(inout) :: state
    logical, intent(out) :: holds
    type(point_type) :: p
    type(guard_type) :: guard
    call begin(scene, state, p)
    if (scene%psi > 1) then
      call begin_together(m, scene, tau, level, trace, node, alpha, beta, p, term)
    else ! the node 0 is touched
      alpha(0) = 0
      beta(:, 0) = 0
      p%weight = weight_of(node, 0_ip)
    end if
    do while (.not. abs(p%side) > 0)
      call stick_step(m, scene, g, tau, level, trace, node, alpha, beta, p, term)
    end do
    holds = .true.
    guard = guard_type()
    do while (p%level < 2*scene%n .and. holds)
      if (p%front < 0) then
        if (slips_on(scene, level(2*scene%n)%velocity, p, guard)) exit
      end if
      call front_step(m, scene, g, tau, level, trace, node, alpha, beta, p, term, guard, holds)
    end do
    state%velocity = p%velocity
    if (holds) state%velocity = p%velocity + 2*mass_factor*scene%chi*p%side*full_friction(scene%n, p%level, level)
  end subroutine walk

  !> No node sticks yet.
  pure subroutine begin(scene, state, p)
    type(scene_type), intent(in) :: scene
    type(shear_type), intent(in) :: state
    type(point_type), intent(out) :: p
    p = point_type(time=state%time, shift=state%shift, velocity=state%velocity, force=state%force, force_before=0, step_before=0, &
                   slope=state%slope, normal=state%force, normal_before=0, sinking=state%velocity, fresh=0, weight=0, alpha=0, &
                   side=0, slack=0, slack_before=0, level=state%level, known=0, front=0, onset=0, turned=0)
    if (.not. scene%psi > 1) p%sinking = 1
  end subroutine begin

  !> Gross slip ends: all elements in contact stick with q = f. Once the contact shrinks there is slip at the edge from now on.
  pure subroutine begin_together(m, scene, tau, level, trace, node, alpha, beta, p, term)
    integer(ip), intent(in) :: m
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(m)
    type(trace_type), intent(in) :: trace(m, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(inout) :: alpha(0:scene%n), beta(m, 0:scene%n)
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    integer(ip) :: i, k
    p%front = min(p%level, 2*scene%n - p%level - 1)
    do i = 0, p%front + 1
      alpha(i) = scene%g_inf*node(i)%radius**2
      do k = 1, m
        beta(k, i) = trace(k, i)%memory
      end do
    end do
    i = merge(p%front, p%front + 1, p%level < scene%n)
    do k = 1, m
      term(k)%age = exp(-(p%time - level(i)%time)/tau(k))
    end do
    p%fresh = scene%g_inf*p%shift + scene%eta*p%velocity + sum(term%stress)
    if (p%level < scene%n) then
      call add_up(m, p%front, trace, node, alpha, beta, p, term)
    else
      p%side = 1
      call speak_of_slack(m, p%front + 1, scene, trace, node, alpha, beta, p, term)
    end if
  end subroutine begin_together

  !> A step of the compression in which all sticks; at its end the node at the edge is touched, and may slip.
  pure subroutine stick_step(m, scene, g, tau, level, trace, node, alpha, beta, p, term)
    integer(ip), intent(in) :: m
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(m), tau(m)
    type(trace_type), intent(in) :: trace(m, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(inout) :: alpha(0:scene%n), beta(m, 0:scene%n)
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    type(span_type) :: span
    real(dp) :: force, velocity, bend, weight
    integer(ip) :: next, k
    next = p%level + 1
    call measure_span(m, scene, g, tau, level(p%level:next), trace(:, next), p, term, span)
    call stick_force(m, scene, node(next)%radius, level(next), p, term, span, force, velocity, bend)
    call note_span(m, scene, span, level(next), velocity, force, bend, p, term)
    alpha(next) = scene%g_inf*p%shift
    do k = 1, m
      beta(k, next) = term(k)%stress
      term(k)%age = 1
    end do
    if (abs(velocity) <= level(next)%velocity .and. next < scene%n) then
      weight = weight_of(node, next)
      p%front = next
      p%weight = p%weight + weight
      p%alpha = p%alpha + weight*alpha(next)
      do k = 1, m
        term(k)%beta_sum = term(k)%beta_sum + weight*beta(k, next)
      end do
    else
      p%side = -sign(1.0_dp, velocity)
      call speak_of_slack(m, next, scene, trace, node, alpha, beta, p, term)
    end if
  end subroutine stick_step

  !> S at the end of the step: it is linear in the velocity there, as is what the sum over nodes lacks (module rst_sync_edge) while
  !> the edge does not slip.
  pure subroutine stick_force(m, scene, radius, end, p, term, span, force, velocity, bend)
    integer(ip), intent(in) :: m
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: radius  !! of the contact
    type(level_type), intent(in) :: end
    type(point_type), intent(in) :: p
    type(term_type), intent(in) :: term(m)
    type(span_type), intent(in) :: span
    real(dp), intent(out) :: force, velocity, bend
    type(rule_type) :: rule
    real(dp) :: known, share, tilt
    rule = rule_of(scene, .true., radius, 1.0_dp, end, span, p)
    known = without_force(rule, span, p)*p%weight - (p%alpha + sum(term%beta_sum))
    share = 1 + answer_of(rule, span)*p%weight
    velocity = rule%rest - rule%kick*force_ahead(span%h, p)
    if (abs(velocity) < end%velocity) then
      tilt = end%missing/end%velocity
      force = (known + rule%rest*tilt)*(1/(share + rule%kick*tilt))
    else ! slips from now on, in a ring thinner than the cell: q/f next to it as it was at the edge before
      force = (known + p%velocity/p%sinking*end%missing)/share
    end if
    velocity = rule%rest - rule%kick*force
    bend = -rule%push*span%half_rate*(force - p%force)
  end subroutine stick_force

  !> By how much Q falls with the force at the end of the step.
  pure function answer_of(rule, span) result(answer)
    type(rule_type), intent(in) :: rule
    type(span_type), intent(in) :: span
    real(dp) :: answer
    answer = rule%kick*span%end_response + rule%push*span%half_rate*span%bend_response
  end function answer_of

  !> Q if there were none.
  pure function without_force(rule, span, p) result(q)
    type(rule_type), intent(in) :: rule
    type(span_type), intent(in) :: span
    type(point_type), intent(in) :: p
    real(dp) :: q
    q = span%base + (span%end_response*rule%rest + rule%push*span%half_rate*span%bend_response*p%force)
  end function without_force

  !> S goes on as in the step before.
  pure function force_ahead(h, p) result(force)
    real(dp), intent(in) :: h
    type(point_type), intent(in) :: p
    real(dp) :: force
    force = p%force
    if (p%known > 0) force = p%force + (p%force - p%force_before(1))*(h/p%step_before(1))
  end function force_ahead

  !> Where little slips, S behaves like int f dX, and the weights are of the measure of time in which that is smooth; where much
  !> does, S is smooth in time. reach: share of the former.
  pure function rule_of(scene, in_time, radius, reach, end, span, p) result(rule)
    type(scene_type), intent(in) :: scene
    logical, intent(in) :: in_time              !! the weights of the level are
    real(dp), intent(in) :: radius, reach  !! radius: of the contact
    type(level_type), intent(in) :: end
    type(span_type), intent(in) :: span
    type(point_type), intent(in) :: p
    type(rule_type) :: rule
    real(dp) :: slope_weight
    logical :: usually
    rule%push = 2*mass_factor*scene%chi
    rule%feedback = rule%push*span%h*span%end_response*radius
    rule%reach = reach**8
    call choose_weights(rule%feedback, p%known, span%h, p%step_before, merge(span%drop, 0.0_dp, scene%psi > 1), end%weight, &
                        rule%weight, slope_weight, usually)
    rule%timely = rule%weight
    if (usually .and. reach < 1 .and. .not. in_time) then
      rule%timely = cubic_weights(span%h, p%step_before)
      rule%weight = rule%reach*rule%weight + (1 - rule%reach)*rule%timely
    end if
    rule%kick = rule%push*rule%weight(0)
    rule%rest = slope_weight*p%slope + (rule%weight(2)*p%force_before(1) + rule%weight(3)*p%force_before(2))
    rule%rest = p%velocity - rule%push*rule%rest
    rule%rest = rule%rest - (rule%push*rule%weight(1))*p%force ! last: what the step waits for
  end function rule_of

  !> A step with slip behind the front.
  subroutine front_step(m, scene, g, tau, level, trace, node, alpha, beta, p, term, guard, holds)
    integer(ip), intent(in) :: m
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(m), tau(m)
    type(trace_type), intent(in) :: trace(m, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(inout) :: alpha(0:scene%n), beta(m, 0:scene%n)
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    type(guard_type), intent(inout) :: guard
    logical, intent(out) :: holds
    type(span_type) :: span
    type(rule_type) :: rule
    type(end_type) :: now
    real(dp) :: reach
    logical :: turns, stuck
    integer(ip) :: next, edge, front_before, k
    next = p%level + 1
    edge = min(next, 2*scene%n - next)
    call measure_span(m, scene, g, tau, level(p%level:next), trace(:, next), p, term, span)
    stuck = p%front >= 0
    reach = 1
    if (p%front >= edge) call pass_node(m, node, trace, alpha, beta, p, term)
    front_before = p%front
    if (p%front + 1 < edge) reach = (node(p%front + 1)%radius/node(edge)%radius)**2
    rule = rule_of(scene, weighed_in_time(scene%n, next), node(edge)%radius, reach, level(next), span, p)
    call answer(m, scene, edge, next, reach, level(next), trace(:, next), trace, node, alpha, beta, rule, span, p, term, now, &
                turns)
    if (turns) then
      call turn_round(m, edge, scene, trace, node, alpha, beta, p, term)
      guard%node = -1
      call answer(m, scene, edge, next, reach, level(next), trace(:, next), trace, node, alpha, beta, rule, span, p, term, now, &
                  turns)
    end if
    call step_guard(m, scene, span, p%front < front_before, edge, level(next)%velocity, now%slack, alpha, beta, p, term, guard, &
                    holds)
    call finish(stuck, next, scene%n, level, rule, span, p, now)
    call note_span(m, scene, span, level(next), now%velocity, now%force, now%bend, p, term)
    if (next <= scene%n) then
      alpha(next) = scene%g_inf*(node(next)%radius**2 + p%side*p%shift)
      do k = 1, m
        beta(k, next) = trace(k, next)%memory + p%side*term(k)%stress
        if (p%front == next - 1) term(k)%age = 1
      end do
    end if
    if (p%side*p%velocity + p%sinking > 0) holds = .false. ! what is touched last would stick
    if (stuck .and. p%front < 0 .and. p%level - p%onset < merge(fewest_after_turn, fewest_steps, p%turned > 0)) &
      holds = .false. ! ends too soon to be followed
  end subroutine front_step

  !> Velocity and bend from S at the end of the step.
  pure subroutine finish(stuck, next, n, level, rule, span, p, now)
    logical, intent(in) :: stuck  !! some of it, at the start of the step
    integer(ip), intent(in) :: next, n
    type(level_type), intent(in) :: level(0:2*n)
    type(rule_type), intent(in) :: rule
    type(span_type), intent(in) :: span
    type(point_type), intent(in) :: p
    type(end_type), intent(inout) :: now
    real(dp) :: missing
    if (p%front < 0) now%force = -p%side*level(next)%force
    if (stuck) then
      missing = 0
      if (next < 2*n .and. now%slack < end_is_near*p%slack .and. (p%slack_before > 0 .or. now%slack <= 0)) &
        missing = (1 - rule%reach)*root_left_out(span%h, now%slack, p%side*now%force + level(next)%force, rule%timely, p)
      now%velocity = rule%rest - rule%push*(rule%weight(0)*now%force + p%side*missing)
    else
      now%velocity = p%velocity + rule%push*p%side*friction_impulse(next, level)
    end if
    now%bend = -rule%push*span%half_rate*(now%force - p%force)
  end subroutine finish

  !> S at the end of the step, and the front. turns: all that slipped has left the contact, and the edge would slip the other way.
  subroutine answer(m, scene, edge, next, reach, end, fade, trace, node, alpha, beta, rule, span, p, term, now, turns)
    integer(ip), intent(in) :: m, edge, next
    real(dp), intent(in) :: reach  !! square of the radius that sticks, by nodes, over that of the contact
    type(scene_type), intent(in) :: scene
    type(level_type), intent(in) :: end
    type(trace_type), intent(in) :: fade(m)  !! at the level
    type(trace_type), intent(in) :: trace(m, 0:edge)
    type(node_type), intent(in) :: node(0:edge)
    real(dp), intent(in) :: alpha(0:edge), beta(m, 0:edge)
    type(rule_type), intent(in) :: rule
    type(span_type), intent(in) :: span
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    type(end_type), intent(out) :: now
    logical, intent(out) :: turns
    real(dp) :: guess, y(-2:1), at_edge, unseen, open, fall
    integer(ip) :: trial
    turns = .false.
    at_edge = 0
    fall = p%side*answer_of(rule, span)
    open = end%fresh + p%side*without_force(rule, span, p)
    guess = force_ahead(span%h, p)
    now%slack = open - fall*guess
    now%force = guess
    if (p%front < 0) return
    unseen = 0
    if (next > scene%n) unseen = unseen_force(m, edge, scene, end, fade, trace, node)*reach
    if (rule%feedback > explicit_below) guess = implied(m, open, p%side*fall, 0.0_dp, end, term, p)
    do trial = 1, most_trials
      now%slack = open - fall*guess
      if (next <= scene%n) at_edge = scene%eta*(p%side*(rule%rest - rule%kick*guess) + end%velocity) ! touched now
      call slacks(m, next <= scene%n .and. p%front == edge - 1, at_edge, edge, trace, alpha, beta, now%slack, p, term, y)
      turns = next > scene%n .and. p%front == edge - 1 .and. y(1) > 0
      if (turns) return
      do while (y(0) < 0)
        call pass_node(m, node, trace, alpha, beta, p, term)
        if (p%front < 0) return
        call slacks(m, .false., at_edge, edge, trace, alpha, beta, now%slack, p, term, y)
      end do
      now%force = implied(m, open, p%side*fall, hinge(p%front, node, y) + unseen, end, term, p)
      if (rule%feedback < explicit_below .or. abs(now%force - guess) <= close_enough*p%normal) exit
      guess = now%force
    end do
  end subroutine answer

  !> S from the sums and what they lack of H; it answers itself through the nodes that stick. open: the slack at the centre if S
  !> were none; fall: by how much Q falls with it.
  pure function implied(m, open, fall, lack, end, term, p) result(force)
    integer(ip), intent(in) :: m
    real(dp), intent(in) :: open, fall, lack
    type(level_type), intent(in) :: end
    type(term_type), intent(in) :: term(m)
    type(point_type), intent(in) :: p
    real(dp) :: force, share
    integer(ip) :: k
    share = p%side/(1 + fall*p%weight)
    force = open*p%weight - p%alpha - end%force
    do k = 1, m
      force = force - term(k)%beta_sum
    end do
    force = (force + lack)*share
  end function implied
end module rst_sync_front
