!> The element that slipped last behind the front of the method `sync` (module rst_sync_front): as long as it goes on slipping, all
!> do.
module rst_sync_sentinel
  use rst_precision, only: dp, ip
  use rst_sync_elements, only: scene_type, term_type
  use rst_sync_point, only: point_type, span_type
  implicit none (type, external)
  private
  public :: guard_type, step_guard, slips_on

  real(dp), parameter :: unknown = 1.0e100_dp !! lag, of what has just begun to slip

  !> The sentinel: its alpha, its slip velocity and by how much that lagged behind the others' a step before; how far its slip
  !> velocity may be off since it began within a step; node -1: none.
  type :: guard_type
    real(dp) :: alpha = 0, kappa = 0, lag = unknown, doubt = 0
    integer(ip) :: node = -1
  end type guard_type

contains

  !> The sentinel in the step: the node that the front passed last, from where it stuck, or the one before.
  pure subroutine step_guard(m, scene, span, passed, edge, sinking, slack, alpha, beta, p, term, guard, holds)
    integer(ip), intent(in) :: m, edge
    type(scene_type), intent(in) :: scene
    type(span_type), intent(in) :: span
    logical, intent(in) :: passed
    real(dp), intent(in) :: sinking, slack, alpha(0:*), beta(m, 0:*)  !! sinking: D' at the end of the step
    type(point_type), intent(in) :: p
    type(term_type), intent(inout) :: term(m)
    type(guard_type), intent(inout) :: guard
    logical, intent(out) :: holds
    real(dp) :: y, slip, kept, keep
    integer(ip) :: k
    holds = .true.
    if (passed) then
      guard = guard_type(alpha=alpha(p%front + 1), node=p%front + 1)
      guard%doubt = abs((1 - 2*scene%chi)*(sinking - p%sinking))/2
      do k = 1, m
        term(k)%faded_sum = term(k)%age*beta(k, guard%node)
      end do
    else if (guard%node < 0 .or. guard%node >= edge) then
      return
    else
      guard%lag = guard%kappa - slip_of_others(p)
      do k = 1, m
        term(k)%faded_sum = term(k)%decay*term(k)%faded_sum
      end do
    end if
    keep = 1 - span%drop
    y = slack - guard%alpha - span%start_response*keep*guard%kappa
    do k = 1, m
      y = y - term(k)%faded_sum
    end do
    holds = y <= 0
    slip = y/(span%end_response + span%drop*span%start_response)
    if (p%front < 0 .and. .not. passed) holds = holds .and. slip <= -guard%doubt
    kept = keep*guard%kappa + span%drop*slip
    guard%alpha = guard%alpha + scene%g_inf*span%h/2*(kept + slip)
    guard%kappa = slip
    do k = 1, m
      term(k)%faded_sum = term(k)%faded_sum + term(k)%from_start*kept + term(k)%from_end*slip
    end do
  end subroutine step_guard

  !> Whether all slips to the end, even if the sentinel's lag, which grows by a tenth or so, doubled. A sentinel that began to slip
  !> within a step lags too much and too little in turns, so the larger of two counts.
  pure function slips_on(scene, velocity, p, guard) result(yes)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: velocity  !! D' at the end
    type(point_type), intent(in) :: p
    type(guard_type), intent(in) :: guard
    logical :: yes
    real(dp) :: now, last
    now = slip_of_others(p)
    last = now + (1 - 2*scene%chi)*(velocity - p%sinking)
    yes = max(now, last) + 2*max(0.0_dp, guard%lag, guard%kappa - now) + guard%doubt <= 0
  end function slips_on

  !> The slip velocity of all others, over d; it changes with D' alone.
  pure function slip_of_others(p) result(slip)
    type(point_type), intent(in) :: p
    real(dp) :: slip
    slip = p%side*p%velocity + p%sinking
  end function slip_of_others
end module rst_sync_sentinel
