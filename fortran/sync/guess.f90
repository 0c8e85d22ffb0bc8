!> Where Newton's steps begin on a panel of the normal motion: D', A, F and the pace at its points,
!> by the coarser run, if there is one, or else by the panel before.
module rst_guess
  use rst_precision, only: dp, ip
  use rst_motion_factors, only: mass_factor
  use rst_collocation, only: stages, point, differential, weights_at, applied
  use rst_tuning, only: most_trials, guess_part
  use rst_panel, only: panel_type, normal_type, place_on
  implicit none (type, external)
  private
  public :: guess_compression, guess_restitution

contains

  !> At first touch D' and A go as without a force, and F is that of the dashpot and of a spring as
  !> strong as the scale r says (kappa = 1 at the turning point).
  pure subroutine guess_compression(normal, known, panel)
    type(normal_type), intent(in) :: normal
    type(panel_type), intent(in) :: known(:) !! panels of the coarser run or the one before; none at first touch
    type(panel_type), intent(inout) :: panel
    real(dp) :: theta(stages)
    if (size(known) > 0) then
      call take_from(known, panel)
      if (all(panel%force(1:) > 0)) return
      panel%force(1:) = max(panel%force(0), tiny(1.0_dp))
    else
      theta = panel%from + point(1:)*(panel%to - panel%from)
      panel%radius(1:) = normal%scale*sin(theta)
      panel%velocity(1:) = cos(theta)
      panel%force(1:) = sin(theta)**3/(2*mass_factor*normal%scale**2) + normal%eta*panel%radius(1:)*panel%velocity(1:)
    end if
  end subroutine guess_compression

  !> After the turning point D' is linear in time. entered: when the edge passed the points in the
  !> compression.
  pure subroutine guess_restitution(normal, known, entered, panel)
    type(normal_type), intent(in) :: normal
    real(dp), intent(in) :: entered(stages)
    type(panel_type), intent(in) :: known(:) !! panels of the coarser run or the one before; none at the turning point
    type(panel_type), intent(inout) :: panel
    real(dp) :: after(stages)
    integer(ip) :: i
    if (size(known) > 0) then
      call take_from(known, panel)
      if (any(panel%pace(1:) <= 0)) panel%pace(1:) = max(panel%pace(0), tiny(1.0_dp))
    else
      do i = 1, stages
        after(i) = first_return(normal%eta, normal%g, normal%rate, panel%time(0) - entered(i))
      end do
      panel%pace(1:) = applied(differential, after)/(panel%from - panel%to)
      panel%pace(1:) = max(panel%pace(1:), guess_part*maxval(panel%pace(1:)))
      panel%velocity(1:) = -mass_factor*panel%force(0)*after
    end if
  end subroutine guess_restitution

  !> Values of the known panels, one after the other from `from` on, at the points of a panel; the
  !> last one is continued.
  pure subroutine take_from(known, panel)
    type(panel_type), intent(in) :: known(:)
    type(panel_type), intent(inout) :: panel
    real(dp) :: weight(0:stages), theta, x
    integer(ip) :: i, p
    p = 1
    do i = 1, stages
      theta = panel%from + point(i)*(panel%to - panel%from)
      do
        x = place_on(known(p), theta)
        if (x <= 1 .or. p == size(known)) exit
        p = p + 1
      end do
      weight = weights_at(x)
      panel%radius(i) = sum(weight*known(p)%radius)
      panel%velocity(i) = sum(weight*known(p)%velocity)
      panel%force(i) = sum(weight*known(p)%force)
      panel%pace(i) = sum(weight*known(p)%pace)
    end do
  end subroutine take_from

  !> When, after the turning point, the edge is back where it was `before` ahead of it while D' is
  !> linear in time: x with (1/2) G_inf (x^2 - before^2) + eta x + sum_k g_k tau_k [x - tau_k +
  !> (before + tau_k) E_k] = 0, E_k = exp(-(x + before)/tau_k). It rises with x; x = before solves
  !> the elastic one.
  pure function first_return(eta, g, rate, before) result(x)
    real(dp), intent(in) :: eta, g(:), rate(:), before
    real(dp) :: x, low, high, excess, slope, z
    integer(ip) :: i, k
    low = 0
    high = before
    x = before
    do i = 1, most_trials
      excess = eta*x
      slope = eta
      do k = 1, size(g, kind=ip)
        z = rate(k)*(x + before)
        if (z < guess_part) then
          excess = excess + g(k)*(x + before)*((x - before)/2 + z*(2*before - x)/6)
          slope = slope + g(k)*x
        else
          excess = excess + g(k)*((x - (1 - exp(-z))/rate(k)) + before*exp(-z))/rate(k)
          slope = slope + g(k)*((1 - exp(-z))/rate(k) - before*exp(-z))
        end if
      end do
      if (excess > 0) high = x
      if (excess <= 0) low = x
      x = x - excess/slope
      if (.not. (x > low .and. x < high)) x = (low + high)/2
      if (abs(excess) <= guess_part*slope*x .or. high - low <= guess_part*high) exit
    end do
  end function first_return
end module rst_guess
