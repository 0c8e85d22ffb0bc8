!> A panel of the normal motion and what is known of it between its points.
module rst_panel
  use rst_precision, only: dp, ip
  use rst_collocation, only: stages, weights_at
  implicit none (type, external)
  private
  public :: panel_type, normal_type, place_on, find_angle, range_at

  !> The motion at the start of the panel and at its points. The edge angle theta goes from `from`
  !> to `to`, upward in compression and downward in restitution; pace: |ds/dtheta|. Twin of `struct
  !> sync_panel` in C.
  type, bind(c) :: panel_type
    real(dp) :: from, to
    real(dp), dimension(0:stages) :: radius, time, depth, velocity, force, pace
  end type panel_type

  !> The normal motion of a solid, views of the caller's arrays. scale: r of A in theta; closeness:
  !> when iterations end; residual_speed: the speed that a sphere that has stopped will not exceed.
  type :: normal_type
    real(dp) :: eta, scale, closeness, residual_speed
    integer(ip) :: n_arms, n_compression, n_panels
    real(dp), pointer, contiguous :: g(:), rate(:)
    type(panel_type), pointer, contiguous :: panel(:)
    real(dp), pointer, contiguous, dimension(:, :, :) :: memory, loading !! (0:stages, arms, panels): M_k and P_k
    real(dp), pointer, contiguous :: kernel(:, :, :, :)  !! (stages, 0:stages, arms, panels): of the arms (module rst_arms)
    real(dp), pointer, contiguous :: entry(:, :, :)      !! (stages, arms, 2), room: M_k and P_k when the edge went in
  end type normal_type

contains

  !> The panel of the compression at whose angles theta is, and the weights of its points there.
  pure subroutine find_angle(theta, n_panels, panel, p, weight)
    real(dp), intent(in) :: theta
    integer(ip), intent(in) :: n_panels
    type(panel_type), intent(in) :: panel(n_panels)
    integer(ip), intent(out) :: p
    real(dp), intent(out) :: weight(0:stages)
    p = range_at(theta, panel)
    weight = weights_at(place_on(panel(p), theta))
  end subroutine find_angle

  !> The last panel that begins at theta or before, or else the first one, of panels whose angles
  !> rise, or fall if that is said. (Of the angles alone, one component of the panels, the compiler
  !> would make a copy.)
  pure function range_at(theta, panel, descends) result(i)
    real(dp), intent(in) :: theta
    type(panel_type), intent(in) :: panel(:)
    logical, intent(in), optional :: descends
    real(dp) :: sense
    integer(ip) :: i, last, middle
    sense = 1
    if (present(descends)) sense = merge(-1.0_dp, 1.0_dp, descends)
    i = 1
    last = size(panel, kind=ip)
    do while (i < last)
      middle = (i + last + 1)/2
      if (sense*theta < sense*panel(middle)%from) then
        last = middle - 1
      else
        i = middle
      end if
    end do
  end function range_at

  !> x of an angle on the panel.
  pure function place_on(panel, theta) result(x)
    type(panel_type), intent(in) :: panel
    real(dp), intent(in) :: theta
    real(dp) :: x
    x = (theta - panel%from)/(panel%to - panel%from)
  end function place_on
end module rst_panel
