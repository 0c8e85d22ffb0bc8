!> The tangential motion of an impact, piece after piece (docs/sync.md): stick, partial slip behind a front, gross slip.
module rst_tangential_motion
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, root_between, weights_at, factors_type, factorize, solution_of
  use rst_arms, only: advance
  use rst_panel, only: normal_type
  use rst_store, only: contact_type, piece_type, store_type
  use rst_piece, only: ground_type, lay_ground, advance_memory
  use rst_slip, only: solution_type, take_piece, solved, sticks_again, nothing, slip_begins, stick_ends, slip_leaves
  implicit none (type, external)
  private
  public :: follow_contact, find_velocity, solved, sticks_again, lacks_pieces

  integer(ip), parameter :: lacks_pieces = 2  !! follow_contact was given too few
  integer(ip), parameter :: most_idle = 2     !! events at one place, of which one undoes the other
  real(dp), parameter :: steady = 1.0e-10_dp, weightless = 1.0e-12_dp  !! slip velocity, and slack, that are rounding

contains

  !> U' at the end of the impact. found: solved; sticks_again, where slipping elements do, which a front cannot
  !> describe; lacks_pieces.
  subroutine follow_contact(normal, contact, store, velocity, found)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    real(dp), intent(out) :: velocity
    integer(ip), intent(out) :: found
    type(ground_type) :: ground
    type(solution_type) :: s
    integer(ip) :: panel, event, idle
    real(dp) :: x, side
    call start(normal, contact, store, panel, x, velocity)
    found = lacks_pieces
    if (panel == 0) return
    side = 0
    idle = 0
    event = nothing
    do while (panel <= normal%n_panels)
      found = lacks_pieces
      if (store%n_pieces >= size(store%piece) .or. store%n_records >= size(store%record)) return
      if (.not. abs(side) > 0 .and. panel > normal%n_compression .and. contact%no_slip == 0) &
        side = sign(1.0_dp, velocity) ! the edge of a shrinking contact slips
      s%w(0) = velocity
      call take_piece(normal, contact, store, panel, x, side, ground, s, event, found)
      if (found /= solved) return
      velocity = s%w(stages)
      if (ground%to > x) then
        call keep(normal, side, ground, s, store)
        idle = 0
      else
        idle = idle + 1
        found = sticks_again
        if (idle > most_idle) return
      end if
      x = ground%to
      if (event == slip_begins) side = sign(1.0_dp, velocity)
      if (event == slip_begins .and. (store%n_records == 0 .or. sum(store%now_z(stages, :) - side*store%now_x(0, :)) &
                                      < weightless*contact%stress)) event = stick_ends ! nothing has stuck, or but in rounding
      if (event == stick_ends) exit
      if (event == slip_leaves) side = -side
      if (x >= 1) then
        panel = panel + 1
        x = 0
      end if
    end do
    found = solved
    if (event == stick_ends) call slide(normal, contact, store, panel, x, side, velocity, found)
  end subroutine follow_contact

  !> First touch, or the end of gross slip, at which D' = U': until then an element has the same stress in x as in z. panel is 0 if
  !> there is no room for the records of it.
  subroutine start(normal, contact, store, panel, x, velocity)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(out) :: panel
    real(dp), intent(out) :: x, velocity
    real(dp) :: weight(0:stages)
    integer(ip) :: k
    panel = 0
    x = 0
    velocity = contact%psi
    if (size(store%record) < normal%n_compression) return
    store%n_records = 0
    store%n_pieces = 0
    store%now_x(0, :) = 0
    store%now_l(0, :) = 0
    panel = 1
    x = 0
    velocity = contact%psi
    if (.not. contact%psi > 1 .or. contact%no_slip /= 0) return
    velocity = (2*contact%chi - contact%psi)/(2*contact%chi - 1)
    call find_velocity(normal, velocity, panel, x)
    do k = 1, min(panel, normal%n_compression)
      call record_slip(normal, k, store)
    end do
    if (panel <= normal%n_compression) then
      associate (last => store%record(panel))
        last%to = last%from + x*(last%end - last%from)
      end associate
    end if
    weight = weights_at(x)
    do k = 1, normal%n_arms
      store%now_x(0, k) = sum(weight*normal%memory(:, k, panel))
      if (panel <= normal%n_compression) store%now_l(0, k) = sum(weight*normal%loading(:, k, panel))
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

  !> A panel of the compression in gross slip.
  subroutine record_slip(normal, panel, store)
    type(normal_type), intent(in) :: normal
    integer(ip), intent(in) :: panel
    type(store_type), intent(inout) :: store
    integer(ip) :: i, k
    store%n_records = panel
    associate (on => normal%panel(panel))
      store%record(panel)%from = on%from
      store%record(panel)%to = on%to
      store%record(panel)%end = on%to
      do i = 0, stages
        store%record(panel)%edge(:, i) = [on%radius(i), on%time(i), on%velocity(i)*on%pace(i), on%velocity(i)*on%pace(i)]
      end do
    end associate
    do k = 1, normal%n_arms
      do i = 0, stages
        store%held(1:2, i, k, panel) = 0
        store%held(3:4, i, k, panel) = 2*[normal%memory(i, k, panel), normal%loading(i, k, panel)]
      end do
    end do
  end subroutine record_slip

  !> A solved piece: for the history, and, while all sticks in a growing contact, as a record. Its end starts the next one.
  subroutine keep(normal, side, ground, s, store)
    type(normal_type), intent(in) :: normal
    real(dp), intent(in) :: side
    type(ground_type), intent(in) :: ground
    type(solution_type), intent(in) :: s
    type(store_type), intent(inout) :: store
    real(dp) :: weight(0:stages), loading
    integer(ip) :: n, i, k
    store%n_pieces = store%n_pieces + 1
    store%piece(store%n_pieces) = piece_type(ground%panel, merge(1_ip, 0_ip, ground%rooted), ground%from, ground%to, s%w, &
                                             s%force, s%stick)
    if (.not. abs(side) > 0 .and. .not. ground%returning) then
      n = store%n_records + 1
      store%n_records = n
      store%record(n)%from = ground%angle(0)
      store%record(n)%to = ground%angle(stages)
      store%record(n)%end = ground%angle(stages)
      do i = 0, stages
        store%record(n)%edge(:, i) = [ground%radius(i), ground%time(i), ground%velocity(i)*ground%pace(i), s%w(i)*ground%pace(i)]
        weight = weights_at(ground%place(i))
        do k = 1, normal%n_arms
          loading = sum(weight*normal%loading(:, k, ground%panel))
          store%held(:, i, k, n) = [store%now_z(i, k) - store%now_x(i, k), loading - store%now_l(i, k), &
                                    store%now_z(i, k) + store%now_x(i, k), loading + store%now_l(i, k)]
        end do
      end do
    end if
    do k = 1, normal%n_arms
      store%now_x(0, k) = store%now_x(stages, k)
      store%now_l(0, k) = store%now_l(stages, k)
    end do
  end subroutine keep

  !> Gross slip to the end: U' follows D'. It lasts if the element that slipped last, the one at the centre, goes on: its slack y
  !> stays 0, which asks for the velocity v, and it slips with v - v_d.
  subroutine slide(normal, contact, store, panel, x, side, velocity, found)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(in) :: panel
    real(dp), intent(in) :: x, side
    real(dp), intent(inout) :: velocity
    integer(ip), intent(out) :: found
    type(ground_type) :: ground
    type(solution_type) :: s
    real(dp) :: from, weight(0:stages)
    integer(ip) :: p, k
    logical :: lasts
    from = x
    weight = weights_at(x)
    do k = 1, normal%n_arms ! from now on now_l is the slack that the arms of the element at the centre have
      store%now_l(0, k) = sum(weight*normal%memory(:, k, panel)) - side*store%now_x(0, k)
    end do
    do p = panel, normal%n_panels
      found = lacks_pieces
      if (store%n_pieces >= size(store%piece)) return
      if (from < 1) then
        s%w(0) = velocity
        call slide_piece(normal, contact, store, p, from, side, ground, s, lasts)
        found = sticks_again
        if (.not. lasts) return
        velocity = s%w(stages)
        call keep(normal, side, ground, s, store)
      end if
      from = 0
    end do
    found = solved
  end subroutine slide

  subroutine slide_piece(normal, contact, store, panel, from, side, ground, s, lasts)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_type), intent(inout) :: store
    integer(ip), intent(in) :: panel
    real(dp), intent(in) :: from, side
    type(ground_type), intent(out) :: ground
    type(solution_type), intent(inout) :: s
    logical, intent(out) :: lasts
    real(dp) :: kept(stages), velocity(stages), slip(stages)
    type(factors_type) :: factors
    integer(ip) :: i, k
    logical :: fails
    ground%panel = panel
    ground%from = from
    ground%to = 1
    ground%rooted = .false.
    lasts = .false.
    call lay_ground(normal, store, ground, fails)
    if (fails) return
    s%w(1:) = s%w(0) + 2*contact%chi*side*(ground%velocity(1:) - ground%velocity(0))
    s%force = side*ground%force
    s%stick = 0
    kept = 0
    do k = 1, normal%n_arms
      kept = kept + store%kernel(:, 0, k)*store%now_l(0, k)
    end do
    call factorize(ground%answer, factors, fails)
    if (fails) return
    velocity = solution_of(factors, -kept)
    slip = velocity - (ground%velocity(1:) - side*s%w(1:))
    call advance(normal%g, ground%span, store%kernel, velocity, store%now_l)
    lasts = .true.
    do i = 1, stages
      lasts = lasts .and. slip(i)*abs(ground%answer(i, i)) >= -steady*abs(ground%answer(i, i)) - weightless*contact%stress
    end do
    call advance_memory(normal, ground, s%w(1:), store)
  end subroutine slide_piece
end module rst_tangential_motion
