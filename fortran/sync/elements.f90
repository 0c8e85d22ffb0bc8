!> The tangential motion of an impact by elements (docs/theory.md, the method `sync`): for slip that sticks again, and for the
!> energy ledger. Module rst_sync_element_step has the step of the elements; here are the contact and the sphere.
!>
!> Elements sit at the radii X_j of the levels. Level l <= n of the compression is the instant at which the edge of the
!> contact is at X_l; level 2n - l is that of the restitution. So elements enter and leave exactly at a level.
!>
!> Both sums, over elements and over time, lean on the normal problem, whose force N and impulse are known: the share of friction
!> that is used, by the trapezoidal rule, times N. Full slip is then exact, and all else is second order.
!>
!> Use: choose walk%n >= 1 and walk%capacity; fill level(0:2n), memory(n_terms, 0:2n), and with `prescribed` also
!> shear(start:2n)%velocity. term, body and stress are room, whatever they contain. Call follow_elements. shear then has U' and
!> S = int_0^A q dX at all levels, and ledger its accounts (module rst_ledger), which are 0 if not asked for.
!> Without friction: chi = 0 and start = 2n give the accounts in z.
module rst_sync_walk
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of
  use rst_ledger, only: ledger_type
  use rst_sync_element_step, only: walk_type, term_type, step_type, room_columns, column_weight, column_limit, column_trial, &
                                   column_slip, column_force, column_power, column_turn, measure_step, relax_normal, &
                                   limit_friction, note_power, relax_shear, friction_force, move_elements, work_of, weighted_sum
  implicit none (type, external)
  private
  public :: walk_type, walk_level_type, walk_shear_type, term_type, room_columns, follow_elements

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp

  !> The normal motion at a level. Twin of `struct walk_level` in C.
  type, bind(c) :: walk_level_type
    real(dp) :: step      !! time since the level before, with all its digits
    real(dp) :: radius    !! of the contact
    real(dp) :: depth, velocity, force
  end type walk_level_type

  !> U' and S at a level. Twin of `struct walk_shear` in C.
  type, bind(c) :: walk_shear_type
    real(dp) :: velocity, force
  end type walk_shear_type

  !> Energies so far, in units of the force N times the depth.
  type :: account_type
    real(dp) :: work_z = 0, left_z = 0, work_x = 0, left_x = 0, friction = 0
  end type account_type

  !> The element at the edge, of which the contact has only a part at the end of the step: what its part has on top of the sum
  !> over all other elements.
  type :: rim_type
    real(dp) :: weight, trial, response, limit
  end type rim_type

