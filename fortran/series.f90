!> Two generalised Maxwell chains in series, as one chain: what two bodies of unlike materials are to each other (THEORY 9).
!>
!> With the operational modulus M(s) = m_inf + sum_k m_k s/(s + p_k) + eta s, p_k = 1/tau_k, compliances add:
!> 1/M = 1/M_1 + 1/M_2. The relaxation rates of the pair are the zeros x of F(x) = M_1(-x) + M_2(-x). F falls from +inf to
!> -inf between neighbouring rates of the two chains taken together, so that exactly one zero lies between two of them; one
!> more lies below the lowest if F(0) = m_inf1 + m_inf2 > 0, and one above the highest if eta_1 + eta_2 > 0. A rate that both chains
!> share is one of the pair, too.
module rst_series
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: chain_type, series_chain

  !> Size and ends of a chain. Twin of `struct rst_chain` in C; its terms come as arrays, tau ascending.
  type, bind(c) :: chain_type
    real(dp) :: m_inf, eta
    integer(ip) :: n
  end type chain_type

contains

  !> Chains a and b in series: `pair` has at most a%n + b%n + 1 terms, tau ascending. `rate`, `from_a` and `from_b` are workspace:
  !> the rates of both chains, ascending, and the term of each chain that has that rate, 0 for none.
  pure subroutine series_chain(a, m_a, tau_a, b, m_b, tau_b, rate, from_a, from_b, pair, m, tau)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n)
    real(dp), intent(out) :: rate(a%n + b%n)
    integer(ip), intent(out) :: from_a(a%n + b%n), from_b(a%n + b%n)
    type(chain_type), intent(out) :: pair
    real(dp), intent(out) :: m(a%n + b%n + 1), tau(a%n + b%n + 1)
    integer(ip) :: n_rates, i
    real(dp) :: low, high

    pair%m_inf = in_series(a%m_inf, b%m_inf)
    pair%eta = in_series(a%eta, b%eta)
    pair%n = 0
    call merge_rates(a%n, tau_a, b%n, tau_b, rate, from_a, from_b, n_rates)
    if (a%eta + b%eta > 0) then  ! the zero above the highest rate; none if both chains have a dashpot and nothing else
      low = 0
      if (n_rates > 0) low = rate(n_rates)
      if (n_rates > 0 .or. a%m_inf + b%m_inf > 0) then
        high = upper_end(a, m_a, tau_a, b, m_b, tau_b, low)
        call add_zero(a, m_a, tau_a, b, m_b, tau_b, low, high, pair, m, tau)
      end if
    end if
    do i = n_rates, 1, -1
      if (from_a(i) > 0 .and. from_b(i) > 0) then
        call add_term(in_series(m_a(from_a(i)), m_b(from_b(i))), rate(i), a%n + b%n + 1, pair, m, tau)
      end if
      low = 0
      if (i > 1) low = rate(max(i - 1, 1_ip))
      if (i > 1 .or. a%m_inf + b%m_inf > 0) then
        call add_zero(a, m_a, tau_a, b, m_b, tau_b, low, rate(i), pair, m, tau)
      end if
    end do
  end subroutine series_chain

  pure function in_series(x, y) result(z)
    real(dp), intent(in) :: x, y
    real(dp) :: z
    z = 0
    if (x > 0 .and. y > 0) z = x/(x + y)*y
  end function in_series

  !> tau ascends, so the rates are read from behind.
  pure subroutine merge_rates(n_a, tau_a, n_b, tau_b, rate, from_a, from_b, n)
    integer(ip), intent(in) :: n_a, n_b
    real(dp), intent(in) :: tau_a(n_a), tau_b(n_b)
    real(dp), intent(out) :: rate(n_a + n_b)
    integer(ip), intent(out) :: from_a(n_a + n_b), from_b(n_a + n_b), n
    integer(ip) :: i, j
    real(dp) :: next_a, next_b
    i = n_a
    j = n_b
    n = 0
    do while (i > 0 .or. j > 0)
      next_a = 0
      next_b = 0
      if (i > 0) next_a = tau_a(i)
      if (j > 0) next_b = tau_b(j)
      n = n + 1
      rate(n) = 1/max(next_a, next_b)
      from_a(n) = 0
      from_b(n) = 0
      if (next_a >= next_b) then
        from_a(n) = i
        i = i - 1
      end if
      if (next_b >= next_a) then
        from_b(n) = j
        j = j - 1
      end if
    end do
  end subroutine merge_rates

  !> M(-x) = m_inf - eta x + sum m_k x/(x - p_k), and its derivative with respect to s = -x.
  pure subroutine evaluate(chain, m, tau, x, value, slope)
    type(chain_type), intent(in) :: chain
    real(dp), intent(in) :: m(chain%n), tau(chain%n), x
    real(dp), intent(out) :: value, slope
    integer(ip) :: k
    real(dp) :: away
    value = chain%m_inf - chain%eta*x
    slope = chain%eta
    do k = 1, chain%n
      away = x*tau(k) - 1  ! (x - p) tau
      value = value + m(k)*(x*tau(k)/away)
      slope = slope + m(k)*(tau(k)/away)/away
    end do
  end subroutine evaluate

  pure function sum_at(a, m_a, tau_a, b, m_b, tau_b, x) result(total)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n), x
    real(dp) :: total
    real(dp) :: value_a, value_b, slope
    call evaluate(a, m_a, tau_a, x, value_a, slope)
    call evaluate(b, m_b, tau_b, x, value_b, slope)
    total = value_a + value_b
  end function sum_at

  !> Some x above the highest zero: F -> -eta x there.
  pure function upper_end(a, m_a, tau_a, b, m_b, tau_b, low) result(x)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n), low
    real(dp) :: x
    x = max(2*low, (a%m_inf + b%m_inf)/(a%eta + b%eta))
    do while (sum_at(a, m_a, tau_a, b, m_b, tau_b, x) > 0)
      x = 2*x
    end do
  end function upper_end

  !> The zero of F between low and high, by bisection on x - low, which keeps all its digits where the zero is close to a
  !> rate. F falls. The residue of M there is -M_1^2/(M_1' + M_2'), hence m = M_1^2/(x (M_1' + M_2')).
  pure subroutine add_zero(a, m_a, tau_a, b, m_b, tau_b, low, high, pair, m, tau)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n), low, high
    type(chain_type), intent(inout) :: pair
    real(dp), intent(inout) :: m(a%n + b%n + 1), tau(a%n + b%n + 1)
    real(dp) :: left, right, x, value_a, value_b, slope_a, slope_b, modulus
    integer(ip) :: i
    left = low
    right = high
    do i = 1, 2000
      x = middle(left, right)
      if (x <= left .or. x >= right) exit
      if (sum_at(a, m_a, tau_a, b, m_b, tau_b, x) > 0) then
        left = x
      else
        right = x
      end if
    end do
    call evaluate(a, m_a, tau_a, x, value_a, slope_a)
    call evaluate(b, m_b, tau_b, x, value_b, slope_b)
    modulus = (value_a/x)*(-value_b/(slope_a + slope_b))
    call add_term(modulus, x, a%n + b%n + 1, pair, m, tau)
  end subroutine add_zero

  !> Geometric middle where the ends are decades apart, arithmetic where they are close.
  pure function middle(left, right) result(x)
    real(dp), intent(in) :: left, right
    real(dp) :: x
    if (right > 4*left) then
      x = sqrt(max(left, right*1.0e-30_dp))*sqrt(right)
    else
      x = left + 0.5_dp*(right - left)
    end if
  end function middle

  !> A term too weak for its zero to be told from a neighbouring rate has no positive modulus, and is none.
  pure subroutine add_term(modulus, x, capacity, pair, m, tau)
    real(dp), intent(in) :: modulus, x
    integer(ip), intent(in) :: capacity
    type(chain_type), intent(inout) :: pair
    real(dp), intent(inout) :: m(capacity), tau(capacity)
    if (.not. modulus > 0) return
    pair%n = pair%n + 1
    m(pair%n) = modulus
    tau(pair%n) = 1/x
  end subroutine add_term
end module rst_series
