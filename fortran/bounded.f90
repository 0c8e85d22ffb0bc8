!> A quotient that is only wanted within bounds, and does not overflow beyond them.
module rst_bounded
  use rst_precision, only: dp
  implicit none (type, external)
  private
  public :: bounded

contains

  !> a/b within low < 0 < high; where b is 0 the bound on the side of a, and 0 for a = 0.
  elemental function bounded(a, b, low, high) result(x)
    real(dp), intent(in) :: a, b, low, high
    real(dp) :: x, up, down
    up = a*sign(1.0_dp, b)
    down = abs(b)
    x = 0
    if (up > 0 .and. up >= high*down) then
      x = high
    else if (up < 0 .and. up <= low*down) then
      x = low
    else if (abs(up) > 0) then
      x = up/down
    end if
  end function bounded
end module rst_bounded
