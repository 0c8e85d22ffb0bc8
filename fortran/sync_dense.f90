!> The normal problem at as many levels as the tangential one wants, from its solution at fewer (module rst_sync_levels).
!>
!> A panel of that solution has an acceleration that is a parabola in time, so depth and velocity are known between its
!> levels to the same fourth order. What remains at a new level is the time at which the edge is on its node, fading memory, and
!> the normal force, which all follow without iterations over the motion.
module rst_sync_dense
  use rst_precision, only: dp, ip
  use rst_bounded, only: bounded
  use rst_memory, only: memory_type, memory_of, memory_pair_type, remember_pair, parabola_type, spacing_type, spacing_of, &
                        parabola_through, integrated, integrated_twice
  use rst_sync_grid, only: grid_type, level_type, node_type, spread_nodes, mass_factor
  use rst_sync_guess, only: first_return
  use rst_sync_sweeps, only: shortest
  use rst_sync_loading, only: by_parts, longest_panel, first_levels
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
    real(dp) :: depth, velocity, acceleration
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
    real(dp) :: offset, spread(3)
    integer(ip) :: p, k
    offset = 0
    call spread_nodes(grid, n*r, node)
    level(0) = coarse(0)
    do k = 1, n_terms
      trace(k, 0) = trace_type(0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
    end do
    do p = 0, n - 2, 2
      spread = spread_of(coarse(p:p + 3), p)
      call dense_compression(grid, g_inf, eta, n_terms, g, tau, n*r, r, p*r, coarse(p:p + 2), spread, level, trace, node, offset, &
                             failed)
      if (failed) return
    end do
    do p = n, 2*n - 2, 2
      spread = spread_of(coarse(p:min(p + 3, 2*n)), p - n)
      call dense_restitution(g_inf, eta, n_terms, g, tau, n*r, r, p*r, coarse(p:p + 2), spread, level, trace, node, offset, failed)
      if (failed) return
    end do
  end subroutine dense_levels

  !> Half as many levels, every other one.
  pure subroutine thin_levels(n_terms, n, level, trace, node, thin_level, thin_trace, thin_node)
    integer(ip), intent(in) :: n_terms, n  !! n: levels a phase that are left
    type(level_type), intent(in) :: level(0:4*n)
    type(trace_type), intent(in) :: trace(n_terms, 0:4*n)
    type(node_type), intent(in) :: node(0:2*n)
    type(level_type), intent(out) :: thin_level(0:2*n)
    type(trace_type), intent(out) :: thin_trace(n_terms, 0:2*n)
    type(node_type), intent(out) :: thin_node(0:n)
    real(dp) :: h, part
    integer(ip) :: l, k
    do l = 0, n
      thin_node(l) = node_type(node(2*l)%radius, 2*node(2*l)%width)
    end do
    thin_level(0) = level(0)
    thin_trace(:, 0) = trace(:, 0)
    do l = 1, 2*n
      thin_level(l) = level(2*l)
      thin_level(l)%step = level(2*l - 1)%step + level(2*l)%step
      h = thin_level(l)%step
      part = level(2*l)%step/h
      do k = 1, n_terms
        thin_trace(k, l) = trace(k, 2*l)
        call join_steps(part, (part - 1)*part*h*h, trace(k, 2*l - 1), trace(k, 2*l), thin_trace(k, l))
      end do
    end do
  end subroutine thin_levels

  !> Two steps in one. part: of the second; bent: x (x-h) between them.
  pure subroutine join_steps(part, bent, first, second, both)
    real(dp), intent(in) :: part, bent
    type(trace_type), intent(in) :: first, second
    type(trace_type), intent(inout) :: both
    real(dp) :: middle
    middle = second%decay*first%from_end + second%from_start  ! what a velocity of 1 between the steps adds
    both%decay = second%decay*first%decay
    both%from_start = second%decay*first%from_start + part*middle
    both%from_end = second%from_end + (1 - part)*middle
    both%from_bend = second%decay*first%from_bend + second%from_bend + bent*middle
  end subroutine join_steps

  !> The levels from `start` on to the end of a panel of the compression, in pairs.
  pure subroutine dense_compression(grid, g_inf, eta, n_terms, g, tau, n, r, start, coarse, spread, level, trace, node, &
                                    offset, failed)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n, r, start
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms)
    type(level_type), intent(in) :: coarse(0:2)
    real(dp), intent(in) :: spread(3)
    type(level_type), intent(inout) :: level(0:2*n)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    type(node_type), intent(inout) :: node(0:n)
    real(dp), intent(inout) :: offset  !! time of the level `start` since that of the panel: by how much it is off
    logical, intent(out) :: failed
    type(path_type) :: path
    real(dp) :: t(0:2), d(0:2), v(0:2), a(0:2), u(2), width(2), h, resolved, part
    integer(ip) :: l, q
    path = path_of(coarse, mass_factor*eta)
    part = 1/real(r, dp)
    t(2) = offset
    h = 0
    d(2) = coarse(0)%depth
    v(2) = coarse(0)%velocity
    a(2) = sqrt(d(2))
    do l = start, start + 2*r - 2, 2
      t(0) = t(2)
      d(0) = d(2)
      v(0) = v(2)
      a(0) = a(2)
      do q = 1, 2
        t(q) = max(t(q - 1) + 0.1_dp*h, between(start, spread, real(l + q - start, dp)*part))
      end do
      u = [node(l + 1)%radius, node(l + 2)%radius]
      width = [node(l + 1)%width, node(l + 2)%width]
      call meet_edge(grid, path, u, t, d(1:2), v(1:2), a(1:2), width, failed)
      if (failed) return
      if (l + 2 == n) t(2) = coarse(1)%step + coarse(2)%step ! Newton's step may leave more than the next step is long
      h = t(2) - t(1)
      do q = 1, 2
        level(l + q) = level_type(path%time + t(q), t(q) - t(q - 1), d(q), v(q), 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
        node(l + q) = node_type(a(q), width(q))
      end do
      resolved = merge(0.0_dp, longest_panel*grid%radius**2/real(n, dp), l < first_levels)
      call load_pair(g_inf, eta, n_terms, g, tau, resolved, t(1:2) - t(0), d, v, a, level(l + 1:l + 2), trace(:, l:l + 2))
    end do
    offset = t(2) - (coarse(1)%step + coarse(2)%step)
  end subroutine dense_compression

  !> M_k, P_k, forces of two levels of the compression: velocity, A D' and A^3 are parabolas in it.
  pure subroutine load_pair(g_inf, eta, n_terms, g, tau, resolved, x, d, v, a, level, trace)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), resolved, x(2), d(0:2), v(0:2), a(0:2)
    type(level_type), intent(inout) :: level(2)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2)
    type(spacing_type) :: spacing
    type(parabola_type) :: speeds, cubes, sweeps
    type(trace_type) :: now(2)
    real(dp) :: a3(0:2), av(0:2), h(2), drive(2), speed(2)
    integer(ip) :: k, q
    a3 = d*a
    av = a*v
    level%force = (2.0_dp/3.0_dp)*g_inf*a3(1:2) + eta*av(1:2)
    level%fresh = g_inf*d(1:2) + eta*v(1:2)
    if (n_terms == 0) return
    spacing = spacing_of(x)
    speeds = parabola_through(spacing, v)
    cubes = parabola_through(spacing, a3)
    sweeps = parabola_through(spacing, av)
    h = [x(1), x(2) - x(1)]
    do k = 1, n_terms
      call fade_in_steps(g(k), tau(k), h, now)
      if (by_parts(x, tau(k), resolved)) then
        drive = (2.0_dp/3.0_dp)*(g(k)*(a3(1:2) - now%decay*a3(0:1)) - added(now, a3, cubes%bend)/tau(k))
      else
        drive = added(now, av, sweeps%bend)
      end if
      speed = added(now, v, speeds%bend)
      do q = 1, 2
        now(q)%fade = 1
        now(q)%loading = drive(q) + now(q)%decay*trace(k, q - 1)%loading
        now(q)%memory = speed(q) + now(q)%decay*trace(k, q - 1)%memory
        level(q)%force = level(q)%force + now(q)%loading
        level(q)%fresh = level(q)%fresh + now(q)%memory
        trace(k, q) = now(q)
      end do
    end do
  end subroutine load_pair

  !> What a parabola through three values adds to what is remembered in the two steps between them, times g.
  pure function added(trace, y, bend) result(share)
    type(trace_type), intent(in) :: trace(2)
    real(dp), intent(in) :: y(0:2), bend
    real(dp) :: share(2)
    share = trace%from_start*y(0:1) + trace%from_end*y(1:2) + trace%from_bend*bend
  end function added

  !> The levels from `start` on to the end of a panel of the restitution. The force follows from that at the same radius.
  pure subroutine dense_restitution(g_inf, eta, n_terms, g, tau, n, r, start, coarse, spread, level, trace, node, offset, failed)
    integer(ip), intent(in) :: n_terms, n, r, start
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms)
    type(level_type), intent(in) :: coarse(0:2)
    real(dp), intent(in) :: spread(3)
    type(level_type), intent(inout) :: level(0:2*n)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    type(node_type), intent(in) :: node(0:n)
    real(dp), intent(inout) :: offset  !! time of the level `start` since that of the panel: by how much it is off
    logical, intent(out) :: failed
    type(path_type) :: path
    real(dp) :: h, t, part
    integer(ip) :: l, j
    path = path_of(coarse, 0.0_dp)
    part = 1/real(r, dp)
    t = offset
    do l = start + 1, start + 2*r
      j = 2*n - l
      if (r == 1) then
        h = coarse(l - start)%step + merge(coarse(1)%step, 0.0_dp, l - start == 2) - t
      else if (l == n + 1) then
        h = first_return(g_inf, eta, n_terms, g, tau, level(n)%step)
      else
        h = max(0.1_dp*level(l - 1)%step, between(1_ip, spread, real(l - start, dp)*part) - t)
      end if
      call meet_free_edge(g_inf, eta, n_terms, g, tau, path, t, node(j)%radius, trace(:, j:j + 1), level(l - 1), trace(:, l - 1), &
                          h, level(l), trace(:, l), failed)
      if (failed .and. l > n + 2) then ! the guess leads astray
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
      if (h < shortest) return
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

  !> The motion without dashpot.
  pure function on_path(path, x) result(motion)
    type(path_type), intent(in) :: path
    real(dp), intent(in) :: x
    type(motion_type) :: motion
    motion%acceleration = path%rest%start + x*(path%rest%slope + x*path%rest%bend)
    motion%velocity = path%velocity + integrated(x, path%rest)
    motion%depth = path%depth + x*path%velocity + integrated_twice(x, path%rest)
  end function on_path

  !> The motion, with dashpot, at two times.
  pure subroutine follow_path(path, x, depth, velocity, acceleration, radius)
    type(path_type), intent(in) :: path
    real(dp), intent(in) :: x(2)
    real(dp), dimension(2), intent(out) :: depth, velocity, acceleration, radius
    integer(ip) :: q
    !$omp simd
    do q = 1, 2
      acceleration(q) = path%rest%start + x(q)*(path%rest%slope + x(q)*path%rest%bend)
      velocity(q) = path%velocity + integrated(x(q), path%rest)
      depth(q) = path%depth + x(q)*path%velocity + integrated_twice(x(q), path%rest)
      radius(q) = sqrt(max(depth(q), tiny(1.0_dp)))
    end do
    if (path%drag > 0) then
      do q = 1, 2
        depth(q) = depth(q) - integrated(x(q), path%cubes)
        radius(q) = sqrt(max(depth(q), tiny(1.0_dp)))
        velocity(q) = velocity(q) - (2.0_dp/3.0_dp)*path%drag*(depth(q)*radius(q) - path%cubed)
        acceleration(q) = acceleration(q) - path%drag*radius(q)*velocity(q)
      end do
    end if
  end subroutine follow_path

  !> Newton's steps of two times t(1:2) to where A (1-u^2) = 2 u radius D', from a guess. `width`: du/dj, then dA/dj: along the
  !> grid dA/du follows with rho^2 = (A/radius)^2 + D'^2 (see grid_type).
  pure subroutine meet_edge(grid, path, u, t, d, v, a, width, failed)
    type(grid_type), intent(in) :: grid
    type(path_type), intent(in) :: path
    real(dp), intent(in) :: u(2)
    real(dp), intent(inout) :: t(0:2), width(2)
    real(dp), dimension(2), intent(out) :: d, v, a
    logical, intent(out) :: failed
    real(dp), dimension(2) :: acceleration, cosine, sine, dx, h
    real(dp) :: miss, part, rho
    integer(ip) :: i, q
    cosine = (1 - u)*(1 + u)
    sine = 2*u*grid%radius
    do i = 1, most_steps
      h = t(1:2) - t(0:1)
      call follow_path(path, t(1:2), d, v, acceleration, a)
      !$omp simd private(miss)
      do q = 1, 2
        miss = a(q)*cosine(q) - sine(q)*v(q)
        dx(q) = bounded(-2*a(q)*miss, v(q)*cosine(q) - 2*a(q)*sine(q)*acceleration(q), -0.5_dp*h(q), h(q))
        dx(q) = merge(0.0_dp, dx(q), abs(miss) <= rounding*sine(q))
      end do
      failed = .not. (abs(dx(1)) <= sharpness*h(1) .and. abs(dx(2)) <= sharpness*h(2))
      if (.not. failed) exit
      t(1:2) = t(1:2) + dx
    end do
    !$omp simd private(part, rho)
    do q = 1, 2
      part = dx(q)*(path%rest%slope + (2*t(q) + dx(q))*path%rest%bend)
      part = acceleration(q) + path%drag*a(q)*v(q) + part
      d(q) = max(d(q) + dx(q)*(v(q) + 0.5_dp*dx(q)*acceleration(q)), tiny(1.0_dp))
      v(q) = v(q) + dx(q)*(part - path%drag*a(q)*v(q))
      a(q) = sqrt(d(q))
      acceleration(q) = part - path%drag*a(q)*v(q)
      t(q) = t(q) + dx(q)
      rho = 1/(1 + u(q)*u(q))
      cosine(q) = cosine(q)*rho
      sine(q) = sine(q)*rho
      width(q) = width(q)*(a(q)*sine(q) + grid%radius**2*v(q)*cosine(q))*cosine(q)*2*rho &
                 /(grid%radius*(cosine(q)**2 - 2*sine(q)**2*acceleration(q)))
    end do
  end subroutine meet_edge

  !> Differences of the times of a panel since its start, for the cubic through them and the level before, or the one after if that
  !> is of another phase; after first touch, where times are a square, of them over the square of their numbers.
  pure function spread_of(coarse, p) result(spread)
    type(level_type), intent(in) :: coarse(0:)  !! up to 3 if p is 0
    integer(ip), intent(in) :: p                !! the panel is so many levels behind the start of its phase
    real(dp) :: spread(3), third
    if (coarse(0)%depth > 0) then
      if (p > 0) third = coarse(2)%step - 2*coarse(1)%step + coarse(0)%step
      if (p == 0) third = coarse(3)%step - 2*coarse(2)%step + coarse(1)%step
      spread = [coarse(1)%step, (coarse(2)%step - coarse(1)%step)*0.5_dp, third*(1.0_dp/6.0_dp)]
    else
      spread(1) = coarse(1)%time
      spread(2) = coarse(2)%time*0.25_dp - coarse(1)%time
      spread(3) = (coarse(3)%time*(1.0_dp/9.0_dp) - coarse(2)%time*0.5_dp + coarse(1)%time)*0.5_dp
    end if
  end function spread_of

  !> Time since the start of the panel at y levels behind it. start: 0 at first touch.
  pure function between(start, spread, y) result(time)
    integer(ip), intent(in) :: start
    real(dp), intent(in) :: spread(3), y
    real(dp) :: time
    time = spread(1) + (y - 1)*(spread(2) + (y - 2)*spread(3))
    if (start > 0) time = y*time
    if (start == 0) time = y*y*time
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

  pure subroutine fade_in_steps(g, tau, h, trace)
    real(dp), intent(in) :: g, tau, h(2)
    type(trace_type), intent(out) :: trace(2)
    type(memory_pair_type) :: m
    real(dp) :: gh
    integer(ip) :: q
    call remember_pair(h/tau, m)
    do q = 1, 2
      gh = g*h(q)
      trace(q)%decay = m%decay(q)
      trace(q)%from_start = gh*(m%phi1(q) - m%phi2(q))
      trace(q)%from_end = gh*m%phi2(q)
      trace(q)%from_bend = gh*h(q)*h(q)*(2*m%phi3(q) - m%phi2(q))
    end do
  end subroutine fade_in_steps
end module rst_sync_dense
