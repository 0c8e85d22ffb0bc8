!> The nodes of a contact and the integral over its radius of what is linear in y = x^2 between them: exact for the elastic force,
!> whatever the number of nodes (docs/contact.md).
module rst_contact_grid
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, layout_of, at_width, at_arrays, lanes
  implicit none (type, external)
  private
  public :: place_nodes, weight, integral, stretch

  real(dp), parameter :: stretch_ratio = 1.5_dp  !! of a grid that is outgrown; twice loses more resolution, less stretches more often

contains

  !> int p dx from x1 to x2 if p is linear in x^2, 1 at x1 and 0 at x2, whichever is larger.
  elemental function weight(x1, x2)
    real(dp), intent(in) :: x1, x2
    real(dp) :: weight
    weight = 0
    if (x1 + x2 > 0) weight = abs(x2 - x1)*(2*x2 + x1)/(3*(x1 + x2))
  end function weight

  !> Set the layout of the state and the grid. Nodes are half-way between evenly spaced ones and those of sin, which are dense at the rim.
  pure subroutine place_nodes(law) bind(c, name="rst_law_grid")
    type(law_type), intent(inout) :: law
    real(dp), parameter :: half_pi = acos(0.0_dp)
    real(dp) :: part
    integer(ip) :: j, n
    do j = 1, law%n + 1
      part = real(j - 1, dp)/real(law%n, dp)
      law%x(j) = 0.5_dp*(part + sin(half_pi*part))
      law%y(j) = law%x(j)**2
    end do
    law%at = layout_of(law)
    n = law%n
    law%outwards(1:n) = weight(law%x(1:n), law%x(2:n + 1))
    law%weight(1:n) = law%outwards(1:n)
    law%weight(2:n) = law%weight(2:n) + weight(law%x(2:n), law%x(1:n - 1))
  end subroutine place_nodes

  !> int f dx over a contact that ends at the last element where f is not zero, and that element's outer cell.
  pure function integral(law, f)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: f(*)
    real(dp) :: integral
    integer(ip) :: first, j
    integral = 0
    do first = 0, law%n - 1, lanes
      !$omp simd reduction(+: integral)
      do j = first + 1, first + lanes
        integral = integral + law%weight(j)*f(j)
      end do
    end do
  end function integral

  !> A contact of radius^2 `area` that outgrows its grid: the grid is widened, states are interpolated linearly in y; what lies
  !> beyond the old width is virgin.
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
    if (ratio <= 1) return
    do array = at_arrays, law%at%work - law%n, law%n
      call resample(law%n, law%y, ratio**2, state(array))
    end do
    state(at_width) = ratio*state(at_width)
  end subroutine stretch

  pure subroutine resample(n, y, ratio, values)
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: y(n + 1), ratio
    real(dp), intent(inout) :: values(n)
    real(dp) :: place
    integer(ip) :: i, j
    i = 1
    do j = 1, n ! the values read lie at or behind j: ratio > 1
      place = min(1.0_dp, ratio*y(j))
      do while (i < n .and. y(i + 1) < place)
        i = i + 1
      end do
      if (i < n) then
        values(j) = values(i) + (values(i + 1) - values(i))*(place - y(i))/(y(i + 1) - y(i))
      else
        values(j) = values(n)*(y(n + 1) - place)/(y(n + 1) - y(n))
      end if
    end do
  end subroutine resample
end module rst_contact_grid
