!> The sum over elements of the method `sync`, int_0^A q dX, from the nodes.
!>
!> int q dX = r int f dX - int (r f - q) dX with int f dX known exactly and r = q/f at the edge: the integrand is flat there,
!> whatever relaxes on the way in, and zero where all slips. So the trapezoidal rule is fourth order but for the
!> kink where stick begins; hinge() knows its error. What the rule lacks of int f dX is level_type%missing.
module rst_sync_edge
  use rst_precision, only: dp, ip
  use rst_bounded, only: bounded
  use rst_sync_grid, only: level_type, node_type
  use rst_sync_dense, only: trace_type
  use rst_sync_elements, only: scene_type, shear_type, step_type, sums_type, term_type, columns, column_x2, column_weight, &
                               column_alpha
  implicit none (type, external)
  private
  public :: weight_of, balance_levels, shear_force, find_front, stick_radius

contains

  !> Of the trapezoidal rule. An uneven grid has X'' /= 0 at the centre: Euler-Maclaurin's second term.
  pure function weight_of(node, i) result(weight)
    type(node_type), intent(in) :: node(0:*)
    integer(ip), intent(in) :: i
    real(dp) :: weight
    weight = node(i)%width
    if (i == 0) weight = node(0)%width/2 + (4*node(1)%width - 3*node(0)%width - node(2)%width)/24
  end function weight_of

  !> What the trapezoidal rule lacks of the normal force at all levels. Nodes in contact are 0 to j-1 at the levels j and 2n-j, and
  !> at the latter all have forgotten alike since the former.
  pure subroutine balance_levels(g_inf, n_terms, n, trace, node, level)
    real(dp), intent(in) :: g_inf
    integer(ip), intent(in) :: n_terms, n
    type(trace_type), intent(in) :: trace(n_terms, 0:2*n)
    type(node_type), intent(in) :: node(0:n)
    type(level_type), intent(inout) :: level(0:2*n)
    real(dp) :: weight, x2, faded
    integer(ip) :: j, k, back
    level%missing = 0 ! until all terms are there: what has faded
    do k = 1, n_terms
      faded = 0
      do j = 1, n
        back = 2*n - j
        faded = trace(k, j)%decay*(faded + weight_of(node, j - 1)*trace(k, j - 1)%memory)
        level(j)%missing = level(j)%missing + faded
        if (back > j) level(back)%missing = level(back)%missing + trace(k, back)%fade*faded
      end do
    end do
    weight = 0
    x2 = 0
    do j = 1, n
      back = 2*n - j
      weight = weight + weight_of(node, j - 1)
      x2 = x2 + weight_of(node, j - 1)*(g_inf*node(j - 1)%radius**2)
      level(j)%missing = level(j)%force - (level(j)%fresh*weight - x2 - level(j)%missing)
      if (back > j) level(back)%missing = level(back)%force - (level(back)%fresh*weight - x2 - level(back)%missing)
    end do
  end subroutine balance_levels

  !> int q dX at the end of a step; before the nodes are moved (trial) without the kink.
  pure function shear_force(scene, trial, restitution, radius, normal, velocity, trace, step, term, body, beta, faded, sums, &
                              state) result(total)
    type(scene_type), intent(in) :: scene
    logical, intent(in) :: trial, restitution
    type(level_type), intent(in) :: normal
    real(dp), intent(in) :: radius  !! of the contact
    real(dp), intent(in) :: velocity, body(0:scene%capacity - 1, columns)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    real(dp), intent(in), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(step_type), intent(in) :: step
    type(term_type), intent(in) :: term(scene%n_terms)
    type(sums_type), intent(in) :: sums
    type(shear_type), intent(in) :: state
    real(dp) :: total, ratio, slack(0:2), q(0:2)
    integer(ip) :: k
    total = 0
    if (step%last < 0) return
    if (restitution) then ! an edge that slips
      ratio = step%q - body(step%last, column_alpha)
      do k = 1, scene%n_terms
        ratio = ratio - beta(step%last, k)
      end do
      ratio = sign(1.0_dp, ratio)
    else ! the edge has just been touched and answers with the same modulus both ways
      ratio = bounded(velocity, max(normal%velocity, 0.0_dp), -1.0_dp, 1.0_dp)
    end if
    if (abs(ratio) >= 1 .and. state%front == step%last .and. (restitution .or. scene%no_slip == 0) .and. .not. trial) then
      q = 0
      slack = 0
      do k = min(2_ip, step%last), 0, -1
        call node_forces(scene, trace, term, step, body, beta, faded, state, step%last - k, slack(k), q(k))
      end do
      if (step%last < 3) then
        total = last_contact(radius, step%last, q)
      else
        total = sums%q + stuck_edge(scene, body, step%last, slack, q)
      end if
      return
    end if
    total = ratio*normal%missing + sums%q
    if (scene%no_slip /= 0 .and. .not. restitution) then
      total = total + body(step%last + 1, column_weight)/2*scene%eta*(velocity - ratio*normal%velocity)
    else if (abs(ratio) >= 1 .and. state%front >= 1 .and. .not. trial) then
      slack = 0
      do k = 0, min(2_ip, state%front)
        call node_forces(scene, trace, term, step, body, beta, faded, state, state%front - k, slack(k), q(k))
        slack(k) = slack(k)*body(state%front - k, column_weight)
      end do
      if (state%front == 1) slack(2) = 2*slack(1) - slack(0)
      total = total + ratio*hinge(slack)
    end if
  end function shear_force

  !> f - |q| and q of a node that sticks, at the end of the step.
  pure subroutine node_forces(scene, trace, term, step, body, beta, faded, state, i, slack, q)
    type(scene_type), intent(in) :: scene
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(term_type), intent(in) :: term(scene%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(in), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(shear_type), intent(in) :: state
    integer(ip), intent(in) :: i
    real(dp), intent(out) :: slack, q
    real(dp) :: age
    integer(ip) :: k, j
    slack = step%f - body(i, column_x2)
    q = step%q - body(i, column_alpha)
    do k = 1, scene%n_terms
      if (i < state%first) then
        age = term(k)%age
        do j = state%first - 1, i + 1, -1
          age = age*trace(k, j)%decay
        end do
        slack = slack - age*trace(k, i)%memory
        q = q - age*beta(i, k)
      else
        slack = slack - faded(i, k)
        q = q - beta(i, k)
      end if
    end do
    slack = max(0.0_dp, slack - abs(q))
  end subroutine node_forces

  !> Error of the trapezoidal rule for int (f - |q|) dX, which falls to zero at a kink between the outermost node that sticks and
  !> the
  !> next one: by Bernoulli's polynomials of x, where the kink is between them, times its slope and curvature there. slack: of
  !> the three outermost nodes that stick, times their widths.
  pure function hinge(slack) result(error)
    real(dp), intent(in) :: slack(0:2)
    real(dp) :: error, slope, bend, x
    error = 0
    bend = (slack(2) - 2*slack(1) + slack(0))/2
    slope = slack(1) - slack(0) - bend
    if (slope <= 0) then
      bend = 0
      slope = slack(1) - slack(0)
    end if
    if (slope <= 0) return
    x = min(1.0_dp, 2*slack(0)/(slope + sqrt(max(0.0_dp, slope**2 - 4*bend*slack(0)))))
    slope = slope - 2*bend*x
    error = slope*(x*(1 - x)/2 - 1.0_dp/12) - bend*x*(x*(x - 1.5_dp) + 0.5_dp)/3
  end function hinge

  !> What the trapezoidal rule lacks when all nodes stick: the last cell, where q goes on to the edge, by Gregory's rule, less
  !> the triangle next to the edge where q would be above f and slips. q: of the three outermost nodes.
  pure function stuck_edge(scene, body, last, slack, q) result(missing)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: last
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns), slack(0:2), q(0:2)
    real(dp) :: missing, edge, y(0:2), reach, slope, bend, width, widening
    edge = 3*q(0) - 3*q(1) + q(2)
    y(0) = edge*body(last + 1, column_weight)
    y(1) = q(0)*body(last, column_weight)
    y(2) = q(1)*body(last - 1, column_weight)
    missing = y(0)/2 - (y(0) - y(1))/12 - (y(0) - 2*y(1) + y(2))/24
    if (scene%no_slip /= 0) return
    bend = (slack(1) - 2*slack(0) - abs(edge))/2
    slope = slack(0) + abs(edge) - bend
    if (slope <= 0) then
      bend = 0
      slope = slack(0) + abs(edge)
    end if
    if (slope <= 0) return
    reach = min(1.0_dp, 2*abs(edge)/(slope + sqrt(max(0.0_dp, slope**2 + 4*bend*abs(edge))))) ! of the triangle, in cells
    width = body(last + 1, column_weight)
    widening = body(last, column_weight) - width
    missing = missing + sign(1.0_dp, edge)*reach*(-abs(edge)*width + reach*((slope*width - abs(edge)*widening)/2 &
                                                  + reach*((slope*widening + bend*width)/3 + reach*bend*widening/4)))
  end function stuck_edge

  !> The contact is all but over: int q dX of an even function that is known at the centre and at the outermost node, as if they
  !> were
  !> evenly spaced, which all grids are near the centre or nearly. q: from that node inwards.
  pure function last_contact(radius, last, q) result(total)
    real(dp), intent(in) :: radius, q(0:2)
    integer(ip), intent(in) :: last  !! 0 to 2
    real(dp) :: total
    total = q(last)*radius
    if (last > 0) total = total + (q(0) - q(last))*radius/(3*(real(last, dp)/real(last + 1, dp))**2)
  end function last_contact

  !> The outermost node that sticks, from where it was; -1: none.
  pure subroutine find_front(scene, kappa, last, state)
    type(scene_type), intent(in) :: scene
    real(dp), intent(in) :: kappa(0:scene%capacity - 1)
    integer(ip), intent(in) :: last
    type(shear_type), intent(inout) :: state
    state%front = max(0_ip, min(state%front, last))
    do while (state%front < last)
      if (state%front + 1 >= state%first .and. abs(kappa(state%front + 1)) > 0) exit
      state%front = state%front + 1
    end do
    do while (state%front >= state%first)
      if (.not. abs(kappa(state%front)) > 0) exit
      state%front = state%front - 1
    end do
  end subroutine find_front

  !> Where stick ends, between nodes.
  pure function stick_radius(scene, edge, node, trace, term, step, body, beta, faded, state) result(stick)
    type(scene_type), intent(in) :: scene
    integer(ip), intent(in) :: edge
    type(node_type), intent(in) :: node(0:scene%n)
    type(trace_type), intent(in) :: trace(scene%n_terms, 0:2*scene%n)
    type(term_type), intent(in) :: term(scene%n_terms)
    type(step_type), intent(in) :: step
    real(dp), intent(in) :: body(0:scene%capacity - 1, columns)
    real(dp), intent(in), dimension(0:scene%capacity - 1, scene%n_terms) :: beta, faded
    type(shear_type), intent(in) :: state
    real(dp) :: stick, slack(0:1), q
    integer(ip) :: k
    stick = node(edge)%radius
    if (scene%no_slip /= 0 .or. edge == 0) return
    stick = 0
    if (state%front < 0) return
    stick = node(state%front)%radius
    if (state%front < 1) return
    do k = 0, 1
      call node_forces(scene, trace, term, step, body, beta, faded, state, state%front - k, slack(k), q)
    end do
    stick = stick + bounded(slack(0), max(slack(1) - slack(0), 0.0_dp), -1.0_dp, 1.0_dp)*(node(state%front + 1)%radius - stick)
  end function stick_radius
end module rst_sync_edge
