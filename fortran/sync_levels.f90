!> The normal problem at levels at which the edge of contact sits on a node (THEORY 4.4 to 4.6 and 6). No elements are needed:
!>
!>   compression  P_k = int_0^A w_k dX obeys P_k' = A D' - P_k/tau_k
!>   restitution  the edge at X_j, entered at t_j, is free:  G_inf (D - X_j^2) + sum_k (M_k(s) - E_kj M_k(t_j)) + eta D' = 0
!>                with M_k' = D' - M_k/tau_k and E_kj = exp(-(s-t_j)/tau_k), and with it the whole force is known from the
!>                compression:  int_0^A f dX = (2/3) G_inf X_j^3 + sum_k E_kj P_k(t_j)
!>
!> Both are integrated in panels of two levels: the acceleration is the parabola in time through three levels, velocity
!> and depth are its integrals and fading memory is taken exactly (module rst_memory): fourth order, for any tau. Stresses
!> stand for elongations (M_k and P_k times g_k), so that tau_k -> 0 at constant g_k tau_k is a dashpot.
module rst_sync_levels
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: grid_type, level_type, node_type, spread_nodes, at_level, mass_factor
  use rst_sync_compression, only: compression_panel
  use rst_sync_restitution, only: restitution_panel
  implicit none (type, external)
  private
  public :: normal_levels
  public :: grid_type, level_type, node_type, mass_factor  ! of rst_sync_grid: what all who work on levels need

contains

  !> All levels. `failed` tells that an iteration did not converge: take more levels.
  pure subroutine normal_levels(grid, g_inf, eta, n_terms, g, tau, n, closeness, guessed, level, memory, loading, node, failed)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n_terms, n  !! n even
    real(dp), intent(in) :: g_inf, eta, g(n_terms), tau(n_terms)
    real(dp), intent(in) :: closeness  !! iterations stop when velocities, and times relatively, change by less
    logical, intent(in) :: guessed     !! whether the levels come with a guess (double_levels)
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp), intent(out) :: memory(n_terms, 0:2*n)   !! g_k M_k
    real(dp), intent(out) :: loading(n_terms, 0:2*n)  !! g_k P_k of the compression
    type(node_type), intent(out) :: node(0:n)         !! radii; widths are not made
    logical, intent(out) :: failed
    type(level_type) :: guess, next_guess
    real(dp), parameter :: rounding_of_change = 1.0e-12_dp
    real(dp) :: rate, close
    integer(ip) :: l

    call spread_nodes(grid, n, node)
    close = closeness
    if (grid%start > 0) close = max(0.25_dp*closeness, min(closeness, rounding_of_change)) ! both ends are small
    rate = merge(0.003_dp, 1.0_dp, guessed) ! as the run with half the levels ended, or nothing known
    guess = level(0)
    level(0) = at_level(0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp)
    memory(:, 0) = 0
    loading(:, 0) = 0
    do l = 0, n - 2, 2
      next_guess = level(l + 2)
      if (grid%start > 0 .or. eta > 0) rate = 1 ! panels are unlike; Newton's steps are not made for a dashpot
      call compression_panel(grid, g_inf, eta, n_terms, g, tau, n, l, close, guessed, guess, rate, level, memory, &
                             loading, node, failed)
      if (failed) return
      guess = next_guess
    end do
    do l = n, 2*n - 2, 2
      next_guess = level(l + 2)
      if (grid%start > 0 .or. eta > 0) rate = 1 ! panels are unlike; Newton's steps are not made for a dashpot
      call restitution_panel(g_inf, eta, n_terms, g, tau, n, l, close, guessed, guess, rate, level, memory, &
                             loading, node, failed)
      if (failed) return
      guess = next_guess
    end do
  end subroutine normal_levels
end module rst_sync_levels
