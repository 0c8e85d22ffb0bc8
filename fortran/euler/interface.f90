!> The procedures of this folder that C calls, under their C names. Arguments are described where
!> they are computed.
module rst_euler_interface
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use rst_euler, only: scene_type, state_type, start_impact, advance_impact
  implicit none (type, external)
  private
contains

  pure subroutine rst_start_impact(scene, state, x2) bind(c, name="rst_start_impact")
    type(scene_type), intent(in) :: scene
    type(state_type), intent(out) :: state
    real(c_double), intent(out) :: x2(scene%capacity)
    call start_impact(scene, state, x2)
  end subroutine rst_start_impact

  pure subroutine rst_advance_impact(scene, g, tau, decay, gain, x2, f, yz, u, yx, q, slip, move, q_before, n_steps, &
                                     state) bind(c, name="rst_advance_impact")
    type(scene_type), intent(in) :: scene
    integer(c_int64_t), intent(in), value :: n_steps
    real(c_double), intent(in) :: g(scene%n_terms), tau(scene%n_terms), decay(scene%n_terms), gain(scene%n_terms)
    real(c_double), intent(in) :: x2(scene%capacity)
    real(c_double), intent(inout) :: f(scene%capacity), yz(scene%capacity, scene%n_terms)
    real(c_double), intent(inout) :: u(scene%capacity), yx(scene%capacity, scene%n_terms)
    real(c_double), intent(inout) :: q(scene%capacity), slip(scene%capacity)
    real(c_double), intent(inout) :: move(scene%capacity), q_before(scene%capacity)
    type(state_type), intent(inout) :: state
    call advance_impact(scene, g, tau, decay, gain, x2, f, yz, u, yx, q, slip, move, q_before, n_steps, state)
  end subroutine rst_advance_impact
end module rst_euler_interface
