!> The compression on one panel (docs/sync.md): in the plane of A/r and D' the sphere is at the distance rho from the origin, at
!> the edge angle theta,  A = r rho sin(theta), D' = rho cos(theta),  and with kappa = (15/4) r^2 F
!>
!>   drho/dtheta = rho sin cos (1 - kappa)/(cos^2 + kappa sin^2),  ds/dtheta = 2 r^2 rho sin/(cos^2 + kappa sin^2),
!>   F = eta A D' + sum_k P_k,  P_k' = g_k A D' - P_k/tau_k.
!>
!> All of it is smooth, at first touch (theta = 0, rho = 1) and at the turning point (theta = pi/2) too.
module rst_compression_panel
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, point, integral, integrated, applied, composed, factors_type, factorize, solution_of, &
                             has_converged, keeps_matrix
  use rst_arms, only: solid_type, respond
  use rst_panel, only: panel_type, mesh_type, mass_factor
  implicit none (type, external)
  private
  public :: compress

  integer(ip), parameter :: most_iterations = 15

  !> Sine and cosine of theta at the points, rho, kappa, force, and cos^2 + kappa sin^2.
  type :: motion_type
    real(dp), dimension(stages) :: sine, cosine, rho, kappa, force, below
  end type motion_type

contains

  !> The panel from its values at its start, (0), and from those at its points as a guess.
  pure subroutine compress(solid, g, rate, mesh, panel, memory, loading, fails)
    type(solid_type), intent(in) :: solid
    real(dp), intent(in) :: g(solid%n_arms), rate(solid%n_arms)
    type(mesh_type), intent(in) :: mesh
    type(panel_type), intent(inout) :: panel
    real(dp), dimension(0:stages, solid%n_arms), intent(inout) :: memory, loading  !! M_k and P_k
    logical, intent(out) :: fails
    type(motion_type) :: m
    type(factors_type) :: factors
    real(dp) :: answer(stages, stages), step(stages), change, previous, h, start
    logical :: new
    integer(ip) :: i
    h = panel%to - panel%from
    start = sqrt(panel%velocity(0)**2 + (panel%radius(0)/mesh%radius)**2)
    call begin(mesh%radius, panel, m)
    previous = 1
    new = .true.
    do i = 1, most_iterations
      call load(solid, g, rate, mesh%radius, h, m, loading, answer, fails)
      if (.not. fails .and. new) call factorize(newton_matrix(mesh%radius, h, m, answer), factors, fails)
      if (fails) return
      step = solution_of(factors, missing(h, start, m))
      m%rho = m%rho + step
      change = maxval(abs(step))
      fails = .not. (change < 1.0e3_dp .and. all(m%rho > 0))
      if (fails) return
      if (has_converged(change, min(previous, 10*change), mesh%closeness)) exit
      new = change > keeps_matrix*previous
      previous = change
    end do
    fails = i > most_iterations
    if (fails) return
    call load(solid, g, rate, mesh%radius, h, m, loading, answer, fails)
    if (.not. fails) call note(solid, g, rate, mesh%radius, h, m, panel, memory, fails)
  end subroutine compress

  !> From the guess in the panel.
  pure subroutine begin(r, panel, m)
    real(dp), intent(in) :: r
    type(panel_type), intent(in) :: panel
    type(motion_type), intent(out) :: m
    real(dp) :: theta(stages)
    theta = panel%from + point(1:)*(panel%to - panel%from)
    m%sine = sin(theta)
    m%cosine = cos(theta)
    m%rho = sqrt(panel%velocity(1:)**2 + (panel%radius(1:)/r)**2)
    m%force = panel%force(1:)
    m%kappa = 2*mass_factor*r*r*m%force
    m%below = m%cosine**2 + m%kappa*m%sine**2
  end subroutine begin

  !> F by P_k at the pace of the F before; answer: of F at a point to A D' at another one.
  pure subroutine load(solid, g, rate, r, h, m, loading, answer, fails)
    type(solid_type), intent(in) :: solid
    real(dp), intent(in) :: g(solid%n_arms), rate(solid%n_arms), r, h
    type(motion_type), intent(inout) :: m
    real(dp), intent(inout) :: loading(0:stages, solid%n_arms)
    real(dp), intent(out) :: answer(stages, stages)
    logical, intent(out) :: fails
    real(dp) :: kernel(stages, stages), decay(stages), span(stages), sweep(stages)
    integer(ip) :: j, k
    span = h*pace_of(r, m)
    sweep = r*m%rho**2*m%sine*m%cosine ! A D'
    answer = 0
    m%force = solid%eta*sweep
    fails = .false.
    do k = 1, solid%n_arms
      call respond(rate(k), span, kernel, decay, fails)
      if (fails) return
      loading(1:, k) = decay*loading(0, k) + applied(kernel, g(k)*span*sweep)
      m%force = m%force + loading(1:, k)
      do j = 1, stages
        answer(:, j) = answer(:, j) + kernel(:, j)*(g(k)*span(j))
      end do
    end do
    do j = 1, stages
      answer(j, j) = answer(j, j) + solid%eta
    end do
    m%kappa = 2*mass_factor*r*r*m%force
    m%below = m%cosine**2 + m%kappa*m%sine**2
  end subroutine load

  !> ds/dtheta
  pure function pace_of(r, m) result(pace)
    real(dp), intent(in) :: r
    type(motion_type), intent(in) :: m
    real(dp) :: pace(stages)
    pace = 2*r*r*m%rho*m%sine/m%below
  end function pace_of

  !> What rho lacks of its integral.
  pure function missing(h, start, m) result(miss)
    real(dp), intent(in) :: h, start
    type(motion_type), intent(in) :: m
    real(dp) :: miss(stages)
    miss = integrated(start, h*m%rho*m%sine*m%cosine*(1 - m%kappa)/m%below) - m%rho
  end function missing

  !> Newton's matrix for that; that the arms answer to the pace too is left out.
  pure function newton_matrix(r, h, m, answer) result(matrix)
    real(dp), intent(in) :: r, h, answer(stages, stages)
    type(motion_type), intent(in) :: m
    real(dp) :: matrix(stages, stages), slope(stages, stages), both(stages), by_kappa(stages)
    integer(ip) :: j
    both = m%sine*m%cosine
    by_kappa = -(m%rho*both/m%below**2)*(2*mass_factor*r*r)
    do j = 1, stages
      slope(:, j) = by_kappa*answer(:, j)*(2*r*m%rho(j)*both(j))
      slope(j, j) = slope(j, j) + both(j)*(1 - m%kappa(j))/m%below(j)
    end do
    matrix = -h*composed(integral, slope)
    do j = 1, stages
      matrix(j, j) = 1 + matrix(j, j)
    end do
  end function newton_matrix

  !> The motion, put into the panel, and M_k.
  pure subroutine note(solid, g, rate, r, h, m, panel, memory, fails)
    type(solid_type), intent(in) :: solid
    real(dp), intent(in) :: g(solid%n_arms), rate(solid%n_arms), r, h
    type(motion_type), intent(in) :: m
    type(panel_type), intent(inout) :: panel
    real(dp), intent(inout) :: memory(0:stages, solid%n_arms)
    logical, intent(out) :: fails
    real(dp) :: kernel(stages, stages), decay(stages)
    integer(ip) :: k
    panel%radius(1:) = r*m%rho*m%sine
    panel%depth(1:) = panel%radius(1:)**2
    panel%velocity(1:) = m%rho*m%cosine
    if (panel%to >= acos(0.0_dp)) panel%velocity(stages) = 0
    panel%force(1:) = m%force
    panel%pace(1:) = pace_of(r, m)
    panel%time(1:) = integrated(panel%time(0), h*panel%pace(1:))
    fails = .not. all(abs(panel%time) < huge(1.0_dp)) .or. any(panel%pace(1:) <= 0)
    if (fails) return
    do k = 1, solid%n_arms
      call respond(rate(k), h*panel%pace(1:), kernel, decay, fails)
      if (fails) return
      memory(1:, k) = decay*memory(0, k) + applied(kernel, g(k)*h*panel%pace(1:)*panel%velocity(1:))
    end do
  end subroutine note
end module rst_compression_panel
