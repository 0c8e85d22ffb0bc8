!> The compression on one panel (docs/sync.md): radius and velocity over the edge angle theta, tan(theta) = A/(r D').
!>
!>   dA/dtheta = D' Q/(r N),  dD'/dtheta = -(15/8) F ds/dtheta,  ds/dtheta = 2 A Q/(r N),
!>   Q = A^2 + r^2 D'^2,  N = D'^2 + (15/4) A^2 F,  F = eta A D' + sum_k P_k,  P_k' = g_k A D' - P_k/tau_k
!>
!> All of it is smooth at first touch (theta = 0) and at the turning point (theta = pi/2).
module rst_compression_panel
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, point, integral, weights_at, integrated, applied, composed, solve_linear
  use rst_arms, only: solid_type, respond
  use rst_panel, only: panel_type, mass_factor
  implicit none (type, external)
  private
  public :: compress

  integer(ip), parameter :: most_iterations = 15

  !> Radius, velocity and force at the points, and what follows from them.
  type :: motion_type
    real(dp), dimension(stages) :: a, v, f, pace
  end type motion_type

contains

  !> The panel from its values at its start, (0), and from the panel before as a guess. r: the scale of the radius in theta.
  pure subroutine compress(solid, g, rate, r, closeness, before, panel, memory, loading, fails)
    type(solid_type), intent(in) :: solid
    real(dp), intent(in) :: g(solid%n_arms), rate(solid%n_arms), r
    real(dp), intent(in) :: closeness  !! iterations end when the next one would change D' and A/r by less
    type(panel_type), intent(in) :: before
    type(panel_type), intent(inout) :: panel
    real(dp), dimension(0:stages, solid%n_arms), intent(inout) :: memory, loading  !! M_k and P_k
    logical, intent(out) :: fails
    type(motion_type) :: m
    real(dp) :: answer(stages, stages), step(2*stages, 1), change, previous, h
    integer(ip) :: i
    h = panel%to - panel%from
    m = guess(r, before, panel)
    previous = 1
    do i = 1, most_iterations
      m%pace = pace_of(r, m%a, m%v, m%f)
      call load(solid, g, rate, h*m%pace, m, loading, answer, fails)
      if (fails) return
      m%pace = pace_of(r, m%a, m%v, m%f)
      call newton(solid%eta, r, h, panel, m, answer, step, fails)
      if (fails) return
      change = maxval(abs(step(:stages, 1)))/r + maxval(abs(step(stages + 1:, 1)))
      fails = .not. change < 1.0e3_dp
      if (fails) return
      m%a = m%a + step(:stages, 1)
      m%v = m%v + step(stages + 1:, 1)
      fails = any(m%a <= 0)
      if (fails) return
      if (change*min(1.0_dp, change/previous) < closeness) exit
      previous = change
    end do
    fails = i > most_iterations
    if (fails) return
    call note(solid, g, rate, r, h, m, panel, memory, loading, fails)
  end subroutine compress

  !> From the panel before, continued; at first touch A = r sin(theta), D' = cos(theta).
  pure function guess(r, before, panel) result(m)
    real(dp), intent(in) :: r
    type(panel_type), intent(in) :: before, panel
    type(motion_type) :: m
    real(dp) :: x, theta, weight(0:stages)
    integer(ip) :: i
    do i = 1, stages
      theta = panel%from + point(i)*(panel%to - panel%from)
      if (panel%from > 0) then
        x = (theta - before%from)/(before%to - before%from)
        weight = weights_at(x)
        m%a(i) = sum(weight*before%radius)
        m%v(i) = sum(weight*before%velocity)
        m%f(i) = sum(weight*before%force)
      else
        m%a(i) = r*sin(theta)
        m%v(i) = cos(theta)
        m%f(i) = m%a(i)**3
      end if
    end do
    if (all(m%a > 0 .and. m%f > 0 .and. m%v > -0.1_dp)) return
    m%a = panel%radius(0)
    m%f = max(panel%force(0), tiny(1.0_dp))
    m%v = m%a/r*cos(panel%from + point(1:)*(panel%to - panel%from))/sin(panel%from + point(1:)*(panel%to - panel%from))
  end function guess

  !> |ds/dtheta|
  elemental function pace_of(r, a, v, f) result(pace)
    real(dp), intent(in) :: r, a, v, f
    real(dp) :: pace
    pace = 2*a*(a*a + (r*v)**2)/(r*(v*v + 2*mass_factor*a*a*f))
  end function pace_of

  !> P_k and F. answer: of F at a point to A D' at another one, by the arms.
  pure subroutine load(solid, g, rate, span, m, loading, answer, fails)
    type(solid_type), intent(in) :: solid
    real(dp), intent(in) :: g(solid%n_arms), rate(solid%n_arms), span(stages)
    type(motion_type), intent(inout) :: m
    real(dp), intent(inout) :: loading(0:stages, solid%n_arms)
    real(dp), intent(out) :: answer(stages, stages)
    logical, intent(out) :: fails
    real(dp) :: kernel(stages, stages), decay(stages)
    integer(ip) :: j, k
    answer = 0
    m%f = solid%eta*m%a*m%v
    fails = .false.
    do k = 1, solid%n_arms
      call respond(rate(k), span, kernel, decay, fails)
      if (fails) return
      loading(1:, k) = decay*loading(0, k) + applied(kernel, g(k)*span*m%a*m%v)
      m%f = m%f + loading(1:, k)
      do j = 1, stages
        answer(:, j) = answer(:, j) + kernel(:, j)*(g(k)*span(j))
      end do
    end do
  end subroutine load

  !> Newton's step of A and D'; that the arms answer to the pace too is left out of its matrix.
  pure subroutine newton(eta, r, h, panel, m, answer, step, fails)
    real(dp), intent(in) :: eta, r, h, answer(stages, stages)
    type(panel_type), intent(in) :: panel
    type(motion_type), intent(in) :: m
    real(dp), intent(out) :: step(2*stages, 1)
    logical, intent(out) :: fails
    real(dp), dimension(stages, stages) :: by_a, by_v, pull_a, pull_v
    real(dp), dimension(stages) :: alpha, q, n, part, part_a, part_v, part_f
    real(dp) :: matrix(2*stages, 2*stages)
    integer(ip) :: i, j
    alpha = mass_factor*m%f
    q = m%a**2 + (r*m%v)**2
    n = m%v**2 + 2*m%a**2*alpha
    part = q/(r*n)  ! dA/dtheta = D' part, ds/dtheta = 2 A part
    part_a = part*(2*m%a/q - 4*m%a*alpha/n)
    part_v = part*(2*r*r*m%v/q - 2*m%v/n)
    part_f = -part*2*m%a**2/n*mass_factor
    step(:stages, 1) = integrated(panel%radius(0), h*part*m%v) - m%a
    step(stages + 1:, 1) = integrated(panel%velocity(0), -h*alpha*2*m%a*part) - m%v
    do j = 1, stages
      by_a(:, j) = part_f*(answer(:, j)*m%v(j))  ! of `part` to A at the point j
      by_a(j, j) = by_a(j, j) + part_f(j)*eta*m%v(j) + part_a(j)
      by_v(:, j) = part_f*(answer(:, j)*m%a(j))
      by_v(j, j) = by_v(j, j) + part_f(j)*eta*m%a(j) + part_v(j)
      pull_a(:, j) = mass_factor*answer(:, j)*m%v(j)
      pull_a(j, j) = pull_a(j, j) + mass_factor*eta*m%v(j)
      pull_v(:, j) = mass_factor*answer(:, j)*m%a(j)
      pull_v(j, j) = pull_v(j, j) + mass_factor*eta*m%a(j)
    end do
    do j = 1, stages
      pull_a(:, j) = 2*m%a*(part*pull_a(:, j) + alpha*by_a(:, j))
      pull_v(:, j) = 2*m%a*(part*pull_v(:, j) + alpha*by_v(:, j))
      by_a(:, j) = m%v*by_a(:, j)
      by_v(:, j) = m%v*by_v(:, j)
      pull_a(j, j) = pull_a(j, j) + 2*part(j)*alpha(j)
      by_v(j, j) = by_v(j, j) + part(j)
    end do
    matrix(:stages, :stages) = -h*composed(integral, by_a)
    matrix(:stages, stages + 1:) = -h*composed(integral, by_v)
    matrix(stages + 1:, :stages) = h*composed(integral, pull_a)
    matrix(stages + 1:, stages + 1:) = h*composed(integral, pull_v)
    do i = 1, 2*stages
      matrix(i, i) = 1 + matrix(i, i)
    end do
    call solve_linear(2*stages, 1_ip, matrix, step, fails)
  end subroutine newton

  !> The motion, put into the panel.
  pure subroutine note(solid, g, rate, r, h, m, panel, memory, loading, fails)
    type(solid_type), intent(in) :: solid
    real(dp), intent(in) :: g(solid%n_arms), rate(solid%n_arms), r, h
    type(motion_type), intent(inout) :: m
    type(panel_type), intent(inout) :: panel
    real(dp), dimension(0:stages, solid%n_arms), intent(inout) :: memory, loading
    logical, intent(out) :: fails
    real(dp) :: kernel(stages, stages), decay(stages), span(stages)
    integer(ip) :: k
    fails = .false.
    span = h*pace_of(r, m%a, m%v, m%f)
    m%f = solid%eta*m%a*m%v
    do k = 1, solid%n_arms
      call respond(rate(k), span, kernel, decay, fails)
      if (fails) return
      loading(1:, k) = decay*loading(0, k) + applied(kernel, g(k)*span*m%a*m%v)
      memory(1:, k) = decay*memory(0, k) + applied(kernel, g(k)*span*m%v)
      m%f = m%f + loading(1:, k)
    end do
    panel%radius(1:) = m%a
    panel%depth(1:) = m%a**2
    panel%velocity(1:) = m%v
    panel%force(1:) = m%f
    panel%pace(1:) = pace_of(r, m%a, m%v, m%f)
    panel%time(1:) = integrated(panel%time(0), h*panel%pace(1:))
    fails = .not. all(abs(panel%time) < huge(1.0_dp)) .or. any(panel%pace(1:) <= 0)
  end subroutine note
end module rst_compression_panel
