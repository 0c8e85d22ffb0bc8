!> Where a run of the normal problem begins its sweeps: from a run with half the levels, or from where the panels before point to.
module rst_sync_guess
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: level_type, at_level, mass_factor
  implicit none (type, external)
  private
  public :: double_levels, is_likely, steps_ahead, ahead, first_return

contains

  !> A guess of 2n levels a phase from n: every other one, and between them polynomials in the number of the level, through six of
  !> the same phase, four if there are no six.
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

  !> Where the motion is not smooth polynomials may lead astray.
  pure function is_likely(first, second) result(yes)
    type(level_type), intent(in) :: first, second
    logical :: yes
    yes = min(first%step, second%step) > 0.1_dp*max(first%step, second%step) .and. min(first%depth, second%depth) > 0
  end function is_likely

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
end module rst_sync_guess
