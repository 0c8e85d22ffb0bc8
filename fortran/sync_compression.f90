!> Two levels of the compression of the normal problem (THEORY 4.4, module rst_sync_levels).
module rst_sync_compression
  use rst_precision, only: dp, ip
  use rst_bounded, only: bounded
  use rst_memory, only: parabola_type, spacing_type, spacing_of, parabola_through, integrated, integrated_twice, shares
  use rst_sync_grid, only: grid_type, level_type, node_type, at_level, mass_factor
  use rst_sync_guess, only: is_likely, steps_ahead, ahead
  use rst_sync_sweeps, only: settle, is_lost, answer, most_sweeps, rounding
  use rst_sync_loading, only: load_terms, follow_terms, longest_panel, first_levels
  implicit none (type, external)
  private
  public :: compression_panel

contains

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
      if (done .or. is_lost(sweep, change)) exit
    end do
    failed = .not. done
    call follow_terms(n_terms, resolved, g, tau, x, v, a(1:2), moved, lift, gain, loading(:, l:l + 2), memory(:, l:l + 2), &
                      loading(:, 2*n - l - 1:2*n - l))
    do q = 1, 2
      level(l + q) = at_level(level(l)%time + x(q), x(q) - (q - 1)*x(1), d(q), v(q), eta*a(q)*v(q) - rest(q)*(1/mass_factor))
      node(l + q)%radius = a(q)
    end do
  end subroutine compression_panel

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

  !> What the dashpot does to depth and velocity. A strong one answers more depth with less velocity, hence less depth: Newton's
  !> step instead of the sweep's.
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
      dx = bounded(-miss, v(q)*cosine - 2*a(q)*sine*acceleration, -0.5_dp*x(q), x(q))
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
end module rst_sync_compression
