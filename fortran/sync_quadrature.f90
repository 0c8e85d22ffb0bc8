!> int S ds over a step from level to level, from the forces S at its ends and at the two levels before it: the cubic through S
!> ds/dy
!> in a measure y of time in which S is smooth. From first touch on, where forces go like powers of the root of time, y is that
!> root; towards the end, where the force of a contact that sticks goes like the root of the time that is left, y is that root;
!> in between, time itself.
module rst_sync_quadrature
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: level_type
  implicit none (type, external)
  private
  public :: spread_weights, choose_weights, cubic_weights, weighed_in_time
  public :: friction_impulse, full_friction
  public :: explicit_below, shortest_start, most_trials

  integer(ip), parameter :: block = 32              !! levels at a time
  real(dp), parameter :: steepest = 2               !! ratio of steps up to which four levels are better than three

  real(dp), parameter :: explicit_below = 0.2_dp    !! feedback of a step below which one evaluation is enough
  integer(ip), parameter :: most_trials = 20        !! where there are more
  !> Feedback of a step: the cubic through four levels is stable up to 3, the parabola through three up to 6, the force at the
  !> end of the step always.
  real(dp), parameter :: stiff_above = 1.5_dp, very_stiff_above = 6
  !> Part of a step below which the first one after gross slip says nothing of slopes: their errors grow as it falls.
  real(dp), parameter :: shortest_start = 0.1_dp

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
    call weigh_in_time(n, max(3_ip, last_of_start(n) + 1), 2*n - last_of_start(n) - 1, level)
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

  !> From one level to another, where y is time.
  pure subroutine weigh_in_time(n, from, to, level)
    integer(ip), intent(in) :: n, from, to
    type(level_type), intent(inout) :: level(0:2*n)
    integer(ip) :: first, last, i
    real(dp) :: h(-2:block), dsdy(-3:block)
    dsdy = 1
    do first = from, to, block
      last = min(first + block - 1, to)
      do i = -2, last - first
        h(i) = level(first + i)%step
      end do
      call weigh(last - first, h, dsdy, level(first:))
    end do
  end subroutine weigh_in_time

  !> The last level that is reached in the root of time; as many before the end it is the root of what is left.
  pure function last_of_start(n) result(last)
    integer(ip), intent(in) :: n
    integer(ip) :: last
    last = 2*n/3
  end function last_of_start

  !> Whether y is time itself at the level.
  pure function weighed_in_time(n, level) result(yes)
    integer(ip), intent(in) :: n, level
    logical :: yes
    yes = min(level, 2*n - level) > last_of_start(n)
  end function weighed_in_time

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
      if (max(h(i)*once(i - 1), h(i - 1)*once(i - 2)) > steepest) twist = 0
      bend = (twist - h(i)**3*(1.0_dp/6.0_dp))*twice(i)
      level(i)%weight(0) = dsdy(i)*(h(i)/2 + bend*once(i))
      level(i)%weight(1) = dsdy(i - 1)*(h(i)/2 - bend*(once(i) + once(i - 1)) - twist*twice(i - 1)*once(i - 1))
      level(i)%weight(2) = dsdy(i - 2)*(bend*once(i - 1) + twist*twice(i - 1)*(once(i - 1) + once(i - 2)))
      level(i)%weight(3) = -dsdy(i - 3)*twist*twice(i - 1)*once(i - 2)
    end do
  end subroutine weigh

  !> Weights of the forces in their integral over a step, and that of their slope at the end of gross slip, if there was any (see
  !> starting_weights); whether they are the usual ones.
  pure subroutine choose_weights(feedback, known, h, before, ease, usual, weight, slope_weight, usually)
    real(dp), intent(in) :: feedback, h, before(2), ease, usual(0:3)
    integer(ip), intent(in) :: known
    real(dp), intent(out) :: weight(0:3), slope_weight
    logical, intent(out) :: usually
    usually = .false.
    slope_weight = 0
    if (feedback > very_stiff_above) then
      weight = [h, 0.0_dp, 0.0_dp, 0.0_dp]
    else if (feedback > stiff_above) then
      weight = parabolic_weights(h, before(1))
    else if (known < 3) then
      call starting_weights(known, h, before, ease, weight, slope_weight)
    else
      weight = usual
      usually = .true.
    end if
  end subroutine choose_weights

  !> The same for the first three steps, in time: after `known` steps, the last of them `before`. Where the slope of the force at
  !> the
  !> start is known, it has the weight slope_weight and `ease` is 1; where that slope jumps, as dashpots let it, 0.
  pure subroutine starting_weights(known, h, before, ease, weight, slope_weight)
    integer(ip), intent(in) :: known
    real(dp), intent(in) :: h, before(2), ease
    real(dp), intent(out) :: weight(0:3), slope_weight
    real(dp) :: twist, bend
    weight = [h/2, h/2, 0.0_dp, 0.0_dp]
    slope_weight = 0
    if (known == 0) then
      weight(0:1) = weight(0:1) + ease*[-h, h]/6
      slope_weight = ease*h*h/6
    else if (known == 1) then
      twist = -ease*h**3*(h + 2*before(1))/(12*(h + before(1)))
      weight(0:2) = weight(0:2) + (twist - h**3/6)*bends(h, before(1)) + twist/before(1)**2*[0, -1, 1]
      slope_weight = twist/before(1)
    else
      twist = 0
      if (max(h/before(1), before(1)/before(2)) < steepest) twist = -h**3*(h + 2*before(1))/(12*(h + sum(before)))
      bend = twist - h**3/6
      weight(0:2) = weight(0:2) + bend*bends(h, before(1))
      weight(1:3) = weight(1:3) - twist*bends(before(1), before(2))
    end if
  end subroutine starting_weights

  !> The cubic through four levels in time; the steps between the first three of them, from the last one backwards, are `before`.
  pure function cubic_weights(h, before) result(weight)
    real(dp), intent(in) :: h, before(2)
    real(dp) :: weight(0:3), once(0:2), twice, twist, bend
    once = [1/h, 1/before(1), 1/before(2)]
    twice = 1/(before(1) + before(2))
    twist = -h*h*h*(h + 2*before(1))/(12*(h + before(1) + before(2)))
    if (max(h*once(1), before(1)*once(2)) > steepest) twist = 0
    bend = (twist - h*h*h*(1.0_dp/6.0_dp))/(h + before(1))
    twist = twist*twice
    weight = [h/2 + bend*once(0), h/2 - bend*(once(0) + once(1)) - twist*once(1), bend*once(1) + twist*(once(1) + once(2)), &
              -twist*once(2)]
  end function cubic_weights

  !> The parabola through three levels, for one in time: what makes those that follow stable where force and velocity hang together
  !> so
  !> closely that the cubic is not.
  pure function parabolic_weights(h, before) result(weight)
    real(dp), intent(in) :: h, before
    real(dp) :: weight(0:3)
    weight = [h/2, h/2, 0.0_dp, 0.0_dp]
    if (before > 0) weight(0:2) = weight(0:2) - h**3/6*bends(h, before)
  end function parabolic_weights

  !> Second divided difference by the values at three levels, from the last one backwards.
  pure function bends(h, before) result(share)
    real(dp), intent(in) :: h, before
    real(dp) :: share(3)
    share = [1/h, -(1/h + 1/before), 1/before]/(h + before)
  end function bends

  !> int int f dX ds over the step that ends at the level l. The difference of D' would be exact, but not to the part of a small psi
  !> that e_x wants.
  pure function friction_impulse(l, level) result(passed)
    integer(ip), intent(in) :: l
    type(level_type), intent(in) :: level(0:*)
    real(dp) :: passed
    passed = (level(l)%weight(0)*level(l)%force + level(l)%weight(1)*level(l - 1)%force) &
             + (level(l)%weight(2)*level(l - 2)%force + level(l)%weight(3)*level(l - 3)%force)
  end function friction_impulse

  !> The same from a level to the end.
  pure function full_friction(n, l, level) result(passed)
    integer(ip), intent(in) :: n, l
    type(level_type), intent(in) :: level(0:2*n)
    real(dp) :: passed
    integer(ip) :: i
    passed = 0
    do i = l + 1, 2*n
      passed = passed + friction_impulse(i, level)
    end do
  end function full_friction
end module rst_sync_quadrature
