!> The restitution of the normal problem as one polynomial where it mirrors the compression (module rst_sync_curve_*).
!>
!> It is smooth in the y at which the compression had the same edge: s = s_m (2 - y^2) if all is elastic. Unknown are the times at
!> which the edge is free (rst_sync_levels). Memory is taken with exp(s/tau) in the integrand, so that it is not to last more than a
!> few relaxation times.
module COMING
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: mass_factor
  use rst_memory, only: growth_of
  use POINTS, only: p, up, integral, slope
  use GOING, only: most_sweeps, best_rate
  implicit none (type, external)
  private
  public :: come_back

  real(dp), parameter :: longest = 6.0_dp !! relaxation times
  real(dp), parameter :: square(p) = up(1:)**2

contains

  pure function integrated(start, f) result(sums)
    real(dp), intent(in) :: start, f(0:p)
    real(dp) :: sums(p), others(p)
    integer(ip) :: l, n
    sums = start + integral(:, 0)*f(0)
    others = 0 ! see moments of the modules rst_sync_going_*
    do n = 1, p, 2
      !$omp simd
      do l = 1, p
        sums(l) = sums(l) + integral(l, n)*f(n)
        others(l) = others(l) + integral(l, n + 1)*f(n + 1)
      end do
    end do
    sums = sums + others
  end function integrated

  !> Columns of `left`, by terms: what the compression left of g P and g M of each edge at the turning point; exp(time since
  !> then/tau).
  pure subroutine come_back(g_inf, n_terms, g, tau, closeness, turn, going, left, coming, unfinished, failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, g(n_terms), tau(n_terms), closeness, turn, going(0:p, 2 + 2*n_terms)
    real(dp), intent(out) :: left(0:p, 5 + 3*n_terms), coming(0:p, 3 + n_terms), unfinished
    logical, intent(out) :: failed
    real(dp) :: moved(p), force(0:p), change, previous, rate
    integer(ip) :: sweep, k
    failed = .true.
    call turn_round(n_terms, tau, turn, going, left, coming)
    previous = huge(1.0_dp)
    rate = 0.1_dp
    do sweep = 1, most_sweeps
      do k = 1, n_terms
        if (.not. maxval(coming(:, 1)) - turn < tau(k)*longest) return
      end do
      call move_edges(g_inf, n_terms, g, tau, turn, going, left, coming, force, moved, failed)
      if (failed) return
      change = maxval(abs(moved))*(1/turn)
      if (sweep > 1) rate = max(change/previous, best_rate)
      coming(1:, 1) = coming(1:, 1) + moved
      unfinished = change*min(rate, 1.0_dp)
      if (unfinished < closeness) exit
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
end module COMING
