!> One time step of the elements of the foundation in the tangential problem (docs/sync.md, section
!> 8).
!>
!> An element holds the stresses y_k of its spring and arms, y_k' = g_k v - y_k/tau_k, and its slip
!> velocity kappa = U' - v. The spring G_inf is the arm 0, whose relaxation time is infinite. The
!> force is q = sum_k y_k + eta v; friction limits it to f.
!>
!> In a step v is linear, from v0 to v1, so y_k becomes decay y_k + from_start v0 + from_end v1, for
!> any tau. In stick v1 = U'. Where that needs more force than f, v1 is what brings q to the limit.
!>
!> Where springs rule, kappa jumps as slip begins, and v0 must jump with it: v1 alone would swing
!> from step to step about the velocity that gives the displacement. Where dashpots rule, kappa is
!> continuous. So the share `drop` of the old kappa is replaced by the new one: the stiffness that
!> v0 meets over that of v1, 1 for springs, 0 for dashpots. This is second order: in a short step 1
!> - drop is O(h/tau) without a dashpot, so that v is constant but for O(h); with a dashpot drop is
!> O(h), and kappa changes by O(h).
module rst_sync_element_step
  use rst_motion_factors, only: mass_factor
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of
  use rst_tuning, only: largest_phase
  implicit none (type, external)
  private
  public :: walk_type, walk_term_type, step_type, columns, c_weight, c_limit, c_trial, c_slip, c_force, c_stuck
  public :: measure_step, relax, friction_force, move_elements, begin_to_slip, weighted_sum

  integer(ip), parameter :: halvings = 8  !! of the time in which an element begins to slip
  integer(ip), parameter :: lanes = 8  !! partial sums, so that no result depends on the width of vectors

  !> What an element has besides its stresses: weight in X, f, q for v1 = 0, kappa, q, v0; for the
  !> ledger f and, if it stuck, q at the start of the step.
  integer(ip), parameter :: c_weight = 1, c_limit = 2, c_trial = 3, c_slip = 4, c_force = 5, c_start = 6, &
                            c_limit_before = 7, c_stuck = 8, columns = 8

  !> What is to be computed. Twin of `struct walk` in C.
  type, bind(c) :: walk_type
    integer(ip) :: n, n_terms
    integer(ip) :: capacity    !! room for elements: n + 1, rounded up to a multiple of 8
    integer(ip) :: start       !! level at which gross slip ends: 0 for psi <= 1, 2 n if never
    integer(ip) :: end         !! the last level: 2 n, or n for a sphere that stops in the solid
    integer(ip) :: mode        !! how friction acts
    integer(ip) :: prescribed  !! 1: U' is given from the level `start` on
    integer(ip) :: divides     !! 1: slip begins within a step, for the parts of the ledger
    real(dp) :: chi, psi, g_inf, eta  !! psi: U' at first touch, 1 without slip or friction
  end type walk_type

  !> An arm in a step, and M_k at the level where the walk is. Twin of `struct walk_term` in C.
  type, bind(c) :: walk_term_type
    real(dp) :: g, decay, from_start, from_end, normal
  end type walk_term_type

  !> A step as all elements meet it: response of q to v0, to v1, and their difference, the viscous
  !> part.
  type :: step_type
    real(dp) :: h, start_response, end_response, viscous, drop
    real(dp) :: stretch  !! of h in the tangential motion
    integer(ip) :: last  !! elements 0 to last are in contact
    integer(ip) :: top   !! elements 0 to top are computed, whole groups of lanes; the others weigh nothing
  end type step_type

