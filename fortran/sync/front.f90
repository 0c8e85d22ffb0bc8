!> The front of slip (docs/sync.md): the stick radius c as the edge of the corrective contact.
!>
!> With the side d = 1 or -1 of the slip, the slack y = f - d q of an element that has stuck since the edge reached it at the time
!> t_X is that of a contact with the velocity v_d = D' - d U' in place of D':
!>
!>   y(X) = sum_k [m_k - E_k m_k(t_X)] + eta v_d,  m_k = M_k - d M_k^x,  E_k = exp(-(s - t_X)/tau_k)
!>
!> It is zero at c, and the slack force is H = int_0^c y dX = sum_k E_k p_k(t_c), p_k = P_k - d P_k^x.
module rst_front
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, weights_at
  use rst_panel, only: normal_type
  use rst_store, only: store_type, of_edge, of_arm
  implicit none (type, external)
  private
  public :: element_type, slack_type, look_at, find_front, held_by

  !> An element that has stuck since the edge was at an angle theta: its radius X, the slack that it had taken on when it was
  !> touched, sum_k E_k m_k(t_X), sum_k E_k p_k(t_X), the slope of y over theta, and dX/dtheta.
  type :: element_type
    real(dp) :: radius, taken, force, slope, stretch
  end type element_type

  !> At an instant: the front, its radius, H, and y at the centre and at the edge of what has been recorded. near: part e of the
  !> slack at the centre, or of what the edge lacks if that is less, at which a search may end. Near its end y is linear in X: H is
  !> then off by about e^3, and the front by e^2.
  type :: slack_type
    real(dp) :: near, angle, radius, force, centre, edge
  end type slack_type

  integer(ip), parameter :: most_iterations = 60
  real(dp), parameter :: rounding = 4*epsilon(1.0_dp)
  real(dp), parameter :: faded = 50 !! exp(-faded) is below rounding; beyond 708 it underflows, which is slow

