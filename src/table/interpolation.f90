!> SPDX-License-Identifier: BSD-3-Clause
!> Interpolation that a table is built with: polynomials through Chebyshev points (both ends included) in one variable, and
!> their use along one index of an array of several.
!>
!>     nodes       x_j = (1 - cos(pi j/(n - 1)))/2, j = 0..n-1, on [0, 1]
!>     weights     p(x) = sum_j row_j f_j, barycentric: row_j = (w_j/(x - x_j))/sum_i w_i/(x - x_i), w_j = (-1)^j, half at the ends
!>     spectrum    c_k = (2/(n - 1)) sum_j'' f_j T_k(2 x_j - 1): the size of the last ones tells what n leaves out
module rst_table_interpolation
  use, intrinsic :: iso_c_binding, only: dp => c_double, ip => c_int64_t
  implicit none (type, external)
  private
  real(dp), parameter :: pi = 3.14159265358979323846_dp

contains

  pure subroutine nodes(n, x) bind(c, name="rst_table_nodes")
    integer(ip), intent(in), value :: n
    real(dp), intent(out) :: x(n)
    integer(ip) :: j
    do j = 1, n
      x(j) = node(n, j)
    end do
  end subroutine nodes

  !> x_(j - 1). sin^2 keeps the distance to the lower end exact; the upper end is its mirror image.
  pure function node(n, j) result(x)
    integer(ip), intent(in) :: n, j
    real(dp) :: x
    x = 0
    if (j > 1) x = sin(pi*real(min(j - 1, n - j), dp)/real(2*(n - 1), dp))**2
    if (2*j > n + 1) x = 1 - x
  end function node

  !> The row that takes n values at the nodes to the value at `point`.
  pure subroutine weights(n, point, row) bind(c, name="rst_table_weights")
    integer(ip), intent(in), value :: n
    real(dp), intent(in), value :: point
    real(dp), intent(out) :: row(n)
    integer(ip) :: j
    real(dp) :: distance
    do j = 1, n
      distance = point - node(n, j)
      if (.not. abs(distance) > 0) then
        row = 0
        row(j) = 1
        return
      end if
      row(j) = sign_of(j)/distance
      if (j == 1 .or. j == n) row(j) = row(j)/2
    end do
    row = row/sum(row)
  end subroutine weights

  pure function sign_of(j) result(s)
    integer(ip), intent(in) :: j
    real(dp) :: s
    s = real(1 - 2*mod(j, 2_ip), dp)
  end function sign_of

  !> Rows that take n values at the nodes to their n coefficients c_k.
  pure subroutine spectrum(n, row) bind(c, name="rst_table_spectrum")
    integer(ip), intent(in), value :: n
    real(dp), intent(out) :: row(n, n)
    integer(ip) :: j, k
    if (n == 1) then
      row(1, 1) = 1
      return
    end if
    do k = 0, n - 1
      do j = 0, n - 1  ! T_k(2 x_j - 1) = cos(k (pi - pi j/(n - 1)))
        row(j + 1, k + 1) = 2/real(n - 1, dp)*cos(pi*real(mod(k*(n - 1 - j), 2*(n - 1)), dp)/real(n - 1, dp))
        if (j == 0 .or. j == n - 1) row(j + 1, k + 1) = row(j + 1, k + 1)/2
        if (k == 0 .or. k == n - 1) row(j + 1, k + 1) = row(j + 1, k + 1)/2
      end do
    end do
  end subroutine spectrum

  !> The last two of these rows; zero for a single node.
  pure subroutine last(n, row) bind(c, name="rst_table_last")
    integer(ip), intent(in), value :: n
    real(dp), intent(out) :: row(n, 2)
    integer(ip) :: j, k
    row = 0
    if (n < 3) return
    do k = n - 2, n - 1
      do j = 0, n - 1
        row(j + 1, k - n + 3) = 2/real(n - 1, dp)*cos(pi*real(mod(k*(n - 1 - j), 2*(n - 1)), dp)/real(n - 1, dp))
        if (j == 0 .or. j == n - 1) row(j + 1, k - n + 3) = row(j + 1, k - n + 3)/2
        if (k == n - 1) row(j + 1, k - n + 3) = row(j + 1, k - n + 3)/2
      end do
    end do
  end subroutine last

  !> b(:, i, :) = sum_j row(j, i) a(:, j, :)
  pure subroutine along(after, n, m, before, row, a, b) bind(c, name="rst_table_along")
    integer(ip), intent(in), value :: after, n, m, before
    real(dp), intent(in) :: row(n, m), a(after, n, before)
    real(dp), intent(out) :: b(after, m, before)
    integer(ip) :: h, i, j
    do h = 1, before
      do i = 1, m
        b(:, i, h) = 0
        do j = 1, n
          b(:, i, h) = b(:, i, h) + row(j, i)*a(:, j, h)
        end do
      end do
    end do
  end subroutine along
end module rst_table_interpolation
