! SPDX-License-Identifier: BSD-3-Clause
!> Single procedures of the method `sync` behind plain arguments, for test_sync_parts.c and
!> test_sync_front.c. One motion at a time is held here, in rooms of fixed size: a test program, not
!> the library, may keep state.
module sync_probe
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t, c_null_ptr
  use rst_friction_mode, only: mode_gross_slip, mode_partial_slip
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, point, integral, weights_at, last_coefficient, start_of, differential, applied, root_between, &
                             factors_type, factorize, solution_of
  use rst_arms, only: respond
  use rst_panel, only: panel_type, normal_type
  use rst_normal_motion, only: normal_control_type, follow_normal
  use rst_store, only: contact_type, record_type, piece_type, store_type, of_arm
  use rst_front, only: element_type, margin_type, element_at, find_front
  use rst_tangential_motion, only: follow_contact
  implicit none (type, external)
  private

  integer(ip), parameter :: arms = 4, room = 300, points = stages + 1

  type(normal_type) :: normal
  type(store_type) :: store
  real(dp), target :: g_room(arms), rate_room(arms), entry_room(2*stages*arms), kernel_room(stages*points*arms*room)
  real(dp), target, dimension(points*arms*room) :: memory_room, loading_room
  real(dp), target :: corrective_room(of_arm*points*arms*room)
  real(dp), target :: response_room(stages*points*arms)
  real(dp), target, dimension(points*arms) :: memory_z_room, memory_x_room, loading_x_room
  type(panel_type), target :: panel_room(room)
  type(record_type), target :: record_room(room)
  type(piece_type), target :: piece_room(room)

