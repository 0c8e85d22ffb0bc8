!> A function between two instants at which it and its slope are known (Hermite's cubic).
module rst_cubic
  use rst_precision, only: dp, ip
  use rst_bounded, only: bounded
  implicit none (type, external)
  private
  public :: cubic_type, cubic_between, cubic_value, cubic_slope, cubic_bend, cubic_integral, cubic_root

  !> In units of the interval h; d0 and d1: slopes times h.
  type :: cubic_type
    real(dp) :: h, y0, y1, d0, d1
  end type cubic_type

contains

  pure function cubic_between(h, y0, y1, slope0, slope1) result(c)
    real(dp), intent(in) :: h, y0, y1, slope0, slope1
    type(cubic_type) :: c
    c = cubic_type(h, y0, y1, h*slope0, h*slope1)
  end function cubic_between

  pure function cubic_value(c, t) result(y)
    type(cubic_type), intent(in) :: c
    real(dp), intent(in) :: t
    real(dp) :: y, x, ease
    x = t/c%h
    ease = x*x*(3 - 2*x)
    y = c%y0*(1 - ease) + c%y1*ease + x*(1 - x)*(c%d0*(1 - x) - c%d1*x)
  end function cubic_value

  pure function cubic_slope(c, t) result(slope)
    type(cubic_type), intent(in) :: c
    real(dp), intent(in) :: t
    real(dp) :: slope, x
    x = t/c%h
    slope = (6*x*(1 - x)*(c%y1 - c%y0) + c%d0*(1 - x)*(1 - 3*x) + c%d1*x*(3*x - 2))/c%h
  end function cubic_slope

  !> Second derivative.
  pure function cubic_bend(c, t) result(bend)
    type(cubic_type), intent(in) :: c
    real(dp), intent(in) :: t
    real(dp) :: bend, x
    x = t/c%h
    bend = ((6 - 12*x)*(c%y1 - c%y0) + c%d0*(6*x - 4) + c%d1*(6*x - 2))/c%h**2
  end function cubic_bend

  !> int_0^t
  pure function cubic_integral(c, t) result(area)
    type(cubic_type), intent(in) :: c
    real(dp), intent(in) :: t
    real(dp) :: area, x
    x = t/c%h
    area = t*(c%y0 + (c%y1 - c%y0)*x*x*(1 - x/2) + c%d0*x*(0.5_dp - x*(2.0_dp/3.0_dp - x/4)) &
              - c%d1*x*x*(1.0_dp/3.0_dp - x/4))
  end function cubic_integral

  !> Where a falling function is y: Newton's method, kept within bounds by bisection.
  pure function cubic_root(c, y) result(t)
    type(cubic_type), intent(in) :: c
    real(dp), intent(in) :: y
    real(dp) :: t, low, high, excess, slope
    integer(ip) :: i
    low = 0
    high = c%h
    t = c%h*max(0.0_dp, bounded(c%y0 - y, max(c%y0 - c%y1, 0.0_dp), -1.0_dp, 1.0_dp))
    do i = 1, 60
      excess = cubic_value(c, t) - y
      if (excess > 0) low = t
      if (excess <= 0) high = t
      slope = cubic_slope(c, t)
      if (abs(excess) <= epsilon(1.0_dp)) exit
      if (slope < 0) t = t - excess/slope
      if (.not. (slope < 0 .and. t > low .and. t < high)) t = (low + high)/2
    end do
  end function cubic_root
end module rst_cubic
