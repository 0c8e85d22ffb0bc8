!> How friction acts, as C decides it once for each impact: `enum rst_mode` of src/base/kernels.h.
module rst_friction_mode
  use rst_precision, only: ip
  implicit none (type, external)
  private
  public :: mode_frictionless, mode_gross_slip, mode_partial_slip, mode_no_slip

  integer(ip), parameter :: mode_frictionless = 0, mode_gross_slip = 1, mode_partial_slip = 2, mode_no_slip = 3
end module rst_friction_mode
