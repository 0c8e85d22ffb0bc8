! SPDX-License-Identifier: BSD-3-Clause
!> Newton's linear system (1 - gamma J) x = b of the method `cvode`, solved by its structure.
!>
!> J is diagonal in the memory states. These are coupled to the rest by two dense rows, those of D''
!> and U'', and two columns. They are eliminated. A 2 x 2 system remains, first for (D, D'), which
!> do not depend on the tangential side, then for (U, U'). The cost is linear in the number of
!> relaxation times.
module rst_cvode_newton
  use rst_cvode_types, only: scene_type, contact_type, shear_sums_type, state_depth, state_velocity, memory_at, loading_at, &
                             shift_at, shear_velocity_at, shear_memory_at
  use rst_motion_factors, only: mass_factor, shear_factor
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: solve_newton

contains

  !> y: where J is taken; contact and sums are those of y.
  subroutine solve_newton(scene, g, tau, contact, sums, gamma, y, b, x) bind(c, name="rst_cvode_solve_newton")
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(contact_type), intent(in) :: contact
    type(shear_sums_type), intent(in) :: sums
    real(dp), intent(in), value :: gamma
    real(dp), intent(in) :: y(scene%n_states), b(scene%n_states)
    real(dp), intent(inout) :: x(scene%n_states)
    real(dp) :: change
    call solve_normal(scene, g, tau, contact, gamma, y, b, x, change)
    if (scene%n_states >= shear_velocity_at(scene)) call solve_shear(scene, g, tau, sums, gamma, change, b, x)
  end subroutine solve_newton

  !> The normal states; `change`: that of int_0^A f dX.
  subroutine solve_normal(scene, g, tau, contact, gamma, y, b, x, change)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), gamma
    type(contact_type), intent(in) :: contact
    real(dp), intent(in) :: y(scene%n_states), b(scene%n_states)
    real(dp), intent(inout) :: x(scene%n_states)
    real(dp), intent(out) :: change
    real(dp) :: widening, by_depth, by_velocity, known, damp, velocity
    integer(ip) :: k
    velocity = y(state_velocity)
    widening = 0  ! dA/dD times D'
    if (scene%restitution == 0 .and. contact%radius > 0) widening = 0.5_dp*velocity/contact%radius
    by_depth = scene%g_inf*contact%radius + scene%eta*widening
    by_velocity = scene%eta*contact%radius
    known = 0
    do k = 1, scene%n_terms
      damp = 1 + gamma/tau(k)
      if (scene%restitution == 0) then
        known = known + b(loading_at(scene, k))/damp
        by_depth = by_depth + gamma*g(k)*widening/damp
      else
        known = known + contact%radius*b(memory_at(k))/damp
      end if
      by_velocity = by_velocity + gamma*g(k)*contact%radius/damp
    end do
    x(state_velocity) = (b(state_velocity) - gamma*mass_factor*(known + by_depth*b(state_depth))) &
                        /(1 + gamma*mass_factor*(by_velocity + gamma*by_depth))
    x(state_depth) = b(state_depth) + gamma*x(state_velocity)
    change = known + by_depth*x(state_depth) + by_velocity*x(state_velocity)
    do k = 1, scene%n_terms
      damp = 1 + gamma/tau(k)
      x(memory_at(k)) = (b(memory_at(k)) + gamma*g(k)*x(state_velocity))/damp
      if (scene%restitution == 0) then
        x(loading_at(scene, k)) = (b(loading_at(scene, k)) &
                                   + gamma*g(k)*(contact%radius*x(state_velocity) + widening*x(state_depth)))/damp
      else
        x(loading_at(scene, k)) = b(loading_at(scene, k))
      end if
    end do
  end subroutine solve_normal

  !> The tangential states, the normal ones being known.
  subroutine solve_shear(scene, g, tau, sums, gamma, change, b, x)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: g(scene%n_terms), tau(scene%n_terms), gamma, change
    type(shear_sums_type), intent(in) :: sums
    real(dp), intent(in) :: b(scene%n_states)
    real(dp), intent(inout) :: x(scene%n_states)
    real(dp) :: stress, forced, known, by_shift, by_velocity, damp
    integer(ip) :: k, u, v
    u = shift_at(scene)
    v = shear_velocity_at(scene)
    stress = scene%g_inf*x(state_depth) + scene%eta*x(state_velocity)
    known = 0
    by_velocity = scene%eta
    do k = 1, scene%n_terms
      damp = 1 + gamma/tau(k)
      stress = stress + x(memory_at(k))
      known = known + b(shear_memory_at(scene, k))/damp
      by_velocity = by_velocity + gamma*g(k)/damp
    end do
    by_shift = sums%stick*scene%g_inf
    by_velocity = sums%stick*by_velocity
    forced = change - (sums%stick + 2*sums%backward)*stress + sums%stick*known
    x(v) = (b(v) - gamma*shear_factor*scene%chi*(forced + by_shift*b(u))) &
           /(1 + gamma*shear_factor*scene%chi*(by_velocity + gamma*by_shift))
    x(u) = b(u) + gamma*x(v)
    do k = 1, scene%n_terms
      x(shear_memory_at(scene, k)) = (b(shear_memory_at(scene, k)) + gamma*g(k)*x(v))/(1 + gamma/tau(k))
    end do
  end subroutine solve_shear
end module rst_cvode_newton
