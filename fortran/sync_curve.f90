!> The normal problem of the method `sync` where nothing in it is abrupt: one polynomial a phase. Not for a dashpot alone (eta).
!>
!> Compression and restitution are found at Chebyshev's points by sweeps (modules rst_sync_going_*; rst_sync_coming_* if memory
!> lasts long, otherwise rst_sync_fading_*). Columns of `curve`, their series: A/y, D', g_k P_k, g_k M_k by y in the compression;
!> s, D, D', g_k M_k in the restitution, by the y of the edge, falling, if memory lasts long, otherwise by z, with B in place of s.
!> Beside M_k there is layer(k, 1)*exp(-s/tau_k) and layer(k, 2)*exp(-(s-s_m)/tau_k) in the one and the other phase.
module CURVE
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: mass_factor
  use rst_memory, only: growth_of
  use POINTS, only: p, up, series
  use GOING, only: compress
  use COMING, only: come_back
  use FADING, only: retreat
  implicit none (type, external)
  private
  public :: follow_curve

  real(dp), parameter :: mirrored = 2.5_dp     !! relaxation times of the compression up to which the restitution mirrors it
  !> What is left out of P_k is where the contact is that many relaxation times old, and in ripples behind, which average out.
  real(dp), parameter :: settles_within = 8, ripples = 0.05_dp

contains

  !> depth: the largest, roughly. closeness: see normal_levels. turn: s_m and, unless memory lasts long, T, and delay and lead, see
  !> turn_round in rst_sync_fading_*, otherwise 0. spread: slopes of y
  !> over u = tan(phi/2) at both ends, for rst_sync_sample. lacks: what series leave out, and sweeps unfinished.
  pure subroutine follow_curve(depth, g_inf, n_terms, g, tau, closeness, turn, spread, going, coming, curve, layer, x_kept, &
                               inverse, lacks, failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: depth, g_inf, g(n_terms), tau(n_terms), closeness
    real(dp), intent(out) :: turn(4), spread(2), lacks(2)
    real(dp), intent(out) :: going(0:p, 2 + 2*n_terms), coming(0:p, 3 + n_terms), curve(0:p, 5 + 3*n_terms)
    real(dp), intent(out) :: layer(n_terms, 2), x_kept(n_terms), inverse(0:p, 0:p, n_terms)
    logical, intent(out) :: failed
    real(dp) :: radius, force, unfinished(2)
    integer(ip) :: k
    turn(2:) = 0
    layer = 0
    call compress(depth, g_inf, n_terms, g, tau, closeness, turn(1), going, layer(:, 1), x_kept, inverse, &
                  unfinished(1), failed)
    if (failed) return
    if (any(turn(1) > mirrored*tau)) then
      call fit_going(n_terms, turn(1), going, curve)
      do k = 1, n_terms
        going(p, 2 + n_terms + k) = going(p, 2 + n_terms + k) + layer(k, 1)/growth_of(turn(1)/tau(k))
      end do
      call retreat(g_inf, n_terms, g, tau, closeness, turn(1), going, curve, layer(:, 1), x_kept, inverse, turn(3), turn(4), &
                   turn(2), coming, layer(:, 2), unfinished(2), failed)
    else
      call come_back(g_inf, n_terms, g, tau, closeness, turn(1), going, curve, coming, unfinished(2), failed)
      call fit_going(n_terms, turn(1), going, curve)
    end if
    if (failed) return
    do k = 1, 3 + n_terms
      curve(:, 2 + 2*n_terms + k) = series_of(coming(:, k))
    end do
    lacks = [lack(n_terms, tau, turn, curve), sum(unfinished)]
    radius = sqrt(going(p, 1))
    force = (2.0_dp/3.0_dp)*g_inf*radius*going(p, 1)
    do k = 1, n_terms
      force = force + going(p, 2 + k)
    end do
    spread = [2*sqrt(depth/turn(1)), radius/(2*turn(1)*sqrt(depth)*mass_factor*force)]
  end subroutine follow_curve

  pure subroutine fit_going(n_terms, turn, going, curve)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: turn, going(0:p, 2 + 2*n_terms)
    real(dp), intent(inout) :: curve(0:p, 5 + 3*n_terms)
    real(dp), parameter :: inverse(p) = 1/up(1:)
    real(dp) :: f(0:p)
    integer(ip) :: k
    f(0) = sqrt(turn)
    f(1:) = sqrt(going(1:, 1))*inverse
    curve(:, 1) = series_of(f)
    do k = 2, 2 + 2*n_terms
      curve(:, k) = series_of(going(:, k))
    end do
  end subroutine fit_going

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

  !> What the series leave out at most, in units of velocity. That of B is not used.
  pure function lack(n_terms, tau, turn, curve) result(most)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: tau(n_terms), turn(4), curve(0:p, 5 + 3*n_terms)
    real(dp) :: most
    integer(ip) :: k
    associate (last => curve(p - 3:, :), m => n_terms)
      most = max(next_of(last(:, 2)), next_of(last(:, 5 + 2*m)))
      if (.not. turn(2) > 0) most = max(most, next_of(last(:, 3 + 2*m))*(1/turn(1)))
      do k = 1, m
        most = max(most, min(turn(1), settles_within*tau(k) + ripples*turn(1))*next_of(last(:, 2 + k)), &
                   turn(1)*max(next_of(last(:, 2 + m + k)), next_of(last(:, 5 + 2*m + k))))
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
