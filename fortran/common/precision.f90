!> Kinds shared by every Fortran file: those of C, so that calls between both languages need no
!> conversion.
module rst_precision
  use, intrinsic :: iso_c_binding, only: dp => c_double, ip => c_int64_t
  implicit none (type, external)
  private
  public :: dp, ip
end module rst_precision
