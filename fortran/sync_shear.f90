!> The tangential problem of the method `sync` (THEORY 4.3, 5, 6): elements at the nodes of module rst_sync_levels, steps from
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
!> Sum over elements. int q dX = r int f dX - int (r f - q) dX with int f dX known exactly and r = q/f at the edge: the
!> integrand is flat there, whatever relaxes on the way in, and zero where all slips. So the trapezoidal rule is fourth
!> order but for the kink where stick begins; hinge() knows its error.
!>
!> Time. Depth and velocity of the contact point are integrated to third order from the forces of three levels.
module rst_sync_shear
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of
  use rst_sync_levels, only: level_type, node_type
  use rst_sync_elements, only: step_type, sums_type, term_type, element_loop, lanes, columns, column_x2, column_weight, &
                               column_alpha, column_kappa
  use rst_cubic, only: cubic_type, cubic_between, cubic_slope, cubic_integral, cubic_root
  implicit none (type, external)
  private
  public :: scene_type, shear_type, follow_shear
  public :: start_shear, advance_shear, place_nodes, measure_step, stick_radius  !! of the history and the ledger, level by level

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp
  real(dp), parameter :: explicit_below = 0.1_dp  !! feedback of a step below which one evaluation is enough
  integer(ip), parameter :: most_trials = 20

  !> Twin of `struct sync_scene` in C.
  type, bind(c) :: scene_type
    real(dp) :: chi, psi, g_inf, eta
    integer(ip) :: n_terms, n, capacity  !! capacity: of the element arrays, n + 1 rounded up to whole lanes
    integer(ip) :: no_slip
  end type scene_type

  !> Where the contact point is at a level. Twin of `struct sync_shear` in C.
  type, bind(c) :: shear_type
    real(dp) :: time, shift, velocity, force     !! s, U, U', int_0^A q dX
    real(dp) :: step_before, force_before        !! 0: no level before
    real(dp) :: weight, x2                       !! sums over the nodes in contact, weighted
    real(dp) :: passive_weight, passive_alpha    !! over the passive ones
    integer(ip) :: level, first, front, updates  !! first: active node; front: outermost node that sticks, -1: none
  end type shear_type

