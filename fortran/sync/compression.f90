!> The compression on one panel (docs/sync.md): in the plane of A/r and D' the sphere is at the
!> distance rho from the origin, at the edge angle theta,  A = r rho sin(theta), D' = rho
!> cos(theta),  and with kappa = (15/4) r^2 F
!>
!>   drho/dtheta = rho sin cos (1 - kappa)/(cos^2 + kappa sin^2),  ds/dtheta = 2 r^2 rho sin/(cos^2 + kappa sin^2),
!>   F = eta A D' + sum_k P_k,  P_k' = g_k A D' - P_k/tau_k.
!>
!> All of it is smooth, at first touch (theta = 0, rho = 1) and at the turning point (theta = pi/2)
!> too.
module rst_compression_panel
  use rst_precision, only: dp, ip
  use rst_motion_factors, only: mass_factor
  use rst_collocation, only: stages, point, integral, integrated, applied, factors_type, factorize, solution_of, &
                             has_converged
  use rst_arms, only: respond, advance
  use rst_tuning, only: keeps_matrix, largest_decrease, diverges_above, most_steps
  use rst_panel, only: panel_type, normal_type
  implicit none (type, external)
  private
  public :: compress

  !> At the points: sine and cosine of theta, rho, force, and cos^2 + kappa sin^2.
  type :: motion_type
    real(dp), dimension(stages) :: sine, cosine, rho, force, below
  end type motion_type

  !> If it is wanted, or kept: how the force answers to A D' and to the time per x, and Newton's
  !> matrix.
  type :: slope_type
    logical :: wanted
    real(dp), dimension(stages, stages) :: by_sweep, by_span
    type(factors_type) :: factors
  end type slope_type

