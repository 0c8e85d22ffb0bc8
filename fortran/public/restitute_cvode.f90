! SPDX-License-Identifier: BSD-3-Clause
!> The component cvode for Fortran: all that cvode.h declares, under the same names. cvode.h is the
!> manual, and the rules of the module restitute hold. Link restitute::fortran_cvode.
!>
!>     use restitute
!>     use restitute_cvode_module
!>     type(restitute_cvode_recorder) :: recorder
!>     type(restitute_cvode_event), allocatable :: events(:)
!>     status = restitute_cvode_recorder_create(recorder=recorder, error=error)
!>     options%method = restitute_cvode_recorder_method(recorder)
!>     ...                                              ! a solver with these options solves
!>     status = restitute_cvode_recorder_events(recorder, events, error)
!>     do i = 1, size(events)
!>       print *, events(i)%time, restitute_cvode_event_text(events(i)%kind)
!>     end do
module restitute_cvode_module
  use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int64_t, c_loc, c_null_ptr, c_ptr, c_size_t, c_sizeof
  use restitute, only: restitute_error, restitute_method, RESTITUTE_ERROR_MEMORY
  use restitute_texts_module, only: text_at
  implicit none (type, external)
  private
  public :: restitute_cvode_event, restitute_cvode_events, restitute_cvode_work, restitute_cvode_recorder
  public :: restitute_method_cvode, restitute_method_cvode_bdf, restitute_method_cvode_adams
  public :: restitute_cvode_sundials_version, restitute_cvode_event_text
  public :: restitute_cvode_recorder_create, restitute_cvode_recorder_destroy, restitute_cvode_recorder_method
  public :: restitute_cvode_recorder_events, restitute_cvode_recorder_work

  !> Kinds of events, see restitute_cvode_event_text.
  integer(c_int), parameter, public :: &
    RESTITUTE_CVODE_EVENT_ENTRY = 1, &
    RESTITUTE_CVODE_EVENT_EXIT = 2, &
    RESTITUTE_CVODE_EVENT_GROSS_SLIP_END = 3, &
    RESTITUTE_CVODE_EVENT_STICK_TO_SLIP = 4, &
    RESTITUTE_CVODE_EVENT_SLIP_TO_STICK = 5, &
    RESTITUTE_CVODE_EVENT_TURN = 6, &
    RESTITUTE_CVODE_EVENT_CONTACT_END = 7

  !> One event.
  type, bind(c) :: restitute_cvode_event
    real(c_double) :: time = 0, position = 0, indentation = 0, normal_velocity = 0, tangential_velocity = 0
    integer(c_int) :: kind = 0, elements = 0
  end type restitute_cvode_event

  !> What C asks for events with; restitute_cvode_recorder_events does it for you.
  type, bind(c) :: restitute_cvode_events
    integer(c_size_t) :: struct_size = 0, capacity = 0, count = 0
    type(c_ptr) :: event = c_null_ptr
  end type restitute_cvode_events

  !> Work behind an impact.
  type, bind(c) :: restitute_cvode_work
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: steps = 0, restarts = 0, rates = 0, events = 0, stiff = 0
  end type restitute_cvode_work

  !> A method that keeps events and work, made by restitute_cvode_recorder_create, released by
  !> _destroy.
  type, bind(c) :: restitute_cvode_recorder
    type(c_ptr) :: address = c_null_ptr
  end type restitute_cvode_recorder

  interface restitute_cvode_events
    module procedure new_cvode_events
  end interface restitute_cvode_events
  interface restitute_cvode_work
    module procedure new_cvode_work
  end interface restitute_cvode_work

  interface
    subroutine init_cvode_events(value, size) bind(c, name="restitute_cvode_events_init_sized")
      import
      type(restitute_cvode_events), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_cvode_events

    subroutine init_cvode_work(value, size) bind(c, name="restitute_cvode_work_init_sized")
      import
      type(restitute_cvode_work), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_cvode_work

    type(c_ptr) function c_cvode() bind(c, name="restitute_method_cvode")
      import
    end function c_cvode

    type(c_ptr) function c_cvode_bdf() bind(c, name="restitute_method_cvode_bdf")
      import
    end function c_cvode_bdf

    type(c_ptr) function c_cvode_adams() bind(c, name="restitute_method_cvode_adams")
      import
    end function c_cvode_adams

    type(c_ptr) function c_sundials_version() bind(c, name="restitute_cvode_sundials_version")
      import
    end function c_sundials_version

    type(c_ptr) function c_event_text(kind) bind(c, name="restitute_cvode_event_text")
      import
      integer(c_int), value :: kind
    end function c_event_text

    integer(c_int) function c_create(method, recorder, error) bind(c, name="restitute_cvode_recorder_create")
      import
      type(c_ptr), value :: method
      type(restitute_cvode_recorder), intent(inout) :: recorder
      type(restitute_error), intent(inout), optional :: error
    end function c_create

    subroutine c_destroy(recorder) bind(c, name="restitute_cvode_recorder_destroy")
      import
      type(c_ptr), value :: recorder
    end subroutine c_destroy

    type(c_ptr) function c_method(recorder) bind(c, name="restitute_cvode_recorder_method")
      import
      type(c_ptr), value :: recorder
    end function c_method

    integer(c_int) function c_events(recorder, events, error) bind(c, name="restitute_cvode_recorder_events")
      import
      type(c_ptr), value :: recorder
      type(restitute_cvode_events), intent(inout) :: events
      type(restitute_error), intent(inout), optional :: error
    end function c_events

    integer(c_int) function c_work(recorder, work, error) bind(c, name="restitute_cvode_recorder_work")
      import
      type(c_ptr), value :: recorder
      type(restitute_cvode_work), intent(inout) :: work
      type(restitute_error), intent(inout), optional :: error
    end function c_work
  end interface

