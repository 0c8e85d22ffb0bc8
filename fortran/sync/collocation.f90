!> Collocation on one panel: Radau's points, integrals of the polynomials through them,
!> interpolation, and small linear systems.
!>
!> A panel is 0 <= x <= 1. A function of it is known by its value at x = 0 and at the `stages`
!> points of Radau (docs/sync.md). An initial value problem y' = h f(y) is solved where y_i = y_0 +
!> h sum_j integral(i, j) f_j: Radau IIA, which is of order 2 stages - 1 at the end of the panel and
!> damps whatever decays within it (L-stable).
module rst_collocation
  use rst_precision, only: dp, ip
  use rst_tuning, only: most_trials, stagnates_below, stagnates_at
  implicit none (type, external)
  private
  public :: stages, point, integral, differential, weights_at, value_on, last_coefficient, integrated, start_of, root_between
  public :: shifted_inverse
  public :: applied, composed, factors_type, factorize, solution_of, has_converged

  integer(ip), parameter :: stages = 6

  !> The start of the panel and Radau's points: zeros of P_6 - P_5, Legendre's polynomials in 2x -
  !> 1.
  real(dp), parameter :: point(0:stages) = [0.0_dp, 3.98098570514687430e-02_dp, 1.98013417873608183e-01_dp, &
                         4.37974810247386159e-01_dp, 6.95464273353636142e-01_dp, 9.01464914201173584e-01_dp, 1.0_dp]

  !> integral(i, j): int_0^x_i of the polynomial that is 1 at point j and 0 at the other points,
  !> without x = 0.
  real(dp), parameter :: integral(stages, stages) = reshape([ &
    5.09500109946406099e-02_dp, 1.08221658919058661e-01_dp, 9.77796700926453488e-02_dp, &
    1.02122375612933844e-01_dp, 1.00331001384960802e-01_dp, 1.00794192626740414e-01_dp, &
    -1.89073065542921387e-02_dp, 1.06975519937332605e-01_dp, 2.23172250636895830e-01_dp, &
    2.02975957373091070e-01_dp, 2.10247308553338452e-01_dp, 2.08450667155953867e-01_dp, &
    1.36860714330882295e-02_dp, -2.75390233553924196e-02_dp, 1.36314679273051881e-01_dp, &
    2.76399136380747812e-01_dp, 2.56085372050337601e-01_dp, 2.60463391594787486e-01_dp, &
    -1.03700387660460459e-02_dp, 1.74967471412281611e-02_dp, -2.96469659881962166e-02_dp, &
    1.31006023136042982e-01_dp, 2.53365934704565643e-01_dp, 2.42693594234484972e-01_dp, &
    7.36065639663980361e-03_dp, -1.16537218911955866e-02_dp, 1.63585788434371590e-02_dp, &
    -2.48763031998222861e-02_dp, 9.24305343356996018e-02_dp, 1.59820376610255471e-01_dp, &
    -2.90953645256171456e-03_dp, 4.51223712257675397e-03_dp, -6.00340261044787597e-03_dp, &
    7.83708405064264743e-03_dp, -1.09952368277285543e-02_dp, 2.77777777777777762e-02_dp], [stages, stages])

  !> The inverse of `integral`: differential(i, j) is the slope at x_i of the polynomial that is 1
  !> at point j and 0 at the others and at x = 0.
  real(dp), parameter :: differential(stages, stages) = reshape([ &
    1.25597034762915083e+01_dp, -9.80283871256801653e+00_dp, 5.18215783855871859e+00_dp, &
    -4.10823909345880711e+00_dp, 4.38578506340093455e+00_dp, -9.94297742192881095e+00_dp, &
    4.07582598887629555e+00_dp, 2.52508140796372516e+00_dp, -5.54452290952743798e+00_dp, &
    3.49150290911386163e+00_dp, -3.46400504745148874e+00_dp, 7.67606215723304786e+00_dp, &
    -1.21720380846426046e+00_dp, 3.13222586264734160e+00_dp, 1.14161816684749406e+00_dp, &
    -5.06987875099360696e+00_dp, 3.95154245658761161e+00_dp, -8.23273712821840675e+00_dp, &
    5.66231866944142515e-01_dp, -1.15740999277438084e+00_dp, 2.97497625382125097e+00_dp, &
    7.18944191897770368e-01_dp, -6.81053943889144531e+00_dp, 1.16387072773680202e+01_dp, &
    -3.07104212256840814e-01_dp, 5.83382192454110382e-01_dp, -1.17801932705882950e+00_dp, &
    3.46004179608626705e+00_dp, 5.54652756999501451e-01_dp, -2.56390548844538486e+01_dp, &
    1.09086010788007282e-01_dp, -2.02547698469053405e-01_dp, 3.84542362009172578e-01_dp, &
    -9.26443110403131875e-01_dp, 4.01713280695131214e+00_dp, 1.85000000000000000e+01_dp], [stages, stages])

  !> 1/prod(point_j - point_k): the barycentric weights; sum_j weight_j y_j is the coefficient of
  !> x^stages.
  real(dp), parameter :: barycentric(0:stages) = [4.62e2_dp, -7.35130466231380069e+02_dp, 4.74019611732518399e+02_dp, &
                         -3.56279434793616133e+02_dp, 2.72918967701194731e+02_dp, -1.94528678408716956e+02_dp, 7.7e1_dp]

  !> Of a matrix: what elimination takes off its rows, what is left of them, and which row is
  !> exchanged for which.
  type :: factors_type
    real(dp), dimension(stages, stages) :: lower, upper
    integer(ip) :: pivot(stages)
  end type factors_type

