!> The normal problem at levels at which the edge of contact sits on a node (THEORY 4.4 to 4.6 and 6).
!>
!> The nodes X_0 = 0 < X_1 < ... < X_n = A_max are where the edge is at n instants of the compression; the levels are these
!> instants and the n of the restitution at which the shrinking edge is there again. No elements are needed:
!>
!>   compression  P_k = int_0^A w_k dX obeys P_k' = A D' - P_k/tau_k
!>   restitution  the edge at X_j, entered at t_j, is free:  G_inf (D - X_j^2) + sum_k (M_k(s) - E_kj M_k(t_j)) + eta D' = 0
!>                with M_k' = D' - M_k/tau_k and E_kj = exp(-(s-t_j)/tau_k), and with it the whole force is known from the
!>                compression:  int_0^A f dX = (2/3) G_inf X_j^3 + sum_k E_kj P_k(t_j)
!>
!> Both are integrated in panels of two levels: the acceleration is the parabola in time through three levels, velocity
!> and depth are its integrals and fading memory is taken exactly (module rst_memory): fourth order, for any tau. Stresses
!> stand for elongations (M_k and P_k times g_k), so that tau_k -> 0 at constant g_k tau_k is a dashpot.
module rst_sync_levels
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of, parabola_type, spacing_type, spacing_of, parabola_through, remembered, integrated, &
                        integrated_twice, own_share, own_memory
  implicit none (type, external)
  private
  public :: grid_type, level_type, node_type, likely_depth, choose_grid, normal_levels, spread_nodes, first_return
  public :: panel_type, panel_of, by_parts, loaded_by_parts, longest_panel, first_levels, mass_factor

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp
  integer(ip), parameter :: most_sweeps = 100
  integer(ip), parameter :: first_levels = 8        !! of the compression, where sqrt(s) is most curved
  real(dp), parameter :: longest_panel = 6.0_dp     !! roughly, in D_max/n
  real(dp), parameter :: rounding = 16*epsilon(1.0_dp)  !! of differences of velocities and depths of order 1

  !> How levels are spread: by u = tan(phi/2), tan(phi) = A/(radius D'), from 0 at first touch to 1 at the turning point.
  !> In strongly damped impacts the contact shrinks to a small part of its size at once, and the sphere all but stops before it
  !> turns: start and turn are how finely both ends are divided (u = sinh(start v)/sinh(start) and alike; 0: evenly).
  type, bind(c) :: grid_type
    real(dp) :: radius, start, turn
  end type grid_type

  !> Where the sphere is at a level; step: time since the level before, with all its digits; force: int_0^A f dX. For the
  !> tangential problem: `fresh` is f + G_inf X^2 of an element that forgets nothing, `missing` what the sum over nodes lacks of the
  !> force, `weight` see module rst_sync_quadrature. Twin of `struct sync_level` in C.
  type, bind(c) :: level_type
    real(dp) :: time, step, depth, velocity, force, fresh, missing, weight(0:3)
  end type level_type

  !> X_j and dX/dj. Twin of `struct sync_node` in C.
  type, bind(c) :: node_type
    real(dp) :: radius, width
  end type node_type

  !> D', A^3 and A D' in a panel.
  type :: panel_type
    type(parabola_type) :: speeds, cubes, sweeps
  end type panel_type

contains

  !> Largest indentation, roughly (a few per cent): the energy balance with the modulus at that age,
  !> 1 = D^(5/2) (G_inf + sum g_k/(1 + 0.8 D/tau_k) + (5/4) eta/D), which has the elastic and the viscous limit right.
  pure function likely_depth(g_inf, eta, n_terms, g, tau) result(depth)
    real(dp), intent(in) :: g_inf, eta
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp) :: depth, modulus, factor
    integer(ip) :: i, k
    depth = 1
    do i = 1, 100
      modulus = g_inf + 1.25_dp*eta/depth
      do k = 1, n_terms
        modulus = modulus + g(k)/(1 + 0.8_dp*depth/tau(k))
      end do
      factor = 1/sqrt(modulus*depth*depth*sqrt(depth))
      depth = depth*factor
      if (abs(factor - 1) < 0.01_dp) exit
    end do
  end function likely_depth

  !> Grid for a solid, from what a Kelvin-Voigt solid of its stiffness E and viscosity would do, both at the age of the impact:
  !> after the turning point its contact shrinks to A ~ (E D/viscosity^2)^(1/3) before the sphere moves; before it, the
  !> sphere creeps at D' ~ E D/viscosity.
  pure function choose_grid(g_inf, eta, n_terms, g, tau) result(grid)
    real(dp), intent(in) :: g_inf, eta
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    type(grid_type) :: grid
    real(dp), parameter :: even_above = 0.5_dp  !! contacts that stay larger than this part need no grading
    real(dp) :: depth, stiffness, viscosity, age, small_radius
    integer(ip) :: k
    depth = likely_depth(g_inf, eta, n_terms, g, tau)
    grid = grid_type(sqrt(depth), 0.0_dp, 0.0_dp)
    stiffness = g_inf
    viscosity = eta
    do k = 1, n_terms
      age = 0.8_dp*tau(k)/depth
      stiffness = stiffness + g(k)*(age/(1 + age))**2
      viscosity = viscosity + g(k)*tau(k)/(1 + age)**2
    end do
    small_radius = depth*stiffness/max(viscosity, tiny(1.0_dp)*1.0e200_dp)**2
    if (small_radius > (even_above*grid%radius)**3) return
    grid%start = asinh(grid%radius/small_radius**(1.0_dp/3.0_dp))
    grid%turn = asinh(1/max(depth*stiffness/viscosity, 1.0e-9_dp))
  end function choose_grid

  !> All levels. `failed` tells that an iteration did not converge: take more levels.
  pure subroutine normal_levels(grid, g_inf, eta, n_terms, g, tau, n, closeness, level, memory, loading, node, failed)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n  !! n even
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms)
    real(dp), intent(in) :: closeness  !! iterations stop when velocities, and times relatively, change by less
    type(level_type), intent(out) :: level(0:2*n)
    real(dp), intent(out) :: memory(n_terms, 0:2*n)   !! g_k M_k
    real(dp), intent(out) :: loading(n_terms, 0:2*n)  !! g_k P_k of the compression
    type(node_type), intent(out) :: node(0:n)         !! radii; widths are not made
    logical, intent(out) :: failed
    integer(ip) :: l

    call spread_nodes(grid, n, node)
    level(0) = at_level(0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp)
    memory(:, 0) = 0
    loading(:, 0) = 0
    do l = 0, n - 2, 2
      call compression_panel(grid, g_inf, eta, n_terms, g, tau, n, l, closeness, level, memory, loading, node, failed)
      if (failed) return
    end do
    do l = n, 2*n - 2, 2
      call restitution_panel(g_inf, eta, n_terms, g, tau, n, l, closeness, level, memory, loading, node, failed)
      if (failed) return
    end do
  end subroutine normal_levels

  !> Where the levels of the compression are: radius and width hold u and du/dj, until the compression has passed them.
  pure subroutine spread_nodes(grid, n, node)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n
    type(node_type), intent(out) :: node(0:n)
    real(dp) :: v, slope, turn_scale, start_scale
    integer(ip) :: j
    turn_scale = 0
    start_scale = 0
    if (grid%turn > 0) turn_scale = 1/sinh(grid%turn)
    if (grid%start > 0) start_scale = 1/sinh(grid%start)
    do j = 0, n
      v = real(j, dp)/real(n, dp)
      slope = 1/real(n, dp)
      if (grid%turn > 0) then
        slope = slope*grid%turn*cosh(grid%turn*(1 - v))*turn_scale
        v = 1 - sinh(grid%turn*(1 - v))*turn_scale
      end if
      if (grid%start > 0) then
        slope = slope*grid%start*cosh(grid%start*v)*start_scale
        v = sinh(grid%start*v)*start_scale
      end if
      node(j) = node_type(v, slope)
    end do
    node(0) = node_type(0.0_dp, 2*grid%radius*node(0)%width)
  end subroutine spread_nodes

  pure function at_level(time, step, depth, velocity, force) result(level)
    real(dp), intent(in) :: time, step, depth, velocity, force
    type(level_type) :: level
    level = level_type(time, step, depth, velocity, force, 0.0_dp, 0.0_dp, 0.0_dp)
  end function at_level

  !> Levels l+1 and l+2 of the compression, by sweeps over: times at which the edge is on the grid, depth and velocity from the
  !> acceleration, memory, acceleration. The dashpot's part of it, -(15/8) eta A D', is a total derivative and taken
  !> exactly; `rest` is the acceleration without it.
  pure subroutine compression_panel(grid, g_inf, eta, n_terms, g, tau, n, l, closeness, level, memory, loading, node, &
                                    failed)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n, l
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), closeness
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp), intent(inout) :: memory(n_terms, 0:2*n), loading(n_terms, 0:2*n)
    type(node_type), intent(inout) :: node(0:n)
    logical, intent(out) :: failed
    real(dp) :: x(2), u(2), d(0:2), v(0:2), a(0:2), a3(0:2), rest(0:2), held(2), echo(2), change, previous, drag, resolved, next
    type(spacing_type) :: spacing
    type(parabola_type) :: push, cubes
    integer(ip) :: q, sweep
    logical :: done

    drag = mass_factor*eta
    resolved = merge(0.0_dp, longest_panel*grid%radius**2/real(n, dp), l < first_levels)
    d(0) = level(l)%depth
    v(0) = level(l)%velocity
    a(0) = node(l)%radius
    a3(0) = a(0)**3
    rest(0) = -mass_factor*level(l)%force + drag*a(0)*v(0)
    u = [node(l + 1)%radius, node(l + 2)%radius]
    call guess_compression(grid, g_inf, eta, n_terms, g, n, l, u, level, node, x, a, a3, rest)
    previous = huge(1.0_dp)
    do sweep = 1, most_sweeps
      spacing = spacing_of(x)
      push = parabola_through(spacing, rest)
      if (drag > 0) cubes = parabola_through(spacing, (2.0_dp/3.0_dp)*drag*(a3 - a3(0)))
      change = 0
      do q = 1, 2
        d(q) = d(0) + x(q)*v(0) + integrated_twice(x(q), push)
        v(q) = v(0) + integrated(x(q), push)
        if (drag > 0) then
          ! a strong dashpot answers more depth with less velocity, hence less depth: Newton's step instead of the sweep's
          next = a(q)**2 + (d(q) - integrated(x(q), cubes) - a(q)**2)/(1 + drag*own_share(q, x)*a(q))
          d(q) = max(next, 0.25_dp*a(q)**2)
          v(q) = v(q) - (2.0_dp/3.0_dp)*drag*(d(q)*sqrt(d(q)) - a3(0))
        end if
        d(q) = max(d(q), 0.25_dp*a(q)**2)
        a(q) = sqrt(d(q))
        call meet_edge(grid, u(q), drag, rest(q), x(q), d(q), v(q), a(q), change)
        a3(q) = d(q)*a(q)
      end do
      if (x(2) <= x(1)) x(2) = 2*x(1)
      call load_terms(n_terms, resolved, g, tau, x, v, a, a3, loading(:, l:l + 2), held, echo)
      do q = 1, 2
        next = -mass_factor*((2.0_dp/3.0_dp)*g_inf*a3(q) + held(q))
        if (echo(q) > 0) next = rest(q) + (next - rest(q))/(1 + mass_factor*own_share(q, x)*echo(q)) ! as for the dashpot
        change = max(change, abs(next - rest(q))*x(2))
        rest(q) = next
      end do
      call settle(sweep, change, closeness, previous, done)
      if (done) exit
    end do
    failed = .not. done
    call remember_terms(n_terms, g, tau, x, v, memory(:, l:l + 2))
    do q = 1, 2
      level(l + q) = at_level(level(l)%time + x(q), x(q) - (q - 1)*x(1), d(q), v(q), eta*a(q)*v(q) - rest(q)/mass_factor)
      node(l + q)%radius = a(q)
    end do
  end subroutine compression_panel

  !> Where the panels before point to; at first touch D = s.
  pure subroutine guess_compression(grid, g_inf, eta, n_terms, g, n, l, u, level, node, x, a, a3, rest)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n, l
    real(dp), intent(in) :: g_inf, eta, g(n_terms), u(2)
    type(level_type), intent(in) :: level(0:2*n)
    type(node_type), intent(in) :: node(0:n)
    real(dp), intent(out) :: x(2)
    real(dp), intent(inout) :: a(0:2), a3(0:2), rest(0:2)
    real(dp) :: before(0:2)
    integer(ip) :: q
    if (l == 0) then
      do q = 1, 2
        x(q) = (2*grid%radius*u(q)/max(1 - u(q)*u(q), 0.1_dp))**2
        a(q) = sqrt(x(q))
        a3(q) = x(q)*a(q)
        rest(q) = -mass_factor*(g_inf + sum(g))*(2.0_dp/3.0_dp)*a3(q)
      end do
      return
    end if
    x = steps_ahead(level(l)%step, level(l - 1)%step)
    do q = 0, 2
      before(q) = -mass_factor*(level(l - 2 + q)%force - eta*node(l - 2 + q)%radius*level(l - 2 + q)%velocity)
    end do
    rest(1:2) = ahead(before)
    do q = 0, 2
      before(q) = node(l - 2 + q)%radius
    end do
    a(1:2) = ahead(before)
    a3(1:2) = a(1:2)**3
  end subroutine guess_compression

  !> One Newton step of the time x towards A (1-u^2) = 2 u radius D'.
  pure subroutine meet_edge(grid, u, drag, rest, x, depth, velocity, a, change)
    type(grid_type), intent(in) :: grid
    real(dp), intent(in) :: u, drag, rest
    real(dp), intent(inout) :: x, depth, velocity, a, change
    real(dp) :: cosine, sine, acceleration, miss, dx
    cosine = (1 - u)*(1 + u)
    sine = 2*u*grid%radius
    acceleration = rest - drag*a*velocity
    miss = a*cosine - sine*velocity
    dx = -miss/(velocity/(2*a)*cosine - sine*acceleration)
    dx = max(-0.5_dp*x, min(x, dx))
    if (abs(miss) > rounding*sine) change = max(change, abs(dx)/x)
    depth = max(depth + dx*velocity, tiny(1.0_dp))
    velocity = velocity + dx*acceleration
    a = sqrt(depth)
    x = x + dx
  end subroutine meet_edge

  !> P_k at both points. `held`: sum g_k P_k, `echo`: its derivative by the velocity.
  pure subroutine load_terms(n_terms, resolved, g, tau, x, v, a, a3, loading, held, echo)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: resolved  !! the panels of a run resolve longer relaxation times
    real(dp), intent(in) :: g(n_terms), tau(n_terms), x(2), v(0:2), a(0:2), a3(0:2)
    real(dp), intent(inout) :: loading(n_terms, 0:2)
    real(dp), intent(out) :: held(2), echo(2)
    type(panel_type) :: panel
    type(memory_type) :: m
    integer(ip) :: k, q
    held = 0
    echo = 0
    if (n_terms == 0) return
    panel = panel_of(x, v, a, a3)
    do k = 1, n_terms
      do q = 1, 2
        m = memory_of(x(q)/tau(k))
        if (by_parts(x, tau(k), resolved)) then
          loading(k, q) = m%decay*loading(k, 0) + g(k)*loaded_by_parts(panel, m, tau(k), x(q), a3(0), a3(q))
        else
          loading(k, q) = m%decay*loading(k, 0) + g(k)*remembered(m, x(q), panel%sweeps)
          echo(q) = echo(q) + g(k)*a(q)*own_memory(m, q, x)
        end if
        held(q) = held(q) + loading(k, q)
      end do
    end do
  end subroutine load_terms

  !> M_k at both points.
  pure subroutine remember_terms(n_terms, g, tau, x, v, memory)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms), x(2), v(0:2)
    real(dp), intent(inout) :: memory(n_terms, 0:2)
    type(parabola_type) :: speeds
    type(memory_type) :: m
    integer(ip) :: k, q
    speeds = parabola_through(spacing_of(x), v)
    do k = 1, n_terms
      do q = 1, 2
        m = memory_of(x(q)/tau(k))
        memory(k, q) = m%decay*memory(k, 0) + g(k)*remembered(m, x(q), speeds)
      end do
    end do
  end subroutine remember_terms

  pure function panel_of(x, v, a, a3) result(panel)
    real(dp), intent(in) :: x(2), v(0:2), a(0:2), a3(0:2)
    type(panel_type) :: panel
    type(spacing_type) :: spacing
    spacing = spacing_of(x)
    panel = panel_type(parabola_through(spacing, v), parabola_through(spacing, a3), parabola_through(spacing, a*v))
  end function panel_of

  !> A D' ~ sqrt(s) is no parabola at first touch; int A D' exp is taken by parts, with (2/3) A^3 in its place, by the first
  !> panels, and by all of them where they resolve tau: a change between both within the run would show. With longer
  !> panels by parts would cancel.
  pure function by_parts(x, tau, resolved) result(yes)
    real(dp), intent(in) :: x(2), tau, resolved
    logical :: yes
    yes = x(2) < tau .and. tau > resolved
  end function by_parts

  pure function loaded_by_parts(panel, m, tau, x, a3_start, a3) result(y)
    type(panel_type), intent(in) :: panel
    type(memory_type), intent(in) :: m
    real(dp), intent(in) :: tau, x, a3_start, a3
    real(dp) :: y
    y = (2.0_dp/3.0_dp)*(a3 - m%decay*a3_start - remembered(m, x, panel%cubes)/tau)
  end function loaded_by_parts

  !> Levels l+1 and l+2 of the restitution: times at which the edge is free, from the acceleration, which depends on
  !> the time only through the fading of what the compression left.
  pure subroutine restitution_panel(g_inf, eta, n_terms, g, tau, n, l, closeness, level, memory, loading, node, &
                                    failed)
    integer(ip), intent(in) :: n_terms, n, l
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), closeness
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp), intent(inout) :: memory(n_terms, 0:2*n)
    real(dp), intent(inout) :: loading(n_terms, 0:2*n)  !! at the new levels room for what the nodes have left at the start
    type(node_type), intent(in) :: node(0:n)
    logical, intent(out) :: failed
    real(dp) :: x(2), d(0:2), v(0:2), push(0:2), before(0:2), change, previous, next, excess, noise, slope, dx, faded
    type(spacing_type) :: spacing
    type(parabola_type) :: pushes, speeds
    type(memory_type) :: m
    integer(ip) :: q, j, k, sweep
    logical :: done

    d(0) = level(l)%depth
    v(0) = level(l)%velocity
    push(0) = -mass_factor*level(l)%force
    if (l == n) then
      do q = 1, 2
        x(q) = first_return(g_inf, eta, n_terms, g, tau, level(n)%time - level(n - q)%time)
        push(q) = -mass_factor*level(n - q)%force
      end do
    else
      x = steps_ahead(level(l)%step, level(l - 1)%step)
      do q = 0, 2
        before(q) = -mass_factor*level(l - 2 + q)%force
      end do
      push(1:2) = ahead(before)
    end if
    do q = 1, 2
      do k = 1, n_terms
        loading(k, l + q) = exp(-(level(l)%time - level(2*n - l - q)%time)/tau(k))
      end do
    end do
    previous = huge(1.0_dp)
    do sweep = 1, most_sweeps
      spacing = spacing_of(x)
      pushes = parabola_through(spacing, push)
      do q = 1, 2
        d(q) = d(0) + x(q)*v(0) + integrated_twice(x(q), pushes)
        v(q) = v(0) + integrated(x(q), pushes)
      end do
      speeds = parabola_through(spacing, v)
      change = 0
      do q = 1, 2
        j = 2*n - l - q
        excess = g_inf*(d(q) - node(j)%radius**2) + eta*v(q)
        noise = rounding*(g_inf*d(q) + eta)
        slope = g_inf*v(q) + eta*push(q)
        next = (2.0_dp/3.0_dp)*g_inf*node(j)%radius**3
        do k = 1, n_terms
          m = memory_of(x(q)/tau(k))
          memory(k, l + q) = m%decay*memory(k, l) + g(k)*remembered(m, x(q), speeds)
          faded = loading(k, l + q)*m%decay
          excess = excess + memory(k, l + q) - faded*memory(k, j)
          noise = noise + rounding*(g(k)*d(q) + faded*abs(memory(k, j)))
          slope = slope + g(k)*v(q) - (memory(k, l + q) - faded*memory(k, j))/tau(k)
          next = next + faded*loading(k, j)
        end do
        dx = max(-0.5_dp*x(q), min(x(q), -excess/slope))
        if (slope >= 0) dx = x(q)
        if (abs(excess) > noise) change = max(change, abs(dx)/x(q))
        change = max(change, abs(next*mass_factor + push(q))*x(2))
        x(q) = x(q) + dx
        push(q) = -mass_factor*next
      end do
      if (x(2) <= x(1)) x(2) = 2*x(1)
      call settle(sweep, change, closeness, previous, done)
      if (done) exit
    end do
    failed = .not. done
    do q = 1, 2
      level(l + q) = at_level(level(l)%time + x(q), x(q) - (q - 1)*x(1), d(q), v(q), -push(q)/mass_factor)
    end do
  end subroutine restitution_panel

  !> When, after the turning point, the edge is back where it was `before` ahead of it: there D' is linear in time, and
  !> the edge condition is (1/2) G_inf (x^2 - before^2) + eta x + sum_k g_k tau_k [x - tau_k + (before + tau_k) E] = 0 with
  !> E = exp(-(x+before)/tau_k).  It rises with x; x = before solves the elastic one.
  pure function first_return(g_inf, eta, n_terms, g, tau, before) result(x)
    real(dp), intent(in) :: g_inf, eta, before
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp) :: x, low, high, excess, slope, faded
    integer(ip) :: i, k
    low = 0
    high = before
    x = before
    do i = 1, 60
      excess = g_inf*(x*x - before*before)/2 + eta*x
      slope = g_inf*x + eta
      do k = 1, n_terms
        faded = exp(-(x + before)/tau(k))
        excess = excess + g(k)*tau(k)*(x - tau(k) + (before + tau(k))*faded)
        slope = slope + g(k)*(tau(k) - (before + tau(k))*faded)
      end do
      if (excess > 0) high = x
      if (excess <= 0) low = x
      x = x - excess/slope
      if (.not. (x > low .and. x < high)) x = (low + high)/2
      if (abs(excess) <= 0.01_dp*slope*x .or. high - low <= 0.01_dp*high) exit
    end do
    x = max(x, 1.0e-3_dp*before)
  end function first_return

  !> Sweeps end when they change little, or when rounding lets them change less no more.
  pure subroutine settle(sweep, change, closeness, previous, yes)
    integer(ip), intent(in) :: sweep
    real(dp), intent(in) :: change, closeness
    real(dp), intent(inout) :: previous
    logical, intent(out) :: yes
    real(dp), parameter :: stagnates_below = 1.0e-11_dp, enough_at_last = 1.0e-9_dp
    integer(ip), parameter :: many = 30
    yes = change < closeness .or. (change < stagnates_below .and. change >= previous) &
          .or. (sweep >= many .and. change < enough_at_last)
    previous = change
  end subroutine settle

  !> The next two steps of a sequence of times whose last steps were `last` and `earlier`.
  pure function steps_ahead(last, earlier) result(x)
    real(dp), intent(in) :: last, earlier
    real(dp) :: x(2)
    x(1) = max(0.5_dp*last, 2*last - earlier)
    x(2) = x(1) + max(0.5_dp*last, 3*last - 2*earlier)
  end function steps_ahead

  !> Continue three values by their parabola.
  pure function ahead(before) result(next)
    real(dp), intent(in) :: before(0:2)
    real(dp) :: next(2)
    next(1) = before(0) - 3*before(1) + 3*before(2)
    next(2) = 3*before(0) - 8*before(1) + 6*before(2)
  end function ahead
end module rst_sync_levels
