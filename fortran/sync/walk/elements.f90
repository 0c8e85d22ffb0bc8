!> The tangential motion of an impact by elements (docs/sync.md, section 8): for slip that sticks
!> again, and for the energy ledger. Module rst_sync_element_step has the step of the elements; here
!> are contact and sphere.
!>
!> Elements sit at the radii X_j of the levels. Level j <= n is the instant of the compression at
!> which the edge of the contact is at X_j, level 2n - j that of the restitution. So elements enter
!> and leave exactly at a level.
!>
!> The sums over elements and over time lean on the normal problem, whose force N and impulse are
!> known: each is the share of friction that is used, by the trapezoidal rule, times the known one.
!> So full slip is exact.
!>
!> With walk%divides slip begins within a step, where the ledger needs it.
!>
!> To call follow_elements: fill walk, level(0:end), memory(n_terms, 0:end) and, with
!> walk%prescribed, shear(start:end)%velocity. Steps are positive and psi is not negative. term,
!> body and stress are room, whatever they contain. Results: shear(0:end) and the accounts of module
!> rst_ledger. Without friction start = 2n.
module rst_sync_walk
  use rst_friction_mode, only: mode_frictionless, mode_no_slip
  use rst_motion_factors, only: mass_factor
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of
  use rst_ledger, only: ledger_type
  use rst_tuning, only: most_trials, walk_closeness
  use rst_sync_element_step, only: walk_type, walk_term_type, step_type, columns, c_weight, c_limit, c_trial, c_slip, &
                                   c_force, c_stuck, measure_step, relax, friction_force, move_elements, begin_to_slip, &
                                   weighted_sum
  implicit none (type, external)
  private
  public :: walk_type, walk_term_type, walk_level_type, walk_shear_type, columns, follow_elements

  !> The normal motion at a level; step: time since the level before. Twin of `struct walk_level` in
  !> C.
  type, bind(c) :: walk_level_type
    real(dp) :: step, radius, depth, velocity, force
  end type walk_level_type

  !> U' and S = int_0^A q dX at a level. Twin of `struct walk_shear` in C.
  type, bind(c) :: walk_shear_type
    real(dp) :: velocity, force
  end type walk_shear_type

  !> Energies in units of force N times depth D, and the sum over f at the level where work_z ends.
  type :: account_type
    real(dp) :: work_z = 0, left_z = 0, work_x = 0, left_x = 0, friction = 0, force_z = 0
  end type account_type

  !> The element at the edge, of whose cell the contact has only a part: what corrects the sum over
  !> the others.
  type :: rim_type
    real(dp) :: weight, trial, response, limit
  end type rim_type

