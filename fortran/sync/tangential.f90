!> The tangential motion of an impact, piece after piece (docs/sync.md): stick, partial slip behind
!> a front, gross slip.
module rst_tangential_motion
  use rst_friction_mode, only: mode_gross_slip, mode_no_slip
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, root_between, weights_at, factors_type, factorize, solution_of
  use rst_arms, only: advance
  use rst_tuning, only: most_idle, steady, weightless, shortest
  use rst_panel, only: normal_type
  use rst_store, only: contact_type, piece_type, store_type, backward, sticks, forward
  use rst_piece, only: interval_type, set_interval, advance_memory
  use rst_slip, only: solution_type, take_piece, solved, sticks_again, no_event, slip_begins, stick_ends, slip_reverses
  implicit none (type, external)
  private
  public :: follow_contact, find_velocity, solved, sticks_again, lacks_pieces

  integer(ip), parameter :: lacks_pieces = 2  !! follow_contact was given too few

contains

  !> U' at the end of the impact. found: solved; sticks_again, where slipping elements do, which a
  !> front cannot describe; lacks_pieces.
  subroutine follow_contact(normal, contact, store, velocity, found)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    real(dp), intent(out) :: velocity
    integer(ip), intent(out) :: found
    type(interval_type) :: interval
    type(solution_type) :: s
    integer(kind(sticks)) :: sense
    integer(kind(no_event)) :: event
    integer(ip) :: panel, idle
    real(dp) :: x
    call start(normal, contact, store, panel, x, velocity)
    found = lacks_pieces
    if (panel == 0) return
    sense = sticks
    event = no_event
    idle = 0
    do while (panel <= normal%n_panels)
      found = lacks_pieces
      if (store%n_pieces >= size(store%piece) .or. store%n_records >= size(store%record) .or. store%n_trials <= 0) return
      if (sense == sticks .and. panel > normal%n_compression .and. contact%mode /= mode_no_slip) &
        sense = sense_of(velocity) ! the edge of a shrinking contact slips
      s%shear_velocity(0) = velocity
      call take_piece(normal, contact, store, panel, x, sense, interval, s, event, found)
      if (found /= solved) return
      velocity = s%shear_velocity(stages)
      idle = idle + 1
      if (interval%to > x) idle = 0
      if (idle == 0) call keep(normal, sense, interval, s, store)
      found = sticks_again
      if (idle > most_idle) return
      x = interval%to
      select case (event)
      case (slip_begins)
        sense = sense_of(velocity)
        if (.not. has_stuck(contact, sense, store)) event = stick_ends
      case (slip_reverses)
        sense = -sense
      end select
      if (event == stick_ends) exit
      if (x >= 1) then
        panel = panel + 1
        x = 0
      end if
    end do
    found = solved
    if (event == stick_ends) call slide(normal, contact, store, panel, x, sense, velocity, found)
  end subroutine follow_contact

  pure function sense_of(velocity) result(sense)
    real(dp), intent(in) :: velocity
    integer(kind(sticks)) :: sense
    sense = merge(backward, forward, velocity < 0)
  end function sense_of

  !> Whether elements stick at the end of a piece in stick, and not in rounding alone: the one at
  !> the centre has a margin.
  pure function has_stuck(contact, sense, store) result(yes)
    type(contact_type), intent(in) :: contact
    integer(kind(sticks)), intent(in) :: sense
    type(store_type), intent(in) :: store
    logical :: yes
    yes = store%n_records > 0 .and. sum(store%memory_z(stages, :) - sense*store%memory_x(0, :)) >= weightless*contact%stress
  end function has_stuck

  !> First touch, or the end of gross slip, at which D' = U': until then an element has the same
  !> stress in x as in z. panel is 0 if there is no room for the records of it.
  subroutine start(normal, contact, store, panel, x, velocity)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(out) :: panel
    real(dp), intent(out) :: x, velocity
    type(interval_type) :: interval
    real(dp) :: weight(0:stages)
    logical :: fails
    integer(ip) :: k
    panel = 0
    x = 0
    velocity = contact%psi
    if (size(store%record) < normal%n_compression) return
    store%n_records = 0
    store%n_pieces = 0
    store%memory_x(0, :) = 0
    store%loading_x(0, :) = 0
    panel = 1
    if (contact%mode /= mode_gross_slip) return
    velocity = (2*contact%chi - contact%psi)/(2*contact%chi - 1)
    call find_velocity(normal, velocity, panel, x)
    do k = 1, min(panel, normal%n_compression)
      interval%panel = k
      interval%from = 0
      interval%to = merge(x, 1.0_dp, k == panel)
      interval%rooted = .false.
      if (.not. interval%to > shortest) cycle
      call set_interval(normal, store, interval, fails)
      if (.not. fails) call add_record(normal, interval, interval%velocity, .true., store)
    end do
    weight = weights_at(x)
    do k = 1, normal%n_arms
      store%memory_x(0, k) = sum(weight*normal%memory(:, k, panel))
      if (panel <= normal%n_compression) store%loading_x(0, k) = sum(weight*normal%loading(:, k, panel))
    end do
  end subroutine start

  !> The panel, and x on it, where D' has fallen to a velocity.
  pure subroutine find_velocity(normal, velocity, panel, x)
    type(normal_type), intent(in) :: normal
    real(dp), intent(in) :: velocity
    integer(ip), intent(out) :: panel
    real(dp), intent(out) :: x
    real(dp) :: above(0:stages)
    integer(ip) :: i
    panel = 1
    do while (normal%panel(panel)%velocity(stages) > velocity .and. panel < normal%n_panels)
      panel = panel + 1
    end do
    above = normal%panel(panel)%velocity - velocity
    i = 1
    x = 1
    if (above(stages) > 0) return ! of a sphere that has stopped before
    do while (above(i) > 0 .and. i < stages)
      i = i + 1
    end do
    x = root_between(i, above)
  end subroutine find_velocity

  !> A solved piece: for the history, and, while all sticks in a growing contact, as a record. Its
  !> end starts the next one.
  subroutine keep(normal, sense, interval, s, store)
    type(normal_type), intent(in) :: normal
    integer(kind(sticks)), intent(in) :: sense
    type(interval_type), intent(in) :: interval
    type(solution_type), intent(in) :: s
    type(store_type), intent(inout) :: store
    store%n_pieces = store%n_pieces + 1
    store%piece(store%n_pieces) = piece_type(interval%panel, merge(1_ip, 0_ip, interval%rooted), interval%from, interval%to, &
                                             s%shear_velocity, s%shear_force, s%stick_radius)
    if (sense == sticks .and. .not. interval%returning) call add_record(normal, interval, s%shear_velocity, .false., store)
    store%memory_x(0, :) = store%memory_x(stages, :)
    store%loading_x(0, :) = store%loading_x(stages, :)
  end subroutine keep

  !> An interval of the compression in which all sticks, or all slips: then elements have the same
  !> stress in x as in z.
  subroutine add_record(normal, interval, shear_velocity, slips, store)
    type(normal_type), intent(in) :: normal
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: shear_velocity(0:stages)
    logical, intent(in) :: slips
    type(store_type), intent(inout) :: store
    real(dp) :: weight(0:stages), z(2), x(2)
    integer(ip) :: n, i, k
    n = store%n_records + 1
    store%n_records = n
    store%record(n)%from = interval%angle(0)
    store%record(n)%to = interval%angle(stages)
    do i = 0, stages
      store%record(n)%touch(:, i) = [interval%radius(i), interval%time(i), interval%velocity(i)*interval%pace(i), &
                                     shear_velocity(i)*interval%pace(i)]
      weight = weights_at(interval%x(i))
      do k = 1, normal%n_arms
        z = [store%memory_z(i, k), sum(weight*normal%loading(:, k, interval%panel))]
        x = merge(z, [store%memory_x(i, k), store%loading_x(i, k)], slips)
        store%corrective(:, i, k, n) = [z - x, z + x]
      end do
    end do
  end subroutine add_record

  !> Gross slip to the end: U' follows D'. It lasts if the element that slipped last, the one at the
  !> centre, goes on: its stick margin y stays 0, which asks for the velocity v, and it slips with v
  !> - v_sigma.
  subroutine slide(normal, contact, store, panel, x, sense, velocity, found)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(in) :: panel
    real(dp), intent(in) :: x
    integer(kind(sticks)), intent(in) :: sense
    real(dp), intent(inout) :: velocity
    integer(ip), intent(out) :: found
    type(interval_type) :: interval
    type(solution_type) :: s
    real(dp) :: from, weight(0:stages)
    real(dp), pointer, contiguous :: m(:, :) !! m_k of the element at the centre
    integer(ip) :: p, k
    logical :: lasts
    from = x
    weight = weights_at(x)
    m => store%loading_x ! which gross slip does not need
    do k = 1, normal%n_arms
      m(0, k) = sum(weight*normal%memory(:, k, panel)) - sense*store%memory_x(0, k)
    end do
    do p = panel, normal%n_panels
      found = lacks_pieces
      if (store%n_pieces >= size(store%piece)) return
      if (from < 1) then
        s%shear_velocity(0) = velocity
        call slide_piece(normal, contact, store, p, from, sense, m, interval, s, lasts)
        found = sticks_again
        if (.not. lasts) return
        velocity = s%shear_velocity(stages)
        call keep(normal, sense, interval, s, store)
      end if
      from = 0
    end do
    found = solved
  end subroutine slide

  subroutine slide_piece(normal, contact, store, panel, from, sense, m, interval, s, lasts)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(in) :: panel
    real(dp), intent(in) :: from
    integer(kind(sticks)), intent(in) :: sense
    real(dp), pointer, contiguous, intent(in) :: m(:, :)
    type(interval_type), intent(out) :: interval
    type(solution_type), intent(inout) :: s
    logical, intent(out) :: lasts
    real(dp) :: known(stages), velocity(stages), slip(stages)
    type(factors_type) :: factors
    integer(ip) :: i, k
    logical :: fails
    interval%panel = panel
    interval%from = from
    interval%to = 1
    interval%rooted = .false.
    lasts = .false.
    call set_interval(normal, store, interval, fails)
    if (fails) return
    s%shear_velocity(1:) = s%shear_velocity(0) + 2*contact%chi*sense*(interval%velocity(1:) - interval%velocity(0))
    s%shear_force = sense*interval%force
    s%stick_radius = 0
    known = 0
    do k = 1, normal%n_arms
      known = known + store%kernel(:, 0, k)*m(0, k)
    end do
    call factorize(interval%answer, factors, fails)
    if (fails) return
    velocity = solution_of(factors, -known)
    slip = velocity - (interval%velocity(1:) - sense*s%shear_velocity(1:))
    call advance(normal%g, interval%span, store%kernel, velocity, m)
    lasts = .true.
    do i = 1, stages
      lasts = lasts .and. slip(i)*abs(interval%answer(i, i)) >= -steady*abs(interval%answer(i, i)) - weightless*contact%stress
    end do
    call advance_memory(normal, interval, s%shear_velocity(1:), store)
  end subroutine slide_piece
end module rst_tangential_motion
