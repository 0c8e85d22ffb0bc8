!> Levels for the tangential problem from a normal problem that is known as polynomials (module rst_sync_curve).
!>
!> Nodes are where the edge is at y = u (c_1 + c_3 u^2 + c_5 u^4) for even u, odd as sums over nodes want it at the centre. The
!> slopes at both ends are those of a grid that is even in u = tan(phi/2), tan(phi) = A/(radius D') (grid_type of
!> rst_sync_grid). All levels of a phase are independent of each other, so they come in groups of lanes.
module rst_sync_sample
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_type, memory_of, gentle_memory, series_below
  use rst_sync_grid, only: level_type, node_type
  use rst_sync_dense, only: trace_type
  implicit none (type, external)
  private
  public :: sample_curve

  integer(ip), parameter :: lanes = 8, highest = 16  !! degree of the polynomials, at most

contains

  !> n levels a phase. turn: time of the turning point; curve: see follow_curve.
  pure subroutine sample_curve(p, turn, spread, g_inf, n_terms, g, tau, curve, n, level, trace, node)
    integer(ip), intent(in) :: p, n_terms, n
    real(dp), intent(in) :: turn, spread(2), g_inf, g(n_terms), tau(n_terms), curve(0:p, 5 + 3*n_terms)
    type(level_type), intent(out) :: level(0:2*n)
    type(trace_type), intent(out) :: trace(n_terms, 0:2*n)
    type(node_type), intent(out) :: node(0:n)
    real(dp) :: c(3), rise(0:highest)
    integer(ip) :: first
    call derive(p, curve(:, 1), rise)
    c(1) = max(1.3_dp, min(spread(1), 1.9_dp)) ! beyond, y would not rise everywhere
    c(3) = (max(0.15_dp, min(spread(2), 0.5_dp)) - 3 + 2*c(1))/2
    c(2) = 1 - c(1) - c(3)
    do first = 0, n, lanes
      call sample_compression(p, turn, c, g_inf, n_terms, curve, rise(:p), n, first, level, trace, node)
    end do
    do first = 1, n, lanes
      call sample_restitution(p, c, g_inf, n_terms, curve(:, 3 + 2*n_terms:), n, first, node, level, trace)
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
    real(dp) :: y(lanes)
    integer(ip) :: k, q
    y = c(0)
    do k = 1, p
      !$omp simd
      do q = 1, lanes
        y(q) = y(q) + c(k)*t(q, k)
      end do
    end do
  end function summed

  pure subroutine sample_compression(p, turn, c, g_inf, n_terms, curve, rise, n, first, level, trace, node)
    integer(ip), intent(in) :: p, n_terms, n, first
    real(dp), intent(in) :: turn, c(3), g_inf, curve(0:p, 2 + 2*n_terms), rise(0:p)
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
    force = (2.0_dp/3.0_dp)*g_inf*depth*radius
    fresh = g_inf*depth
    do k = 1, n_terms
      held = summed(p, curve(:, 2 + k), t)
      force = force + held
      do q = 1, last
        trace(k, first + q - 1)%loading = held(q)
      end do
      held = summed(p, curve(:, 2 + n_terms + k), t)
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
    if (first == 0) then
      level(0) = level_type(0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
      do k = 1, n_terms
        trace(k, 0) = trace_type(0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp)
      end do
    end if
  end subroutine sample_compression

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

  !> The steps that end at `count` levels behind the first one given.
  pure subroutine fade_in_steps(n_terms, g, tau, count, level, trace)
    integer(ip), intent(in) :: n_terms, count
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    type(level_type), intent(inout) :: level(0:count)
    type(trace_type), intent(inout) :: trace(n_terms, count)
    real(dp), dimension(lanes) :: h, z, gh, decay, phi1, phi2, phi3
    type(memory_type) :: m
    integer(ip) :: q, k
    h = 0
    do q = 1, count
      h(q) = level(q)%time - level(q - 1)%time
      level(q)%step = h(q)
    end do
    do k = 1, n_terms
      z = h*(1/tau(k))
      if (maxval(z) < series_below) then
        call gentle_memory(lanes, z, decay, phi1, phi2, phi3)
      else
        do q = 1, count
          m = memory_of(z(q))
          decay(q) = m%decay
          phi1(q) = m%phi1
          phi2(q) = m%phi2
          phi3(q) = m%phi3
        end do
      end if
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