contains

  !> The polynomial through y has the value sum(weight*y) at x: Lagrange's products over all other
  !> points. At a point it is the value there to the last bit: weights are scaled to the sum 1,
  !> which they have but for rounding.
  pure function weights_at(x) result(weight)
    real(dp), intent(in) :: x
    real(dp) :: weight(0:stages), a(0:stages), first, middle, last
    a = x - point
    first = a(0)*a(1)
    middle = a(2)*a(3)*a(4)
    last = a(5)*a(6)
    weight = barycentric*[a(1)*(middle*last), a(0)*(middle*last), a(3)*a(4)*(first*last), a(2)*a(4)*(first*last), &
                          a(2)*a(3)*(first*last), a(6)*(first*middle), a(5)*(first*middle)]
    weight = weight*(2 - (((weight(0) + weight(1)) + (weight(2) + weight(3))) + ((weight(4) + weight(5)) + weight(6))))
  end function weights_at

  !> The polynomial through y at x.
  pure function value_on(x, y) result(value)
    real(dp), intent(in) :: x, y(0:stages)
    real(dp) :: value
    value = sum(weights_at(x)*y)
  end function value_on

  !> The last coefficient of y in Chebyshev's polynomials on the panel: about what a polynomial of
  !> one degree less misses.
  pure function last_coefficient(y) result(c)
    real(dp), intent(in) :: y(0:stages)
    real(dp) :: c
    c = abs(sum(barycentric*y))/2.0_dp**(2*stages - 1)
  end function last_coefficient

  !> start + int_0^x_i y dx at the points.
  pure function integrated(start, y) result(total)
    real(dp), intent(in) :: start, y(stages)
    real(dp) :: total(stages)
    total = start + applied(integral, y)
  end function integrated

  !> The matrix a of six columns, applied to y. (Compilers may call a library for matmul; a sum
  !> written out stays in registers.)
  pure function applied(a, y) result(z)
    real(dp), intent(in) :: a(stages, stages), y(stages)
    real(dp) :: z(stages)
    z = a(:, 1)*y(1) + a(:, 2)*y(2) + a(:, 3)*y(3) + a(:, 4)*y(4) + a(:, 5)*y(5) + a(:, 6)*y(6)
  end function applied

  pure function composed(a, b) result(c)
    real(dp), intent(in), dimension(stages, stages) :: a, b
    real(dp) :: c(stages, stages)
    integer(ip) :: j
    do j = 1, stages
      c(:, j) = applied(a, b(:, j))
    end do
  end function composed

  !> At the start of the panel, the polynomial through the values at the points alone.
  pure function start_of(y) result(start)
    real(dp), intent(in) :: y(stages)
    real(dp) :: start
    start = -sum(barycentric(1:)*y)/barycentric(0)
  end function start_of

  !> (differential + diagonal)^-1 for a diagonal that is nowhere negative, by elimination in place.
  !> Without pivots: Radau's matrix is positive definite but for a scale of its rows (diagonally
  !> stable, Hairer and Wanner), so that none is zero.
  pure function shifted_inverse(diagonal) result(a)
    real(dp), intent(in) :: diagonal(stages)
    real(dp) :: a(stages, stages), column(stages), row(stages)
    integer(ip) :: j, k
    a = differential
    do k = 1, stages
      a(k, k) = a(k, k) + diagonal(k)
    end do
    do k = 1, stages
      row = a(k, :)*(1/a(k, k))
      row(k) = 1/a(k, k)
      column = a(:, k)
      column(k) = 0
      a(:, k) = 0
      do j = 1, stages
        a(:, j) = a(:, j) - column*row(j)
      end do
      a(k, :) = row
    end do
  end function shifted_inverse

  !> A zero of the polynomial through y between the points i - 1 and i, where it changes its sign:
  !> the secant's, halved where that hardly moves.
  pure function root_between(i, y) result(x)
    integer(ip), intent(in) :: i
    real(dp), intent(in) :: y(0:stages)
    real(dp) :: x, low, high, at_low, at_high, now
    integer(ip) :: n
    low = point(i - 1)
    high = point(i)
    at_low = y(i - 1)
    at_high = y(i)
    do n = 1, most_trials
      x = low - at_low*(high - low)/(at_high - at_low)
      if (modulo(n, 3_ip) == 0 .or. .not. (x > low .and. x < high)) x = 0.5_dp*(low + high)
      now = sum(weights_at(x)*y)
      if (now*at_high > 0) then
        high = x
        at_high = now
      else
        low = x
        at_low = now
      end if
      if (high - low <= epsilon(x) .or. .not. abs(now) > 0) exit
    end do
  end function root_between

  !> Whether Newton's steps end: the next change, predicted from the last two, is below closeness,
  !> or rounding keeps it from falling.
  pure function has_converged(change, previous, closeness) result(yes)
    real(dp), intent(in) :: change, previous, closeness
    logical :: yes
    yes = change*min(1.0_dp, change/previous) < closeness .or. (change < stagnates_below .and. change > stagnates_at*previous)
  end function has_converged

  !> Factors of a matrix by elimination with pivots. fails: it is singular or not finite.
  pure subroutine factorize(a, factors, fails)
    real(dp), intent(in) :: a(stages, stages)
    type(factors_type), intent(out) :: factors
    logical, intent(out) :: fails
    real(dp) :: part(stages), row(stages)
    integer(ip), parameter :: below(stages) = [1_ip, 2_ip, 3_ip, 4_ip, 5_ip, 6_ip]
    integer(ip) :: j, k, p
    factors%upper = a
    fails = .true.
    associate (u => factors%upper)
      do k = 1, stages
        p = k
        do j = k + 1, stages
          if (abs(u(j, k)) > abs(u(p, k))) p = j
        end do
        if (.not. (abs(u(p, k)) > 0 .and. abs(u(p, k)) <= huge(1.0_dp))) return
        factors%pivot(k) = p
        if (p /= k) then
          row = u(k, :)
          u(k, :) = u(p, :)
          u(p, :) = row
        end if
        part = merge(u(:, k)*(1/u(k, k)), 0.0_dp, below > k) ! none of rows that are done: whole columns are faster than parts
        do j = k + 1, stages
          u(:, j) = u(:, j) - part*u(k, j)
        end do
        factors%lower(:, k) = part
      end do
    end associate
    fails = .false.
  end subroutine factorize

  !> x with a x = b, from the factors of a.
  pure function solution_of(factors, b) result(x)
    type(factors_type), intent(in) :: factors
    real(dp), intent(in) :: b(stages)
    real(dp) :: x(stages), rest(stages), one
    integer(ip) :: k
    rest = b
    do k = 1, stages
      one = rest(factors%pivot(k))
      rest(factors%pivot(k)) = rest(k)
      rest(k) = one
      rest = rest - factors%lower(:, k)*one
    end do
    do k = stages, 1, -1
      x(k) = rest(k)/factors%upper(k, k)
      rest = rest - factors%upper(:, k)*x(k)
    end do
  end function solution_of
end module rst_collocation
