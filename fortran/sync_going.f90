!> The compression of the normal problem as one polynomial (module rst_sync_curve_*).
!>
!> It is smooth in the root of time: s = s_m y^2, with y from 0 at first touch to 1 at the turning point, and with P_k and M_k as in
!> THEORY 4.4 and 4.5
!>   D' = 1 - J(y)/J(1),  J = int_0^y D'' 2y dy,  s_m = -1/J(1),   D = s_m int_0^y D' 2y dy.
!> Memory of few relaxation times is taken with exp(s/tau) in the integrand. Where it is shorter, P_k at the points are the solution
!> of linear equations, and so are M_k but for a part that fades at once, `layer` exp(-s/tau).
module GOING
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: mass_factor, soften, lag_of
  use rst_memory, only: growth_of
  use ELIMINATION, only: solve_again, steps_type, accelerate
  use POINTS, only: p, up, moment
  implicit none (type, external)
  private
  public :: compress, longest, most_sweeps, best_rate

  integer(ip), parameter :: most_sweeps = 30
  real(dp), parameter :: longest = 4.0_dp    !! a phase, in relaxation times, with exp(s/tau) in the integrand
  real(dp), parameter :: kept_within = 0.25_dp !! see solve_again
  real(dp), parameter :: best_rate = 0.15_dp !! of sweeps, that is believed
  real(dp), parameter :: square(p) = up(1:)**2

  !> D of an elastic impact over its largest, s_m over the same, and D', by the series in q = s^(5/2) and one term that lets it turn
  !> round where it does: right to 1e-4. Dashpots let it turn later than that: what the delay adds to D is `bulge`, of slope
  !> `swelling` over y^2, as viscous forces begin with sqrt(s).
  real(dp), parameter :: elastic_time = 0.4_dp*gamma(0.4_dp)*gamma(0.5_dp)/gamma(0.9_dp), time(p) = elastic_time*square
  real(dp), parameter :: q(p) = sqrt(time**5), last = ((1/elastic_time - 1)/q(p) + 1/7.0_dp)/q(p)**2 - 1/(112.0_dp*q(p))
  real(dp), parameter :: elastic(p) = time*(1 - q*(1/7.0_dp - q*(1/112.0_dp + q*last)))
  real(dp), parameter :: slowing(p) = 1 - q*(0.5_dp - q*(6/112.0_dp + q*(8.5_dp*last)))
  real(dp), parameter :: bulge(p) = square*(1 - up(1:)**3)**2, swelling(p) = (1 - up(1:)**3)*(1 - 4*up(1:)**3)

