!> int S ds over a step from level to level where the motion is smooth in the number j of the level (module rst_sync_sample).
!>
!> While F = int f dX rises and falls by the whole of it within few levels, S/F is smooth from first touch on; and S/A is towards the
!> end, in stick, where S goes like the radius A, and in slip, where it is F. But F and A are known at all levels beforehand. So the
!> weights are those with which
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
  !> from the end of the step) times those of F ds/dj (rows): for the first three levels of a phase, those amid it, and the last two,
  !> where r of the very end is not known, 0/0.
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

  !> ds/dj from the steps to the six levels after the first of a phase: there and at the next two; amid of six steps.
  real(dp), parameter :: &
    rate_at_end(6, 0:2) = reshape([147, -213, 237, -163, 62, -10, 10, 87, -63, 37, -13, 2, -2, 22, 57, -23, 7, -1], &
                                  [6, 3])/60.0_dp, &
    rate_amid(3) = [37, -8, 1]/60.0_dp

contains

  !> level%weight of all levels, 8 a phase or more.
  pure subroutine spread_ratios(n, node, level)
    integer(ip), intent(in) :: n
    type(node_type), intent(in) :: node(0:n)
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp) :: f(-3:block + 2), once(-3:block + 2), g(6)
    integer(ip) :: from, to, i
    call weigh_in_time(n, max(3_ip, n - 4), min(2*n, n + 5), level)
    do i = 0, 5
      g(i + 1) = level(i)%force*rate(n, i, level)
    end do
    level(1)%weight = [dot_product(first, g)/level(1)%force, 0.0_dp, 0.0_dp, 0.0_dp]
    level(2)%weight = [matmul(g, second)/level(2:1:-1)%force, 0.0_dp, 0.0_dp]
    level(3)%weight = [matmul(g, third)/level(3:1:-1)%force, 0.0_dp]
    do from = 4, n - 5, block
      to = min(from + block - 1, n - 5)
      do i = -3, to - from + 2
        f(i) = level(from + i)%force*rate(n, from + i, level)
        once(i) = 1/level(from + i)%force
      end do
      call weigh_inner(to - from, f, once, level(from:))
    end do
    do from = n + 6, 2*n - 2, block
      to = min(from + block - 1, 2*n - 2)
      do i = -3, to - from + 2
        f(i) = node(2*n - from - i)%radius*rate(n, from + i, level)
      end do
      do i = -3, to - from
        once(i) = 1/node(2*n - from - i)%radius
      end do
      call weigh_inner(to - from, f, once, level(from:))
    end do
    do i = 0, 5
      g(i + 1) = node(5 - i)%radius*rate(n, 2*n - 5 + i, level)
    end do
    level(2*n - 1)%weight = matmul(g, last_but_one)/node(1:4)%radius
    level(2*n)%weight = [0.0_dp, matmul(g, last)/node(1:3)%radius]
    do i = n + 6, 2*n
      call pass_friction(n, i, level)
    end do
  end subroutine spread_ratios

  pure subroutine pass_friction(n, l, level)
    integer(ip), intent(in) :: n, l
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp) :: f(6), j
    integer(ip) :: i, last
    last = min(l + 2, 2*n)
    do i = 0, 5
      f(6 - i) = level(last - i)%force*rate(n, last - i, level)
    end do
    if (l == 2*n) then
      j = dot_product([27, -173, 482, -798, 1427, 475]/1440.0_dp, f)
    else if (l == 2*n - 1) then
      j = dot_product([-11, 77, -258, 1022, 637, -27]/1440.0_dp, f)
    else
      j = dot_product([11, -93, 802, 802, -93, 11]/1440.0_dp, f)
    end if
    j = j - dot_product(level(l)%weight, level(l:l - 3:-1)%force)
    j = j/(level(l)%force**2 + level(l - 1)%force**2)
    level(l)%weight(0:1) = level(l)%weight(0:1) + j*level(l:l - 1:-1)%force
  end subroutine pass_friction

  !> ds/dj; l is none of the three levels around the turning point.
  pure function rate(n, l, level)
    integer(ip), intent(in) :: n, l
    type(level_type), intent(in) :: level(0:2*n)
    real(dp) :: rate
    if (l < 3) then
      rate = dot_product(rate_at_end(:, l), level(1:6)%step)
    else if (l > 2*n - 3) then
      rate = dot_product(rate_at_end(:, 2*n - l), level(2*n:2*n - 5:-1)%step)
    else
      rate = rate_amid(1)*(level(l)%step + level(l + 1)%step) + rate_amid(2)*(level(l - 1)%step + level(l + 2)%step) &
             + rate_amid(3)*(level(l - 2)%step + level(l + 3)%step)
    end if
  end function rate

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
