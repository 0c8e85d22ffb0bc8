! SPDX-License-Identifier: BSD-3-Clause
!> The elements of the method `cvode` and their tangential force (docs/theory.md, sections 2 and 3;
!> docs/cvode.md).
!>
!> Between the instants at which it begins to stick or to slip, the state of an element follows from
!> the states of the sphere:
!>
!>   normal   f = G_inf (D - X^2) + sum_k [M_k - c_k] + eta D'          c_k: M_k(t_X), decaying with tau_k
!>   stick    q = G_inf (U - alpha) + sum_k [Mx_k - beta_k] + eta U'    alpha, beta_k: kept when it last began to stick
!>   slip     q = +-f, and u = +-(D - X^2) + r where r relaxes by itself (module rst_cvode_recovery)
!>
!> The code computes the margin d = f - q of the sticking element: it slips forward for d < 0, and
!> backward for d > 2 f. Of the fading memory d needs only b_k = c_k - beta_k. At the change from
!> stick to slip q has no jump. So the rates are continuous there, even if the instant has not been
!> found.
!>
!> The integrand is f - q. It vanishes where the contact slips forward and, without a parallel
!> dashpot, at the edge: int_0^A q dX = int_0^A f dX - int_0^A (f - q) dX. The first part is exact.
!> The second uses the trapezoidal rule, up to the last element and on to the edge. Cells in which
!> slip begins are divided there, since the slip annulus may be thinner than a cell. If a term
!> relaxes faster than the edge passes from element to element, its fading memory b is a thin layer
!> at the edge, which the trapezoidal rule does not resolve. It is exponential in the time since
!> entry, so the error of the rule in a cell is known: width times b at its younger end times
!>
!>   missed(z) = (1 + exp(-z))/2 - (1 - exp(-z))/z,   z: what passed between the entries of both ends, over tau_k.
module rst_cvode_elements
  use rst_cvode_types, only: scene_type, contact_type, shear_sums_type, state_depth, state_velocity, memory_at, shift_at, &
                             shear_velocity_at, shear_memory_at
  use rst_motion_factors, only: shear_factor
  use rst_friction_mode, only: mode_no_slip
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: layer_weights, margins, force_by_rule, shear_rates, slip_rates, fade, enter_element, begin_slip, begin_stick

  !> What an element does; twin of `enum cvode_motion`.
  integer(ip), parameter :: sticks = 0, slips_forward = 1, slips_backward = -1


