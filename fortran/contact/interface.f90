!> One step of one contact, as C calls it (src/contact/kernels.h), its force and its frame.
module rst_contact_interfaces
  use, intrinsic :: iso_c_binding, only: c_double
  use rst_motion_factors, only: elastic_contact_time
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, rates_type, motion_type, at_width, at_overlap, at_force, at_axis, at_arrays
  use rst_contact_grid, only: stretch
  use rst_contact_rates, only: largest_overlap
  use rst_contact_normal, only: normal_type, press
  use rst_contact_tangential, only: shear
  implicit none (type, external)
  private
  public :: contact_step, contact_force, contact_turn, force_type

  !> restitute_contact_force of include/restitute/contact.h.
  type, bind(c) :: force_type
    real(c_double) :: normal, tangential(3)
  end type force_type

  !> The result of contact_step. The state changes only if `done`.
  integer(ip), parameter :: done = 0, step_too_long = 1, normal_jumped = 2

  real(dp), parameter :: margin = 1.02_dp        !! of a new grid over the expected radius
  real(dp), parameter :: least_steps = 10        !! a contact: below, the first steps alone may exceed the largest force
  real(dp), parameter :: at_rest = 1.0e-60_dp    !! m/s, s/kg: below, energies underflow, masses overflow
  real(dp), parameter :: least_overlap = 1.0e-30_dp  !! over the radius, of a new grid: the square of its width is not to underflow

contains

  pure subroutine contact_step(law, rates, motion, state, force, status) bind(c, name="rst_law_step")
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    type(motion_type), intent(in) :: motion
    real(dp), intent(inout) :: state(*)
    type(force_type), intent(out) :: force
    integer(ip), intent(out) :: status
    type(normal_type) :: contact
    real(dp) :: displacement(2), axis(3), other(3), before(3), approach, friction
    logical :: lost
    axis = state(at_axis:at_axis + 2)
    call follow_normal(motion%axis, axis, lost)
    status = merge(normal_jumped, done, lost)
    if (.not. state(at_width) > 0 .and. .not. lost) call touch(law, rates, motion, state, status)
    if (status /= done) return
    state(at_axis:at_axis + 2) = axis
    if (motion%overlap*motion%radius > state(at_width)**2) call stretch(law, motion%overlap*motion%radius, state)
    call press(law, rates, motion, state(at_overlap), state(at_width), state(at_arrays), state(law%at_surface), contact)
    before = state(at_force:at_force + 2)
    approach = motion%overlap - state(at_overlap)
    state(at_overlap) = motion%overlap
    state(at_force) = contact%force
    displacement = 0
    friction = 0
    force%normal = contact%force
    force%tangential = 0
    if (law%slips /= 0) then
      other = cross(motion%axis, axis)
      displacement = [dot_product(axis, motion%displacement), dot_product(other, motion%displacement)]
      call shear(law, rates, motion, displacement, state(at_width), contact, &
                 state(law%at_u), state(law%at_w), state(at_force + 1), friction)
      force%tangential = -(state(at_force + 1)*axis + state(at_force + 2)*other)
    end if
    if (law%accounts /= 0) then ! work of the bodies by the trapezoidal rule, as in velocity Verlet; the friction part of it
      state(law%at_work) = state(law%at_work) &
                           + 0.5_dp*dot_product([approach, displacement], before + state(at_force:at_force + 2))
      state(law%at_work + 1) = state(law%at_work + 1) + friction
    end if
  end subroutine contact_step

  !> The grid of a new contact: for an impact at this speed, if it approaches, and for the present
  !> overlap.
  pure subroutine touch(law, rates, motion, state, status)
    type(law_type), intent(in) :: law
    type(rates_type), intent(in) :: rates
    type(motion_type), intent(in) :: motion
    real(dp), intent(inout) :: state(*)
    integer(ip), intent(out) :: status
    real(dp) :: overlap, mass
    status = done
    overlap = max(motion%overlap, least_overlap*motion%radius)
    if (min(motion%velocity, motion%mobility(1)) > at_rest) then
      mass = rates%step/(2*motion%mobility(1))
      overlap = max(overlap, largest_overlap(law, mass, motion%velocity, motion%radius))
      if (least_steps*rates%step*motion%velocity > elastic_contact_time*overlap) status = step_too_long
    end if
    if (status /= done) return
    state(at_width) = margin*sqrt(min(overlap, motion%radius)*motion%radius)
    state(at_overlap) = motion%overlap - motion%velocity*rates%step
  end subroutine touch

  !> The last force on body 1.
  pure subroutine contact_force(normal, state, force) bind(c, name="rst_law_force")
    real(dp), intent(in) :: normal(3), state(*)
    type(force_type), intent(out) :: force
    force%normal = state(at_force)
    force%tangential = -(state(at_force + 1)*state(at_axis:at_axis + 2) &
                         + state(at_force + 2)*cross(normal, state(at_axis:at_axis + 2)))
  end subroutine contact_force

  !> The frame follows a normal that jumps.
  pure subroutine contact_turn(from, to, state) bind(c, name="rst_law_turn")
    real(dp), intent(in) :: from(3), to(3)
    real(dp), intent(inout) :: state(*)
    state(at_axis:at_axis + 2) = turned(state(at_axis:at_axis + 2), from, to)
  end subroutine contact_turn

  pure function cross(a, b) result(c)
    real(dp), intent(in) :: a(3), b(3)
    real(dp) :: c(3)
    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  !> The first tangential axis, brought back into the tangential plane; any one for a new contact
  !> (zero). If the normal has turned too far towards it, it is unchanged and `lost` is set.
  pure subroutine follow_normal(normal, axis, lost)
    real(dp), intent(in) :: normal(3)
    real(dp), intent(inout) :: axis(3)
    logical, intent(out) :: lost
    real(dp), parameter :: most_lost = 0.75_dp  !! of the square of its length: a turn by 60 degrees
    real(dp) :: in_plane(3), size
    lost = .false.
    in_plane = axis
    if (.not. dot_product(axis, axis) > 0) then
      in_plane = 0
      in_plane(minloc(abs(normal), 1)) = 1
    end if
    in_plane = in_plane - dot_product(normal, in_plane)*normal
    size = dot_product(in_plane, in_plane)
    if (dot_product(axis, axis) > 0 .and. size < (1 - most_lost)) lost = .true.
    if (.not. lost) axis = in_plane/sqrt(size)
  end subroutine follow_normal

  !> A tangential vector after the smallest rotation that turns one normal into another.
  pure function turned(vector, from, to)
    real(dp), intent(in) :: vector(3), from(3), to(3)
    real(dp) :: turned(3), axis(3), cosine
    axis = cross(from, to)
    cosine = dot_product(from, to)
    turned = vector ! opposite: half a turn about the vector itself
    if (1 + cosine > 1.0e-12_dp) turned = cosine*vector + cross(axis, vector) + axis*(dot_product(axis, vector)/(1 + cosine))
  end function turned
end module rst_contact_interfaces
