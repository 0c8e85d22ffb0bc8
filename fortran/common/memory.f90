!> Fading memory over one step: int_0^x exp(-(x-t)/tau) y(t) dt in closed form for linear y, for any
!> tau.
!>
!> phi_1(z) = (1-exp(-z))/z, phi_2 = (1-phi_1)/z with z = x/tau: finite for tau -> 0 (the dashpot
!> limit) and tau -> infinity (the elastic one), so no relaxation time limits the step.
module rst_memory
  use rst_precision, only: dp
  implicit none (type, external)
  private
  public :: memory_type, memory_of

  !> exp(-z) and the phi functions.
  type :: memory_type
    real(dp) :: decay, phi1, phi2
  end type memory_type

  real(dp), parameter :: series_below = 0.5_dp  !! beyond, the closed form loses less than two digits
  integer :: i
  real(dp), parameter :: c(0:9) = [(1/gamma(i + 4.0_dp), i=0, 9)]  !! (1/2 - phi_2)/z = sum_i (-z)^i/(i+3)!

contains

  elemental function memory_of(z) result(m)
    real(dp), intent(in) :: z
    type(memory_type) :: m
    real(dp) :: series
    integer :: k
    if (z < series_below) then
      series = c(9)
      do k = 8, 0, -1
        series = c(k) - z*series
      end do
      m%phi2 = 0.5_dp - z*series
      m%phi1 = 1 - z*m%phi2
      m%decay = 1 - z*m%phi1
    else
      m%decay = exp(-z)
      m%phi1 = (1 - m%decay)/z
      m%phi2 = (1 - m%phi1)/z
    end if
  end function memory_of
end module rst_memory
