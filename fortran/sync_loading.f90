!> What a panel of the compression does to fading memory: P_k' = A D' - P_k/tau_k, and M_k, with the motion of a sweep.
module rst_sync_loading
  use rst_precision, only: dp, ip
  use rst_memory, only: memory_pair_type, remember_pair, parabola_type, spacing_type, spacing_of, parabola_through, remembered, &
                        memory_shares
  implicit none (type, external)
  private
  public :: load_terms, follow_terms, remember_speeds, by_parts, longest_panel, first_levels

  integer(ip), parameter :: first_levels = 8        !! of the compression, where sqrt(s) is most curved
  real(dp), parameter :: longest_panel = 6.0_dp     !! roughly, in D_max/n

contains

  !> P_k at both points and the force without the dashpot's, `held`. It answers to the depth as if terms did not fade on the way
  !> (stiffness), or those that do to the velocity (echo), both times A.
  pure subroutine load_terms(n_terms, g_inf, resolved, g, tau, x, spacing, v, a, a3, loading, held, stiffness, echo)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, resolved  !! the panels of a run resolve longer relaxation times
    real(dp), intent(in) :: g(n_terms), tau(n_terms), x(2), v(0:2), a(0:2), a3(0:2)
    type(spacing_type), intent(in) :: spacing
    real(dp), intent(inout) :: loading(n_terms, 0:2)
    real(dp), dimension(2), intent(out) :: held, stiffness, echo
    type(parabola_type) :: cubes, sweeps
    type(memory_pair_type) :: m
    real(dp) :: load, before, share(2, 2)
    integer(ip) :: k, q
    held = (2.0_dp/3.0_dp)*g_inf*a3(1:2)
    stiffness = g_inf
    echo = 0
    if (n_terms == 0) return
    cubes = parabola_through(spacing, a3)
    sweeps = parabola_through(spacing, a*v)
    do k = 1, n_terms
      call remember_pair(x/tau(k), m)
      before = loading(k, 0)
      if (by_parts(x, tau(k), resolved)) then
        !$omp simd private(load)
        do q = 1, 2
          load = remembered(m%phi1(q), m%phi2(q), m%phi3(q), x(q), cubes)
          load = m%decay(q)*before + g(k)*loaded_by_parts(m%decay(q), load, tau(k), a3(0), a3(q))
          loading(k, q) = load
          held(q) = held(q) + load
          stiffness(q) = stiffness(q) + g(k)*m%phi1(q)
        end do
      else
        share = memory_shares(m, x, spacing)
        !$omp simd private(load)
        do q = 1, 2
          load = m%decay(q)*before + g(k)*remembered(m%phi1(q), m%phi2(q), m%phi3(q), x(q), sweeps)
          loading(k, q) = load
          held(q) = held(q) + load
          echo(q) = echo(q) + g(k)*max(share(q, q), 0.0_dp)
        end do
      end if
    end do
  end subroutine load_terms

  !> M_k at both points; P_k follows the last step of times and accelerations. fade: exp(-t/tau) from the first point to the second,
  !> and from the start to it, for the restitution, which passes them in that order.
  pure subroutine follow_terms(n_terms, resolved, g, tau, x, v, a, moved, lift, gain, loading, memory, fade)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: resolved, g(n_terms), tau(n_terms), x(2), v(0:2), a(2), moved(2), lift(2), gain(2)
    real(dp), intent(inout) :: loading(n_terms, 0:2), memory(n_terms, 0:2)
    real(dp), intent(out) :: fade(n_terms, 2)
    type(memory_pair_type) :: m
    type(spacing_type) :: spacing
    type(parabola_type) :: speeds
    real(dp), parameter :: faint = 1.0e-290_dp
    real(dp) :: share(2, 2), remembered_now(0:2)
    integer(ip) :: k
    if (n_terms == 0) return
    spacing = spacing_of(x)
    speeds = parabola_through(spacing, v)
    do k = 1, n_terms
      call remember_pair(x/tau(k), m)
      remembered_now = memory(k, :)
      call remember_speeds(g(k), m, x, speeds, remembered_now)
      memory(k, :) = remembered_now
      loading(k, 1:2) = loading(k, 1:2) + moved*(g(k)*a*v(1:2) - loading(k, 1:2)/tau(k))
      if (by_parts(x, tau(k), resolved)) then
        loading(k, 1:2) = loading(k, 1:2) + g(k)*m%phi1*a*lift
      else
        share = memory_shares(m, x, spacing)
        loading(k, 1:2) = loading(k, 1:2) + g(k)*a*(share(:, 1)*gain(1) + share(:, 2)*gain(2))
      end if
      fade(k, 1) = 0
      if (m%decay(1) > faint) fade(k, 1) = m%decay(2)/m%decay(1)
      fade(k, 2) = m%decay(2)
    end do
  end subroutine follow_terms

  pure subroutine remember_speeds(g, m, x, speeds, memory)
    real(dp), intent(in) :: g, x(2)
    type(memory_pair_type), intent(in) :: m
    type(parabola_type), intent(in) :: speeds
    real(dp), intent(inout) :: memory(0:2)
    integer(ip) :: q
    do q = 1, 2
      memory(q) = m%decay(q)*memory(0) + g*remembered(m%phi1(q), m%phi2(q), m%phi3(q), x(q), speeds)
    end do
  end subroutine remember_speeds

  !> A D' ~ sqrt(s) is no parabola at first touch; int A D' exp is taken by parts, with (2/3) A^3 in its place, by the first
  !> panels, and by all of them where they resolve tau: a change between both within the run would show. With longer
  !> panels by parts would cancel.
  pure function by_parts(x, tau, resolved) result(yes)
    real(dp), intent(in) :: x(2), tau, resolved
    logical :: yes
    yes = x(2) < tau .and. tau > resolved
  end function by_parts

  !> `cubes`: what is remembered of A^3
  pure function loaded_by_parts(decay, cubes, tau, a3_start, a3) result(y)
    real(dp), intent(in) :: decay, cubes, tau, a3_start, a3
    real(dp) :: y
    y = (2.0_dp/3.0_dp)*(a3 - decay*a3_start - cubes/tau)
  end function loaded_by_parts
end module rst_sync_loading
