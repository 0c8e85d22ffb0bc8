!> What the tangential problem of the method `sync` works on: views of the caller's arrays, set by
!> the interface to C.
module rst_store
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages
  implicit none (type, external)
  private
  public :: contact_type, record_type, piece_type, store_type, of_touch, of_arm, backward, sticks, forward

  !> Sense (sigma) of the slip at the edge.
  enum, bind(c)
    enumerator :: backward = -1, sticks = 0, forward = 1
  end enum

  !> Kinds of values of an element and of each of its arms, beside each other since one needs all of
  !> them at an angle.
  integer(ip), parameter :: of_touch = 4, of_arm = 4

  !> The tangential problem. Twin of `struct sync_contact` in C.
  type, bind(c) :: contact_type
    real(dp) :: chi, psi     !! psi: U' at first touch, 1 without slip
    real(dp) :: roughness   !! what the polynomial of a piece may miss of U'
    real(dp) :: noise       !! stick margin over `stress`, angles and velocities that the polynomials of the normal motion may miss
    real(dp) :: closeness   !! iterations end when U' changes by less
    real(dp) :: stress      !! a usual stress: largest force over largest radius
    integer(ip) :: mode     !! how friction acts
  end type contact_type

  !> A range of the compression in which all elements stick, or all slip: what they were given when
  !> the edge reached them, here and in `corrective` of store_type. The edge angle goes from `from`
  !> to `to`. touch: X, t_X, and D' and U' times |ds/dtheta|. Twin of `struct sync_record` in C.
  type, bind(c) :: record_type
    real(dp) :: from, to
    real(dp) :: touch(of_touch, 0:stages)
  end type record_type

  !> A solved piece of a panel, for histories: x from `from` to `to`; rooted: in the root of what is
  !> left of it. U', S and the stick radius at its points. Twin of `struct sync_piece` in C.
  type, bind(c) :: piece_type
    integer(ip) :: panel, rooted
    real(dp) :: from, to
    real(dp), dimension(0:stages) :: shear_velocity, shear_force, stick_radius
  end type piece_type

  !> Records, pieces and room. (0:stages, arms): of the piece being solved, (0) is its start.
  type :: store_type
    integer(ip) :: n_records, n_pieces, n_trials !! n_trials: pieces that may still be tried
    type(record_type), pointer, contiguous :: record(:)
    type(piece_type), pointer, contiguous :: piece(:)
    real(dp), pointer, contiguous :: corrective(:, :, :, :) !! (of_arm, 0:stages, arms, records): m_k, p_k for sigma = 1, for -1
    !> (stages, 0:stages, arms). kernel: of the piece, either its panel's in normal_type or the room
    real(dp), pointer, contiguous, dimension(:, :, :) :: kernel, kernel_room
    real(dp), pointer, contiguous, dimension(:, :) :: memory_z, memory_x, loading_x !! M_k in z, in x, P_k in x
  end type store_type
end module rst_store