contains

  type(restitute_cvode_events) function new_cvode_events() result(new)
    call init_cvode_events(new, c_sizeof(new))
  end function new_cvode_events

  type(restitute_cvode_work) function new_cvode_work() result(new)
    call init_cvode_work(new, c_sizeof(new))
  end function new_cvode_work

  type(restitute_method) function restitute_method_cvode() result(method)
    method%address = c_cvode()
  end function restitute_method_cvode

  type(restitute_method) function restitute_method_cvode_bdf() result(method)
    method%address = c_cvode_bdf()
  end function restitute_method_cvode_bdf

  type(restitute_method) function restitute_method_cvode_adams() result(method)
    method%address = c_cvode_adams()
  end function restitute_method_cvode_adams

  function restitute_cvode_sundials_version() result(text)
    character(len=:), allocatable :: text
    text = text_at(c_sundials_version())
  end function restitute_cvode_sundials_version

  function restitute_cvode_event_text(kind) result(text)
    integer(c_int), intent(in) :: kind
    character(len=:), allocatable :: text
    text = text_at(c_event_text(kind))
  end function restitute_cvode_event_text

  integer(c_int) function restitute_cvode_recorder_create(method, recorder, error) result(status)
    type(restitute_method), intent(in), optional :: method
    type(restitute_cvode_recorder), intent(inout) :: recorder
    type(restitute_error), intent(inout), optional :: error
    type(restitute_method) :: wanted
    if (present(method)) wanted = method
    status = c_create(wanted%address, recorder, error)
  end function restitute_cvode_recorder_create

  subroutine restitute_cvode_recorder_destroy(recorder)
    type(restitute_cvode_recorder), intent(inout) :: recorder
    call c_destroy(recorder%address)
    recorder%address = c_null_ptr
  end subroutine restitute_cvode_recorder_destroy

  type(restitute_method) function restitute_cvode_recorder_method(recorder) result(method)
    type(restitute_cvode_recorder), intent(in) :: recorder
    method%address = c_method(recorder%address)
  end function restitute_cvode_recorder_method

  !> Events is made as long as there are events.
  integer(c_int) function restitute_cvode_recorder_events(recorder, events, error) result(status)
    type(restitute_cvode_recorder), intent(in) :: recorder
    type(restitute_cvode_event), allocatable, intent(inout) :: events(:)
    type(restitute_error), intent(inout), optional :: error
    type(restitute_cvode_event), allocatable, target :: found(:)
    type(restitute_cvode_events) :: place
    integer :: failed
    place = restitute_cvode_events()
    status = c_events(recorder%address, place, error) ! without capacity: their number
    if (status < 0) return
    allocate (found(place%count), stat=failed)
    if (failed /= 0) status = RESTITUTE_ERROR_MEMORY
    place%capacity = place%count
    if (place%count > 0) place%event = c_loc(found)
    if (failed == 0) status = c_events(recorder%address, place, error)
    if (status >= 0) call move_alloc(found, events)
  end function restitute_cvode_recorder_events

  integer(c_int) function restitute_cvode_recorder_work(recorder, work, error) result(status)
    type(restitute_cvode_recorder), intent(in) :: recorder
    type(restitute_cvode_work), intent(inout) :: work
    type(restitute_error), intent(inout), optional :: error
    status = c_work(recorder%address, work, error)
  end function restitute_cvode_recorder_work
end module restitute_cvode_module
