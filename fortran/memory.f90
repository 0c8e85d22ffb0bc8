!> Fading memory over one step: int_0^x exp(-(x-t)/tau) y(t) dt in closed form for polynomials y, for any tau.
!>
!> phi_1(z) = (1-exp(-z))/z, phi_2 = (1-phi_1)/z, phi_3 = (1/2-phi_2)/z with z = x/tau: finite for tau -> 0 (the dashpot
!> limit) and tau -> infinity (the elastic one), so that no relaxation time limits a step.
module rst_memory
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: memory_type, memory_of, memory_pair_type, remember_pair, parabola_type, spacing_type, spacing_of, parabola_through
  public :: remembered, integrated, integrated_twice, shares, memory_shares

  !> exp(-z) and the phi functions.
  type, bind(c) :: memory_type
    real(dp) :: decay, phi1, phi2, phi3
  end type memory_type

  !> The same for the two points of a panel.
  type :: memory_pair_type
    real(dp), dimension(2) :: decay, phi1, phi2, phi3
  end type memory_pair_type

  !> y(t) = start + slope t + bend t^2
  type :: parabola_type
    real(dp) :: start, slope, bend
  end type parabola_type

  !> Of the three points of a parabola, the first at 0: x1, and 1/x1, 1/(x2-x1), 1/x2, which many parabolas share.
  type :: spacing_type
    real(dp) :: x1, first, between, last
  end type spacing_type

  real(dp), parameter :: series_below = 0.5_dp  !! beyond, the closed form loses less than two digits
  integer :: i
  real(dp), parameter :: c(0:9) = [(1/gamma(i + 4.0_dp), i=0, 9)]  !! phi_3(z) = sum_i (-z)^i/(i+3)!

contains

  elemental function memory_of(z) result(m)
    real(dp), intent(in) :: z
    type(memory_type) :: m
    real(dp), parameter :: short_series_below = 0.03_dp  !! there z^6/9! is nothing beside 1/6
    real(dp) :: z2
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

  pure subroutine remember_pair(z, m)
    real(dp), intent(in) :: z(2)
    type(memory_pair_type), intent(out) :: m
    type(memory_type) :: one
    integer(ip) :: q
    if (max(z(1), z(2)) < series_below) then
      call gentle_memory(z, m%decay, m%phi1, m%phi2, m%phi3)
    else
      do q = 1, 2
        one = memory_of(z(q))
        m%decay(q) = one%decay
        m%phi1(q) = one%phi1
        m%phi2(q) = one%phi2
        m%phi3(q) = one%phi3
      end do
    end if
  end subroutine remember_pair

  !> The same for z below series_below.
  pure subroutine gentle_memory(z, decay, phi1, phi2, phi3)
    real(dp), intent(in) :: z(2)
    real(dp), dimension(2), intent(out) :: decay, phi1, phi2, phi3
    real(dp) :: z2, last
    integer(ip) :: q
    !$omp simd private(z2, last)
    do q = 1, 2
      z2 = z(q)*z(q)
      last = (c(4) - z(q)*c(5)) + z2*((c(6) - z(q)*c(7)) + z2*(c(8) - z(q)*c(9)))
      last = (c(0) - z(q)*c(1)) + z2*((c(2) - z(q)*c(3)) + z2*last)
      phi3(q) = last
      phi2(q) = 0.5_dp - z(q)*phi3(q)
      phi1(q) = 1 - z(q)*phi2(q)
      decay(q) = 1 - z(q)*phi1(q)
    end do
  end subroutine gentle_memory

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
    p%slope = p%slope - p%bend*s%x1
  end function parabola_through

  !> int_0^x exp(-(x-t)/tau) p(t) dt with the phi functions of x/tau
  pure function remembered(phi1, phi2, phi3, x, p) result(y)
    real(dp), intent(in) :: phi1, phi2, phi3, x
    type(parabola_type), intent(in) :: p
    real(dp) :: y
    y = x*(p%start*phi1 + x*(p%slope*phi2 + x*((2*p%bend)*phi3)))
  end function remembered

  !> int_0^x p(t) dt
  pure function integrated(x, p) result(y)
    real(dp), intent(in) :: x
    type(parabola_type), intent(in) :: p
    real(dp) :: y
    y = x*(p%start + x*(p%slope*0.5_dp + x*(p%bend*(1.0_dp/3.0_dp))))
  end function integrated

  !> int_0^x (x-t) p(t) dt
  pure function integrated_twice(x, p) result(y)
    real(dp), intent(in) :: x
    type(parabola_type), intent(in) :: p
    real(dp) :: y
    y = x*x*(p%start*0.5_dp + x*(p%slope*(1.0_dp/6.0_dp) + x*(p%bend*(1.0_dp/12.0_dp))))
  end function integrated_twice

  !> Derivatives of int_0^x p dt and int_0^x (x-t) p(t) dt at both points (first index) by the values of p there.
  pure subroutine shares(x, s, once, twice)
    real(dp), intent(in) :: x(2)
    type(spacing_type), intent(in) :: s
    real(dp), intent(out) :: once(2, 2), twice(2, 2)
    real(dp) :: first, last, square, third
    integer(ip) :: q
    first = s%first*s%between
    last = s%last*s%between
    !$omp simd private(square, third)
    do q = 1, 2
      square = x(q)*x(q)
      third = x(q)*(1.0_dp/3.0_dp)
      once(q, 1) = square*first*(0.5_dp*x(2) - third)
      once(q, 2) = square*last*(third - 0.5_dp*x(1))
      square = square*(0.5_dp*third)
      twice(q, 1) = square*first*(x(2) - 0.5_dp*x(q))
      twice(q, 2) = square*last*(0.5_dp*x(q) - x(1))
    end do
  end subroutine shares

  !> Derivatives of what is remembered of p at both points (first index) by the values of p there.
  pure function memory_shares(m, x, s) result(share)
    type(memory_pair_type), intent(in) :: m
    real(dp), intent(in) :: x(2)
    type(spacing_type), intent(in) :: s
    real(dp) :: share(2, 2), first, last, square
    integer(ip) :: q
    first = s%first*s%between
    last = s%last*s%between
    !$omp simd private(square)
    do q = 1, 2
      square = x(q)*x(q)
      share(q, 1) = square*first*(x(2)*m%phi2(q) - 2*x(q)*m%phi3(q))
      share(q, 2) = square*last*(2*x(q)*m%phi3(q) - x(1)*m%phi2(q))
    end do
  end function memory_shares
end module rst_memory
