!> Fading memory over one step: int_0^x exp(-(x-t)/tau) y(t) dt in closed form for polynomials y, for any tau.
!>
!> phi_1(z) = (1-exp(-z))/z, phi_2 = (1-phi_1)/z, phi_3 = (1/2-phi_2)/z with z = x/tau: finite for tau -> 0 (the dashpot
!> limit) and tau -> infinity (the elastic one), so that no relaxation time limits a step.
module rst_memory
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: memory_type, memory_of, parabola_type, spacing_type, spacing_of, parabola_through
  public :: remembered, integrated, integrated_twice, own_share, own_memory

  !> exp(-z) and the phi functions.
  type :: memory_type
    real(dp) :: decay, phi1, phi2, phi3
  end type memory_type

  !> y(t) = start + slope t + bend t (t - middle)
  type :: parabola_type
    real(dp) :: start, slope, bend, middle
  end type parabola_type

  !> Of the three points of a parabola, the first at 0: x1, and 1/x1, 1/(x2-x1), 1/x2, which many parabolas share.
  type :: spacing_type
    real(dp) :: x1, first, between, last
  end type spacing_type

contains

  elemental function memory_of(z) result(m)
    real(dp), intent(in) :: z
    type(memory_type) :: m
    real(dp), parameter :: series_below = 0.5_dp  !! beyond, the closed form loses less than two digits
    real(dp), parameter :: short_series_below = 0.03_dp  !! there z^6/9! is nothing beside 1/6
    real(dp) :: z2
    integer(ip) :: i
    real(dp), parameter :: c(0:9) = [(1/gamma(i + 4.0_dp), i=0, 9)]  !! phi_3(z) = sum_i (-z)^i/(i+3)!
    if (z < series_below) then
      z2 = z*z
      m%phi3 = 0
      if (z > short_series_below) m%phi3 = z2*((c(6) - z*c(7)) + z2*(c(8) - z*c(9)))
      m%phi3 = (c(0) - z*c(1)) + z2*((c(2) - z*c(3)) + z2*((c(4) - z*c(5)) + m%phi3))
      m%phi2 = 0.5_dp - z*m%phi3
      m%phi1 = 1 - z*m%phi2
      m%decay = 1 - z*m%phi1
    else
      m%decay = exp(-z)
      m%phi1 = (1 - m%decay)/z
      m%phi2 = (1 - m%phi1)/z
      m%phi3 = (0.5_dp - m%phi2)/z
    end if
  end function memory_of

  pure function spacing_of(x) result(s)
    real(dp), intent(in) :: x(2)
    type(spacing_type) :: s
    s = spacing_type(x(1), 1/x(1), 1/(x(2) - x(1)), 1/x(2))
  end function spacing_of

  !> Through (0, y(0)) and (x1, y(1)), (x2, y(2)) of the spacing.
  pure function parabola_through(s, y) result(p)
    type(spacing_type), intent(in) :: s
    real(dp), intent(in) :: y(0:2)
    type(parabola_type) :: p
    p%start = y(0)
    p%slope = (y(1) - y(0))*s%first
    p%bend = ((y(2) - y(1))*s%between - p%slope)*s%last
    p%middle = s%x1
  end function parabola_through

  !> int_0^x exp(-(x-t)/tau) p(t) dt, m = memory_of(x/tau)
  pure function remembered(m, x, p) result(y)
    type(memory_type), intent(in) :: m
    real(dp), intent(in) :: x
    type(parabola_type), intent(in) :: p
    real(dp) :: y
    y = x*(p%start*m%phi1 + x*((p%slope - p%bend*p%middle)*m%phi2 + 2*x*p%bend*m%phi3))
  end function remembered

  !> int_0^x p(t) dt
  pure function integrated(x, p) result(y)
    real(dp), intent(in) :: x
    type(parabola_type), intent(in) :: p
    real(dp) :: y
    y = x*(p%start + x*((p%slope - p%bend*p%middle)/2 + x*p%bend/3))
  end function integrated

  !> int_0^x (x-t) p(t) dt
  pure function integrated_twice(x, p) result(y)
    real(dp), intent(in) :: x
    type(parabola_type), intent(in) :: p
    real(dp) :: y
    y = x*x*(p%start/2 + x*((p%slope - p%bend*p%middle)/6 + x*p%bend/12))
  end function integrated_twice

  !> Derivative of int_0^x p dt by the value of p at x itself; x is the q-th of the points x(1), x(2).
  pure function own_share(q, x) result(share)
    integer(ip), intent(in) :: q
    real(dp), intent(in) :: x(2)
    real(dp) :: share
    if (q == 1) then
      share = x(1)/2 + x(1)**2/(6*(x(2) - x(1)))
    else
      share = x(2)*(x(2)/3 - x(1)/2)/(x(2) - x(1))
    end if
  end function own_share

  !> The same of remembered(m, x, p).
  pure function own_memory(m, q, x) result(share)
    type(memory_type), intent(in) :: m
    integer(ip), intent(in) :: q
    real(dp), intent(in) :: x(2)
    real(dp) :: share
    if (q == 1) then
      share = x(1)*(x(2)*m%phi2 - 2*x(1)*m%phi3)/(x(2) - x(1))
    else
      share = x(2)*(2*x(2)*m%phi3 - x(1)*m%phi2)/(x(2) - x(1))
    end if
  end function own_memory
end module rst_memory
