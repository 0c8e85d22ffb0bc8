!> The restitution on one panel (docs/sync.md): the edge goes back over the angles of the
!> compression. When it is again at the radius that it had at the time t_A of the compression it is
!> free,
!>
!>   sum_k [M_k - E_k M_k(t_A)] + eta D' = 0,  E_k = exp(-(s - t_A)/tau_k),
!>
!> and the force is what is fade of that at t_A,  F = sum_k E_k P_k(t_A).  Unknown are D' and the
!> pace -ds/dtheta.
module rst_restitution_panel
  use rst_precision, only: dp, ip
  use rst_motion_factors, only: mass_factor
  use rst_collocation, only: stages, point, integral, start_of, integrated, applied, composed, &
                             factors_type, factorize, solution_of, has_converged
  use rst_arms, only: respond
  use rst_tuning, only: keeps_matrix, largest_decrease, diverges_above, most_steps
  use rst_guess, only: guess_restitution
  use rst_panel, only: panel_type, normal_type, find_angle
  implicit none (type, external)
  private
  public :: rebound

  !> The time at the start of the panel. At the points: t_A, A, D', pace, f(A), F, and how fast both
  !> would fade, the sums of rate_k times what E_k multiplies in them.
  type :: motion_type
    real(dp) :: start
    real(dp), dimension(stages) :: entered, radius, v, pace, edge_stress, force, fading_stress, fading_force
  end type motion_type

  !> If it is wanted, or kept: how the sum that is zero answers to D' and the pace, D' to the pace,
  !> Newton's matrix for the pace.
  type :: slope_type
    logical :: wanted
    real(dp), dimension(stages, stages) :: by_v, by_pace, v_by_pace
    type(factors_type) :: factors
  end type slope_type

