! SPDX-License-Identifier: BSD-3-Clause
!> Energies of the elements at an instant, for the ledger of the method `cvode` (docs/theory.md,
!> section 8). In gross slip the tangential state of an element equals its normal one.
module rst_cvode_ledger
  use rst_cvode_types, only: scene_type, energy_type, state_depth, state_velocity, memory_at, shift_at, shear_velocity_at, &
                             shear_memory_at
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: element_energies

contains

  !> Elements 1..n_last; in compression those outside the edge are as if they entered now. Memory of
  !> elements is that of the reference time, which is t.
  subroutine element_energies(scene, g, tau, x, entry, past, motion, shift, c, b, rate_of, u_of, v_of, amplitude, shears, &
                              n_last, t, y, energy) bind(c, name="rst_cvode_element_energies")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), x(scene%n_nodes), entry(scene%n_nodes)
    real(dp), intent(in) :: past(scene%n_nodes, scene%n_terms)
    integer(ip), intent(in) :: motion(scene%n_nodes)
    real(dp), intent(in) :: shift(scene%n_nodes), c(scene%n_nodes, scene%n_terms), b(scene%n_nodes, scene%n_terms)
    real(dp), intent(in) :: rate_of(scene%n_modes), u_of(scene%n_modes), v_of(scene%n_terms, scene%n_modes)
    real(dp), intent(in) :: amplitude(scene%n_nodes, scene%n_modes)
    integer(ip), intent(in), value :: shears, n_last
    real(dp), intent(in), value :: t
    real(dp), intent(in) :: y(scene%n_states)
    type(energy_type), intent(inout) :: energy(scene%n_nodes)
    real(dp) :: edge_speed
    integer(ip) :: i

    edge_speed = y(state_velocity)
    if (shears /= 0) edge_speed = max(-edge_speed, min(edge_speed, y(shear_velocity_at(scene))))
    do i = 1, n_last
      if (scene%restitution == 0 .and. (x(i)**2 >= y(state_depth) .or. (shears /= 0 .and. i > scene%n_entered))) then
        energy(i) = energy_type(viscous_z=scene%eta*y(state_velocity)**2, viscous_x=scene%eta*edge_speed**2, &
                                f=scene%eta*y(state_velocity), q=scene%eta*edge_speed)
      else
        call of_element(i, energy(i))
        if (shears /= 0) call of_its_shear(i, energy(i))
      end if
    end do

  contains

    !> The normal side, and the tangential one in gross slip.
    subroutine of_element(i, e)
      integer(ip), intent(in) :: i
      type(energy_type), intent(out) :: e
      real(dp) :: u, stress
      integer(ip) :: k
      u = y(state_depth) - x(i)**2
      e%f = scene%g_inf*u + scene%eta*y(state_velocity)
      e%viscous_z = scene%eta*y(state_velocity)**2
      e%held_z = 0.5_dp*scene%g_inf*u**2
      do k = 1, scene%n_terms
        stress = y(memory_at(k)) - exp(-max(t - entry(i), 0.0_dp)/tau(k))*past(i, k)
        e%f = e%f + stress
        e%viscous_z = e%viscous_z + stress**2/(g(k)*tau(k))
        e%held_z = e%held_z + 0.5_dp*stress**2/g(k)
      end do
      e%q = e%f
      e%viscous_x = e%viscous_z
      e%held_x = e%held_z
    end subroutine of_element

    subroutine of_its_shear(i, e)
      integer(ip), intent(in) :: i
      type(energy_type), intent(inout) :: e
      real(dp) :: u, speed, sense, v, stress, remainder
      integer(ip) :: j, k
      e%motion = motion(i)
      sense = real(motion(i), dp)
      remainder = 0
      speed = y(shear_velocity_at(scene))
      if (motion(i) /= 0) then
        speed = sense*y(state_velocity)
        do j = 1, scene%n_modes
          remainder = remainder + u_of(j)*amplitude(i, j)
          speed = speed - rate_of(j)*u_of(j)*amplitude(i, j)
        end do
        u = sense*(y(state_depth) - x(i)**2) + remainder
      else
        u = y(shift_at(scene)) - shift(i)
      end if
      e%q = scene%g_inf*u + scene%eta*speed
      e%viscous_x = scene%eta*speed**2
      e%held_x = 0.5_dp*scene%g_inf*u**2
      do k = 1, scene%n_terms
        if (motion(i) == 0) then
          stress = y(shear_memory_at(scene, k)) - (c(i, k) - b(i, k))
        else
          v = 0
          do j = 1, scene%n_modes
            v = v + v_of(k, j)*amplitude(i, j)
          end do
          stress = sense*(y(memory_at(k)) - c(i, k)) + g(k)*(remainder - v)
        end if
        e%q = e%q + stress
        e%viscous_x = e%viscous_x + stress**2/(g(k)*tau(k))
        e%held_x = e%held_x + 0.5_dp*stress**2/g(k)
      end do
    end subroutine of_its_shear
  end subroutine element_energies
end module rst_cvode_ledger
