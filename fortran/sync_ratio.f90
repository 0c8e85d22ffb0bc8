!> int S ds over a step from level to level where the motion is smooth in the number j of the level (module rst_sync_sample).
!>
!> While F = int f dX rises and falls by the whole of it within few levels, S/F is smooth from first touch on; and S/A is towards
!> the end, in stick, where S goes like the radius A, and in slip, where it is F. But F and A are known at all levels beforehand.
!> So the weights are those with which
!>   int r(j) B(j) ds/dj dj,   r the cubic through S/B at the end of the step and at the three levels before it,
!> is exact for B ds/dj as the polynomial through the six levels around the step, B = F in the compression and A in the restitution.
!> There what they lack of int F ds is added by way of S/F at both ends of the step, so that slip is as exact. Around the turning
!> point, where ds/dj bends, weights are those of the cubic in time.
module rst_sync_ratio
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: level_type, node_type
  use rst_sync_quadrature, only: weigh_in_time
  implicit none (type, external)
  private
  public :: spread_ratios

  integer(ip), parameter :: block = 32  !! levels at a time

  !> Integrals over a step, in the numbers of six levels in a row, of Lagrange's polynomials of r at its levels (columns, backwards
  !> from the end of the step) times those of F ds/dj (rows): for the first three levels of a phase, those amid it, and the last
  !> two, where r of the very end is not known, 0/0.
  real(dp), parameter :: &
    first(6) = [475, 1427, -798, 482, -173, 27]/1440.0_dp, &
    second(6, 2) = reshape([-82, 1355, 4444, -902, 262, -37, &
                            -107, 3104, 2710, -904, 277, -40], [6, 2])/10080.0_dp, &
    third(6, 3) = reshape([117, -955, 5730, 12906, -1127, 129, 222, -1910, 18636, 11460, -1738, 210, &
                           -31, 261, -1910, -1910, 261, -31], [6, 3])/40320.0_dp, &
    inner(6, 0:3) = reshape([4574, -37195, 217640, 535030, -44750, 5101, 12063, -103290, 959250, 652920, -96105, 11562, &
                             -3468, 29085, -206580, -223170, 29640, -3507, 691, -5780, 40210, 45740, -5965, 704], &
                            [6, 4])/1814400.0_dp, &
    last_but_one(6, 0:3) = reshape([-5101, 35180, -113710, 319660, 458515, -14144, &
                                    -11562, 81435, -276720, 1190490, 479490, -26733, &
                                    3507, -24510, 81690, -276720, -170565, 8598, -704, 4915, -16340, 54290, 35180, -1741], &
                                   [6, 4])/1814400.0_dp, &
    last(6, 3) = reshape([1537, -9819, 27210, -44470, 70821, 32001, -1134, 7222, -19900, 32076, -44470, -27554, &
                          353, -2247, 6186, -9950, 13605, 8853], [6, 3])/40320.0_dp

  !> The integral over a step of the polynomial alone: amid, from the step outwards, and the last two steps.
  real(dp), parameter :: amid(3) = [802, -93, 11]/1440.0_dp, passed_before_last(6) = [-11, 77, -258, 1022, 637, -27]/1440.0_dp, &
                         passed_last(6) = [27, -173, 482, -798, 1427, 475]/1440.0_dp

  !> ds/dj from the steps to the six levels after the first of a phase: there and at the next two; amid of six steps.
  real(dp), parameter :: &
    rate_at_end(6, 0:2) = reshape([147, -213, 237, -163, 62, -10, 10, 87, -63, 37, -13, 2, -2, 22, 57, -23, 7, -1], &
                                  [6, 3])/60.0_dp, &
    rate_amid(3) = [37, -8, 1]/60.0_dp

