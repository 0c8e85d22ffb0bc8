!> Two levels of the restitution of the normal problem (THEORY 4.5, module rst_sync_levels).
module rst_sync_restitution
  use rst_precision, only: dp, ip
  use rst_bounded, only: bounded
  use rst_memory, only: memory_pair_type, remember_pair, parabola_type, spacing_type, spacing_of, parabola_through, remembered, &
                        integrated, integrated_twice, shares, memory_shares
  use rst_sync_grid, only: level_type, node_type, at_level, mass_factor
  use rst_sync_guess, only: is_likely, steps_ahead, ahead, first_return
  use rst_sync_sweeps, only: settle, is_lost, answer, most_sweeps, rounding, shortest
  use rst_sync_loading, only: remember_speeds
  implicit none (type, external)
  private
  public :: restitution_panel

contains

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
    failed = .true.
    do sweep = 1, most_sweeps
      if (x(1) < shortest) return
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
      if (done .or. is_lost(sweep, change)) exit
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
      moved = merge(x, bounded(-excess, slope, -0.5_dp*x, x), slope >= 0)
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

  !> M_k at both points of the restitution; what is left at the second one of what its node had at its entry.
  pure subroutine remember_terms(n_terms, g, tau, x, v, memory, left)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms), x(2), v(0:2)
    real(dp), intent(inout) :: memory(n_terms, 0:2), left(n_terms)
    type(memory_pair_type) :: m
    type(parabola_type) :: speeds
    real(dp) :: remembered_now(0:2)
    integer(ip) :: k
    if (n_terms == 0) return
    speeds = parabola_through(spacing_of(x), v)
    do k = 1, n_terms
      call remember_pair(x/tau(k), m)
      remembered_now = memory(k, :)
      call remember_speeds(g(k), m, x, speeds, remembered_now)
      memory(k, :) = remembered_now
      left(k) = left(k)*m%decay(2)
    end do
  end subroutine remember_terms
end module rst_sync_restitution
