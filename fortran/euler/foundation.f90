!> The one-dimensional foundation of MDR: element forces, return mapping, and sums over the
!> elements.
!>
!> Element j stands at X_j = (j - 1/2) dx, x2(j) = X_j^2. Elements 1..n_old were in contact before
!> the step and have moved by the full `advance` of the sphere; elements n_old+1..n_new were reached
!> within the step and have moved by what is left of it: by D - X^2 in z, and by the same fraction
!> of the step in x. Stresses y(j,k) belong to term k; g_inf, gain and viscosity per step (eta/h)
!> are those of rst_relaxation.
module rst_foundation
  use rst_precision, only: dp, ip
  use rst_profile, only: plane_profile
  implicit none (type, external)
  private
  public :: place_elements, normal_forces, sticking_forces, friction_forces, total_force

contains

  !> Profile height at the elements, which stand at the middle of cells of width dx: X_j^2 in the
  !> units of theory.md, 2.
  pure subroutine place_elements(n, dx, x2)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: dx
    real(dp), intent(out) :: x2(n)
    integer(ip) :: j
    do j = 1, n
      x2(j) = plane_profile((real(j, dp) - 0.5_dp)*dx, 1.0_dp)
    end do
  end subroutine place_elements

  !> Normal force f_j of every element at indentation `depth` (9), (12). In contact u_z = D - X^2 is
  !> prescribed.
  pure subroutine normal_forces(capacity, n_old, n_new, x2, depth, advance, g_inf, viscosity, n_terms, decay, gain, y, f)
    integer(ip), intent(in) :: capacity, n_old, n_new, n_terms
    real(dp), intent(in) :: x2(capacity), depth, advance, g_inf, viscosity
    real(dp), intent(in) :: decay(n_terms), gain(n_terms)
    real(dp), intent(inout) :: y(capacity, n_terms)
    real(dp), intent(inout) :: f(capacity)
    integer(ip) :: j, k
    real(dp) :: common

    common = g_inf*depth + viscosity*advance
    if (n_terms == 1) then  ! one pass over memory for the commonest solid
      !$omp simd
      do j = 1, n_old
        y(j, 1) = decay(1)*y(j, 1) + gain(1)*advance
        f(j) = common - g_inf*x2(j) + y(j, 1)
      end do
    else
      !$omp simd
      do j = 1, n_old
        f(j) = common - g_inf*x2(j)
      end do
      do k = 1, n_terms
        !$omp simd
        do j = 1, n_old
          y(j, k) = decay(k)*y(j, k) + gain(k)*advance
          f(j) = f(j) + y(j, k)
        end do
      end do
    end if
    do j = n_old + 1, n_new
      f(j) = (g_inf + viscosity)*(depth - x2(j))
      do k = 1, n_terms
        y(j, k) = gain(k)*(depth - x2(j))
        f(j) = f(j) + y(j, k)
      end do
    end do
  end subroutine normal_forces

  !> Tangential force of elements that all stick (no friction limit), and their displacement u.
  pure subroutine sticking_forces(capacity, n_old, n_new, x2, depth, advance_z, advance_x, g_inf, viscosity, &
                                  n_terms, decay, gain, u, y, q)
    integer(ip), intent(in) :: capacity, n_old, n_new, n_terms
    real(dp), intent(in) :: x2(capacity), depth, advance_z, advance_x, g_inf, viscosity
    real(dp), intent(in) :: decay(n_terms), gain(n_terms)
    real(dp), intent(inout) :: u(capacity), y(capacity, n_terms), q(capacity)
    integer(ip) :: j, k
    real(dp) :: move

    !$omp simd
    do j = 1, n_old
      u(j) = u(j) + advance_x
      q(j) = g_inf*u(j) + viscosity*advance_x
    end do
    do k = 1, n_terms
      !$omp simd
      do j = 1, n_old
        y(j, k) = decay(k)*y(j, k) + gain(k)*advance_x
        q(j) = q(j) + y(j, k)
      end do
    end do
    do j = n_old + 1, n_new
      move = advance_x*((depth - x2(j))/advance_z)
      u(j) = move
      q(j) = (g_inf + viscosity)*move
      do k = 1, n_terms
        y(j, k) = gain(k)*move
        q(j) = q(j) + y(j, k)
      end do
    end do
  end subroutine sticking_forces

  !> Return mapping onto |q| <= f, (14)-(17): the trial force has the sign of the slip. `slip` is
  !> the distance by which the element lags behind the sphere in this step. The springs and the
  !> dashpot are reduced by it.
  pure subroutine friction_forces(capacity, n, f, g_inf, viscosity, n_terms, gain, u, y, q, slip)
    integer(ip), intent(in) :: capacity, n, n_terms
    real(dp), intent(in) :: f(capacity), g_inf, viscosity
    real(dp), intent(in) :: gain(n_terms)
    real(dp), intent(inout) :: u(capacity), y(capacity, n_terms), q(capacity)
    real(dp), intent(out) :: slip(capacity)
    integer(ip) :: j, k
    real(dp) :: held, compliance

    compliance = g_inf + viscosity
    do k = 1, n_terms
      compliance = compliance + gain(k)
    end do
    compliance = 1/compliance
    !$omp simd private(held)
    do j = 1, n
      held = max(-f(j), min(f(j), q(j)))
      slip(j) = (q(j) - held)*compliance
      q(j) = held
      u(j) = u(j) - slip(j)
    end do
    do k = 1, n_terms
      !$omp simd
      do j = 1, n
        y(j, k) = y(j, k) - gain(k)*slip(j)
      end do
    end do
  end subroutine friction_forces

  !> Sum of the element forces: int f dX / dx.
  pure function total_force(capacity, n, f) result(total)
    integer(ip), intent(in) :: capacity, n
    real(dp), intent(in) :: f(capacity)
    real(dp) :: total
    integer(ip) :: j
    total = 0
    !$omp simd reduction(+:total)
    do j = 1, n
      total = total + f(j)
    end do
  end function total_force
end module rst_foundation
