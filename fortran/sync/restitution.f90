!> The restitution on one panel (docs/sync.md): the edge goes back over the angles of the compression. When it is again at the
!> radius that it had at the time t_A of the compression it is free,
!>
!>   sum_k [M_k - E_k M_k(t_A)] + eta D' = 0,  E_k = exp(-(s - t_A)/tau_k),
!>
!> and the force is what is left of that at t_A,  F = sum_k E_k P_k(t_A).  Unknown are D' and the pace -ds/dtheta.
module rst_restitution_panel
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, point, integral, start_of, integrated, applied, composed, &
                             factors_type, factorize, solution_of, has_converged, keeps_matrix
  use rst_arms, only: solid_type, respond
  use rst_guess, only: guess_restitution
  use rst_panel, only: panel_type, mesh_type, find_angle, mass_factor
  implicit none (type, external)
  private
  public :: rebound

  integer(ip), parameter :: most_iterations = 25

  !> At the points: time of entry of the edge, its radius, D', pace, the sums above over k, and of rate_k times their terms.
  type :: motion_type
    real(dp), dimension(stages) :: entered, radius, v, pace, open, force, kept_rate, force_rate
  end type motion_type

  !> If it is wanted, or kept: how the sum that is zero answers to D' and the pace, D' to the pace, and Newton's matrix for the pace.
  type :: slope_type
    logical :: wanted
    real(dp), dimension(stages, stages) :: by_v, by_pace, pull
    type(factors_type) :: factors
  end type slope_type

