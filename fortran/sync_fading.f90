!> The restitution of the normal problem as one polynomial (module rst_sync_curve_*).
!>
!> The motion is smooth in time, and in the root of the time that is left: s = s_m + T (1 - z^2), z from 1 at the turning point to
!> 0. So is the edge of contact there but for what is felt of springs that relax at once, while as a function of the edge time has a
!> sharp bend where dashpots rule, behind the turning point. So unknown are the squares B of the edge at Chebyshev's points in z,
!> and T. Edges are free (THEORY 4.5) where
!>   G_inf (D - B) + sum_k (M_k - E_k M_k(t)) = 0,     int f dX = (2/3) G_inf B^(3/2) + sum_k E_k P_k(t),
!> t(B) being when the compression had that edge and E_k = exp(-(s-t)/tau_k). Where E_k is felt t is found with B, in terms of
!> (1 - t/s_m)^2, which is to B as 1 to 1 nearly, at the turning point too. What the edges lack of being free gives Newton's step of
!> B and T; forces follow, from them the motion.
module FADING
  use rst_precision, only: dp, ip
  use rst_sync_grid, only: mass_factor, soften
  use rst_memory, only: growth_of
  use ELIMINATION, only: solve_again, steps_type, accelerate
  use POINTS, only: p, down, back, curl
  use GOING, only: longest, most_sweeps, best_rate
  implicit none (type, external)
  private
  public :: retreat

  real(dp), parameter :: passed(p) = 1 - down(1:)**2 !! time since the turning point over T
  real(dp), parameter :: prolonged = 0.35_dp         !! restitution, by how many delays
  real(dp), parameter :: kept_within = 0.04_dp       !! see solve_again
  real(dp), parameter :: felt_until = 36             !! relaxation times
  integer(ip), parameter :: soon = 6                 !! sweeps after which no more than this part is to change
  real(dp), parameter :: still = 0.01_dp

  !> The edges at the points: time before the turning point at which the compression had them over s_m, and its square; their
  !> squares and radii; D' then.
  type :: edges_type
    real(dp), dimension(p) :: ago_2, ago, square, radius, speed
    real(dp) :: polynomials(p, 0:p) !! at their y
  end type edges_type

