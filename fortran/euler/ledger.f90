!> Contributions of a step of the method `euler` to the energy ledger (fortran/common/ledger.f90).
module rst_euler_ledger
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: post_viscous, post_friction, post_unloading, post_left_behind

contains

  !> Dissipation of one step, sum over the elements of h sum_k f_k^2/(g_k tau_k) + eta du^2/h.
  pure subroutine post_viscous(weight, h, capacity, n, eta, move, n_terms, g, tau, y, account)
    real(dp), intent(in) :: weight, h, eta
    integer(ip), intent(in) :: capacity, n, n_terms
    real(dp), intent(in) :: move(capacity)  !! displacement of the element within the step
    real(dp), intent(in) :: g(n_terms), tau(n_terms), y(capacity, n_terms)
    real(dp), intent(inout) :: account
    integer(ip) :: j, k
    real(dp) :: dissipated
    dissipated = 0
    do j = 1, n
      dissipated = dissipated + eta/h*move(j)**2
    end do
    do k = 1, n_terms
      do j = 1, n
        dissipated = dissipated + h*y(j, k)**2/(g(k)*tau(k))
      end do
    end do
    account = account + weight*dissipated
  end subroutine post_viscous

  !> Friction work of one step: slip times the mean of the force before and after it. At the edge
  !> the force falls by its own size within a step. So the force after the step alone would give an
  !> error of first order for small psi. Where the force changed sign, the slip was at the end of
  !> the step, against the force after it.
  pure subroutine post_friction(weight, capacity, n, q_before, q, slip, account)
    real(dp), intent(in) :: weight
    integer(ip), intent(in) :: capacity, n
    real(dp), intent(in) :: q_before(capacity), q(capacity), slip(capacity)
    real(dp), intent(inout) :: account
    integer(ip) :: j
    real(dp) :: work
    work = 0
    do j = 1, n
      if (q_before(j)*q(j) > 0) then
        work = work + 0.5_dp*(q_before(j) + q(j))*slip(j)
      else
        work = work + q(j)*slip(j)
      end if
    end do
    account = account + weight*work
  end subroutine post_friction

  !> Elements first..last left in this step: friction work while their force falls to zero.
  pure subroutine post_unloading(weight, capacity, first, last, g_inf, viscosity, n_terms, gain, q_before, u, y, account)
    real(dp), intent(in) :: weight, g_inf, viscosity
    integer(ip), intent(in) :: capacity, first, last, n_terms
    real(dp), intent(in) :: gain(n_terms), q_before(capacity)
    real(dp), intent(inout) :: u(capacity), y(capacity, n_terms)
    real(dp), intent(inout) :: account
    integer(ip) :: j, k
    real(dp) :: slip, stiffness
    stiffness = g_inf + viscosity
    do k = 1, n_terms
      stiffness = stiffness + gain(k)
    end do
    do j = first, last
      slip = q_before(j)/stiffness
      account = account + weight*0.5_dp*q_before(j)*slip
      u(j) = u(j) - slip
      do k = 1, n_terms
        y(j, k) = y(j, k) - gain(k)*slip
      end do
    end do
  end subroutine post_unloading

  !> Elastic energy (1/2)(G_inf u^2 + sum_k f_k^2/g_k) of the elements first..last that have just
  !> left.
  pure subroutine post_left_behind(weight, capacity, first, last, g_inf, u, n_terms, g, y, account)
    real(dp), intent(in) :: weight, g_inf
    integer(ip), intent(in) :: capacity, first, last, n_terms
    real(dp), intent(in) :: u(capacity), g(n_terms), y(capacity, n_terms)
    real(dp), intent(inout) :: account
    integer(ip) :: j, k
    real(dp) :: energy
    energy = 0
    do j = first, last
      energy = energy + 0.5_dp*g_inf*u(j)**2
      do k = 1, n_terms
        energy = energy + 0.5_dp*y(j, k)**2/g(k)
      end do
    end do
    account = account + weight*energy
  end subroutine post_left_behind
end module rst_euler_ledger
