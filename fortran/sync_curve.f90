!> The normal problem of the method `sync` where nothing in it is abrupt: one polynomial a phase.
!>
!> The compression is smooth in the root of time: s = s_m y^2, with y from 0 at first touch to 1 at the turning point, and with
!> P_k and M_k as in THEORY 4.4 and 4.5
!>   D' = 1 - J(y)/J(1),  J = int_0^y D'' 2y dy,  s_m = -1/J(1),   D = s_m int_0^y D' 2y dy.
!> The restitution is smooth in the y at which the compression had the same edge: s = s_m (2 - y^2) if all is elastic. Both are
!> found at Chebyshev's points by sweeps, the restitution as the times at which the edge is free (rst_sync_levels). Memory is
!> taken with exp(s/tau) in the integrand, so that a phase is to last no more than a few relaxation times.
!>
!> Columns of the solution at the points, `going` (compression): D, D', g_k P_k, g_k M_k; `coming` (restitution, from the turning
!> point on): s, D, D', g_k M_k. Columns of `curve`, their series: A/y, D', g_k P_k, g_k M_k; s, D, D', g_k M_k.
module CURVE
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: mass_factor
  use POINTS, only: p, place, integral, slope, series
  implicit none (type, external)
  private
  public :: follow_curve

  integer(ip), parameter :: most_sweeps = 30
  real(dp), parameter :: longest = 4.0_dp, longest_at_all = 6.0_dp  !! a phase, in relaxation times: on the way, the restitution
  real(dp), parameter :: best_rate = 0.05_dp                        !! of sweeps, that is believed
  integer :: k, l
  real(dp), parameter :: y(p) = 0.5_dp*(1 + place(1:p)), square(p) = y*y
  !> int_0^y f 2y dy by values of f; nothing comes from the first point.
  real(dp), parameter :: moment(p, p) = reshape([((integral(l, k)*y(k), l=1, p), k=1, p)], int([p, p]))
  !> D of an elastic impact over its largest, nearly, and s_m over the same.
  real(dp), parameter :: elastic_time = 1.472_dp, elastic(p) = elastic_time*square*(1 - 0.148_dp*(elastic_time*square)**2)