contains

  !> The front among the elements up to the one at the edge. slack%near and slack%centre are given, and slack%angle, where to
  !> begin the search.
  !> Where even the element at the edge has slack, the radius is that of the edge, and H its continuation,
  !> as if all stuck.
  subroutine find_front(normal, store, time, side, edge_angle, edge, slack)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: time, side, edge_angle
    type(element_type), intent(in) :: edge
    type(slack_type), intent(inout) :: slack
    type(element_type) :: element
    real(dp) :: low, high, y, theta, enough
    integer(ip) :: n
    slack%edge = slack%centre - edge%taken
    theta = slack%angle
    slack%angle = 0
    slack%radius = 0
    slack%force = 0
    if (slack%centre <= 0) return
    if (slack%edge >= 0) then
      slack%angle = edge_angle
      slack%radius = edge%radius
      slack%force = edge%force + edge%radius*slack%edge
      return
    end if
    enough = min(slack%centre, -slack%edge)*slack%near
    low = 0
    high = edge_angle
    if (.not. (theta > low .and. theta < high)) theta = 0.5_dp*(low + high)
    do n = 1, most_iterations
      call look_at(normal, store, time, side, theta, element)
      y = slack%centre - element%taken
      if (y > 0) low = theta
      if (y <= 0) high = theta
      if (abs(y) <= enough .or. high - low <= rounding*edge_angle) exit
      if (element%slope < 0) then
        theta = theta - y/element%slope
      else
        theta = low
      end if
      if (.not. (theta > low .and. theta < high)) theta = 0.5_dp*(low + high)
    end do
    slack%angle = theta
    slack%radius = element%radius
    slack%force = element%force + element%radius*y
    if (element%slope < 0) call go_on(element, y, slack)
  end subroutine find_front

  !> From an element with little slack y to the front, with y linear in between.
  pure subroutine go_on(element, y, slack)
    type(element_type), intent(in) :: element
    real(dp), intent(in) :: y
    type(slack_type), intent(inout) :: slack
    real(dp) :: further
    further = -y/element%slope*element%stretch
    slack%angle = slack%angle - y/element%slope
    slack%radius = slack%radius + further
    slack%force = slack%force + 0.5_dp*y*further
  end subroutine go_on

  !> Without slip: what the force of the contact lacks of A q, q by the arms' memory alone, for an edge at the angle theta.
  function held_by(normal, store, time, theta) result(held)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: time, theta
    real(dp) :: held, weight(0:stages), edge(of_edge), both(of_arm), arm(2)
    integer(ip) :: k, record
    call find_record(store, theta, record, weight)
    edge = between(weight, store%record(record)%edge)
    held = 0
    do k = 1, normal%n_arms
      both = held_between(weight, store%held, k, record)
      arm = 0.5_dp*(both(3:) - both(:2))
      held = held + exp(-normal%rate(k)*(time - edge(2)))*(arm(2) - edge(1)*arm(1))
    end do
  end function held_by

  !> The record in which an angle is, and the weights of its points.
  pure subroutine find_record(store, theta, record, weight)
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: theta
    integer(ip), intent(out) :: record
    real(dp), intent(out) :: weight(0:stages)
    integer(ip) :: last, middle
    record = 1
    last = store%n_records
    do while (record < last)
      middle = (record + last + 1)/2
      if (theta < store%record(middle)%from) last = middle - 1
      if (theta >= store%record(middle)%from) record = middle
    end do
    associate (r => store%record(record))
      weight = weights_at((theta - r%from)/(r%end - r%from))
    end associate
  end subroutine find_record

  !> The element that the edge reached at the angle theta. By A^2 = D the edge moves by dX/dtheta = D' (ds/dtheta)/(2 X), and
  !> dy/dtheta = -v_d ds/dtheta sum_k g_k E_k.
  subroutine look_at(normal, store, time, side, theta, element)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: time, side, theta
    type(element_type), intent(out) :: element
    real(dp) :: weight(0:stages), edge(of_edge), both(of_arm), arm(2), ago, fade, answer
    integer(ip) :: k, record
    call find_record(store, theta, record, weight)
    edge = between(weight, store%record(record)%edge)
    ago = time - edge(2)
    element%taken = 0
    element%force = 0
    answer = 0
    do k = 1, normal%n_arms
      if (normal%rate(k)*ago > faded) cycle
      fade = 1
      if (normal%rate(k) > 0) fade = exp(-normal%rate(k)*ago)
      both = held_between(weight, store%held, k, record)
      arm = merge(both(:2), both(3:), side > 0)
      element%taken = element%taken + fade*arm(1)
      element%force = element%force + fade*arm(2)
      answer = answer + normal%g(k)*fade
    end do
    element%radius = edge(1)
    element%slope = -(edge(3) - side*edge(4))*answer
    element%stretch = 0
    if (element%radius > 0) element%stretch = edge(3)/(2*element%radius)
  end subroutine look_at

  !> Values of an element or of an arm, known at the points of a record, in between. (Sums that are written out stay in
  !> registers. There are as many values of both kinds.)
  pure function between(weight, at) result(values)
    real(dp), intent(in) :: weight(0:stages), at(of_edge, 0:stages)
    real(dp) :: values(of_edge)
    values = weight(0)*at(:, 0) + weight(1)*at(:, 1) + weight(2)*at(:, 2) + weight(3)*at(:, 3) + weight(4)*at(:, 4) &
             + weight(5)*at(:, 5) + weight(6)*at(:, 6)
  end function between

  !> m_k and p_k of an arm for d = 1 and for d = -1. (As a pointer, since compilers would copy parts of a component.)
  function held_between(weight, held, arm, record) result(values)
    real(dp), intent(in) :: weight(0:stages)
    real(dp), pointer, contiguous, intent(in) :: held(:, :, :, :)
    integer(ip), intent(in) :: arm, record
    real(dp) :: values(of_arm)
    values = between(weight, held(:, :, arm, record))
  end function held_between
end module rst_front
