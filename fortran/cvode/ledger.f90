! SPDX-License-Identifier: BSD-3-Clause
!> Energy rates at an instant, for the ledger of the method `cvode` (docs/theory.md, section 8).
!>
!> In units of the normal impact energy, with U in place of D for the tangential side:
!>
!>   viscous_z' = (15/4) int_0^A (sum_k y_k^2/(g_k tau_k) + eta u'^2) dX     x: (15/2) chi times the same of the tangential side
!>   friction'  = (15/2) chi int_0^A f |slip velocity| dX
!>
!> and an element that leaves takes (G_inf u^2 + sum_k y_k^2/g_k)/2 with it. In gross slip the
!> tangential state of an element equals its normal one.
module rst_cvode_ledger
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use rst_cvode_types, only: scene_type, contact_type, state_depth, state_velocity, memory_at, shift_at, shear_velocity_at, &
                             shear_memory_at
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: energy_rates

contains

  !> rate: int dX of the dissipation in z and x and of the work of friction, without the factors;
  !> held_z, held_x: energy of each element inside the edge, or of those 1..n_last, whichever are
  !> more. Memory of elements is that of the reference time, which is t.
  subroutine energy_rates(scene, g, tau, contact, x, entry, past, motion, shift, c, b, rate_of, u_of, v_of, amplitude, shears, &
                          n_last, t, y, rate, held_z, held_x) bind(c, name="rst_cvode_energy_rates")
    type(scene_type), intent(in) :: scene
    type(contact_type), intent(in) :: contact
    real(c_double), intent(in) :: g(scene%n_terms), tau(scene%n_terms), x(scene%n_nodes), entry(scene%n_nodes)
    real(c_double), intent(in) :: past(scene%n_nodes, scene%n_terms)
    integer(c_int64_t), intent(in) :: motion(scene%n_nodes)
    real(c_double), intent(in) :: shift(scene%n_nodes), c(scene%n_nodes, scene%n_terms), b(scene%n_nodes, scene%n_terms)
    real(c_double), intent(in) :: rate_of(scene%n_modes), u_of(scene%n_modes), v_of(scene%n_terms, scene%n_modes)
    real(c_double), intent(in) :: amplitude(scene%n_nodes, scene%n_modes)
    integer(c_int64_t), intent(in), value :: shears, n_last
    real(c_double), intent(in), value :: t
    real(c_double), intent(in) :: y(scene%n_states)
    real(c_double), intent(out) :: rate(3)
    real(c_double), intent(inout) :: held_z(scene%n_nodes), held_x(scene%n_nodes)
    real(dp) :: inner, outer, now(3), edge(3), velocity
    integer(ip) :: i, n

    n = 0
    do while (n < scene%n_nodes)
      if (x(n + 1)**2 >= contact%square) exit
      n = n + 1
    end do
    rate = 0
    inner = 0
    do i = 1, max(n, n_last)
      call of_element(i, now)
      if (i > n) cycle
      outer = contact%radius
      if (i < n) outer = x(i + 1)
      rate = rate + 0.5_dp*(outer - inner)*now
      inner = x(i)
    end do
    if (n == 0) return
    velocity = y(state_velocity)
    edge = 0
    if (scene%restitution == 0) then
      edge(1) = scene%eta*velocity**2
      edge(2) = edge(1)
      if (shears /= 0) edge(2) = scene%eta*max(-velocity, min(velocity, y(shear_velocity_at(scene))))**2
    end if
    rate = rate + 0.5_dp*(contact%radius - x(n))*edge

  contains

    !> One element.
    subroutine of_element(i, now)
      integer(ip), intent(in) :: i
      real(dp), intent(out) :: now(3)
      real(dp) :: u, f, stress
      integer(ip) :: k
      u = y(state_depth) - x(i)**2
      f = scene%g_inf*u + scene%eta*y(state_velocity)
      now(1) = scene%eta*y(state_velocity)**2
      held_z(i) = 0.5_dp*scene%g_inf*u**2
      do k = 1, scene%n_terms
        stress = y(memory_at(k)) - exp(-max(t - entry(i), 0.0_dp)/tau(k))*past(i, k)
        f = f + stress
        now(1) = now(1) + stress**2/(g(k)*tau(k))
        held_z(i) = held_z(i) + 0.5_dp*stress**2/g(k)
      end do
      now(2) = now(1)
      now(3) = 0
      held_x(i) = held_z(i)
      if (shears /= 0 .and. i <= scene%n_entered) call of_its_shear(i, u, f, now)
    end subroutine of_element

    !> The tangential side of an element.
    subroutine of_its_shear(i, u_z, f, now)
      integer(ip), intent(in) :: i
      real(dp), intent(in) :: u_z, f
      real(dp), intent(inout) :: now(3)
      real(dp) :: u, speed, sense, v, stress, remainder
      integer(ip) :: j, k
      sense = real(motion(i), dp)
      remainder = 0
      speed = y(shear_velocity_at(scene))
      if (motion(i) /= 0) then
        speed = sense*y(state_velocity)
        do j = 1, scene%n_modes
          remainder = remainder + u_of(j)*amplitude(i, j)
          speed = speed - rate_of(j)*u_of(j)*amplitude(i, j)
        end do
        now(3) = max(f, 0.0_dp)*abs(y(shear_velocity_at(scene)) - speed)
        u = sense*u_z + remainder
      else
        u = y(shift_at(scene)) - shift(i)
      end if
      now(2) = scene%eta*speed**2
      held_x(i) = 0.5_dp*scene%g_inf*u**2
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
        now(2) = now(2) + stress**2/(g(k)*tau(k))
        held_x(i) = held_x(i) + 0.5_dp*stress**2/g(k)
      end do
    end subroutine of_its_shear
  end subroutine energy_rates
end module rst_cvode_ledger
