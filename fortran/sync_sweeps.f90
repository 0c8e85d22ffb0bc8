!> What sweeps over a panel of the normal problem share: when they end, and the two linear equations of a Newton step.
module rst_sync_sweeps
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: settle, is_lost, answer, most_sweeps, rounding, shortest

  integer(ip), parameter :: most_sweeps = 100
  real(dp), parameter :: shortest = 1.0e-100_dp    !! step: edges that are free at once are not told from each other
  real(dp), parameter :: rounding = 16*epsilon(1.0_dp)  !! of differences of velocities and depths of order 1

contains

  !> Sweeps end when the next one would change little, or when rounding lets them change less no more. What it would change is
  !> foretold from `rate`, the part of the change that was left by the last sweep, here or in the panels before.
  pure subroutine settle(sweep, change, closeness, previous, rate, yes)
    integer(ip), intent(in) :: sweep
    real(dp), intent(in) :: change, closeness
    real(dp), intent(inout) :: previous, rate
    logical, intent(out) :: yes
    real(dp), parameter :: stagnates_below = 1.0e-11_dp, enough_at_last = 1.0e-9_dp
    real(dp), parameter :: quicker = 0.3_dp  !! Newton's steps fall faster from step to step
    real(dp), parameter :: best_rate = 0.0003_dp  !! that is believed
    integer(ip), parameter :: many = 30
    if (sweep > 1) rate = max(quicker*change/previous, 0.1_dp*rate, best_rate)
    yes = change < closeness .or. (rate < 0.3_dp .and. change*max(rate, change) < closeness)
    if (.not. yes .and. sweep > 1) &
      yes = (change < stagnates_below .and. change >= previous) .or. (sweep >= many .and. change < enough_at_last)
    previous = change
  end subroutine settle

  !> Whether changes are as large as all there is for long, or so large that the next sweeps would overflow.
  pure function is_lost(sweep, change) result(yes)
    integer(ip), intent(in) :: sweep
    real(dp), intent(in) :: change
    logical :: yes
    integer(ip), parameter :: enough = 20
    real(dp), parameter :: beyond_return = 1.0e10_dp
    yes = (sweep >= enough .and. change > 1) .or. change > beyond_return
  end function is_lost

  !> Solution of two linear equations, the first with a and b, the second with c and d on the left; huge if there is none.
  pure function answer(a, b, c, d, right) result(x)
    real(dp), intent(in) :: a, b, c, d, right(2)
    real(dp) :: x(2), inverse
    x = huge(1.0_dp)
    inverse = a*d - b*c
    if (.not. abs(inverse) > 0) return
    inverse = 1/inverse
    x(1) = (d*right(1) - b*right(2))*inverse
    x(2) = (a*right(2) - c*right(1))*inverse
  end function answer
end module rst_sync_sweeps
