! SPDX-License-Identifier: BSD-3-Clause
!> Influence coefficients of the incompressible half-space (18): the displacement of one cell of a
!> square grid under a uniform traction on another, in closed form, for unit shear modulus and unit
!> spacing.
!>
!> The kernels are 1/(4 pi r) (normal), (1/r + x^2/r^3)/(4 pi) (along x under a traction along x),
!> (x y/r^3)/(4 pi) (along y under a traction along x). With S1 = x asinh(y/|x|) and S2 = y
!> asinh(x/|y|) their integrals over a cell are signed sums over its corners of S1 + S2, S1 + 2 S2
!> and -r.
module rst_bem_influence
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: influence, normal_traction, shear_along

  integer(ip), parameter :: normal_traction = 0, shear_along = 1
  real(dp), parameter :: pi = 3.14159265358979323846_dp

contains

  !> table(i, j): cells i apart along x and j along y, 0 to n.
  pure subroutine influence(kind, n, table) bind(c, name="rst_bem_influence_table")
    integer(ip), intent(in), value :: kind, n
    real(dp), intent(out) :: table(0:n, 0:n)
    real(dp) :: edge, next_edge, below, above
    integer(ip) :: i, j
    do j = 0, n
      edge = corner(kind, -0.5_dp, j + 0.5_dp) - corner(kind, -0.5_dp, j - 0.5_dp)
      do i = 0, n
        above = corner(kind, i + 0.5_dp, j + 0.5_dp)
        below = corner(kind, i + 0.5_dp, j - 0.5_dp)
        next_edge = above - below
        table(i, j) = (next_edge - edge)/(4*pi)
        edge = next_edge
      end do
    end do
  end subroutine influence

  !> Twofold integral of 4 pi times the kernel. Corners lie between cells: x and y are never 0.
  elemental function corner(kind, x, y) result(s)
    integer(ip), intent(in) :: kind
    real(dp), intent(in) :: x, y
    real(dp) :: s
    if (kind == shear_along) then
      s = x*asinh(y/abs(x)) + 2*y*asinh(x/abs(y))
    else
      s = x*asinh(y/abs(x)) + y*asinh(x/abs(y))
    end if
  end function corner

end module rst_bem_influence
