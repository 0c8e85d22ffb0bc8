! SPDX-License-Identifier: BSD-3-Clause
!> The work around the Fourier transforms of a convolution of fields that are even in x and y. Only
!> a quarter of such a field is kept, m x m cells with centres at (i + 1/2, j + 1/2); its transform
!> is a cosine transform (DCT-II) of length n: n = 2m with zero padding for a convolution without
!> images, n = m where images do not matter.
!>
!> A DCT-II of length n is a complex transform of length n of the reordered sequence (even places
!> forward, odd places backward; Makhoul 1980): X_k = w_k V_k + conj(w_k) V_(n-k), w_k = exp(-i pi
!> k/(2n)). The map is linear with real results, so one complex transform carries two rows. With A =
!> w_k V_k and B = conj(w_k) V_(n-k): X_k = A + B, X_(n-k) = i (A - B), and back V_k = conj(w_k)
!> (X_k - i X_(n-k))/2, V_(n-k) = w_k (X_k + i X_(n-k))/2.
!>
!> A convolution: lay_rows, transform along x, turn, transform along y, filter, back along y,
!> turn_back, back along x, take_rows.
module rst_bem_cosine
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: set_twiddles, lay_rows, turn, filter, turn_back, take_rows

  real(dp), parameter :: pi = 3.14159265358979323846_dp

