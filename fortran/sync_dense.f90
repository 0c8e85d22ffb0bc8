!> The normal problem at as many levels as the tangential one wants, from its solution at fewer (module rst_sync_levels).
!>
!> A panel of that solution has an acceleration that is a parabola in time, so depth and velocity are known between its
!> levels to the same fourth order. What remains at a new level is the time at which the edge is on its node, fading memory, and
!> the normal force, which all follow without iterations over the motion.
module rst_sync_dense
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of, parabola_type, spacing_type, spacing_of, parabola_through, remembered, integrated, &
                        integrated_twice
  use rst_sync_levels, only: grid_type, level_type, node_type, spread_nodes, first_return, panel_type, panel_of, by_parts, &
                             loaded_by_parts, longest_panel, first_levels, mass_factor
  implicit none (type, external)
  private
  public :: trace_type, dense_levels, thin_levels, fade_in_step

  integer(ip), parameter :: most_steps = 40
  !> Part of a step that Newton's last step may be: what it changes is then taken as linear.
  real(dp), parameter :: sharpness = 1.0e-3_dp
  real(dp), parameter :: rounding = 16*epsilon(1.0_dp)  !! of differences of velocities and depths of order 1

  !> A relaxation time at a level: g M, g P (in the restitution: what is left of that of the node at the edge), what is left of
  !> what that node had at its entry; and of the step that ends at the level: exp(-h/tau) and what a velocity
  !> v_0 (1-x/h) + v_1 x/h + b x (x-h) adds to g M, by v_0, v_1, b. Twin of `struct sync_trace` in C.
  type, bind(c) :: trace_type
    real(dp) :: memory, loading, fade, decay, from_start, from_end, from_bend
  end type trace_type

  !> The sphere between three levels, by the time since the first of them, which keeps its digits. `rest`: acceleration without
  !> that by the dashpot of a growing contact; the latter is -(2/3) drag (A^3)', `cubes` its integral.
  type :: path_type
    real(dp) :: time, depth, velocity, drag, cubed
    type(parabola_type) :: rest, cubes
  end type path_type

  type :: motion_type
    real(dp) :: depth, velocity, acceleration, radius
  end type motion_type

