!> One piece of the tangential motion, up to the next event (docs/sync.md).
module rst_slip
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, point, integral, integrated, last_coefficient, start_of, root_between, weights_at, applied, &
                             factors_type, factorize, solution_of, &
                             has_converged
  use rst_panel, only: normal_type
  use rst_store, only: contact_type, store_type
  use rst_piece, only: ground_type, lay_ground, stick, advance_memory, push_factor, value_on
  use rst_front, only: element_type, slack_type, look_at, find_front, held_by
  implicit none (type, external)
  private
  public :: solution_type, take_piece, solved, sticks_again, nothing, slip_begins, stick_ends, slip_leaves

  integer(ip), parameter :: solved = 0, sticks_again = 1

  !> Events that end a piece: slip sets in at the edge of a growing contact; the last element sticks no more; all that slipped has
  !> left the shrinking contact.
  integer(ip), parameter :: nothing = 0, slip_begins = 1, stick_ends = 2, slip_leaves = 3

  integer(ip), parameter :: most_iterations = 20, most_secants = 15
  !> Part of the roughness that may be left of the slack at the edge when slip leaves. Nobody slips there then. (Slip that begins too
  !> early or too late may look as if it stuck again, and stick may end in all elements at once.)
  real(dp), parameter :: at_edge = 0.1_dp
  real(dp), parameter :: narrowest = 1.0e-7_dp  !! part of a panel down to which pieces are halved
  real(dp), parameter :: shortest_piece = 0.02_dp !! below this width of a piece slip that turns back is reported as re-stick
  real(dp), parameter :: empty = 1.0e-13_dp     !! a piece shorter than that is none

  !> U', S, stick radius and angle of the front at the points; what is zero at the event that may end the piece: D' - |U'| in
  !> stick, else the slack at the centre and at the edge. returns: elements that slipped would stick again.
  type :: solution_type
    real(dp), dimension(0:stages) :: w, force, stick, front, centre, edge
    logical :: returns
  end type solution_type

