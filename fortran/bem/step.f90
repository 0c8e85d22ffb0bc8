! SPDX-License-Identifier: BSD-3-Clause
!> The loops over cells of one time step (docs/bem.md). Units: a_el along the surface, d0 into it
!> and along it over mu, moduli in G_r. With f = K p, the displacement is u = C f - h, where C and h
!> (the memory of the solid) are known when the step begins.
module rst_bem_step
  use rst_friction_mode, only: mode_no_slip
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: start_normal, start_shear, recall, remember, normal_target, enter, shear_bounds, shear_target, measure, settle

  real(dp), parameter :: pull = 1.5_dp !! u_x of the sphere over U

contains

  !> First guess of p: extrapolated from the last two steps.
  pure subroutine start_normal(ld, m, p, p_before, start, low, high) bind(c, name="rst_bem_start_normal")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), dimension(ld, m) :: p, p_before
    real(dp), intent(inout), dimension(ld, m) :: start, low, high
    integer(ip) :: i, j
    do j = 1, m
      do i = 1, m
        start(i, j) = 2*p(i, j) - p_before(i, j)
        low(i, j) = 0
        high(i, j) = huge(1.0_dp)
      end do
    end do
  end subroutine start_normal

  !> The same for tau; cells that slipped start at the limit, which has changed with the pressure.
  pure subroutine start_shear(ld, m, p, tau, tau_before, high, start) bind(c, name="rst_bem_start_shear")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), dimension(ld, m) :: p, tau, tau_before, high
    real(dp), intent(inout) :: start(ld, m)
    integer(ip) :: i, j
    do j = 1, m
      do i = 1, m
        start(i, j) = merge(sign(high(i, j), tau(i, j)), 2*tau(i, j) - tau_before(i, j), &
                            abs(tau(i, j)) >= p(i, j) .and. p(i, j) > 0 .and. high(i, j) < huge(1.0_dp))
      end do
    end do
  end subroutine start_shear

  !> h = sum_k decay_k b_k + drift - held f.
  pure subroutine recall(ld, m, n_terms, decay, b, held, drift, f, h) bind(c, name="rst_bem_recall")
    integer(ip), intent(in), value :: ld, m, n_terms
    real(dp), intent(in), value :: held
    real(dp), intent(in) :: decay(n_terms), b(ld, ld, n_terms), drift(ld, m), f(ld, m)
    real(dp), intent(inout) :: h(ld, m)
    integer(ip) :: j, k
    do j = 1, m
      h(1:m, j) = drift(1:m, j) - held*f(1:m, j)
      do k = 1, n_terms
        h(1:m, j) = h(1:m, j) + decay(k)*b(1:m, j, k)
      end do
    end do
  end subroutine recall

  !> b_k = decay_k b_k + gain_k (f_new - f), drift = drift - half_flow (f + f_new), f = f_new.
  pure subroutine remember(ld, m, n_terms, decay, gain, half_flow, f_new, b, drift, f) bind(c, name="rst_bem_remember")
    integer(ip), intent(in), value :: ld, m, n_terms
    real(dp), intent(in), value :: half_flow
    real(dp), intent(in) :: decay(n_terms), gain(n_terms), f_new(ld, m)
    real(dp), intent(inout) :: b(ld, ld, n_terms), drift(ld, m), f(ld, m)
    integer(ip) :: j, k
    do j = 1, m
      do k = 1, n_terms
        b(1:m, j, k) = decay(k)*b(1:m, j, k) + gain(k)*(f_new(1:m, j) - f(1:m, j))
      end do
      if (half_flow > 0) drift(1:m, j) = drift(1:m, j) - half_flow*(f(1:m, j) + f_new(1:m, j))
      f(1:m, j) = f_new(1:m, j)
    end do
  end subroutine remember

  !> Target of K p in contact: (D - r^2/2 + h)/C.
  pure subroutine normal_target(ld, m, spacing, depth, c, h, target) bind(c, name="rst_bem_normal_target")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), value :: spacing, depth, c
    real(dp), intent(in) :: h(ld, m)
    real(dp), intent(inout) :: target(ld, m)
    real(dp) :: y2
    integer(ip) :: i, j
    do j = 1, m
      y2 = (real(j, dp) - 0.5_dp)**2
      do i = 1, m
        target(i, j) = (depth - 0.5_dp*spacing**2*((real(i, dp) - 0.5_dp)**2 + y2) + h(i, j))/c
      end do
    end do
  end subroutine normal_target

  !> Anchors of the cells that entered in the step. The anchor a is u_x - 1.5 U of a cell that
  !> sticks. Before it enters, both its gap and its s = u_x - 1.5 U move as under a growing flat
  !> punch, in proportion, so s where the gap closes is extrapolated from the last two steps. In the
  !> first step the load is proportional: s = -1.5 (U/D) r^2/2.
  pure subroutine enter(ld, m, spacing, first_ratio, p, p_before, gap, gap_before, s, s_before, a) bind(c, name="rst_bem_enter")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), value :: spacing, first_ratio !! first_ratio: U/D in the first step, else negative
    real(dp), intent(in), dimension(ld, m) :: p, p_before, gap, gap_before, s, s_before
    real(dp), intent(inout) :: a(ld, m)
    real(dp) :: ahead
    integer(ip) :: i, j
    do j = 1, m
      do i = 1, m
        if (.not. (p(i, j) > 0 .and. p_before(i, j) <= 0)) cycle
        if (first_ratio >= 0) then
          a(i, j) = -pull*first_ratio*0.5_dp*spacing**2*((real(i, dp) - 0.5_dp)**2 + (real(j, dp) - 0.5_dp)**2)
        else
          ahead = 0
          if (gap_before(i, j) > gap(i, j)) ahead = min(1.0_dp, max(0.0_dp, gap(i, j)/(gap_before(i, j) - gap(i, j))))
          a(i, j) = s(i, j) + ahead*(s(i, j) - s_before(i, j))
        end if
      end do
    end do
  end subroutine enter

  !> |tau| <= p, or any in contact without slip.
  pure subroutine shear_bounds(ld, m, mode, p, low, high) bind(c, name="rst_bem_shear_bounds")
    integer(ip), intent(in), value :: ld, m, mode
    real(dp), intent(in) :: p(ld, m)
    real(dp), intent(inout), dimension(ld, m) :: low, high
    integer(ip) :: i, j
    do j = 1, m
      do i = 1, m
        high(i, j) = p(i, j)
        if (mode == mode_no_slip .and. p(i, j) > 0) high(i, j) = huge(1.0_dp)
        low(i, j) = -high(i, j)
      end do
    end do
  end subroutine shear_bounds

  !> Target of K tau where it sticks: (1.5 U + a + h)/C.
  pure subroutine shear_target(ld, m, shift, c, a, h, target) bind(c, name="rst_bem_shear_target")
    integer(ip), intent(in), value :: ld, m
    real(dp), intent(in), value :: shift, c
    real(dp), intent(in), dimension(ld, m) :: a, h
    real(dp), intent(inout) :: target(ld, m)
    integer(ip) :: i, j
    do j = 1, m
      do i = 1, m
        target(i, j) = (pull*shift + a(i, j) + h(i, j))/c
      end do
    end do
  end subroutine shear_target

  !> The gap after the normal problem; the one before is kept; force: sum of p over the quarter;
  !> contact: number of its cells.
  pure subroutine measure(ld, m, near, c, f, target, p, gap, gap_before, force, contact) &
    bind(c, name="rst_bem_measure")
    integer(ip), intent(in), value :: ld, m, near !! near: contact is within the first so many
    real(dp), intent(in), value :: c
    real(dp), intent(in), dimension(ld, m) :: f, target, p
    real(dp), intent(inout), dimension(ld, m) :: gap, gap_before
    real(dp), intent(out) :: force, contact
    integer(ip) :: i, j
    force = 0
    contact = 0
    do j = 1, m
      do i = 1, m
        gap_before(i, j) = gap(i, j)
        gap(i, j) = c*(f(i, j) - target(i, j))
      end do
    end do
    do j = 1, near
      !$omp simd reduction(+:force, contact)
      do i = 1, near
        force = force + p(i, j)
        contact = contact + merge(1.0_dp, 0.0_dp, p(i, j) > 0)
      end do
    end do
  end subroutine measure

  !> After the tangential problem: s of all cells, anchors of those that slipped. work: sum of mean
  !> tau times slip over the quarter.
  pure subroutine settle(ld, m, near, shift, c, h, f, p, tau_before, tau, low, high, a, s, s_before, force, &
                         stick, work) &
    bind(c, name="rst_bem_settle")
    integer(ip), intent(in), value :: ld, m, near !! near: contact is within the first so many
    real(dp), intent(in), value :: shift, c
    real(dp), intent(in), dimension(ld, m) :: h, f, p, tau_before, tau, low, high
    real(dp), intent(inout), dimension(ld, m) :: a, s, s_before
    real(dp), intent(out) :: force, stick, work
    integer(ip) :: i, j
    logical :: slips
    force = 0
    stick = 0
    work = 0
    do j = 1, m
      do i = 1, m
        s_before(i, j) = s(i, j)
        s(i, j) = c*f(i, j) - h(i, j) - pull*shift
        if (i > near .or. j > near) cycle
        if (p(i, j) <= 0) cycle
        force = force + tau(i, j)
        slips = tau(i, j) >= high(i, j) .or. tau(i, j) <= low(i, j)
        if (slips) then
          work = work - 0.5_dp*(tau_before(i, j) + tau(i, j))*(s(i, j) - a(i, j))
          a(i, j) = s(i, j)
        else
          stick = stick + 1
        end if
      end do
    end do
  end subroutine settle

end module rst_bem_step
