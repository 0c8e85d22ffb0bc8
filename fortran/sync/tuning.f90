!> The thresholds and iteration limits of the Fortran side of `sync`; those of the C side are in src/sync/tuning.h.
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

  real(dp), parameter :: keeps_matrix = 0.1_dp
  real(dp), parameter :: stagnates_below = 1.0e-6_dp, stagnates_at = 0.5_dp
  real(dp), parameter :: largest_decrease = 0.9_dp
  real(dp), parameter :: diverges_above = 1.0e6_dp
  integer(ip), parameter :: most_steps = 25

  ! ---- searches

  integer(ip), parameter :: most_trials = 60
  integer(ip), parameter :: most_secants = 15
  real(dp), parameter :: faded = 50
  real(dp), parameter :: search_rounding = 4*epsilon(1.0_dp)
  real(dp), parameter :: search_part = 0.1_dp
  real(dp), parameter :: guess_part = 1.0e-3_dp

  ! ---- panels of the normal motion

  integer(ip), parameter :: deepest = 40
  real(dp), parameter :: largest_unresolved_rebound = 1.0e-2_dp

  ! ---- pieces of the tangential motion

  real(dp), parameter :: narrowest = 1.0e-7_dp
  real(dp), parameter :: shortest_piece = 0.02_dp
  real(dp), parameter :: shortest = 1.0e-13_dp
  real(dp), parameter :: at_edge = 0.1_dp
  integer(ip), parameter :: most_idle = 2
  real(dp), parameter :: steady = 1.0e-10_dp, weightless = 1.0e-12_dp

  ! ---- walks

  real(dp), parameter :: walk_closeness = 1.0e-13_dp
  real(dp), parameter :: largest_phase = 0.5_dp
end module rst_tuning
