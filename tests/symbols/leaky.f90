! A library that exports a foreign name, takes memory unseen, calls the Fortran run-time library,
! prints and ends the program: the checks must find all of it.
! SPDX-License-Identifier: BSD-3-Clause
subroutine leaky_name(value) bind(c, name="leaky_name")
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_char, c_null_char
  implicit none
  real(c_double), intent(in), value :: value
  interface
    function puts(text) bind(c, name="puts") result(written)
      import :: c_int, c_char
      character(kind=c_char), intent(in) :: text(*)
      integer(c_int) :: written
    end function puts
    subroutine end_program() bind(c, name="abort")
    end subroutine end_program
  end interface
  real(c_double) :: copies(int(value))
  copies = value
  print *, copies
  if (puts("value"//c_null_char) < 0) call end_program()
end subroutine leaky_name

subroutine restitute_private_name() bind(c, name="restitute_private_name")
end subroutine restitute_private_name