contains

  subroutine probe_collocation(x, a) bind(c)
    real(c_double), intent(out) :: x(0:stages), a(stages, stages)
    x = point
    a = integral
  end subroutine probe_collocation

  subroutine probe_weights(x, weight) bind(c)
    real(c_double), value :: x
    real(c_double), intent(out) :: weight(0:stages)
    weight = weights_at(x)
  end subroutine probe_weights

  !> last_coefficient and start_of of y, its slopes at the points if y(0) is 0, and its root before
  !> the point i.
  subroutine probe_polynomial(y, i, last, start, slope, root) bind(c)
    real(c_double), intent(in) :: y(0:stages)
    integer(c_int64_t), value :: i
    real(c_double), intent(out) :: last, start, slope(stages), root
    last = last_coefficient(y)
    start = start_of(y(1:))
    slope = applied(differential, y(1:))
    root = root_between(i, y)
  end subroutine probe_polynomial

  !> x with a x = b. Nonzero: a is singular.
  function probe_solve(a, b, x) bind(c) result(failed)
    real(c_double), intent(in) :: a(stages, stages), b(stages)
    real(c_double), intent(out) :: x(stages)
    integer(c_int64_t) :: failed
    type(factors_type) :: factors
    logical :: fails
    call factorize(a, factors, fails)
    failed = merge(1, 0, fails)
    if (.not. fails) x = solution_of(factors, b)
  end function probe_solve

  function probe_respond(rate, span, kernel, decay) bind(c) result(failed)
    real(c_double), value :: rate
    real(c_double), intent(in) :: span(stages)
    real(c_double), intent(out) :: kernel(stages, stages), decay(stages)
    integer(c_int64_t) :: failed
    real(dp) :: both(stages, 0:stages)
    logical :: fails
    call respond(rate, span, both, fails)
    kernel = both(:, 1:)
    decay = both(:, 0)
    failed = merge(1_ip, 0_ip, fails)
  end function probe_respond

  !> The normal motion of a solid, in panels of at most (pi/2)/2^halvings; counts: panels of the
  !> compression and of all.
  function probe_normal(eta, n, g, rate, depth, halvings, roughness, counts) bind(c) result(found)
    real(c_double), value :: eta, depth, roughness
    integer(c_int64_t), value :: n, halvings
    real(c_double), intent(in) :: g(n), rate(n)
    integer(c_int64_t), intent(out) :: counts(2)
    integer(c_int64_t) :: found
    type(normal_control_type) :: control
    call hold(eta, n, g, rate)
    normal%scale = sqrt(0.4_dp*depth)
    normal%closeness = 1.0e-12_dp
    control = normal_control_type(roughness=roughness, stop_speed=1.0e-9_dp, halvings=halvings, capacity=room, &
                                  n_coarse=0_ip, n_coarse_compression=0_ip, coarse=c_null_ptr)
    call follow_normal(control, normal, found)
    counts = [normal%n_compression, normal%n_panels]
  end function probe_normal

  !> The solid, and the views of the rooms that its number of arms asks for.
  subroutine hold(eta, n, g, rate)
    real(dp), intent(in) :: eta
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: g(n), rate(n)
    g_room(:n) = g
    rate_room(:n) = rate
    normal%eta = eta
    normal%n_arms = n
    normal%g => g_room(:n)
    normal%rate => rate_room(:n)
    normal%panel => panel_room
    normal%memory(0:stages, 1:n, 1:room) => memory_room
    normal%loading(0:stages, 1:n, 1:room) => loading_room
    normal%kernel(1:stages, 0:stages, 1:n, 1:room) => kernel_room
    normal%entry(1:stages, 1:n, 1:2) => entry_room
    store%n_records = 0
    store%n_pieces = 0
    store%n_trials = huge(store%n_trials)
    store%record => record_room
    store%piece => piece_room
    store%corrective(1:of_arm, 0:stages, 1:n, 1:room) => corrective_room
    store%kernel_room(1:stages, 0:stages, 1:n) => response_room
    store%kernel => store%kernel_room
    store%memory_z(0:stages, 1:n) => memory_z_room
    store%memory_x(0:stages, 1:n) => memory_x_room
    store%loading_x(0:stages, 1:n) => loading_x_room
  end subroutine hold

  !> The motion on the panel p (from 1) where x of it is passed, 0 to 1: angle, radius, time, depth,
  !> velocity, force.
  subroutine probe_motion(p, x, motion) bind(c)
    integer(c_int64_t), value :: p
    real(c_double), value :: x
    real(c_double), intent(out) :: motion(6)
    real(dp) :: weight(0:stages)
    weight = weights_at(x)
    associate (on => panel_room(p))
      motion = [on%from + x*(on%to - on%from), sum(weight*on%radius), sum(weight*on%time), sum(weight*on%depth), &
                sum(weight*on%velocity), sum(weight*on%force)]
    end associate
  end subroutine probe_motion

  !> The tangential motion on the normal one that was followed last.
  function probe_contact(chi, psi, roughness, velocity, n_pieces) bind(c) result(found)
    real(c_double), value :: chi, psi, roughness
    real(c_double), intent(out) :: velocity
    integer(c_int64_t), intent(out) :: n_pieces
    integer(c_int64_t) :: found
    call follow_contact(normal, contact_type(chi=chi, psi=psi, roughness=roughness, noise=1.0e-8_dp, &
                        closeness=1.0e-12_dp, stress=1.0_dp, &
                                             mode=merge(mode_gross_slip, mode_partial_slip, psi > 1)), store, velocity, found)
    n_pieces = store%n_pieces
  end function probe_contact

  !> The piece i (from 1): its panel, the part of it, whether in the root of what is left; U', S,
  !> stick radius at y of the piece.
  subroutine probe_piece(i, y, panel, range, rooted, motion) bind(c)
    integer(c_int64_t), value :: i
    real(c_double), value :: y
    integer(c_int64_t), intent(out) :: panel, rooted
    real(c_double), intent(out) :: range(2), motion(3)
    real(dp) :: weight(0:stages)
    weight = weights_at(y)
    associate (on => piece_room(i))
      panel = on%panel
      rooted = on%rooted
      range = [on%from, on%to]
      motion = [sum(weight*on%shear_velocity), sum(weight*on%shear_force), sum(weight*on%stick_radius)]
    end associate
  end subroutine probe_piece

  !> The front in a contact that was loaded at the rates D' = 1 and U' = shear until the time
  !> `loaded`, all of it in stick, has the memories m of the arms in z and x now, and the velocity r
  !> of slip; recorded over A. out: radius, H, y at centre and edge.
  subroutine probe_front(n, g, rate, eta, shear, loaded, time, m, slip, sense, out) bind(c)
    integer(c_int64_t), value :: n
    integer(c_int), value :: sense
    real(c_double), intent(in) :: g(n), rate(n), m(n, 2)
    real(c_double), value :: eta, shear, loaded, time, slip
    real(c_double), intent(out) :: out(4)
    type(margin_type) :: margin
    type(element_type) :: outermost
    real(dp) :: stress, force, radius
    integer(ip) :: i, j, k
    integer(ip), parameter :: records = 4
    call hold(eta, n, g, rate)
    store%n_records = records
    do j = 1, records
      associate (r => record_room(j))
        r%from = sqrt(loaded)*real(j - 1, dp)/records
        r%to = sqrt(loaded)*real(j, dp)/records
                do i = 0, stages
          radius = r%from + (r%to - r%from)*point(i)
          r%touch(:, i) = [radius, radius**2, 2*radius, shear*2*radius]
          do k = 1, n
            call load(g(k), rate(k), radius**2, stress, force)
            store%corrective(:, i, k, j) = [(1 - shear)*[stress, force], (1 + shear)*[stress, force]]
          end do
        end do
      end associate
    end do
    call element_at(normal, store, time, sense, sqrt(loaded), outermost)
    margin%angle = 0
    margin%at_centre = eta*slip + sum(m(:, 1) - sense*m(:, 2))
    margin%accuracy = 1.0e-4_dp
    call find_front(normal, store, time, sense, sqrt(loaded), outermost, margin)
    out = [margin%stick_radius, margin%force, margin%at_centre, margin%at_edge]
  end subroutine probe_front

  !> M and P at the time t under D' = 1, A = sqrt(t), by the series of the exponential (rate t < 2).
  pure subroutine load(g, rate, t, stress, force)
    real(dp), intent(in) :: g, rate, t
    real(dp), intent(out) :: stress, force
    real(dp) :: term, wide
    integer(ip) :: j
    term = g*t             ! g int_0^t exp(-rate v) dv = sum g t (-rate t)^j/(j + 1)!
    wide = 2*g*t*sqrt(t)/3 ! g int_0^t sqrt(v) exp(-rate (t - v)) dv: terms t^(3/2) (-rate t)^j/((3/2)(5/2)...(3/2 + j))
    stress = 0
    force = 0
    do j = 0, 40
      stress = stress + term
      force = force + wide
      term = -term*rate*t/real(j + 2, dp)
      wide = -wide*rate*t/(real(j, dp) + 2.5_dp)
    end do
  end subroutine load
end module sync_probe
