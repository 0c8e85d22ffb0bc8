!> Levels for the tangential problem from a normal problem that is known as polynomials (module rst_sync_curve).
!>
!> Nodes are where the edge is at y = u (c_1 + c_3 u^2 + c_5 u^4) for even u, odd as sums over nodes want it at the centre. The
!> slopes at both ends are those of a grid that is even in u = tan(phi/2), tan(phi) = A/(radius D') (grid_type of
!> rst_sync_grid). All levels of a phase are independent of each other, so they come in groups of lanes.
module rst_sync_sample
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_of_lanes, growth_of, lanes
  use rst_sync_grid, only: level_type, node_type, mass_factor, lag_of
  use rst_sync_dense, only: trace_type
  implicit none (type, external)
  private
  public :: sample_curve

  integer(ip), parameter :: highest = 16  !! degree of the polynomials, at most
  integer(ip), parameter :: most_steps = 20
  real(dp), parameter :: settling = 2.9_dp      !! of springs behind the turning point, in relaxation times
  real(dp), parameter :: sharp(2:4) = [1.0e-3_dp, 3.0e-5_dp, 1.0e-6_dp] !! part of a time that Newton's last step may be, by degree
  real(dp), parameter :: felt_until = 36        !! relaxation times
  real(dp), parameter :: at_once = 300          !! of them in the restitution, where springs do as dashpots