contains

  pure function moments(f) result(sums)
    real(dp), intent(in) :: f(p)
    real(dp) :: sums(p), others(p)
    integer(ip) :: l, n
    sums = 0
    others = 0 ! additions of one sum wait for each other
    do n = 1, p, 2
      !$omp simd
      do l = 1, p
        sums(l) = sums(l) + moment(l, n)*f(n)
        others(l) = others(l) + moment(l, n + 1)*f(n + 1)
      end do
    end do
    sums = sums + others
  end function moments

  !> s_m goes like the force to a negative power, 3/2 for springs; a step of a power of 0.4 takes that into account.
  !> Columns of `going`: D, D', g_k P_k, g_k M_k without the layer. x_kept, inverse: see solve_again. unfinished: what
  !> the last sweep left to be changed, about.
  pure subroutine compress(depth, g_inf, n_terms, g, tau, closeness, turn, going, layer, x_kept, inverse, unfinished, failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: depth, g_inf, g(n_terms), tau(n_terms), closeness
    real(dp), intent(out) :: turn, going(0:p, 2 + 2*n_terms), layer(n_terms)
    real(dp), intent(out) :: x_kept(n_terms), inverse(0:p, 0:p, n_terms), unfinished
    logical, intent(out) :: failed
    real(dp), dimension(p) :: a, d, v, next
    real(dp), dimension(0:p) :: guess, step !! of s_m and forces
    type(steps_type) :: before
    real(dp) :: change, previous, rate, rate_before, excess, part, moved, least
    integer(ip) :: sweep, k, l
    failed = .true.
    x_kept = 0
    going(0, :) = 0
    call start(depth, g_inf, n_terms, g, tau, turn, d, v)
    a = sqrt(d)
    do k = 1, n_terms
      if (turn < longest*tau(k)) then
        going(1:, 2 + k) = g(k)*(2.0_dp/3.0_dp)*d*a/(1 + square*(0.6_dp*turn/tau(k)))
      else
        going(1:, 2 + k) = (g(k)*tau(k))*a*v
        call load(turn, g(k), tau(k), a*v, x_kept(k), inverse(:, :, k), going(1:, 2 + k))
      end if
    end do
    guess(0) = turn
    call press(g_inf, n_terms, d, a, going(:, 3:), guess(1:))
    previous = huge(1.0_dp)
    rate_before = best_rate
    do sweep = 1, most_sweeps
      next = moments(guess(1:))
      part = 1/next(p)
      excess = part/(mass_factor*guess(0)) - 1
      turn = guess(0)*((1 + 0.7_dp*excess)/(1 + 0.3_dp*excess))
      !$omp simd
      do l = 1, p
        v(l) = 1 - next(l)*part
      end do
      next = moments(v)
      change = 0
      least = huge(1.0_dp)
      !$omp simd reduction(max: change) reduction(min: least)
      do l = 1, p
        next(l) = turn*next(l)
        least = min(least, next(l))
        change = max(change, abs(next(l) - d(l)))
        d(l) = next(l)
        a(l) = sqrt(max(d(l), 0.0_dp))
      end do
      change = max(change, abs(turn - guess(0)))*(1/turn)
      if (.not. (least > 0 .and. turn < 2*guess(0))) return
      do k = 1, n_terms
        next = going(1:, 2 + k)
        call load(turn, g(k), tau(k), a*v, x_kept(k), inverse(:, :, k), going(1:, 2 + k))
        moved = 0
        !$omp simd reduction(max: moved)
        do l = 1, p
          moved = max(moved, abs(next(l) - going(l, 2 + k)))
        end do
        change = max(change, moved*turn)
      end do
      rate = max(change/previous, best_rate)
      unfinished = change*min(max(rate, rate_before), 1.0_dp)
      if (sweep > 1 .and. unfinished < closeness) exit
      rate_before = rate
      previous = change
      step(0) = turn
      call press(g_inf, n_terms, d, a, going(:, 3:), step(1:))
      step = step - guess
      call accelerate(step, before, guess)
    end do
    if (sweep > most_sweeps) return
    failed = .false.
    going(0, 2) = 1
    going(1:, 1) = d
    going(1:, 2) = v
    do k = 1, n_terms
      call remember(turn, g(k), tau(k), going(:, 2), x_kept(k), inverse(:, :, k), &
                    going(:, 2 + n_terms + k), layer(k))
    end do
  end subroutine compress

  !> s_m, D and D', nearly: what an elastic impact would do, and what dashpots change, by their share of the force.
  pure subroutine start(depth, g_inf, n_terms, g, tau, turn, d, v)
    real(dp), intent(in) :: depth, g_inf
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms)
    real(dp), intent(out) :: turn, d(p), v(p)
    real(dp) :: stiffness, viscosity, part, lag, largest, delay
    call soften(g_inf, 0.0_dp, n_terms, g, tau, depth, stiffness, viscosity)
    part = viscosity/(stiffness*depth)
    lag = lag_of(n_terms, g, tau, depth)/depth
    turn = depth*(elastic_time + part*(0.29_dp - 0.42_dp*lag/(lag + 0.17_dp))/(1 + 0.13_dp*part))
    largest = depth*(1 - 0.085_dp*part/(0.25_dp + part))
    delay = turn/largest - elastic_time
    d = largest*(elastic + delay*bulge)
    v = (largest/turn)*(elastic_time*slowing + delay*swelling)
  end subroutine start

  !> Forces at the points.
  pure subroutine press(g_inf, n_terms, d, a, held, force)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, d(p), a(p), held(0:p, n_terms)
    real(dp), intent(out) :: force(p)
    integer(ip) :: k, l
    !$omp simd
    do l = 1, p
      force(l) = a(l)*((2.0_dp/3.0_dp)*g_inf*d(l))
    end do
    do k = 1, n_terms
      !$omp simd
      do l = 1, p
        force(l) = force(l) + held(l, k)
      end do
    end do
  end subroutine press

  !> g int_0^s exp(-(s-r)/tau) f dr at the points.
  pure subroutine load(turn, g, tau, f, x_kept, inverse, held)
    real(dp), intent(in) :: turn, g, tau, f(p)
    real(dp), intent(inout) :: x_kept, inverse(0:p, 0:p), held(p)
    real(dp) :: growth(p), lasts
    integer(ip) :: l
    lasts = turn/tau
    if (lasts < longest) then
      !$omp simd
      do l = 1, p
        growth(l) = growth_of(square(l)*lasts)
      end do
      held = (g*turn)*moments(f*growth)/growth
    else
      call solve_again(p, moment, tau/turn, (g*tau)*moments(f), kept_within, x_kept, inverse, held)
    end if
  end subroutine load

  !> The same of the speed v, without the layer where there is one, that of the speed at first touch.
  pure subroutine remember(turn, g, tau, v, x_kept, inverse, memory, layer)
    real(dp), intent(in) :: turn, g, tau, v(0:p)
    real(dp), intent(inout) :: x_kept, inverse(0:p, 0:p)
    real(dp), intent(out) :: memory(0:p), layer
    layer = 0
    memory = 0
    if (turn < longest*tau) then
      call load(turn, g, tau, v(1:), x_kept, inverse, memory(1:))
    else
      layer = -g*tau
      x_kept = 0 ! nothing has been solved before
      call solve_again(p, moment, tau/turn, (g*tau)*moments(v(1:) - 1), kept_within, x_kept, inverse, memory(1:))
      memory = memory - layer
    end if
  end subroutine remember
end module GOING