contains

  pure subroutine set_twiddles(n, w) bind(c, name="rst_bem_set_twiddles")
    integer(ip), intent(in), value :: n
    complex(dp), intent(out) :: w(0:n - 1)
    integer(ip) :: k
    do k = 0, n - 1
      w(k) = cmplx(cos(pi*k/(2*n)), -sin(pi*k/(2*n)), dp)
    end do
  end subroutine set_twiddles

  !> Two rows a line, reordered. ld: length of the lines of the field, of which m are taken.
  pure subroutine lay_rows(ld, m, n, x, ldv, v) bind(c, name="rst_bem_lay_rows")
    integer(ip), intent(in), value :: ld, m, n, ldv
    real(dp), intent(in) :: x(0:ld - 1, 0:m - 1)
    complex(dp), intent(inout) :: v(0:ldv - 1, 0:m/2 - 1)
    integer(ip) :: i, j
    do j = 0, m/2 - 1
      do i = 0, m/2 - 1
        v(i, j) = cmplx(x(2*i, 2*j), x(2*i, 2*j + 1), dp)
      end do
      do i = m/2, n - 1 - m/2
        v(i, j) = 0
      end do
      do i = n - m/2, n - 1
        v(i, j) = cmplx(x(2*(n - 1 - i) + 1, 2*j), x(2*(n - 1 - i) + 1, 2*j + 1), dp)
      end do
    end do
  end subroutine lay_rows

  !> From transformed rows to columns, two wave numbers a line, reordered.
  pure subroutine turn(m, n, w, ldv, v, t, line) bind(c, name="rst_bem_turn")
    integer(ip), intent(in), value :: m, n, ldv
    complex(dp), intent(in) :: w(0:n - 1), v(0:ldv - 1, 0:m/2 - 1)
    complex(dp), intent(inout) :: t(0:ldv - 1, 0:n/2 - 1)
    complex(dp), intent(inout) :: line(0:n - 1)
    complex(dp) :: a, b
    integer(ip) :: j, k
    do j = 0, m/2 - 1
      line(0) = 2*v(0, j)
      do k = 1, n/2
        a = w(k)*v(k, j)
        b = conjg(w(k))*v(n - k, j)
        line(k) = a + b
        line(n - k) = cmplx(aimag(b) - aimag(a), real(a) - real(b), dp)
      end do
      do k = 0, n/2 - 1
        t(j, k) = cmplx(real(line(2*k)), real(line(2*k + 1)), dp)
        t(n - 1 - j, k) = cmplx(aimag(line(2*k)), aimag(line(2*k + 1)), dp)
      end do
    end do
    do k = 0, n/2 - 1
      do j = m/2, n - 1 - m/2
        t(j, k) = 0
      end do
    end do
  end subroutine turn

  !> Multiply the spectrum. factor(c, l, k): of the wave number l along y and 2k + c - 1 along x.
  pure subroutine filter(n, w, factor, ldv, t) bind(c, name="rst_bem_filter")
    integer(ip), intent(in), value :: n, ldv
    complex(dp), intent(in) :: w(0:n - 1)
    real(dp), intent(in) :: factor(2, 0:n - 1, 0:n/2 - 1)
    complex(dp), intent(inout) :: t(0:ldv - 1, 0:n/2 - 1)
    real(dp) :: c, s, p, q, ar, ai, br, bi, xr, xi, yr, yi
    integer(ip) :: k, l
    do k = 0, n/2 - 1
      t(0, k) = cmplx(factor(1, 0, k)*real(t(0, k)), factor(2, 0, k)*aimag(t(0, k)), dp)
      do l = 1, n/2
        c = real(w(l))
        s = aimag(w(l))
        p = real(t(l, k))
        q = aimag(t(l, k))
        ar = c*p - s*q ! A = w t(l)
        ai = c*q + s*p
        p = real(t(n - l, k))
        q = aimag(t(n - l, k))
        br = c*p + s*q ! B = conjg(w) t(n - l)
        bi = c*q - s*p
        xr = 0.5_dp*factor(1, l, k)*(ar + br)
        xi = 0.5_dp*factor(2, l, k)*(ai + bi)
        yr = 0.5_dp*factor(2, n - l, k)*(ar - br) ! -i X_(n-l)
        yi = 0.5_dp*factor(1, n - l, k)*(ai - bi)
        p = xr + yr
        q = xi + yi
        t(l, k) = cmplx(c*p + s*q, c*q - s*p, dp)
        p = xr - yr
        q = xi - yi
        t(n - l, k) = cmplx(c*p - s*q, c*q + s*p, dp)
      end do
    end do
  end subroutine filter

  !> From columns back to rows.
  pure subroutine turn_back(m, n, w, ldv, t, v, line) bind(c, name="rst_bem_turn_back")
    integer(ip), intent(in), value :: m, n, ldv
    complex(dp), intent(in) :: w(0:n - 1), t(0:ldv - 1, 0:n/2 - 1)
    complex(dp), intent(inout) :: v(0:ldv - 1, 0:m/2 - 1)
    complex(dp), intent(inout) :: line(0:n - 1)
    complex(dp) :: y, plus, minus
    integer(ip) :: j, k
    do j = 0, m/2 - 1
      do k = 0, n/2 - 1
        line(2*k) = cmplx(real(t(j, k)), real(t(n - 1 - j, k)), dp)
        line(2*k + 1) = cmplx(aimag(t(j, k)), aimag(t(n - 1 - j, k)), dp)
      end do
      v(0, j) = 0.5_dp*line(0)
      do k = 1, n/2
        y = cmplx(aimag(line(n - k)), -real(line(n - k)), dp)
        plus = line(k) + y
        minus = line(k) - y
        v(k, j) = conjg(w(k))*plus*0.5_dp
        v(n - k, j) = w(k)*minus*0.5_dp
      end do
    end do
  end subroutine turn_back

  pure subroutine take_rows(ld, m, n, ldv, v, x) bind(c, name="rst_bem_take_rows")
    integer(ip), intent(in), value :: ld, m, n, ldv
    complex(dp), intent(in) :: v(0:ldv - 1, 0:m/2 - 1)
    real(dp), intent(inout) :: x(0:ld - 1, 0:m - 1)
    integer(ip) :: i, j
    do j = 0, m/2 - 1
      do i = 0, m/2 - 1
        x(2*i, 2*j) = real(v(i, j))
        x(2*i, 2*j + 1) = aimag(v(i, j))
        x(2*i + 1, 2*j) = real(v(n - 1 - i, j))
        x(2*i + 1, 2*j + 1) = aimag(v(n - 1 - i, j))
      end do
    end do
  end subroutine take_rows

end module rst_bem_cosine
