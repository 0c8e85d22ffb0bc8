!> One piece of the tangential motion, up to the next event (docs/sync.md).
module rst_slip
  use rst_friction_mode, only: mode_no_slip
  use rst_precision, only: dp, ip
  use rst_motion_factors, only: shear_factor
  use rst_collocation, only: stages, point, integral, integrated, last_coefficient, start_of, root_between, value_on, applied, &
                             factors_type, factorize, solution_of, has_converged
  use rst_tuning, only: most_steps, diverges_above, most_secants, search_part, narrowest, shortest_piece, shortest, at_edge
  use rst_panel, only: normal_type
  use rst_store, only: contact_type, store_type, sticks
  use rst_piece, only: interval_type, set_interval, stick, advance_memory
  use rst_front, only: element_type, margin_type, element_at, find_front, memory_force_at
  implicit none (type, external)
  private
  public :: solution_type, take_piece, solved, sticks_again, no_event, slip_begins, stick_ends, slip_reverses

  integer(ip), parameter :: solved = 0, sticks_again = 1

  !> Events that end a piece: slip sets in at the edge of a growing contact; the last element sticks
  !> no more; the edge of the shrinking contact is at the front, so that no element slips, and slip
  !> the other way begins.
  enum, bind(c)
    enumerator :: no_event, slip_begins, stick_ends, slip_reverses
  end enum

  !> What became of a try to solve a piece: Newton's steps do not converge, or polynomials miss too
  !> much; elements that slipped would stick again; the piece is solved.
  enum, bind(c)
    enumerator :: too_wide, turns_back, good
  end enum

  !> U', S, stick radius and angle of the front at the points; what is zero at the events: lead = D'
  !> - |U'| in stick, else the stick margin at the centre and at the edge.
  type :: solution_type
    real(dp), dimension(0:stages) :: shear_velocity, shear_force, stick_radius, front, lead, centre_margin, edge_margin
    integer(kind(good)) :: quality
  end type solution_type