contains

  !> The step after level l, of length h, in which elements of total weight `stuck` stick.
  !>
  !> Their springs make U' swing at a rate omega. The trapezoidal rule lags behind by the share
  !> (omega h)^2/12 of a swing; at large chi that would be nearly all of the error. It is exact for
  !> the step 2 tan(omega h/2)/omega, which therefore replaces h. Arms that relax within a step are
  !> no springs: each counts by its decay.
  pure subroutine measure_step(walk, g, tau, l, h, stuck, term, step)
    type(walk_type), intent(in) :: walk
    real(dp), intent(in) :: g(walk%n_terms), tau(walk%n_terms), h, stuck
    integer(ip), intent(in) :: l
    type(walk_term_type), intent(inout) :: term(0:walk%n_terms)
    type(step_type), intent(inout) :: step
    type(memory_type) :: m
    real(dp) :: square, stretch  ! of omega h/2; 2 tan(omega h/2)/(omega h) - 1
    integer(ip) :: k
    m = memory_of(0.0_dp)
    term(0)%g = walk%g_inf
    do k = 0, walk%n_terms
      if (k > 0) m = memory_of(h/tau(max(k, 1_ip)))
      if (k > 0) term(k)%g = g(max(k, 1_ip))
      term(k)%decay = m%decay
      term(k)%from_start = term(k)%g*h*(m%phi1 - m%phi2)
      term(k)%from_end = term(k)%g*h*m%phi2
    end do
    step%last = min(l, 2*walk%n - l - 1)
    step%top = step%last/lanes*lanes + lanes - 1
    step%h = h
    square = min(mass_factor*walk%chi*h*sum(term%decay*term%from_start)*stuck, largest_phase)
    stretch = square/3 + 2*square**2/15
    step%stretch = 1 + stretch
    term%from_start = (1 + stretch*term%decay)*term%from_start
    term%from_end = (1 + stretch*term%decay)*term%from_end
    step%start_response = sum(term%from_start)
    step%end_response = sum(term%from_end) + walk%eta
    step%viscous = max(step%end_response - step%start_response, 0.0_dp)
    step%drop = 1 - step%viscous/step%end_response
  end subroutine measure_step

  !> Fade what elements keep of M_k at entry, and find their friction limit at the end of the step,
  !> where the sphere has `velocity`. Relax their stresses, and add them up in `trial`. In gross
  !> slip they are those in z.
  pure subroutine relax(walk, gross, velocity, term, step, body, stress, faded)
    type(walk_type), intent(in) :: walk
    logical, intent(in) :: gross
    real(dp), intent(in) :: velocity
    type(walk_term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(inout) :: body(0:walk%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:walk%capacity - 1, 0:walk%n_terms) :: stress, faded
    real(dp) :: normal, from_normal, from_shear
    integer(ip) :: i, k
    if (walk%divides /= 0) then
      body(0:step%top, c_limit_before) = body(0:step%top, c_limit)
      body(0:step%top, c_stuck) = merge(body(0:step%top, c_force), huge(1.0_dp), abs(body(0:step%top, c_slip)) <= 0)
    end if
    from_normal = merge(1.0_dp, 0.0_dp, gross)
    body(0:step%top, c_limit) = walk%eta*velocity
    body(0:step%top, c_trial) = 0
    do k = 0, walk%n_terms
      normal = term(k)%normal
      from_shear = merge(0.0_dp, term(k)%decay, gross)
      !$omp simd
      do i = 0, step%top
        faded(i, k) = term(k)%decay*faded(i, k)
        body(i, c_limit) = body(i, c_limit) + (normal - faded(i, k))
        stress(i, k) = from_shear*stress(i, k) + from_normal*(normal - faded(i, k))
        body(i, c_trial) = body(i, c_trial) + stress(i, k)
      end do
    end do
    body(0:step%top, c_limit) = max(body(0:step%top, c_limit), 0.0_dp)
  end subroutine relax

  !> Sum of all forces for U' = velocity at the end of the step, and its derivative.
  pure subroutine friction_force(walk, step, velocity, body, force, slope)
    type(walk_type), intent(in) :: walk
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: velocity, body(0:walk%capacity - 1, columns)
    real(dp), intent(out) :: force, slope
    real(dp) :: q, limit, forces(lanes), stuck(lanes)
    integer(ip) :: first, i, l
    forces = 0
    stuck = 0
    do first = 0, step%top, lanes
      !$omp simd private(i, q, limit)
      do l = 1, lanes
        i = first + l - 1
        limit = body(i, c_limit)
        q = body(i, c_trial) + step%end_response*velocity
        forces(l) = forces(l) + body(i, c_weight)*min(max(q, -limit), limit)
        stuck(l) = stuck(l) + merge(body(i, c_weight), 0.0_dp, abs(q) <= limit)
      end do
    end do
    force = sum(forces)
    slope = step%end_response*sum(stuck)
  end subroutine friction_force

  !> Move the elements while U' goes from velocity(0) to velocity(1). Work of friction, and what the
  !> elements take up: mean forces on mean velocities, by which springs dissipate nothing.
  pure subroutine move_elements(walk, term, step, velocity, body, stress, friction, work)
    type(walk_type), intent(in) :: walk
    type(walk_term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: velocity(0:1)
    real(dp), intent(inout) :: body(0:walk%capacity - 1, columns), stress(0:walk%capacity - 1, 0:walk%n_terms)
    real(dp), intent(out) :: friction, work
    real(dp) :: admittance, q, limit, kept, slip, impulse, loss, frictions(lanes), works(lanes)
    integer(ip) :: first, i, k, l
    admittance = 1/(step%end_response + step%drop*step%start_response)
    frictions = 0
    works = 0
    do first = 0, step%top, lanes
      !$omp simd private(i, q, limit, kept, slip, impulse, loss)
      do l = 1, lanes
        i = first + l - 1
        limit = body(i, c_limit)
        q = body(i, c_trial) + step%end_response*velocity(1)
        slip = (q - min(max(q, -limit), limit))*admittance
        q = min(max(q, -limit), limit)
        kept = (1 - step%drop)*body(i, c_slip) + step%drop*slip
        impulse = body(i, c_weight)*step%stretch*step%h/6
        loss = impulse*(body(i, c_force)*(2*kept + slip) + q*(kept + 2*slip))
        frictions(l) = frictions(l) + loss
        works(l) = works(l) + 1.5_dp*impulse*(body(i, c_force) + q)*(velocity(0) + velocity(1)) - loss
        body(i, c_force) = q
        body(i, c_slip) = slip
        body(i, c_start) = velocity(0) - kept
      end do
    end do
    friction = sum(frictions)
    work = sum(works)
    do k = 0, walk%n_terms
      !$omp simd
      do i = 0, step%top
        stress(i, k) = stress(i, k) + term(k)%from_start*body(i, c_start) &
                       + term(k)%from_end*(velocity(1) - body(i, c_slip))
      end do
    end do
  end subroutine move_elements

  !> The element j sticks at the start of the step and slips at its end. This replaces what
  !> move_elements made of its stresses and its slip, and gives how much more friction takes. Slip
  !> begins where f and q, which are linear in the step, meet. From there the force that slip takes
  !> away grows from 0 to `excess`. As arms may relax meanwhile, time is halved again and again
  !> towards that instant.
  pure subroutine begin_to_slip(walk, g, tau, step, j, term, brief, body, stress, more)
    type(walk_type), intent(in) :: walk
    real(dp), intent(in) :: g(walk%n_terms), tau(walk%n_terms)
    type(step_type), intent(in) :: step
    integer(ip), intent(in) :: j
    type(walk_term_type), intent(in) :: term(0:walk%n_terms)
    type(walk_term_type), intent(inout) :: brief(0:walk%n_terms)  !! room; `normal`: stress that slip takes away
    real(dp), intent(inout) :: body(0:walk%capacity - 1, columns), stress(0:walk%capacity - 1, 0:walk%n_terms)
    real(dp), intent(out) :: more
    type(step_type) :: short
    real(dp) :: slip, excess, part, fall, rate(0:1), at, to
    integer(ip) :: i
    slip = body(j, c_slip)
    more = -(body(j, c_stuck)*(2*step%drop + 1) + body(j, c_force)*(step%drop + 2))*step%stretch*step%h/6*slip
    excess = abs(slip)*(step%end_response + step%drop*step%start_response)
    part = excess/(excess + max(body(j, c_limit_before) - sign(body(j, c_stuck), body(j, c_stuck)*slip), 0.0_dp))
    fall = part*(body(j, c_limit_before) - body(j, c_limit))
    brief%normal = 0
    rate = 0
    at = 0
    to = 0.5_dp**halvings
    do i = 0, halvings
      call measure_step(walk, g, tau, 0_ip, (to - at)*part*step%h, 0.0_dp, brief, short)
      rate(0) = (1 - short%drop)*rate(1)
      rate(1) = (to*excess - sum(brief%decay*brief%normal) - short%start_response*rate(0)) &
                /(short%end_response + short%drop*short%start_response)
      rate(0) = rate(0) + short%drop*rate(1)
      brief%normal = brief%decay*brief%normal + brief%from_start*rate(0) + brief%from_end*rate(1)
      more = more + short%h/6*((body(j, c_limit) + (1 - at)*fall)*(2*rate(0) + rate(1)) &
                               + (body(j, c_limit) + (1 - to)*fall)*(rate(0) + 2*rate(1)))
      at = to
      to = 2*to
    end do
    more = body(j, c_weight)*more
    stress(j, :) = stress(j, :) + (step%drop*term%from_start + term%from_end)*slip - sign(1.0_dp, slip)*brief%normal
    body(j, c_slip) = sign(rate(1), slip)
  end subroutine begin_to_slip

  !> sum_i weight_i x_i of the elements in contact; others have no weight.
  pure function weighted_sum(walk, step, weight, x) result(total)
    type(walk_type), intent(in) :: walk
    type(step_type), intent(in) :: step
    real(dp), intent(in), dimension(0:walk%capacity - 1) :: weight, x
    real(dp) :: total, sums(lanes)
    integer(ip) :: first
    sums = 0
    do first = 0, step%top, lanes
      sums = sums + weight(first:first + lanes - 1)*x(first:first + lanes - 1)
    end do
    total = sum(sums)
  end function weighted_sum
end module rst_sync_element_step
