!> One time step of the elements of the foundation in the tangential problem (docs/theory.md, the method `sync`).
!>
!> State of element i: the stresses y_k of its springs and arms with y_k' = g_k v - y_k/tau_k, and its slip velocity
!> kappa = U' - v. The spring G_inf is the arm 0, whose relaxation time is infinite. Its force is q = sum_k y_k + eta v.
!>
!> In a step v is linear, v0 to v1, so an arm becomes decay y + from_start v0 + from_end v1 exactly, for any tau.
!> v1 = U' sticks; if the force of stick exceeds the friction limit f, v1 is the one that brings q to the limit.
!>
!> Where springs rule, the slip velocity may jump as slip begins, and v0 has to jump with it: an end velocity found from the
!> displacement alone would swing about its mean from step to step. Where dashpots rule, it is continuous. So of the
!> slip velocity at the start of the step the share `drop` is replaced by that at the end. drop is the stiffness that v0
!> meets over the one that v1 meets: 1 for springs, 0 for dashpots. Both limits are second order, and so is what lies between.
module rst_sync_element_step
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of
  implicit none (type, external)
  private
  public :: walk_type, term_type, step_type, room_columns, lanes
  public :: column_weight, column_limit, column_trial, column_slip, column_start, column_force, column_power, column_turn
  public :: measure_step, relax_normal, limit_friction, note_power, relax_shear, friction_force, move_elements
  public :: work_of, weighted_sum

  integer(ip), parameter :: lanes = 8  !! so many partial sums, whatever the width of vectors: sums are the same everywhere

  !> What each element has besides its stresses: weight in X, friction limit, force if v1 were 0, slip velocity kappa, v0, force
  !> and, for the ledger, the factors of v0 and of v1 - v0 in the work of its stresses. The rest of the room: stresses.
  integer(ip), parameter :: column_weight = 1, column_limit = 2, column_trial = 3, column_slip = 4, column_start = 5
  integer(ip), parameter :: column_force = 6, column_power = 7, column_turn = 8
  integer(ip), parameter :: room_columns = 8

  !> What is to be computed. Twin of `struct walk` in C.
  type, bind(c) :: walk_type
    integer(ip) :: n, n_terms
    integer(ip) :: capacity      !! elements of room for each column: n + 1, rounded up to a multiple of lanes
    integer(ip) :: start         !! level at which gross slip ends, 0 for psi <= 1, 2 n if it never ends
    integer(ip) :: no_slip       !! 1: friction without limit
    integer(ip) :: prescribed    !! 1: U' is given from the level `start` on
    integer(ip) :: keeps_ledger  !! 1: fill the ledger
    real(dp) :: chi, psi, g_inf, eta
  end type walk_type

  !> An arm in a step. Twin of `struct walk_term` in C.
  type, bind(c) :: term_type
    real(dp) :: g, decay, from_start, from_end, power, turn
    real(dp) :: normal  !! M_k at the level where the walk is
  end type term_type

  !> The step as all elements meet it: how the force answers v0 and v1, and factors of its work.
  type :: step_type
    real(dp) :: h, start_response, end_response, drop, work_start, work_turn
    integer(ip) :: last  !! elements 0 to last are in contact
  end type step_type