contains

  !> missed(z) of the cell inside each element.
  subroutine layer_weights(scene, tau, entry, layer_weight) bind(c, name="rst_cvode_layer_weights")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), entry(scene%n_nodes)
    real(dp), intent(out) :: layer_weight(scene%n_nodes, scene%n_terms)
    integer(ip) :: i, k
    do k = 1, scene%n_terms
      layer_weight(1, k) = 0
      do i = 2, scene%n_nodes
        layer_weight(i, k) = missed((entry(i) - entry(i - 1))/tau(k))
      end do
    end do
  end subroutine layer_weights

  pure function missed(z) result(part)
    real(dp), intent(in) :: z
    real(dp) :: part
    if (z < 0.02_dp) then  ! the difference would be lost in rounding
      part = z*z*(1.0_dp/12 - z*(1.0_dp/24 - z/80))
    else
      part = 0.5_dp*(1 + exp(-z)) - (1 - exp(-z))/z
    end if
  end function missed

  !> Margins d and normal stresses f of the elements inside the edge, and of one more if it has been
  !> in contact. start_y, start_rate: states at the beginning of the step, for elements that enter
  !> within it; past: M of the compression at their entry. layer: error of the rule in the cell
  !> inside each element, over its width.
  subroutine margins(scene, g, tau, contact, x, entry, past, shift, c, b, layer_weight, start_y, start_rate, t, y, &
                     n_contact, d, f, layer) bind(c, name="rst_cvode_margins")
    type(scene_type), intent(in) :: scene
    type(contact_type), intent(in) :: contact
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    real(dp), intent(in) :: x(scene%n_nodes), entry(scene%n_nodes), past(scene%n_nodes, scene%n_terms)
    real(dp), intent(in) :: shift(scene%n_nodes), c(scene%n_nodes, scene%n_terms), b(scene%n_nodes, scene%n_terms)
    real(dp), intent(in) :: layer_weight(scene%n_nodes, scene%n_terms)
    real(dp), intent(in) :: start_y(scene%n_states), start_rate(scene%n_states)
    real(dp), intent(in), value :: t
    real(dp), intent(in) :: y(scene%n_states)
    integer(ip), intent(inout) :: n_contact  !! in: a guess
    real(dp), intent(inout) :: d(scene%n_nodes), f(scene%n_nodes), layer(scene%n_nodes)
    real(dp) :: common_d, common_f, faded
    integer(ip) :: i, k, known, new

    n_contact = count_inside(scene%n_nodes, x, contact%square, n_contact)
    known = min(n_contact + 1, scene%n_entered)
    common_f = scene%g_inf*y(state_depth) + scene%eta*y(state_velocity)
    common_d = scene%g_inf*(y(state_depth) - y(shift_at(scene))) + scene%eta*(y(state_velocity) - y(shear_velocity_at(scene)))
    do k = 1, scene%n_terms
      common_f = common_f + y(memory_at(k))
      common_d = common_d + (y(memory_at(k)) - y(shear_memory_at(scene, k)))
    end do
    do i = 1, known
      f(i) = common_f - scene%g_inf*x(i)**2
      d(i) = common_d - scene%g_inf*(x(i)**2 - shift(i))
      layer(i) = 0
    end do
    do k = 1, scene%n_terms
      faded = exp(-(t - scene%reference)/tau(k))
      do i = 1, known
        f(i) = f(i) - faded*c(i, k)
        d(i) = d(i) - faded*b(i, k)
        layer(i) = layer(i) + layer_weight(i, k)*faded*b(i, k)
      end do
    end do
    do new = scene%n_entered + 1, n_contact
      call new_margin(scene, g, tau, x(new), entry(new), past, new, layer_weight, start_y, start_rate, t, y, common_f, &
                      d(new), f(new), layer(new))
    end do
  end subroutine margins

  !> An element that has entered since the step began. Its U and Mx at entry come from a cubic
  !> between the beginning of the step and now; of a term that relaxes within the step they come
  !> from a straight line, since its slopes are useless.
  pure subroutine new_margin(scene, g, tau, x, entry, past, i, layer_weight, start_y, start_rate, t, y, common_f, d, f, layer)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), x, entry, past(scene%n_nodes, scene%n_terms)
    integer(ip), intent(in) :: i
    real(dp), intent(in) :: layer_weight(scene%n_nodes, scene%n_terms)
    real(dp), intent(in) :: start_y(scene%n_states), start_rate(scene%n_states), t, y(scene%n_states), common_f
    real(dp), intent(out) :: d, f, layer
    real(dp) :: h, z, before, slope, faded, q, from
    integer(ip) :: k, u, m
    u = shift_at(scene)
    h = t - scene%step_start
    z = 1
    if (h > 0) z = max(0.0_dp, min(1.0_dp, (entry - scene%step_start)/h))
    from = start_y(u) + cubic(z, y(u) - start_y(u), h*start_y(shear_velocity_at(scene)), h*y(shear_velocity_at(scene)))
    q = scene%g_inf*(y(u) - from) + scene%eta*y(shear_velocity_at(scene))
    f = common_f - scene%g_inf*x**2
    layer = 0
    do k = 1, scene%n_terms
      m = shear_memory_at(scene, k)
      faded = exp(-max(t - entry, 0.0_dp)/tau(k))
      before = z*(y(m) - start_y(m))
      if (tau(k) > h) then
        slope = g(k)*y(shear_velocity_at(scene)) - y(m)/tau(k)
        before = cubic(z, y(m) - start_y(m), h*start_rate(m), h*slope)
      end if
      q = q + (y(m) - faded*(start_y(m) + before))
      f = f - faded*past(i, k)
      layer = layer + layer_weight(i, k)*faded*(past(i, k) - (start_y(m) + before))
    end do
    d = f - q
  end subroutine new_margin

  !> Hermite's cubic on [0, 1] from 0 to `rise`.
  pure function cubic(z, rise, slope_before, slope_after) result(value)
    real(dp), intent(in) :: z, rise, slope_before, slope_after
    real(dp) :: value
    value = z*(slope_before + z*(3*rise - 2*slope_before - slope_after + z*(slope_before + slope_after - 2*rise)))
  end function cubic

  !> How many of the ascending x lie inside the edge.
  pure function count_inside(n, x, square, guess) result(inside)
    integer(ip), intent(in) :: n, guess
    real(dp), intent(in) :: x(n), square
    integer(ip) :: inside
    inside = max(0_ip, min(guess, n))
    do while (inside > 0)
      if (x(inside)**2 < square) exit
      inside = inside - 1
    end do
    do while (inside < n)
      if (x(inside + 1)**2 >= square) exit
      inside = inside + 1
    end do
  end function count_inside

  !> f - q of an element.
  pure function shortfall(mode, motion, d, f) result(m)
    integer(ip), intent(in) :: mode, motion
    real(dp), intent(in) :: d, f
    real(dp) :: m
    if (mode == mode_no_slip) then
      m = d
    else if (motion == sticks) then
      m = max(0.0_dp, min(d, 2*f))
    else
      m = real(1 - motion, dp)*f
    end if
  end function shortfall

  !> Mean of f - q between two elements. Where the inner one sticks and the outer one slips the
  !> front between them is where the force without slip, linear in X, meets the limit; it moves on
  !> while the outer one slips, whose margin is still that of the force that it would have had.
  pure function mean_shortfall(mode, motion, motion_out, d, d_out, f, f_out, m) result(mean)
    integer(ip), intent(in) :: mode, motion, motion_out
    real(dp), intent(in) :: d, d_out, f, f_out, m  !! m: shortfall of the inner one
    real(dp) :: mean, left, left_out, part, limit
    left = 2*f - d
    left_out = 2*f_out - d_out
    if (mode == mode_no_slip .or. motion /= sticks) then
      mean = 0.5_dp*(m + shortfall(mode, motion_out, d_out, f_out))
    else if (motion_out /= slips_backward .and. d > 0 .and. d_out < 0 .and. left > 0) then
      mean = 0.5_dp*d*d/(d - d_out)
    else if (motion_out /= slips_forward .and. d > 0 .and. left > 0 .and. left_out < 0) then
      part = left/(left - left_out)
      limit = d + part*(d_out - d)
      mean = 0.5_dp*((d + limit)*part + (limit + 2*f_out)*(1 - part))
    else
      mean = 0.5_dp*(m + shortfall(mode, motion_out, d_out, f_out))
    end if
  end function mean_shortfall

  !> int (f - q) dX from the last element, n, to the edge.
  pure function edge_cell(scene, contact, x, motion, n, d, f, y) result(missing)
    type(scene_type), intent(in) :: scene
    type(contact_type), intent(in) :: contact
    integer(ip), intent(in) :: n, motion(scene%n_nodes)
    real(dp), intent(in) :: x(scene%n_nodes), d(scene%n_nodes), f(scene%n_nodes), y(scene%n_states)
    real(dp) :: missing, width, m, edge
    width = contact%radius - x(n)
    m = shortfall(scene%mode, motion(n), d(n), f(n))
    if (scene%restitution == 0) then
      edge = scene%eta*(y(state_velocity) - y(shear_velocity_at(scene)))  ! of a dashpot, cut to f
      if (scene%mode /= mode_no_slip) edge = max(0.0_dp, min(edge, 2*scene%eta*y(state_velocity)))
      missing = 0.5_dp*width*(m + edge)
    else
      edge = d(n)  ! f = 0, so this is minus the q of an element that does not slip there
      if (n < scene%n_entered) edge = edge + width/(x(n + 1) - x(n))*(d(n + 1) - d(n))
      missing = 0.5_dp*width*(m + merge(edge, 0.0_dp, scene%mode == mode_no_slip))
      if (scene%mode /= mode_no_slip .and. motion(n) == sticks) missing = width*thin_slip(d(n), f(n), edge)
    end if
  end function edge_cell

  !> Mean of f - q over a cell on whose inner side an element sticks and at whose outer side f = 0,
  !> f and the force without slip being linear. The slip annulus may be thinner than a cell. d, f:
  !> inside; edge: minus the force without slip outside.
  pure function thin_slip(d, f, edge) result(mean)
    real(dp), intent(in) :: d, f, edge
    real(dp) :: mean, part, inner
    inner = max(0.0_dp, min(d, 2*f))
    if (edge < 0) then  ! slips forward behind this part of the cell: there f = q
      mean = 0.5_dp*inner*inner/(inner - edge)
    else                ! slips backward, f - q = 2 f
      part = 1
      if (edge > 0) part = (2*f - inner)/(2*f - inner + edge)
      mean = 0.5_dp*inner*part + f*(1 - part)
    end if
  end function thin_slip

  !> Error of the rule in the cell between the last element and the edge, over its width. At the
  !> edge b is the whole memory of the sphere.
  pure function edge_layer(scene, tau, entry, t, y) result(layer)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), entry, t, y(scene%n_states)
    real(dp) :: layer
    integer(ip) :: k
    layer = 0
    if (scene%restitution /= 0 .or. abs(y(shear_velocity_at(scene))) > y(state_velocity)) return
    do k = 1, scene%n_terms
      layer = layer + missed(max(t - entry, 0.0_dp)/tau(k))*(y(memory_at(k)) - y(shear_memory_at(scene, k)))
    end do
  end function edge_layer

  !> int_0^A f dX by the same rule as int (f - q) dX. If nearly all elements stick and q is much
  !> smaller than f, the exact force minus that integral would be mostly the error of the rule.
  subroutine force_by_rule(scene, tau, contact, x, entry, past, c, layer_weight, n, f, t, y, force) &
    bind(c, name="rst_cvode_force_by_rule")
    type(scene_type), intent(in) :: scene
    type(contact_type), intent(in) :: contact
    real(dp), intent(in) :: tau(scene%n_terms), x(scene%n_nodes), entry(scene%n_nodes)
    real(dp), intent(in) :: past(scene%n_nodes, scene%n_terms), c(scene%n_nodes, scene%n_terms)
    real(dp), intent(in) :: layer_weight(scene%n_nodes, scene%n_terms)
    integer(ip), intent(in), value :: n
    real(dp), intent(in) :: f(scene%n_nodes), y(scene%n_states)
    real(dp), intent(in), value :: t
    real(dp), intent(out) :: force
    real(dp) :: width, faded
    integer(ip) :: i, k
    force = 0
    if (n == 0) return
    do i = 2, n
      force = force + 0.5_dp*(x(i) - x(i - 1))*(f(i - 1) + f(i))
    end do
    width = contact%radius - x(n)
    force = force + 0.5_dp*width*f(n)
    if (scene%restitution == 0) force = force + 0.5_dp*width*scene%eta*y(state_velocity)
    do k = 1, scene%n_terms
      faded = exp(-(t - scene%reference)/tau(k))
      do i = 2, min(n, scene%n_entered)
        force = force + (x(i) - x(i - 1))*layer_weight(i, k)*faded*c(i, k)
      end do
      do i = max(2_ip, scene%n_entered + 1), n
        force = force + (x(i) - x(i - 1))*layer_weight(i, k)*exp(-max(t - entry(i), 0.0_dp)/tau(k))*past(i, k)
      end do
      if (scene%restitution == 0) force = force + width*missed(max(t - entry(n), 0.0_dp)/tau(k))*y(memory_at(k))
    end do
  end subroutine force_by_rule

  !> The tangential rates from the margins.
  subroutine shear_rates(scene, g, tau, contact, x, entry, motion, n_contact, d, f, layer, t, y, rate, sums) &
    bind(c, name="rst_cvode_shear_rates")
    type(scene_type), intent(in) :: scene
    type(contact_type), intent(in) :: contact
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), x(scene%n_nodes), entry(scene%n_nodes)
    integer(ip), intent(in) :: motion(scene%n_nodes)
    integer(ip), intent(in), value :: n_contact
    real(dp), intent(in) :: d(scene%n_nodes), f(scene%n_nodes), layer(scene%n_nodes)
    real(dp), intent(in), value :: t
    real(dp), intent(in) :: y(scene%n_states)
    real(dp), intent(inout) :: rate(scene%n_states)
    type(shear_sums_type), intent(out) :: sums
    real(dp) :: velocity, missing
    integer(ip) :: k, m
    velocity = y(shear_velocity_at(scene))
    sums%n_contact = n_contact
    call integrate(scene, tau, contact, x, entry, motion, n_contact, d, f, layer, t, y, missing, sums%stick, sums%backward)
    sums%force = contact%force - missing
    rate(shift_at(scene)) = velocity
    rate(shear_velocity_at(scene)) = -shear_factor*scene%chi*sums%force
    do k = 1, scene%n_terms
      m = shear_memory_at(scene, k)
      rate(m) = g(k)*velocity - y(m)/tau(k)
    end do
  end subroutine shear_rates

  !> int_0^A (f - q) dX and the lengths that stick and slip backward.
  pure subroutine integrate(scene, tau, contact, x, entry, motion, n, d, f, layer, t, y, missing, stick, backward)
    type(scene_type), intent(in) :: scene
    type(contact_type), intent(in) :: contact
    real(dp), intent(in) :: tau(scene%n_terms), x(scene%n_nodes), entry(scene%n_nodes), d(scene%n_nodes), f(scene%n_nodes)
    real(dp), intent(in) :: layer(scene%n_nodes), t, y(scene%n_states)
    integer(ip), intent(in) :: motion(scene%n_nodes), n
    real(dp), intent(out) :: missing, stick, backward
    real(dp) :: m, weight, before
    integer(ip) :: i
    logical :: held  !! the element before sticks
    missing = 0
    stick = 0
    backward = 0
    before = 0
    held = .false.
    do i = 1, n
      if (i < n) then
        weight = 0.5_dp*(x(i + 1) - before)
      else
        weight = 0.5_dp*(contact%radius - before)
      end if
      m = shortfall(scene%mode, motion(i), d(i), f(i))
      if (i < n) missing = missing + (x(i + 1) - x(i))*mean_shortfall(scene%mode, motion(i), motion(i + 1), d(i), d(i + 1), &
                                                                     f(i), f(i + 1), m)
      if (m >= 2*f(i) .and. scene%mode /= mode_no_slip) then
        backward = backward + weight
        held = .false.
      else if (m > 0 .or. scene%mode == mode_no_slip) then
        stick = stick + weight
        if (held) missing = missing + (x(i) - before)*layer(i)
        held = .true.
      else
        held = .false.
      end if
      before = x(i)
    end do
    if (n == 0) return
    missing = missing + edge_cell(scene, contact, x, motion, n, d, f, y)
    if (held) missing = missing + (contact%radius - x(n))*edge_layer(scene, tau, entry(n), t, y)
  end subroutine integrate

  !> Root functions of the elements, which fall through 0 when their motion changes: f - |q| of a
  !> sticking element, the slip velocity of a slipping one. `least` prevents events of functions
  !> that are 0 by construction.
  subroutine slip_rates(scene, motion, n_contact, rate_of, u_of, amplitude, least_stress, least_velocity, d, f, t, y, value) &
    bind(c, name="rst_cvode_slip_rates")
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: motion(scene%n_nodes)
    integer(ip), intent(in), value :: n_contact
    real(dp), intent(in) :: rate_of(scene%n_modes), u_of(scene%n_modes), amplitude(scene%n_nodes, scene%n_modes)
    real(dp), intent(in), value :: least_stress, least_velocity, t
    real(dp), intent(in) :: d(scene%n_nodes), f(scene%n_nodes), y(scene%n_states)
    real(dp), intent(out) :: value(scene%n_nodes)
    real(dp) :: velocity, recovering, weight
    integer(ip) :: i, j
    do i = 1, scene%n_nodes
      value(i) = 1
    end do
    if (scene%mode == mode_no_slip) return
    velocity = y(shear_velocity_at(scene))
    do i = 1, min(n_contact, scene%n_entered)
      if (motion(i) == sticks) then
        value(i) = min(d(i), 2*f(i) - d(i)) + least_stress
      else
        recovering = 0
        do j = 1, scene%n_modes
          weight = exp(-rate_of(j)*(t - scene%reference))
          recovering = recovering - rate_of(j)*u_of(j)*weight*amplitude(i, j)
        end do
        value(i) = real(motion(i), dp)*(velocity - recovering) - y(state_velocity) + least_velocity
      end if
    end do
  end subroutine slip_rates

  !> Fading memory from the reference time to `time`.
  subroutine fade(scene, tau, rate_of, time, c, b, amplitude) bind(c, name="rst_cvode_fade")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms), rate_of(scene%n_modes)
    real(dp), intent(in), value :: time
    real(dp), intent(inout) :: c(scene%n_nodes, scene%n_terms), b(scene%n_nodes, scene%n_terms)
    real(dp), intent(inout) :: amplitude(scene%n_nodes, scene%n_modes)
    real(dp) :: faded
    integer(ip) :: i, j, k
    do k = 1, scene%n_terms
      faded = exp(-(time - scene%reference)/tau(k))
      do i = 1, scene%n_entered
        c(i, k) = faded*c(i, k)
        b(i, k) = faded*b(i, k)
      end do
    end do
    do j = 1, scene%n_modes
      faded = exp(-rate_of(j)*(time - scene%reference))
      do i = 1, scene%n_entered
        amplitude(i, j) = faded*amplitude(i, j)
      end do
    end do
  end subroutine fade

  !> Element i entered at `entry`, when the states were y: its memory at the reference time. It
  !> slips at once if the sphere moves faster along the surface than into it.
  subroutine enter_element(scene, tau, i, entry, past, y, motion, shift, c, b, amplitude) bind(c, name="rst_cvode_enter_element")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms)
    integer(ip), intent(in), value :: i
    real(dp), intent(in), value :: entry
    real(dp), intent(in) :: past(scene%n_nodes, scene%n_terms), y(scene%n_states)
    integer(ip), intent(inout) :: motion(scene%n_nodes)
    real(dp), intent(inout) :: shift(scene%n_nodes), c(scene%n_nodes, scene%n_terms), b(scene%n_nodes, scene%n_terms)
    real(dp), intent(inout) :: amplitude(scene%n_nodes, scene%n_modes)
    real(dp) :: faded
    integer(ip) :: j, k
    shift(i) = y(shift_at(scene))
    do k = 1, scene%n_terms
      faded = exp(-(scene%reference - entry)/tau(k))
      c(i, k) = faded*past(i, k)
      b(i, k) = c(i, k) - faded*y(shear_memory_at(scene, k))
    end do
    do j = 1, scene%n_modes
      amplitude(i, j) = 0
    end do
    motion(i) = sticks
    if (scene%mode /= mode_no_slip) then
      if (y(shear_velocity_at(scene)) > y(state_velocity)) motion(i) = slips_forward
      if (y(shear_velocity_at(scene)) < -y(state_velocity)) motion(i) = slips_backward
    end if
  end subroutine enter_element

  !> Sticking element i begins to slip at the reference time: initial values of its recovery.
  subroutine begin_slip(scene, g, x, i, d, f, from_u, from_v, shift, c, b, y, motion, amplitude) &
    bind(c, name="rst_cvode_begin_slip")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), x(scene%n_nodes)
    integer(ip), intent(in), value :: i
    real(dp), intent(in) :: d(scene%n_nodes), f(scene%n_nodes)
    real(dp), intent(in) :: from_u(scene%n_modes), from_v(scene%n_terms, scene%n_modes)
    real(dp), intent(in) :: shift(scene%n_nodes), c(scene%n_nodes, scene%n_terms), b(scene%n_nodes, scene%n_terms)
    real(dp), intent(in) :: y(scene%n_states)
    integer(ip), intent(inout) :: motion(scene%n_nodes)
    real(dp), intent(inout) :: amplitude(scene%n_nodes, scene%n_modes)
    real(dp) :: sense, u, stress
    integer(ip) :: j, k
    motion(i) = merge(slips_backward, slips_forward, d(i) > f(i))
    sense = real(motion(i), dp)
    u = y(shift_at(scene)) - shift(i) - sense*(y(state_depth) - x(i)**2)
    do j = 1, scene%n_modes
      amplitude(i, j) = from_u(j)*u
      do k = 1, scene%n_terms
        stress = y(shear_memory_at(scene, k)) - (c(i, k) - b(i, k)) - sense*(y(memory_at(k)) - c(i, k))
        amplitude(i, j) = amplitude(i, j) + from_v(k, j)*(u - stress/g(k))
      end do
    end do
  end subroutine begin_slip

  !> Slipping element i sticks from the reference time on, with its present displacement and
  !> stresses.
  subroutine begin_stick(scene, g, x, i, u_of, v_of, shift, c, b, y, motion, amplitude) bind(c, name="rst_cvode_begin_stick")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), x(scene%n_nodes)
    integer(ip), intent(in), value :: i
    real(dp), intent(in) :: u_of(scene%n_modes), v_of(scene%n_terms, scene%n_modes)
    real(dp), intent(inout) :: shift(scene%n_nodes), b(scene%n_nodes, scene%n_terms)
    real(dp), intent(in) :: c(scene%n_nodes, scene%n_terms), y(scene%n_states)
    integer(ip), intent(inout) :: motion(scene%n_nodes)
    real(dp), intent(in) :: amplitude(scene%n_nodes, scene%n_modes)
    real(dp) :: sense, u, v
    integer(ip) :: j, k
    sense = real(motion(i), dp)
    u = 0
    do j = 1, scene%n_modes
      u = u + u_of(j)*amplitude(i, j)
    end do
    shift(i) = y(shift_at(scene)) - (sense*(y(state_depth) - x(i)**2) + u)
    do k = 1, scene%n_terms
      v = 0
      do j = 1, scene%n_modes
        v = v + v_of(k, j)*amplitude(i, j)
      end do
      b(i, k) = c(i, k) - y(shear_memory_at(scene, k)) + sense*(y(memory_at(k)) - c(i, k)) + g(k)*(u - v)
    end do
    motion(i) = sticks
  end subroutine begin_stick
end module rst_cvode_elements