contains

  pure subroutine follow_elements(walk, g, tau, level, memory, shear, term, body, stress, ledger) &
    bind(c, name="rst_follow_elements")
    type(walk_type), intent(in) :: walk
    real(dp), intent(in) :: g(walk%n_terms), tau(walk%n_terms)
    type(walk_level_type), intent(in) :: level(0:2*walk%n)
    real(dp), intent(in) :: memory(walk%n_terms, 0:2*walk%n)  !! M_k at the levels
    type(walk_shear_type), intent(inout) :: shear(0:2*walk%n)
    type(walk_term_type), intent(out) :: term(0:walk%n_terms, 2)
    real(dp), intent(out) :: body(0:walk%capacity - 1, columns)
    real(dp), intent(out) :: stress(0:walk%capacity - 1, 0:walk%n_terms, 2)  !! y_k, and what is left of M_k at entry
    type(ledger_type), intent(out) :: ledger
    type(account_type) :: account
    type(step_type) :: step
    real(dp) :: stuck
    integer(ip) :: l
    body = 0
    stress = 0
    do l = 0, min(walk%start, walk%end)
      shear(l) = walk_shear_type(walk%psi, 0.0_dp)
      if (walk%mode == mode_frictionless) cycle
      shear(l) = walk_shear_type(walk%psi - 2*walk%chi*(1 - level(l)%velocity), level(l)%force) ! gross slip
    end do
    stuck = 0
    do l = 0, walk%end - 1
      call measure_step(walk, g, tau, l, level(l + 1)%step, stuck, term(:, 1), step)
      term(0, 1)%normal = walk%g_inf*level(l)%depth
      term(1:, 1)%normal = memory(:, l)
      if (l < walk%n) &
        call enter_contact(walk, l, level, shear(l)%velocity, term(:, 1), step, body, stress, account)
      term(0, 1)%normal = walk%g_inf*level(l + 1)%depth
      term(1:, 1)%normal = memory(:, l + 1)
      call relax(walk, l < walk%start, level(l + 1)%velocity, term(:, 1), step, body, stress(:, :, 1), stress(:, :, 2))
      call step_normal(walk, l, level, step, body, account)
      if (l >= walk%start) &
        call step_shear(walk, g, tau, l, level, shear(l:l + 1), term, step, body, stress(:, :, 1), account, stuck)
      if (l >= walk%n) call leave_contact(walk, step%last, term(:, 1), body(:, c_weight), stress, account)
    end do
    call close_accounts(walk, level(min(walk%start, walk%end))%velocity, account, ledger)
  end subroutine follow_elements

  !> Element j is touched. It moves with the contact point unless that is faster than the sphere:
  !> then it slips at once. Arms that relax within the step are dashpots to it.
  pure subroutine enter_contact(walk, j, level, velocity, term, step, body, stress, account)
    type(walk_type), intent(in) :: walk
    integer(ip), intent(in) :: j
    type(walk_level_type), intent(in) :: level(0:walk%n)
    real(dp), intent(in) :: velocity  !! of the contact point
    type(walk_term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(inout) :: body(0:walk%capacity - 1, columns), stress(0:walk%capacity - 1, 0:walk%n_terms, 2)
    type(account_type), intent(inout) :: account
    real(dp) :: own
    own = velocity
    if (walk%mode /= mode_no_slip) own = min(max(velocity, -level(j)%velocity), level(j)%velocity)
    body(j, c_weight) = (level(j + 1)%radius - level(max(j - 1, 0_ip))%radius)/2
    body(j, c_slip) = velocity - own
    body(j, c_force) = step%viscous*own
    body(j, c_limit) = step%viscous*level(j)%velocity
    stress(j, :, 1) = 0
    stress(j, :, 2) = term%normal
    account%force_z = account%force_z + body(j, c_weight)*step%viscous*level(j)%velocity
  end subroutine enter_contact

  !> Element j leaves; what it holds is lost.
  pure subroutine leave_contact(walk, j, term, weight, stress, account)
    type(walk_type), intent(in) :: walk
    integer(ip), intent(in) :: j
    type(walk_term_type), intent(in) :: term(0:walk%n_terms)
    real(dp), intent(inout) :: weight(0:walk%capacity - 1)
    real(dp), intent(in) :: stress(0:walk%capacity - 1, 0:walk%n_terms, 2)
    type(account_type), intent(inout) :: account
    integer(ip) :: k
    do k = 0, walk%n_terms
      if (.not. term(k)%g > 0) cycle  ! G_inf of a fluid
      account%left_z = account%left_z + weight(j)*(term(k)%normal - stress(j, k, 2))**2/(2*term(k)%g)
      account%left_x = account%left_x + weight(j)*stress(j, k, 1)**2/(2*term(k)%g)
    end do
    weight(j) = 0
  end subroutine leave_contact

  !> Work in z. While all slips, elements take up in x what they do in z.
  pure subroutine step_normal(walk, l, level, step, body, account)
    type(walk_type), intent(in) :: walk
    integer(ip), intent(in) :: l
    type(walk_level_type), intent(in) :: level(0:2*walk%n)
    type(step_type), intent(in) :: step
    real(dp), intent(inout) :: body(0:walk%capacity - 1, columns)
    type(account_type), intent(inout) :: account
    real(dp) :: force, work
    force = weighted_sum(walk, step, body(:, c_weight), body(:, c_limit))
    work = step%h/4*(account%force_z + force)*(level(l)%velocity + level(l + 1)%velocity)
    account%work_z = account%work_z + work
    account%force_z = force
    if (l >= walk%start) return
    account%work_x = account%work_z
    body(0:step%top, c_slip) = 0
    body(0:step%top, c_force) = body(0:step%top, c_limit)
  end subroutine step_normal

  !> From level l to the next one in x.
  pure subroutine step_shear(walk, g, tau, l, level, shear, term, step, body, stress, account, stuck)
    type(walk_type), intent(in) :: walk
    real(dp), intent(in) :: g(walk%n_terms), tau(walk%n_terms)
    integer(ip), intent(in) :: l
    type(walk_level_type), intent(in) :: level(0:2*walk%n)
    type(walk_shear_type), intent(inout) :: shear(0:1)
    type(walk_term_type), intent(inout) :: term(0:walk%n_terms, 2)  !! of the step, and room
    type(step_type), intent(in) :: step
    real(dp), intent(inout) :: body(0:walk%capacity - 1, columns), stress(0:walk%capacity - 1, 0:walk%n_terms)
    type(account_type), intent(inout) :: account
    real(dp), intent(out) :: stuck  !! weight of the elements that stick
    type(rim_type) :: rim
    real(dp) :: share, friction, work, more
    integer(ip) :: i
    body(0:step%top, c_trial) = body(0:step%top, c_trial) &
                                + step%start_response*(shear(0)%velocity - (1 - step%drop)*body(0:step%top, c_slip))
    ! in the compression the rim enters with half a cell at the end of the step; in the restitution
    ! it leaves, with all of its cell in the sum, of which half a cell is still in contact: that
    ! counts only without slip
    associate (edge => level(step%last:step%last + 1)%radius)
      rim = rim_type((edge(2) - edge(1))/2, 0.0_dp, step%viscous, step%viscous*max(level(l + 1)%velocity, 0.0_dp))
      if (l >= walk%n) rim = rim_type((edge(1) - edge(2))/2, body(step%last, c_trial), step%end_response, 0.0_dp)
    end associate
    share = account%force_z + rim%weight*rim%limit
    share = merge(level(l + 1)%force/max(share, tiny(share)), 1.0_dp, share > 0)
    if (walk%mode == mode_no_slip) body(0:step%top, c_limit) = huge(1.0_dp)
    if (walk%mode == mode_no_slip) rim%limit = huge(1.0_dp)
    call find_velocity(walk, level(l:l + 1), share, rim, step, body, shear, stuck)
    call move_elements(walk, term(:, 1), step, shear%velocity, body, stress, friction, work)
    do i = 0, merge(step%last, -1_ip, walk%divides /= 0)
      if (abs(body(i, c_stuck)) < huge(1.0_dp) .and. abs(body(i, c_slip)) > 0) then
        call begin_to_slip(walk, g, tau, step, i, term(:, 1), term(:, 2), body, stress, more)
        friction = friction + more
        work = work - more
      end if
    end do
    account%friction = account%friction + friction
    account%work_x = account%work_x + work
  end subroutine step_shear

  !> Find U' at the end of the step, by Newton's method within a bracket, or take what is
  !> prescribed; and S.
  !>
  !> U'(1) = U'(0) - push ((1 - w) S(0) + w S(1)), where push makes the impulse of N exact. w = 1/2
  !> + z/12 + ... is exact for U'' = -z U'/h: with 1/2, U' would swing where dashpots hold the
  !> sphere within a step (large z).
  pure subroutine find_velocity(walk, level, share, rim, step, body, shear, stuck)
    type(walk_type), intent(in) :: walk
    type(walk_level_type), intent(in) :: level(0:1)
    real(dp), intent(in) :: share  !! N over its sum
    type(rim_type), intent(in) :: rim
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: body(0:walk%capacity - 1, columns)
    type(walk_shear_type), intent(inout) :: shear(0:1)
    real(dp), intent(out) :: stuck  !! weight of the elements that stick, as the force has it
    type(memory_type) :: m
    real(dp) :: w, push, v, low, high, miss, change, force, slope, q
    integer(ip) :: trial
    m = memory_of(2*mass_factor*walk%chi*step%h*step%viscous*max(level(0)%radius, level(1)%radius))
    w = m%phi2/m%phi1
    push = step%stretch*2*walk%chi*(level(0)%velocity - level(1)%velocity)/((1 - w)*level(0)%force + w*level(1)%force)
    v = shear(0)%velocity
    if (level(0)%force > 0) v = v - 2*walk%chi*(level(0)%velocity - level(1)%velocity)*shear(0)%force/level(0)%force
    if (walk%prescribed /= 0) v = shear(1)%velocity
    low = -huge(v)
    high = huge(v)
    do trial = 1, most_trials
      call friction_force(walk, step, v, body, force, slope)
      q = rim%trial + rim%response*v
      force = share*(force + rim%weight*min(max(q, -rim%limit), rim%limit))
      if (abs(q) <= rim%limit) slope = slope + rim%weight*rim%response
      slope = share*slope
      if (walk%prescribed /= 0) exit
      miss = v - shear(0)%velocity + push*((1 - w)*shear(0)%force + w*force)
      low = max(low, merge(v - miss, v, miss > 0))  ! the derivative is at least 1
      high = min(high, merge(v, v - miss, miss > 0))
      change = -miss/(1 + push*w*slope)
      if (v + change < low .or. v + change > high) change = (low + high)/2 - v
      v = v + change
      if (abs(change) <= walk_closeness*walk%psi) exit
    end do
    shear(1) = walk_shear_type(v, force)
    stuck = slope/step%end_response
  end subroutine find_velocity

  !> What an element took up and does not hold when it leaves was dissipated in it. Gross slip,
  !> until the sphere had `velocity`, added int N (U' - D') ds with N = -D''/mass_factor.
  pure subroutine close_accounts(walk, velocity, account, ledger)
    type(walk_type), intent(in) :: walk
    real(dp), intent(in) :: velocity
    type(account_type), intent(in) :: account
    type(ledger_type), intent(out) :: ledger
    real(dp) :: slide, friction
    logical :: elastic
    slide = (walk%psi - 2*walk%chi + (2*walk%chi - 1)*(1 + velocity)/2)*(1 - velocity)/mass_factor
    elastic = walk%n_terms == 0 .and. walk%eta <= 0
    friction = account%friction
    if (elastic .and. friction > 0) friction = friction + account%work_x - account%left_x
    ledger%left_z = 2*mass_factor*account%left_z
    ledger%viscous_z = 2*mass_factor*max(account%work_z - account%left_z, 0.0_dp)
    ledger%friction_x = 4*mass_factor*walk%chi*max(friction + slide, 0.0_dp)
    ledger%left_x = 4*mass_factor*walk%chi*account%left_x
    ledger%viscous_x = 4*mass_factor*walk%chi*max(account%work_x - account%left_x, 0.0_dp)
    if (walk%mode == mode_frictionless) ledger = ledger_type(ledger%viscous_z, ledger%left_z, 0.0_dp, 0.0_dp, 0.0_dp)
    if (elastic) ledger%viscous_z = 0  ! not rounding
    if (elastic) ledger%viscous_x = 0
  end subroutine close_accounts
end module rst_sync_walk
