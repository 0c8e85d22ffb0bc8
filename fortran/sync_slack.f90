!> The slack of the method `sync` behind its front (module rst_sync_front): sums over the nodes that stick, y at those beside the
!> front, and how they change as the front passes a node or slip turns round.
module rst_sync_slack
  use rst_precision, only: dp, ip
  use rst_sync_levels, only: level_type, node_type
  use rst_sync_dense, only: trace_type
  use rst_sync_elements, only: scene_type, term_type
  use rst_sync_edge, only: weight_of
  use rst_sync_point, only: point_type, slack_at
  use rst_sync_hinge, only: beyond_edge
  implicit none (type, external)
  private
  public :: add_up, speak_of_slack, unseen_force, slacks, pass_node, turn_round

contains

  !> Sums over the nodes that stick; age: of the node `last`, front or front + 1.
  pure subroutine add_up(m, last, trace, node, alpha, beta, p, term)
    integer(ip), intent(in) :: m, last
    type(trace_type), intent(in) :: trace(m, 0:last)
    type(node_type), intent(in) :: node(0:last)
    real(dp), intent(in) :: alpha(0:last), beta(m, 0:last)
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    real(dp) :: weight, age
    integer(ip) :: i, k
    p%weight = 0
    p%alpha = 0
    do i = 0, p%front
      weight = weight_of(node, i)
      p%weight = p%weight + weight
      p%alpha = p%alpha + weight*alpha(i)
    end do
    do k = 1, m
      age = term(k)%age
      term(k)%beta_sum = 0
      do i = last, 0, -1
        if (i <= p%front) term(k)%beta_sum = term(k)%beta_sum + weight_of(node, i)*age*beta(k, i)
        age = age*trace(k, i)%decay
      end do
    end do
  end subroutine add_up

  !> From now on alpha and beta are those of the slack, for the side given; nodes 0 to last have been touched.
  pure subroutine speak_of_slack(m, last, scene, trace, node, alpha, beta, p, term)
    integer(ip), intent(in) :: m, last
    type(scene_type), intent(in) :: scene
    type(trace_type), intent(in) :: trace(m, 0:last)
    type(node_type), intent(in) :: node(0:last)
    real(dp), intent(inout) :: alpha(0:last), beta(m, 0:last)
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    integer(ip) :: i, k
    do i = 0, last
      alpha(i) = scene%g_inf*node(i)%radius**2 + p%side*alpha(i)
      do k = 1, m
        beta(k, i) = trace(k, i)%memory + p%side*beta(k, i)
      end do
    end do
    call add_up(m, last, trace, node, alpha, beta, p, term)
    p%onset = p%level
    p%slack = slack_at(m, scene, p, term)
    p%slack_before = 0
  end subroutine speak_of_slack

  !> What the sum over nodes, with what `beyond` adds in the last cell, lacks of int f dX in the restitution. Where the slipping
  !> ring is thin, y is f but for a little and its integral lacks as much, which is not little beside S. Not so in the compression:
  !> behind an edge that slips f may rise within a layer thinner than a cell, but y is nothing there.
  pure function unseen_force(m, edge, scene, end, fade, trace, node) result(unseen)
    integer(ip), intent(in) :: m, edge
    type(scene_type), intent(in) :: scene
    type(level_type), intent(in) :: end
    type(trace_type), intent(in) :: fade(m), trace(m, 0:edge)
    type(node_type), intent(in) :: node(0:edge)
    real(dp) :: unseen, f(-2:1), age
    integer(ip) :: j, k, inmost
    if (edge > 2) then ! most levels, without branches
      f(-2:0) = end%fresh - scene%g_inf*node(edge - 3:edge - 1)%radius**2
      do k = 1, m
        age = fade(k)%fade*trace(k, edge)%decay
        f(0) = f(0) - age*trace(k, edge - 1)%memory
        age = age*trace(k, edge - 1)%decay
        f(-1) = f(-1) - age*trace(k, edge - 2)%memory
        age = age*trace(k, edge - 2)%decay
        f(-2) = f(-2) - age*trace(k, edge - 3)%memory
      end do
    else
      inmost = 1 - edge
      f = end%fresh
      do j = 0, inmost, -1
        f(j) = end%fresh - scene%g_inf*node(edge - 1 + j)%radius**2
      end do
      do k = 1, m
        age = fade(k)%fade
        do j = 0, inmost, -1
          age = age*trace(k, edge + j)%decay
          f(j) = f(j) - age*trace(k, edge - 1 + j)%memory
        end do
      end do
      if (edge == 2) f(-2) = f(0)
    end if
    f(1) = 0
    if (edge == 1) f(-1) = f(1)
    unseen = end%missing - beyond_edge(edge - 1, node, f)
  end function unseen_force

  !> y of the nodes front - 2 to front + 1; the latter may just be touched. `slack`: y at the centre, about which y is even.
  pure subroutine slacks(m, touched, at_edge, edge, trace, alpha, beta, slack, p, term, y)
    integer(ip), intent(in) :: m, edge
    logical, intent(in) :: touched
    type(trace_type), intent(in) :: trace(m, 0:edge)
    real(dp), intent(in) :: at_edge, slack, alpha(0:edge), beta(m, 0:edge)
    type(point_type), intent(in) :: p
    type(term_type), intent(in) :: term(m)
    real(dp), intent(out) :: y(-2:1)
    real(dp) :: age
    integer(ip) :: j, k, f
    f = p%front
    if (f >= 2 .and. .not. touched) then ! most nodes, without branches
      y = alpha(f - 2:f + 1)
      do k = 1, m
        age = term(k)%age
        y(1) = y(1) + age*beta(k, f + 1)
        age = age*trace(k, f + 1)%decay
        y(0) = y(0) + age*beta(k, f)
        age = age*trace(k, f)%decay
        y(-1) = y(-1) + age*beta(k, f - 1)
        age = age*trace(k, f - 1)%decay
        y(-2) = y(-2) + age*beta(k, f - 2)
      end do
      y = slack - y ! last: what the step waits for
      return
    end if
    y = slack
    do j = 1, max(-2_ip, -f), -1
      if (j < 1 .or. .not. touched) y(j) = slack - alpha(f + j)
    end do
    do k = 1, m
      age = term(k)%age
      do j = 1, max(-2_ip, -f), -1
        if (j < 1 .or. .not. touched) y(j) = y(j) - age*beta(k, f + j)
        if (f + j > 0) age = age*trace(k, f + j)%decay
      end do
    end do
    if (touched) y(1) = at_edge
    if (f == 1) y(-2) = y(0)
    if (f == 0) y(-1) = y(1)
  end subroutine slacks

  !> The outermost node that sticks slips from now on, or leaves the contact.
  pure subroutine pass_node(m, node, trace, alpha, beta, p, term)
    integer(ip), intent(in) :: m
    type(node_type), intent(in) :: node(0:*)
    type(trace_type), intent(in) :: trace(m, 0:*)
    real(dp), intent(in) :: alpha(0:*), beta(m, 0:*)
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    real(dp) :: weight
    integer(ip) :: k
    weight = weight_of(node, p%front)
    p%weight = p%weight - weight
    p%alpha = p%alpha - weight*alpha(p%front)
    do k = 1, m
      term(k)%age = term(k)%age*trace(k, p%front + 1)%decay
      term(k)%beta_sum = term(k)%beta_sum - weight*term(k)%age*beta(k, p%front)
    end do
    p%front = p%front - 1
  end subroutine pass_node

  !> The other side. The slack f - d q has 2 G_inf X^2 and 2 M_k less what was alpha and beta.
  pure subroutine turn_round(m, edge, scene, trace, node, alpha, beta, p, term)
    integer(ip), intent(in) :: m, edge
    type(scene_type), intent(in) :: scene
    type(trace_type), intent(in) :: trace(m, 0:edge)
    type(node_type), intent(in) :: node(0:edge)
    real(dp), intent(inout) :: alpha(0:edge), beta(m, 0:edge)
    type(point_type), intent(inout) :: p
    type(term_type), intent(inout) :: term(m)
    integer(ip) :: i, k
    do i = 0, edge
      alpha(i) = 2*scene%g_inf*node(i)%radius**2 - alpha(i)
      do k = 1, m
        beta(k, i) = 2*trace(k, i)%memory - beta(k, i)
      end do
    end do
    p%side = -p%side
    p%onset = p%level
    p%turned = p%turned + 1
    call add_up(m, edge, trace, node, alpha, beta, p, term)
    p%slack = 2*p%fresh - p%slack
    p%slack_before = 0
  end subroutine turn_round
end module rst_sync_slack