contains

  !> delay, lead: see turn_round. going: of the compression; its last row is all that there is at the turning point. loading:
  !> series, layer: what its M_k have beside them. Columns of `coming`: B, D, D', g_k M_k without left(k)*exp(-(s-s_m)/tau_k).
  !> x_kept, inverse: see solve_again.
  pure subroutine retreat(g_inf, n_terms, g, tau, closeness, turn, going, loading, layer, x_kept, inverse, delay, lead, &
                          lasts, coming, left, unfinished, failed)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, g(n_terms), tau(n_terms), closeness, turn, going(0:p, 2 + 2*n_terms)
    real(dp), intent(in) :: loading(0:p, 2 + 2*n_terms), layer(n_terms)
    real(dp), intent(out) :: x_kept(n_terms), inverse(0:p, 0:p, n_terms), delay, lead, lasts
    real(dp), intent(out) :: coming(0:p, 3 + n_terms), left(n_terms), unfinished
    logical, intent(out) :: failed
    type(edges_type) :: edges
    real(dp) :: force(0:p), excess(p), stiffness(p), rate(p), later, change, previous, part, part_before, least, longest_tau
    real(dp), dimension(0:p) :: guess, step !! of T and B
    type(steps_type) :: before
    integer(ip) :: sweep, l
    call turn_round(g_inf, n_terms, g, tau, turn, going(p, 1), delay, lead, lasts, edges)
    coming(0, 2) = going(p, 1)
    coming(:, 3:) = 0
    x_kept = 0
    force(0) = -mass_factor*((2.0_dp/3.0_dp)*g_inf*going(p, 1)*sqrt(going(p, 1)) + sum(going(p, 3:2 + n_terms)))
    failed = .true.
    previous = huge(1.0_dp)
    part_before = best_rate
    least = 0
    longest_tau = 0
    if (n_terms > 0) longest_tau = maxval(tau)
    do sweep = 1, most_sweeps
      least = max(least, lasts*passed(1) + turn*edges%ago(1))
      if (sweep == 1 .or. least < felt_until*longest_tau) call find_edges(loading, edges)
      call weigh(g_inf, n_terms, g, tau, least, turn, lasts, loading, layer, edges, force(1:), excess, stiffness, rate)
      call move(g_inf, n_terms, g, tau, lasts, force, going, x_kept, inverse, coming, left, excess, rate)
      if (.not. rate(p) < 0) return
      later = max(-0.3_dp*lasts, min(0.3_dp*lasts, -excess(p)/rate(p)))
      step(0) = later
      step(1:p - 1) = (excess(:p - 1) + rate(:p - 1)*passed(:p - 1)*later)/stiffness(:p - 1)
      step(p) = 0
      change = abs(step(0))
      !$omp simd reduction(max: change)
      do l = 1, p
        change = max(change, abs(step(l)))
      end do
      change = change*(1/turn)
      if (.not. change < 1) return
      part = max(change/previous, best_rate)
      if (sweep > soon .and. change > still) return
      unfinished = change*min(max(part, part_before), 1.0_dp)
      if (sweep > 1 .and. unfinished < closeness) exit
      part_before = part
      previous = change
      guess(0) = lasts
      guess(1:) = edges%square
      call accelerate(step, before, guess)
      lasts = guess(0)
      call shift_edges(least < felt_until*longest_tau, turn, guess(1:), edges)
    end do
    if (sweep > most_sweeps) return
    failed = .false.
    coming(0, 1) = going(p, 1)
    lasts = lasts + later
    coming(1:, 1) = edges%square
    call shift(n_terms, g, tau, later, force, coming)
  end subroutine retreat

  !> Nearly what a Kelvin-Voigt solid of that stiffness and viscosity would do if the force stayed as it is at the turning point:
  !> with delay = viscosity/stiffness it is (s - s_m + delay)^2 = (s_m - t)^2 + delay^2. Forces fall, and so
  !> edges are ahead of that, by `lead`, where springs settle at once.
  pure subroutine turn_round(g_inf, n_terms, g, tau, turn, depth, delay, lead, lasts, edges)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, g(n_terms), tau(n_terms), turn, depth
    real(dp), intent(out) :: delay, lead, lasts
    type(edges_type), intent(out) :: edges
    real(dp) :: stiffness, viscosity, part, settling
    integer(ip) :: k, l
    call soften(g_inf, 0.0_dp, n_terms, g, tau, depth, stiffness, viscosity)
    delay = viscosity/stiffness
    lasts = turn + prolonged*delay
    part = 2*delay/lasts
    settling = 0
    do k = 1, n_terms
      settling = settling + min(3.0_dp, turn/tau(k))*tau(k)*(g(k)*tau(k))/viscosity
    end do
    lead = 0.65_dp*delay/(delay + settling + tiny(1.0_dp))
    !$omp simd
    do l = 1, p
      edges%ago_2(l) = passed(l)*((passed(l) + part)/(1 + part) + lead*part*passed(l)*(1 - passed(l))/(passed(l) + 0.06_dp))
      edges%ago_2(l) = min(edges%ago_2(l), 1.0_dp)
      edges%ago(l) = sqrt(edges%ago_2(l))
    end do
  end subroutine turn_round

  !> Chebyshev's polynomials at the y of the edges.
  pure subroutine place(edges)
    type(edges_type), intent(inout) :: edges
    integer(ip) :: l, k
    associate (t => edges%polynomials)
      !$omp simd
      do l = 1, p
        t(l, 0) = 1
        t(l, 1) = 2*sqrt(max(0.0_dp, 1 - edges%ago(l))) - 1
      end do
      do k = 2, p
        !$omp simd
        do l = 1, p
          t(l, k) = 2*t(l, 1)*t(l, k - 1) - t(l, k - 2)
        end do
      end do
    end associate
  end subroutine place

  pure function summed(c, t) result(f)
    real(dp), intent(in) :: c(0:p), t(p, 0:p)
    real(dp) :: f(p), others(p)
    integer(ip) :: l, k
    f = c(0)
    others = 0
    do k = 1, p, 2
      !$omp simd
      do l = 1, p
        f(l) = f(l) + c(k)*t(l, k)
        others(l) = others(l) + c(k + 1)*t(l, k + 1)
      end do
    end do
    f = f + others
  end function summed

  pure subroutine find_edges(loading, edges)
    real(dp), intent(in) :: loading(0:p, 2)
    type(edges_type), intent(inout) :: edges
    integer(ip) :: l
    call place(edges)
    edges%radius = summed(loading(:, 1), edges%polynomials)
    edges%speed = summed(loading(:, 2), edges%polynomials)
    !$omp simd
    do l = 1, p
      edges%radius(l) = (0.5_dp*(1 + edges%polynomials(l, 1)))*edges%radius(l)
      edges%square(l) = edges%radius(l)**2
    end do
  end subroutine find_edges

  !> Forces, by edges as they are; of what the edges lack of being free that part which they have from the compression, its slope in
  !> B, and in time.
  pure subroutine weigh(g_inf, n_terms, g, tau, least, turn, lasts, loading, layer, edges, force, excess, stiffness, rate)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, g(n_terms), tau(n_terms), turn, lasts, loading(0:p, 2 + 2*n_terms), layer(n_terms)
    real(dp), intent(in) :: least !! time between the turning point and the next, and as long before it
    type(edges_type), intent(in) :: edges
    real(dp), dimension(p), intent(out) :: force, excess, stiffness, rate
    real(dp) :: held(p), kept(p), fading(p)
    integer(ip) :: k, l
    !$omp simd
    do l = 1, p
      force(l) = (2.0_dp/3.0_dp)*g_inf*edges%square(l)*edges%radius(l)
      excess(l) = -g_inf*edges%square(l)
      stiffness(l) = g_inf
      rate(l) = 0
    end do
    do k = 1, n_terms
      if (least >= felt_until*tau(k)) cycle
      held = summed(loading(:, 2 + k), edges%polynomials)
      kept = summed(loading(:, 2 + n_terms + k), edges%polynomials)
      if (turn > longest*tau(k) .and. turn < felt_until*tau(k)) then
        !$omp simd
        do l = 1, p
          kept(l) = kept(l) + layer(k)/growth_of((turn*(1 - edges%ago(l)))*(1/tau(k)))
        end do
      end if
      !$omp simd
      do l = 1, p
        fading(l) = 1/growth_of((lasts*passed(l) + turn*edges%ago(l))*(1/tau(k)))
        kept(l) = fading(l)*kept(l)
        force(l) = force(l) + fading(l)*held(l)
        excess(l) = excess(l) - kept(l)
        stiffness(l) = stiffness(l) + fading(l)*g(k)
        rate(l) = rate(l) + kept(l)*(1/tau(k))
      end do
    end do
  end subroutine weigh

  !> The motion by the forces, and the rest of what the edges lack; force: then D''.
  pure subroutine move(g_inf, n_terms, g, tau, lasts, force, going, x_kept, inverse, coming, left, excess, rate)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g_inf, g(n_terms), tau(n_terms), lasts, going(0:p, 2 + 2*n_terms)
    real(dp), intent(inout) :: force(0:p), coming(0:p, 3 + n_terms), left(n_terms), excess(p), rate(p)
    real(dp), intent(inout) :: x_kept(n_terms), inverse(0:p, 0:p, n_terms)
    real(dp) :: held(p)
    integer(ip) :: k, l
    force(1:) = -mass_factor*force(1:)
    coming(1:, 3) = lasts*returned(force(:p - 1))
    coming(1:, 2) = coming(0, 2) + lasts*returned(coming(:p - 1, 3))
    !$omp simd
    do l = 1, p
      excess(l) = excess(l) + g_inf*coming(l, 2)
      rate(l) = rate(l) + g_inf*coming(l, 3)
    end do
    do k = 1, n_terms
      call remember(lasts, g(k), tau(k), coming(:, 3), going(p, 2 + n_terms + k), x_kept(k), inverse(:, :, k), &
                    coming(:, 3 + k), left(k))
      held = coming(1:, 3 + k)
      if (lasts > longest*tau(k) .and. lasts*passed(1) < felt_until*tau(k)) then
        !$omp simd
        do l = 1, p
          held(l) = held(l) + left(k)/growth_of(lasts*passed(l)*(1/tau(k)))
        end do
      end if
      !$omp simd
      do l = 1, p
        excess(l) = excess(l) + held(l)
        rate(l) = rate(l) + (g(k)*coming(l, 3) - held(l)*(1/tau(k)))
      end do
    end do
  end subroutine move

  !> Integrals in the restitution over T by values from the turning point on; nothing comes from the last point.
  pure function returned(f) result(sums)
    real(dp), intent(in) :: f(0:p - 1)
    real(dp) :: sums(p), others(p)
    integer(ip) :: l, n
    sums = 0
    others = 0 ! see moments
    do n = 0, p - 1, 2
      !$omp simd
      do l = 1, p
        sums(l) = sums(l) + back(l, n)*f(n)
        others(l) = others(l) + back(l, n + 1)*f(n + 1)
      end do
    end do
    sums = sums + others
  end function returned

  !> g M at the points from `start` at the turning point on, without the layer where there is one.
  pure subroutine remember(lasts, g, tau, v, start, x_kept, inverse, memory, layer)
    real(dp), intent(in) :: lasts, g, tau, v(0:p), start
    real(dp), intent(inout) :: x_kept, inverse(0:p, 0:p), memory(0:p)
    real(dp), intent(out) :: layer
    real(dp) :: growth(p)
    integer(ip) :: l
    layer = 0
    if (lasts < longest*tau) then
      !$omp simd
      do l = 1, p
        growth(l) = growth_of(lasts*passed(l)*(1/tau))
      end do
      memory(0) = start
      memory(1:) = (start + (g*lasts)*returned([v(0), v(1:p - 1)*growth(:p - 1)]))/growth
    else
      call solve_again(p + 1, curl, lasts/tau, (g*lasts)*v, kept_within, x_kept, inverse, memory)
      layer = start - memory(0)
    end if
  end subroutine remember

  !> Move the edges to where their squares are as guessed.
  pure subroutine shift_edges(felt, turn, guess, edges)
    logical, intent(in) :: felt
    real(dp), intent(in) :: turn, guess(p)
    type(edges_type), intent(inout) :: edges
    real(dp) :: step
    integer(ip) :: l
    !$omp simd private(step)
    do l = 1, p - 1
      step = max(guess(l), 0.25_dp*edges%square(l)) - edges%square(l)
      edges%square(l) = edges%square(l) + step
      edges%radius(l) = sqrt(edges%square(l))
      if (felt) edges%ago_2(l) = min(1.0_dp, max(0.2_dp*edges%ago_2(l), &
                                                 edges%ago_2(l) - step*2*edges%ago(l)/(turn*edges%speed(l))))
      edges%ago(l) = sqrt(edges%ago_2(l))
    end do
  end subroutine shift_edges

  !> The times of the points were moved after the motion was found.
  pure subroutine shift(n_terms, g, tau, later, force, coming)
    integer(ip), intent(in) :: n_terms
    real(dp), intent(in) :: g(n_terms), tau(n_terms), later, force(0:p)
    real(dp), intent(inout) :: coming(0:p, 3 + n_terms)
    integer(ip) :: k
    do k = 1, n_terms
      coming(1:, 3 + k) = coming(1:, 3 + k) + later*passed*(g(k)*coming(1:, 3) - coming(1:, 3 + k)*(1/tau(k)))
    end do
    coming(1:, 2) = coming(1:, 2) + later*passed*coming(1:, 3)
    coming(1:, 3) = coming(1:, 3) + later*passed*force(1:)
  end subroutine shift
end module FADING
