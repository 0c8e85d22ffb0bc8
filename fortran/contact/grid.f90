!> The nodes of a contact and the integral over its radius of what is linear in y = x^2 between
!> them: exact for the elastic force, for any number of nodes (docs/contact.md).
module rst_contact_grid
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, at_width, at_arrays
  implicit none (type, external)
  private
  public :: place_nodes, weight, stretch

  real(dp), parameter :: stretch_ratio = 1.5_dp  !! of a wider grid: 2 loses resolution, less widens more often

contains

  !> int p dx from x1 to x2 if p is linear in x^2, 1 at x1 and 0 at x2, whichever is larger.
  elemental function weight(x1, x2)
    real(dp), intent(in) :: x1, x2
    real(dp) :: weight
    weight = 0
    if (x1 + x2 > 0) weight = abs(x2 - x1)*(2*x2 + x1)/(3*(x1 + x2))
  end function weight

  !> Set the layout of the state and the grid. Nodes are half-way between evenly spaced ones and
  !> those of sin, which are dense at the edge.
  pure subroutine place_nodes(law) bind(c, name="rst_law_grid")
    type(law_type), intent(inout) :: law
    real(dp), parameter :: half_pi = acos(0.0_dp)
    real(dp) :: share
    integer(ip) :: j, n
    n = law%n
    do j = 1, n + 1
      share = real(j - 1, dp)/real(n, dp)
      law%x(j) = 0.5_dp*(share + sin(half_pi*share))
      law%y(j) = law%x(j)**2
    end do
    law%per_cell(2:n) = 1/(law%y(2:n) - law%y(1:n - 1))
    law%bit(1) = 1
    do j = 2, n
      law%bit(j) = 2*law%bit(j - 1)
    end do
    law%outwards(1:n) = weight(law%x(1:n), law%x(2:n + 1))
    law%weight(1:n) = law%outwards(1:n)
    law%weight(2:n) = law%weight(2:n) + weight(law%x(2:n), law%x(1:n - 1))
    law%at_u = at_arrays + n*law%n_terms
    law%at_w = law%at_u + 2*n*law%slips
    law%at_surface = law%at_w + 2*n*law%n_terms*law%slips
    law%at_work = law%at_surface + n*law%surface
    law%size = law%at_work + 2*law%accounts - 1
  end subroutine place_nodes

  !> A contact of radius^2 `area` that outgrows its grid: the grid is widened, states are
  !> interpolated linearly in y; elements beyond the old width are untouched.
  pure subroutine stretch(law, area, state)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: area
    real(dp), intent(inout) :: state(*)
    integer(ip) :: array
    real(dp) :: ratio
    ratio = 1
    do while (area > (ratio*state(at_width))**2)
      ratio = stretch_ratio*ratio
    end do
    do array = at_arrays, law%at_work - law%n, law%n
      call resample(law%n, law%y, ratio**2, state(array))
    end do
    state(at_width) = ratio*state(at_width)
  end subroutine stretch

  pure subroutine resample(n, y, ratio, values)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: y(n + 1), ratio
    real(dp), intent(inout) :: values(n)
    real(dp) :: place, outer
    integer(ip) :: i, j
    i = 1
    do j = 1, n ! the values read lie at or behind j: ratio > 1
      place = min(1.0_dp, ratio*y(j))
      do while (i < n .and. y(i + 1) < place)
        i = i + 1
      end do
      outer = 0
      if (i < n) outer = values(i + 1)
      place = (place - y(i))/(y(i + 1) - y(i)) ! 1 beyond the old grid: exactly 0 there, untouched
      values(j) = (1 - place)*values(i) + place*outer
    end do
  end subroutine resample
end module rst_contact_grid