contains

  !> The next piece from x on: the rest of the panel, or less where its polynomial misses too much
  !> or an event ends it. s%shear_velocity(0) and the starts of memory_x and loading_x are given.
  subroutine take_piece(normal, contact, store, panel, x, sense, interval, s, event, found)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(in) :: panel
    real(dp), intent(in) :: x
    integer(kind(sticks)), intent(in) :: sense
    type(interval_type), intent(out) :: interval
    type(solution_type), intent(inout) :: s
    integer(kind(no_event)), intent(out) :: event
    integer(ip), intent(out) :: found
    real(dp) :: to, place
    to = 1
    found = sticks_again
    do
      interval%panel = panel
      interval%from = x
      interval%to = to
      interval%rooted = .false.
      call solve_piece(normal, contact, store, sense, .false., interval, s)
      event = no_event
      if (s%quality /= too_wide) call next_event(contact, interval, sense, s, event, place)
      if (event == slip_begins .and. last_coefficient(s%shear_velocity) > contact%roughness) then
        s%quality = too_wide
      else if (event /= no_event) then
        to = x + place*(to - x)
        call end_at(normal, contact, store, to, sense, event, interval, s)
      end if
      if (s%quality == good .and. last_coefficient(s%shear_velocity) <= contact%roughness) exit
      if (s%quality == turns_back .and. to - x < shortest_piece) return
      to = x + 0.5_dp*(to - x)
      if (to - x < narrowest) return
    end do
    found = solved
  end subroutine take_piece

  !> The piece of which `interval` has the range. warm: s%shear_velocity and s%front are a guess.
  subroutine solve_piece(normal, contact, store, sense, warm, interval, s)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(kind(sticks)), intent(in) :: sense
    logical, intent(in) :: warm
    type(interval_type), intent(inout) :: interval
    type(solution_type), intent(inout) :: s
    logical :: fails
    store%n_trials = store%n_trials - 1
    s%quality = too_wide
    call set_interval(normal, store, interval, fails)
    if (fails) return
    if (sense == sticks) then
      call stick_all(normal, contact, store, interval, s)
    else
      call slip_behind(normal, contact, store, interval, sense, warm, s)
    end if
  end subroutine solve_piece

  !> All elements stick.
  subroutine stick_all(normal, contact, store, interval, s)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    type(interval_type), intent(in) :: interval
    type(solution_type), intent(inout) :: s
    real(dp) :: memory_force(stages)
    logical :: fails
    integer(ip) :: i
    memory_force = 0
    if (interval%returning) then
      do i = 1, stages
        memory_force(i) = memory_force_at(normal, store, interval%time(i), interval%angle(i))
      end do
    end if
    call stick(normal, contact, interval, memory_force, s%shear_velocity, s%shear_force, store, fails)
    if (fails) return
    s%shear_force(0) = start_of(s%shear_force(1:))
    s%stick_radius = interval%radius
    s%lead = interval%velocity - abs(s%shear_velocity)
    s%quality = good
  end subroutine stick_all

  !> Partial slip: U' at the points with S = sigma (F - H) (s14), by Newton's steps; H answers as
  !> the elements that stick do.
  subroutine slip_behind(normal, contact, store, interval, sense, warm, s)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    type(interval_type), intent(in) :: interval
    integer(kind(sticks)), intent(in) :: sense
    logical, intent(in) :: warm
    type(solution_type), intent(inout) :: s
    type(element_type) :: outermost(0:stages)
    type(factors_type) :: factors
    real(dp) :: matrix(stages, stages), step(stages), push, change, previous, accuracy
    logical :: fails
    integer(ip) :: i, j, n
    push = shear_factor*contact%chi
    do i = 0, stages
      call element_at(normal, store, interval%time(i), sense, outermost_angle(store, interval, i), outermost(i))
    end do
    s%front(0) = outermost_angle(store, interval, 0_ip)
    accuracy = sqrt(search_part*contact%noise) ! a front that is at rest is then not taken for one that moves outward
    call find_margin(normal, store, interval, sense, accuracy, outermost(0), 0_ip, s)
    if (.not. warm) s%shear_velocity(1:) = s%shear_velocity(0) - push*s%shear_force(0)*(interval%time(1:) - interval%time(0))
    previous = 1
    do n = 1, most_steps
      call advance_memory(normal, interval, s%shear_velocity(1:), store)
      do i = 1, stages
        if (n == 1 .and. .not. warm) s%front(i) = s%front(i - 1)
        call find_margin(normal, store, interval, sense, accuracy, outermost(i), i, s)
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
      if (.not. change < diverges_above) return
      if (has_converged(change, previous, contact%closeness)) exit
      previous = change
    end do
    if (n > most_steps) return
    call advance_memory(normal, interval, s%shear_velocity(1:), store)
    do i = 1, stages
      s%centre_margin(i) = margin_at_centre(normal, store, interval, sense, i, s%shear_velocity(i))
      s%edge_margin(i) = s%centre_margin(i) - outermost(i)%deficit
    end do
    s%shear_force(1:) = s%shear_force(1:) + s%stick_radius(1:)*applied(interval%answer, step) ! by the last step
    s%quality = good
    if (any(s%front(1:) > s%front(:stages - 1) + contact%noise)) s%quality = turns_back
    if (interval%returning) return
    if (any(interval%velocity(1:) > sense*s%shear_velocity(1:) + contact%noise)) s%quality = turns_back
  end subroutine slip_behind

  !> Front, stick margin and S at the point i.
  subroutine find_margin(normal, store, interval, sense, accuracy, outermost, i, s)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    type(interval_type), intent(in) :: interval
    integer(kind(sticks)), intent(in) :: sense
    real(dp), intent(in) :: accuracy  !! see margin_type
    type(element_type), intent(in) :: outermost
    integer(ip), intent(in) :: i
    type(solution_type), intent(inout) :: s
    type(margin_type) :: margin
    margin%accuracy = accuracy
    margin%angle = s%front(i)
    margin%at_centre = margin_at_centre(normal, store, interval, sense, i, s%shear_velocity(i))
    call find_front(normal, store, interval%time(i), sense, outermost_angle(store, interval, i), outermost, margin)
    s%front(i) = margin%angle
    s%stick_radius(i) = margin%stick_radius
    s%centre_margin(i) = margin%at_centre
    s%edge_margin(i) = margin%at_edge
    s%shear_force(i) = sense*(interval%force(i) - margin%force)
  end subroutine find_margin

  pure function margin_at_centre(normal, store, interval, sense, i, shear_velocity) result(margin)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    type(interval_type), intent(in) :: interval
    integer(kind(sticks)), intent(in) :: sense
    integer(ip), intent(in) :: i
    real(dp), intent(in) :: shear_velocity
    real(dp) :: margin
    margin = normal%eta*(interval%velocity(i) - sense*shear_velocity) + sum(store%memory_z(i, :) - sense*store%memory_x(i, :))
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
  subroutine next_event(contact, interval, sense, s, event, place)
    type(contact_type), intent(in) :: contact
    type(interval_type), intent(in) :: interval
    integer(kind(sticks)), intent(in) :: sense
    type(solution_type), intent(in) :: s
    integer(kind(no_event)), intent(out) :: event
    real(dp), intent(out) :: place
    integer(ip) :: i
    event = no_event
    place = 1
    if (contact%mode == mode_no_slip) return
    do i = 1, stages
      if (sense == sticks) then
        if (s%lead(i) >= -contact%roughness) cycle
        event = slip_begins ! the branch of |U'| at this point: where U' changes its sign, |U'| is no polynomial
        place = first_rise(i, sign(1.0_dp, s%shear_velocity(i))*s%shear_velocity - interval%velocity)
      else if (s%centre_margin(i) < 0) then
        event = stick_ends
        place = first_rise(i, -s%centre_margin)
      else if (interval%returning .and. s%edge_margin(i) > contact%noise*min(1.0_dp, contact%psi)*contact%stress) then
        event = slip_reverses
        place = first_rise(i, s%edge_margin)
      end if
      if (event /= no_event) return
    end do
  end subroutine next_event

  !> U' and front of the piece on `interval` at the points of one that starts where it does and ends
  !> at `to`, as a guess.
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

  !> The piece that ends at an event, about at x = guess: its end is moved by secants until what is
  !> zero at the event is.
  subroutine end_at(normal, contact, store, guess, sense, event, interval, s)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    real(dp), intent(in) :: guess
    integer(kind(sticks)), intent(in) :: sense
    integer(kind(no_event)), intent(in) :: event
    type(interval_type), intent(inout) :: interval
    type(solution_type), intent(inout) :: s
    real(dp) :: to, miss(0:stages), enough, to_before, miss_before, slope
    integer(ip) :: n
    to = guess
    to_before = 0
    miss_before = 0
    do n = 1, most_secants
      if (to - interval%from <= shortest) then
        interval%to = interval%from
        s%shear_velocity = s%shear_velocity(0)
        store%memory_z(stages, :) = store%memory_z(0, :)
        s%quality = good
        return
      end if
      call shorten(interval, to, event == stick_ends, s)
      interval%to = to
      interval%rooted = event == stick_ends
      call solve_piece(normal, contact, store, sense, .true., interval, s)
      if (s%quality == too_wide) return
      select case (event)
      case (slip_begins)
        miss = s%lead
        enough = contact%closeness
      case (stick_ends)
        miss = s%centre_margin
        enough = contact%closeness*contact%stress
      case default
        miss = s%edge_margin
        enough = at_edge*contact%roughness*contact%stress
      end select
      if (abs(miss(stages)) <= enough) return
      if (n == 1) then
        slope = (miss(stages) - miss(stages - 1))/(to - interval%x(stages - 1))
      else
        slope = (miss(stages) - miss_before)/(to - to_before)
      end if
      to_before = to
      miss_before = miss(stages)
      s%quality = too_wide
      if (.not. abs(slope) > 0) return
      to = max(interval%from, to - miss_before/slope)
      if (to > 1) to = 0.5_dp*(1 + to_before)
    end do
  end subroutine end_at
end module rst_slip
