!> What the contact law works on (docs/contact.md): the law, the rates of a time step, the motion of one step, and the layout of
!> the state, a flat array of the caller. The structs are those of src/contact/kernels.h.
module rst_contact_types
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t, c_size_t
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: law_type, rates_type, motion_type, layout_type, layout_of, most_nodes, most_terms, lanes
  public :: at_width, at_overlap, at_force, at_axis, at_arrays

  integer(ip), parameter :: most_nodes = 32, most_terms = 8
  integer(ip), parameter :: lanes = 8  !! elements come in multiples of that: loops of known length become vectors

  !> Header of the state: grid width (0: virgin contact), overlap after the last step, last force (normal, two tangential
  !> components), first tangential axis.
  integer(ip), parameter :: at_width = 1, at_overlap = 2, at_force = 3, at_axis = 6, at_arrays = 9

  !> Where the arrays of the state begin, each of n values: w_z(n, n_terms), u_x, u_y, w_x(n, n_terms), w_y(n, n_terms), u_z;
  !> then the work of the bodies on the contact and what friction took of it.
  type, bind(c) :: layout_type
    integer(c_int64_t) :: w_z, u_x, u_y, w_x, w_y, u_z, work, size
  end type layout_type

  !> An immutable law. Moduli are those of the effective solid; the grid is in units of its width.
  type, bind(c) :: law_type
    integer(c_int64_t) :: n        !! elements
    integer(c_int64_t) :: n_terms
    integer(c_int64_t) :: surface  !! 1: the free surface is a state (dashpot or no equilibrium modulus)
    integer(c_int64_t) :: slips    !! 1: there are tangential states
    integer(c_int64_t) :: accounts !! 1: work and friction are kept
    type(layout_type) :: at
    real(c_double) :: g_inf, eta
    real(c_double) :: softness       !! 1/g_inf, 0 if there is none
    real(c_double) :: normal, tangential  !! 4/(1-nu) and 8/(2-nu): both sides of the contact (9)
    real(c_double) :: g(most_terms), tau(most_terms)
    real(c_double) :: x(most_nodes + 1)  !! nodes, x(n + 1) = 1: where the next one would be
    real(c_double) :: y(most_nodes + 1)  !! x^2
    real(c_double) :: weight(most_nodes)     !! of a node within the contact, in both of its cells
    real(c_double) :: outwards(most_nodes)   !! its part in the outer one, from x(j) to x(j + 1)
  end type law_type

  !> What depends on the time step alone: a displacement du, even over the step, makes w <- decay w + gain du.
  type, bind(c) :: rates_type
    real(c_double) :: step
    real(c_double) :: softness   !! displacement, even over the step, by a unit force: 1/(G_inf + eta/step + sum g gain)
    real(c_double) :: drag       !! force of a change of velocity until the end of the step: eta + sum g bend
    real(c_double) :: decay(most_terms), gain(most_terms), bend(most_terms)
  end type rates_type

  !> One step of one contact: restitute_contact_motion of include/restitute/contact.h.
  type, bind(c) :: motion_type
    integer(c_size_t) :: struct_size
    real(c_double) :: overlap          !! at the end of the step
    real(c_double) :: velocity         !! mean of the step, approaching
    real(c_double) :: displacement(3)  !! of body 1 past body 2 in the step
    real(c_double) :: axis(3)          !! unit normal, from body 1 into body 2
    real(c_double) :: mobility(2)      !! step/(2 m), normal and tangential
    real(c_double) :: radius
    real(c_double) :: friction
  end type motion_type

contains

  pure function layout_of(law) result(at)
    type(law_type), intent(in) :: law
    type(layout_type) :: at
    integer(ip) :: n, arms, slips
    n = law%n
    arms = n*law%n_terms
    slips = law%slips
    at%w_z = at_arrays
    at%u_x = at%w_z + arms
    at%u_y = at%u_x + n*slips
    at%w_x = at%u_y + n*slips
    at%w_y = at%w_x + arms*slips
    at%u_z = at%w_y + arms*slips
    at%work = at%u_z + n*law%surface
    at%size = at%work + 2*law%accounts - 1
  end function layout_of
end module rst_contact_types