contains

  !> The next piece from x on: the rest of the panel, or less where its polynomial misses too much or an event ends it.
  !> s%w(0) and the starts of now_x, now_l are given.
  subroutine take_piece(normal, contact, store, panel, x, side, ground, s, event, found)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(in) :: panel
    real(dp), intent(in) :: x, side
    type(ground_type), intent(out) :: ground
    type(solution_type), intent(inout) :: s
    integer(ip), intent(out) :: event, found
    real(dp) :: to, place
    logical :: fails
    to = 1
    found = sticks_again
    do
      ground%panel = panel
      ground%from = x
      ground%to = to
      ground%rooted = .false.
      call solve_piece(normal, contact, store, side, .false., ground, s, fails)
      event = nothing
      if (.not. fails) call next_event(contact, ground, side, s, event, place)
      if (event == slip_begins) then
        fails = last_coefficient(s%w) > contact%roughness
        if (.not. fails) call cut(normal, place, store, ground, s)
      else if (event /= nothing) then
        to = x + place*(to - x)
        call end_at(normal, contact, store, to, side, event, ground, s, fails)
      end if
      if (.not. fails) then
        if (.not. s%returns .and. last_coefficient(s%w) <= contact%roughness) exit
        if (s%returns .and. to - x < shortest_piece) return
      end if
      to = x + 0.5_dp*(to - x)
      if (to - x < narrowest) return
    end do
    found = solved
  end subroutine take_piece

  !> The piece of which `ground` has the range.
  subroutine solve_piece(normal, contact, store, side, warm, ground, s, fails)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    real(dp), intent(in) :: side
    logical, intent(in) :: warm  !! s%w and s%front are a guess
    type(ground_type), intent(inout) :: ground
    type(solution_type), intent(inout) :: s
    logical, intent(out) :: fails
    real(dp) :: held(stages)
    integer(ip) :: i
    call lay_ground(normal, store, ground, fails)
    if (fails) return
    if (abs(side) > 0) then
      call slip_behind(normal, contact, store, ground, side, warm, s, fails)
      return
    end if
    held = 0
    if (ground%returning) then
      do i = 1, stages
        held(i) = held_by(normal, store, ground%time(i), ground%angle(i))
      end do
    end if
    call stick(normal, contact, ground, held, s%w, s%force, store, fails)
    s%force(0) = start_of(s%force(1:))
    s%stick = ground%radius
    s%edge = 1
    s%centre = ground%velocity - abs(s%w)
    s%returns = .false.
  end subroutine solve_piece

  !> Partial slip: U' at the points with S = d (F - H), by Newton's steps; H answers as the elements that stick do.
  subroutine slip_behind(normal, contact, store, ground, side, warm, s, fails)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    type(ground_type), intent(in) :: ground
    real(dp), intent(in) :: side
    logical, intent(in) :: warm
    type(solution_type), intent(inout) :: s
    logical, intent(out) :: fails
    type(element_type) :: edge(0:stages)
    type(factors_type) :: factors
    real(dp) :: matrix(stages, stages), step(stages), push, change, previous, near
    integer(ip) :: i, j, n
    push = push_factor(contact)
    call look_at_edges(normal, store, ground, side, edge)
    s%front(0) = edge_of(store, ground, 0_ip)
    near = sqrt(0.1_dp*contact%noise) ! a front that is at rest is then not taken for one that moves outward
    call slacken(normal, store, ground, side, near, edge(0), 0_ip, s)
    if (.not. warm) s%w(1:) = s%w(0) - push*s%force(0)*(ground%time(1:) - ground%time(0))
    previous = 1
    do n = 1, most_iterations
      call advance_memory(normal, ground, s%w(1:), store)
      do i = 1, stages
        if (n == 1 .and. .not. warm) s%front(i) = s%front(i - 1)
        call slacken(normal, store, ground, side, near, edge(i), i, s)
      end do
      do j = 1, stages
        matrix(:, j) = push*applied(integral, ground%span*s%stick(1:)*ground%answer(:, j))
        matrix(j, j) = 1 + matrix(j, j)
      end do
      call factorize(matrix, factors, fails)
      if (fails) return
      step = solution_of(factors, integrated(s%w(0), -push*ground%span*s%force(1:)) - s%w(1:))
      s%w(1:) = s%w(1:) + step
      change = maxval(abs(step))
      fails = .not. change < 1.0e3_dp
      if (fails) return
      if (has_converged(change, previous, contact%closeness)) exit
      previous = change
    end do
    fails = n > most_iterations
    if (fails) return
    call advance_memory(normal, ground, s%w(1:), store)
    do i = 1, stages
      s%centre(i) = slack_at_centre(normal, store, ground, side, i, s%w(i))
      s%edge(i) = s%centre(i) - edge(i)%taken
    end do
    s%force(1:) = s%force(1:) + s%stick(1:)*applied(ground%answer, step) ! by the last step
    s%returns = any(s%front(1:) > s%front(:stages - 1) + contact%noise)
    if (.not. ground%returning) s%returns = s%returns .or. any(ground%velocity(1:) > side*s%w(1:) + contact%noise)
  end subroutine slip_behind

  !> At every point, the outermost element that may stick.
  subroutine look_at_edges(normal, store, ground, side, edge)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    type(ground_type), intent(in) :: ground
    real(dp), intent(in) :: side
    type(element_type), intent(out) :: edge(0:stages)
    integer(ip) :: i
    do i = 0, stages
      call look_at(normal, store, ground%time(i), side, edge_of(store, ground, i), edge(i))
    end do
  end subroutine look_at_edges

  !> Front, slack and S at the point i.
  subroutine slacken(normal, store, ground, side, near, edge, i, s)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    type(ground_type), intent(in) :: ground
    real(dp), intent(in) :: side, near  !! see slack_type
    type(element_type), intent(in) :: edge
    integer(ip), intent(in) :: i
    type(solution_type), intent(inout) :: s
    type(slack_type) :: slack
    slack%near = near
    slack%angle = s%front(i)
    slack%centre = slack_at_centre(normal, store, ground, side, i, s%w(i))
    call find_front(normal, store, ground%time(i), side, edge_of(store, ground, i), edge, slack)
    s%front(i) = slack%angle
    s%stick(i) = slack%radius
    s%centre(i) = slack%centre
    s%edge(i) = slack%edge
    s%force(i) = side*(ground%force(i) - slack%force)
  end subroutine slacken

  pure function slack_at_centre(normal, store, ground, side, i, w) result(slack)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    type(ground_type), intent(in) :: ground
    real(dp), intent(in) :: side, w
    integer(ip), intent(in) :: i
    real(dp) :: slack
    slack = normal%eta*(ground%velocity(i) - side*w) + sum(store%now_z(i, :) - side*store%now_x(i, :))
  end function slack_at_centre

  !> The angle of the outermost element that may stick: recorded, and in contact.
  pure function edge_of(store, ground, i) result(edge)
    type(store_type), intent(in) :: store
    type(ground_type), intent(in) :: ground
    integer(ip), intent(in) :: i
    real(dp) :: edge
    edge = store%record(store%n_records)%to
    if (ground%returning) edge = min(edge, ground%angle(i))
  end function edge_of

  !> The first event on the piece, and its place.
  subroutine next_event(contact, ground, side, s, event, place)
    type(contact_type), intent(in) :: contact
    type(ground_type), intent(in) :: ground
    real(dp), intent(in) :: side
    type(solution_type), intent(in) :: s
    integer(ip), intent(out) :: event
    real(dp), intent(out) :: place
    integer(ip) :: i
    event = nothing
    place = 1
    if (contact%no_slip /= 0) return
    do i = 1, stages
      if (.not. abs(side) > 0 .and. s%centre(i) < -contact%roughness) then
        event = slip_begins ! the branch of |U'| at this point: where U' changes its sign, |U'| is no polynomial
        place = first_rise(i, sign(1.0_dp, s%w(i))*s%w - ground%velocity)
        return
      end if
      if (abs(side) > 0 .and. s%centre(i) < 0) then
        event = stick_ends
        place = first_rise(i, -s%centre)
        return
      end if
      if (abs(side) > 0 .and. ground%returning .and. s%edge(i) > contact%noise*min(1.0_dp, contact%psi)*contact%stress) then
        event = slip_leaves
        place = first_rise(i, s%edge)
        return
      end if
    end do
  end subroutine next_event

  !> Keep a piece in stick up to a place on it, 0 to 1: the same polynomials at new points. Not kept up are force, span and answer
  !> of the ground, and centre, edge and front.
  subroutine cut(normal, place, store, ground, s)
    type(normal_type), intent(in) :: normal
    real(dp), intent(in) :: place
    type(store_type), intent(inout) :: store
    type(ground_type), intent(inout) :: ground
    type(solution_type), intent(inout) :: s
    real(dp) :: weight(0:stages, 0:stages), now(0:stages), up_to
    integer(ip) :: i, k
    up_to = merge(place, 0.0_dp, place*(ground%to - ground%from) > empty)
    do i = 0, stages
      weight(:, i) = weights_at(up_to*point(i))
    end do
    ground%to = ground%from + up_to*(ground%to - ground%from)
    ground%angle = ground%angle(0) + up_to*(ground%angle - ground%angle(0))
    ground%place = ground%place(0) + up_to*(ground%place - ground%place(0))
    ground%radius = restricted(weight, ground%radius)
    ground%time = restricted(weight, ground%time)
    ground%velocity = restricted(weight, ground%velocity)
    ground%pace = restricted(weight, ground%pace)
    s%w = restricted(weight, s%w)
    s%force = restricted(weight, s%force)
    s%stick = ground%radius
    do k = 1, normal%n_arms
      now = store%now_z(:, k) ! compilers would copy components of derived types
      store%now_z(:, k) = restricted(weight, now)
      now = store%now_x(:, k)
      store%now_x(:, k) = restricted(weight, now)
      now = store%now_l(:, k)
      store%now_l(:, k) = restricted(weight, now)
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

  !> U' and front of the piece on `ground` at the points of one that starts where it does and ends at `to`, as a guess.
  pure subroutine shorten(ground, to, rooted, s)
    type(ground_type), intent(in) :: ground
    real(dp), intent(in) :: to
    logical, intent(in) :: rooted
    type(solution_type), intent(inout) :: s
    real(dp) :: w(0:stages), front(0:stages), place
    integer(ip) :: i
    w = s%w
    front = s%front
    do i = 1, stages
      place = point(i)
      if (rooted) place = 1 - (1 - point(i))**2
      place = place*(to - ground%from)/(ground%to - ground%from)
      if (ground%rooted) place = 1 - sqrt(max(0.0_dp, 1 - place))
      s%w(i) = value_on(place, w)
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
  subroutine end_at(normal, contact, store, guess, side, event, ground, s, fails)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    real(dp), intent(in) :: guess, side
    integer(ip), intent(in) :: event
    type(ground_type), intent(inout) :: ground
    type(solution_type), intent(inout) :: s
    logical, intent(out) :: fails
    real(dp) :: to, miss, to_before, miss_before, slope
    integer(ip) :: n
    to = guess
    to_before = 0
    miss_before = 0
    do n = 1, most_secants
      fails = .false.
      if (to - ground%from <= empty) then
        ground%to = ground%from
        s%w = s%w(0)
        s%returns = .false.
        return
      end if
      call shorten(ground, to, event == stick_ends, s)
      ground%to = to
      ground%rooted = event == stick_ends
      call solve_piece(normal, contact, store, side, .true., ground, s, fails)
      if (fails) return
      miss = merge(s%edge(stages), s%centre(stages), event == slip_leaves)
      if (abs(miss) <= merge(at_edge*contact%roughness, contact%closeness, event == slip_leaves)*contact%stress) return
      if (n == 1) then
        slope = miss - merge(s%edge(stages - 1), s%centre(stages - 1), event == slip_leaves)
        slope = slope/(to - ground%place(stages - 1))
      else
        slope = (miss - miss_before)/(to - to_before)
      end if
      to_before = to
      miss_before = miss
      fails = .not. abs(slope) > 0
      if (fails) return
      to = max(ground%from, to - miss/slope)
      if (to > 1) to = 0.5_dp*(1 + to_before)
    end do
    fails = .true.
  end subroutine end_at
end module rst_slip
