!> The front of slip (docs/sync.md): the stick radius c as the edge of the corrective contact.
!>
!> With the sense sigma = 1 or -1 of the slip, the stick margin y = f - sigma q of an element that
!> has stuck since the edge reached it, at the time t_X, is that of a contact with the velocity
!> v_sigma in place of D' (s12). With m_k = M_k - sigma M_k^x and E_k = exp(-(s - t_X)/tau_k),
!>
!>   y(X) = sum_k [m_k - E_k m_k(t_X)] + eta v_sigma,  v_sigma = D' - sigma U'
!>
!> It is zero at c, and its integral is H = int_0^c y dX = sum_k E_k p_k(t_c) (s13), with p_k = P_k
!> - sigma P_k^x. For sigma = 1 elements that were touched in gross slip have the same y.
module rst_front
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, weights_at
  use rst_panel, only: normal_type
  use rst_tuning, only: most_trials, search_rounding, faded
  use rst_store, only: store_type, of_touch, of_arm, sticks
  implicit none (type, external)
  private
  public :: element_type, margin_type, element_at, find_front, memory_force_at

  !> An element that has stuck since the edge was at an angle theta: its distance X from the centre;
  !> what its stick margin lacks of that at the centre, sum_k E_k m_k(t_X); sum_k E_k p_k(t_X); the
  !> slope of y over theta; dX/dtheta.
  type :: element_type
    real(dp) :: distance, deficit, loading, slope, stretch
  end type element_type

  !> At an instant: the angle of the front, its radius c, H, and y at the centre and in the
  !> outermost element. accuracy: part e of y at the centre, or of what the outermost element lacks
  !> if that is less, at which a search may end. Near its end y is linear in X: H is then off by
  !> about e^3, and the front by e^2.
  type :: margin_type
    real(dp) :: accuracy, angle, stick_radius, force, at_centre, at_edge
  end type margin_type

