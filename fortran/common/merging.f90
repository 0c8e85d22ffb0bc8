!> Merging of relaxation times that do not matter in a contact of a given duration (docs/theory.md,
!> section 7).
!>
!> A term that hardly relaxes within the contact is added to G_inf; one that relaxes at once is
!> added to eta as g tau. The bounds are on the energy of the change, in units of the impact
!> energy, with D' <= 1:
!>   slow: the modulus changes by at most g t/tau; over loading and unloading that is worth 2 D_max^(5/2) of it
!>   fast: the stress changes by g tau^2 u'' and, after entry, g tau u' exp(-t/tau); together at most
!>         (3/2) g tau^2 an element, (15/4) of it integrated over the contact radius A_max
!> They act in z, and in x with 2 chi times the weight and through the friction limit: the bound on
!> e_z and e_x is 2 max(1, chi) times the sum. Above chi = 4, which no solid or hollow sphere has,
!> the tangential oscillation is so fast that u'' outgrows its normal counterpart: there the fast
!> part counts chi/4 times.
module rst_merging
  use rst_motion_factors, only: shear_factor
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: merge_terms

contains

  !> Merge in place, cheapest first, what costs at most `allowed` all together. Terms come in
  !> ascending order of tau; those kept move to the front, n_terms is their number. slow_rate: bound
  !> from slow terms per unit of contact time, so that it can be stated for the contact time found.
  pure subroutine merge_terms(share, window, depth, allowed, g_inf, eta, n_terms, g, tau, slow_rate, fast_bound) &
    bind(c, name="rst_merge_terms")
    real(dp), intent(in), value :: share  !! the larger of what a force changes in z and x: 1, or chi with friction, if larger
    real(dp), intent(in), value :: window, depth, allowed
    real(dp), intent(inout) :: g_inf, eta
    integer(ip), intent(inout) :: n_terms
    real(dp), intent(inout) :: g(n_terms), tau(n_terms)
    real(dp), intent(out) :: slow_rate, fast_bound
    integer(ip) :: first, last, k
    real(dp) :: weight, slow, fast

    weight = 2*share
    slow_rate = 0
    fast_bound = 0
    first = 1
    last = n_terms
    do while (first <= last)
      slow = weight*2*depth*depth*sqrt(depth)*g(last)/tau(last)
      fast = weight*max(1.0_dp, share/4)*(1.5_dp*shear_factor)*sqrt(depth)*g(first)*tau(first)*tau(first)
      if (slow_rate*window + fast_bound + min(slow*window, fast) > allowed) exit
      if (slow*window <= fast) then
        g_inf = g_inf + g(last)
        slow_rate = slow_rate + slow
        last = last - 1
      else
        eta = eta + g(first)*tau(first)
        fast_bound = fast_bound + fast
        first = first + 1
      end if
    end do
    do k = first, last
      g(k - first + 1) = g(k)
      tau(k - first + 1) = tau(k)
    end do
    n_terms = last - first + 1
  end subroutine merge_terms
end module rst_merging
