!> int S ds over a step from level to level, from the forces S at its ends and at the two levels before it: the cubic through S ds/dy
!> in a measure y of time in which S is smooth. From first touch on, where forces go like powers of the root of time, y is that
!> root; towards the end, where the force of a contact that sticks goes like the root of the time that is left, y is that root;
!> in between, time itself.
module rst_sync_quadrature
  use rst_precision, only: dp, ip
  use rst_sync_levels, only: level_type
  implicit none (type, external)
  private
  public :: spread_weights, starting_weights

  integer(ip), parameter :: block = 32  !! levels at a time

contains

  !> level%weight from the third level on: of the forces at that level and the three before it.
  pure subroutine spread_weights(n, level)
    integer(ip), intent(in) :: n
    type(level_type), intent(inout) :: level(0:2*n)
    integer(ip) :: first, last, i
    real(dp) :: rest, y(-3:block), h(-2:block), dsdy(-3:block)
    dsdy = 1
    do first = 3, last_of_start(n), block
      last = min(first + block - 1, last_of_start(n))
      do i = -3, last - first
        y(i) = sqrt(level(first + i)%time)
        dsdy(i) = 2*y(i)
      end do
      do i = -2, last - first
        h(i) = level(first + i)%step/(y(i) + y(i - 1))
      end do
      call weigh(last - first, h, dsdy, level(first:))
    end do
    dsdy = 1
    do first = max(3_ip, last_of_start(n) + 1), 2*n - last_of_start(n) - 1, block
      last = min(first + block - 1, 2*n - last_of_start(n) - 1)
      do i = -2, last - first
        h(i) = level(first + i)%step
      end do
      call weigh(last - first, h, dsdy, level(first:))
    end do
    rest = 0
    last = 2*n
    do while (last >= 2*n - last_of_start(n))
      first = max(last - block + 1, 2*n - last_of_start(n))
      do i = last - first, -3, -1
        y(i) = rest
        rest = rest + level(first + i)%step
      end do
      rest = y(-1)
      do i = -3, last - first
        y(i) = sqrt(y(i))
        dsdy(i) = -2*y(i)
      end do
      do i = -2, last - first
        h(i) = -level(first + i)%step/(y(i) + y(i - 1))
      end do
      call weigh(last - first, h, dsdy, level(first:))
      last = first - 1
    end do
  end subroutine spread_weights

  !> The last level that is reached in the root of time; as many before the end it is the root of what is left.
  pure function last_of_start(n) result(last)
    integer(ip), intent(in) :: n
    integer(ip) :: last
    last = 2*n/3
  end function last_of_start

  !> Of the levels 0 to last, from the steps of y and ds/dy.
  pure subroutine weigh(last, h, dsdy, level)
    integer(ip), intent(in) :: last
    real(dp), intent(in) :: h(-2:block), dsdy(-3:block)
    type(level_type), intent(inout) :: level(0:last)
    real(dp), dimension(-2:block) :: once, twice
    real(dp) :: twist, bend
    integer(ip) :: i
    !$omp simd
    do i = -2, last
      once(i) = 1/h(i)
    end do
    !$omp simd
    do i = -1, last
      twice(i) = 1/(h(i) + h(i - 1))
    end do
    !$omp simd private(twist, bend)
    do i = 0, last
      twist = -h(i)**3*(h(i) + 2*h(i - 1))/(12*(h(i) + h(i - 1) + h(i - 2)))
      bend = (twist - h(i)**3/6)*twice(i)
      level(i)%weight(0) = dsdy(i)*(h(i)/2 + bend*once(i))
      level(i)%weight(1) = dsdy(i - 1)*(h(i)/2 - bend*(once(i) + once(i - 1)) - twist*twice(i - 1)*once(i - 1))
      level(i)%weight(2) = dsdy(i - 2)*(bend*once(i - 1) + twist*twice(i - 1)*(once(i - 1) + once(i - 2)))
      level(i)%weight(3) = -dsdy(i - 3)*twist*twice(i - 1)*once(i - 2)
    end do
  end subroutine weigh

  !> The same for the first three steps, which know fewer forces: `steps` from the new level backwards, 0 before the start.
  pure function starting_weights(steps) result(weight)
    real(dp), intent(in) :: steps(3)
    real(dp) :: weight(0:3), twist, bend
    weight = 0
    weight(0:1) = steps(1)/2
    if (.not. steps(2) > 0) return
    twist = 0
    if (steps(3) > 0) twist = -steps(1)**3*(steps(1) + 2*steps(2))/(12*sum(steps))
    bend = (twist - steps(1)**3/6)/(steps(1) + steps(2))
    weight(0) = weight(0) + bend/steps(1)
    weight(1) = weight(1) - bend*(1/steps(1) + 1/steps(2))
    weight(2) = bend/steps(2)
    if (.not. steps(3) > 0) return
    weight(1) = weight(1) - twist/(steps(2)*(steps(2) + steps(3)))
    weight(2) = weight(2) + twist/(steps(2)*steps(3))
    weight(3) = -twist/(steps(3)*(steps(2) + steps(3)))
  end function starting_weights
end module rst_sync_quadrature
