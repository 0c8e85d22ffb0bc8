!> The factors of the equations of motion in the units of docs/theory.md, section 2, and how long an
!> elastic impact lasts.
module rst_motion_factors
  use rst_precision, only: dp
  implicit none (type, external)
  private
  public :: mass_factor, shear_factor, elastic_contact_time, rst_mass_factor, rst_elastic_contact_time

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp       !! D'' = -(15/8) int_0^A f dX
  real(dp), parameter :: shear_factor = 2*mass_factor       !! U'' = -(15/4) chi int_0^A q dX
  real(dp), parameter :: elastic_contact_time = 2.9432751843_dp  !! over the largest indentation, at unit speed: Hertz

contains

  ! The same for C, which sees no parameters.

  pure real(dp) function rst_mass_factor() bind(c)
    rst_mass_factor = mass_factor
  end function rst_mass_factor

  pure real(dp) function rst_elastic_contact_time() bind(c)
    rst_elastic_contact_time = elastic_contact_time
  end function rst_elastic_contact_time
end module rst_motion_factors
