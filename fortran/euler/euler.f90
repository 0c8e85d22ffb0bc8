!> The paper's method: the MDR foundation (9)-(17) and explicit Euler for the sphere, in the units
!> of docs/theory.md, section 2.
!>
!> A step moves the sphere with its present velocities, computes the forces of the foundation, and
!> then changes the velocities. Phases: compression (elements enter), restitution (elements leave,
!> outermost first), done. The tangential motion has one of four modes:
!>   frictionless      nothing to do
!>   gross_slip        q = f everywhere: no tangential element states until all elements stick at once
!>                     (docs/theory.md, section 4); for psi >= psi_c they never do, and (27) follows
!>   partial_slip      return mapping, element by element
!>   no_slip           the limit psi -> 0: all elements in contact stick
module rst_euler
  use rst_precision, only: dp, ip
  use rst_foundation, only: place_elements, normal_forces, sticking_forces, friction_forces, total_force
  use rst_euler_ledger, only: post_viscous, post_friction, post_unloading, post_left_behind
  use rst_ledger, only: ledger_type
  use rst_friction_mode, only: mode_frictionless, mode_gross_slip, mode_partial_slip, mode_no_slip
  use rst_motion_factors, only: mass_factor
  implicit none (type, external)
  private
  public :: scene_type, state_type, start_impact, advance_impact
  public :: phase_compression, phase_restitution, phase_done, phase_sunk, phase_overflow, phase_stalled

  integer(ip), parameter :: phase_compression = 0, phase_restitution = 1, phase_done = 2, phase_sunk = 3, &
                            phase_overflow = 4, phase_stalled = 5
  integer(ip), parameter :: stalled_for_good = 10000  !! at the turning point a few steps may stall

  !> The solid, the sphere and the resolution. Twin of `struct euler_scene` in C.
  type, bind(c) :: scene_type
    real(dp) :: chi, shear_speed  !! U' at first touch
    real(dp) :: g_inf, eta
    real(dp) :: step, spacing
    real(dp) :: rest_speed  !! a sphere with less than this left, kinetic and elastic, has sunk in for good
    integer(ip) :: n_terms, capacity
    integer(ip) :: can_sink     !! nonzero: the solid has no equilibrium modulus
    integer(ip) :: keep_ledger
    integer(ip) :: mode         !! of the tangential side at first touch
  end type scene_type

  !> The state of the impact. Twin of `struct euler_state` in C. Forces are int f dX and int q dX
  !> over X > 0.
  type, bind(c) :: state_type
    real(dp) :: time, depth, velocity, shift, shear_velocity
    real(dp) :: force, shear_force  !! as they move the sphere
    real(dp) :: true_edge_force, true_edge_shear  !! integrated to the true edge of contact, to be reported
    real(dp) :: centre_force    !! of the innermost element in the last step: it dates the end of contact
    real(dp) :: leave_time      !! when the latest element left
    real(dp) :: max_depth, max_force, max_time
    integer(ip) :: n_contact, max_contact, phase, mode, n_steps, n_updates
    integer(ip) :: n_stalled       !! consecutive steps too short to change the indentation in rounding
    type(ledger_type) :: ledger
  end type state_type

