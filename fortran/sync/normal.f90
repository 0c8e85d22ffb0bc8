!> The normal motion of an impact, panel after panel (docs/sync.md).
!>
!> Panels are equal parts of the edge angle, halved while their polynomials miss too much or
!> Newton's steps do not converge, and twice as wide again where halves are not needed. Their ends
!> are at multiples of (pi/2)/2^deepest.
module rst_normal_motion
  use, intrinsic :: iso_c_binding, only: c_ptr, c_f_pointer
  use rst_precision, only: dp, ip
  use rst_motion_factors, only: mass_factor
  use rst_collocation, only: stages, last_coefficient
  use rst_panel, only: panel_type, normal_type, range_at
  use rst_guess, only: guess_compression
  use rst_compression_panel, only: compress
  use rst_restitution_panel, only: rebound
  use rst_tuning, only: deepest, largest_unresolved_rebound
  implicit none (type, external)
  private
  public :: normal_control_type, follow_normal, rebounds, stops, lacks_room, does_not_converge

  !> What follow_normal found: a rebound; a sphere that has stopped in the solid for good, or that
  !> rounding cannot follow but that will not be faster than normal%residual_speed; that the panels
  !> given are too few; nothing.
  integer(ip), parameter :: rebounds = 0, stops = 1, lacks_room = 2, does_not_converge = 3

  integer(ip), parameter :: whole = 2_ip**deepest
  real(dp), parameter :: unit = acos(0.0_dp)/real(whole, dp)

  !> Twin of `struct sync_normal_control` in C.
  type, bind(c) :: normal_control_type
    real(dp) :: roughness   !! what the polynomials of a panel may miss of D', A/r and the time over that of the panel
    real(dp) :: stop_speed  !! a sphere that cannot come back faster has stopped
    integer(ip) :: halvings !! panels are at most (pi/2)/2^halvings wide
    integer(ip) :: capacity !! panels there is room for
    !> The next coarser run, if there is one: its panels in each phase are twice as wide at least,
    !> so that no two runs agree because their panels are the same.
    integer(ip) :: n_coarse, n_coarse_compression
    type(c_ptr) :: coarse
  end type normal_control_type

