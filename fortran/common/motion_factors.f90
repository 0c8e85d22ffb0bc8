!> The factors of the equations of motion in the units of docs/theory.md, section 2.
module rst_motion_factors
  use rst_precision, only: dp
  implicit none (type, external)
  private
  public :: mass_factor, shear_factor

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp   !! D'' = -(15/8) int_0^A f dX
  real(dp), parameter :: shear_factor = 15.0_dp/4.0_dp  !! U'' = -(15/4) chi int_0^A q dX
end module rst_motion_factors
