!> What the parts of the tangential problem of the method `sync` share: a scene, where the contact point is, a step, and what
!> the loop over elements takes and gives; the loop itself is in module rst_sync_lanes.
module rst_sync_elements
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: scene_type, shear_type, step_type, sums_type, term_type, lanes
  public :: column_x2, column_weight, column_alpha, column_kappa, columns

  integer(ip), parameter :: lanes = 8  !! element arrays are longer by as many than the nodes

  !> Columns of the array of elements: G_inf X^2, weight of the trapezoidal rule, alpha, slip velocity kappa.
  integer(ip), parameter :: column_x2 = 1, column_weight = 2, column_alpha = 3, column_kappa = 4, columns = 4

  !> Twin of `struct sync_scene` in C.
  type, bind(c) :: scene_type
    real(dp) :: chi, psi, g_inf, eta
    integer(ip) :: n_terms, n, capacity  !! capacity: of the element arrays, n + 1 rounded up to whole lanes
    integer(ip) :: no_slip
    integer(ip) :: stepped  !! with elements from the start; 0: if slip does not stay behind one front
  end type scene_type

  !> Where the contact point is at a level. Twin of `struct sync_shear` in C.
  type, bind(c) :: shear_type
    real(dp) :: time, shift, velocity, force     !! s, U, U', int_0^A q dX
    real(dp) :: step_before(2), force_before(2)  !! the steps that ended here and at the level before; S at the two levels before
    real(dp) :: normal_before(0:2)               !! int_0^A f dX here and at the two levels before
    real(dp) :: slope                            !! dS/ds at the end of gross slip
    real(dp) :: passive_weight, passive_alpha    !! weighted sums over the passive nodes
    integer(ip) :: known                         !! how many steps were made, up to 3
    integer(ip) :: level, first, front, updates  !! first: active node; front: outermost node that sticks, -1: none
  end type shear_type

  !> A step from level to level, as all elements see it. Of the slip velocity before, the share 1 - drop goes on.
  type, bind(c) :: step_type
    real(dp) :: h
    real(dp) :: q, f               !! Q, and f + G_inf X^2 of an element that forgets nothing
    real(dp) :: spring             !! G_inf h/2
    real(dp) :: start_response, end_response  !! of a force to the velocities at both ends of the step
    real(dp) :: drop
    integer(ip) :: first, last     !! nodes to be moved, and those that fill the last group of lanes, which are not in contact
    integer(ip) :: n_terms, capacity
  end type step_type

  !> A relaxation time in a step: y <- decay y + from_start v_0 + from_end v_1 + from_bend b for the velocity
  !> v_0 (1-x/h) + v_1 x/h + b x (x-h); M of the contact point at both ends of the step; weighted sums over the passive nodes of
  !> beta, and of `faded` over all; what is left at both ends of the step of what the outermost passive node had at its entry.
  !> Twin of `struct sync_term` in C.
  type, bind(c) :: term_type
    real(dp) :: decay, from_start, from_end, from_bend, stress, next_stress
    real(dp) :: beta_sum, faded_sum, age_before, age
  end type term_type

  !> Over the nodes moved, weighted: int q dX, the width that sticks.
  type, bind(c) :: sums_type
    real(dp) :: q, stuck
  end type sums_type
end module rst_sync_elements
