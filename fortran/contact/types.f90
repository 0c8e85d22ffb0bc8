!> Types of the contact law (docs/contact.md): the law, the rates of a time step and the motion of
!> one step. The structs are those of src/contact/kernels.h.
module rst_contact_types
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t, c_size_t
  use rst_precision, only: ip
  implicit none (type, external)
  private
  public :: law_type, rates_type, motion_type, most_nodes, most_terms, lanes
  public :: at_width, at_overlap, at_force, at_axis, at_arrays

  integer(ip), parameter :: most_nodes = 32, most_terms = 8
  integer(ip), parameter :: lanes = 8  !! elements come in multiples of that: loops of known length become vectors

  !> Header of the state: grid width (0: virgin contact), overlap after the last step, last force
  !> (normal, two tangential components), first tangential axis. Then the arrays: w_z(n, n_terms),
  !> u(n, 2), w(n, n_terms, 2), surface(n); then the work of the bodies on the contact and its
  !> friction part.
  integer(ip), parameter :: at_width = 1, at_overlap = 2, at_force = 3, at_axis = 6, at_arrays = 9

  !> An immutable law. Moduli are those of the effective solid; the grid is in units of its width.
  type, bind(c) :: law_type
    integer(c_int64_t) :: n        !! elements
    integer(c_int64_t) :: n_terms
    integer(c_int64_t) :: surface  !! 1: the free surface is a state (dashpot or no equilibrium modulus)
    integer(c_int64_t) :: slips    !! 1: there are tangential states
    integer(c_int64_t) :: accounts !! 1: work and friction are kept
    integer(c_int64_t) :: at_u, at_w, at_surface, at_work, size  !! where the arrays of the state begin
    real(c_double) :: g_inf, eta
    real(c_double) :: compliance          !! 1/g_inf, 0 if there is none
    real(c_double) :: normal, tangential  !! 4/(1-nu) and 8/(2-nu): both sides of the contact (9)
    real(c_double) :: g(most_terms), tau(most_terms)
    real(c_double) :: x(most_nodes + 1)   !! nodes, x(n + 1) = 1: where the next one would be
    real(c_double) :: y(most_nodes + 1)   !! x^2
    real(c_double) :: weight(most_nodes)     !! of a node within the contact, in both of its cells
    real(c_double) :: outwards(most_nodes)   !! its part in the outer one, from x(j) to x(j + 1)
    real(c_double) :: per_cell(most_nodes)   !! 1/(y(j) - y(j - 1)), 0 for the first
    real(c_double) :: bit(most_nodes)        !! 2^(j - 1)
  end type law_type

  !> Values that depend on the time step only: a displacement du, even over the step, makes w <-
  !> decay w + gain du.
  type, bind(c) :: rates_type
    integer(c_size_t) :: struct_size
    real(c_double) :: step
    integer(c_int64_t) :: law    !! hash
    real(c_double) :: compliance !! displacement, even over the step, by a unit force: 1/(G_inf + eta/step + sum g gain)
    real(c_double) :: viscosity  !! force of a change of velocity until the end of the step: eta + sum g bend
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
end module rst_contact_types