contains

  !> n r levels a phase from n. `failed` tells that a time was not found: take more levels for the solution given.
  pure subroutine dense_levels(grid, g_inf, eta, n_terms, g, tau, n, r, coarse, level, trace, node, failed)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n, r  !! n even
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms)
    type(level_type), intent(in) :: coarse(0:2*n)
    type(level_type), intent(out) :: level(0:2*n*r)
    type(trace_type), intent(out) :: trace(n_terms, 0:2*n*r)
    type(node_type), intent(out) :: node(0:n*r)
    logical, intent(out) :: failed
    real(dp) :: offset
    integer(ip) :: p, k
    offset = 0
    call spread_nodes(grid, n*r, node)
    level(0) = coarse(0)
    do k = 1, n_terms
      trace(k, 0) = trace_type(0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
    end do
    do p = 0, n - 2, 2
      call dense_compression(grid, g_inf, eta, n_terms, g, tau, n*r, r, p*r, coarse(p:p + 2), level, trace, node, offset, failed)
      if (failed) return
    end do
    do p = n, 2*n - 2, 2
      call dense_restitution(g_inf, eta, n_terms, g, tau, n*r, r, p*r, coarse(p:p + 2), level, trace, node, offset, failed)
      if (failed) return
    end do
  end subroutine dense_levels

  !> Half as many levels, every other one.
  pure subroutine thin_levels(n_terms, g, tau, n, level, trace, node, thin_level, thin_trace, thin_node)
    integer(ip), intent(in) :: n_terms, n  !! n: levels a phase that are left
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    type(level_type), intent(in) :: level(0:4*n)
    type(trace_type), intent(in) :: trace(n_terms, 0:4*n)
    type(node_type), intent(in) :: node(0:2*n)
    type(level_type), intent(out) :: thin_level(0:2*n)
    type(trace_type), intent(out) :: thin_trace(n_terms, 0:2*n)
    type(node_type), intent(out) :: thin_node(0:n)
    integer(ip) :: l, k
    do l = 0, n
      thin_node(l) = node_type(node(2*l)%radius, 2*node(2*l)%width)
    end do
    thin_level(0) = level(0)
    thin_trace(:, 0) = trace(:, 0)
    do l = 1, 2*n
      thin_level(l) = level(2*l)
      thin_level(l)%step = level(2*l - 1)%step + level(2*l)%step
      do k = 1, n_terms
        thin_trace(k, l) = trace(k, 2*l)
        call fade_in_step(g(k), tau(k), thin_level(l)%step, thin_trace(k, l))
      end do
    end do
  end subroutine thin_levels

  !> The levels from `start` on to the end of a panel of the compression, in pairs.
  pure subroutine dense_compression(grid, g_inf, eta, n_terms, g, tau, n, r, start, coarse, level, trace, node, offset, &
                                    failed)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n, r, start
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms)
    type(level_type), intent(in) :: coarse(0:2)
    type(level_type), intent(inout) :: level(0:2*n)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    type(node_type), intent(inout) :: node(0:n)
    real(dp), intent(inout) :: offset  !! time of the level `start` since that of the panel: by how much it is off
    logical, intent(out) :: failed
    type(path_type) :: path
    type(motion_type) :: motion(0:2)
    real(dp) :: x(2), t, t_before, h, start_of_pair, resolved
    integer(ip) :: l, q
    path = path_of(coarse, mass_factor*eta)
    motion(2) = motion_type(coarse(0)%depth, coarse(0)%velocity, 0.0_dp, sqrt(coarse(0)%depth))
    t = offset
    t_before = t
    do l = start, start + 2*r - 2, 2
      motion(0) = motion(2)
      start_of_pair = t
      do q = 1, 2
        h = merge(t - t_before, 0.0_dp, l + q > 1)
        t_before = t
        t = max(t + 0.1_dp*h, between(coarse, l + q - start, r))
        call meet_edge(grid, path, node(l + q)%radius, t_before, t, motion(q), failed)
        if (failed) return
        x(q) = t - start_of_pair
        level(l + q) = level_type(path%time + t, t - t_before, motion(q)%depth, motion(q)%velocity, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
        node(l + q) = node_type(motion(q)%radius, node(l + q)%width*edge_advance(grid, node(l + q)%radius, motion(q)))
      end do
      resolved = merge(0.0_dp, longest_panel*grid%radius**2/real(n, dp), l < first_levels)
      call load_pair(g_inf, eta, n_terms, g, tau, resolved, x, motion, level(l + 1:l + 2), trace(:, l:l + 2))
    end do
    offset = t - (coarse(1)%step + coarse(2)%step)
  end subroutine dense_compression

  !> M_k, P_k, forces of two levels of the compression.
  pure subroutine load_pair(g_inf, eta, n_terms, g, tau, resolved, x, motion, level, trace)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), resolved, x(2)
    type(motion_type), intent(in) :: motion(0:2)
    type(level_type), intent(inout) :: level(2)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2)
    type(panel_type) :: panel
    type(memory_type) :: m
    real(dp) :: a3(0:2), drive
    integer(ip) :: k, q
    a3 = motion%depth*motion%radius
    do q = 1, 2
      level(q)%force = (2.0_dp/3.0_dp)*g_inf*a3(q) + eta*motion(q)%radius*motion(q)%velocity
      level(q)%fresh = g_inf*motion(q)%depth + eta*motion(q)%velocity
    end do
    if (n_terms == 0) return
    panel = panel_of(x, motion%velocity, motion%radius, a3)
    do k = 1, n_terms
      do q = 1, 2
        m = memory_of(x(q)/tau(k))
        if (by_parts(x, tau(k), resolved)) then
          drive = loaded_by_parts(panel, m, tau(k), x(q), a3(0), a3(q))
        else
          drive = remembered(m, x(q), panel%sweeps)
        end if
        trace(k, q)%fade = 1
        trace(k, q)%loading = m%decay*trace(k, 0)%loading + g(k)*drive
        trace(k, q)%memory = m%decay*trace(k, 0)%memory + g(k)*remembered(m, x(q), panel%speeds)
        level(q)%force = level(q)%force + trace(k, q)%loading
        level(q)%fresh = level(q)%fresh + trace(k, q)%memory
        if (q == 1) call note_step(g(k), x(1), m, trace(k, 1))
      end do
      call fade_in_step(g(k), tau(k), x(2) - x(1), trace(k, 2))
    end do
  end subroutine load_pair

  !> The levels from `start` on to the end of a panel of the restitution. The force follows from that at the same radius.
  pure subroutine dense_restitution(g_inf, eta, n_terms, g, tau, n, r, start, coarse, level, trace, node, offset, failed)
    integer(ip), intent(in) :: n_terms, n, r, start
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms)
    type(level_type), intent(in) :: coarse(0:2)
    type(level_type), intent(inout) :: level(0:2*n)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    type(node_type), intent(in) :: node(0:n)
    real(dp), intent(inout) :: offset  !! time of the level `start` since that of the panel: by how much it is off
    logical, intent(out) :: failed
    type(path_type) :: path
    real(dp) :: h, t
    integer(ip) :: l, j
    path = path_of(coarse, 0.0_dp)
    t = offset
    do l = start + 1, start + 2*r
      j = 2*n - l
      if (r == 1) then
        h = coarse(l - start)%step + merge(coarse(1)%step, 0.0_dp, l - start == 2) - t
      else if (l == n + 1) then
        h = first_return(g_inf, eta, n_terms, g, tau, level(n)%step)
      else if (l == n + 2) then
        h = max(0.1_dp*level(l - 1)%step, between(coarse, l - start, r) - t)
      else
        h = 2*level(l - 1)%step - level(l - 2)%step
        if (l > n + 4) h = h + level(l - 1)%step - 2*level(l - 2)%step + level(l - 3)%step
        h = max(0.5_dp*level(l - 1)%step, h)
      end if
      call meet_free_edge(g_inf, eta, n_terms, g, tau, path, t, node(j)%radius, trace(:, j:j + 1), level(l - 1), trace(:, l - 1), &
                          h, level(l), trace(:, l), failed)
      if (failed .and. l > n + 4) then ! the parabola of the steps leads astray
        h = level(l - 1)%step
        call meet_free_edge(g_inf, eta, n_terms, g, tau, path, t, node(j)%radius, trace(:, j:j + 1), level(l - 1), &
                            trace(:, l - 1), h, level(l), trace(:, l), failed)
      end if
      if (failed) return
      t = t + h
    end do
    offset = t - (coarse(1)%step + coarse(2)%step)
  end subroutine dense_restitution

  !> The next level of the restitution: when the edge, at X_j, is free. h: a guess of the step. loaded: of the nodes j, j+1.
  pure subroutine meet_free_edge(g_inf, eta, n_terms, g, tau, path, t, radius, loaded, before, trace_before, h, level, trace, &
                                 failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), t, radius  !! t: of the level before, on the path
    type(path_type), intent(in) :: path
    type(trace_type), intent(in) :: loaded(n_terms, 0:1), trace_before(n_terms)
    type(level_type), intent(in) :: before
    real(dp), intent(inout) :: h
    type(level_type), intent(out) :: level
    type(trace_type), intent(out) :: trace(n_terms)
    logical, intent(out) :: failed
    type(motion_type) :: motion
    real(dp) :: excess, slope, noise, bend, kept, dx
    integer(ip) :: i, k
    failed = .true.
    do i = 1, most_steps
      motion = on_path(path, t + h)
      bend = (motion%acceleration + mass_factor*before%force)/(2*h)
      excess = g_inf*(motion%depth - radius**2) + eta*motion%velocity
      slope = g_inf*motion%velocity + eta*motion%acceleration
      noise = rounding*(g_inf*motion%depth + eta)
      do k = 1, n_terms
        call fade_in_step(g(k), tau(k), h, trace(k))
        trace(k)%fade = trace_before(k)%fade*loaded(k, 1)%decay*trace(k)%decay
        trace(k)%memory = trace(k)%decay*trace_before(k)%memory + trace(k)%from_start*before%velocity &
                          + trace(k)%from_end*motion%velocity + trace(k)%from_bend*bend
        kept = trace(k)%fade*loaded(k, 0)%memory
        excess = excess + (trace(k)%memory - kept)
        slope = slope + g(k)*motion%velocity - (trace(k)%memory - kept)/tau(k)
        noise = noise + rounding*(g(k)*motion%depth + abs(kept))
      end do
      dx = h
      if (slope < 0) dx = max(-0.5_dp*h, min(h, -excess/slope))
      if (abs(excess) <= noise) dx = 0
      failed = .not. abs(dx) <= sharpness*h
      if (.not. failed) exit
      h = h + dx
    end do
    level = level_type(path%time + t + (h + dx), h + dx, motion%depth + dx*motion%velocity, &
                       motion%velocity + dx*motion%acceleration, (2.0_dp/3.0_dp)*g_inf*radius**3, g_inf*radius**2, 0.0_dp, 0.0_dp)
    do k = 1, n_terms
      call shift_step(g(k), tau(k), h, dx, motion%velocity, trace(k))
      trace(k)%loading = trace(k)%fade*loaded(k, 0)%loading
      level%force = level%force + trace(k)%loading
      level%fresh = level%fresh + trace(k)%fade*loaded(k, 0)%memory
    end do
    h = h + dx
  end subroutine meet_free_edge

  !> The step h is longer by a small dx: what follows from (h phi_2)' = phi_1 - phi_2 and (h phi_1)' = exp(-h/tau).
  pure subroutine shift_step(g, tau, h, dx, velocity, trace)
    real(dp), intent(in) :: g, tau, h, dx, velocity
    type(trace_type), intent(inout) :: trace
    real(dp) :: y
    y = dx/h
    trace%memory = trace%memory + dx*(g*velocity - trace%memory/tau)
    trace%from_end = trace%from_end + y*trace%from_start
    trace%from_start = trace%from_start*(1 - y) + dx*g*trace%decay
    trace%from_bend = trace%from_bend*(1 + 3*y)
    trace%decay = trace%decay*(1 - dx/tau)
    trace%fade = trace%fade*(1 - dx/tau)
  end subroutine shift_step

  pure function path_of(coarse, drag) result(path)
    type(level_type), intent(in) :: coarse(0:2)
    real(dp), intent(in) :: drag
    type(path_type) :: path
    type(spacing_type) :: spacing
    real(dp) :: a(0:2)
    spacing = spacing_of([coarse(1)%step, coarse(1)%step + coarse(2)%step])
    a = 0
    if (drag > 0) a = sqrt(coarse%depth)
    path = path_type(coarse(0)%time, coarse(0)%depth, coarse(0)%velocity, drag, coarse(0)%depth*a(0), &
                     parabola_through(spacing, drag*a*coarse%velocity - mass_factor*coarse%force), &
                     parabola_through(spacing, (2.0_dp/3.0_dp)*drag*(coarse%depth*a - coarse(0)%depth*a(0))))
  end function path_of

  pure function on_path(path, x) result(motion)
    type(path_type), intent(in) :: path
    real(dp), intent(in) :: x
    type(motion_type) :: motion
    motion%acceleration = path%rest%start + x*(path%rest%slope + path%rest%bend*(x - path%rest%middle))
    motion%velocity = path%velocity + integrated(x, path%rest)
    motion%depth = path%depth + x*path%velocity + integrated_twice(x, path%rest)
    if (path%drag > 0) motion%depth = motion%depth - integrated(x, path%cubes)
    motion%radius = sqrt(max(motion%depth, tiny(1.0_dp)))
    if (path%drag > 0) then
      motion%velocity = motion%velocity - (2.0_dp/3.0_dp)*path%drag*(motion%depth*motion%radius - path%cubed)
      motion%acceleration = motion%acceleration - path%drag*motion%radius*motion%velocity
    end if
  end function on_path

  !> Newton's steps of the time to where A (1-u^2) = 2 u radius D', from a guess.
  pure subroutine meet_edge(grid, path, u, before, time, motion, failed)
    type(grid_type), intent(in) :: grid
    type(path_type), intent(in) :: path
    real(dp), intent(in) :: u, before  !! before: time of the level before, on the path
    real(dp), intent(inout) :: time
    type(motion_type), intent(out) :: motion
    logical, intent(out) :: failed
    real(dp) :: cosine, sine, miss, dx, h
    integer(ip) :: i
    cosine = (1 - u)*(1 + u)
    sine = 2*u*grid%radius
    failed = .true.
    do i = 1, most_steps
      h = time - before
      motion = on_path(path, time)
      miss = motion%radius*cosine - sine*motion%velocity
      dx = -miss/(motion%velocity/(2*motion%radius)*cosine - sine*motion%acceleration)
      dx = max(-0.5_dp*h, min(h, dx))
      if (abs(miss) <= rounding*sine) dx = 0
      failed = .not. abs(dx) <= sharpness*h
      if (.not. failed) exit
      time = time + dx
    end do
    motion%depth = max(motion%depth + dx*(motion%velocity + dx/2*motion%acceleration), tiny(1.0_dp))
    motion%acceleration = motion%acceleration + path%drag*motion%radius*motion%velocity &
                          + dx*(path%rest%slope + path%rest%bend*(2*time - path%rest%middle))
    motion%velocity = motion%velocity + dx*(motion%acceleration - path%drag*motion%radius*motion%velocity)
    motion%radius = sqrt(motion%depth)
    motion%acceleration = motion%acceleration - path%drag*motion%radius*motion%velocity
    time = time + dx
  end subroutine meet_edge

  !> dA/du along the grid, with rho^2 = (A/radius)^2 + D'^2 (see grid_type).
  pure function edge_advance(grid, u, motion) result(slope)
    type(grid_type), intent(in) :: grid
    real(dp), intent(in) :: u
    type(motion_type), intent(in) :: motion
    real(dp) :: slope, cosine, sine, rho
    cosine = (1 - u)*(1 + u)/(1 + u*u)
    sine = 2*u/(1 + u*u)
    rho = sqrt((motion%radius/grid%radius)**2 + motion%velocity**2)
    slope = rho*cosine/(2*grid%radius)/(cosine**2/(2*grid%radius**2) - sine**2*motion%acceleration)*2/(1 + u*u)
  end function edge_advance

  !> Time of the i-th of 2 r new levels since the start of a panel, by the parabola; after first touch, where it is a square, by
  !> that times a line.
  pure function between(coarse, i, r) result(time)
    type(level_type), intent(in) :: coarse(0:2)
    integer(ip), intent(in) :: i, r
    real(dp) :: time, y, x(2)
    y = real(i, dp)/real(r, dp)
    x = [coarse(1)%step, coarse(1)%step + coarse(2)%step]
    if (coarse(0)%depth > 0) then
      time = y*(x(1) + (y - 1)/2*(x(2) - 2*x(1)))
    else
      time = y*y*(x(1) + (y - 1)*(x(2)/4 - x(1)))
    end if
  end function between

  pure subroutine fade_in_step(g, tau, h, trace)
    real(dp), intent(in) :: g, tau, h
    type(trace_type), intent(inout) :: trace
    call note_step(g, h, memory_of(h/tau), trace)
  end subroutine fade_in_step

  pure subroutine note_step(g, h, m, trace)
    real(dp), intent(in) :: g, h
    type(memory_type), intent(in) :: m
    type(trace_type), intent(inout) :: trace
    trace%decay = m%decay
    trace%from_start = g*h*(m%phi1 - m%phi2)
    trace%from_end = g*h*m%phi2
    trace%from_bend = g*h*h*h*(2*m%phi3 - m%phi2)
  end subroutine note_step
end module rst_sync_dense
