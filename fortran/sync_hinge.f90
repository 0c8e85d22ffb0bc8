!> The slack of the method `sync` behind its front (module rst_sync_front): its integral H over X from nodes, and that of H over a
!> step towards the end of stick.
module rst_sync_hinge
  use rst_precision, only: dp, ip
  use rst_sync_levels, only: node_type
  use rst_sync_point, only: point_type
  implicit none (type, external)
  private
  public :: hinge, beyond_edge, root_left_out

  real(dp), parameter :: sixth = 1.0_dp/6, third = 1.0_dp/3  !! compilers divide by constants as written
  !> What `beyond` is where x is 1, by y at the nodes f-2 to f+1 times their widths: Gregory's rule.
  real(dp), parameter :: whole_cell(-2:1) = [19, -87, 177, 251]/720.0_dp

  real(dp), parameter :: nearly_a_line = 0.25_dp  !! bends up to that part of the slope

contains

  !> What the trapezoidal rule over the nodes 0 to f lacks of int_0^c y dX, where the cubic through y dX/dj at the nodes f-2 to f+1
  !> has its root c between f and f+1, the part x of the way. Where it is all but a line there, x of the line is taken, and the
  !> triangle from there to the root.
  pure function hinge(f, node, y) result(missing)
    integer(ip), intent(in) :: f
    type(node_type), intent(in) :: node(0:f + 1)
    real(dp), intent(in) :: y(-2:1)
    real(dp) :: missing, v(-2:1), slope, bend, twist, along, x, left, turn
    v = by_index(f, node, y)
    call expand(f, v, slope, bend, twist)
    if (f > 1 .and. v(1) <= 0 .and. abs(bend) + abs(twist) < nearly_a_line*(v(0) - v(1))) then
      along = 1/(v(0) - v(1))
      x = min(1.0_dp, v(0)*along)
      left = (bend + twist*(1 + x))*(x*(x - 1))
      turn = along*(bend*(2*x - 1) + twist*(3*x*x - 1))
      missing = beyond(v, slope, bend, twist, x) + (0.5_dp*along)*(left*left)*(1 + turn*(1 + turn))
    else
      x = root_of(v, slope, bend, twist)
      missing = beyond(v, slope, bend, twist, x)
    end if
  end function hinge

  !> Where the cubic is zero; 1 if nowhere.
  pure function root_of(v, slope, bend, twist) result(x)
    real(dp), intent(in) :: v(-2:1), slope, bend, twist
    real(dp) :: x, root
    root = sqrt(max(0.0_dp, slope**2 - 4*bend*v(0))) ! less the slope there
    x = 1
    if (.not. (root > 0 .and. abs(root - slope) > 0)) return
    x = 2*v(0)/(root - slope)
    x = x + twist*x*(x*x - 1)/root
    x = max(0.0_dp, min(1.0_dp, x))
  end function root_of

  !> What the rule lacks if c is the part x of the way from f to f+1: Euler-Maclaurin's terms at f and the integral from there on.
  pure function beyond(v, slope, bend, twist, x) result(missing)
    real(dp), intent(in) :: v(-2:1), slope, bend, twist, x
    real(dp) :: missing
    missing = v(0)*(x - 0.5_dp) + slope*(0.5_dp*x*x - 1.0_dp/12) + bend*(third*x)*(x*x) &
              + twist*(x*x*(0.25_dp*x*x - 0.5_dp) + (1.0_dp/12 + 1.0_dp/120))
  end function beyond

  !> The same where all of the last cell counts.
  pure function beyond_edge(f, node, y) result(missing)
    integer(ip), intent(in) :: f
    type(node_type), intent(in) :: node(0:f + 1)
    real(dp), intent(in) :: y(-2:1)
    real(dp) :: missing, v(-2:1), slope, bend, twist
    v = by_index(f, node, y)
    if (f > 0) then
      missing = ((whole_cell(0)*v(0) + whole_cell(1)*v(1)) + (whole_cell(-1)*v(-1) + whole_cell(-2)*v(-2)))
    else
      call expand(f, v, slope, bend, twist)
      missing = beyond(v, slope, bend, twist, 1.0_dp)
    end if
  end function beyond_edge

  !> y dX/dj at the nodes f-2 to f+1; even in X.
  pure function by_index(f, node, y) result(v)
    integer(ip), intent(in) :: f
    type(node_type), intent(in) :: node(0:f + 1)
    real(dp), intent(in) :: y(-2:1)
    real(dp) :: v(-2:1), width_before
    if (f > 1) then
      v = y*node(f - 2:f + 1)%width
    else
      width_before = 2*node(0)%width - node(1)%width ! of the node -1
      v(0:1) = y(0:1)*node(f:f + 1)%width
      v(-1) = y(-1)*merge(node(0)%width, width_before, f > 0)
      v(-2) = y(-2)*width_before
    end if
  end function by_index

  !> v(0) + slope x + bend x^2 + twist x (x^2 - 1) through the values at -2 to 1; without the twist next to the centre.
  pure subroutine expand(f, v, slope, bend, twist)
    integer(ip), intent(in) :: f
    real(dp), intent(in) :: v(-2:1)
    real(dp), intent(out) :: slope, bend, twist
    slope = 0.5_dp*(v(1) - v(-1))
    bend = 0.5_dp*(v(1) + v(-1)) - v(0)
    twist = 0
    if (f > 0) twist = ((v(1) - v(-2)) - 3*(v(0) - v(-1)))*sixth
  end subroutine expand

  !> What the usual rule lacks of int H ds over a step near the end of stick, where H = C y^(3/2) with smooth C and y, the slack at
  !> the centre: y is taken as a parabola in time, C as a line. slack, lack: y and H at the end of the step.
  pure function root_left_out(h, slack, lack, weight, p) result(missing)
    real(dp), intent(in) :: h, slack, lack, weight(0:3)
    type(point_type), intent(in) :: p
    real(dp) :: missing, slope, bend, left, c, before_c, rise, before, lack_here, lack_before
    real(dp), parameter :: place(3) = [0.5_dp - sqrt(0.15_dp), 0.5_dp, 0.5_dp + sqrt(0.15_dp)], &
                           share(3) = [5.0_dp/18, 8.0_dp/18, 5.0_dp/18]  ! Gauss
    real(dp), parameter :: all_but_gone = 0.01_dp  !! of the slack: says nothing of C any more
    integer(ip) :: i
    missing = 0
    if (.not. p%slack > 0) return
    before = p%step_before(1)
    lack_here = p%side*p%force + p%normal
    lack_before = p%side*p%force_before(1) + p%normal_before(1)
    slope = (slack - p%slack)/h
    bend = 0
    if (p%slack_before > 0) bend = (slope - (p%slack - p%slack_before)/before)/(h + before)
    slope = slope - bend*h ! at the start
    c = lack_here/(p%slack*sqrt(p%slack))
    before_c = c
    if (p%slack_before > 0) before_c = lack_before/(p%slack_before*sqrt(p%slack_before))
    if (p%slack <= all_but_gone*p%slack_before) c = before_c
    rise = 0
    if (slack > all_but_gone*p%slack) then
      rise = (lack/(slack*sqrt(slack)) - c)/h
      do i = 1, 3
        missing = missing + share(i)*h*root_law(h*place(i))
      end do
    else ! substituted such that the root is no more at its end
      if (before > 0) rise = (c - before_c)/before
      left = min(h, 2*p%slack/(-slope + sqrt(max(0.0_dp, slope**2 - 4*bend*p%slack))))
      do i = 1, 3
        missing = missing + share(i)*2*place(i)*left*root_law(left*(1 - place(i)**2))
      end do
    end if
    missing = missing - (weight(0)*lack + weight(1)*lack_here)
    if (p%slack_before > 0) then
      missing = missing - weight(2)*root_law(-before)
      if (p%known > 2) missing = missing - weight(3)*root_law(-before - p%step_before(2))
    else
      missing = missing - (weight(2)*lack_before + weight(3)*(p%side*p%force_before(2) + p%normal_before(2)))
    end if
  contains
    pure function root_law(x) result(law)
      real(dp), intent(in) :: x
      real(dp) :: law, y
      y = max(0.0_dp, p%slack + x*(slope + x*bend))
      law = (c + rise*x)*y*sqrt(y)
    end function root_law
  end function root_left_out
end module rst_sync_hinge
