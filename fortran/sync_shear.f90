!> The tangential problem of the method `sync` (THEORY 4.3, 5, 6): elements at the nodes of module rst_sync_dense, steps from
!> level to level, so that elements enter and leave exactly at a level.
!>
!> State. In stick q_i = Q - alpha_i - sum_k beta_ik with Q = G_inf U + sum_k M_k + eta U' for all (M_k' = g_k U' - M_k/tau_k);
!> alpha_i and beta_ik date from the entry of the element and from its slip. A slip velocity kappa, linear in the step, adds
!> its own elongation to them. A trial force beyond the friction limit is brought back to it by the kappa at the end of
!> the step that does so. Where dashpots rule, the velocity is continuous and starts from that of the step before;
!> where springs rule, it may jump: step%drop is the part of the old velocity that is not kept.
!>
!> Passive elements. Elements that have stuck since they were touched, while |U'| <= D', need no stepping: their sums follow from
!> Q and sums over their entries. Among them f - |q| falls outward, since by its entry an element further out has
!>   d(f -+ q)/dt_X = -(D' -+ U')(t_X) (G_inf + sum_k g_k exp(-(s-t_X)/tau_k)) <= 0
!> less: so the outermost one says when the first of them slips. From then on it is stepped (active), as are all elements that
!> slip as they are touched. Passive are nodes 0 to first - 1, active the others in contact.
!>
!> Time. Velocity and shift of the contact point follow from the forces of four levels (module rst_sync_quadrature).
module rst_sync_shear
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of
  use rst_sync_levels, only: level_type, node_type, mass_factor
  use rst_sync_dense, only: trace_type, fade_in_step
  use rst_sync_elements, only: scene_type, shear_type, step_type, sums_type, term_type, lanes, columns, &
                               column_x2, column_weight, column_alpha, column_kappa
  use rst_sync_lanes, only: move_elements
  use rst_sync_quadrature, only: full_friction, choose_weights, explicit_below, shortest_start, most_trials
  use rst_sync_edge, only: weight_of, shear_force, find_front
  use rst_sync_front, only: follow_front
  use rst_cubic, only: cubic_type, cubic_between, cubic_slope, cubic_bend, cubic_integral, cubic_root
  implicit none (type, external)
  private
  public :: follow_shear
  public :: start_shear, advance_shear, place_nodes, measure_step  !! of the history and the ledger, level by level

  real(dp), parameter :: slides_within = 1.0e-9_dp !! of full friction, what sums of rounding leave