contains

  !> Coefficients of a step of length h.
  pure subroutine measure_step(walk, g, tau, h, term, step)
    type(walk_type), intent(in) :: walk
    real(dp), intent(in) :: g(walk%n_terms), tau(walk%n_terms), h
    type(term_type), intent(inout) :: term(0:walk%n_terms)
    type(step_type), intent(inout) :: step
    type(memory_type) :: m
    real(dp) :: z
    integer(ip) :: k
    step%h = h
    step%start_response = 0
    step%end_response = walk%eta
    step%work_turn = walk%eta*h/3
    do k = 0, walk%n_terms
      z = 0
      if (k > 0) z = h/tau(k)
      m = memory_of(z)
      term(k)%g = walk%g_inf
      if (k > 0) term(k)%g = g(k)
      term(k)%decay = m%decay
      term(k)%from_start = term(k)%g*h*(m%phi1 - m%phi2)
      term(k)%from_end = term(k)%g*h*m%phi2
      term(k)%power = h*m%phi1
      term(k)%turn = h*(m%phi1 - m%phi2)
      step%start_response = step%start_response + term(k)%from_start
      step%end_response = step%end_response + term(k)%from_end
      step%work_turn = step%work_turn + term(k)%g*h*h*(m%phi3 - phi4_of(z, m))
    end do
    step%work_start = h*step%end_response
    step%drop = 1
    if (step%start_response < step%end_response) step%drop = step%start_response/step%end_response
  end subroutine measure_step

  !> phi_4 = (1/6 - phi_3)/z = sum_i (-z)^i/(i+4)!
  pure function phi4_of(z, m) result(phi4)
    real(dp), intent(in) :: z
    type(memory_type), intent(in) :: m
    real(dp) :: phi4
    integer :: i
    if (z > 0.5_dp) then
      phi4 = (1.0_dp/6 - m%phi3)/z
      return
    end if
    phi4 = 0
    do i = 16, 5, -1  ! 0.5^12/16! is nothing beside 1/24
      phi4 = (1 - z*phi4)/i
    end do
    phi4 = (1 - z*phi4)/24
  end function phi4_of

  !> What elements keep of M_k at their entry fades in the step.
  pure subroutine relax_normal(walk, term, step, faded)
    type(walk_type), intent(in) :: walk
    type(term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(inout) :: faded(0:walk%capacity - 1, 0:walk%n_terms)
    integer(ip) :: i, k
    do k = 0, walk%n_terms
      !$omp simd
      do i = 0, step%last
        faded(i, k) = term(k)%decay*faded(i, k)
      end do
    end do
  end subroutine relax_normal

  !> Friction limit f of the elements at the level that term%normal is of, where the sphere has the velocity D'.
  pure subroutine limit_friction(walk, term, step, velocity, faded, limit)
    type(walk_type), intent(in) :: walk
    type(term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: velocity, faded(0:walk%capacity - 1, 0:walk%n_terms)
    real(dp), intent(out) :: limit(0:walk%capacity - 1)
    integer(ip) :: i, k
    limit = walk%eta*velocity + sum(term%normal)
    do k = 0, walk%n_terms
      !$omp simd
      do i = 0, step%last
        limit(i) = limit(i) - faded(i, k)
      end do
    end do
    limit = max(limit, 0.0_dp)
  end subroutine limit_friction

  !> Factors of v0 and v1 - v0 in the work of the stresses that elements have before the step.
  pure subroutine note_power(walk, term, step, stress, power, turn)
    type(walk_type), intent(in) :: walk
    type(term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: stress(0:walk%capacity - 1, 0:walk%n_terms)
    real(dp), intent(out), dimension(0:walk%capacity - 1) :: power, turn
    integer(ip) :: i, k
    power = 0
    turn = 0
    do k = 0, walk%n_terms
      !$omp simd
      do i = 0, step%last
        power(i) = power(i) + term(k)%power*stress(i, k)
        turn(i) = turn(i) + term(k)%turn*stress(i, k)
      end do
    end do
  end subroutine note_power

  !> Relax the stresses, and say in `trial` what the force would be at the end of a step that sticks, but for v1.
  pure subroutine relax_shear(walk, term, step, velocity, stress, slip, trial)
    type(walk_type), intent(in) :: walk
    type(term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: velocity  !! U' at the start of the step
    real(dp), intent(inout) :: stress(0:walk%capacity - 1, 0:walk%n_terms)
    real(dp), intent(in) :: slip(0:walk%capacity - 1)
    real(dp), intent(out) :: trial(0:walk%capacity - 1)
    real(dp) :: kept
    integer(ip) :: i, k
    kept = 1 - step%drop
    trial = 0
    !$omp simd
    do i = 0, step%last
      trial(i) = step%start_response*(velocity - kept*slip(i))
    end do
    do k = 0, walk%n_terms
      !$omp simd
      do i = 0, step%last
        stress(i, k) = term(k)%decay*stress(i, k)
        trial(i) = trial(i) + stress(i, k)
      end do
    end do
  end subroutine relax_shear

  !> Sum of all forces for U' = velocity at the end of the step, and its derivative.
  pure subroutine friction_force(walk, step, velocity, weight, limit, trial, force, slope)
    type(walk_type), intent(in) :: walk
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: velocity
    real(dp), intent(in), dimension(0:walk%capacity - 1) :: weight, limit, trial
    real(dp), intent(out) :: force, slope
    real(dp), dimension(lanes) :: forces, stuck
    real(dp) :: q
    integer(ip) :: first, i, l
    forces = 0
    stuck = 0
    do first = 0, step%last, lanes
      !$omp simd private(i, q)
      do l = 1, lanes
        i = first + l - 1
        q = trial(i) + step%end_response*velocity
        forces(l) = forces(l) + weight(i)*min(max(q, -limit(i)), limit(i))
        stuck(l) = stuck(l) + merge(weight(i), 0.0_dp, abs(q) <= limit(i))
      end do
    end do
    force = lane_sum(forces)
    slope = step%end_response*lane_sum(stuck)
  end subroutine friction_force

  !> Move the elements: the contact point goes from U' = velocity(0) to velocity(1). Afterwards `start` is v0, and if
  !> `friction` is asked for it is the friction work of the step.
  pure subroutine move_elements(walk, term, step, velocity, body, stress, friction)
    type(walk_type), intent(in) :: walk
    type(term_type), intent(in) :: term(0:walk%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: velocity(0:1)
    real(dp), intent(inout) :: body(0:walk%capacity - 1, room_columns)
    real(dp), intent(inout) :: stress(0:walk%capacity - 1, 0:walk%n_terms)
    real(dp), intent(out) :: friction
    real(dp) :: admittance, q, before, kept, slip, work(lanes)
    integer(ip) :: first, i, k, l
    admittance = 1/(step%end_response + step%drop*step%start_response)
    work = 0
    do first = 0, step%last, lanes
      !$omp simd private(i, q, before, kept, slip)
      do l = 1, lanes
        i = first + l - 1
        q = body(i, column_trial) + step%end_response*velocity(1)
        slip = q
        q = min(max(q, -body(i, column_limit)), body(i, column_limit))
        slip = (slip - q)*admittance
        kept = (1 - step%drop)*body(i, column_slip) + step%drop*slip
        before = body(i, column_force)
        work(l) = work(l) + body(i, column_weight)*(kept*(2*before + q) + slip*(before + 2*q))
        body(i, column_force) = q
        body(i, column_slip) = slip
        body(i, column_start) = velocity(0) - kept
      end do
    end do
    friction = step%h/6*lane_sum(work)
    do k = 0, walk%n_terms
      !$omp simd
      do i = 0, step%last
        stress(i, k) = stress(i, k) + term(k)%from_start*body(i, column_start) &
                       + term(k)%from_end*(velocity(1) - body(i, column_slip))
      end do
    end do
  end subroutine move_elements

  !> int q v of all elements over the step, v linear: what they take up.
  pure function work_of(walk, step, velocity, body) result(work)
    type(walk_type), intent(in) :: walk
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: velocity  !! U' at the end
    real(dp), intent(in) :: body(0:walk%capacity - 1, room_columns)
    real(dp) :: work, works(lanes), v0, dv
    integer(ip) :: first, i, l
    works = 0
    do first = 0, step%last, lanes
      !$omp simd private(i, v0, dv)
      do l = 1, lanes
        i = first + l - 1
        v0 = body(i, column_start)
        dv = velocity - body(i, column_slip) - v0
        works(l) = works(l) + body(i, column_weight)*(v0*(body(i, column_power) + step%work_start*(v0 + dv)) &
                                                    + dv*(body(i, column_turn) + step%work_turn*dv))
      end do
    end do
    work = lane_sum(works)
  end function work_of

  !> sum_i weight_i x_i
  pure function weighted_sum(walk, step, weight, x) result(total)
    type(walk_type), intent(in) :: walk
    type(step_type), intent(in) :: step
    real(dp), intent(in), dimension(0:walk%capacity - 1) :: weight, x
    real(dp) :: total, sums(lanes)
    integer(ip) :: first
    sums = 0
    do first = 0, step%last, lanes
      sums = sums + weight(first:first + lanes - 1)*x(first:first + lanes - 1)
    end do
    total = lane_sum(sums)
  end function weighted_sum

  pure function lane_sum(x) result(total)
    real(dp), intent(in) :: x(lanes)
    real(dp) :: total
    total = ((x(1) + x(5)) + (x(3) + x(7))) + ((x(2) + x(6)) + (x(4) + x(8)))
  end function lane_sum
end module rst_sync_element_step
