!> The loop over elements of the method `sync`, a group of lanes at a time (see rst_sync_shear for what it computes).
module rst_sync_lanes
  use rst_precision, only: dp, ip
  use rst_sync_elements, only: step_type, sums_type, term_type, lanes, columns, column_x2, column_weight, column_alpha, column_kappa
  implicit none (type, external)
  private
  public :: move_elements

contains

  !> Move all elements in contact by one step, or with trial /= 0 only say what that would give. Each lane has its own sums.
  subroutine move_elements(step, trial, term, body, beta, faded, sums)
    type(step_type), intent(in) :: step
    integer(ip), intent(in), value :: trial
    type(term_type), intent(in) :: term(step%n_terms)
    real(dp), intent(inout) :: body(0:step%capacity - 1, columns)
    real(dp), intent(inout), dimension(0:step%capacity - 1, step%n_terms) :: beta, faded
    type(sums_type), intent(out) :: sums
    integer(ip), parameter :: block = 64  !! elements whose intermediate values stay in the nearest cache
    real(dp), dimension(block) :: f, stick, force, weight, kept, slip
    real(dp), dimension(lanes) :: sum_q
    real(dp) :: carried, keep, admittance, decay, from_start, from_end
    integer(ip) :: first, count, inside, k, l

    keep = 1 - step%drop
    carried = step%start_response*keep
    admittance = 1/(step%end_response + step%drop*step%start_response)
    sum_q = 0
    sums%stuck = 0
    if (trial == 0 .and. step%n_terms == 1) then
      call move_with_one_term(term(1)%decay, term(1)%from_start, term(1)%from_end, body(:, column_x2), body(:, column_weight), &
                              body(:, column_alpha), body(:, column_kappa), beta, faded)
      call add_lanes()
      return
    end if
    do first = step%first, step%last, block
      inside = min(block, step%last + 1 - first)
      count = (inside + lanes - 1)/lanes*lanes
      !$omp simd
      do l = 1, count
        f(l) = step%f - body(first + l - 1, column_x2)
        stick(l) = step%q - body(first + l - 1, column_alpha) - carried*body(first + l - 1, column_kappa)
        weight(l) = body(first + l - 1, column_weight)
      end do
      do l = inside + 1, count
        weight(l) = 0
      end do
      do k = 1, step%n_terms
        decay = term(k)%decay
        !$omp simd
        do l = 1, count
          f(l) = f(l) - decay*faded(first + l - 1, k)
          stick(l) = stick(l) - decay*beta(first + l - 1, k)
        end do
      end do
      !$omp simd
      do l = 1, count
        f(l) = max(f(l), 0.0_dp)
        force(l) = min(max(stick(l), -f(l)), f(l))
        slip(l) = (stick(l) - force(l))*admittance
      end do
      do k = 1, count, lanes
        do l = 1, lanes
          sum_q(l) = sum_q(l) + weight(k + l - 1)*force(k + l - 1)
        end do
      end do
      if (trial /= 0) then
        do l = 1, inside
          if (.not. abs(slip(l)) > 0) sums%stuck = sums%stuck + weight(l)
        end do
        cycle
      end if
      !$omp simd
      do l = 1, count
        kept(l) = keep*body(first + l - 1, column_kappa) + step%drop*slip(l)
        body(first + l - 1, column_alpha) = body(first + l - 1, column_alpha) + step%spring*(kept(l) + slip(l))
        body(first + l - 1, column_kappa) = slip(l)
      end do
      do k = 1, step%n_terms
        decay = term(k)%decay
        from_start = term(k)%from_start
        from_end = term(k)%from_end
        !$omp simd
        do l = 1, count
          faded(first + l - 1, k) = decay*faded(first + l - 1, k)
          beta(first + l - 1, k) = decay*beta(first + l - 1, k) + from_start*kept(l) + from_end*slip(l)
        end do
      end do
    end do
    call add_lanes()
  contains

    !> The usual solid, in one go.
    subroutine move_with_one_term(decay, from_start, from_end, x2, weight, alpha, kappa, beta, faded)
      real(dp), intent(in) :: decay, from_start, from_end
      real(dp), intent(in), dimension(0:step%capacity - 1) :: x2, weight
      real(dp), intent(inout), dimension(0:step%capacity - 1) :: alpha, kappa, beta, faded
      real(dp) :: fresh, q, drop, spring, f, stick, force, slip, kept, share(lanes), total(lanes)
      integer(ip) :: first, i, l
      fresh = step%f
      q = step%q
      drop = step%drop
      spring = step%spring
      total = 0
      do first = step%first, step%last, lanes
        do l = 1, lanes
          share(l) = weight(first + l - 1)
        end do
        do l = step%last - first + 2, lanes
          share(l) = 0
        end do
        !$omp simd private(i, f, stick, force, slip, kept)
        do l = 1, lanes
          i = first + l - 1
          f = max(fresh - x2(i) - decay*faded(i), 0.0_dp)
          stick = q - alpha(i) - carried*kappa(i) - decay*beta(i)
          force = min(max(stick, -f), f)
          slip = (stick - force)*admittance
          kept = keep*kappa(i) + drop*slip
          alpha(i) = alpha(i) + spring*(kept + slip)
          kappa(i) = slip
          faded(i) = decay*faded(i)
          beta(i) = decay*beta(i) + from_start*kept + from_end*slip
          total(l) = total(l) + share(l)*force
        end do
      end do
      sum_q = total
    end subroutine move_with_one_term

    !> In an order that does not depend on the width of vectors.
    subroutine add_lanes()
      sums%q = ((sum_q(1) + sum_q(5)) + (sum_q(3) + sum_q(7))) + ((sum_q(2) + sum_q(6)) + (sum_q(4) + sum_q(8)))
    end subroutine add_lanes
  end subroutine move_elements
end module rst_sync_lanes
