!> One piece of the tangential motion, up to the next event (docs/sync.md).
module rst_slip
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, point, integral, integrated, last_coefficient, start_of, root_between, weights_at, applied, &
                             factors_type, factorize, solution_of, &
                             has_converged
  use rst_panel, only: normal_type
  use rst_store, only: contact_type, store_type
  use rst_piece, only: interval_type, set_interval, stick, advance_memory, push_factor, value_on
  use rst_front, only: element_type, margin_type, element_at, find_front, memory_force_at
  implicit none (type, external)
  private
  public :: solution_type, take_piece, solved, sticks_again, nothing, slip_begins, stick_ends, slip_reverses

  integer(ip), parameter :: solved = 0, sticks_again = 1

  !> Events that end a piece: slip sets in at the edge of a growing contact; the last element sticks no more; the edge of the
  !> shrinking contact is at the front, so that no element slips, and slip the other way begins.
  integer(ip), parameter :: nothing = 0, slip_begins = 1, stick_ends = 2, slip_reverses = 3

  integer(ip), parameter :: most_iterations = 20, most_secants = 15
  !> Part of the roughness that may be left of the margin at the edge when slip reverses. No element slips there then. (Slip that
  !> begins too early or too late may look as if it stuck again, and stick may end in all elements at once.)
  real(dp), parameter :: at_edge = 0.1_dp
  real(dp), parameter :: narrowest = 1.0e-7_dp  !! part of a panel down to which pieces are halved
  real(dp), parameter :: shortest_piece = 0.02_dp !! below this width of a piece slip that turns back is reported as re-stick
  real(dp), parameter :: empty = 1.0e-13_dp     !! a piece shorter than that is none

  !> U', S, stick radius and angle of the front at the points; what is zero at the event that may end the piece: D' - |U'| in
  !> stick, else the stick margin at the centre and at the edge. returns: elements that slipped would stick again.
  type :: solution_type
    real(dp), dimension(0:stages) :: shear_velocity, shear_force, stick_radius, front, centre_margin, edge_margin
    logical :: returns
  end type solution_type

