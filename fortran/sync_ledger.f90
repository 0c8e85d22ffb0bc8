!> The energy ledger of the method `sync` (THEORY 4.8), with the accounts of module rst_ledger.
!>
!> It walks over the levels once more and reads the states of all nodes. Each node is in contact from one level to another, so
!> an account is a sum over nodes (trapezoidal rule in X) of integrals over its levels. In a step the velocity of an
!> element is taken as linear; what its relaxation times dissipate for that is known, for any tau. Velocities
!> bend within a step and forces have kinks: second order in 1/n.
!>
!> Nothing is taken from the balance: what is missing in it is the error of the method and of this walk.
module rst_sync_ledger
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of
  use rst_ledger, only: ledger_type
  use rst_sync_levels, only: level_type, node_type
  use rst_sync_dense, only: trace_type
  use rst_sync_elements, only: scene_type, shear_type, step_type, term_type, columns, column_weight, column_alpha, &
                               column_kappa
  use rst_sync_shear, only: start_shear, advance_shear, place_nodes, measure_step
  implicit none (type, external)
  private
  public :: keep_ledger, loss_type, slips_to_the_end, has_no_friction

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp
  integer(ip), parameter :: has_no_friction = 0, slips_to_the_end = 1  !! anything else: sticks at some time

  !> int_0^h y^2/(g tau) dt for y' = g v - y/tau, v linear. Slow terms by Gauss' rule of three points, at which
  !> y = keep y_0 + from_start v_0 + from_end v_1; fast ones, y = C exp(-t/tau) + a line, in closed form. Twin of `struct sync_loss`
  !> in C.
  type, bind(c) :: loss_type
    integer(ip) :: fast
    real(dp) :: h, g, tau
    real(dp), dimension(3) :: keep, from_start, from_end
    type(memory_type) :: once, twice  !! of h/tau and 2 h/tau
  end type loss_type

