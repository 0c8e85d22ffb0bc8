!> From the sphere to the plane profile that MDR presses into its foundation.
module rst_profile
  use rst_precision, only: dp
  implicit none (type, external)
  private
  public :: plane_profile

contains

  !> g(x) = |x| int_0^|x| f'(r)/sqrt(x^2 - r^2) dr (6) for the parabola f = r^2/(2R): g = x^2/R (8).
  pure function plane_profile(x, radius) result(height) bind(c, name="rst_plane_profile")
    real(dp), intent(in), value :: x, radius
    real(dp) :: height
    height = x*x/radius
  end function plane_profile
end module rst_profile
