!> What C calls of the method `sync`, under its C names. Arrays come as addresses in two structs,
!> which become views here.
module rst_sync_interface
  use, intrinsic :: iso_c_binding, only: c_ptr, c_f_pointer, c_double, c_int64_t
  use rst_collocation, only: stages, weights_at
  use rst_panel, only: panel_type, normal_type
  use rst_normal_motion, only: normal_control_type, follow_normal
  use rst_store, only: contact_type, store_type, of_arm
  use rst_tangential_motion, only: follow_contact, find_velocity
  implicit none (type, external)
  private
  public :: normal_arrays_type, store_arrays_type
  public :: rst_follow_normal, rst_follow_contact, rst_find_velocity, rst_weights_at

  !> Twin of `struct sync_normal` in C: see normal_type.
  type, bind(c) :: normal_arrays_type
    real(c_double) :: eta, scale, closeness, residual_speed
    integer(c_int64_t) :: n_arms, n_compression, n_panels
    type(c_ptr) :: g, rate, panel, memory, loading, kernel, entry
  end type normal_arrays_type

  !> Twin of `struct sync_store` in C: see store_type; capacity: of records and pieces; room: for
  !> the kernel_room, memory_z, memory_x and loading_x of store_type.
  type, bind(c) :: store_arrays_type
    integer(c_int64_t) :: capacity, n_records, n_pieces, n_trials
    type(c_ptr) :: record, piece, corrective, room
  end type store_arrays_type

contains

  !> The normal motion: fills the panels of `normal`, of which there are control%capacity.
  subroutine rst_follow_normal(control, normal, found) bind(c, name="rst_follow_normal")
    type(normal_control_type), intent(in) :: control
    type(normal_arrays_type), intent(inout) :: normal
    integer(c_int64_t), intent(out) :: found
    type(normal_type) :: n
    n = view_normal(normal, control%capacity)
    call follow_normal(control, n, found)
    normal%residual_speed = n%residual_speed
    normal%n_compression = n%n_compression
    normal%n_panels = n%n_panels
  end subroutine rst_follow_normal

  !> The tangential motion on a normal one: U' at the end, and what module rst_tangential_motion
  !> found.
  subroutine rst_follow_contact(normal, contact, store, velocity, found) bind(c, name="rst_follow_contact")
    type(normal_arrays_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(store_arrays_type), intent(inout) :: store
    real(c_double), intent(out) :: velocity
    integer(c_int64_t), intent(out) :: found
    type(normal_type) :: n
    type(store_type) :: s
    n = view_normal(normal, normal%n_panels)
    s = view_store(store, n%n_arms)
    call follow_contact(n, contact, s, velocity, found)
    store%n_records = s%n_records
    store%n_pieces = s%n_pieces
    store%n_trials = s%n_trials
  end subroutine rst_follow_contact

  !> The edge angle at which D' has fallen to a velocity; returning: /= 0 in the restitution.
  subroutine rst_find_velocity(normal, velocity, angle, returning) bind(c, name="rst_sync_find_velocity")
    type(normal_arrays_type), intent(in) :: normal
    real(c_double), intent(in), value :: velocity
    real(c_double), intent(out) :: angle
    integer(c_int64_t), intent(out) :: returning
    type(normal_type) :: n
    integer(c_int64_t) :: panel
    real(c_double) :: x
    n = view_normal(normal, normal%n_panels)
    call find_velocity(n, velocity, panel, x)
    angle = n%panel(panel)%from + x*(n%panel(panel)%to - n%panel(panel)%from)
    returning = merge(1_c_int64_t, 0_c_int64_t, panel > n%n_compression)
  end subroutine rst_find_velocity

  function view_normal(normal, panels) result(n)
    type(normal_arrays_type), intent(in) :: normal
    integer(c_int64_t), intent(in) :: panels
    type(normal_type) :: n
    integer(c_int64_t) :: arms, points
    arms = normal%n_arms
    points = (1 + stages)*arms*panels
    n%eta = normal%eta
    n%scale = normal%scale
    n%closeness = normal%closeness
    n%residual_speed = normal%residual_speed
    n%n_arms = arms
    n%n_compression = normal%n_compression
    n%n_panels = normal%n_panels
    call c_f_pointer(normal%panel, n%panel, [panels])
    n%g => numbers(normal%g, arms)
    n%rate => numbers(normal%rate, arms)
    n%memory(0:stages, 1:arms, 1:panels) => numbers(normal%memory, points)
    n%loading(0:stages, 1:arms, 1:panels) => numbers(normal%loading, points)
    n%kernel(1:stages, 0:stages, 1:arms, 1:panels) => numbers(normal%kernel, stages*points)
    n%entry(1:stages, 1:arms, 1:2) => numbers(normal%entry, 2*stages*arms)
  end function view_normal

  function view_store(store, arms) result(s)
    type(store_arrays_type), intent(in) :: store
    integer(c_int64_t), intent(in) :: arms
    type(store_type) :: s
    real(c_double), pointer, contiguous :: room(:)
    integer(c_int64_t) :: points
    points = (1 + stages)*arms
    s%n_records = 0
    s%n_pieces = 0
    s%n_trials = store%n_trials
    call c_f_pointer(store%record, s%record, [store%capacity])
    call c_f_pointer(store%piece, s%piece, [store%capacity])
    s%corrective(1:of_arm, 0:stages, 1:arms, 1:store%capacity) => numbers(store%corrective, of_arm*points*store%capacity)
    room => numbers(store%room, (stages + 3)*points)
    s%kernel_room(1:stages, 0:stages, 1:arms) => room(:stages*points)
    s%memory_z(0:stages, 1:arms) => room(stages*points + 1:)
    s%memory_x(0:stages, 1:arms) => room((stages + 1)*points + 1:)
    s%loading_x(0:stages, 1:arms) => room((stages + 2)*points + 1:)
    s%kernel => s%kernel_room
  end function view_store

  function numbers(address, n) result(a)
    type(c_ptr), intent(in) :: address
    integer(c_int64_t), intent(in) :: n
    real(c_double), pointer, contiguous :: a(:)
    call c_f_pointer(address, a, [n])
  end function numbers

  !> The weights of the points of a panel for a value at x.
  subroutine rst_weights_at(x, weight) bind(c, name="rst_sync_weights_at")
    real(c_double), intent(in), value :: x
    real(c_double), intent(out) :: weight(0:stages)
    weight = weights_at(x)
  end subroutine rst_weights_at
end module rst_sync_interface
