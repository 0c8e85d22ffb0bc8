!> What C calls of the method `sync` in every impact, under its C names, which end with the vector width of sync.F90.
!> Arguments are described where they are computed.
module rst_sync_interfaces
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  use rst_sync_grid, only: grid_type, level_type, node_type
  use rst_sync_guess, only: double_levels
  use rst_sync_levels, only: normal_levels
  use rst_sync_dense, only: trace_type, dense_levels
  use rst_sync_elements, only: scene_type, shear_type, term_type, columns
  use rst_sync_quadrature, only: spread_weights
  use rst_sync_edge, only: balance_levels
  use rst_sync_shear, only: follow_shear
  implicit none (type, external)
  private
  public :: rst_normal_levels, rst_double_levels, rst_dense_levels, rst_finish_levels, rst_follow_shear

contains

  pure subroutine rst_normal_levels(grid, g_inf, eta, n_terms, g, tau, n, closeness, guessed, level, memory, loading, node, &
                                    failed) bind(c, name="rst_normal_levels")
    type(grid_type), intent(in) :: grid
    real(c_double), intent(in), value :: g_inf, eta, closeness
    integer(c_int64_t), intent(in), value :: n_terms, n, guessed
    real(c_double), intent(in) :: g(n_terms), tau(n_terms)
    type(level_type), intent(inout) :: level(0:2*n)
    real(c_double), intent(out) :: memory(n_terms, 0:2*n), loading(n_terms, 0:2*n)
    type(node_type), intent(out) :: node(0:n)
    integer(c_int64_t), intent(out) :: failed
    logical :: fails
    call normal_levels(grid, g_inf, eta, n_terms, g, tau, n, closeness, guessed /= 0, level, memory, loading, node, fails)
    failed = merge(1_c_int64_t, 0_c_int64_t, fails)
  end subroutine rst_normal_levels

  pure subroutine rst_double_levels(n, level) bind(c, name="rst_double_levels")
    integer(c_int64_t), intent(in), value :: n
    type(level_type), intent(inout) :: level(0:4*n)
    call double_levels(n, level)
  end subroutine rst_double_levels

  pure subroutine rst_dense_levels(grid, g_inf, eta, n_terms, g, tau, n, r, coarse, level, trace, node, failed) &
    bind(c, name="rst_dense_levels")
    type(grid_type), intent(in) :: grid
    real(c_double), intent(in), value :: g_inf, eta
    integer(c_int64_t), intent(in), value :: n_terms, n, r
    real(c_double), intent(in) :: g(n_terms), tau(n_terms)
    type(level_type), intent(in) :: coarse(0:2*n)
    type(level_type), intent(out) :: level(0:2*n*r)
    type(trace_type), intent(out) :: trace(n_terms, 0:2*n*r)
    type(node_type), intent(out) :: node(0:n*r)
    integer(c_int64_t), intent(out) :: failed
    logical :: fails
    call dense_levels(grid, g_inf, eta, n_terms, g, tau, n, r, coarse, level, trace, node, fails)
    failed = merge(1_c_int64_t, 0_c_int64_t, fails)
  end subroutine rst_dense_levels

  !> What all runs on these levels share, made once.
  pure subroutine rst_finish_levels(g_inf, n_terms, n, trace, node, level) bind(c, name="rst_finish_levels")
    real(c_double), intent(in), value :: g_inf
    integer(c_int64_t), intent(in), value :: n_terms, n
    type(trace_type), intent(in) :: trace(n_terms, 0:2*n)
    type(node_type), intent(in) :: node(0:n)
    type(level_type), intent(inout) :: level(0:2*n)
    call balance_levels(g_inf, n_terms, n, trace, node, level)
    call spread_weights(n, level)
  end subroutine rst_finish_levels

  subroutine rst_follow_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state) &
    bind(c, name="rst_follow_shear")
    type(scene_type), intent(in) :: scene
    real(c_double), intent(in) :: g(scene%n_terms), tau(scene%n_terms)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(level_type), intent(in) :: level(0:2*scene%n)
    type(node_type), intent(in) :: node(0:scene%n)
    real(c_double), intent(out) :: body(0:scene%capacity - 1, columns)
    real(c_double), intent(out), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(term_type), intent(inout) :: term(scene%n_terms)
    type(shear_type), intent(out) :: state
    call follow_shear(scene, g, tau, level, trace, node, body, beta, faded, term, state)
  end subroutine rst_follow_shear
end module rst_sync_interfaces
