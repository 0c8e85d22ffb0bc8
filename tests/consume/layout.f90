! SPDX-License-Identifier: BSD-3-Clause
!> Every public struct has the same layout in C and in Fortran: sizes by c_sizeof, offsets by
!> address differences, in the order of layout.c. A member that one side lacks shifts the list and
!> fails, too.
module layout_checks
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use restitute
  implicit none (type, external)
  private
  public :: check_all

  integer :: at = 0, wrong = 0

  interface
    !> The number k (from 0) of layout.c; -1000 behind the last.
    pure function layout_value(k) bind(c, name="layout_value") result(value)
      import :: c_int, c_long_long
      implicit none (type, external)
      integer(c_int), value :: k
      integer(c_long_long) :: value
    end function layout_value
  end interface

contains

  !> Whether all agree.
  function check_all() result(good)
    logical :: good
    call check_error()
    call check_impact()
    call check_scene()
    call check_numbers()
    call check_options()
    call check_result()
    call check_ledger()
    call check_history()
    call check_body()
    call check_contact()
    call check_constants()
    call compare("end", -1000_c_long_long)
    good = wrong == 0
    if (good) print "(i0, a)", at - 1, " sizes, offsets and constants agree"
  end function check_all

  subroutine compare(what, here)
    character(len=*), intent(in) :: what
    integer(c_long_long), intent(in) :: here
    if (layout_value(at) /= here) then
      write (error_unit, "(a, 2(a, i0))") what, ": C ", layout_value(at), ", Fortran ", here
      wrong = wrong + 1
    end if
    at = at + 1
  end subroutine compare

  subroutine offset(what, member, start)
    character(len=*), intent(in) :: what
    type(c_ptr), intent(in) :: member, start
    integer(c_intptr_t) :: a, b
    a = transfer(member, a)
    b = transfer(start, b)
    call compare(what, int(a - b, c_long_long))
  end subroutine offset

  subroutine check_error()
    type(restitute_error), target :: x
    call compare("restitute_error", int(c_sizeof(x), c_long_long))
    call offset("error%status", c_loc(x%status), c_loc(x))
    call offset("error%message", c_loc(x%message), c_loc(x))
  end subroutine check_error

  subroutine check_impact()
    type(restitute_impact), target :: x
    call compare("restitute_impact", int(c_sizeof(x), c_long_long))
    call offset("impact%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("impact%chi", c_loc(x%chi), c_loc(x))
    call offset("impact%psi", c_loc(x%psi), c_loc(x))
    call offset("impact%delta1", c_loc(x%delta1), c_loc(x))
    call offset("impact%gamma", c_loc(x%gamma), c_loc(x))
    call offset("impact%solid", c_loc(x%solid), c_loc(x))
  end subroutine check_impact

  subroutine check_scene()
    type(restitute_scene), target :: x
    call compare("restitute_scene", int(c_sizeof(x), c_long_long))
    call offset("scene%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("scene%material", c_loc(x%material), c_loc(x))
    call offset("scene%deformable", c_loc(x%deformable), c_loc(x))
    call offset("scene%radius1", c_loc(x%radius1), c_loc(x))
    call offset("scene%mass1", c_loc(x%mass1), c_loc(x))
    call offset("scene%radius2", c_loc(x%radius2), c_loc(x))
    call offset("scene%mass2", c_loc(x%mass2), c_loc(x))
    call offset("scene%inertia1", c_loc(x%inertia1), c_loc(x))
    call offset("scene%inertia2", c_loc(x%inertia2), c_loc(x))
    call offset("scene%rotation_blocked", c_loc(x%rotation_blocked), c_loc(x))
    call offset("scene%friction", c_loc(x%friction), c_loc(x))
    call offset("scene%normal_speed", c_loc(x%normal_speed), c_loc(x))
    call offset("scene%tangential_speed", c_loc(x%tangential_speed), c_loc(x))
    call offset("scene%spin1", c_loc(x%spin1), c_loc(x))
    call offset("scene%spin2", c_loc(x%spin2), c_loc(x))
    call offset("scene%density", c_loc(x%density), c_loc(x))
  end subroutine check_scene

  subroutine check_numbers()
    type(restitute_numbers), target :: x
    call compare("restitute_numbers", int(c_sizeof(x), c_long_long))
    call offset("numbers%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("numbers%chi", c_loc(x%chi), c_loc(x))
    call offset("numbers%psi", c_loc(x%psi), c_loc(x))
    call offset("numbers%delta1", c_loc(x%delta1), c_loc(x))
    call offset("numbers%gamma", c_loc(x%gamma), c_loc(x))
    call offset("numbers%delta2", c_loc(x%delta2), c_loc(x))
    call offset("numbers%radius", c_loc(x%radius), c_loc(x))
    call offset("numbers%mass", c_loc(x%mass), c_loc(x))
    call offset("numbers%modulus", c_loc(x%modulus), c_loc(x))
    call offset("numbers%length_z", c_loc(x%length_z), c_loc(x))
    call offset("numbers%length_x", c_loc(x%length_x), c_loc(x))
    call offset("numbers%time", c_loc(x%time), c_loc(x))
    call offset("numbers%force", c_loc(x%force), c_loc(x))
  end subroutine check_numbers

  subroutine check_options()
    type(restitute_options), target :: x
    call compare("restitute_options", int(c_sizeof(x), c_long_long))
    call offset("options%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("options%method", c_loc(x%method), c_loc(x))
    call offset("options%tolerance", c_loc(x%tolerance), c_loc(x))
    call offset("options%elements", c_loc(x%elements), c_loc(x))
    call offset("options%time_step", c_loc(x%time_step), c_loc(x))
    call offset("options%max_updates", c_loc(x%max_updates), c_loc(x))
    call offset("options%time_limit", c_loc(x%time_limit), c_loc(x))
    call offset("options%speed_limit", c_loc(x%speed_limit), c_loc(x))
    call offset("options%radius_limit", c_loc(x%radius_limit), c_loc(x))
    call offset("options%displacement_limit", c_loc(x%displacement_limit), c_loc(x))
    call offset("options%dundurs_limit", c_loc(x%dundurs_limit), c_loc(x))
  end subroutine check_options

  subroutine check_result()
    type(restitute_result), target :: x
    call compare("restitute_result", int(c_sizeof(x), c_long_long))
    call offset("result%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("result%ez", c_loc(x%ez), c_loc(x))
    call offset("result%ex", c_loc(x%ex), c_loc(x))
    call offset("result%error_ez", c_loc(x%error_ez), c_loc(x))
    call offset("result%error_ex", c_loc(x%error_ex), c_loc(x))
    call offset("result%contact_time", c_loc(x%contact_time), c_loc(x))
    call offset("result%max_indentation", c_loc(x%max_indentation), c_loc(x))
    call offset("result%max_contact_radius", c_loc(x%max_contact_radius), c_loc(x))
    call offset("result%max_normal_force", c_loc(x%max_normal_force), c_loc(x))
    call offset("result%merging_bound", c_loc(x%merging_bound), c_loc(x))
    call offset("result%terms_merged", c_loc(x%terms_merged), c_loc(x))
    call offset("result%elements", c_loc(x%elements), c_loc(x))
    call offset("result%steps", c_loc(x%steps), c_loc(x))
    call offset("result%element_spacing", c_loc(x%element_spacing), c_loc(x))
    call offset("result%time_step", c_loc(x%time_step), c_loc(x))
    call offset("result%updates", c_loc(x%updates), c_loc(x))
    call offset("result%speed_ratio", c_loc(x%speed_ratio), c_loc(x))
    call offset("result%radius_ratio", c_loc(x%radius_ratio), c_loc(x))
    call offset("result%displacement_ratio", c_loc(x%displacement_ratio), c_loc(x))
    call offset("result%dundurs_beta", c_loc(x%dundurs_beta), c_loc(x))
    call offset("result%flags", c_loc(x%flags), c_loc(x))
    call offset("result%method", c_loc(x%method), c_loc(x))
  end subroutine check_result

  subroutine check_ledger()
    type(restitute_ledger), target :: x
    call compare("restitute_ledger", int(c_sizeof(x), c_long_long))
    call offset("ledger%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("ledger%rebound_z", c_loc(x%rebound_z), c_loc(x))
    call offset("ledger%viscous_z", c_loc(x%viscous_z), c_loc(x))
    call offset("ledger%left_z", c_loc(x%left_z), c_loc(x))
    call offset("ledger%residual_z", c_loc(x%residual_z), c_loc(x))
    call offset("ledger%rebound_x", c_loc(x%rebound_x), c_loc(x))
    call offset("ledger%friction_x", c_loc(x%friction_x), c_loc(x))
    call offset("ledger%viscous_x", c_loc(x%viscous_x), c_loc(x))
    call offset("ledger%left_x", c_loc(x%left_x), c_loc(x))
    call offset("ledger%residual_x", c_loc(x%residual_x), c_loc(x))
  end subroutine check_ledger

  subroutine check_history()
    type(restitute_history), target :: x
    call compare("restitute_history", int(c_sizeof(x), c_long_long))
    call offset("history%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("history%capacity", c_loc(x%capacity), c_loc(x))
    call offset("history%count", c_loc(x%count), c_loc(x))
    call offset("history%time", c_loc(x%time), c_loc(x))
    call offset("history%indentation", c_loc(x%indentation), c_loc(x))
    call offset("history%contact_radius", c_loc(x%contact_radius), c_loc(x))
    call offset("history%stick_radius", c_loc(x%stick_radius), c_loc(x))
    call offset("history%normal_force", c_loc(x%normal_force), c_loc(x))
    call offset("history%tangential_force", c_loc(x%tangential_force), c_loc(x))
    call offset("history%normal_velocity", c_loc(x%normal_velocity), c_loc(x))
    call offset("history%tangential_velocity", c_loc(x%tangential_velocity), c_loc(x))
  end subroutine check_history

  subroutine check_body()
    type(restitute_body), target :: x
    call compare("restitute_body", int(c_sizeof(x), c_long_long))
    call offset("body%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("body%position", c_loc(x%position), c_loc(x))
    call offset("body%velocity", c_loc(x%velocity), c_loc(x))
    call offset("body%spin", c_loc(x%spin), c_loc(x))
    call offset("body%radius", c_loc(x%radius), c_loc(x))
    call offset("body%mass", c_loc(x%mass), c_loc(x))
    call offset("body%inertia", c_loc(x%inertia), c_loc(x))
    call offset("body%normal", c_loc(x%normal), c_loc(x))
  end subroutine check_body

  subroutine check_contact()
    type(restitute_contact), target :: x
    call compare("restitute_contact", int(c_sizeof(x), c_long_long))
    call offset("contact%struct_size", c_loc(x%struct_size), c_loc(x))
    call offset("contact%material", c_loc(x%material), c_loc(x))
    call offset("contact%deformable", c_loc(x%deformable), c_loc(x))
    call offset("contact%friction", c_loc(x%friction), c_loc(x))
    call offset("contact%touch_gap", c_loc(x%touch_gap), c_loc(x))
    call offset("contact%density", c_loc(x%density), c_loc(x))
  end subroutine check_contact

  subroutine check_constants()
    integer(c_int), parameter :: constants(*) = &
      [RESTITUTE_OK, RESTITUTE_NO_REBOUND, RESTITUTE_TOLERANCE_NOT_REACHED, RESTITUTE_ERROR_NULL, &
       RESTITUTE_ERROR_STRUCT_SIZE, RESTITUTE_ERROR_DOMAIN, RESTITUTE_ERROR_MEMORY, RESTITUTE_ERROR_UNSTABLE_STEP, &
       RESTITUTE_ERROR_TOO_MUCH_WORK, RESTITUTE_ERROR_FILE, RESTITUTE_ERROR_FORMAT, RESTITUTE_ERROR_INTERNAL, &
       RESTITUTE_ERROR_INTEGRATOR, RESTITUTE_ERROR_INTERRUPTED, &
       RESTITUTE_FLAG_FAST, RESTITUTE_FLAG_LARGE_CONTACT, RESTITUTE_FLAG_LONG_SLIDE, RESTITUTE_FLAG_COUPLED, &
       RESTITUTE_ONE_BODY_DEFORMS, RESTITUTE_BOTH_BODIES_DEFORM]
    integer :: k
    do k = 1, size(constants)
      call compare("constant", int(constants(k), c_long_long))
    end do
  end subroutine check_constants
end module layout_checks

program layout
  use layout_checks, only: check_all
  implicit none (type, external)
  if (.not. check_all()) error stop 1
end program layout