contains

  !> The next piece from x on: the rest of the panel, or less where its polynomial misses too much or an event ends it.
  !> s%shear_velocity(0) and the starts of memory_x and loading_x are given.
  subroutine take_piece(normal, contact, store, panel, x, side, interval, s, event, found)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(in) :: panel
    real(dp), intent(in) :: x, side
    type(interval_type), intent(out) :: interval
    type(solution_type), intent(inout) :: s
    integer(ip), intent(out) :: event, found
    real(dp) :: to, place
    logical :: fails
    to = 1
    found = sticks_again
    do
      interval%panel = panel
      interval%from = x
      interval%to = to
      interval%rooted = .false.
      call solve_piece(normal, contact, store, side, .false., interval, s, fails)
      event = nothing
      if (.not. fails) call next_event(contact, interval, side, s, event, place)
      if (event == slip_begins) then
        fails = last_coefficient(s%shear_velocity) > contact%roughness
        if (.not. fails) call cut(normal, place, store, interval, s)
      else if (event /= nothing) then
        to = x + place*(to - x)
        call end_at(normal, contact, store, to, side, event, interval, s, fails)
      end if
      if (.not. fails) then
        if (.not. s%returns .and. last_coefficient(s%shear_velocity) <= contact%roughness) exit
        if (s%returns .and. to - x < shortest_piece) return
      end if
      to = x + 0.5_dp*(to - x)
      if (to - x < narrowest) return
    end do
    found = solved
  end subroutine take_piece

  !> The piece of which `interval` has the range.
  subroutine solve_piece(normal, contact, store, side, warm, interval, s, fails)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    real(dp), intent(in) :: side
    logical, intent(in) :: warm  !! s%shear_velocity and s%front are a guess
    type(interval_type), intent(inout) :: interval
    type(solution_type), intent(inout) :: s
    logical, intent(out) :: fails
    real(dp) :: memory_force(stages)
    integer(ip) :: i
    call set_interval(normal, store, interval, fails)
    if (fails) return
    if (abs(side) > 0) then
      call slip_behind(normal, contact, store, interval, side, warm, s, fails)
      return
    end if
    memory_force = 0
    if (interval%returning) then
      do i = 1, stages
        memory_force(i) = memory_force_at(normal, store, interval%time(i), interval%angle(i))
      end do
    end if
    call stick(normal, contact, interval, memory_force, s%shear_velocity, s%shear_force, store, fails)
    s%shear_force(0) = start_of(s%shear_force(1:))
    s%stick_radius = interval%radius
    s%edge_margin = 1
    s%centre_margin = interval%velocity - abs(s%shear_velocity)
    s%returns = .false.
  end subroutine solve_piece

  !> Partial slip: U' at the points with S = d (F - H), by Newton's steps; H answers as the elements that stick do.
  subroutine slip_behind(normal, contact, store, interval, side, warm, s, fails)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: side
    logical, intent(in) :: warm
    type(solution_type), intent(inout) :: s
    logical, intent(out) :: fails
    type(element_type) :: outermost(0:stages)
    type(factors_type) :: factors
    real(dp) :: matrix(stages, stages), step(stages), push, change, previous, accuracy
    integer(ip) :: i, j, n
    push = push_factor(contact)
    call outermost_elements(normal, store, interval, side, outermost)
    s%front(0) = outermost_angle(store, interval, 0_ip)
    accuracy = sqrt(0.1_dp*contact%noise) ! a front that is at rest is then not taken for one that moves outward
    call find_margin(normal, store, interval, side, accuracy, outermost(0), 0_ip, s)
    if (.not. warm) s%shear_velocity(1:) = s%shear_velocity(0) - push*s%shear_force(0)*(interval%time(1:) - interval%time(0))
    previous = 1
    do n = 1, most_iterations
      call advance_memory(normal, interval, s%shear_velocity(1:), store)
      do i = 1, stages
        if (n == 1 .and. .not. warm) s%front(i) = s%front(i - 1)
        call find_margin(normal, store, interval, side, accuracy, outermost(i), i, s)
      end do
      do j = 1, stages
        matrix(:, j) = push*applied(integral, interval%span*s%stick_radius(1:)*interval%answer(:, j))
        matrix(j, j) = 1 + matrix(j, j)
      end do
      call factorize(matrix, factors, fails)
      if (fails) return
      step = solution_of(factors, integrated(s%shear_velocity(0), -push*interval%span*s%shear_force(1:)) - s%shear_velocity(1:))
      s%shear_velocity(1:) = s%shear_velocity(1:) + step
      change = maxval(abs(step))
      fails = .not. change < 1.0e3_dp
      if (fails) return
      if (has_converged(change, previous, contact%closeness)) exit
      previous = change
    end do
    fails = n > most_iterations
    if (fails) return
    call advance_memory(normal, interval, s%shear_velocity(1:), store)
    do i = 1, stages
      s%centre_margin(i) = margin_at_centre(normal, store, interval, side, i, s%shear_velocity(i))
      s%edge_margin(i) = s%centre_margin(i) - outermost(i)%deficit
    end do
    s%shear_force(1:) = s%shear_force(1:) + s%stick_radius(1:)*applied(interval%answer, step) ! by the last step
    s%returns = any(s%front(1:) > s%front(:stages - 1) + contact%noise)
    if (.not. interval%returning) &
      s%returns = s%returns .or. any(interval%velocity(1:) > side*s%shear_velocity(1:) + contact%noise)
  end subroutine slip_behind

  !> At every point, the outermost element that may stick.
  subroutine outermost_elements(normal, store, interval, side, outermost)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: side
    type(element_type), intent(out) :: outermost(0:stages)
    integer(ip) :: i
    do i = 0, stages
      call element_at(normal, store, interval%time(i), side, outermost_angle(store, interval, i), outermost(i))
    end do
  end subroutine outermost_elements

  !> Front, stick margin and S at the point i.
  subroutine find_margin(normal, store, interval, side, accuracy, outermost, i, s)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: side, accuracy  !! see margin_type
    type(element_type), intent(in) :: outermost
    integer(ip), intent(in) :: i
    type(solution_type), intent(inout) :: s
    type(margin_type) :: margin
    margin%accuracy = accuracy
    margin%angle = s%front(i)
    margin%at_centre = margin_at_centre(normal, store, interval, side, i, s%shear_velocity(i))
    call find_front(normal, store, interval%time(i), side, outermost_angle(store, interval, i), outermost, margin)
    s%front(i) = margin%angle
    s%stick_radius(i) = margin%stick_radius
    s%centre_margin(i) = margin%at_centre
    s%edge_margin(i) = margin%at_edge
    s%shear_force(i) = side*(interval%force(i) - margin%force)
  end subroutine find_margin

  pure function margin_at_centre(normal, store, interval, side, i, shear_velocity) result(margin)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: side, shear_velocity
    integer(ip), intent(in) :: i
    real(dp) :: margin
    margin = normal%eta*(interval%velocity(i) - side*shear_velocity) + sum(store%memory_z(i, :) - side*store%memory_x(i, :))
  end function margin_at_centre

  !> The angle of the outermost element that may stick: recorded, and in contact.
  pure function outermost_angle(store, interval, i) result(angle)
    type(store_type), intent(in) :: store
    type(interval_type), intent(in) :: interval
    integer(ip), intent(in) :: i
    real(dp) :: angle
    angle = store%record(store%n_records)%to
    if (interval%returning) angle = min(angle, interval%angle(i))
  end function outermost_angle

  !> The first event on the piece, and its place.
  subroutine next_event(contact, interval, side, s, event, place)
    type(contact_type), intent(in) :: contact
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: side
    type(solution_type), intent(in) :: s
    integer(ip), intent(out) :: event
    real(dp), intent(out) :: place
    integer(ip) :: i
    event = nothing
    place = 1
    if (contact%no_slip /= 0) return
    do i = 1, stages
      if (.not. abs(side) > 0 .and. s%centre_margin(i) < -contact%roughness) then
        event = slip_begins ! the branch of |U'| at this point: where U' changes its sign, |U'| is no polynomial
        place = first_rise(i, sign(1.0_dp, s%shear_velocity(i))*s%shear_velocity - interval%velocity)
        return
      end if
      if (abs(side) > 0 .and. s%centre_margin(i) < 0) then
        event = stick_ends
        place = first_rise(i, -s%centre_margin)
        return
      end if
      if (abs(side) > 0 .and. interval%returning .and. &
          s%edge_margin(i) > contact%noise*min(1.0_dp, contact%psi)*contact%stress) then
        event = slip_reverses
        place = first_rise(i, s%edge_margin)
        return
      end if
    end do
  end subroutine next_event

  !> Keep a piece in stick up to a place on it, 0 to 1: the same polynomials at new points. Not kept up are force, span and answer
  !> of the interval, and centre, edge and front.
  subroutine cut(normal, place, store, interval, s)
    type(normal_type), intent(in) :: normal
    real(dp), intent(in) :: place
    type(store_type), intent(inout) :: store
    type(interval_type), intent(inout) :: interval
    type(solution_type), intent(inout) :: s
    real(dp) :: weight(0:stages, 0:stages), now(0:stages), up_to
    integer(ip) :: i, k
    up_to = merge(place, 0.0_dp, place*(interval%to - interval%from) > empty)
    do i = 0, stages
      weight(:, i) = weights_at(up_to*point(i))
    end do
    interval%to = interval%from + up_to*(interval%to - interval%from)
    interval%angle = interval%angle(0) + up_to*(interval%angle - interval%angle(0))
    interval%x = interval%x(0) + up_to*(interval%x - interval%x(0))
    interval%radius = restricted(weight, interval%radius)
    interval%time = restricted(weight, interval%time)
    interval%velocity = restricted(weight, interval%velocity)
    interval%pace = restricted(weight, interval%pace)
    s%shear_velocity = restricted(weight, s%shear_velocity)
    s%shear_force = restricted(weight, s%shear_force)
    s%stick_radius = interval%radius
    do k = 1, normal%n_arms
      now = store%memory_z(:, k) ! compilers would copy components of derived types
      store%memory_z(:, k) = restricted(weight, now)
      now = store%memory_x(:, k)
      store%memory_x(:, k) = restricted(weight, now)
      now = store%loading_x(:, k)
      store%loading_x(:, k) = restricted(weight, now)
    end do
  end subroutine cut

  pure function restricted(weight, y) result(z)
    real(dp), intent(in) :: weight(0:stages, 0:stages), y(0:stages)
    real(dp) :: z(0:stages)
    integer(ip) :: i
    do i = 0, stages
      z(i) = sum(weight(:, i)*y)
    end do
  end function restricted

  !> U' and front of the piece on `interval` at the points of one that starts where it does and ends at `to`, as a guess.
  pure subroutine shorten(interval, to, rooted, s)
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: to
    logical, intent(in) :: rooted
    type(solution_type), intent(inout) :: s
    real(dp) :: shear_velocity(0:stages), front(0:stages), place
    integer(ip) :: i
    shear_velocity = s%shear_velocity
    front = s%front
    do i = 1, stages
      place = point(i)
      if (rooted) place = 1 - (1 - point(i))**2
      place = place*(to - interval%from)/(interval%to - interval%from)
      if (interval%rooted) place = 1 - sqrt(max(0.0_dp, 1 - place))
      s%shear_velocity(i) = value_on(place, shear_velocity)
      s%front(i) = value_on(place, front)
    end do
  end subroutine shorten

  !> Where y, which is positive at the point i, became so; 0: at the start.
  pure function first_rise(i, y) result(place)
    integer(ip), intent(in) :: i
    real(dp), intent(in) :: y(0:stages)
    real(dp) :: place
    integer(ip) :: j
    j = i
    do while (j > 1 .and. y(j - 1) >= 0)
      j = j - 1
    end do
    place = 0
    if (y(j - 1) < 0) place = root_between(j, y)
  end function first_rise

  !> The piece that ends where stick or slip does, about at x = guess: its end is moved by secants until what is zero there is.
  subroutine end_at(normal, contact, store, guess, side, event, interval, s, fails)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    real(dp), intent(in) :: guess, side
    integer(ip), intent(in) :: event
    type(interval_type), intent(inout) :: interval
    type(solution_type), intent(inout) :: s
    logical, intent(out) :: fails
    real(dp) :: to, miss, to_before, miss_before, slope
    integer(ip) :: n
    to = guess
    to_before = 0
    miss_before = 0
    do n = 1, most_secants
      fails = .false.
      if (to - interval%from <= empty) then
        interval%to = interval%from
        s%shear_velocity = s%shear_velocity(0)
        s%returns = .false.
        return
      end if
      call shorten(interval, to, event == stick_ends, s)
      interval%to = to
      interval%rooted = event == stick_ends
      call solve_piece(normal, contact, store, side, .true., interval, s, fails)
      if (fails) return
      miss = merge(s%edge_margin(stages), s%centre_margin(stages), event == slip_reverses)
      if (abs(miss) <= merge(at_edge*contact%roughness, contact%closeness, event == slip_reverses)*contact%stress) return
      if (n == 1) then
        slope = miss - merge(s%edge_margin(stages - 1), s%centre_margin(stages - 1), event == slip_reverses)
        slope = slope/(to - interval%x(stages - 1))
      else
        slope = (miss - miss_before)/(to - to_before)
      end if
      to_before = to
      miss_before = miss
      fails = .not. abs(slope) > 0
      if (fails) return
      to = max(interval%from, to - miss/slope)
      if (to > 1) to = 0.5_dp*(1 + to_before)
    end do
    fails = .true.
  end subroutine end_at
end module rst_slip