contains

  !> All accounts. kind: a parameter above; body, beta, faded, term, before, now, loss: room.
  subroutine keep_ledger(scene, kind, g, tau, level, trace, node, body, beta, faded, term, before, now, loss, ledger)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: kind
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(out) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    real(dp), intent(out) :: before(0:scene%capacity - 1, scene%n_terms + 2)
    type(term_type), intent(inout) :: now(scene%n_terms)
    type(loss_type), intent(inout) :: loss(scene%n_terms)
    type(ledger_type), intent(out) :: ledger
    type(shear_type) :: state
    real(dp) :: gross
    ledger = ledger_type(0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
    gross = 2*scene%chi
    call place_nodes(scene, node, body, beta, faded)
    call post_normal(scene, g, tau, level, trace, node, body(:, column_weight), 2*scene%n, 0.0_dp, 0.0_dp, before, &
                     ledger%viscous_z, ledger%left_z)
    if (kind == slips_to_the_end) then
      ledger%viscous_x = gross*ledger%viscous_z
      ledger%left_x = gross*ledger%left_z
      ledger%friction_x = slide(scene, level, 2*scene%n, 0.0_dp, 0.0_dp, 0.0_dp)
    else if (kind /= has_no_friction) then
      call start_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
      if (state%time > 0) then
        call post_normal(scene, g, tau, level, trace, node, body(:, column_weight), state%level, &
                         state%time - level(state%level)%time, state%velocity, before, ledger%viscous_x, ledger%left_x)
        ledger%viscous_x = gross*ledger%viscous_x
        ledger%left_x = gross*ledger%left_x
        ledger%friction_x = slide(scene, level, state%level, state%time - level(state%level)%time, state%velocity, state%force)
      end if
      call post_shear(scene, g, tau, level, trace, node, body, beta, faded, term, before, now, loss, state, ledger)
    end if
  end subroutine keep_ledger

  !> In z, from first touch to `rest` after the level `last`, where the velocity is `velocity`.
  pure subroutine post_normal(scene, g, tau, level, trace, node, weight, last, rest, velocity, fade, viscous, left)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(in) :: weight(0:scene%capacity - 1), rest, velocity
    integer(ip), intent(in) :: last
    real(dp), intent(out) :: fade(0:scene%capacity - 1, scene%n_terms)  !! of M_k at the entry of the node
    real(dp), intent(inout) :: viscous, left
    integer(ip) :: l, edge, k
    real(dp) :: h, v(0:1), energy, dissipated
    fade = 0
    do l = 0, last
      if (l == last .and. .not. rest > 0) exit
      edge = min(l, 2*scene%n - l - 1)  ! outermost node in contact in the step
      h = merge(rest, level(min(l + 1, 2*scene%n))%step, l == last)
      v = [level(l)%velocity, merge(velocity, level(min(l + 1, 2*scene%n))%velocity, l == last)]
      if (l < scene%n) fade(l, :) = trace(:, l)%memory
      call normal_loss(scene, g, tau, h, v, edge, trace(:, l), weight, fade, dissipated)
      viscous = viscous + 2*mass_factor*dissipated
      if (l < scene%n .or. l == last) cycle
      energy = scene%g_inf*(level(l + 1)%depth - node(edge)%radius**2)**2/2
      do k = 1, scene%n_terms
        energy = energy + (trace(k, l + 1)%memory - fade(edge, k))**2/(2*g(k))
      end do
      left = left + 2*mass_factor*weight(edge)*energy
    end do
  end subroutine post_normal

  !> What the nodes 0 to edge dissipate in one step; `fade` is brought to its end.
  pure subroutine normal_loss(scene, g, tau, h, v, edge, trace, weight, fade, total)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), h, v(0:1)
    type(trace_type), intent(in) :: trace(scene%n_terms)
    integer(ip), intent(in) :: edge
    real(dp), intent(in) :: weight(0:scene%capacity - 1)
    real(dp), intent(inout) :: fade(0:scene%capacity - 1, scene%n_terms)
    real(dp), intent(out) :: total
    type(loss_type) :: loss
    integer(ip) :: i, k
    total = scene%eta*squared(h, v(0), v(1))*sum(weight(0:edge))
    do k = 1, scene%n_terms
      loss = loss_of(h, g(k), tau(k))
      do i = 0, edge
        total = total + weight(i)*lost(loss, trace(k)%memory - fade(i, k), v(0), v(1))
        fade(i, k) = fade(i, k)*loss%once%decay
      end do
    end do
  end subroutine normal_loss

  !> Friction work while all slips, int f (U' - D'), from first touch to `rest` after the level `last`.
  pure function slide(scene, level, last, rest, velocity, force) result(work)
    type(scene_type), intent(in) :: scene
    type(level_type), intent(in) :: level(0:2*scene%n)
    integer(ip), intent(in) :: last
    real(dp), intent(in) :: rest, velocity, force
    real(dp) :: work, h, power(0:2), h_before
    integer(ip) :: l
    work = 0
    power = 0
    h_before = 0
    do l = 0, last
      if (l == last .and. .not. rest > 0) exit
      if (l < last) then
        h = level(l + 1)%step
        power(2) = level(l + 1)%force*slip_velocity(level(l + 1)%velocity)
      else
        h = rest
        power(2) = force*slip_velocity(velocity)
      end if
      work = work + h/2*(power(1) + power(2))
      if (l > 0) then ! the parabola through three levels
        work = work - h**3/6*((power(2) - power(1))/h - (power(1) - power(0))/h_before)/(h + h_before)
      end if
      power(0:1) = power(1:2)
      h_before = h
    end do
    work = 4*mass_factor*scene%chi*work
  contains
    pure function slip_velocity(v) result(slip)
      real(dp), intent(in) :: v
      real(dp) :: slip
      slip = scene%psi - 2*scene%chi + (2*scene%chi - 1)*v
    end function slip_velocity
  end function slide

  !> In x, from the instant at which the contact sticks for the first time.
  subroutine post_shear(scene, g, tau, level, trace, node, body, beta, faded, term, before, now, loss, state, ledger)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(dp), intent(inout) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    real(dp), intent(out) :: before(0:scene%capacity - 1, scene%n_terms + 2)
    type(term_type), intent(inout) :: now(scene%n_terms)
    type(loss_type), intent(inout) :: loss(scene%n_terms)
    type(shear_type), intent(inout) :: state
    type(ledger_type), intent(inout) :: ledger
    type(step_type) :: step
    real(dp) :: velocity, shift
    integer(ip) :: k, edge
    do while (state%level < 2*scene%n)
      edge = min(state%level, 2*scene%n - state%level - 1)  ! outermost node in contact in the step
      now = term
      velocity = state%velocity
      shift = state%shift
      call measure_step(scene, g, tau, level(state%level + 1)%time - state%time, .false., trace(:, state%level + 1), now, step)
      do k = 1, scene%n_terms
        loss(k) = loss_of(step%h, g(k), tau(k))
      end do
      call remember_nodes(scene, tau, level, edge, body, beta, state, before)
      call advance_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
      call post_nodes(scene, g, edge, step, loss, now, term, velocity, shift, body, before, state, ledger)
    end do
  end subroutine post_shear

  !> beta, alpha and kappa of the nodes 0 to edge, as they are before a step. Passive nodes keep beta as it was at their entry.
  pure subroutine remember_nodes(scene, tau, level, edge, body, beta, state, before)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: tau(scene%n_terms)
    type(level_type), intent(in) :: level(0:2*scene%n)
    integer(ip), intent(in) :: edge
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns), beta(0:scene%capacity - 1, scene%n_terms)
    type(shear_type), intent(in) :: state
    real(dp), intent(inout) :: before(0:scene%capacity - 1, scene%n_terms + 2)
    integer(ip) :: i, k
    do k = 1, scene%n_terms
      do i = 0, edge
        before(i, k) = beta(i, k)
        if (i < state%first) before(i, k) = exp(-(state%time - level(i)%time)/tau(k))*beta(i, k)
      end do
    end do
    before(0:edge, scene%n_terms + 1) = body(0:edge, column_alpha)
    before(0:edge, scene%n_terms + 2) = body(0:edge, column_kappa)
  end subroutine remember_nodes

  !> Post what the nodes 0 to edge did in a step. The slip velocity went from `kept` to `slip` (module rst_sync_shear), which
  !> also says what alpha and beta have become. In the restitution the outermost node leaves at the end of the step:
  !> friction lets go of all force that it still had. (The loop over elements may or may not have moved it.)
  pure subroutine post_nodes(scene, g, edge, step, loss, now, term, velocity, shift, body, before, state, ledger)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), velocity, shift
    integer(ip), intent(in) :: edge
    type(step_type), intent(in) :: step
    type(loss_type), intent(in) :: loss(scene%n_terms)
    type(term_type), intent(in) :: now(scene%n_terms), term(scene%n_terms)  !! before and after the step
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns), before(0:scene%capacity - 1, scene%n_terms + 2)
    type(shear_type), intent(in) :: state
    type(ledger_type), intent(inout) :: ledger
    real(dp) :: scale, kept, slip, kappa, alpha, beta, v(0:1), q(0:1), viscous, friction, left
    logical :: leaves
    integer(ip) :: i, k
    viscous = 0
    friction = 0
    left = 0
    do i = 0, edge
      leaves = i == edge .and. state%level > scene%n
      alpha = before(i, scene%n_terms + 1)
      kappa = before(i, scene%n_terms + 2)
      slip = body(i, column_kappa)
      if (leaves) slip = last_slip()
      kept = (1 - step%drop)*kappa + step%drop*slip
      v = [velocity - kept, state%velocity - slip]
      q(0) = scene%g_inf*elongated(shift, alpha) + scene%eta*(velocity - kappa)
      alpha = alpha + step%spring*(kept + slip)
      if (leaves) left = elongated(state%shift, alpha)**2/2*scene%g_inf
      q(1) = scene%g_inf*elongated(state%shift, alpha) + scene%eta*v(1)
      viscous = viscous + body(i, column_weight)*scene%eta*squared(step%h, v(0), v(1))
      do k = 1, scene%n_terms
        beta = now(k)%decay*before(i, k) + now(k)%from_start*kept + now(k)%from_end*slip
        q(0) = q(0) + now(k)%stress - before(i, k)
        q(1) = q(1) + term(k)%stress - beta
        viscous = viscous + body(i, column_weight)*lost(loss(k), now(k)%stress - before(i, k), v(0), v(1))
        if (leaves) left = left + (term(k)%stress - beta)**2/(2*g(k))
      end do
      friction = friction + body(i, column_weight)*step%h*((kept*q(0) + slip*q(1))/3 + (kept*q(1) + slip*q(0))/6)
    end do
    scale = 4*mass_factor*scene%chi
    ledger%viscous_x = ledger%viscous_x + scale*viscous
    ledger%friction_x = ledger%friction_x + scale*friction
    ledger%left_x = ledger%left_x + scale*body(edge, column_weight)*left
  contains
    !> Elongation of the spring G_inf; 0 without it.
    pure function elongated(u, spring) result(length)
      real(dp), intent(in) :: u, spring
      real(dp) :: length
      length = 0
      if (scene%g_inf > 0) length = u - spring/scene%g_inf
    end function elongated

    !> The slip velocity that brings the force of the leaving node to zero; 0 in a step of no length.
    pure function last_slip() result(slip)
      real(dp) :: slip, response
      slip = 0
      response = step%end_response + step%drop*step%start_response
      if (scene%no_slip /= 0 .or. .not. response > 0) return
      slip = scene%g_inf*state%shift - alpha + scene%eta*state%velocity - step%start_response*(1 - step%drop)*kappa
      slip = slip + sum(term%stress) - sum(now%decay*before(i, 1:scene%n_terms))
      slip = slip/response
    end function last_slip
  end subroutine post_nodes

  !> int_0^h v^2 dt, v linear
  pure function squared(h, v0, v1) result(y)
    real(dp), intent(in) :: h, v0, v1
    real(dp) :: y
    y = h*(v0*v0 + v0*v1 + v1*v1)/3
  end function squared

  pure function loss_of(h, g, tau) result(loss)
    real(dp), intent(in) :: h, g, tau
    type(loss_type) :: loss
    real(dp), parameter :: fast_above = 0.5_dp  !! up to there Gauss' rule errs by 1e-6
    real(dp), parameter :: point(3) = [0.5_dp - sqrt(0.15_dp), 0.5_dp, 0.5_dp + sqrt(0.15_dp)]
    type(memory_type) :: m
    integer(ip) :: p
    loss%h = h
    loss%g = g
    loss%tau = tau
    loss%fast = merge(1_ip, 0_ip, h > fast_above*tau)
    loss%once = memory_of(h/tau)
    loss%twice = memory_of(2*h/tau)
    do p = 1, 3
      m = memory_of(point(p)*h/tau)
      loss%keep(p) = m%decay
      loss%from_start(p) = g*h*point(p)*((m%phi1 - m%phi2) + (1 - point(p))*m%phi2)
      loss%from_end(p) = g*h*point(p)*point(p)*m%phi2
    end do
  end function loss_of

  pure function lost(loss, y0, v0, v1) result(y)
    type(loss_type), intent(in) :: loss
    real(dp), intent(in) :: y0, v0, v1
    real(dp), parameter :: share(3) = [5.0_dp/18, 8.0_dp/18, 5.0_dp/18]
    real(dp) :: y, c, line0, line1, lag
    if (loss%fast /= 0) then
      lag = loss%tau/loss%h*(v1 - v0)
      line0 = loss%g*loss%tau*(v0 - lag)
      line1 = loss%g*loss%tau*(v1 - lag)
      c = y0 - line0
      y = c*c*loss%twice%phi1 + 2*c*(line0*loss%once%phi2 + line1*(loss%once%phi1 - loss%once%phi2)) &
          + (line0*line0 + line0*line1 + line1*line1)/3
    else
      y = sum(share*(loss%keep*y0 + loss%from_start*v0 + loss%from_end*v1)**2)
    end if
    y = y*loss%h/(loss%g*loss%tau)
  end function lost
end module rst_sync_ledger