contains

  !> Before the contact sticks for the first time: state%level is the level before it.
  pure subroutine start_shear(scene, g, tau, level, memory, node, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(out) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(out) :: state
    integer(ip) :: k
    call place_nodes(scene, node, body, beta, faded)
    state = shear_type(time=0, shift=0, velocity=scene%psi, force=0, step_before=0, force_before=0, &
                       weight=body(0, column_weight), x2=0, passive_weight=body(0, column_weight), passive_alpha=0, &
                       level=0, first=1, front=0, updates=0)
    do k = 1, scene%n_terms
      term(k) = term_type(0, 0, 0, 0, 0, 0, 0, 0, 0, 0)
    end do
    if (scene%psi > 1 .and. scene%no_slip == 0) call end_gross_slip(scene, g, tau, level, memory, body, beta, term, state)
  end subroutine start_shear

  !> From state%level to the next level.
  subroutine advance_shear(scene, elements, g, tau, level, memory, node, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    procedure(element_loop) :: elements
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    type(step_type) :: step
    integer(ip) :: next, edge
    next = state%level + 1
    edge = min(next, 2*scene%n - next)
    step%last = edge - 1
    call measure_step(scene, g, tau, level(next)%time - state%time, term, step)
    step%f = scene%g_inf*level(next)%depth + scene%eta*level(next)%velocity + sum(memory(:, next))
    if (next > scene%n) call leave_node(scene, tau, level, edge, level(next)%time, memory, body, beta, term, state)
    call take_step(scene, elements, tau, level, next > scene%n, node(edge)%radius, level(next), memory, body, beta, faded, term, &
                   step, state)
    state%level = next
    if (next <= scene%n) call enter_node(scene, edge, level(next)%velocity, memory(:, next), body, beta, faded, term, state)
  end subroutine advance_shear

  !> One impact to its end; state%velocity is U' then.
  subroutine follow_shear(scene, elements, g, tau, level, memory, node, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    procedure(element_loop) :: elements
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(out) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(out) :: state
    call start_shear(scene, g, tau, level, memory, node, body, beta, faded, term, state)
    do while (state%level < 2*scene%n)
      call advance_shear(scene, elements, g, tau, level, memory, node, body, beta, faded, term, state)
    end do
  end subroutine follow_shear

  pure subroutine place_nodes(scene, node, body, beta, faded)
    type(scene_type), intent(in) :: scene
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(out) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    integer(ip) :: i
    do i = 0, scene%n
      body(i, column_x2) = scene%g_inf*node(i)%radius**2
      body(i, column_weight) = node(i)%width
    end do
    ! an uneven grid has X'' /= 0 at the centre: Euler-Maclaurin's second term
    body(0, column_weight) = node(0)%width/2 + (4*node(1)%width - 3*node(0)%width - node(2)%width)/24
    body(scene%n + 1:, column_x2:column_weight) = 0
    body(:, column_alpha:) = 0
    beta = 0
    faded = 0
  end subroutine place_nodes

  !> psi > 1: all elements stick at once when D' = (2 chi - psi)/(2 chi - 1), with q = f (THEORY 4.3).
  pure subroutine end_gross_slip(scene, g, tau, level, memory, body, beta, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout) :: beta(0:scene%capacity - 1, scene%n_terms)
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    type(cubic_type) :: velocity
    type(memory_type) :: m
    real(dp) :: target, h, bend
    integer(ip) :: l, i, k

    target = (2*scene%chi - scene%psi)/(2*scene%chi - 1)
    l = 0
    do while (l < 2*scene%n - 1)
      if (level(l + 1)%velocity < target) exit
      l = l + 1
    end do
    velocity = cubic_between(level(l + 1)%time - level(l)%time, level(l)%velocity, level(l + 1)%velocity, &
                             -mass_factor*level(l)%force, -mass_factor*level(l + 1)%force)
    h = cubic_root(velocity, target)
    state%time = level(l)%time + h
    state%shift = level(l)%depth + cubic_integral(velocity, h)
    state%velocity = target
    state%force = -cubic_slope(velocity, h)/mass_factor
    state%level = l
    bend = 0
    if (h > 0) bend = -mass_factor*(state%force - level(l)%force)/(2*h)
    do k = 1, scene%n_terms
      m = memory_of(h/tau(k))
      term(k)%stress = m%decay*memory(k, l) + g(k)*h*(level(l)%velocity*(m%phi1 - m%phi2) + target*m%phi2 &
                                                      + bend*h*h*(2*m%phi3 - m%phi2))
    end do
    state%front = merge(l, 2*scene%n - l - 1, l < scene%n)
    state%first = state%front + 1
    do i = 0, state%front
      body(i, column_alpha) = body(i, column_x2)
    end do
    state%weight = sum(body(0:state%front, column_weight))
    state%x2 = 0
    do i = 0, state%front
      state%x2 = state%x2 + body(i, column_weight)*body(i, column_x2)
    end do
    state%passive_weight = state%weight
    state%passive_alpha = state%x2
    do k = 1, scene%n_terms
      do i = 0, state%front
        beta(i, k) = memory(k, i)
        term(k)%faded_guard = memory(k, i)*exp(-(state%time - level(i)%time)/tau(k))
        term(k)%faded_sum = term(k)%faded_sum + body(i, column_weight)*term(k)%faded_guard
      end do
      term(k)%beta_guard = term(k)%faded_guard
      term(k)%beta_sum = term(k)%faded_sum
    end do
  end subroutine end_gross_slip

  !> How forces answer the step, and what fades in it.
  pure subroutine measure_step(scene, g, tau, h, term, step)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), h
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(step_type), intent(inout) :: step
    type(memory_type) :: m
    integer(ip) :: k
    step%n_terms = scene%n_terms
    step%capacity = scene%capacity
    step%h = h
    step%spring = scene%g_inf*h/2
    step%start_response = step%spring
    step%end_response = step%spring + scene%eta
    do k = 1, scene%n_terms
      m = memory_of(h/tau(k))
      term(k)%decay = m%decay
      term(k)%from_start = g(k)*h*(m%phi1 - m%phi2)
      term(k)%from_end = g(k)*h*m%phi2
      term(k)%from_bend = g(k)*h*h*h*(2*m%phi3 - m%phi2)
      step%start_response = step%start_response + term(k)%from_start
      step%end_response = step%end_response + term(k)%from_end
      term(k)%faded_sum = m%decay*term(k)%faded_sum
      term(k)%beta_sum = m%decay*term(k)%beta_sum
      term(k)%faded_guard = m%decay*term(k)%faded_guard
      term(k)%beta_guard = m%decay*term(k)%beta_guard
    end do
    step%drop = min(1.0_dp, step%start_response/step%end_response)
  end subroutine measure_step

  !> Predict the force at the end of the step, move the elements, correct. Where force and velocity at the end of the step hang
  !> together closely (dashpots, few levels) the velocity is first found by Newton steps on trial moves.
  subroutine take_step(scene, elements, tau, level, restitution, radius, normal, memory, body, beta, faded, term, step, &
                       state)
    type(scene_type), intent(in) :: scene
    procedure(element_loop) :: elements
    real(dp), intent(in) :: tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    logical, intent(in) :: restitution
    real(dp), intent(in) :: radius            !! of the contact at the new level
    type(level_type), intent(in) :: normal    !! at the new level
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(step_type), intent(inout) :: step
    type(shear_type), intent(inout) :: state
    real(dp) :: push, force, velocity, shift, change
    type(sums_type) :: sums
    integer(ip) :: trial, k

    push = 2*mass_factor*scene%chi
    force = state%force
    if (state%step_before > 0) force = state%force + (state%force - state%force_before)*step%h/state%step_before
    velocity = state%velocity - push*impulse(step%h, force, state)
    call move(scene, push, force, velocity, state, term, step, shift)
    if (push*step%h/2*step%end_response*radius > explicit_below) then
      do trial = 1, most_trials
        call move_nodes(scene, elements, 1_ip, term, step, body, beta, faded, state, sums)
        force = shear_force(scene, tau, level, .true., restitution, normal, velocity, memory, step, term, body, beta, faded, sums, &
                            state)
        change = (state%velocity - push*impulse(step%h, force, state) - velocity) &
                 /(1 + push*step%h/2*step%end_response*sums%stuck)
        velocity = velocity + change
        force = force + change*step%end_response*sums%stuck
        call move(scene, push, force, velocity, state, term, step, shift)
        if (abs(change) < 1.0e-12_dp*(1 + scene%psi)) exit
      end do
    end if
    if (scene%no_slip == 0) call wake_nodes(scene, tau, level, memory, step, body, beta, faded, term, state)
    call move_nodes(scene, elements, 0_ip, term, step, body, beta, faded, state, sums)
    call find_front(scene, body(:, column_kappa), step%last, state)
    force = shear_force(scene, tau, level, .false., restitution, normal, velocity, memory, step, term, body, beta, faded, sums, &
                        state)
    velocity = state%velocity - push*impulse(step%h, force, state)
    call move(scene, push, force, velocity, state, term, step, shift)
    do k = 1, scene%n_terms
      term(k)%stress = term(k)%next_stress
    end do
    state%shift = shift
    state%velocity = velocity
    state%time = normal%time
    state%step_before = step%h
    state%force_before = state%force
    state%force = force
  end subroutine take_step

  !> int S ds over the step: the parabola through the forces of three levels.
  pure function impulse(h, force, state) result(sum)
    real(dp), intent(in) :: h, force
    type(shear_type), intent(in) :: state
    real(dp) :: sum
    sum = h/2*(state%force + force)
    if (state%step_before > 0) then
      sum = sum - h**3/6*((force - state%force)/h - (state%force - state%force_before)/state%step_before) &
            /(h + state%step_before)
    end if
  end function impulse

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
  pure subroutine wake_nodes(scene, tau, level, memory, step, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
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
        f = f - term(k)%faded_guard
        q = q - term(k)%beta_guard
      end do
      if (abs(q) <= f) exit
      call wake_group(scene, tau, level, memory, body, beta, faded, term, state)
    end do
  end subroutine wake_nodes

  !> Until then beta is what it was at the entry of the node. Nodes get what they have at the start of the step, the sums are those
  !> of its end.
  pure subroutine wake_group(scene, tau, level, memory, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    real(dp) :: decay
    integer(ip) :: i, k, lowest
    lowest = state%first - 1 - mod(state%first - 1, lanes)
    do i = lowest, state%first - 1
      state%passive_weight = state%passive_weight - body(i, column_weight)
      state%passive_alpha = state%passive_alpha - body(i, column_weight)*body(i, column_alpha)
    end do
    do k = 1, scene%n_terms
      do i = lowest, state%first - 1
        decay = exp(-(state%time - level(i)%time)/tau(k))
        beta(i, k) = decay*beta(i, k)
        faded(i, k) = decay*memory(k, i)
        term(k)%beta_sum = term(k)%beta_sum - body(i, column_weight)*term(k)%decay*beta(i, k)
      end do
      if (lowest > 0) then
        decay = term(k)%decay*exp(-(state%time - level(lowest - 1)%time)/tau(k))
        term(k)%beta_guard = decay*beta(lowest - 1, k)
        term(k)%faded_guard = decay*memory(k, lowest - 1)
      end if
    end do
    state%first = lowest
  end subroutine wake_group

  !> The loop over active elements, and what passive ones, all stuck, add.
  subroutine move_nodes(scene, elements, trial, term, step, body, beta, faded, state, sums)
    type(scene_type), intent(in) :: scene
    procedure(element_loop) :: elements
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
      call elements(step, trial, term, body, beta, faded, sums)
      state%updates = state%updates + step%last - step%first + 1
    end if
    sums%stuck = sums%stuck + state%passive_weight
    sums%q = sums%q + (step%q*state%passive_weight - state%passive_alpha)
    do k = 1, scene%n_terms
      sums%q = sums%q - term(k)%beta_sum
    end do
  end subroutine move_nodes

  !> f - |q| and q of a node that sticks, at the end of the step.
  pure subroutine node_forces(scene, tau, level, memory, step, body, beta, faded, state, i, slack, q)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(in), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(shear_type), intent(in) :: state
    integer(ip), intent(in) :: i
    real(dp), intent(out) :: slack, q
    real(dp) :: decay
    integer(ip) :: k
    slack = step%f - body(i, column_x2)
    q = step%q - body(i, column_alpha)
    do k = 1, scene%n_terms
      if (i < state%first) then
        decay = exp(-(state%time + step%h - level(i)%time)/tau(k))
        slack = slack - decay*memory(k, i)
        q = q - decay*beta(i, k)
      else
        slack = slack - faded(i, k)
        q = q - beta(i, k)
      end if
    end do
    slack = max(0.0_dp, slack - abs(q))
  end subroutine node_forces

  !> int q dX from the nodes; before they are moved (trial) without the kink.
  pure function shear_force(scene, tau, level, trial, restitution, normal, velocity, memory, step, term, body, beta, faded, sums, &
                            state) result(total)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    logical, intent(in) :: trial, restitution
    type(level_type), intent(in) :: normal
    real(dp), intent(in) :: velocity, body(0:scene%capacity - 1, columns)
    real(dp), intent(in), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(step_type), intent(in) :: step
    type(term_type), intent(in) :: term(scene%n_terms)
    type(sums_type), intent(in) :: sums
    type(shear_type), intent(in) :: state
    real(dp) :: total, ratio, f, slack(0:1), q(0:2)
    integer(ip) :: k
    total = 0
    if (step%last < 0) return
    f = step%f*state%weight - state%x2
    do k = 1, scene%n_terms
      f = f - term(k)%faded_sum
    end do
    ratio = sign(1.0_dp, step%q - body(step%last, column_alpha) - sum(beta(step%last, :))) ! of an edge that slips
    if (.not. restitution) then ! the edge has just been touched and answers with the same modulus both ways
      ratio = max(-1.0_dp, min(1.0_dp, velocity/max(normal%velocity, tiny(1.0_dp))))
    end if
    if (abs(ratio) >= 1 .and. state%front == step%last .and. (restitution .or. scene%no_slip == 0) .and. .not. trial) then
      q = 0
      do k = min(2_ip, step%last), 0, -1
        call node_forces(scene, tau, level, memory, step, body, beta, faded, state, step%last - k, slack(0), q(k))
      end do
      total = sums%q + stuck_edge(scene, body, step%last, slack(0), q)
      return
    end if
    total = ratio*(normal%force - f) + sums%q
    if (scene%no_slip /= 0 .and. .not. restitution) then
      total = total + body(step%last + 1, column_weight)/2*scene%eta*(velocity - ratio*normal%velocity)
    else if (abs(ratio) >= 1 .and. state%front >= 1 .and. .not. trial) then
      do k = 0, 1
        call node_forces(scene, tau, level, memory, step, body, beta, faded, state, state%front - k, slack(k), q(k))
      end do
      total = total + ratio*body(state%front, column_weight)*hinge(slack(0), slack(1))
    end if
  end function shear_force

  !> Error of the trapezoidal rule, per cell, for int (f - |q|) dX, which falls to zero at the kink between the outermost node
  !> that sticks and the next one: its slope there times (x(1-x)/2 - 1/12), x where the kink is between them.
  pure function hinge(slack, slack_inside) result(error)
    real(dp), intent(in) :: slack, slack_inside
    real(dp) :: error, slope, x
    error = 0
    slope = slack_inside - slack
    if (slope <= 0) return
    x = min(1.0_dp, slack/slope)
    error = slope*(x*(1 - x)/2 - 1.0_dp/12)
  end function hinge

  !> What the trapezoidal rule lacks when all nodes stick: the last cell, where q goes on to the edge, by Gregory's rule, less
  !> the triangle next to the edge where q would be above f and slips. q: of the three outermost nodes.
  pure function stuck_edge(scene, body, last, slack, q) result(missing)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: last
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns), slack, q(0:2)
    real(dp) :: missing, edge, y(0:2), reach
    if (last < 3) then ! the contact is all but over: to its end with the force of the outermost node
      missing = q(0)*body(last, column_weight)/2
      return
    end if
    edge = 3*q(0) - 3*q(1) + q(2)
    y(0) = edge*body(last + 1, column_weight)
    y(1) = q(0)*body(last, column_weight)
    y(2) = q(1)*body(last - 1, column_weight)
    missing = y(0)/2 - (y(0) - y(1))/12 - (y(0) - 2*y(1) + y(2))/24
    if (scene%no_slip /= 0) return
    reach = abs(edge)/max(slack + abs(edge), tiny(1.0_dp)) ! of the triangle, in cells
    missing = missing - edge*reach/2*(body(last, column_weight) + body(last + 1, column_weight))/2
  end function stuck_edge

  !> The outermost node that sticks, from where it was; -1: none.
  pure subroutine find_front(scene, kappa, last, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: kappa(0:scene%capacity - 1)
    integer(ip), intent(in) :: last
    type(shear_type), intent(inout) :: state
    state%front = max(0_ip, min(state%front, last))
    do while (state%front < last)
      if (state%front + 1 >= state%first .and. abs(kappa(state%front + 1)) > 0) exit
      state%front = state%front + 1
    end do
    do while (state%front >= state%first)
      if (.not. abs(kappa(state%front)) > 0) exit
      state%front = state%front - 1
    end do
  end subroutine find_front

  !> A node is touched at the edge: what sphere and solid have gone through so far is not its own. It slips if the sphere moves
  !> faster along than into the surface.
  pure subroutine enter_node(scene, edge, velocity, memory, body, beta, faded, term, state)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: edge
    real(dp), intent(in) :: velocity, memory(scene%n_terms)
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
    state%weight = state%weight + body(edge, column_weight)
    state%x2 = state%x2 + body(edge, column_weight)*body(edge, column_x2)
    if (passive) then
      state%first = edge + 1
      state%passive_weight = state%passive_weight + body(edge, column_weight)
      state%passive_alpha = state%passive_alpha + body(edge, column_weight)*body(edge, column_alpha)
    end if
    do k = 1, scene%n_terms
      beta(edge, k) = term(k)%stress
      faded(edge, k) = memory(k)
      term(k)%faded_sum = term(k)%faded_sum + body(edge, column_weight)*memory(k)
      if (passive) then
        term(k)%beta_guard = beta(edge, k)
        term(k)%faded_guard = memory(k)
        term(k)%beta_sum = term(k)%beta_sum + body(edge, column_weight)*beta(edge, k)
      end if
    end do
  end subroutine enter_node

  !> The node that the edge has come back to is no longer part of the sums. `time`: of the new level.
  pure subroutine leave_node(scene, tau, level, edge, time, memory, body, beta, term, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), time, memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    integer(ip), intent(in) :: edge
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns), beta(0:scene%capacity - 1, scene%n_terms)
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(inout) :: state
    real(dp) :: decay
    integer(ip) :: k
    state%weight = state%weight - body(edge, column_weight)
    state%x2 = state%x2 - body(edge, column_weight)*body(edge, column_x2)
    if (edge < state%first) then
      state%passive_weight = state%passive_weight - body(edge, column_weight)
      state%passive_alpha = state%passive_alpha - body(edge, column_weight)*body(edge, column_alpha)
    end if
    do k = 1, scene%n_terms
      decay = exp(-(time - level(edge)%time)/tau(k))
      term(k)%faded_sum = term(k)%faded_sum - body(edge, column_weight)*decay*memory(k, edge)
      if (edge >= state%first) cycle
      term(k)%beta_sum = term(k)%beta_sum - body(edge, column_weight)*decay*beta(edge, k)
      if (edge == 0) cycle
      decay = exp(-(time - level(edge - 1)%time)/tau(k))
      term(k)%beta_guard = decay*beta(edge - 1, k)
      term(k)%faded_guard = decay*memory(k, edge - 1)
    end do
    state%first = min(state%first, edge)
  end subroutine leave_node

  !> Where stick ends, between nodes.
  pure function stick_radius(scene, tau, level, edge, node, memory, step, body, beta, faded, state) result(stick)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), memory(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    integer(ip), intent(in) :: edge
    type(node_type), intent(in) :: node(0:scene%n)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(in), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(shear_type), intent(in) :: state
    real(dp) :: stick, slack(0:1), q
    integer(ip) :: k
    stick = node(edge)%radius
    if (scene%no_slip /= 0 .or. edge == 0) return
    stick = 0
    if (state%front < 0) return
    stick = node(state%front)%radius
    if (state%front < 1) return
    do k = 0, 1
      call node_forces(scene, tau, level, memory, step, body, beta, faded, state, state%front - k, slack(k), q)
    end do
    stick = stick + min(1.0_dp, slack(0)/max(slack(1) - slack(0), tiny(1.0_dp)))*(node(state%front + 1)%radius - stick)
  end function stick_radius
end module rst_sync_shear