contains

  !> The panel n from its values at its start, (0), and from those at its points as a guess. Unknown
  !> is F: rho follows from it.
  subroutine compress(normal, n, fails)
    type(normal_type), intent(in) :: normal
    integer(ip), intent(in) :: n
    logical, intent(out) :: fails
    type(motion_type) :: m
    type(slope_type) :: slope
    real(dp), dimension(stages) :: theta, force, step, turn
    real(dp) :: change, previous, width, scale, start
    real(dp), pointer, contiguous :: loading(:, :), kernel(:, :, :) ! compilers would copy components of derived types
    integer(ip) :: i
    loading(0:, 1:) => normal%loading(:, :, n)
    kernel(1:, 0:, 1:) => normal%kernel(:, :, :, n)
    scale = normal%scale
    associate (panel => normal%panel(n))
      width = panel%to - panel%from
      start = sqrt(panel%velocity(0)**2 + (panel%radius(0)/scale)**2)
      theta = panel%from + point(1:)*width
      force = panel%force(1:)
    end associate
    m%sine = sin(theta)
    m%cosine = cos(theta)
    previous = 1
    slope%wanted = .true.
    do i = 1, most_steps
      call follow(scale, width, start, force, m)
      call load(normal%eta, normal%g, normal%rate, scale, width, m, loading, kernel, slope, fails)
      if (.not. fails .and. slope%wanted) call prepare(scale, width, m, slope, fails)
      if (fails) return
      step = max(solution_of(slope%factors, m%force - force), -largest_decrease*force)
      force = force + step
      turn = 2*mass_factor*scale**2*step/m%below ! of kappa
      change = maxval(abs(turn)*m%sine**2) + maxval(abs(integrated(0.0_dp, width*m%sine*m%cosine*turn/m%below)))
      fails = .not. change < diverges_above
      if (fails) return
      if (has_converged(change, previous, normal%closeness)) exit
      slope%wanted = change > keeps_matrix*previous
      previous = change
    end do
    fails = i > most_steps
    if (fails) return
    slope%wanted = .false.
    call follow(scale, width, start, force, m)
    call load(normal%eta, normal%g, normal%rate, scale, width, m, loading, kernel, slope, fails)
    if (.not. fails) call note(normal, scale, width, m, n, fails)
  end subroutine compress

  !> rho for a force, d ln(rho)/dtheta = sin cos (1 - kappa)/(cos^2 + kappa sin^2).
  pure subroutine follow(scale, width, start, force, m)
    real(dp), intent(in) :: scale, width, start, force(stages)
    type(motion_type), intent(inout) :: m
    real(dp) :: kappa(stages)
    kappa = 2*mass_factor*scale*scale*force
    m%below = m%cosine**2 + kappa*m%sine**2
    m%rho = start*exp(integrated(0.0_dp, width*m%sine*m%cosine*(1 - kappa)/m%below))
  end subroutine follow

  !> The force of that motion.
  pure subroutine load(eta, g, rate, scale, width, m, loading, kernel, slope, fails)
    real(dp), intent(in) :: eta, g(:), rate(:), scale, width
    type(motion_type), intent(inout) :: m
    real(dp), intent(inout) :: loading(0:stages, size(g)), kernel(stages, 0:stages, size(g))
    type(slope_type), intent(inout) :: slope
    logical, intent(out) :: fails
    real(dp) :: span(stages), sweep(stages), to_span(stages)
    integer(ip) :: j, k
    span = width*pace_of(scale, m)
    sweep = scale*m%rho**2*m%sine*m%cosine ! A D'
    m%force = eta*sweep
    if (slope%wanted) slope%by_sweep = 0
    if (slope%wanted) slope%by_span = 0
    fails = .false.
    do k = 1, size(g, kind=ip)
      call respond(rate(k), span, kernel(:, :, k), fails)
      if (fails) return
      loading(1:, k) = kernel(:, 0, k)*loading(0, k) + applied(kernel(:, 1:, k), g(k)*span*sweep)
      m%force = m%force + loading(1:, k)
      if (.not. slope%wanted) cycle
      to_span = g(k)*sweep - rate(k)*loading(1:, k)
      do j = 1, stages
        slope%by_sweep(:, j) = slope%by_sweep(:, j) + kernel(:, j, k)*(g(k)*span(j))
        slope%by_span(:, j) = slope%by_span(:, j) + kernel(:, j, k)*to_span(j)
      end do
    end do
    if (.not. slope%wanted) return
    do j = 1, stages
      slope%by_sweep(j, j) = slope%by_sweep(j, j) + eta
    end do
  end subroutine load

  !> ds/dtheta
  pure function pace_of(scale, m) result(pace)
    real(dp), intent(in) :: scale
    type(motion_type), intent(in) :: m
    real(dp) :: pace(stages)
    pace = 2*scale*scale*m%rho*m%sine/m%below
  end function pace_of

  !> Newton's matrix for the force, of what it is less what its own motion makes it.
  pure subroutine prepare(scale, width, m, slope, fails)
    real(dp), intent(in) :: scale, width
    type(motion_type), intent(in) :: m
    type(slope_type), intent(inout) :: slope
    logical, intent(out) :: fails
    real(dp) :: by_rho(stages, stages), matrix(stages, stages), both(stages), span(stages), kappa
    integer(ip) :: j
    kappa = 2*mass_factor*scale*scale ! of a force
    both = m%sine*m%cosine
    span = width*pace_of(scale, m)
    do j = 1, stages
      by_rho(:, j) = slope%by_sweep(:, j)*(2*scale*m%rho(j)**2*both(j)) + slope%by_span(:, j)*span(j) ! to ln(rho)
    end do
    do j = 1, stages
      matrix(:, j) = applied(by_rho, integral(:, j))*(width*kappa*both(j)/m%below(j)**2) &
                     + slope%by_span(:, j)*(span(j)*kappa*m%sine(j)**2/m%below(j))
      matrix(j, j) = 1 + matrix(j, j)
    end do
    call factorize(matrix, slope%factors, fails)
  end subroutine prepare

  !> The motion, put into the panel, and M_k.
  subroutine note(normal, scale, width, m, n, fails)
    type(normal_type), intent(in) :: normal
    real(dp), intent(in) :: scale, width
    type(motion_type), intent(in) :: m
    integer(ip), intent(in) :: n
    logical, intent(out) :: fails
    real(dp), pointer, contiguous :: kernel(:, :, :), memory(:, :)
    associate (panel => normal%panel(n))
      panel%radius(1:) = scale*m%rho*m%sine
      panel%depth(1:) = panel%radius(1:)**2
      panel%velocity(1:) = m%rho*m%cosine
      if (panel%to >= acos(0.0_dp)) panel%velocity(stages) = 0
      panel%force(1:) = m%force
      panel%pace(1:) = pace_of(scale, m)
      panel%time(1:) = integrated(panel%time(0), width*panel%pace(1:))
      fails = .not. all(abs(panel%time) < huge(1.0_dp)) .or. any(panel%pace(1:) <= 0)
      kernel(1:, 0:, 1:) => normal%kernel(:, :, :, n)
      memory(0:, 1:) => normal%memory(:, :, n)
      call advance(normal%g, width*panel%pace(1:), kernel, panel%velocity(1:), memory)
    end associate
  end subroutine note
end module rst_compression_panel