contains

  !> The front among the elements up to the outermost one. margin%accuracy and margin%at_centre are
  !> given, and margin%angle, where to begin the search. Where even the outermost element has y > 0,
  !> the front is there, and H is continued as if all stuck.
  subroutine find_front(normal, store, time, sense, outermost_angle, outermost, margin)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: time, outermost_angle
    integer(kind(sticks)), intent(in) :: sense
    type(element_type), intent(in) :: outermost
    type(margin_type), intent(inout) :: margin
    type(element_type) :: element
    real(dp) :: low, high, y, theta, enough
    integer(ip) :: n
    margin%at_edge = margin%at_centre - outermost%deficit
    theta = margin%angle
    margin%angle = 0
    margin%stick_radius = 0
    margin%force = 0
    if (margin%at_centre <= 0) return
    if (margin%at_edge >= 0) then
      margin%angle = outermost_angle
      margin%stick_radius = outermost%distance
      margin%force = outermost%loading + outermost%distance*margin%at_edge
      return
    end if
    enough = min(margin%at_centre, -margin%at_edge)*margin%accuracy
    low = 0
    high = outermost_angle
    if (.not. (theta > low .and. theta < high)) theta = 0.5_dp*(low + high)
    do n = 1, most_trials
      call element_at(normal, store, time, sense, theta, element)
      y = margin%at_centre - element%deficit
      if (y > 0) low = theta
      if (y <= 0) high = theta
      if (abs(y) <= enough .or. high - low <= search_rounding*outermost_angle) exit
      if (element%slope < 0) then
        theta = theta - y/element%slope
      else
        theta = low
      end if
      if (.not. (theta > low .and. theta < high)) theta = 0.5_dp*(low + high)
    end do
    margin%angle = theta
    margin%stick_radius = element%distance
    margin%force = element%loading + element%distance*y
    if (element%slope < 0) call extrapolate_front(element, y, margin)
  end subroutine find_front

  !> From an element with a small margin y to the front, with y linear in between.
  pure subroutine extrapolate_front(element, y, margin)
    type(element_type), intent(in) :: element
    real(dp), intent(in) :: y
    type(margin_type), intent(inout) :: margin
    real(dp) :: further
    further = -y/element%slope*element%stretch
    margin%angle = margin%angle - y/element%slope
    margin%stick_radius = margin%stick_radius + further
    margin%force = margin%force + 0.5_dp*y*further
  end subroutine extrapolate_front

  !> Without slip, for an edge at the angle theta: S less A (sum_k M_k^x + eta U'): sum_k E_k (P_k^x
  !> - A M_k^x)(t_A).
  function memory_force_at(normal, store, time, theta) result(memory_force)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: time, theta
    real(dp) :: memory_force, weight(0:stages), touch(of_touch), both(of_arm), arm(2)
    integer(ip) :: k, record
    call find_record(store, theta, record, weight)
    touch = interpolated(weight, store%record(record)%touch)
    memory_force = 0
    do k = 1, normal%n_arms
      both = corrective_at(weight, store%corrective, k, record)
      arm = 0.5_dp*(both(3:) - both(:2))
      memory_force = memory_force + exp(-normal%rate(k)*(time - touch(2)))*(arm(2) - touch(1)*arm(1))
    end do
  end function memory_force_at

  !> The record in which an angle is, and the weights of its points.
  pure subroutine find_record(store, theta, record, weight)
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: theta
    integer(ip), intent(out) :: record
    real(dp), intent(out) :: weight(0:stages)
    integer(ip) :: last, middle
    record = 1
    last = store%n_records
    do while (record < last) ! as range_at, of which compilers would copy the argument
      middle = (record + last + 1)/2
      if (theta < store%record(middle)%from) last = middle - 1
      if (theta >= store%record(middle)%from) record = middle
    end do
    associate (r => store%record(record))
      weight = weights_at((theta - r%from)/(r%to - r%from))
    end associate
  end subroutine find_record

  !> The element that the edge reached at the angle theta. By A^2 = D the edge moves by dX/dtheta =
  !> D' (ds/dtheta)/(2 X), and dy/dtheta = -v_sigma ds/dtheta sum_k g_k E_k.
  subroutine element_at(normal, store, time, sense, theta, element)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(in) :: store
    real(dp), intent(in) :: time, theta
    integer(kind(sticks)), intent(in) :: sense
    type(element_type), intent(out) :: element
    real(dp) :: weight(0:stages), touch(of_touch), both(of_arm), arm(2), ago, fade, answer
    integer(ip) :: k, record
    call find_record(store, theta, record, weight)
    touch = interpolated(weight, store%record(record)%touch)
    ago = time - touch(2)
    element%deficit = 0
    element%loading = 0
    answer = 0
    do k = 1, normal%n_arms
      if (normal%rate(k)*ago > faded) cycle
      fade = 1
      if (normal%rate(k) > 0) fade = exp(-normal%rate(k)*ago)
      both = corrective_at(weight, store%corrective, k, record)
      arm = merge(both(:2), both(3:), sense > 0)
      element%deficit = element%deficit + fade*arm(1)
      element%loading = element%loading + fade*arm(2)
      answer = answer + normal%g(k)*fade
    end do
    element%distance = touch(1)
    element%slope = -(touch(3) - sense*touch(4))*answer
    element%stretch = 0
    if (element%distance > 0) element%stretch = touch(3)/(2*element%distance)
  end subroutine element_at

  !> Values of an element or of an arm, known at the points of a record, in between. (Sums that are
  !> written out stay in registers. There are as many values of both kinds.)
  pure function interpolated(weight, at) result(values)
    real(dp), intent(in) :: weight(0:stages), at(of_touch, 0:stages)
    real(dp) :: values(of_touch)
    values = weight(0)*at(:, 0) + weight(1)*at(:, 1) + weight(2)*at(:, 2) + weight(3)*at(:, 3) + weight(4)*at(:, 4) &
             + weight(5)*at(:, 5) + weight(6)*at(:, 6)
  end function interpolated

  !> m_k and p_k of an arm for sigma = 1 and for -1. (As a pointer, since compilers would copy parts
  !> of a component.)
  function corrective_at(weight, corrective, arm, record) result(values)
    real(dp), intent(in) :: weight(0:stages)
    real(dp), pointer, contiguous, intent(in) :: corrective(:, :, :, :)
    integer(ip), intent(in) :: arm, record
    real(dp) :: values(of_arm)
    values = interpolated(weight, corrective(:, :, arm, record))
  end function corrective_at
end module rst_front