contains

  !> The panel mesh%n_panels + 1 from its values at its start, (0), and from known panels as a guess.
  pure subroutine rebound(solid, g, rate, mesh, known, panel, memory, loading, entry, fails)
    type(solid_type), intent(in) :: solid
    real(dp), intent(in) :: g(solid%n_arms), rate(solid%n_arms)
    type(mesh_type), intent(in) :: mesh
    type(panel_type), intent(in) :: known(:)
    type(panel_type), intent(inout) :: panel(mesh%n_panels + 1)
    real(dp), intent(inout) :: memory(0:stages, solid%n_arms, mesh%n_panels + 1)
    real(dp), intent(in) :: loading(0:stages, solid%n_arms, mesh%n_compression)
    real(dp), intent(out) :: entry(stages, solid%n_arms, 2)  !! room: M_k and P_k when the edge went in
    logical, intent(out) :: fails
    type(motion_type) :: m
    type(slope_type) :: slope
    real(dp) :: step_v(stages), step_pace(stages), change, previous, h
    integer(ip) :: i, new
    new = mesh%n_panels + 1
    h = panel(new)%from - panel(new)%to
    call recall(solid, mesh, panel, memory, loading, panel(new), m, entry)
    call guess_restitution(solid, g, rate, known, m%entered, panel(new))
    m%v = panel(new)%velocity(1:)
    m%pace = panel(new)%pace(1:)
    previous = 1
    slope%wanted = .true.
    do i = 1, most_iterations
      call balance(solid, g, rate, h, panel(new)%time(0), memory(:, :, new), entry, m, slope, fails)
      if (.not. fails .and. slope%wanted) call prepare(solid%eta, h, m, slope, fails)
      if (fails) return
      call newton(h, panel(new)%velocity(0), m, slope, step_v, step_pace)
      change = maxval(abs(step_v)) + maxval(abs(step_pace))/maxval(m%pace)
      fails = .not. change < 1.0e6_dp
      if (fails) return
      m%v = m%v + step_v
      if (panel(new)%to > 0) step_pace(stages) = max(step_pace(stages), -0.9_dp*m%pace(stages)) ! at theta = 0 it is 0
      step_pace(:stages - 1) = max(step_pace(:stages - 1), -0.9_dp*m%pace(:stages - 1))
      m%pace = m%pace + step_pace
      if (has_converged(change, previous, mesh%closeness)) exit
      slope%wanted = change > keeps_matrix*previous
      previous = change
    end do
    fails = i > most_iterations
    if (fails) return
    slope%wanted = .false.
    call balance(solid, g, rate, h, panel(new)%time(0), memory(:, :, new), entry, m, slope, fails)
    if (.not. fails) call note(mesh, h, m, panel(new))
    if (.not. fails) fails = .not. all(abs(panel(new)%time) < huge(1.0_dp))
  end subroutine rebound

  !> What the compression left at the angles of the points.
  pure subroutine recall(solid, mesh, panel, memory, loading, new, m, entry)
    type(solid_type), intent(in) :: solid
    type(mesh_type), intent(in) :: mesh
    type(panel_type), intent(in) :: panel(mesh%n_compression), new
    real(dp), intent(in), dimension(0:stages, solid%n_arms, mesh%n_compression) :: memory, loading
    type(motion_type), intent(out) :: m
    real(dp), intent(out) :: entry(stages, solid%n_arms, 2)
    real(dp) :: weight(0:stages)
    integer(ip) :: i, k, p
    do i = 1, stages
      call find_angle(new%from + point(i)*(new%to - new%from), mesh%n_compression, panel, p, weight)
      m%entered(i) = sum(weight*panel(p)%time)
      m%radius(i) = sum(weight*panel(p)%radius)
      do k = 1, solid%n_arms
        entry(i, k, 1) = sum(weight*memory(:, k, p))
        entry(i, k, 2) = sum(weight*loading(:, k, p))
      end do
    end do
  end subroutine recall

  !> The sums at the points for D' and the pace, with memory and, if wanted, how the sum that is zero answers to both.
  pure subroutine balance(solid, g, rate, h, start, memory, entry, m, slope, fails)
    type(solid_type), intent(in) :: solid
    real(dp), intent(in) :: g(solid%n_arms), rate(solid%n_arms), h, start
    real(dp), intent(inout) :: memory(0:stages, solid%n_arms)
    real(dp), intent(in) :: entry(stages, solid%n_arms, 2)
    type(motion_type), intent(inout) :: m
    type(slope_type), intent(inout) :: slope
    logical, intent(out) :: fails
    real(dp) :: kernel(stages, stages), decay(stages), left(stages), since(stages)
    integer(ip) :: k
    since = integrated(start, h*m%pace) - m%entered
    m%open = solid%eta*m%v
    m%force = 0
    m%kept_rate = 0
    m%force_rate = 0
    if (slope%wanted) slope%by_v = 0
    if (slope%wanted) slope%by_pace = 0
    fails = .false.
    do k = 1, solid%n_arms
      call respond(rate(k), h*m%pace, kernel, decay, fails)
      if (fails) return
      memory(1:, k) = decay*memory(0, k) + applied(kernel, g(k)*h*m%pace*m%v)
      left = 1
      if (rate(k) > 0) left = exp(-rate(k)*since)
      m%open = m%open + (memory(1:, k) - left*entry(:, k, 1))
      m%force = m%force + left*entry(:, k, 2)
      m%kept_rate = m%kept_rate + rate(k)*left*entry(:, k, 1)
      m%force_rate = m%force_rate + rate(k)*left*entry(:, k, 2)
      if (slope%wanted) call add_answer(kernel, (g(k)*h)*m%pace, h*(g(k)*m%v - rate(k)*memory(1:, k)), slope)
    end do
  end subroutine balance

  !> How the stress of an arm answers to D' and to the pace.
  pure subroutine add_answer(kernel, to_v, to_pace, slope)
    real(dp), intent(in) :: kernel(stages, stages), to_v(stages), to_pace(stages)
    type(slope_type), intent(inout) :: slope
    integer(ip) :: j
    do j = 1, stages
      slope%by_v(:, j) = slope%by_v(:, j) + kernel(:, j)*to_v(j)
      slope%by_pace(:, j) = slope%by_pace(:, j) + kernel(:, j)*to_pace(j)
    end do
  end subroutine add_answer

  !> Newton's matrix for the pace, from which that of D' follows.
  pure subroutine prepare(eta, h, m, slope, fails)
    real(dp), intent(in) :: eta, h
    type(motion_type), intent(in) :: m
    type(slope_type), intent(inout) :: slope
    logical, intent(out) :: fails
    real(dp) :: faded(stages, stages)
    integer(ip) :: j
    do j = 1, stages
      slope%by_v(j, j) = slope%by_v(j, j) + eta
      slope%by_pace(:, j) = slope%by_pace(:, j) + m%kept_rate*(h*integral(:, j))
      faded(:, j) = (m%pace*m%force_rate)*(h*integral(:, j))
      faded(j, j) = faded(j, j) - m%force(j)
    end do
    slope%pull = (mass_factor*h)*composed(integral, faded)
    call factorize(slope%by_pace + composed(slope%by_v, slope%pull), slope%factors, fails)
  end subroutine prepare

  !> Newton's step: that of D' follows from that of the pace.
  pure subroutine newton(h, start, m, slope, step_v, step_pace)
    real(dp), intent(in) :: h, start
    type(motion_type), intent(in) :: m
    type(slope_type), intent(in) :: slope
    real(dp), intent(out) :: step_v(stages), step_pace(stages)
    real(dp) :: miss(stages)
    miss = integrated(start, -mass_factor*h*m%pace*m%force) - m%v
    step_pace = solution_of(slope%factors, -m%open - applied(slope%by_v, miss))
    step_v = miss + applied(slope%pull, step_pace)
  end subroutine newton

  pure subroutine note(mesh, h, m, panel)
    type(mesh_type), intent(in) :: mesh
    real(dp), intent(in) :: h
    type(motion_type), intent(in) :: m
    type(panel_type), intent(inout) :: panel
    panel%velocity(1:) = m%v
    panel%force(1:) = m%force
    panel%pace(1:) = m%pace
    if (mesh%n_panels == mesh%n_compression) panel%pace(0) = start_of(m%pace)
    panel%time(1:) = integrated(panel%time(0), h*m%pace)
    panel%radius(1:) = m%radius
    panel%depth(1:) = integrated(panel%depth(0), h*m%pace*m%v)
  end subroutine note
end module rst_restitution_panel