contains

  !> From first touch to the end of contact. Given are the solid, normal%scale and normal%closeness.
  subroutine follow_normal(control, normal, found)
    type(normal_control_type), intent(in) :: control
    type(normal_type), intent(inout) :: normal
    integer(ip), intent(out) :: found
    type(panel_type), pointer, contiguous :: panel(:), coarse(:)
    panel => normal%panel
    nullify (coarse)
    if (control%n_coarse > 0) call c_f_pointer(control%coarse, coarse, [control%n_coarse])
    normal%n_panels = 0
    call go_through(.false., found)
    if (found /= rebounds) return
    call go_through(.true., found)
  contains

    !> The compression or the restitution: place runs from 0 to whole.
    subroutine go_through(back, found)
      logical, intent(in) :: back
      integer(ip), intent(out) :: found
      integer(ip) :: place, width, widest, n
      logical :: fails
      place = 0
      widest = whole/2_ip**control%halvings
      width = widest
      fails = .false.
      do while (place < whole)
        n = normal%n_panels + 1
        found = lacks_room
        if (n > control%capacity) return
        if (back) width = min(width, width_at(whole - place, normal%n_compression, panel))
        call halve_coarser(back, place, width)
        call begin(normal, n)
        panel(n)%from = merge(whole - place, place, back)*unit
        panel(n)%to = merge(whole - place - width, place + width, back)*unit
        call solve_panel(back, n, fails)
        if (.not. fails) fails = missed(normal%scale, panel(n), back) > control%roughness
        if (fails) then
          width = width/2
          if (width > 0) cycle
          call give_up(found)
          return
        end if
        normal%n_panels = n
        if (.not. back) normal%n_compression = n
        place = place + width
        if (.not. back) then
          found = stops
          normal%residual_speed = control%stop_speed
          if (has_stopped(normal, control%stop_speed)) return
        end if
        if (width < widest .and. modulo(place, 2*width) == 0) width = 2*width
      end do
      found = rebounds
    end subroutine go_through

    !> Newton's steps begin where the coarser run was, or where the panel before leads if the last
    !> try did not converge.
    subroutine solve_panel(back, n, fails)
      logical, intent(in) :: back
      integer(ip), intent(in) :: n
      logical, intent(inout) :: fails
      integer(ip) :: first, last
      first = merge(control%n_coarse_compression, 0_ip, back) + 1
      last = merge(control%n_coarse, control%n_coarse_compression, back)
      if (first <= last .and. .not. fails) then
        call solve_from(coarse(first:last), back, n, fails)
      else
        first = merge(n, n - 1, n == merge(normal%n_compression, 0_ip, back) + 1)
        call solve_from(panel(first:n - 1), back, n, fails)
      end if
    end subroutine solve_panel

    subroutine solve_from(known, back, n, fails)
      type(panel_type), intent(in) :: known(:)
      logical, intent(in) :: back
      integer(ip), intent(in) :: n
      logical, intent(out) :: fails
      if (back) then
        call rebound(normal, known, fails)
      else
        call guess_compression(normal, known, panel(n))
        call compress(normal, n, fails)
      end if
    end subroutine solve_from

    !> No panel is wider than half the one that the coarser run has at a place.
    subroutine halve_coarser(back, place, width)
      logical, intent(in) :: back
      integer(ip), intent(in) :: place
      integer(ip), intent(inout) :: width
      integer(ip) :: first, last, i
      first = merge(control%n_coarse_compression, 0_ip, back) + 1
      last = merge(control%n_coarse, control%n_coarse_compression, back)
      if (first > last) return
      i = first - 1 + range_at(merge(whole - place - 0.5_dp, place + 0.5_dp, back)*unit, coarse(first:last), back)
      if (passed(coarse(i)%to, back) > place) &
        width = max(1_ip, min(width, (passed(coarse(i)%to, back) - passed(coarse(i)%from, back))/2))
    end subroutine halve_coarser

    !> Rounding ends the panels. What is left after the compression may be too slow to matter.
    subroutine give_up(found)
      integer(ip), intent(out) :: found
      found = does_not_converge
      if (normal%n_panels == 0) return
      normal%residual_speed = fastest_later(normal)
      if (.not. normal%residual_speed < largest_unresolved_rebound) return
      found = stops
      normal%n_panels = normal%n_compression
    end subroutine give_up
  end subroutine follow_normal

  !> How far a phase has come at an angle.
  elemental function passed(angle, back) result(place)
    real(dp), intent(in) :: angle
    logical, intent(in) :: back
    integer(ip) :: place
    place = nint(angle/unit, ip)
    if (back) place = whole - place
  end function passed

  !> The width of the panel of the compression that ends at a place, or in which it is: between
  !> panels the compression is not smooth.
  pure function width_at(place, n, panel) result(width)
    integer(ip), intent(in) :: place, n
    type(panel_type), intent(in) :: panel(n)
    integer(ip) :: width
    associate (on => panel(range_at((place - 0.5_dp)*unit, panel)))
      width = nint(on%to/unit, ip) - nint(on%from/unit, ip)
    end associate
  end function width_at

  !> The start of a panel is the end of the one before, and the first one starts at first touch.
  !> (Values at its points come later.)
  subroutine begin(normal, n)
    type(normal_type), intent(in) :: normal
    integer(ip), intent(in) :: n
    if (n == 1) then
      normal%panel(1) = panel_type(from=0, to=0, radius=0, time=0, depth=0, velocity=1, force=0, pace=0)
      normal%memory(0, :, 1) = 0
      normal%loading(0, :, 1) = 0
    else
      associate (last => normal%panel(n - 1))
        normal%panel(n) = panel_type(from=0, to=0, radius=last%radius(stages), time=last%time(stages), depth=last%depth(stages), &
                                     velocity=last%velocity(stages), force=last%force(stages), pace=last%pace(stages))
      end associate
      normal%memory(0, :, n) = normal%memory(stages, :, n - 1)
      normal%loading(0, :, n) = normal%loading(stages, :, n - 1)
    end if
  end subroutine begin

  !> What the polynomials of a panel may miss: of D', A/r and, in the compression, of the pace over
  !> its largest value, since the restitution follows from slopes of what the compression left.
  pure function missed(scale, panel, back) result(most)
    real(dp), intent(in) :: scale
    type(panel_type), intent(in) :: panel
    logical, intent(in) :: back
    real(dp) :: most
    most = max(last_coefficient(panel%velocity), last_coefficient(panel%radius)/scale, &
               last_coefficient(panel%time)/panel%time(stages))
    if (.not. back) most = max(most, last_coefficient(panel%pace)/maxval(panel%pace))
  end function missed

  !> Whether the sphere is slower than stop_speed and will not come back faster: because springs
  !> hold less energy, with stresses up to twice their mean, or because the dashpot keeps them from
  !> letting it go: f >= 0 at the centre means |D'| <= sum M_k/eta.
  function has_stopped(normal, stop_speed) result(yes)
    type(normal_type), intent(in) :: normal
    real(dp), intent(in) :: stop_speed
    logical :: yes
    real(dp) :: velocity
    velocity = normal%panel(normal%n_compression)%velocity(stages)
    yes = .false.
    if (velocity >= stop_speed .or. .not. velocity > 0) return
    yes = stored(normal) < stop_speed**2 .or. sum(normal%memory(stages, :, normal%n_compression)) < stop_speed*normal%eta
  end function has_stopped

  !> The square of the speed that springs could give the sphere after the last panel of the
  !> compression, with stresses up to twice their mean.
  function stored(normal) result(energy)
    type(normal_type), intent(in) :: normal
    real(dp) :: energy
    integer(ip) :: last
    last = normal%n_compression
    energy = 2*mass_factor*sum(normal%loading(stages, :, last)**2/normal%g)/normal%panel(last)%radius(stages)
  end function stored

  !> The speed that the sphere will not exceed after the last panel of the compression, by its
  !> energy.
  function fastest_later(normal) result(speed)
    type(normal_type), intent(in) :: normal
    real(dp) :: speed
    speed = sqrt(normal%panel(normal%n_compression)%velocity(stages)**2 + stored(normal))
  end function fastest_later
end module rst_normal_motion