contains

  !> The panel after those there are, from its values at its start, (0), and from known panels as a
  !> guess.
  subroutine rebound(normal, known, fails)
    type(normal_type), intent(in) :: normal
    type(panel_type), intent(in) :: known(:)
    logical, intent(out) :: fails
    type(motion_type) :: m
    type(slope_type) :: slope
    real(dp) :: step_v(stages), step_pace(stages), change, previous, width
    real(dp), pointer, contiguous :: memory(:, :), kernel(:, :, :), entry(:, :, :) ! compilers would copy components
    integer(ip) :: i, n
    n = normal%n_panels + 1
    memory(0:, 1:) => normal%memory(:, :, n)
    kernel(1:, 0:, 1:) => normal%kernel(:, :, :, n)
    entry => normal%entry
    associate (panel => normal%panel(n))
      width = panel%from - panel%to
      call recall(normal, panel, m)
      call guess_restitution(normal, known, m%entered, panel)
      m%v = panel%velocity(1:)
      m%pace = panel%pace(1:)
      previous = 1
      slope%wanted = .true.
      do i = 1, most_steps
        call balance(normal%eta, normal%g, normal%rate, width, memory, kernel, entry, m, slope, fails)
        if (.not. fails .and. slope%wanted) call prepare(normal%eta, width, m, slope, fails)
        if (fails) return
        call newton(width, panel%velocity(0), m, slope, step_v, step_pace)
        change = maxval(abs(step_v)) + maxval(abs(step_pace))/maxval(m%pace)
        fails = .not. change < diverges_above
        if (fails) return
        m%v = m%v + step_v
        if (panel%to > 0) step_pace(stages) = max(step_pace(stages), -largest_decrease*m%pace(stages)) ! at theta = 0 it is 0
        step_pace(:stages - 1) = max(step_pace(:stages - 1), -largest_decrease*m%pace(:stages - 1))
        m%pace = m%pace + step_pace
        if (has_converged(change, previous, normal%closeness)) exit
        slope%wanted = change > keeps_matrix*previous
        previous = change
      end do
      fails = i > most_steps
      if (fails) return
      slope%wanted = .false.
      call balance(normal%eta, normal%g, normal%rate, width, memory, kernel, entry, m, slope, fails)
      if (fails) return
      call note(n == normal%n_compression + 1, width, m, panel)
      fails = .not. all(abs(panel%time) < huge(1.0_dp))
    end associate
  end subroutine rebound

  !> What the compression fade at the angles of the points.
  subroutine recall(normal, new, m)
    type(normal_type), intent(in) :: normal
    type(panel_type), intent(in) :: new
    type(motion_type), intent(out) :: m
    type(panel_type), pointer, contiguous :: panel(:)
    real(dp) :: weight(0:stages)
    integer(ip) :: i, k, p
    panel => normal%panel
    m%start = new%time(0)
    do i = 1, stages
      call find_angle(new%from + point(i)*(new%to - new%from), normal%n_compression, panel, p, weight)
      m%entered(i) = sum(weight*panel(p)%time)
      m%radius(i) = sum(weight*panel(p)%radius)
      do k = 1, normal%n_arms
        normal%entry(i, k, 1) = sum(weight*normal%memory(:, k, p))
        normal%entry(i, k, 2) = sum(weight*normal%loading(:, k, p))
      end do
    end do
  end subroutine recall

  !> The sums at the points for D' and the pace, with memory and, if wanted, how the sum that is
  !> zero answers to both.
  pure subroutine balance(eta, g, rate, width, memory, kernel, entry, m, slope, fails)
    real(dp), intent(in) :: eta, g(:), rate(:), width
    real(dp), intent(inout) :: memory(0:stages, size(g)), kernel(stages, 0:stages, size(g))
    real(dp), intent(in) :: entry(stages, size(g), 2)
    type(motion_type), intent(inout) :: m
    type(slope_type), intent(inout) :: slope
    logical, intent(out) :: fails
    real(dp) :: fade(stages), span(stages), since(stages)
    integer(ip) :: k
    span = width*m%pace
    since = integrated(m%start, span) - m%entered
    m%edge_stress = eta*m%v
    m%force = 0
    m%fading_stress = 0
    m%fading_force = 0
    if (slope%wanted) slope%by_v = 0
    if (slope%wanted) slope%by_pace = 0
    fails = .false.
    do k = 1, size(g, kind=ip)
      call respond(rate(k), span, kernel(:, :, k), fails)
      if (fails) return
      memory(1:, k) = kernel(:, 0, k)*memory(0, k) + applied(kernel(:, 1:, k), g(k)*span*m%v)
      fade = 1
      if (rate(k) > 0) fade = exp(-rate(k)*since)
      m%edge_stress = m%edge_stress + (memory(1:, k) - fade*entry(:, k, 1))
      m%force = m%force + fade*entry(:, k, 2)
      m%fading_stress = m%fading_stress + rate(k)*fade*entry(:, k, 1)
      m%fading_force = m%fading_force + rate(k)*fade*entry(:, k, 2)
      if (slope%wanted) &
        call add_answer(kernel(:, 1:, k), g(k)*span, width*(g(k)*m%v - rate(k)*memory(1:, k)), slope)
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
  pure subroutine prepare(eta, width, m, slope, fails)
    real(dp), intent(in) :: eta, width
    type(motion_type), intent(in) :: m
    type(slope_type), intent(inout) :: slope
    logical, intent(out) :: fails
    real(dp) :: faded(stages, stages)
    integer(ip) :: j
    do j = 1, stages
      slope%by_v(j, j) = slope%by_v(j, j) + eta
      slope%by_pace(:, j) = slope%by_pace(:, j) + m%fading_stress*(width*integral(:, j))
      faded(:, j) = (m%pace*m%fading_force)*(width*integral(:, j))
      faded(j, j) = faded(j, j) - m%force(j)
    end do
    slope%v_by_pace = (mass_factor*width)*composed(integral, faded)
    call factorize(slope%by_pace + composed(slope%by_v, slope%v_by_pace), slope%factors, fails)
  end subroutine prepare

  !> Newton's step: that of D' follows from that of the pace.
  pure subroutine newton(width, start, m, slope, step_v, step_pace)
    real(dp), intent(in) :: width, start
    type(motion_type), intent(in) :: m
    type(slope_type), intent(in) :: slope
    real(dp), intent(out) :: step_v(stages), step_pace(stages)
    real(dp) :: miss(stages)
    miss = integrated(start, -mass_factor*width*m%pace*m%force) - m%v
    step_pace = solution_of(slope%factors, -m%edge_stress - applied(slope%by_v, miss))
    step_v = miss + applied(slope%v_by_pace, step_pace)
  end subroutine newton

  pure subroutine note(is_first, width, m, panel)
    logical, intent(in) :: is_first
    real(dp), intent(in) :: width
    type(motion_type), intent(in) :: m
    type(panel_type), intent(inout) :: panel
    panel%velocity(1:) = m%v
    panel%force(1:) = m%force
    panel%pace(1:) = m%pace
    if (is_first) panel%pace(0) = start_of(m%pace)
    panel%time(1:) = integrated(panel%time(0), width*m%pace)
    panel%radius(1:) = m%radius
    panel%depth(1:) = integrated(panel%depth(0), width*m%pace*m%v)
  end subroutine note
end module rst_restitution_panel
