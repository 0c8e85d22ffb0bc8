!> The thresholds and iteration limits of the Fortran side of the method `sync`. Those of the C side
!> are in src/sync/tuning.h, which says what "Twice" was measured with. Each number stands in one of
!> the two.
module rst_tuning
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: keeps_matrix, stagnates_below, stagnates_at, largest_decrease, diverges_above, most_steps
  public :: most_trials, most_secants, faded, search_rounding, search_part, guess_part
  public :: deepest, largest_unresolved_rebound
  public :: narrowest, shortest_piece, shortest, at_edge, most_idle, steady, weightless
  public :: walk_closeness, largest_phase

  ! ---- Newton's steps

  !> The matrix is kept while steps fall by that: a step then costs a third, and four steps more
  !> would cost more than a matrix. Twice: no effect
  real(dp), parameter :: keeps_matrix = 0.1_dp

  !> Steps below the first that do not fall by the second are rounding. Twice: no effect; of the
  !> second: no effect
  real(dp), parameter :: stagnates_below = 1.0e-6_dp, stagnates_at = 0.5_dp

  !> Part of a positive unknown (F, pace) that a step may take off: it stays positive. 0.95: no
  !> effect
  real(dp), parameter :: largest_decrease = 0.9_dp

  !> Steps that change velocities, which are about 1, by more than that diverge; so do more steps
  !> than the second. Panels and pieces are halved then. Twice: no effect; of the second: no effect
  real(dp), parameter :: diverges_above = 1.0e6_dp
  integer(ip), parameter :: most_steps = 25

  ! ---- searches

  !> Halvings of a bracket that leave no digit of a double (53), and some steps more. Twice: no
  !> effect
  integer(ip), parameter :: most_trials = 60

  !> Secants to the end of a piece, which take two or three. Twice: no effect
  integer(ip), parameter :: most_secants = 15

  !> exp(-faded) is below rounding (36 would do); beyond 708 it underflows, which is slow. Twice: no
  !> effect
  real(dp), parameter :: faded = 50

  !> A bracket of the front, over the angle of the edge, that rounding ends. Twice: no effect
  real(dp), parameter :: search_rounding = 4*epsilon(1.0_dp)

  !> Part of the noise by which the search may miss the front: a front at rest is then not taken for
  !> one that moves outward. Twice: no effect
  real(dp), parameter :: search_part = 0.1_dp

  !> Accuracy of the guess of the time of return, from which Newton's method starts. Twice: no
  !> effect
  real(dp), parameter :: guess_part = 1.0e-3_dp

  ! ---- panels of the normal motion

  !> Panels end at multiples of (pi/2)/2^deepest: 1e-12, below which D' has no digits. 45: no effect
  integer(ip), parameter :: deepest = 40

  !> Where rounding ends the panels, a slower rebound is taken as none; a faster one is refused.
  !> Twice: no effect
  real(dp), parameter :: largest_unresolved_rebound = 1.0e-2_dp

  ! ---- pieces of the tangential motion

  !> Part of a panel down to which pieces are halved, and below which slip that turns back is
  !> reported as re-stick: wider pieces may only miss too much. Twice: no effect; of the second: no
  !> effect
  real(dp), parameter :: narrowest = 1.0e-7_dp, shortest_piece = 0.02_dp

  !> A piece shorter than that, by rounding of x, is none. Twice: no effect
  real(dp), parameter :: shortest = 1.0e-13_dp

  !> Part of the roughness that may be left of the margin at the edge when slip reverses: no element
  !> slips there then. (Slip that begins too early or too late may look as if it stuck again, and
  !> stick may end in all elements at once.) Twice: no effect
  real(dp), parameter :: at_edge = 0.1_dp

  !> Events at one place, of which one undoes the other. Twice: no effect
  integer(ip), parameter :: most_idle = 2

  !> Slip velocity, and stick margin over a usual stress, that are rounding. Twice: no effect; of
  !> the second: no effect
  real(dp), parameter :: steady = 1.0e-10_dp, weightless = 1.0e-12_dp

  ! ---- walks

  !> Newton's steps for U' over psi end there: above rounding. Twice: no effect
  real(dp), parameter :: walk_closeness = 1.0e-13_dp

  !> Largest (omega dt/2)^2 that is corrected for: its series misses 1 % of the step there. Twice:
  !> no effect
  real(dp), parameter :: largest_phase = 0.5_dp
end module rst_tuning