contains

  !> depth: the largest, roughly. closeness: see normal_levels. turn: s_m. spread: slopes of y over u = tan(phi/2) at both ends, for
  !> rst_sync_sample. left_out: by series.
  pure subroutine follow_curve(depth, g_inf, n_terms, g, tau, closeness, turn, spread, going, coming, curve, left_out, failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: depth, g_inf, g(n_terms), tau(n_terms), closeness
    real(dp), intent(out) :: turn, spread(2), left_out
    real(dp), intent(out) :: going(0:p, 2 + 2*n_terms), coming(0:p, 3 + n_terms), curve(0:p, 5 + 3*n_terms)
    logical, intent(out) :: failed
    real(dp) :: radius, force
    integer(ip) :: k
    call compress(depth, g_inf, n_terms, g, tau, closeness, turn, going, failed)
    if (failed) return
    call come_back(g_inf, n_terms, g, tau, closeness, turn, going, curve, coming, failed)
    if (failed) return
    call fit(n_terms, turn, going, coming, curve)
    left_out = lack(n_terms, turn, curve)
    radius = sqrt(going(p, 1))
    force = (2.0_dp/3.0_dp)*g_inf*radius*going(p, 1)
    do k = 1, n_terms
      force = force + going(p, 2 + k)
    end do
    spread = [2*sqrt(depth/turn), radius/(2*turn*sqrt(depth)*mass_factor*force)]
  end subroutine follow_curve

  !> exp(z), for z up to 4 or a little more.
  elemental function growth_of(z) result(growth)
    real(dp), intent(in) :: z
    real(dp) :: growth, x
    real(dp), parameter :: c(2:11) = [(1/gamma(k + 1.0_dp), k=2, 11)]
    x = z*0.0625_dp
    growth = x*x*(c(2) + x*(c(3) + x*(c(4) + x*(c(5) + x*(c(6) + x*(c(7) + x*(c(8) + x*(c(9) + x*(c(10) + x*c(11))))))))))
    growth = 1 + (x + growth)
    growth = growth*growth
    growth = growth*growth
    growth = growth*growth
    growth = growth*growth
  end function growth_of

  !> exp(s/tau) in the compression, which lasts so many relaxation times.
  pure subroutine grow(lasts, growth)
    real(dp), intent(in) :: lasts
    real(dp), intent(out) :: growth(p)
    integer(ip) :: l
    !$omp simd
    do l = 1, p
      growth(l) = growth_of(square(l)*lasts)
    end do
  end subroutine grow

  pure function moments(f) result(sums)
    real(dp), intent(in) :: f(p)
    real(dp) :: sums(p)
    integer(ip) :: l, n
    sums = 0
    do n = 1, p
      !$omp simd
      do l = 1, p
        sums(l) = sums(l) + moment(l, n)*f(n)
      end do
    end do
  end function moments

  pure function integrated(start, f) result(sums)
    real(dp), intent(in) :: start, f(0:p)
    real(dp) :: sums(p)
    integer(ip) :: l, n
    sums = start
    do n = 0, p
      !$omp simd
      do l = 1, p
        sums(l) = sums(l) + integral(l, n)*f(n)
      end do
    end do
  end function integrated

  !> s_m goes like the force to a negative power, 3/2 for springs; a step of a power of 0.4 takes that into account.
  pure subroutine compress(depth, g_inf, n_terms, g, tau, closeness, turn, going, failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: depth, g_inf, g(n_terms), tau(n_terms), closeness
    real(dp), intent(out) :: turn, going(0:p, 2 + 2*n_terms)
    logical, intent(out) :: failed
    real(dp), dimension(p) :: a, d, v, force, growth, next
    real(dp) :: change, previous, rate, before, excess, part, moved
    integer(ip) :: sweep, k, l
    failed = .true.
    turn = elastic_time*depth
    d = depth*elastic
    a = sqrt(d)
    do k = 1, n_terms
      going(1:, 2 + k) = g(k)*(2.0_dp/3.0_dp)*d*a/(1 + square*(0.6_dp*turn/tau(k)))
    end do
    previous = huge(1.0_dp)
    rate = 0.1_dp
    do sweep = 1, most_sweeps
      !$omp simd
      do l = 1, p
        force(l) = (2.0_dp/3.0_dp)*g_inf*a(l)*d(l)
      end do
      do k = 1, n_terms
        !$omp simd
        do l = 1, p
          force(l) = force(l) + going(l, 2 + k)
        end do
      end do
      next = moments(force)
      before = turn
      part = 1/next(p)
      excess = part/(mass_factor*turn) - 1
      turn = turn*((1 + 0.7_dp*excess)/(1 + 0.3_dp*excess))
      !$omp simd
      do l = 1, p
        v(l) = 1 - next(l)*part
      end do
      next = moments(v)
      change = 0
      !$omp simd reduction(max: change)
      do l = 1, p
        next(l) = turn*next(l)
        change = max(change, abs(next(l) - d(l)))
        d(l) = next(l)
        a(l) = sqrt(d(l))
      end do
      change = max(change, abs(turn - before))*(1/turn)
      if (.not. (minval(d) > 0 .and. turn < 2*before)) return
      do k = 1, n_terms
        if (.not. turn < tau(k)*longest) return
        call grow(turn/tau(k), growth)
        next = moments(a*v*growth)
        moved = 0
        !$omp simd reduction(max: moved)
        do l = 1, p
          next(l) = (g(k)*turn)*next(l)/growth(l)
          moved = max(moved, abs(next(l) - going(l, 2 + k)))
          going(l, 2 + k) = next(l)
        end do
        change = max(change, moved*turn)
      end do
      if (sweep > 1) rate = max(change/previous, best_rate)
      if (change*min(rate, 1.0_dp) < closeness) exit
      previous = change
    end do
    if (sweep > most_sweeps) return
    failed = .false.
    do k = 1, n_terms
      call grow(turn/tau(k), growth)
      going(1:, 2 + n_terms + k) = (g(k)*turn)*moments(v*growth)/growth
    end do
    going(0, :) = 0
    going(0, 2) = 1
    going(1:, 1) = d
    going(1:, 2) = v
  end subroutine compress

  !> Columns of `left`, by terms: what the compression left of g P and g M of each edge at the turning point; exp(time since
  !> then/tau).
  pure subroutine come_back(g_inf, n_terms, g, tau, closeness, turn, going, left, coming, failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, g(n_terms), tau(n_terms), closeness, turn, going(0:p, 2 + 2*n_terms)
    real(dp), intent(out) :: left(0:p, 5 + 3*n_terms), coming(0:p, 3 + n_terms)
    logical, intent(out) :: failed
    real(dp) :: moved(p), force(0:p), change, previous, rate
    integer(ip) :: sweep, k
    failed = .true.
    call turn_round(n_terms, tau, turn, going, left, coming)
    previous = huge(1.0_dp)
    rate = 0.1_dp
    do sweep = 1, most_sweeps
      do k = 1, n_terms
        if (.not. maxval(coming(:, 1)) - turn < tau(k)*longest_at_all) return
      end do
      call move_edges(g_inf, n_terms, g, tau, turn, going, left, coming, force, moved, failed)
      if (failed) return
      change = maxval(abs(moved))*(1/turn)
      if (sweep > 1) rate = max(change/previous, best_rate)
      coming(1:, 1) = coming(1:, 1) + moved
      if (change*min(rate, 1.0_dp) < closeness) exit
      failed = .true.
      if (.not. change < 1) return
      previous = change
    end do
    if (failed) return
    coming(1:, 2) = coming(1:, 2) + moved*coming(1:, 3) ! what the last step changes is linear
    do k = 1, n_terms
      coming(1:, 3 + k) = coming(1:, 3 + k) + moved*(g(k)*coming(1:, 3) - coming(1:, 3 + k)*(1/tau(k)))
    end do
    coming(1:, 3) = coming(1:, 3) + moved*force(1:)
  end subroutine come_back

  !> Where the restitution starts, and its times if it were elastic.
  pure subroutine turn_round(n_terms, tau, turn, going, left, coming)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: tau(n_terms), turn, going(0:p, 2 + 2*n_terms)
    real(dp), intent(out) :: left(0:p, 5 + 3*n_terms), coming(0:p, 3 + n_terms)
    real(dp) :: ago(0:p), faded(0:p)
    integer(ip) :: k
    ago(0:p - 1) = turn*(1 - square(p:1:-1))
    ago(p) = turn
    ago(0) = 0
    coming(:, 1) = turn + ago
    coming(0, 2) = going(p, 1)
    coming(0, 3) = 0
    do k = 1, n_terms
      coming(0, 3 + k) = going(p, 2 + n_terms + k)
      faded = 1/growth_of(ago*(1/tau(k)))
      left(:, k) = faded*going(p:0:-1, 2 + k)
      left(:, n_terms + k) = faded*going(p:0:-1, 2 + n_terms + k)
    end do
  end subroutine turn_round

  !> Motion with the times as they are, and Newton's steps of them, `moved`. force: D''.
  pure subroutine move_edges(g_inf, n_terms, g, tau, turn, going, left, coming, force, moved, failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, g(n_terms), tau(n_terms), turn, going(0:p, 2 + 2*n_terms)
    real(dp), intent(inout) :: left(0:p, 5 + 3*n_terms), coming(0:p, 3 + n_terms)
    real(dp), intent(out) :: force(0:p), moved(p)
    logical, intent(out) :: failed
    real(dp), dimension(0:p) :: rate, edge, driven
    real(dp), dimension(p) :: excess, fall, beyond
    real(dp) :: freed
    integer(ip) :: k, l, n
    rate = 0
    do n = 0, p
      !$omp simd
      do l = 0, p
        rate(l) = rate(l) + slope(l, n)*coming(n, 1)
      end do
    end do
    !$omp simd
    do l = 0, p
      edge(l) = going(p - l, 1)
      force(l) = (2.0_dp/3.0_dp)*g_inf*edge(l)*sqrt(edge(l))
    end do
    do k = 1, n_terms
      !$omp simd
      do l = 0, p
        left(l, 2*n_terms + k) = growth_of((coming(l, 1) - turn)*(1/tau(k)))
        force(l) = force(l) + left(l, k)/left(l, 2*n_terms + k)
      end do
    end do
    !$omp simd
    do l = 0, p
      force(l) = -mass_factor*force(l)
      driven(l) = force(l)*rate(l)
    end do
    coming(1:, 3) = integrated(coming(0, 3), driven)
    !$omp simd
    do l = 0, p
      driven(l) = coming(l, 3)*rate(l)
    end do
    coming(1:, 2) = integrated(coming(0, 2), driven)
    !$omp simd
    do l = 1, p
      excess(l) = g_inf*(coming(l, 2) - edge(l))
      fall(l) = g_inf*coming(l, 3)
    end do
    do k = 1, n_terms
      beyond = integrated(coming(0, 3 + k), g(k)*driven*left(:, 2*n_terms + k))
      !$omp simd private(freed)
      do l = 1, p
        freed = 1/left(l, 2*n_terms + k)
        coming(l, 3 + k) = beyond(l)*freed
        freed = (beyond(l) - left(l, n_terms + k))*freed
        excess(l) = excess(l) + freed
        fall(l) = fall(l) + (g(k)*coming(l, 3) - freed*(1/tau(k)))
      end do
    end do
    failed = .not. maxval(fall) < 0
    moved = -excess/fall
  end subroutine move_edges

  pure subroutine fit(n_terms, turn, going, coming, curve)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: turn, going(0:p, 2 + 2*n_terms), coming(0:p, 3 + n_terms)
    real(dp), intent(out) :: curve(0:p, 5 + 3*n_terms)
    real(dp), parameter :: inverse(p) = 1/y
    real(dp) :: f(0:p)
    integer(ip) :: k
    f(0) = sqrt(turn)
    f(1:) = sqrt(going(1:, 1))*inverse
    curve(:, 1) = series_of(f)
    do k = 2, 2 + 2*n_terms
      curve(:, k) = series_of(going(:, k))
    end do
    do k = 1, 3 + n_terms
      curve(:, 2 + 2*n_terms + k) = series_of(coming(:, k))
    end do
  end subroutine fit

  pure function series_of(f) result(c)
    real(dp), intent(in) :: f(0:p)
    real(dp) :: c(0:p)
    integer(ip) :: l, n
    c = 0
    do n = 0, p
      !$omp simd
      do l = 0, p
        c(l) = c(l) + series(l, n)*f(n)
      end do
    end do
  end function series_of

  !> What the series leave out at most, in units of velocity.
  pure function lack(n_terms, turn, curve) result(most)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: turn, curve(0:p, 5 + 3*n_terms)
    real(dp) :: most
    integer(ip) :: k
    associate (last => curve(p - 3:, :), m => n_terms)
      most = max(next_of(last(:, 2)), next_of(last(:, 3 + 2*m))*(1/turn), next_of(last(:, 5 + 2*m)))
      do k = 1, m
        most = max(most, turn*max(next_of(last(:, 2 + k)), next_of(last(:, 2 + m + k)), next_of(last(:, 5 + 2*m + k))))
      end do
    end associate
  end function lack

  !> The next two members of a series, from its last four, if it goes on falling as it falls there.
  pure function next_of(last) result(next)
    real(dp), intent(in) :: last(4)
    real(dp) :: next, before
    next = abs(last(3)) + abs(last(4))
    before = abs(last(1)) + abs(last(2))
    if (next < before) next = next*(next/before)
  end function next_of
end module CURVE