contains

  !> First touch: D = 0, D' = 1, U' = psi. Without slip the problem is linear in U and psi only sets
  !> its scale.
  pure subroutine start_impact(scene, state, x2)
    type(scene_type), intent(in) :: scene
    type(state_type), intent(out) :: state
    real(dp), intent(out) :: x2(scene%capacity)

    call place_elements(scene%capacity, scene%spacing, x2)
    state%time = 0
    state%depth = 0
    state%velocity = 1
    state%shift = 0
    state%shear_velocity = scene%shear_speed
    state%force = 0
    state%shear_force = 0
    state%true_edge_force = 0
    state%true_edge_shear = 0
    state%centre_force = 0
    state%leave_time = 0
    state%max_depth = 0
    state%max_force = 0
    state%max_time = 0
    state%n_contact = 0
    state%max_contact = 0
    state%phase = phase_compression
    state%n_steps = 0
    state%n_updates = 0
    state%n_stalled = 0
    state%ledger = ledger_type(0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
    state%mode = scene%mode
  end subroutine start_impact

  !> Take up to n_steps steps. u, yx, q, slip are not touched before partial slip begins.
  pure subroutine advance_impact(scene, g, tau, decay, gain, x2, f, yz, u, yx, q, slip, move, q_before, n_steps, state)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: n_steps
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), decay(scene%n_terms), gain(scene%n_terms)
    real(dp), intent(in) :: x2(scene%capacity)
    real(dp), intent(inout) :: f(scene%capacity), yz(scene%capacity, scene%n_terms)
    real(dp), intent(inout) :: u(scene%capacity), yx(scene%capacity, scene%n_terms)
    real(dp), intent(inout) :: q(scene%capacity), slip(scene%capacity)
    real(dp), intent(inout) :: move(scene%capacity), q_before(scene%capacity)  !! of the ledger, not touched without it
    type(state_type), intent(inout) :: state
    integer(ip) :: i, n_old, n_inside
    real(dp) :: advance_z, advance_x

    do i = 1, n_steps
      if (state%phase >= phase_done) return
      call move_sphere(scene, state, advance_z, advance_x)
      n_old = state%n_contact
      call enter_elements(scene, x2, state)
      if (state%phase == phase_overflow) return
      n_inside = state%n_contact
      call normal_forces(scene%capacity, n_old, n_inside, x2, state%depth, advance_z, scene%g_inf, &
                         scene%eta/scene%step, scene%n_terms, decay, gain, yz, f)
      call release_elements(scene, f, state)
      if (scene%keep_ledger /= 0) call remember_shear(n_old, n_inside, q, q_before, state)
      call tangential_step(scene, decay, gain, x2, f, n_old, advance_z, advance_x, u, yx, q, slip, state)
      if (scene%keep_ledger /= 0) then
        call keep_ledger(scene, g, tau, gain, x2, yz, u, yx, q, q_before, slip, move, n_old, n_inside, advance_z, advance_x, &
                         state)
      end if
      call correct_edge(scene, gain, f, q, n_old, advance_z, advance_x, state)
      call accelerate_sphere(scene, state)
      call start_sticking(scene, x2, yz, u, yx, q, slip, state)
      call judge_phase(scene, g, x2, yz, advance_z, state)
    end do
  end subroutine advance_impact

  pure subroutine move_sphere(scene, state, advance_z, advance_x)
    type(scene_type), intent(in) :: scene
    type(state_type), intent(inout) :: state
    real(dp), intent(out) :: advance_z, advance_x
    advance_z = scene%step*state%velocity
    advance_x = scene%step*state%shear_velocity
    state%depth = state%depth + advance_z
    state%shift = state%shift + advance_x
    state%time = state%time + scene%step
    state%n_steps = state%n_steps + 1
  end subroutine move_sphere

  !> The surface outside is at rest, so the profile X^2 reaches element n+1 at D = X_(n+1)^2. No
  !> element enters twice in a single impact: none enters after compression.
  pure subroutine enter_elements(scene, x2, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: x2(scene%capacity)
    type(state_type), intent(inout) :: state
    if (state%phase /= phase_compression) return
    do while (state%n_contact < scene%capacity)
      if (state%depth <= x2(state%n_contact + 1)) exit
      state%n_contact = state%n_contact + 1
    end do
    if (state%n_contact == scene%capacity) state%phase = phase_overflow
    state%max_contact = max(state%max_contact, state%n_contact)
  end subroutine enter_elements

  !> An element leaves when its force would become tensile; f falls with X, so the outermost leave
  !> first.
  pure subroutine release_elements(scene, f, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: f(scene%capacity)
    type(state_type), intent(inout) :: state
    state%n_updates = state%n_updates + state%n_contact
    do while (state%n_contact > 0)
      if (f(state%n_contact) > 0) exit
      state%n_contact = state%n_contact - 1
      if (state%n_contact == 0) then
        call end_contact(scene, f(1), state)
      else
        state%leave_time = state%time
      end if
    end do
    if (state%n_contact > 0) state%centre_force = f(1)
    state%force = scene%spacing*total_force(scene%capacity, state%n_contact, f)
  end subroutine release_elements

  !> The innermost element, at dx/2, left within the step, where its force passed zero. Its
  !> neighbour at 3 dx/2 left before; the square of the contact radius goes on to zero at the same
  !> rate: (1/4)/(9/4 - 1/4) of that interval more.
  pure subroutine end_contact(scene, force, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: force
    type(state_type), intent(inout) :: state
    real(dp) :: end_time
    state%phase = phase_done
    end_time = state%time - scene%step*force/min(force - state%centre_force, -tiny(1.0_dp))
    if (state%leave_time > 0) end_time = end_time + max(0.0_dp, end_time - state%leave_time)/8
    state%depth = state%depth + state%velocity*(end_time - state%time)
    state%time = end_time
  end subroutine end_contact

  pure subroutine tangential_step(scene, decay, gain, x2, f, n_old, advance_z, advance_x, u, yx, q, slip, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: decay(scene%n_terms), gain(scene%n_terms), x2(scene%capacity), f(scene%capacity)
    integer(ip), intent(in) :: n_old
    real(dp), intent(in) :: advance_z, advance_x
    real(dp), intent(inout) :: u(scene%capacity), yx(scene%capacity, scene%n_terms)
    real(dp), intent(inout) :: q(scene%capacity), slip(scene%capacity)
    type(state_type), intent(inout) :: state

    select case (state%mode)
    case (mode_gross_slip)
      state%shear_force = state%force
      return
    case (mode_frictionless)
      return
    case default
      call sticking_forces(scene%capacity, min(n_old, state%n_contact), state%n_contact, x2, state%depth, advance_z, &
                           advance_x, scene%g_inf, scene%eta/scene%step, scene%n_terms, decay, gain, u, yx, q)
    end select
    if (state%mode == mode_partial_slip) then
      call friction_forces(scene%capacity, state%n_contact, f, scene%g_inf, scene%eta/scene%step, scene%n_terms, &
                           gain, u, yx, q, slip)
    end if
    state%shear_force = scene%spacing*total_force(scene%capacity, state%n_contact, q)
  end subroutine tangential_step

  !> The forces for a contact that ends at sqrt(D) and not at the end of a cell: where dashpots make
  !> f jump at the edge, the whole cells make it ripple by dx times that jump. The sphere's motion
  !> averages this out, a reported force does not. Elements that entered within the step are
  !> replaced by the force at the edge, that of a surface just touched.
  pure subroutine correct_edge(scene, gain, f, q, n_old, advance_z, advance_x, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: gain(scene%n_terms), f(scene%capacity), q(scene%capacity)
    integer(ip), intent(in) :: n_old
    real(dp), intent(in) :: advance_z, advance_x
    type(state_type), intent(inout) :: state
    real(dp) :: stiffness, edge_f, edge_q, missing
    integer(ip) :: j, k

    state%true_edge_force = state%force
    state%true_edge_shear = state%shear_force
    if (state%phase /= phase_compression) return
    stiffness = scene%eta/scene%step
    do k = 1, scene%n_terms
      stiffness = stiffness + gain(k)
    end do
    edge_f = stiffness*advance_z
    edge_q = max(-edge_f, min(edge_f, stiffness*advance_x))
    missing = sqrt(state%depth) - real(n_old, dp)*scene%spacing
    state%true_edge_force = state%force + missing*edge_f
    state%true_edge_shear = state%shear_force + missing*edge_q
    do j = n_old + 1, state%n_contact
      state%true_edge_force = state%true_edge_force - scene%spacing*f(j)
      if (state%mode == mode_partial_slip) state%true_edge_shear = state%true_edge_shear - scene%spacing*q(j)
    end do
    select case (state%mode)
    case (mode_gross_slip)
      state%true_edge_shear = state%true_edge_force
    case (mode_frictionless, mode_no_slip)
      state%true_edge_shear = state%shear_force
    end select
  end subroutine correct_edge

  pure subroutine accelerate_sphere(scene, state)
    type(scene_type), intent(in) :: scene
    type(state_type), intent(inout) :: state
    state%velocity = state%velocity - scene%step*mass_factor*state%force
    state%shear_velocity = state%shear_velocity - scene%step*mass_factor*2*scene%chi*state%shear_force
  end subroutine accelerate_sphere

  !> Gross slip ends everywhere at once when U' = D' (theory.md, 4): every element then has q = f,
  !> u_x = D - X^2 and the same stresses in x as in z. The step that ends here slipped.
  pure subroutine start_sticking(scene, x2, yz, u, yx, q, slip, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: x2(scene%capacity), yz(scene%capacity, scene%n_terms)
    real(dp), intent(inout) :: u(scene%capacity), yx(scene%capacity, scene%n_terms), q(scene%capacity), slip(scene%capacity)
    type(state_type), intent(inout) :: state
    integer(ip) :: n
    if (state%mode /= mode_gross_slip) return
    if (state%shear_velocity > state%velocity) return
    state%mode = mode_partial_slip
    n = state%n_contact
    u(1:n) = state%depth - x2(1:n)
    q(1:n) = 0
    slip(1:n) = 1
    yx(1:n, :) = yz(1:n, :)
  end subroutine start_sticking

  !> Stop if the rebound is so slow that a step does not change the rounded indentation. Compression
  !> ends when the sphere turns. Without an equilibrium modulus it may never do so (docs/theory.md,
  !> section 6). Then it ends when the kinetic energy plus that in the springs is too small for
  !> rest_speed.
  pure subroutine judge_phase(scene, g, x2, yz, advance_z, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), x2(scene%capacity), yz(scene%capacity, scene%n_terms), advance_z
    type(state_type), intent(inout) :: state
    state%max_force = max(state%max_force, state%true_edge_force)
    if (abs(advance_z) < 0.5_dp*epsilon(1.0_dp)*state%depth) then
      state%n_stalled = state%n_stalled + 1
      if (state%n_stalled > stalled_for_good .and. state%phase < phase_done) state%phase = phase_stalled
    else
      state%n_stalled = 0
    end if
    if (state%phase /= phase_compression) return
    if (state%velocity <= 0) then
      state%phase = phase_restitution
      state%max_depth = state%depth
      state%max_time = state%time
    else if (scene%can_sink /= 0 .and. state%velocity < scene%rest_speed) then
      if (state%velocity**2 + elastic_energy(scene, state, g, x2, yz) < scene%rest_speed**2) then
        state%phase = phase_sunk
        state%max_depth = state%depth
        state%max_time = state%time
      end if
    end if
  end subroutine judge_phase

  !> Energy in the springs, in units of the normal impact energy.
  pure function elastic_energy(scene, state, g, x2, y) result(energy)
    type(scene_type), intent(in) :: scene
    type(state_type), intent(in) :: state
    real(dp), intent(in) :: g(scene%n_terms), x2(scene%capacity), y(scene%capacity, scene%n_terms)
    real(dp) :: energy
    integer(ip) :: j, k
    energy = 0
    do j = 1, state%n_contact
      energy = energy + scene%g_inf*(state%depth - x2(j))**2
    end do
    do k = 1, scene%n_terms
      do j = 1, state%n_contact
        energy = energy + y(j, k)**2/g(k)
      end do
    end do
    energy = energy*mass_factor*scene%spacing
  end function elastic_energy

  !> Tangential forces before the step, since the ledger takes the mean over the step.
  pure subroutine remember_shear(n_old, n_inside, q, q_before, state)
    integer(ip), intent(in) :: n_old, n_inside
    real(dp), intent(in) :: q(n_inside)
    real(dp), intent(inout) :: q_before(n_inside)
    type(state_type), intent(in) :: state
    if (state%mode /= mode_partial_slip) return
    q_before(1:n_old) = q(1:n_old)
    q_before(n_old + 1:n_inside) = 0
  end subroutine remember_shear

  !> Post one step to the ledger. Elements n_contact+1..n_inside have left in this step.
  pure subroutine keep_ledger(scene, g, tau, gain, x2, yz, u, yx, q, q_before, slip, move, n_old, n_inside, advance_z, &
                              advance_x, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), gain(scene%n_terms), x2(scene%capacity)
    real(dp), intent(in) :: yz(scene%capacity, scene%n_terms)
    real(dp), intent(inout) :: u(scene%capacity), yx(scene%capacity, scene%n_terms)
    real(dp), intent(in) :: q(scene%capacity), q_before(scene%capacity), slip(scene%capacity)
    real(dp), intent(inout) :: move(scene%capacity)
    integer(ip), intent(in) :: n_old, n_inside
    real(dp), intent(in) :: advance_z, advance_x
    type(state_type), intent(inout) :: state
    real(dp) :: weight_z, weight_x
    type(ledger_type) :: now
    integer(ip) :: j, n

    weight_z = 2*mass_factor*scene%spacing
    weight_x = 2*scene%chi*weight_z
    n = state%n_contact
    now = ledger_type(0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)

    do j = 1, n
      move(j) = merge(advance_z, state%depth - x2(j), j <= n_old)
    end do
    call post_viscous(weight_z, scene%step, scene%capacity, n, scene%eta, move, scene%n_terms, g, tau, yz, now%viscous_z)
    do j = n + 1, n_inside
      move(j) = state%depth - x2(j)
    end do
    call post_left_behind(weight_z, scene%capacity, n + 1, n_inside, scene%g_inf, move, scene%n_terms, g, yz, now%left_z)

    select case (state%mode)
    case (mode_gross_slip)  ! x moves with z: the same losses, times 2 chi, and the sphere slides ahead of the surface
      now%viscous_x = 2*scene%chi*now%viscous_z
      now%left_x = 2*scene%chi*now%left_z
      now%friction_x = weight_x*state%force/scene%spacing*(advance_x - advance_z)
    case (mode_partial_slip, mode_no_slip)
      do j = 1, n
        move(j) = merge(advance_x, advance_x*((state%depth - x2(j))/advance_z), j <= n_old)
      end do
      if (state%mode == mode_partial_slip) then
        move(1:n) = move(1:n) - slip(1:n)
        call post_friction(weight_x, scene%capacity, n, q_before, q, slip, now%friction_x)
        call post_unloading(weight_x, scene%capacity, n + 1, n_inside, scene%g_inf, scene%eta/scene%step, scene%n_terms, gain, &
                            q_before, u, yx, now%friction_x)
      end if
      call post_viscous(weight_x, scene%step, scene%capacity, n, scene%eta, move, scene%n_terms, g, tau, yx, now%viscous_x)
      call post_left_behind(weight_x, scene%capacity, n + 1, n_inside, scene%g_inf, u, scene%n_terms, g, yx, now%left_x)
    end select

    state%ledger%viscous_z = state%ledger%viscous_z + now%viscous_z
    state%ledger%left_z = state%ledger%left_z + now%left_z
    state%ledger%friction_x = state%ledger%friction_x + now%friction_x
    state%ledger%viscous_x = state%ledger%viscous_x + now%viscous_x
    state%ledger%left_x = state%ledger%left_x + now%left_x
  end subroutine keep_ledger
end module rst_euler
