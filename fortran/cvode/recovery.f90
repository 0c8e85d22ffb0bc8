! SPDX-License-Identifier: BSD-3-Clause
!> How a slipping element relaxes to the state of one that always slipped.
!>
!> An element that slips with |q| = f and one that has slipped since its entry have the same stress.
!> Their difference is an element without stress. Its displacement u and elongations v_k (of the
!> dashpots) relax:
!>
!>   v_k' = (u - v_k)/tau_k,   G_inf u + sum_k g_k (u - v_k) + eta u' = 0.
!>
!> With e_k = sqrt(g_k tau_k) v_k and, if there is a parallel dashpot, e_0 = sqrt(eta) u this is e'
!> = -S e with S symmetric and semi-definite: its eigenvalues are the inverse retardation times of
!> the solid.
module rst_cvode_recovery
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: recovery_modes

contains

  !> Rates of the modes, their displacement u and the elongations v_k, a column a mode: v(k, j) for
  !> amplitude 1 of mode j. `from_u` and `from_v` turn u and v_k into amplitudes. n_modes: n_terms,
  !> one more if eta > 0. `matrix`: workspace.
  subroutine recovery_modes(n_terms, n_modes, g_inf, eta, g, tau, matrix, rate, u, v, from_u, from_v) &
    bind(c, name="rst_cvode_recovery_modes")
    integer(ip), intent(in), value :: n_terms, n_modes
    real(dp), intent(in), value :: g_inf, eta
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp), intent(out) :: matrix(n_modes, n_modes, 2)
    real(dp), intent(out) :: rate(n_modes), u(n_modes), v(n_terms, n_modes), from_u(n_modes), from_v(n_terms, n_modes)
    real(dp) :: total, scale
    integer(ip) :: j, k, shift
    total = g_inf
    do k = 1, n_terms
      total = total + g(k)
    end do
    shift = n_modes - n_terms
    call assemble(n_terms, n_modes, shift, total, eta, g, tau, matrix(:, :, 1))
    call diagonalise(n_modes, matrix(:, :, 1), matrix(:, :, 2))
    do j = 1, n_modes
      rate(j) = max(matrix(j, j, 1), 0.0_dp)
      u(j) = 0
      from_u(j) = 0
      do k = 1, n_terms
        scale = sqrt(g(k)*tau(k))
        v(k, j) = matrix(k + shift, j, 2)/scale
        from_v(k, j) = matrix(k + shift, j, 2)*scale
        if (shift == 0) u(j) = u(j) + g(k)*v(k, j)/total
      end do
      if (shift == 1) then
        u(j) = matrix(1, j, 2)/sqrt(eta)
        from_u(j) = matrix(1, j, 2)*sqrt(eta)
      end if
    end do
  end subroutine recovery_modes

  !> S. Without a parallel dashpot u follows from the v_k and is eliminated.
  pure subroutine assemble(n_terms, n_modes, shift, total, eta, g, tau, s)
    integer(ip), intent(in) :: n_terms, n_modes, shift
    real(dp), intent(in) :: total, eta, g(n_terms), tau(n_terms)
    real(dp), intent(out) :: s(n_modes, n_modes)
    integer(ip) :: i, k
    do i = 1, n_modes
      do k = 1, n_modes
        s(k, i) = 0
      end do
    end do
    do k = 1, n_terms
      s(k + shift, k + shift) = 1/tau(k)
    end do
    if (shift == 1) then
      s(1, 1) = total/eta
      do k = 1, n_terms
        s(k + 1, 1) = -sqrt(g(k)/(eta*tau(k)))
        s(1, k + 1) = s(k + 1, 1)
      end do
    else
      do i = 1, n_terms
        do k = 1, n_terms
          s(k, i) = s(k, i) - sqrt(g(k)/tau(k))*sqrt(g(i)/tau(i))/total
        end do
      end do
    end if
  end subroutine assemble

  !> Jacobi's rotations: for the few terms of a solid nothing is simpler or more accurate.
  pure subroutine diagonalise(n, s, q)
    integer(ip), intent(in) :: n
    real(dp), intent(inout) :: s(n, n)
    real(dp), intent(out) :: q(n, n)
    integer(ip), parameter :: most_sweeps = 60
    integer(ip) :: i, j, sweep, rotations
    do j = 1, n
      do i = 1, n
        q(i, j) = merge(1.0_dp, 0.0_dp, i == j)
      end do
    end do
    do sweep = 1, most_sweeps
      rotations = 0
      do i = 1, n - 1
        do j = i + 1, n
          if (abs(s(i, j)) <= 1.0e-17_dp*sqrt(abs(s(i, i)))*sqrt(abs(s(j, j)))) cycle
          call rotate(n, i, j, s, q)
          rotations = rotations + 1
        end do
      end do
      if (rotations == 0) return
    end do
  end subroutine diagonalise

  pure subroutine rotate(n, i, j, s, q)
    integer(ip), intent(in) :: n, i, j
    real(dp), intent(inout) :: s(n, n), q(n, n)
    real(dp) :: half, tangent, cosine, sine, a, b
    integer(ip) :: k
    half = 0.5_dp*(s(j, j) - s(i, i))/s(i, j)
    tangent = sign(1.0_dp, half)/(abs(half) + sqrt(1 + half*half))
    cosine = 1/sqrt(1 + tangent*tangent)
    sine = tangent*cosine
    do k = 1, n
      a = s(k, i)
      b = s(k, j)
      s(k, i) = cosine*a - sine*b
      s(k, j) = sine*a + cosine*b
    end do
    do k = 1, n
      a = s(i, k)
      b = s(j, k)
      s(i, k) = cosine*a - sine*b
      s(j, k) = sine*a + cosine*b
      a = q(k, i)
      b = q(k, j)
      q(k, i) = cosine*a - sine*b
      q(k, j) = sine*a + cosine*b
    end do
    s(i, j) = 0
    s(j, i) = 0
  end subroutine rotate
end module rst_cvode_recovery
