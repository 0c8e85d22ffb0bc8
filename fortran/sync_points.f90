!> Chebyshev's points of degree POINTS_DEGREE on [-1, 1], and what polynomials through values there need.
!>
!> sync.F90 includes this file and sync_curve.f90 once for each degree.
module POINTS
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: p, place, integral, slope, series, up, down, moment, back, curl

  integer(ip), parameter :: p = POINTS_DEGREE
  real(dp), parameter :: pi = acos(-1.0_dp)
  integer :: i, k
  real(dp), parameter :: place(0:p) = [(-cos(i*pi/p), i=0, p)]
  !> Of the points (first index) and degrees 0 to p + 1.
  real(dp), parameter :: chebyshev(0:p, 0:p + 1) = &
                         reshape([((cos(pi*modulo(k*(p - i), 2*p)/p), i=0, p), k=0, p + 1)], int([p + 1, p + 2]))
  real(dp), parameter :: halved(0:p) = [0.5_dp, (1.0_dp, i=1, p - 1), 0.5_dp]
  real(dp), parameter :: of_series(p, 0:p) = &
                         reshape([[(place(i) + 1, i=1, p)], [((place(i)**2 - 1)/2, i=1, p)], &
                                  [(((chebyshev(i, k + 1) - chebyshev(0, k + 1))/(2*(k + 1)) &
                                     - (chebyshev(i, k - 1) - chebyshev(0, k - 1))/(2*(k - 1)), i=1, p), k=2, p)]], &
                                 int([p, p + 1]))
  real(dp), parameter :: falling(0:p, 0:p) = &
                         reshape([((merge(2*k*halved(i), 0.0_dp, i < k .and. modulo(i + k, 2) == 1), i=0, p), k=0, p)], &
                                 int([p + 1, p + 1]))

  !> Chebyshev's series of the polynomial through values at the points; its integrals from the first point; its slopes.
  real(dp), parameter :: series(0:p, 0:p) = &
                         reshape([((2.0_dp/p*halved(i)*halved(k)*chebyshev(i, k), k=0, p), i=0, p)], int([p + 1, p + 1]))
  real(dp), parameter :: integral(p, 0:p) = matmul(of_series, series)
  real(dp), parameter :: slope(0:p, 0:p) = matmul(chebyshev(:, 0:p), matmul(falling, series))

  !> y of the points of the compression, with s = s_m y^2, and z of those of the restitution, with s = s_m + T (1 - z^2).
  real(dp), parameter :: up(0:p) = 0.5_dp*(1 + place), down(0:p) = 0.5_dp*(1 - place)
  !> int f 2y dy from first touch and int f (-2z) dz from the turning point on by values of f; nothing comes from y = 0 or z = 0.
  real(dp), parameter :: moment(p, p) = reshape([((integral(i, k)*up(k), i=1, p), k=1, p)], int([p, p]))
  real(dp), parameter :: back(p, 0:p - 1) = reshape([((integral(i, k)*down(k), i=1, p), k=0, p - 1)], int([p, p]))
  !> T df/ds in the restitution by values of f; at z = 0 by the second derivative.
  real(dp), parameter :: bend(0:p, 0:p) = matmul(slope, slope), over(0:p) = [(1/(0.5_dp*(1 - place(i))), i=0, p - 1), 0.0_dp]
  real(dp), parameter :: curl(0:p, 0:p) = &
                         reshape([((merge(-2*bend(i, k), slope(i, k)*over(i), i == p), i=0, p), k=0, p)], int([p + 1, p + 1]))
end module POINTS