contains

  !> level%weight of all levels, 10 a phase or more.
  pure subroutine spread_ratios(n, node, level)
    integer(ip), intent(in) :: n
    type(node_type), intent(in) :: node(0:n)
    type(level_type), intent(inout) :: level(0:2*n)
    call weigh_in_time(n, n - 4, n + 5, level)
    call weigh_compression(n, level)
    call weigh_restitution(n, node, level)
  end subroutine spread_ratios

  pure subroutine weigh_compression(n, level)
    integer(ip), intent(in) :: n
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp), dimension(-3:block + 2) :: f, once
    integer(ip) :: from, to, i
    do from = 4, n - 5, block
      to = min(from + block - 1, n - 5)
      call find_rates(n, from - 3, to + 2, level, f)
      do i = -3, to - from + 2
        once(i) = 1/level(from + i)%force
        f(i) = f(i)*level(from + i)%force
      end do
      call weigh_inner(to - from, f, once, level(from:))
      if (from > 4) cycle
      level(1)%weight = 0
      level(2)%weight = 0
      level(3)%weight(3) = 0
      level(1)%weight(0) = dot_product(first(2:), f(:1))*once(-3)
      do i = 1, 2
        level(2)%weight(i - 1) = dot_product(second(2:, i), f(:1))*once(-1 - i)
      end do
      do i = 1, 3
        level(3)%weight(i - 1) = dot_product(third(2:, i), f(:1))*once(-i)
      end do
    end do
  end subroutine weigh_compression

  pure subroutine weigh_restitution(n, node, level)
    integer(ip), intent(in) :: n
    type(node_type), intent(in) :: node(0:n)
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp), dimension(-3:block + 2) :: f, a, once
    real(dp) :: passed(0:block + 1)
    integer(ip) :: from, to, end, i
    do from = n + 6, 2*n - 2, block
      to = min(from + block - 1, 2*n - 2)
      end = to - from + 2
      call find_rates(n, from - 3, to + 2, level, f)
      do i = -3, end
        a(i) = f(i)*node(2*n - from - i)%radius
        f(i) = f(i)*level(from + i)%force
      end do
      do i = -3, end - 1
        once(i) = 1/node(2*n - from - i)%radius
      end do
      call weigh_inner(end - 2, a, once, level(from:))
      do i = 0, end - 2
        passed(i) = amid(1)*(f(i - 1) + f(i)) + amid(2)*(f(i - 2) + f(i + 1)) + amid(3)*(f(i - 3) + f(i + 2))
      end do
      if (to == 2*n - 2) then
        do i = 0, 3
          level(2*n - 1)%weight(i) = dot_product(last_but_one(:, i), a(end - 5:end))*once(end - 1 - i)
        end do
        level(2*n)%weight(0) = 0
        do i = 1, 3
          level(2*n)%weight(i) = dot_product(last(:, i), a(end - 5:end))*once(end - i)
        end do
        passed(end - 1) = dot_product(passed_before_last, f(end - 5:end))
        passed(end) = dot_product(passed_last, f(end - 5:end))
        to = 2*n
      end if
      do i = 0, to - from
        call pass_friction(passed(i), level(from + i - 3:from + i))
      end do
    end do
  end subroutine weigh_restitution

  !> The weights of the last of the levels are to give int F ds for S = F.
  pure subroutine pass_friction(passed, level)
    real(dp), intent(in) :: passed  !! the integral
    type(level_type), intent(inout) :: level(-3:0)
    real(dp) :: lack
    lack = passed - (level(0)%weight(0)*level(0)%force + level(0)%weight(1)*level(-1)%force) &
           - (level(0)%weight(2)*level(-2)%force + level(0)%weight(3)*level(-3)%force)
    lack = lack/(level(0)%force**2 + level(-1)%force**2)
    level(0)%weight(0) = level(0)%weight(0) + lack*level(0)%force
    level(0)%weight(1) = level(0)%weight(1) + lack*level(-1)%force
  end subroutine pass_friction

  !> ds/dj at levels that are none of the three around the turning point; rate: from the first of them on.
  pure subroutine find_rates(n, from, to, level, rate)
    integer(ip), intent(in) :: n, from, to
    type(level_type), intent(in) :: level(0:2*n)
    real(dp), intent(inout) :: rate(from:*)
    integer(ip) :: l
    do l = max(3_ip, from), min(2*n - 3, to)
      rate(l) = rate_amid(1)*(level(l)%step + level(l + 1)%step) + rate_amid(2)*(level(l - 1)%step + level(l + 2)%step) &
                + rate_amid(3)*(level(l - 2)%step + level(l + 3)%step)
    end do
    do l = from, 2
      rate(l) = dot_product(rate_at_end(:, l), level(1:6)%step)
    end do
    do l = 2*n - 2, to
      rate(l) = dot_product(rate_at_end(:, 2*n - l), level(2*n:2*n - 5:-1)%step)
    end do
  end subroutine find_rates

  pure subroutine weigh_inner(count, f, once, level)
    integer(ip), intent(in) :: count
    real(dp), intent(in) :: f(-3:block + 2), once(-3:block + 2)
    type(level_type), intent(inout) :: level(0:count)
    integer(ip) :: i, k
    do k = 0, 3
      !$omp simd
      do i = 0, count
        level(i)%weight(k) = once(i - k)*((inner(1, k)*f(i - 3) + inner(2, k)*f(i - 2)) &
                                          + (inner(3, k)*f(i - 1) + inner(4, k)*f(i)) &
                                          + (inner(5, k)*f(i + 1) + inner(6, k)*f(i + 2)))
      end do
    end do
  end subroutine weigh_inner
end module rst_sync_ratio
