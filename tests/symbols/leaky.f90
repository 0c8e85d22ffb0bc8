! A library that exports a foreign name and calls the Fortran run-time library: the check must find both.
! SPDX-License-Identifier: BSD-3-Clause
subroutine leaky_name(value) bind(c, name="leaky_name")
  use, intrinsic :: iso_c_binding, only: c_double
  real(c_double), intent(in), value :: value
  print *, value
end subroutine leaky_name