contains

  pure subroutine follow_elements(walk, g, tau, level, memory, shear, term, body, stress, ledger)
    type(walk_type), intent(in) :: walk
    real(dp), intent(in) :: g(walk%n_terms), tau(walk%n_terms)
    type(walk_level_type), intent(in) :: level(0:2*walk%n)
    real(dp), intent(in) :: memory(walk%n_terms, 0:2*walk%n)  !! M_k at the levels
    type(walk_shear_type), intent(inout) :: shear(0:2*walk%n)
    type(term_type), intent(out) :: term(0:walk%n_terms)
    real(dp), intent(out) :: body(0:walk%capacity - 1, room_columns)
    real(dp), intent(out) :: stress(0:walk%capacity - 1, 0:walk%n_terms, 2)  !! of shear, and what is left of M_k at entry
    type(ledger_type), intent(out) :: ledger
    type(account_type) :: account
    type(step_type) :: step
    integer(ip) :: l
    body = 0
    stress = 0
    do l = 0, 2*walk%n
      call note_normal(walk, level(l), memory(:, l), term)
      if (l <= walk%start) shear(l)%velocity = walk%psi - 2*walk%chi*(1 - level(l)%velocity)
      if (l <= walk%start) shear(l)%force = level(l)%force
      if (l > walk%n) call leave_contact(walk, 2*walk%n - l, term, body(:, column_weight), stress, account)
      if (l < walk%n) call enter_contact(walk, l, level, shear(l)%velocity, term, body, stress)
      if (l == walk%start) call end_gross_slip(walk, l, level(l)%velocity, term, body, stress, account)
      if (l == 2*walk%n) exit
      step%last = min(l, 2*walk%n - l - 1)
      call measure_step(walk, g, tau, level(l + 1)%step, term, step)
      if (walk%keeps_ledger /= 0) &
        call post_normal(walk, level(l:l + 1)%velocity, term, step, body(:, column_weight), stress(:, :, 2), account)
      call relax_normal(walk, term, step, stress(:, :, 2))
      if (l < walk%start) cycle
      call note_normal(walk, level(l + 1), memory(:, l + 1), term)
      call step_shear(walk, l, level, shear(l:l + 1), term, step, body, stress, account)
    end do
    call close_accounts(walk, account, ledger)
  end subroutine follow_elements

  pure subroutine note_normal(walk, level, memory, term)
    type(walk_type), intent(in) :: walk
    type(walk_level_type), intent(in) :: level
    real(dp), intent(in) :: memory(walk%n_terms)
    type(term_type), intent(inout) :: term(0:walk%n_terms)
    term(0)%normal = walk%g_inf*level%depth
    term(1:)%normal = memory
  end subroutine note_normal

  !> Element j is touched. It moves with the contact point unless that is faster than the sphere: then it would slip at once.
  pure subroutine enter_contact(walk, j, level, velocity, term, body, stress)
    type(walk_type), intent(in) :: walk
    integer(ip), intent(in) :: j
    type(walk_level_type), intent(in) :: level(0:walk%n)
    real(dp), intent(in) :: velocity  !! of the contact point
    type(term_type), intent(in) :: term(0:walk%n_terms)
    real(dp), intent(inout) :: body(0:walk%capacity - 1, room_columns)
    real(dp), intent(inout) :: stress(0:walk%capacity - 1, 0:walk%n_terms, 2)
    real(dp) :: own
    own = velocity
    if (walk%no_slip == 0) own = min(max(velocity, -level(j)%velocity), level(j)%velocity)
    body(j, column_weight) = (level(j + 1)%radius - level(max(j - 1, 0_ip))%radius)/2
    body(j, column_slip) = velocity - own
    body(j, column_force) = walk%eta*own
    stress(j, :, 2) = term%normal
  end subroutine enter_contact

  !> Element j leaves; what it holds is lost.
  pure subroutine leave_contact(walk, j, term, weight, stress, account)
    type(walk_type), intent(in) :: walk
    integer(ip), intent(in) :: j
    type(term_type), intent(in) :: term(0:walk%n_terms)
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

  !> All elements in contact stick, with the stresses of the normal problem. Up to here they took up in x what they did in z.
  !> Friction work in units of force times depth: int N (U' - D') ds with N = -D''/mass_factor.
  pure subroutine end_gross_slip(walk, l, velocity, term, body, stress, account)
    type(walk_type), intent(in) :: walk
    integer(ip), intent(in) :: l
    real(dp), intent(in) :: velocity  !! of the sphere
    type(term_type), intent(in) :: term(0:walk%n_terms)
    real(dp), intent(inout) :: body(0:walk%capacity - 1, room_columns)
    real(dp), intent(inout) :: stress(0:walk%capacity - 1, 0:walk%n_terms, 2)
    type(account_type), intent(inout) :: account
    integer(ip) :: i, k
    if (l == 0) return
    body(:, column_slip) = 0
    body(:, column_force) = walk%eta*velocity
    do k = 0, walk%n_terms
      do i = 0, min(l, 2*walk%n - l - 1)
        stress(i, k, 1) = term(k)%normal - stress(i, k, 2)
        body(i, column_force) = body(i, column_force) + stress(i, k, 1)
      end do
    end do
    account%work_x = account%work_z
    account%left_x = account%left_z
    account%friction = (walk%psi - 2*walk%chi + (2*walk%chi - 1)*(1 + velocity)/2)*(1 - velocity)/mass_factor
  end subroutine end_gross_slip

  !> From level l to the next one in x.
  pure subroutine step_shear(walk, l, level, shear, term, step, body, stress, account)
    type(walk_type), intent(in) :: walk
    integer(ip), intent(in) :: l
    type(walk_level_type), intent(in) :: level(0:2*walk%n)
    type(walk_shear_type), intent(inout) :: shear(0:1)
    type(term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(inout) :: body(0:walk%capacity - 1, room_columns)
    real(dp), intent(inout) :: stress(0:walk%capacity - 1, 0:walk%n_terms, 2)
    type(account_type), intent(inout) :: account
    type(rim_type) :: rim
    real(dp) :: share, friction
    call limit_friction(walk, term, step, level(l + 1)%velocity, stress(:, :, 2), body(:, column_limit))
    if (l >= walk%n) body(step%last, column_limit) = 0  ! leaves
    if (walk%keeps_ledger /= 0) &
      call note_power(walk, term, step, stress(:, :, 1), body(:, column_power), body(:, column_turn))
    call relax_shear(walk, term, step, shear(0)%velocity, stress(:, :, 1), body(:, column_slip), body(:, column_trial))
    share = weighted_sum(walk, step, body(:, column_weight), body(:, column_limit))
    rim = rim_of(walk, l, level, step, body)
    if (l < walk%n) share = share + rim%weight*rim%limit
    share = merge(level(l + 1)%force/max(share, tiny(share)), 1.0_dp, share > 0)
    if (walk%no_slip /= 0) body(:, column_limit) = huge(1.0_dp)
    if (walk%no_slip /= 0) rim%limit = huge(1.0_dp)
    call find_velocity(walk, level(l:l + 1), share, rim, step, body, shear)
    call move_elements(walk, term, step, shear%velocity, body, stress(:, :, 1), friction)
    if (walk%keeps_ledger == 0) return
    account%friction = account%friction + friction
    account%work_x = account%work_x + work_of(walk, step, shear(1)%velocity, body)
  end subroutine step_shear

  !> In the compression the rim enters with half of a cell at the end of the step. In the restitution the sum has it with its whole
  !> weight; half a cell of it is in contact, which counts only if friction has no limit.
  pure function rim_of(walk, l, level, step, body) result(rim)
    type(walk_type), intent(in) :: walk
    integer(ip), intent(in) :: l
    type(walk_level_type), intent(in) :: level(0:2*walk%n)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: body(0:walk%capacity - 1, room_columns)
    type(rim_type) :: rim
    if (l < walk%n) then
      rim = rim_type((level(l + 1)%radius - level(l)%radius)/2, 0.0_dp, walk%eta, walk%eta*max(level(l + 1)%velocity, 0.0_dp))
    else
      rim = rim_type((level(step%last)%radius - level(step%last + 1)%radius)/2, body(step%last, column_trial), &
                     step%end_response, body(step%last, column_limit))
    end if
  end function rim_of

  !> Find U' at the end of the step, by Newton's method within a bracket, or take what is prescribed; and S.
  !>
  !> U'(1) = U'(0) - 2 chi mass_factor i ((1 - w) S(0) + w S(1)), where i makes the impulse of N exact. w = 1/2 + z/12 + ... is
  !> exact for U'' = -z U'/h: the rule 1/2 would let U' swing where dashpots hold the sphere within a step (large z).
  pure subroutine find_velocity(walk, level, share, rim, step, body, shear)
    type(walk_type), intent(in) :: walk
    type(walk_level_type), intent(in) :: level(0:1)
    real(dp), intent(in) :: share  !! N over its sum
    type(rim_type), intent(in) :: rim
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: body(0:walk%capacity - 1, room_columns)
    type(walk_shear_type), intent(inout) :: shear(0:1)
    integer(ip), parameter :: most_trials = 60  !! halvings that exhaust all digits
    real(dp), parameter :: tolerance = 1.0e-14_dp
    type(memory_type) :: m
    real(dp) :: w, push, v, low, high, miss, change, force, slope, q
    integer(ip) :: trial
    push = 2*mass_factor*walk%chi
    m = memory_of(push*step%h*(step%end_response - step%start_response)*max(level(0)%radius, level(1)%radius))
    w = m%phi2/m%phi1
    push = 2*walk%chi*(level(0)%velocity - level(1)%velocity)/((1 - w)*level(0)%force + w*level(1)%force)
    v = shear(0)%velocity - push*shear(0)%force
    if (walk%prescribed /= 0) v = shear(1)%velocity
    low = -huge(v)
    high = huge(v)
    do trial = 1, most_trials
      call friction_force(walk, step, v, body(:, column_weight), body(:, column_limit), body(:, column_trial), force, slope)
      q = rim%trial + rim%response*v
      force = share*(force + rim%weight*min(max(q, -rim%limit), rim%limit))
      if (abs(q) <= rim%limit) slope = slope + rim%weight*rim%response
      slope = share*slope
      if (walk%prescribed /= 0) exit
      miss = v - shear(0)%velocity + push*((1 - w)*shear(0)%force + w*force)
      ! the derivative is 1 and more
      low = max(low, merge(v - miss, v, miss > 0))
      high = min(high, merge(v, v - miss, miss > 0))
      change = -miss/(1 + push*w*slope)
      if (v + change < low .or. v + change > high) change = (low + high)/2 - v
      v = v + change
      force = force + slope*change
      if (abs(change) <= tolerance*walk%psi) exit
    end do
    shear(1) = walk_shear_type(v, force)
  end subroutine find_velocity

  !> Work of the elements in z over a step: all move with the sphere, and their stresses are M_k less what is left of it at entry.
  pure subroutine post_normal(walk, velocity, term, step, weight, faded, account)
    type(walk_type), intent(in) :: walk
    real(dp), intent(in) :: velocity(0:1), weight(0:walk%capacity - 1), faded(0:walk%capacity - 1, 0:walk%n_terms)
    type(term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    type(account_type), intent(inout) :: account
    real(dp) :: whole, change, stress
    integer(ip) :: k
    whole = sum(weight(0:step%last))
    change = velocity(1) - velocity(0)
    account%work_z = account%work_z + whole*(step%work_start*velocity(0)*velocity(1) + step%work_turn*change**2)
    do k = 0, walk%n_terms
      stress = whole*term(k)%normal - weighted_sum(walk, step, weight, faded(:, k))
      account%work_z = account%work_z + stress*(term(k)%power*velocity(0) + term(k)%turn*change)
    end do
  end subroutine post_normal

  !> What an element took up and did not hold when it left was dissipated within it: its arms are integrated exactly.
  pure subroutine close_accounts(walk, account, ledger)
    type(walk_type), intent(in) :: walk
    type(account_type), intent(in) :: account
    type(ledger_type), intent(out) :: ledger
    real(dp) :: unit_z, unit_x
    ledger = ledger_type(0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
    if (walk%keeps_ledger == 0) return
    unit_z = 2*mass_factor
    unit_x = 2*walk%chi*unit_z
    ledger%left_z = unit_z*account%left_z
    ledger%left_x = unit_x*account%left_x
    ledger%friction_x = unit_x*account%friction
    if (walk%n_terms == 0 .and. .not. walk%eta > 0) return  ! nothing but rounding
    ledger%viscous_z = max(unit_z*(account%work_z - account%left_z), 0.0_dp)
    ledger%viscous_x = max(unit_x*(account%work_x - account%left_x), 0.0_dp)
  end subroutine close_accounts
end module rst_sync_walk
