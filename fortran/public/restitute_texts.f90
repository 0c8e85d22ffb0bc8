! SPDX-License-Identifier: BSD-3-Clause
!> Texts between C and Fortran, and messages of what Fortran checks itself. Of these the module
!> restitute gives restitute_text and restitute_message to its users; the others serve the modules
!> of the components.
module restitute_texts_module
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_pointer, c_int, c_null_char, c_ptr, c_size_t
  use restitute_types_module, only: restitute_error, RESTITUTE_ERROR_DOMAIN, RESTITUTE_OK
  implicit none (type, external)
  private
  public :: restitute_text, restitute_message, text_at, check_length, check_number

  interface
    pure integer(c_size_t) function c_text_length(text) bind(c, name="strlen")
      import
      type(c_ptr), value :: text
    end function c_text_length
  end interface

contains

  !> A Fortran text from letters of C, which end with a null character or with the array.
  pure function restitute_text(letters) result(text)
    character(kind=c_char), intent(in) :: letters(:)
    character(len=:), allocatable :: text
    integer :: k, length
    length = findloc(letters, c_null_char, dim=1) - 1
    if (length < 0) length = size(letters)
    allocate (character(len=length) :: text)
    do k = 1, length
      text(k:k) = letters(k)
    end do
  end function restitute_text

  !> What went wrong in one line; empty when done.
  pure function restitute_message(error) result(text)
    type(restitute_error), intent(in) :: error
    character(len=:), allocatable :: text
    text = restitute_text(error%message)
  end function restitute_message

  !> The text at an address of C; empty for a null address.
  function text_at(address) result(text)
    type(c_ptr), intent(in) :: address
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    text = ""
    if (.not. c_associated(address)) return
    call c_f_pointer(address, letters, [c_text_length(address)])
    text = restitute_text(letters)
  end function text_at

  !> Refuses an array that has not as many values as `like`. An absent one passes, and after a
  !> refusal all do.
  subroutine check_length(name, array, like, length, status, error)
    character(len=*), intent(in) :: name, like
    type(*), intent(in), optional :: array(:)
    integer(c_size_t), intent(in) :: length
    integer(c_int), intent(inout) :: status
    type(restitute_error), intent(inout), optional :: error
    if (present(array)) call check_number(name, size(array, kind=c_size_t), like, length, status, error)
  end subroutine check_length

  !> The same for a number of values.
  subroutine check_number(name, number, like, length, status, error)
    character(len=*), intent(in) :: name, like
    integer(c_size_t), intent(in) :: number, length
    integer(c_int), intent(inout) :: status
    type(restitute_error), intent(inout), optional :: error
    character(len=160) :: message
    integer :: k
    if (status /= RESTITUTE_OK .or. number == length) return
    status = RESTITUTE_ERROR_DOMAIN
    if (.not. present(error)) return
    write (message, "(4a, i0, a, i0)") name, ": must have as many values as ", like, ", ", length, "; has ", number
    error = restitute_error(status)
    do k = 1, len_trim(message)
      error%message(k) = message(k:k)
    end do
  end subroutine check_number
end module restitute_texts_module
