!> Merging of relaxation times that a contact of a given length cannot feel (THEORY 4.7, Prony limits).
!>
!> A term that hardly relaxes within the contact joins G_inf; one that has long relaxed joins eta at constant g tau.
!> Costs are bounds on the energy of the change in units of the impact energy, with D' <= 1:
!>   slow: the modulus changes by at most g t/tau; over loading and unloading that is worth 2 D_max^(5/2) of it
!>   fast: the stress changes by g tau^2 u'' and, after entry, g tau u' exp(-t/tau); together at most
!>         (3/2) g tau^2 an element, (15/4) of it integrated over the contact radius A_max
!> Both act twice, in z and, through the friction limit, in x: the bound on e_z and e_x is twice the sum.
module rst_merging
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: merge_terms

contains

  !> Merge in place what costs at most `allowed` all together; the terms kept move to the front, n_terms is their number.
  !> slow_rate: bound from slow terms per unit of contact time, so that it can be stated for the contact time found.
  pure subroutine merge_terms(window, depth, allowed, g_inf, eta, n_terms, g, tau, slow_rate, fast_bound)
    real(dp), intent(in) :: window, depth, allowed
    real(dp), intent(inout) :: g_inf, eta
    integer(ip), intent(inout) :: n_terms
    real(dp), intent(inout) :: g(n_terms), tau(n_terms)
    real(dp), intent(out) :: slow_rate, fast_bound
    integer(ip) :: k, kept
    real(dp) :: share, slow, fast

    slow_rate = 0
    fast_bound = 0
    kept = 0
    if (n_terms == 0) return
    share = allowed/real(n_terms, dp)
    do k = 1, n_terms
      slow = 4*depth*depth*sqrt(depth)*g(k)/tau(k)
      fast = 11.25_dp*sqrt(depth)*g(k)*tau(k)*tau(k)
      if (slow*window <= share) then
        g_inf = g_inf + g(k)
        slow_rate = slow_rate + slow
      else if (fast <= share) then
        eta = eta + g(k)*tau(k)
        fast_bound = fast_bound + fast
      else
        kept = kept + 1
        g(kept) = g(k)
        tau(kept) = tau(k)
      end if
    end do
    n_terms = kept
  end subroutine merge_terms
end module rst_merging