contains

  !> Before the contact sticks for the first time: state%level is the level before it.
  pure subroutine start_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(out) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(out) :: state
    call place_nodes(scene, node, body, beta, faded)
    call first_stick(scene, g, tau, level, trace, term, state)
    state%passive_weight = body(0, column_weight)
    if (state%time > 0) call stick_together(scene, state%level, tau, level, trace, body, beta, term, state)
  end subroutine start_shear

  !> At first touch, or where gross slip ends.
  pure subroutine first_stick(scene, g, tau, level, trace, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(out) :: state
    integer(ip) :: k
    state = shear_type(time=0, shift=0, velocity=scene%psi, force=0, &
                       step_before=0, force_before=0, normal_before=0, slope=0, known=0, &
                       passive_weight=0, passive_alpha=0, &
                       level=0, first=1, front=0, updates=0)
    do k = 1, scene%n_terms
      term(k) = term_type(0, 0, 0, 0, 0, 0, 0, 0, 0, 1)  ! the passive node 0 is entered now
    end do
    if (scene%psi > 1 .and. scene%no_slip == 0) call end_gross_slip(scene, g, tau, level, trace, term, state)
  end subroutine first_stick

  !> From state%level to the next level.
  subroutine advance_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    type(step_type) :: step
    integer(ip) :: next, edge
    logical :: whole
    next = state%level + 1
    edge = min(next, 2*scene%n - next)
    step%last = edge - 1
    whole = state%time <= level(state%level)%time
    call measure_step(scene, g, tau, merge(level(next)%step, level(next)%time - state%time, whole), whole, &
                      trace(:, next), term, step)
    step%f = level(next)%fresh
    if (next > scene%n) call leave_node(scene, edge, trace, body, beta, term, state)
    call take_step(scene, next > scene%n, node(edge)%radius, &
                   level(next), trace, body, beta, faded, term, step, state)
    state%level = next
    if (next < scene%n) call enter_node(scene, edge, level(next)%velocity, trace(:, next), body, beta, faded, term, state)
  end subroutine advance_shear

  !> One impact to its end; state%velocity is U' then. Without elements, if slip stays behind one front.
  subroutine follow_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(out) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(out) :: state
    logical :: holds, slides, slid
    if (scene%no_slip == 0 .and. scene%stepped == 0) then
      call first_stick(scene, g, tau, level, trace, term, state)
      call follow_front(scene, g, tau, level, trace, node, term, body(:, column_alpha), beta, state, holds)
      if (holds) return
    end if
    call start_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
    slides = .false.
    do while (state%level < 2*scene%n)
      call advance_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
      slid = slides
      slides = slides_on(scene, level, body(:, column_kappa), state)
      if (slid .and. slides) exit
    end do
    if (state%level < 2*scene%n) state%velocity = state%velocity - 2*mass_factor*scene%chi*sign(1.0_dp, body(0, column_kappa)) &
                                                  *full_friction(scene%n, state%level, level)
  end subroutine follow_shear

  !> Whether all slips, one way and to the end, even if lags of slip velocities, which grow by a tenth or so, doubled. Slip
  !> velocities of elements that began to slip within a step are off by turns, up to half of what slip loses in a step, so two
  !> levels have to say it.
  pure function slides_on(scene, level, kappa, state) result(yes)
    type(scene_type), intent(in) :: scene
    type(level_type), intent(in) :: level(0:2*scene%n)
    real(dp), intent(in) :: kappa(0:scene%capacity - 1)
    type(shear_type), intent(in) :: state
    logical :: yes
    real(dp) :: now, last, doubt, lag, direction
    integer(ip) :: edge
    yes = .false.
    if (state%front >= 0 .or. state%first > 0 .or. scene%no_slip /= 0) return
    associate (here => level(state%level)%velocity, before => level(state%level - 1)%velocity)
      direction = sign(1.0_dp, kappa(0))
      now = here - direction*state%velocity ! slip velocity, against the direction, of what slipped before
      last = now + (1 - 2*scene%chi)*(level(2*scene%n)%velocity - here)
      doubt = abs((1 - 2*scene%chi)*(here - before))/2
    end associate
    if (max(now, last) + doubt > 0) return
    edge = min(state%level, 2*scene%n - state%level - 1)
    lag = maxval(-direction*kappa(0:edge)) - now
    yes = max(now, last) + 2*max(0.0_dp, lag) + doubt <= 0
  end function slides_on

  pure subroutine place_nodes(scene, node, body, beta, faded)
    type(scene_type), intent(in) :: scene
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(out) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    integer(ip) :: i
    do i = 0, scene%n
      body(i, column_x2) = scene%g_inf*node(i)%radius**2
      body(i, column_weight) = weight_of(node, i)
    end do
    body(scene%n + 1:, column_x2:column_weight) = 0
    body(:, column_alpha:) = 0
    beta = 0
    faded = 0
  end subroutine place_nodes

  !> psi > 1: all elements stick at once when D' = (2 chi - psi)/(2 chi - 1), with q = f (THEORY 4.3).
  pure subroutine end_gross_slip(scene, g, tau, level, trace, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    type(cubic_type) :: velocity
    type(memory_type) :: m
    real(dp), parameter :: closest = 1.0e-9_dp  !! part of a step; one of no length would have no slopes
    real(dp) :: target, h, bend
    integer(ip) :: l, k

    target = (2*scene%chi - scene%psi)/(2*scene%chi - 1)
    l = 0
    do while (l < 2*scene%n - 1)
      if (level(l + 1)%velocity < target) exit
      l = l + 1
    end do
    velocity = between_levels(level(l:l + 1))
    h = cubic_root(velocity, target)
    if (level(l + 1)%step - h <= closest*level(l + 1)%step .and. l + 1 < 2*scene%n) then ! at the next level
      l = l + 1
      velocity = between_levels(level(l:l + 1))
      h = 0
    else if (h <= closest*level(l + 1)%step) then
      h = 0
    end if
    state%time = level(l)%time + h
    state%shift = level(l)%depth + cubic_integral(velocity, h)
    state%velocity = target
    state%force = -cubic_slope(velocity, h)/mass_factor
    state%normal_before(0) = state%force
    state%slope = -cubic_bend(velocity, h)/mass_factor
    state%level = l
    bend = 0
    if (h > 0) bend = -mass_factor*(state%force - level(l)%force)/(2*h)
    do k = 1, scene%n_terms
      m = memory_of(h/tau(k))
      term(k)%stress = m%decay*trace(k, l)%memory + g(k)*h*(level(l)%velocity*(m%phi1 - m%phi2) + target*m%phi2 &
                                                      + bend*h*h*(2*m%phi3 - m%phi2))
    end do
  end subroutine end_gross_slip

  !> All elements in contact after the level l become passive, with q = f.
  pure subroutine stick_together(scene, l, tau, level, trace, body, beta, term, state)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: l
    real(dp), intent(in) :: tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout) :: beta(0:scene%capacity - 1, scene%n_terms)
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    real(dp) :: fade
    integer(ip) :: i, k
    state%front = merge(l, 2*scene%n - l - 1, l < scene%n)
    state%first = state%front + 1
    do i = 0, state%front
      body(i, column_alpha) = body(i, column_x2)
    end do
    state%passive_weight = sum(body(0:state%front, column_weight))
    state%passive_alpha = 0
    do i = 0, state%front
      state%passive_alpha = state%passive_alpha + body(i, column_weight)*body(i, column_x2)
    end do
    do k = 1, scene%n_terms
      term(k)%age = exp(-(state%time - level(state%front)%time)/tau(k))
      term(k)%beta_sum = 0
      fade = term(k)%age
      do i = state%front, 0, -1
        beta(i, k) = trace(k, i)%memory
        term(k)%beta_sum = term(k)%beta_sum + body(i, column_weight)*fade*beta(i, k)
        fade = fade*trace(k, i)%decay
      end do
    end do
  end subroutine stick_together

  pure function between_levels(level) result(velocity)
    type(level_type), intent(in) :: level(2)
    type(cubic_type) :: velocity
    velocity = cubic_between(level(2)%step, level(1)%velocity, level(2)%velocity, -mass_factor*level(1)%force, &
                             -mass_factor*level(2)%force)
  end function between_levels

  !> How forces answer the step, and what fades in it: known for a whole step from level to level.
  pure subroutine measure_step(scene, g, tau, h, whole, trace, term, step)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), h
    logical, intent(in) :: whole
    type(trace_type), intent(in) :: trace(scene%n_terms)  !! at the end of the step
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(step_type), intent(inout) :: step
    type(trace_type) :: t
    integer(ip) :: k
    step%n_terms = scene%n_terms
    step%capacity = scene%capacity
    step%h = h
    step%spring = scene%g_inf*h/2
    step%start_response = step%spring
    step%end_response = step%spring + scene%eta
    do k = 1, scene%n_terms
      t = trace(k)
      if (.not. whole) call fade_in_step(g(k), tau(k), h, t)
      term(k)%decay = t%decay
      term(k)%from_start = t%from_start
      term(k)%from_end = t%from_end
      term(k)%from_bend = t%from_bend
      step%start_response = step%start_response + t%from_start
      step%end_response = step%end_response + t%from_end
      term(k)%beta_sum = t%decay*term(k)%beta_sum
      term(k)%age_before = term(k)%age
      term(k)%age = t%decay*term(k)%age
    end do
    step%drop = 1
    if (step%start_response < step%end_response) step%drop = step%start_response/step%end_response
  end subroutine measure_step

  !> Predict the force at the end of the step, move the elements, correct. Where force and velocity at the end of the step hang
  !> together closely (dashpots, few levels) the velocity is first found by Newton steps on trial moves.
  subroutine take_step(scene, restitution, radius, normal, trace, body, beta, faded, term, step, state)
    type(scene_type), intent(in) :: scene
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    logical, intent(in) :: restitution
    real(dp), intent(in) :: radius            !! of the contact at the new level
    type(level_type), intent(in) :: normal    !! at the new level
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(step_type), intent(inout) :: step
    type(shear_type), intent(inout) :: state
    real(dp) :: push, force, velocity, shift, change, passed, start, feedback, direction, weight(0:3)
    type(sums_type) :: sums
    logical :: stuck
    integer(ip) :: trial, k

    push = 2*mass_factor*scene%chi
    feedback = push*step%h*step%end_response*radius
    call weigh_forces(scene, feedback, normal, step, state, weight, start)
    stuck = state%front >= 0
    force = state%force
    if (state%known > 0) force = state%force + (state%force - state%force_before(1))*step%h/state%step_before(1)
    velocity = state%velocity - push*(start + impulse(force, weight, state))
    call move(scene, push, force, velocity, state, term, step, shift)
    if (feedback > explicit_below) then
      do trial = 1, most_trials
        call move_nodes(scene, 1_ip, term, step, body, beta, faded, state, sums)
        force = shear_force(scene, .true., restitution, radius, normal, velocity, trace, step, term, body, beta, faded, sums, state)
        change = (state%velocity - push*(start + impulse(force, weight, state)) - velocity) &
                 /(1 + push*weight(0)*step%end_response*sums%stuck)
        velocity = velocity + change
        force = force + change*step%end_response*sums%stuck
        call move(scene, push, force, velocity, state, term, step, shift)
        if (abs(change) < 1.0e-12_dp*(1 + scene%psi)) exit
      end do
    end if
    if (scene%no_slip == 0) call wake_nodes(scene, trace, step, body, beta, faded, term, state)
    call move_nodes(scene, 0_ip, term, step, body, beta, faded, state, sums)
    call find_front(scene, body(:, column_kappa), step%last, state)
    force = shear_force(scene, .false., restitution, radius, normal, velocity, trace, step, term, body, beta, faded, sums, state)
    passed = start + impulse(force, weight, state)
    if (restitution .and. scene%no_slip == 0 .and. state%front < step%last) then
      direction = sign(1.0_dp, body(state%front + 1, column_kappa))
      if (state%front >= 0 .or. abs(force - direction*normal%force) <= slides_within*normal%force) &
        passed = impulse_near_sliding(direction, stuck, step%h, force, normal%force, passed, weight, state)
    end if
    velocity = state%velocity - push*passed
    call move(scene, push, force, velocity, state, term, step, shift)
    do k = 1, scene%n_terms
      term(k)%stress = term(k)%next_stress
    end do
    state%shift = shift
    state%velocity = velocity
    state%time = normal%time
    if (step%h < shortest_start*normal%step) state%known = -1 ! as if it had begun here: such differences are none
    call note_force(step%h, force, normal%force, state)
  end subroutine take_step

  !> Weights of the forces in int S ds over the step, and what a known slope at the start adds.
  pure subroutine weigh_forces(scene, feedback, normal, step, state, weight, start)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: feedback
    type(level_type), intent(in) :: normal
    type(step_type), intent(in) :: step
    type(shear_type), intent(in) :: state
    real(dp), intent(out) :: weight(0:3), start
    real(dp) :: slope_weight
    logical :: usually
    call choose_weights(feedback, state%known, step%h, state%step_before, merge(step%drop, 0.0_dp, scene%psi > 1), &
                        normal%weight, weight, slope_weight, usually)
    start = slope_weight*state%slope
  end subroutine weigh_forces

  pure subroutine note_force(h, force, normal_force, state)
    real(dp), intent(in) :: h, force, normal_force
    type(shear_type), intent(inout) :: state
    state%known = min(3_ip, state%known + 1)
    state%step_before = [h, state%step_before(1)]
    state%force_before = [state%force, state%force_before(1)]
    state%normal_before = [normal_force, state%normal_before(0:1)]
    state%force = force
  end subroutine note_force

  !> int S ds over the step.
  pure function impulse(force, weight, state) result(passed)
    real(dp), intent(in) :: force, weight(0:3)
    type(shear_type), intent(in) :: state
    real(dp) :: passed
    passed = weight(0)*force + weight(1)*state%force + weight(2)*state%force_before(1) + weight(3)*state%force_before(2)
  end function impulse

  !> The same where stick ends at the centre, in the step or soon after: its radius vanishes like the root of the time that is left
  !> to it, and so what S lacks of full friction like the 3/2-th power. That is integrated by this law, full friction as before;
  !> the more time is left, the more of the cubic there is.
  pure function impulse_near_sliding(direction, stuck, h, force, normal_force, cubic, weight, state) result(passed)
    real(dp), intent(in) :: direction, h, force, normal_force, cubic, weight(0:3)
    logical, intent(in) :: stuck  !! some of it, at the start
    type(shear_type), intent(in) :: state
    real(dp) :: passed, lack(0:2), z(0:2), left, share
    lack = abs([force - direction*normal_force, state%force - direction*state%normal_before(0), &
                state%force_before(1) - direction*state%normal_before(1)])
    passed = cubic
    if (state%front >= 0 .and. lack(0) >= 0.35_dp*lack(1)) return ! two steps and more are left, as lack^(2/3) tells
    passed = direction*(weight(0)*normal_force + dot_product(weight(1:), state%normal_before))
    if (state%front >= 0) then
      z(0:1) = lack(0:1)**(2.0_dp/3.0_dp)
      share = max(0.0_dp, 1 - 2*z(0)/z(1))
      left = h*z(1)/(z(1) - z(0))
      passed = share*(passed - direction*0.4_dp*(lack(1)*left - lack(0)*(left - h))) + (1 - share)*cubic
    else if (stuck) then
      z(1:2) = lack(1:2)**(2.0_dp/3.0_dp)
      left = h/2
      if (z(2) > z(1)) left = min(h, state%step_before(1)*z(1)/(z(2) - z(1)))
      passed = passed - direction*0.4_dp*lack(1)*left
    end if
  end function impulse_near_sliding

  !> U, M_k and Q at the new level for a velocity whose ends and slopes at both ends are known.
  pure subroutine move(scene, push, force, velocity, state, term, step, shift)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: push, force, velocity
    type(shear_type), intent(in) :: state
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(step_type), intent(inout) :: step
    real(dp), intent(out) :: shift
    real(dp) :: bend
    integer(ip) :: k
    bend = -push*(force - state%force)/(2*step%h)
    shift = state%shift + step%h*(state%velocity + velocity)/2 - bend*step%h**3/6
    step%q = scene%g_inf*shift + scene%eta*velocity
    do k = 1, scene%n_terms
      term(k)%next_stress = term(k)%decay*term(k)%stress + term(k)%from_start*state%velocity + term(k)%from_end*velocity &
                            + term(k)%from_bend*bend
      step%q = step%q + term(k)%next_stress
    end do
  end subroutine move

  !> As long as the outermost passive node passes its friction limit, its group of lanes becomes active.
  pure subroutine wake_nodes(scene, trace, step, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(step_type), intent(in) :: step
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    real(dp) :: f, q
    integer(ip) :: k
    do while (state%first > 0)
      f = step%f - body(state%first - 1, column_x2)
      q = step%q - body(state%first - 1, column_alpha)
      do k = 1, scene%n_terms
        f = f - term(k)%age*trace(k, state%first - 1)%memory
        q = q - term(k)%age*beta(state%first - 1, k)
      end do
      if (abs(q) <= f) exit
      call wake_group(scene, trace, body, beta, faded, term, state)
    end do
  end subroutine wake_nodes

  !> Until then beta is what it was at the entry of the node. Nodes get what they have at the start of the step, the sums are those
  !> of its end.
  pure subroutine wake_group(scene, trace, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    real(dp) :: age
    integer(ip) :: i, k, lowest
    lowest = state%first - 1 - mod(state%first - 1, lanes)
    do i = lowest, state%first - 1
      state%passive_weight = state%passive_weight - body(i, column_weight)
      state%passive_alpha = state%passive_alpha - body(i, column_weight)*body(i, column_alpha)
    end do
    do k = 1, scene%n_terms
      age = term(k)%age_before
      do i = state%first - 1, lowest, -1
        beta(i, k) = age*beta(i, k)
        faded(i, k) = age*trace(k, i)%memory
        term(k)%beta_sum = term(k)%beta_sum - body(i, column_weight)*term(k)%decay*beta(i, k)
        age = age*trace(k, i)%decay
      end do
      term(k)%age_before = age
      term(k)%age = term(k)%decay*age
    end do
    state%first = lowest
  end subroutine wake_group

  !> The loop over active elements, and what passive ones, all stuck, add.
  subroutine move_nodes(scene, trial, term, step, body, beta, faded, state, sums)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: trial
    type(term_type), intent(in) :: term(scene%n_terms)
    type(step_type), intent(inout) :: step
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(shear_type), intent(inout) :: state
    type(sums_type), intent(out) :: sums
    integer(ip) :: k
    sums = sums_type(0.0_dp, 0.0_dp)
    step%first = state%first
    if (step%first <= step%last) then
      call move_elements(step, trial, term, body, beta, faded, sums)
      state%updates = state%updates + step%last - step%first + 1
    end if
    sums%stuck = sums%stuck + state%passive_weight
    sums%q = sums%q + (step%q*state%passive_weight - state%passive_alpha)
    do k = 1, scene%n_terms
      sums%q = sums%q - term(k)%beta_sum
    end do
  end subroutine move_nodes

  !> A node is touched at the edge: what sphere and solid have gone through so far is not its own. It slips if the sphere moves
  !> faster along than into the surface.
  pure subroutine enter_node(scene, edge, velocity, trace, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: edge
    real(dp), intent(in) :: velocity
    type(trace_type), intent(in) :: trace(scene%n_terms)
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    logical :: passive
    integer(ip) :: k
    passive = state%first == edge .and. (abs(state%velocity) <= velocity .or. scene%no_slip /= 0)
    body(edge, column_alpha) = scene%g_inf*state%shift
    body(edge, column_kappa) = 0
    if (scene%no_slip == 0) body(edge, column_kappa) = state%velocity - max(-velocity, min(velocity, state%velocity))
    if (passive) then
      state%first = edge + 1
      state%passive_weight = state%passive_weight + body(edge, column_weight)
      state%passive_alpha = state%passive_alpha + body(edge, column_weight)*body(edge, column_alpha)
    end if
    do k = 1, scene%n_terms
      beta(edge, k) = term(k)%stress
      faded(edge, k) = trace(k)%memory
      if (.not. passive) cycle
      term(k)%age = 1
      term(k)%beta_sum = term(k)%beta_sum + body(edge, column_weight)*beta(edge, k)
    end do
  end subroutine enter_node

  !> The node that the edge has come back to is no longer part of the sums.
  pure subroutine leave_node(scene, edge, trace, body, beta, term, state)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: edge
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns), beta(0:scene%capacity - 1, scene%n_terms)
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    integer(ip) :: k
    if (edge >= state%first) return
    state%passive_weight = state%passive_weight - body(edge, column_weight)
    state%passive_alpha = state%passive_alpha - body(edge, column_weight)*body(edge, column_alpha)
    do k = 1, scene%n_terms
      term(k)%beta_sum = term(k)%beta_sum - body(edge, column_weight)*term(k)%age*beta(edge, k)
      term(k)%age_before = term(k)%age_before*trace(k, edge)%decay
      term(k)%age = term(k)%age*trace(k, edge)%decay
    end do
    state%first = edge
  end subroutine leave_node
end module rst_sync_shear