contains

  !> n levels a phase. turn, spread, curve, layer: see follow_curve. failed: a time was not found.
  pure subroutine sample_curve(p, turn, spread, g_inf, n_terms, g, tau, curve, layer, n, level, trace, node, failed)
    integer(ip), intent(in) :: p, n_terms, n
    real(dp), intent(in) :: turn(4), spread(2), g_inf, g(n_terms), tau(n_terms)
    real(dp), intent(in) :: curve(0:p, 5 + 3*n_terms), layer(n_terms, 2)
    type(level_type), intent(out) :: level(0:2*n)
    type(trace_type), intent(out) :: trace(n_terms, 0:2*n)
    type(node_type), intent(out) :: node(0:n)
    logical, intent(out) :: failed
    real(dp) :: c(3), rise(0:highest)
    integer(ip) :: first, k
    failed = .false.
    call derive(p, curve(:, 1), rise)
    c(1) = max(1.3_dp, min(spread(1), 1.9_dp)) ! beyond, y would not rise everywhere
    c(3) = (max(0.15_dp, min(spread(2), 0.5_dp)) - 3 + 2*c(1))/2
    c(2) = 1 - c(1) - c(3)
    level(0) = level_type(0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
    node(0) = node_type(0.0_dp, c(1)*sqrt(turn(1))*(1/real(n, dp)))
    do k = 1, n_terms
      trace(k, 0) = trace_type(0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
    end do
    do first = 1, n, lanes
      call sample_compression(p, turn(1), c, g_inf, n_terms, tau, curve, layer(:, 1), rise(:p), n, first, level, trace, node)
    end do
    do first = 1, n, lanes
      if (turn(2) > 0) then
        call find_restitution(p, turn, c, g_inf, n_terms, g, tau, curve(:, 4 + 2*n_terms:), layer(:, 2), n, first, node, &
                              level, trace, failed)
        if (failed) return
      else
        call sample_restitution(p, c, g_inf, n_terms, curve(:, 3 + 2*n_terms:), n, first, node, level, trace)
      end if
    end do
    do first = 1, 2*n, lanes
      call fade_in_steps(n_terms, g, tau, min(lanes, 2*n + 1 - first), level(first - 1:), trace(:, first:))
    end do
    call fade_away(n_terms, n, level, trace)
  end subroutine sample_curve

  !> The series of the derivative by y = (1 + x)/2.
  pure subroutine derive(p, c, slope)
    integer(ip), intent(in) :: p
    real(dp), intent(in) :: c(0:p)
    real(dp), intent(out) :: slope(0:highest)
    integer(ip) :: k
    slope(p) = 0
    slope(p - 1) = 4*p*c(p)
    do k = p - 2, 0, -1
      slope(k) = slope(k + 2) + 4*(k + 1)*c(k + 1)
    end do
    slope(0) = slope(0)*0.5_dp
  end subroutine derive

  !> y, and dy/dj, of the nodes j to j + lanes - 1, or those from j inwards.
  pure subroutine place_lanes(c, n, j, inwards, y, slope)
    integer(ip), intent(in) :: n, j
    real(dp), intent(in) :: c(3)
    logical, intent(in) :: inwards
    real(dp), dimension(lanes), intent(out) :: y, slope
    real(dp) :: u
    integer(ip) :: q
    do q = 1, lanes
      u = real(merge(max(j - q + 1, 0_ip), min(j + q - 1, n), inwards), dp)/real(n, dp)
      y(q) = u*(c(1) + u*u*(c(2) + u*u*c(3)))
      slope(q) = (c(1) + u*u*(3*c(2) + u*u*(5*c(3))))*(1/real(n, dp))
    end do
  end subroutine place_lanes

  !> Chebyshev's polynomials.
  pure subroutine polynomials(p, x, t)
    integer(ip), intent(in) :: p
    real(dp), intent(in) :: x(lanes)
    real(dp), intent(out) :: t(lanes, 0:highest)
    integer(ip) :: k, q
    t(:, 0) = 1
    t(:, 1) = x
    do k = 2, p
      !$omp simd
      do q = 1, lanes
        t(q, k) = 2*x(q)*t(q, k - 1) - t(q, k - 2)
      end do
    end do
  end subroutine polynomials

  pure function summed(p, c, t) result(y)
    integer(ip), intent(in) :: p
    real(dp), intent(in) :: c(0:p), t(lanes, 0:highest)
    real(dp) :: y(lanes), others(lanes)
    integer(ip) :: k, q
    y = c(0)
    others = 0 ! see moments of the modules rst_sync_going_*
    do k = 1, p, 2
      !$omp simd
      do q = 1, lanes
        y(q) = y(q) + c(k)*t(q, k)
        others(q) = others(q) + c(k + 1)*t(q, k + 1)
      end do
    end do
    y = y + others
  end function summed

  pure subroutine sample_compression(p, turn, c, g_inf, n_terms, tau, curve, layer, rise, n, first, level, trace, node)
    integer(ip), intent(in) :: p, n_terms, n, first
    real(dp), intent(in) :: turn, c(3), g_inf, tau(n_terms), curve(0:p, 2 + 2*n_terms), layer(n_terms), rise(0:p)
    type(level_type), intent(inout) :: level(0:2*n)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    type(node_type), intent(inout) :: node(0:n)
    real(dp), dimension(lanes) :: y, slope, depth, velocity, radius, width, force, fresh, held
    real(dp) :: t(lanes, 0:highest)
    integer(ip) :: q, k, l, last
    last = min(lanes, n + 1 - first)
    call place_lanes(c, n, first, .false., y, slope)
    call polynomials(p, 2*y - 1, t)
    velocity = summed(p, curve(:, 2), t)
    radius = summed(p, curve(:, 1), t)
    width = (radius + y*summed(p, rise, t))*slope
    radius = radius*y
    depth = radius*radius
    force = radius*((2.0_dp/3.0_dp)*g_inf*depth)
    fresh = g_inf*depth
    do k = 1, n_terms
      held = summed(p, curve(:, 2 + k), t)
      force = force + held
      do q = 1, last
        trace(k, first + q - 1)%loading = held(q)
      end do
      held = summed(p, curve(:, 2 + n_terms + k), t)
      if (abs(layer(k)) > 0) held = held + layer(k)/growth_of(y*y*(turn/tau(k)))
      fresh = fresh + held
      do q = 1, last
        trace(k, first + q - 1)%memory = held(q)
        trace(k, first + q - 1)%fade = 1
      end do
    end do
    do q = 1, last
      l = first + q - 1
      level(l) = level_type(turn*y(q)*y(q), turn*slope(q), depth(q), velocity(q), force(q), fresh(q), 0.0_dp, 0.0_dp)
      node(l) = node_type(radius(q), width(q))
    end do
  end subroutine sample_compression

  !> The restitution by edges.
  pure subroutine sample_restitution(p, c, g_inf, n_terms, curve, n, first, node, level, trace)
    integer(ip), intent(in) :: p, n_terms, n, first
    real(dp), intent(in) :: c(3), g_inf, curve(0:p, 3 + n_terms)
    type(node_type), intent(in) :: node(0:n)
    type(level_type), intent(inout) :: level(0:2*n)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    real(dp), dimension(lanes) :: y, slope, time, depth, velocity, held
    real(dp) :: t(lanes, 0:highest), radius
    integer(ip) :: q, k, l, last
    last = min(lanes, n + 1 - first)
    call place_lanes(c, n, n - first, .true., y, slope)
    call polynomials(p, 1 - 2*y, t)
    time = summed(p, curve(:, 1), t)
    depth = summed(p, curve(:, 2), t)
    velocity = summed(p, curve(:, 3), t)
    do k = 1, n_terms
      held = summed(p, curve(:, 3 + k), t)
      do q = 1, last
        trace(k, n + first + q - 1)%memory = held(q)
      end do
    end do
    do q = 1, last
      l = n + first + q - 1
      radius = node(2*n - l)%radius
      level(l) = level_type(time(q), 0.0_dp, depth(q), velocity(q), (2.0_dp/3.0_dp)*g_inf*radius**3, g_inf*radius**2, &
                            0.0_dp, 0.0_dp)
    end do
  end subroutine sample_restitution

  !> The same by time: where the edge is on the nodes is found by Newton's steps.
  pure subroutine find_restitution(p, turn, c, g_inf, n_terms, g, tau, curve, layer, n, first, node, level, trace, failed)
    integer(ip), intent(in) :: p, n_terms, n, first
    real(dp), intent(in) :: turn(4), c(3), g_inf, g(n_terms), tau(n_terms), curve(0:p, 2 + n_terms), layer(n_terms)
    type(node_type), intent(in) :: node(0:n)
    type(level_type), intent(inout) :: level(0:2*n)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    real(dp), dimension(lanes) :: y, slope, ago, passed, radius, depth, velocity, force, excess, rate, dx
    logical, intent(out) :: failed
    real(dp) :: sharpness, beyond
    integer(ip) :: q, k, l, last, step
    last = min(lanes, n + 1 - first)
    call place_lanes(c, n, n - first, .true., y, slope)
    do q = 1, lanes
      radius(q) = node(max(n - first - q + 1, 0_ip))%radius
    end do
    ago = turn(1)*(1 - y*y)
    passed = guess_times(turn, lag_of(n_terms, g, tau, turn(1)), ago)
    sharpness = sharp(min(p/4, 4_ip))
    do step = 1, most_steps
      call weigh_edges(p, turn(2), g_inf, n_terms, g, tau, curve, layer, n, first, last, radius, ago, passed, trace, depth, &
                       velocity, force, excess, rate)
      beyond = -huge(1.0_dp)
      !$omp simd reduction(max: beyond)
      do q = 1, lanes
        dx(q) = max(-0.5_dp*passed(q), min(passed(q), -excess(q)/min(rate(q), -1.0e-100_dp)))
        beyond = max(beyond, abs(dx(q)) - sharpness*passed(q))
      end do
      failed = .not. beyond < 0
      if (.not. failed) exit
      passed = min(passed + dx, turn(2))
    end do
    if (failed) return
    do q = 1, last
      l = n + first + q - 1
      do k = 1, n_terms
        if (turn(2) < at_once*tau(k)) then
          trace(k, l)%memory = trace(k, l)%memory + dx(q)*(g(k)*velocity(q) - trace(k, l)%memory*(1/tau(k)))
        else
          trace(k, l)%memory = trace(k, l)%memory + dx(q)*(g(k)*tau(k))*force(q)
        end if
      end do
      level(l) = level_type(turn(1) + (passed(q) + dx(q)), 0.0_dp, depth(q) + dx(q)*velocity(q), velocity(q) + dx(q)*force(q), &
                            (2.0_dp/3.0_dp)*g_inf*radius(q)**3, g_inf*radius(q)**2, 0.0_dp, 0.0_dp)
    end do
  end subroutine find_restitution

  !> Times since the turning point at which the edge is back where it was so long before it, nearly (see turn_round of the modules
  !> rst_sync_fading_*), or as long, where springs have not settled yet; T at the end.
  pure function guess_times(turn, lag, ago) result(passed)
    real(dp), intent(in) :: turn(4), lag, ago(lanes)
    real(dp) :: passed(lanes), delay, square, x, unsettled
    integer(ip) :: q
    delay = turn(3)/turn(2)
    unsettled = 1/max(settling*lag, 1.0e-100_dp)
    !$omp simd private(square, x)
    do q = 1, lanes
      square = (1 + 2*delay)*(ago(q)/turn(1))**2
      x = square/(sqrt(square + delay*delay) + delay)
      square = max(0.3_dp*square, square - (1 + 2*delay)*2*turn(4)*delay*x*x*(1 - x)/(x + 0.06_dp))
      x = square/(sqrt(square + delay*delay) + delay)
      passed(q) = turn(2)*x + (ago(q) - turn(2)*x)*max(0.0_dp, 1 - ago(q)*unsettled)*(1 - ago(q)/turn(1))
      passed(q) = min(passed(q), turn(2)) ! as far as the series go
    end do
  end function guess_times

  !> What the edges lack of being free at those times, and its slope in time; the motion then. force: D''.
  pure subroutine weigh_edges(p, lasts, g_inf, n_terms, g, tau, curve, layer, n, first, last, radius, ago, passed, trace, &
                              depth, velocity, force, excess, rate)
    integer(ip), intent(in) :: p, n_terms, n, first, last
    real(dp), intent(in) :: lasts, g_inf, g(n_terms), tau(n_terms), curve(0:p, 2 + n_terms), layer(n_terms)
    real(dp), dimension(lanes), intent(in) :: radius, ago, passed
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    real(dp), dimension(lanes), intent(out) :: depth, velocity, force, excess, rate
    real(dp), dimension(lanes) :: memory, fading, loading, kept
    real(dp) :: t(lanes, 0:highest), drag
    integer(ip) :: k, q, l
    call polynomials(p, 1 - 2*sqrt(max(0.0_dp, 1 - passed*(1/lasts))), t)
    depth = summed(p, curve(:, 1), t)
    velocity = summed(p, curve(:, 2), t)
    force = (2.0_dp/3.0_dp)*g_inf*radius*radius*radius
    excess = g_inf*(depth - radius*radius)
    rate = g_inf*velocity
    drag = 0
    do k = 1, n_terms
      memory = summed(p, curve(:, 2 + k), t)
      excess = excess + memory
      if (lasts < at_once*tau(k)) then
        rate = rate + (g(k)*velocity - memory*(1/tau(k)))
      else
        drag = drag + g(k)*tau(k)
      end if
      if (abs(layer(k)) > 0 .and. passed(1) < felt_until*tau(k)) then
        fading = layer(k)/growth_of(passed*(1/tau(k)))
        memory = memory + fading
        excess = excess + fading
        rate = rate - fading*(1/tau(k))
      end if
      if (passed(1) + ago(1) < felt_until*tau(k)) then
        do q = 1, lanes
          l = max(n - first - q + 1, 0_ip)
          loading(q) = trace(k, l)%loading
          kept(q) = trace(k, l)%memory
        end do
        fading = 1/growth_of((passed + ago)*(1/tau(k)))
        force = force + fading*loading
        excess = excess - fading*kept
        rate = rate + fading*kept*(1/tau(k))
      end if
      do q = 1, last
        trace(k, n + first + q - 1)%memory = memory(q)
      end do
    end do
    force = -mass_factor*force
    rate = rate + drag*force
  end subroutine weigh_edges

  !> The steps that end at `count` levels behind the first one given.
  pure subroutine fade_in_steps(n_terms, g, tau, count, level, trace)
    integer(ip), intent(in) :: n_terms, count
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    type(level_type), intent(inout) :: level(0:count)
    type(trace_type), intent(inout) :: trace(n_terms, count)
    real(dp), dimension(lanes) :: h, z, gh, decay, phi1, phi2, phi3
    integer(ip) :: q, k
    h = 0
    do q = 1, count
      h(q) = level(q)%time - level(q - 1)%time
      level(q)%step = h(q)
    end do
    do k = 1, n_terms
      z = h*(1/tau(k))
      call memory_of_lanes(z, decay, phi1, phi2, phi3)
      gh = g(k)*h
      phi3 = gh*h*h*(2*phi3 - phi2)
      phi1 = gh*(phi1 - phi2)
      phi2 = gh*phi2
      do q = 1, count
        trace(k, q)%decay = decay(q)
        trace(k, q)%from_start = phi1(q)
        trace(k, q)%from_end = phi2(q)
        trace(k, q)%from_bend = phi3(q)
      end do
    end do
  end subroutine fade_in_steps

  !> What is left in the restitution of what the nodes had at their entry.
  pure subroutine fade_away(n_terms, n, level, trace)
    integer(ip), intent(in) :: n_terms, n
    type(level_type), intent(inout) :: level(0:2*n)
    type(trace_type), intent(inout) :: trace(n_terms, 0:2*n)
    integer(ip) :: k, l, j
    do k = 1, n_terms
      do l = n + 1, 2*n
        j = 2*n - l
        trace(k, l)%fade = trace(k, l - 1)%fade*(trace(k, j + 1)%decay*trace(k, l)%decay)
        trace(k, l)%loading = trace(k, l)%fade*trace(k, j)%loading
        level(l)%force = level(l)%force + trace(k, l)%loading
        level(l)%fresh = level(l)%fresh + trace(k, l)%fade*trace(k, j)%memory
      end do
    end do
  end subroutine fade_away
end module rst_sync_sample
