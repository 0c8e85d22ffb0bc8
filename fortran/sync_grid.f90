!> Levels and nodes of the method `sync`, and how they are spread (THEORY 6).
!>
!> The nodes X_0 = 0 < X_1 < ... < X_n = A_max are where the edge is at n instants of the compression; the levels are these
!> instants and the n of the restitution at which the shrinking edge is there again.
module rst_sync_grid
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: grid_type, level_type, node_type, likely_depth, choose_grid, spread_nodes, at_level, mass_factor

  real(dp), parameter :: mass_factor = 15.0_dp/8.0_dp

  !> How levels are spread: by u = tan(phi/2), tan(phi) = A/(radius D'), from 0 at first touch to 1 at the turning point.
  !> In strongly damped impacts the contact shrinks to a small part of its size at once, and the sphere all but stops before it
  !> turns: start and turn are how finely both ends are divided (u = sinh(start v)/sinh(start) and alike; 0: evenly).
  type, bind(c) :: grid_type
    real(dp) :: radius, start, turn
  end type grid_type

  !> Where the sphere is at a level; step: time since the level before, with all its digits; force: int_0^A f dX. For the
  !> tangential problem: `fresh` is f + G_inf X^2 of an element that forgets nothing, `missing` what the sum over nodes lacks of the
  !> force, `weight` see module rst_sync_quadrature. Twin of `struct sync_level` in C.
  type, bind(c) :: level_type
    real(dp) :: time, step, depth, velocity, force, fresh, missing, weight(0:3)
  end type level_type

  !> X_j and dX/dj. Twin of `struct sync_node` in C.
  type, bind(c) :: node_type
    real(dp) :: radius, width
  end type node_type

contains

  !> Largest indentation, roughly (a few per cent): the energy balance with the modulus at that age,
  !> 1 = D^(5/2) (G_inf + sum g_k/(1 + 0.8 D/tau_k) + (5/4) eta/D), which has the elastic and the viscous limit right.
  !> It starts from the solid's own scale, so that scaled moduli give the same steps.
  pure function likely_depth(g_inf, eta, n_terms, g, tau) result(depth)
    real(dp), intent(in) :: g_inf, eta
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp) :: depth, modulus, factor
    integer(ip) :: i, k
    modulus = g_inf
    if (.not. g_inf > 0) modulus = sum(g)
    depth = (1.25_dp*max(eta, tiny(1.0_dp)))**(-2.0_dp/3.0_dp)
    if (modulus > 0) depth = modulus**(-0.4_dp)
    do i = 1, 100
      modulus = g_inf + 1.25_dp*eta/depth
      do k = 1, n_terms
        modulus = modulus + g(k)/(1 + 0.8_dp*depth/tau(k))
      end do
      factor = 1/sqrt(modulus*depth*depth*sqrt(depth))
      depth = depth*factor
      if (abs(factor - 1) < 0.01_dp) exit
    end do
  end function likely_depth

  !> Stiffness and viscosity at the age of the impact, whose depth is known roughly.
  pure subroutine soften(g_inf, eta, n_terms, g, tau, depth, stiffness, viscosity)
    real(dp), intent(in) :: g_inf, eta, depth
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp), intent(out) :: stiffness, viscosity
    real(dp) :: age
    integer(ip) :: k
    stiffness = g_inf
    viscosity = eta
    do k = 1, n_terms
      age = 0.8_dp*tau(k)/depth
      stiffness = stiffness + g(k)*(age/(1 + age))**2
      viscosity = viscosity + g(k)*tau(k)/(1 + age)**2
    end do
  end subroutine soften

  !> Grid for a solid, from what a Kelvin-Voigt solid of its stiffness E and viscosity would do, both at the age of the impact:
  !> after the turning point its contact shrinks to A ~ (E D/viscosity^2)^(1/3) before the sphere moves; before it, the
  !> sphere creeps at D' ~ E D/viscosity. Where the contact shrinks to a smaller part, both ends are divided by these. Below that
  !> damping the turning point alone is, and the less, the less the sphere creeps: in the few levels around it all that slips may
  !> come to slip, but else levels are wanted elsewhere.
  pure function choose_grid(g_inf, eta, n_terms, g, tau) result(grid)
    real(dp), intent(in) :: g_inf, eta
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    type(grid_type) :: grid
    real(dp), parameter :: even_above = 0.5_dp  !! contacts that stay larger than this part need no grading of the start
    real(dp), parameter :: creeping = 0.125_dp  !! D' of such creep
    real(dp), parameter :: nothing = 1.0e-6_dp  !! over D' of the creep: turn would be 1e-20, and all but 0 for even less
    real(dp) :: depth, stiffness, viscosity, small_radius, creep
    depth = likely_depth(g_inf, eta, n_terms, g, tau)
    grid = grid_type(sqrt(depth), 0.0_dp, 0.0_dp)
    call soften(g_inf, eta, n_terms, g, tau, depth, stiffness, viscosity)
    if (viscosity <= nothing*depth*stiffness) return
    small_radius = depth*stiffness/viscosity**2
    creep = max(depth*stiffness/viscosity, 1.0e-9_dp)
    grid%turn = asinh(min(1.0_dp, creeping/creep)**2/creep)
    if (small_radius > (even_above*grid%radius)**3) return
    grid%start = asinh(grid%radius/small_radius**(1.0_dp/3.0_dp))
    grid%turn = asinh(1/creep)
  end function choose_grid

  !> Where the levels of the compression are: radius and width hold u and du/dj, until the compression has passed them.
  pure subroutine spread_nodes(grid, n, node)
    type(grid_type), intent(in) :: grid
    integer(ip), intent(in) :: n
    type(node_type), intent(out) :: node(0:n)
    real(dp) :: v, slope, turn_scale, start_scale
    integer(ip) :: j
    turn_scale = 0
    start_scale = 0
    if (grid%turn > 0) turn_scale = 1/sinh(grid%turn)
    if (grid%start > 0) start_scale = 1/sinh(grid%start)
    do j = 0, n
      v = real(j, dp)/real(n, dp)
      slope = 1/real(n, dp)
      if (grid%turn > 0) then
        slope = slope*grid%turn*cosh(grid%turn*(1 - v))*turn_scale
        v = 1 - sinh(grid%turn*(1 - v))*turn_scale
      end if
      if (grid%start > 0) then
        slope = slope*grid%start*cosh(grid%start*v)*start_scale
        v = sinh(grid%start*v)*start_scale
      end if
      node(j) = node_type(v, slope)
    end do
    node(0) = node_type(0.0_dp, 2*grid%radius*node(0)%width)
  end subroutine spread_nodes

  pure function at_level(time, step, depth, velocity, force) result(level)
    real(dp), intent(in) :: time, step, depth, velocity, force
    type(level_type) :: level
    level = level_type(time, step, depth, velocity, force, 0.0_dp, 0.0_dp, 0.0_dp)
  end function at_level
end module rst_sync_grid
