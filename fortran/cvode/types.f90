! SPDX-License-Identifier: BSD-3-Clause
!> Types of the kernels of the method `cvode`: the scene, the contact, and the positions of the
!> states in CVODE's vector.
!>
!> States: D, D', n_terms times M, n_terms times P and, with a tangential side, U, U', n_terms times
!> the tangential M.
module rst_cvode_types
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: scene_type, contact_type, shear_sums_type, energy_type
  public :: state_depth, state_velocity, memory_at, loading_at, shift_at, shear_velocity_at, shear_memory_at

  integer(ip), parameter :: state_depth = 1, state_velocity = 2

  !> Twin of `struct cvode_scene` in C.
  type, bind(c) :: scene_type
    real(dp) :: chi, g_inf, eta
    real(dp) :: reference    !! time at which fading memory of elements is kept
    real(dp) :: step_start   !! time at which the step under way began
    integer(ip) :: n_terms, n_modes, n_states, n_knots
    integer(ip) :: n_nodes   !! capacity of the arrays of elements
    integer(ip) :: n_entered !! elements 1..n_entered have their memory
    integer(ip) :: restitution
    integer(ip) :: mode      !! how friction acts
  end type scene_type

  !> A^2 (below 0: how far past the end of contact), A, int_0^A f dX. Twin of
  !> `struct cvode_contact`.
  type, bind(c) :: contact_type
    real(dp) :: square, radius, force
  end type contact_type

  !> int_0^A q dX and the lengths of contact that stick and that slip backwards. Twin of
  !> `struct cvode_sums`.
  type, bind(c) :: shear_sums_type
    real(dp) :: force, stick, backward
    integer(ip) :: n_contact  !! elements inside the edge
  end type shear_sums_type

  !> An element's stresses, the power of its dashpots and the energy of its springs. Twin of
  !> `struct element_energy`.
  type, bind(c) :: energy_type
    real(dp) :: f = 0, q = 0, viscous_z = 0, viscous_x = 0, held_z = 0, held_x = 0
    integer(ip) :: motion = 0
  end type energy_type

contains

  pure function memory_at(k) result(i)
    integer(ip), intent(in) :: k
    integer(ip) :: i
    i = 2 + k
  end function memory_at

  pure function loading_at(scene, k) result(i)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: k
    integer(ip) :: i
    i = 2 + scene%n_terms + k
  end function loading_at

  pure function shift_at(scene) result(i)
    type(scene_type), intent(in) :: scene
    integer(ip) :: i
    i = 3 + 2*scene%n_terms
  end function shift_at

  pure function shear_velocity_at(scene) result(i)
    type(scene_type), intent(in) :: scene
    integer(ip) :: i
    i = 4 + 2*scene%n_terms
  end function shear_velocity_at

  pure function shear_memory_at(scene, k) result(i)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: k
    integer(ip) :: i
    i = 4 + 2*scene%n_terms + k
  end function shear_memory_at
end module rst_cvode_types
