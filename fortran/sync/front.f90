!> The front of slip (docs/sync.md): the stick radius c as the edge of the corrective contact.
!>
!> With the side d = 1 or -1 of the slip, the slack y = f - d q of an element that has stuck since the edge reached it at the time t_X is
!> that of a contact with the velocity r = D' - d U' in place of D':
!>
!>   y(X) = sum_k [m_k - E_k m_k(t_X)] + eta r,  m_k = M_k - d M_k^x,  E_k = exp(-(s - t_X)/tau_k)
!>
!> It is zero at c, and the slack force is H = int_0^c y dX = sum_k E_k p_k(t_c), p_k = P_k - d P_k^x.
module rst_front
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, weights_at
  use rst_contact_views, only: normal_type, store_type
  implicit none (type, external)
  private
  public :: slack_type, find_front, held_by

  !> At the instant `time`: the front, its radius, H, and y at the centre and at the edge of what has been recorded.
  type :: slack_type
    real(dp) :: angle, radius, force, centre, edge
  end type slack_type

  integer(ip), parameter :: most_iterations = 60
  real(dp), parameter :: rounding = 4*epsilon(1.0_dp)
  !> Part of the slack at the centre that is left at the front: H, which is largest there, is off by its square.
  real(dp), parameter :: at_front = 1.0e-7_dp

contains

  !> The front among the elements up to the angle `edge`. The arms of now_z and now_x at the point i of the piece are the m_k; slip: r.
  !> Where even the element at the edge has slack, the radius is that of the edge, and H its continuation, as if all stuck.
  pure subroutine find_front(normal, store, i, time, side, slip, edge, slack)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    integer(ip), intent(in) :: i
    real(dp), intent(in) :: time, side, slip, edge
    type(slack_type), intent(inout) :: slack  !! angle: where to begin the search
    real(dp) :: low, high, y, slope, theta, start, force, radius
    integer(ip) :: n, record
    record = store%n_records
    slack%centre = normal%eta*slip + sum(store%now_z(i, :) - side*store%now_x(i, :))
    call look_at(normal, store, i, time, side, edge, record, y, slope, radius, force)
    slack%edge = y + normal%eta*slip
    start = slack%angle
    slack%angle = 0
    slack%radius = 0
    slack%force = 0
    if (slack%centre <= 0) return
    if (slack%edge >= 0) then
      slack%angle = edge
      slack%radius = radius
      slack%force = force + radius*slack%edge
      return
    end if
    low = 0
    high = edge
    theta = start
    if (.not. (theta > low .and. theta < high)) theta = 0.5_dp*(low + high)
    do n = 1, most_iterations
      call look_at(normal, store, i, time, side, theta, record, y, slope, radius, force)
      y = y + normal%eta*slip
      if (y > 0) low = theta
      if (y <= 0) high = theta
      if (abs(y) <= at_front*slack%centre .or. high - low <= rounding*edge) exit
      if (slope < 0) then
        theta = theta - y/slope
      else
        theta = low
      end if
      if (.not. (theta > low .and. theta < high)) theta = 0.5_dp*(low + high)
    end do
    slack%angle = theta
    slack%radius = radius
    slack%force = force + radius*y
  end subroutine find_front

  !> Without slip: what the force of the contact lacks of A q, q by the arms' memory alone, for an edge at the angle theta.
  pure function held_by(normal, store, time, theta) result(held)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: time, theta
    real(dp) :: held, weight(0:stages), radius, entered
    integer(ip) :: k, record
    record = store%n_records
    call find_record(store, theta, record, weight)
    radius = sum(weight*store%record(record)%radius)
    entered = sum(weight*store%record(record)%time)
    held = 0
    do k = 1, normal%n_arms
      held = held + exp(-normal%rate(k)*(time - entered)) &
             *(sum(weight*store%lx(:, k, record)) - radius*sum(weight*store%mx(:, k, record)))
    end do
  end function held_by

  !> The record in which an angle is, and the weights of its points.
  pure subroutine find_record(store, theta, record, weight)
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: theta
    integer(ip), intent(inout) :: record  !! where to begin the search
    real(dp), intent(out) :: weight(0:stages)
    do while (record > 1 .and. theta < store%record(record)%from)
      record = record - 1
    end do
    do while (record < store%n_records .and. theta > store%record(record)%to)
      record = record + 1
    end do
    associate (r => store%record(record))
      weight = weights_at((theta - r%from)/(r%end - r%from))
    end associate
  end subroutine find_record

  !> y without the dashpot for the element that the edge reached at the angle theta, its slope over theta,
  !> -r ds/dtheta sum_k g_k E_k, its radius, and sum_k E_k p_k.
  pure subroutine look_at(normal, store, i, time, side, theta, record, y, slope, radius, force)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    integer(ip), intent(in) :: i
    real(dp), intent(in) :: time, side, theta
    integer(ip), intent(inout) :: record
    real(dp), intent(out) :: y, slope, radius, force
    real(dp) :: weight(0:stages), entered, left, fade
    integer(ip) :: k
    call find_record(store, theta, record, weight)
    associate (r => store%record(record))
      radius = sum(weight*r%radius)
      entered = sum(weight*r%time)
      slope = -sum(weight*(r%sink - side*r%shear))
    end associate
    y = 0
    force = 0
    left = 0
    do k = 1, normal%n_arms
      fade = 1
      if (normal%rate(k) > 0) fade = exp(-normal%rate(k)*(time - entered))
      y = y + ((store%now_z(i, k) - side*store%now_x(i, k)) &
               - fade*sum(weight*(store%mz(:, k, record) - side*store%mx(:, k, record))))
      force = force + fade*sum(weight*(store%lz(:, k, record) - side*store%lx(:, k, record)))
      left = left + normal%g(k)*fade
    end do
    slope = slope*left
  end subroutine look_at
end module rst_front
