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
  use rst_memory, only: memory_pair_type, remember_pair, parabola_type, spacing_type, spacing_of, parabola_through, remembered, &
                        integrated, integrated_twice, shares, memory_shares
  implicit none (type, external)
  private
  public :: grid_type, level_type, node_type, likely_depth, choose_grid, normal_levels, double_levels, spread_nodes, first_return
  public :: by_parts, longest_panel, first_levels, mass_factor

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp
  integer(ip), parameter :: most_sweeps = 100, enough_if_lost = 20  !! with changes as large as all there is
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
  pure subroutine normal_levels(grid, g_inf, eta, n_terms, g, tau, n, closeness, guessed, level, memory, loading, node, failed)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n  !! n even
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms)
    real(dp), intent(in) :: closeness  !! iterations stop when velocities, and times relatively, change by less
    logical, intent(in) :: guessed     !! whether the levels come with a guess (double_levels)
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp), intent(out) :: memory(n_terms, 0:2*n)   !! g_k M_k
    real(dp), intent(out) :: loading(n_terms, 0:2*n)  !! g_k P_k of the compression
    type(node_type), intent(out) :: node(0:n)         !! radii; widths are not made
    logical, intent(out) :: failed
    type(level_type) :: guess, next_guess
    real(dp), parameter :: rounding_of_change = 1.0e-12_dp
    real(dp) :: rate, close
    integer(ip) :: l

    call spread_nodes(grid, n, node)
    close = closeness
    if (grid%start > 0) close = max(0.25_dp*closeness, min(closeness, rounding_of_change)) ! both ends are small
    rate = merge(0.003_dp, 1.0_dp, guessed) ! as the run with half the levels ended, or nothing known
    guess = level(0)
    level(0) = at_level(0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp)
    memory(:, 0) = 0
    loading(:, 0) = 0
    do l = 0, n - 2, 2
      next_guess = level(l + 2)
      if (grid%start > 0 .or. eta > 0) rate = 1 ! panels are unlike; Newton's steps are not made for a dashpot
      call compression_panel(grid, g_inf, eta, n_terms, g, tau, n, l, close, guessed, guess, rate, level, memory, &
                             loading, node, failed)
      if (failed) return
      guess = next_guess
    end do
    do l = n, 2*n - 2, 2
      next_guess = level(l + 2)
      if (grid%start > 0 .or. eta > 0) rate = 1 ! panels are unlike; Newton's steps are not made for a dashpot
      call restitution_panel(g_inf, eta, n_terms, g, tau, n, l, close, guessed, guess, rate, level, memory, &
                             loading, node, failed)
      if (failed) return
      guess = next_guess
    end do
  end subroutine normal_levels

  !> A guess of 2n levels a phase from n: every other one, and between them polynomials in the number of the level, through six of the
  !> same phase, four if there are no six.
  pure subroutine double_levels(n, level)
    integer(ip), intent(in) :: n  !! 4 or more
    type(level_type), intent(inout) :: level(0:4*n)  !! the first 2n + 1 are given
    real(dp), parameter :: of_four(0:3, 0:2) = reshape([5, 15, -5, 1, -1, 9, 9, -1, 1, -5, 15, 5]/16.0_dp, [4, 3])
    real(dp), parameter :: of_six(0:5, 0:4) = reshape([63, 315, -210, 126, -45, 7, -7, 105, 210, -70, 21, -3, 3, -25, 150, 150, &
        -25, 3, -3, 21, -70, 210, 105, -7, 7, -45, 126, -210, 315, 63]/256.0_dp, [6, 5])
    integer(ip) :: l, first, last
    do l = 2*n, 0, -1
      level(2*l) = level(l)
    end do
    do l = 1, 4*n - 1, 2
      first = merge(0_ip, 2*n, l < 2*n)
      last = first + 2*n
      if (n < 6) then
        first = max(first, min(l - 3, last - 6))
        call put_between(4_ip, of_four(:, (l - first)/2), level(first:first + 6:2), level(l))
      else
        first = max(first, min(l - 5, last - 10))
        call put_between(6_ip, of_six(:, (l - first)/2), level(first:first + 10:2), level(l))
      end if
    end do
    do l = 4*n, 1, -1
      level(l)%step = level(l)%time - level(l - 1)%time
    end do
  end subroutine double_levels

  pure subroutine put_between(count, weight, around, level)
    integer(ip), intent(in) :: count
    real(dp), intent(in) :: weight(count)
    type(level_type), intent(in) :: around(:)
    type(level_type), intent(inout) :: level
    integer(ip) :: i
    level = at_level(0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
    do i = 1, count
      level%time = level%time + weight(i)*around(i)%time
      level%depth = level%depth + weight(i)*around(i)%depth
      level%velocity = level%velocity + weight(i)*around(i)%velocity
      level%force = level%force + weight(i)*around(i)%force
    end do
  end subroutine put_between

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
  pure subroutine compression_panel(grid, g_inf, eta, n_terms, g, tau, n, l, closeness, guessed, guess, rate, level, memory, &
                                    loading, node, failed)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n, l
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), closeness
    logical, intent(in) :: guessed
    type(level_type), intent(in) :: guess  !! what level l was guessed to be
    real(dp), intent(inout) :: rate        !! see `settle`
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp), intent(inout) :: memory(n_terms, 0:2*n), loading(n_terms, 0:2*n)
    type(node_type), intent(inout) :: node(0:n)
    logical, intent(out) :: failed
    real(dp) :: x(2), u(2), d(0:2), v(0:2), a(0:2), a3(0:2), rest(0:2), change, previous, drag, resolved
    real(dp), dimension(2) :: held, stiffness, echo, moved, lift, gain
    type(spacing_type) :: spacing
    type(parabola_type) :: push
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
    if (guessed .and. is_likely(level(l + 1), level(l + 2))) then
      call take_guess(eta, guess, level(l + 1:l + 2), x, a, a3, rest)
    else
      call guess_compression(grid, g_inf, eta, n_terms, g, tau, n, l, u, level, node, x, a, a3, rest)
    end if
    previous = huge(1.0_dp)
    do sweep = 1, most_sweeps
      spacing = spacing_of(x)
      push = parabola_through(spacing, rest)
      !$omp simd
      do q = 1, 2
        d(q) = d(0) + x(q)*v(0) + integrated_twice(x(q), push)
        v(q) = v(0) + integrated(x(q), push)
      end do
      if (drag > 0) call resist(drag, x, spacing, a, a3, d, v)
      do q = 1, 2
        d(q) = max(d(q), 0.25_dp*a(q)**2)
        a(q) = sqrt(d(q))
        a3(q) = d(q)*a(q)
      end do
      call load_terms(n_terms, g_inf, resolved, g, tau, x, spacing, v, a, a3, loading(:, l:l + 2), held, stiffness, echo)
      call meet_edge(grid, u, drag, push, spacing, held, stiffness, echo, x, d(1:2), v(1:2), a(1:2), a3(1:2), rest(1:2), moved, &
                     lift, gain, change)
      call settle(sweep, change, closeness, previous, rate, done)
      if (done .or. (sweep >= enough_if_lost .and. change > 1)) exit
    end do
    failed = .not. done
    call follow_terms(n_terms, resolved, g, tau, x, v, a(1:2), moved, lift, gain, loading(:, l:l + 2), memory(:, l:l + 2), &
                      loading(:, 2*n - l - 1:2*n - l))
    do q = 1, 2
      level(l + q) = at_level(level(l)%time + x(q), x(q) - (q - 1)*x(1), d(q), v(q), eta*a(q)*v(q) - rest(q)*(1/mass_factor))
      node(l + q)%radius = a(q)
    end do
  end subroutine compression_panel

  !> Where the motion is not smooth polynomials may lead astray.
  pure function is_likely(first, second) result(yes)
    type(level_type), intent(in) :: first, second
    logical :: yes
    yes = min(first%step, second%step) > 0.1_dp*max(first%step, second%step) .and. min(first%depth, second%depth) > 0
  end function is_likely

  !> The guess, put to what the panel starts with.
  pure subroutine take_guess(eta, guess, level, x, a, a3, rest)
    real(dp), intent(in) :: eta
    type(level_type), intent(in) :: guess, level(2)
    real(dp), intent(out) :: x(2)
    real(dp), intent(inout) :: a(0:2), a3(0:2), rest(0:2)
    real(dp) :: offset
    integer(ip) :: q
    offset = rest(0) + mass_factor*(guess%force - eta*sqrt(guess%depth)*guess%velocity)
    x = [level(1)%step, level(1)%step + level(2)%step]
    do q = 1, 2
      a(q) = sqrt(level(q)%depth)
      a3(q) = level(q)%depth*a(q)
      rest(q) = offset - mass_factor*(level(q)%force - eta*a(q)*level(q)%velocity)
    end do
  end subroutine take_guess

  !> Where the panels before point to; at first touch D = s, and terms fade as int_0^x sqrt(s) exp(-(x-s)/tau) ds does, roughly.
  pure subroutine guess_compression(grid, g_inf, eta, n_terms, g, tau, n, l, u, level, node, x, a, a3, rest)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n, l
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), u(2)
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
        rest(q) = -mass_factor*(g_inf + sum(g/(1 + (2.0_dp/3.0_dp)*x(q)/tau)))*(2.0_dp/3.0_dp)*a3(q)
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

  !> What the dashpot does to depth and velocity. A strong one answers more depth with less velocity, hence less depth: Newton's step
  !> instead of the sweep's.
  pure subroutine resist(drag, x, spacing, a, a3, d, v)
    real(dp), intent(in) :: drag, x(2), a(0:2), a3(0:2)
    type(spacing_type), intent(in) :: spacing
    real(dp), intent(inout) :: d(0:2), v(0:2)
    type(parabola_type) :: cubes
    real(dp) :: once(2, 2), twice(2, 2), next
    integer(ip) :: q
    cubes = parabola_through(spacing, (2.0_dp/3.0_dp)*drag*(a3 - a3(0)))
    call shares(x, spacing, once, twice)
    do q = 1, 2
      next = a(q)**2 + (d(q) - integrated(x(q), cubes) - a(q)**2)/(1 + drag*once(q, q)*a(q))
      d(q) = max(next, 0.25_dp*a(q)**2)
      v(q) = v(q) - (2.0_dp/3.0_dp)*drag*(d(q)*sqrt(d(q)) - a3(0))
    end do
  end subroutine resist

  !> What accelerations add to depth and velocity if the dashpot answers.
  pure subroutine share_drag(drag, a, once, twice)
    real(dp), intent(in) :: drag, a(2)
    real(dp), intent(inout) :: once(2, 2), twice(2, 2)
    integer(ip) :: q
    do q = 1, 2
      twice(q, :) = twice(q, :)/(1 + drag*once(q, q)*a(q))
      once(q, :) = once(q, :) - drag*a(q)*twice(q, :)
    end do
  end subroutine share_drag

  !> A Newton step of both accelerations `rest` towards those by the forces `held`, at the same times, and of both times x along the
  !> path towards A (1-u^2) = 2 u radius D'; depth and velocity follow. moved: the step of x, lift and gain: what that of rest adds
  !> to depth and velocity, `change`: of velocities and, relatively, of times.
  pure subroutine meet_edge(grid, u, drag, push, spacing, held, stiffness, echo, x, d, v, a, a3, rest, moved, lift, gain, change)
    type(grid_type), intent(in) :: grid
    real(dp), intent(in) :: u(2), drag, held(2), stiffness(2), echo(2)
    type(parabola_type), intent(in) :: push    !! through rest
    type(spacing_type), intent(in) :: spacing  !! of x as it comes
    real(dp), intent(inout) :: x(2), d(2), v(2), a(2), a3(2), rest(2)
    real(dp), intent(out) :: moved(2), lift(2), gain(2), change
    real(dp) :: once(2, 2), twice(2, 2), step(2), unmet(2)
    real(dp) :: cosine, sine, acceleration, miss, dx
    integer(ip) :: q
    call shares(x, spacing, once, twice)
    if (drag > 0) call share_drag(drag, a, once, twice)
    call step_of_rest(held, stiffness, echo, a, once, twice, rest, step)
    !$omp simd private(cosine, sine, acceleration, miss, dx)
    do q = 1, 2
      cosine = (1 - u(q))*(1 + u(q))
      sine = 2*u(q)*grid%radius
      lift(q) = twice(q, 1)*step(1) + twice(q, 2)*step(2)
      gain(q) = once(q, 1)*step(1) + once(q, 2)*step(2)
      acceleration = rest(q) + step(q) - drag*a(q)*v(q)
      miss = 2*a(q)*(a(q)*cosine - sine*(v(q) + gain(q))) + cosine*lift(q)
      dx = -miss/(v(q)*cosine - 2*a(q)*sine*acceleration)
      dx = max(-0.5_dp*x(q), min(x(q), dx))
      unmet(q) = merge(abs(dx), 0.0_dp, abs(miss) > 2*rounding*a(q)*sine)
      v(q) = v(q) + gain(q)
      d(q) = max(d(q) + lift(q) + dx*(v(q) + 0.5_dp*dx*acceleration), tiny(1.0_dp))
      v(q) = v(q) + dx*acceleration
      a(q) = sqrt(d(q))
      a3(q) = d(q)*a(q)
      rest(q) = rest(q) + step(q) + dx*(push%slope + push%bend*(2*x(q) + dx))
      moved(q) = dx
      x(q) = x(q) + dx
    end do
    change = max(unmet(1)*spacing%first, unmet(2)*spacing%last, max(abs(step(1)), abs(step(2)))*x(2))
    if (x(2) <= x(1)) x(2) = 2*x(1)
  end subroutine meet_edge

  !> Of rest to where it is by the forces: depth and velocity answer to it (once, twice), and forces to them.
  pure subroutine step_of_rest(held, stiffness, echo, a, once, twice, rest, step)
    real(dp), intent(in) :: held(2), stiffness(2), echo(2), a(2), once(2, 2), twice(2, 2), rest(2)
    real(dp), intent(out) :: step(2)
    real(dp), dimension(2) :: answer_1, answer_2, miss
    integer(ip) :: q
    !$omp simd
    do q = 1, 2
      miss(q) = -mass_factor*held(q) - rest(q)
      answer_1(q) = mass_factor*a(q)*(stiffness(q)*twice(q, 1) + echo(q)*once(q, 1))
      answer_2(q) = mass_factor*a(q)*(stiffness(q)*twice(q, 2) + echo(q)*once(q, 2))
    end do
    step = answer(1 + answer_1(1), answer_2(1), answer_1(2), 1 + answer_2(2), miss)
  end subroutine step_of_rest

  !> Solution of two linear equations, the first with a and b, the second with c and d on the left.
  pure function answer(a, b, c, d, right) result(x)
    real(dp), intent(in) :: a, b, c, d, right(2)
    real(dp) :: x(2), inverse
    inverse = 1/(a*d - b*c)
    x(1) = (d*right(1) - b*right(2))*inverse
    x(2) = (a*right(2) - c*right(1))*inverse
  end function answer

  !> P_k at both points and the force without the dashpot's, `held`. It answers to the depth as if terms did not fade on the way
  !> (stiffness), or those that do to the velocity (echo), both times A.
  pure subroutine load_terms(n_terms, g_inf, resolved, g, tau, x, spacing, v, a, a3, loading, held, stiffness, echo)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, resolved  !! the panels of a run resolve longer relaxation times
    real(dp), intent(in) :: g(n_terms), tau(n_terms), x(2), v(0:2), a(0:2), a3(0:2)
    type(spacing_type), intent(in) :: spacing
    real(dp), intent(inout) :: loading(n_terms, 0:2)
    real(dp), dimension(2), intent(out) :: held, stiffness, echo
    type(parabola_type) :: cubes, sweeps
    type(memory_pair_type) :: m
    real(dp) :: load, before, share(2, 2)
    integer(ip) :: k, q
    held = (2.0_dp/3.0_dp)*g_inf*a3(1:2)
    stiffness = g_inf
    echo = 0
    if (n_terms == 0) return
    cubes = parabola_through(spacing, a3)
    sweeps = parabola_through(spacing, a*v)
    do k = 1, n_terms
      call remember_pair(x/tau(k), m)
      before = loading(k, 0)
      if (by_parts(x, tau(k), resolved)) then
        !$omp simd private(load)
        do q = 1, 2
          load = remembered(m%phi1(q), m%phi2(q), m%phi3(q), x(q), cubes)
          load = m%decay(q)*before + g(k)*loaded_by_parts(m%decay(q), load, tau(k), a3(0), a3(q))
          loading(k, q) = load
          held(q) = held(q) + load
          stiffness(q) = stiffness(q) + g(k)*m%phi1(q)
        end do
      else
        share = memory_shares(m, x, spacing)
        !$omp simd private(load)
        do q = 1, 2
          load = m%decay(q)*before + g(k)*remembered(m%phi1(q), m%phi2(q), m%phi3(q), x(q), sweeps)
          loading(k, q) = load
          held(q) = held(q) + load
          echo(q) = echo(q) + g(k)*max(share(q, q), 0.0_dp)
        end do
      end if
    end do
  end subroutine load_terms

  !> M_k at both points; P_k follows the last step of times and accelerations. fade: exp(-t/tau) from the first point to the second,
  !> and from the start to it, for the restitution, which passes them in that order.
  pure subroutine follow_terms(n_terms, resolved, g, tau, x, v, a, moved, lift, gain, loading, memory, fade)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: resolved, g(n_terms), tau(n_terms), x(2), v(0:2), a(2), moved(2), lift(2), gain(2)
    real(dp), intent(inout) :: loading(n_terms, 0:2), memory(n_terms, 0:2)
    real(dp), intent(out) :: fade(n_terms, 2)
    type(memory_pair_type) :: m
    type(spacing_type) :: spacing
    type(parabola_type) :: speeds
    real(dp), parameter :: faint = 1.0e-290_dp
    real(dp) :: share(2, 2)
    integer(ip) :: k
    if (n_terms == 0) return
    spacing = spacing_of(x)
    speeds = parabola_through(spacing, v)
    do k = 1, n_terms
      call remember_pair(x/tau(k), m)
      call remember_speeds(g(k), m, x, speeds, memory(k, :))
      loading(k, 1:2) = loading(k, 1:2) + moved*(g(k)*a*v(1:2) - loading(k, 1:2)/tau(k))
      if (by_parts(x, tau(k), resolved)) then
        loading(k, 1:2) = loading(k, 1:2) + g(k)*m%phi1*a*lift
      else
        share = memory_shares(m, x, spacing)
        loading(k, 1:2) = loading(k, 1:2) + g(k)*a*(share(:, 1)*gain(1) + share(:, 2)*gain(2))
      end if
      fade(k, 1) = 0
      if (m%decay(1) > faint) fade(k, 1) = m%decay(2)/m%decay(1)
      fade(k, 2) = m%decay(2)
    end do
  end subroutine follow_terms

  pure subroutine remember_speeds(g, m, x, speeds, memory)
    real(dp), intent(in) :: g, x(2)
    type(memory_pair_type), intent(in) :: m
    type(parabola_type), intent(in) :: speeds
    real(dp), intent(inout) :: memory(0:2)
    integer(ip) :: q
    do q = 1, 2
      memory(q) = m%decay(q)*memory(0) + g*remembered(m%phi1(q), m%phi2(q), m%phi3(q), x(q), speeds)
    end do
  end subroutine remember_speeds

  !> M_k at both points of the restitution; what is left at the second one of what its node had at its entry.
  pure subroutine remember_terms(n_terms, g, tau, x, v, memory, left)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms), x(2), v(0:2)
    real(dp), intent(inout) :: memory(n_terms, 0:2), left(n_terms)
    type(memory_pair_type) :: m
    type(parabola_type) :: speeds
    integer(ip) :: k
    if (n_terms == 0) return
    speeds = parabola_through(spacing_of(x), v)
    do k = 1, n_terms
      call remember_pair(x/tau(k), m)
      call remember_speeds(g(k), m, x, speeds, memory(k, :))
      left(k) = left(k)*m%decay(2)
    end do
  end subroutine remember_terms

  !> A D' ~ sqrt(s) is no parabola at first touch; int A D' exp is taken by parts, with (2/3) A^3 in its place, by the first
  !> panels, and by all of them where they resolve tau: a change between both within the run would show. With longer
  !> panels by parts would cancel.
  pure function by_parts(x, tau, resolved) result(yes)
    real(dp), intent(in) :: x(2), tau, resolved
    logical :: yes
    yes = x(2) < tau .and. tau > resolved
  end function by_parts

  !> `cubes`: what is remembered of A^3
  pure function loaded_by_parts(decay, cubes, tau, a3_start, a3) result(y)
    real(dp), intent(in) :: decay, cubes, tau, a3_start, a3
    real(dp) :: y
    y = (2.0_dp/3.0_dp)*(a3 - decay*a3_start - cubes/tau)
  end function loaded_by_parts

  !> Levels l+1 and l+2 of the restitution: times at which the edge is free, from the acceleration, which depends on
  !> the time only through the fading of what the compression left.
  pure subroutine restitution_panel(g_inf, eta, n_terms, g, tau, n, l, closeness, guessed, guess, rate, level, memory, loading, &
                                    node, failed)
    integer(ip), intent(in) :: n_terms, n, l
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), closeness
    logical, intent(in) :: guessed
    type(level_type), intent(in) :: guess  !! what level l was guessed to be
    real(dp), intent(inout) :: rate        !! see `settle`
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp), intent(inout) :: memory(n_terms, 0:2*n)
    real(dp), intent(inout) :: loading(n_terms, 0:2*n)  !! at the new levels what the nodes have left at the turning point, or here
    type(node_type), intent(in) :: node(0:n)
    logical, intent(out) :: failed
    real(dp) :: x(2), d(0:2), v(0:2), push(0:2), before(0:2), square(2), cube(2), change, previous
    type(spacing_type) :: spacing
    type(parabola_type) :: pushes
    integer(ip) :: q, sweep
    logical :: done

    d(0) = level(l)%depth
    v(0) = level(l)%velocity
    push(0) = -mass_factor*level(l)%force
    if (guessed .and. is_likely(level(l + 1), level(l + 2))) then
      x = [level(l + 1)%step, level(l + 1)%step + level(l + 2)%step]
      push(1:2) = push(0) - mass_factor*(level(l + 1:l + 2)%force - guess%force)
    else if (l == n) then
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
      square(q) = node(2*n - l - q)%radius**2
      cube(q) = square(q)*node(2*n - l - q)%radius
      if (l > n) loading(:, l + q) = loading(:, l + q)*loading(:, l)
    end do
    previous = huge(1.0_dp)
    do sweep = 1, most_sweeps
      spacing = spacing_of(x)
      pushes = parabola_through(spacing, push)
      !$omp simd
      do q = 1, 2
        d(q) = d(0) + x(q)*v(0) + integrated_twice(x(q), pushes)
        v(q) = v(0) + integrated(x(q), pushes)
      end do
      call free_edge(g_inf, eta, n_terms, g, tau, pushes, spacing, square, cube, memory(:, 2*n - l - 2:2*n - l - 1), &
                     loading(:, 2*n - l - 2:2*n - l - 1), memory(:, l:l + 2), loading(:, l + 1:l + 2), x, d, v, push(1:2), &
                     change)
      call settle(sweep, change, closeness, previous, rate, done)
      if (done .or. (sweep >= enough_if_lost .and. change > 1)) exit
    end do
    failed = .not. done
    call remember_terms(n_terms, g, tau, x, v, memory(:, l:l + 2), loading(:, l + 2))
    do q = 1, 2
      level(l + q) = at_level(level(l)%time + x(q), x(q) - (q - 1)*x(1), d(q), v(q), -push(q)*(1/mass_factor))
    end do
  end subroutine restitution_panel

  !> A step of both accelerations `push` to those by the forces, and a Newton step of both times x along the path to where the edge
  !> at X_j is free; depth and velocity follow. `change`: see `meet_edge`.
  pure subroutine free_edge(g_inf, eta, n_terms, g, tau, pushes, spacing, square, cube, memory_in, loading_in, memory, left, x, d, &
                            v, push, change)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), square(2), cube(2)  !! X_j^2, X_j^3
    type(parabola_type), intent(in) :: pushes
    type(spacing_type), intent(in) :: spacing
    real(dp), intent(in) :: memory_in(n_terms, 2), loading_in(n_terms, 2), memory(n_terms, 0:2), left(n_terms, 2)
    real(dp), intent(inout) :: x(2), d(0:2), v(0:2), push(2)
    real(dp), intent(out) :: change
    real(dp), dimension(2) :: excess, noise, slope, next, fading, moved, step, drift, answer_1, answer_2
    real(dp) :: once(2, 2), twice(2, 2), echo(2, 2), gain, lift
    integer(ip) :: q
    call weigh_edge(g_inf, eta, n_terms, g, tau, spacing, square, cube, memory_in, loading_in, memory, left, x, d, v, push, &
                    excess, noise, slope, next, fading, echo)
    call shares(x, spacing, once, twice)
    !$omp simd
    do q = 1, 2
      step(q) = -mass_factor*next(q) - push(q)
      drift(q) = mass_factor*fading(q) - pushes%slope - 2*x(q)*pushes%bend
      answer_1(q) = g_inf*twice(q, 1) + eta*once(q, 1) + (echo(q, 1)*once(1, 1) + echo(q, 2)*once(2, 1))
      answer_2(q) = g_inf*twice(q, 2) + eta*once(q, 2) + (echo(q, 1)*once(1, 2) + echo(q, 2)*once(2, 2))
    end do
    moved = answer(slope(1) + drift(1)*answer_1(1), drift(2)*answer_2(1), drift(1)*answer_1(2), slope(2) + drift(2)*answer_2(2), &
                   -(excess + answer_1*step(1) + answer_2*step(2)))
    if (max(slope(1), slope(2)) >= 0 .or. .not. all(abs(moved) <= 0.2_dp*x)) then ! far off one by one is surer
      moved = merge(x, max(-0.5_dp*x, min(x, -excess/slope)), slope >= 0)
      drift = -pushes%slope - pushes%bend*(2*x + moved)
    end if
    step = step + moved*drift
    !$omp simd private(gain, lift)
    do q = 1, 2
      lift = twice(q, 1)*step(1) + twice(q, 2)*step(2)
      gain = once(q, 1)*step(1) + once(q, 2)*step(2)
      noise(q) = merge(abs(moved(q)), 0.0_dp, abs(excess(q)) > rounding*noise(q))
      v(q) = v(q) + gain
      push(q) = push(q) + moved(q)*(pushes%slope + pushes%bend*(2*x(q) + moved(q))) + step(q)
      d(q) = d(q) + lift + moved(q)*(v(q) + 0.5_dp*moved(q)*push(q))
      v(q) = v(q) + moved(q)*push(q)
      x(q) = x(q) + moved(q)
    end do
    change = max(noise(1)*spacing%first, noise(2)*spacing%last, max(abs(step(1)), abs(step(2)))*x(2))
    if (x(2) <= x(1)) x(2) = 2*x(1)
  end subroutine free_edge

  !> What the edges lack of being free: excess of their elements' forces, its rounding, slope in time and answer to velocities at
  !> both points (echo), and the whole forces, next, of which so much fades a time.
  pure subroutine weigh_edge(g_inf, eta, n_terms, g, tau, spacing, square, cube, memory_in, loading_in, memory, left, x, d, v, &
                             push, excess, noise, slope, next, fading, echo)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms), square(2), cube(2)
    type(spacing_type), intent(in) :: spacing
    real(dp), intent(in) :: memory_in(n_terms, 2), loading_in(n_terms, 2)  !! of the compression, of the later node first
    real(dp), intent(in) :: memory(n_terms, 0:2)
    real(dp), intent(in) :: left(n_terms, 2)  !! of what the nodes had at their entry, at the start of the panel
    real(dp), intent(in) :: x(2), d(0:2), v(0:2), push(2)
    real(dp), dimension(2), intent(out) :: excess, noise, slope, next, fading
    real(dp), intent(out) :: echo(2, 2)
    type(parabola_type) :: speeds
    type(memory_pair_type) :: m
    real(dp) :: share(2, 2), faded, kept, held
    integer(ip) :: k, q
    !$omp simd
    do q = 1, 2
      excess(q) = g_inf*(d(q) - square(q)) + eta*v(q)
      noise(q) = g_inf*d(q) + eta
      slope(q) = g_inf*v(q) + eta*push(q)
      next(q) = (2.0_dp/3.0_dp)*g_inf*cube(q)
      fading(q) = 0
      echo(q, 1) = 0
      echo(q, 2) = 0
    end do
    if (n_terms > 0) speeds = parabola_through(spacing, v)
    do k = 1, n_terms
      call remember_pair(x/tau(k), m)
      share = memory_shares(m, x, spacing)
      !$omp simd private(faded, kept, held)
      do q = 1, 2
        faded = left(k, q)*m%decay(q)
        kept = faded*memory_in(k, 3 - q)
        held = m%decay(q)*memory(k, 0) + g(k)*remembered(m%phi1(q), m%phi2(q), m%phi3(q), x(q), speeds)
        excess(q) = excess(q) + (held - kept)
        noise(q) = noise(q) + (g(k)*d(q) + abs(kept))
        slope(q) = slope(q) + (g(k)*v(q) - (held - kept)/tau(k))
        next(q) = next(q) + faded*loading_in(k, 3 - q)
        fading(q) = fading(q) + faded*loading_in(k, 3 - q)/tau(k)
        echo(q, 1) = echo(q, 1) + g(k)*share(q, 1)
        echo(q, 2) = echo(q, 2) + g(k)*share(q, 2)
      end do
    end do
  end subroutine weigh_edge

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

  !> Sweeps end when the next one would change little, or when rounding lets them change less no more. What it would change is
  !> foretold from `rate`, the part of the change that was left by the last sweep, here or in the panels before.
  pure subroutine settle(sweep, change, closeness, previous, rate, yes)
    integer(ip), intent(in) :: sweep
    real(dp), intent(in) :: change, closeness
    real(dp), intent(inout) :: previous, rate
    logical, intent(out) :: yes
    real(dp), parameter :: stagnates_below = 1.0e-11_dp, enough_at_last = 1.0e-9_dp
    real(dp), parameter :: quicker = 0.3_dp  !! Newton's steps fall faster from step to step
    real(dp), parameter :: best_rate = 0.0003_dp  !! that is believed
    integer(ip), parameter :: many = 30
    if (sweep > 1) rate = max(quicker*change/previous, 0.1_dp*rate, best_rate)
    yes = change < closeness .or. (rate < 0.3_dp .and. change*max(rate, change) < closeness)
    if (.not. yes .and. sweep > 1) &
      yes = (change < stagnates_below .and. change >= previous) .or. (sweep >= many .and. change < enough_at_last)
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
