!> Two generalised Maxwell chains in series as one chain: the effective solid of two unlike bodies
!> (docs/theory.md, section 10).
!>
!> With the operational modulus M(s) = m_inf + sum_k m_k s/(s + p_k) + eta s, p_k = 1/tau_k,
!> compliances add: 1/M = 1/M_1 + 1/M_2. The relaxation rates of the pair are the zeros x of F(x) =
!> M_1(-x) + M_2(-x). F falls from +inf to -inf between neighbouring rates of the two chains taken
!> together, so that exactly one zero lies between two of them; one more lies below the lowest if
!> F(0) = m_inf1 + m_inf2 > 0, and one above the highest if eta_1 + eta_2 > 0. A rate that both
!> chains share is one of the pair, too.
module rst_series
  use rst_precision, only: dp, ip
  implicit none (type, external)
  private
  public :: chain_type, series_chain

  !> Size and ends of a chain. Twin of `struct rst_chain` in C; its terms come as arrays, tau
  !> ascending.
  type, bind(c) :: chain_type
    real(dp) :: m_inf, eta
    integer(ip) :: n
  end type chain_type

contains

  !> Chains a and b in series: `pair` has at most a%n + b%n + 1 terms, tau ascending. `times`,
  !> `from_a` and `from_b` are workspace: the times of both chains, descending, and the term of each
  !> chain that has that time, 0 for none.
  pure subroutine series_chain(a, m_a, tau_a, b, m_b, tau_b, times, from_a, from_b, pair, m, tau) &
    bind(c, name="rst_series_chain")
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n)
    real(dp), intent(out) :: times(a%n + b%n)
    integer(ip), intent(out) :: from_a(a%n + b%n), from_b(a%n + b%n)
    type(chain_type), intent(out) :: pair
    real(dp), intent(out) :: m(a%n + b%n + 1), tau(a%n + b%n + 1)
    integer(ip) :: n_times, i
    real(dp) :: slow

    pair%m_inf = in_series(a%m_inf, b%m_inf)
    pair%eta = in_series(a%eta, b%eta)
    pair%n = 0
    call merge_times(a%n, tau_a, b%n, tau_b, times, from_a, from_b, n_times)
    if (a%eta + b%eta > 0) then  ! the zero above the highest rate; none if both chains have a dashpot and nothing else
      slow = 0
      if (n_times > 0) slow = times(n_times)
      if (n_times > 0 .or. a%m_inf + b%m_inf > 0) then
        call add_zero(a, m_a, tau_a, b, m_b, tau_b, slow, 1/upper_end(a, m_a, tau_a, b, m_b, tau_b, slow), pair, m, tau)
      end if
    end if
    do i = n_times, 1, -1
      if (from_a(i) > 0 .and. from_b(i) > 0) then
        call add_term(in_series(m_a(from_a(i)), m_b(from_b(i))), 1/times(i), a%n + b%n + 1, pair, m, tau)
      end if
      slow = 0
      if (i > 1) slow = times(max(i - 1, 1_ip))
      if (i > 1 .or. a%m_inf + b%m_inf > 0) call add_zero(a, m_a, tau_a, b, m_b, tau_b, slow, times(i), pair, m, tau)
    end do
  end subroutine series_chain

  pure function in_series(x, y) result(z)
    real(dp), intent(in) :: x, y
    real(dp) :: z
    z = 0
    if (x > 0 .and. y > 0) z = x/(x + y)*y
  end function in_series

  !> tau ascends, so both chains are read from the end.
  pure subroutine merge_times(n_a, tau_a, n_b, tau_b, times, from_a, from_b, n)
    integer(ip), intent(in) :: n_a, n_b
    real(dp), intent(in) :: tau_a(n_a), tau_b(n_b)
    real(dp), intent(out) :: times(n_a + n_b)
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
      times(n) = max(next_a, next_b)
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
  end subroutine merge_times

  !> M(-x) = m_inf - eta x + sum m_k x/(x - p_k) at x = p (1 + offset), p = 1/tau_p. Written with
  !> the offset from a rate p, it keeps all digits where x is next to p, or p next to another rate.
  pure function value_at(chain, m, tau, tau_p, offset) result(value)
    type(chain_type), intent(in) :: chain
    real(dp), intent(in) :: m(chain%n), tau(chain%n), tau_p, offset
    real(dp) :: value
    integer(ip) :: k
    value = chain%m_inf - chain%eta*((1 + offset)/tau_p)
    do k = 1, chain%n
      value = value + m(k)*((tau(k)/tau_p)*(1 + offset)/beyond(tau(k), tau_p, offset))
    end do
  end function value_at

  !> Its derivative with respect to s = -x, times near**2: with near = |offset| it does not overflow
  !> next to p.
  pure function slope_at(chain, m, tau, tau_p, offset, near) result(slope)
    type(chain_type), intent(in) :: chain
    real(dp), intent(in) :: m(chain%n), tau(chain%n), tau_p, offset, near
    real(dp) :: slope, part
    integer(ip) :: k
    slope = near**2*chain%eta
    do k = 1, chain%n
      part = near/beyond(tau(k), tau_p, offset)
      slope = slope + m(k)*(tau(k)*part)*part
    end do
  end function slope_at

  !> x tau - 1
  pure function beyond(tau, tau_p, offset)
    real(dp), intent(in) :: tau, tau_p, offset
    real(dp) :: beyond
    beyond = (tau - tau_p)/tau_p + offset*(tau/tau_p)
  end function beyond

  pure function sum_at(a, m_a, tau_a, b, m_b, tau_b, tau_p, offset) result(total)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n), tau_p, offset
    real(dp) :: total
    total = value_at(a, m_a, tau_a, tau_p, offset) + value_at(b, m_b, tau_b, tau_p, offset)
  end function sum_at

  !> Twice some x above the highest zero, where F -> -eta x: not next to the zero, as a rate of the
  !> chains may be.
  pure function upper_end(a, m_a, tau_a, b, m_b, tau_b, slow) result(x)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n), slow
    real(dp) :: x
    x = (a%m_inf + b%m_inf)/(a%eta + b%eta)
    if (slow > 0) x = max(2/slow, x)
    do while (sum_at(a, m_a, tau_a, b, m_b, tau_b, 1/x, 0.0_dp) > 0)
      x = 2*x
    end do
    x = 2*x
  end function upper_end

  !> The zero of F between the rates 1/slow and 1/fast, as a term of the pair; slow = 0: there is no
  !> slower rate. F falls: its sign in the middle tells which end is nearer. The zero is sought by
  !> its offset from that end, in the logarithm, since a stiff partner or a neighbouring rate puts
  !> it as close as 1e-30 of a rate. The residue of M there is -M_1^2/(M_1' + M_2'), hence m =
  !> M_1^2/(x (M_1' + M_2')).
  pure subroutine add_zero(a, m_a, tau_a, b, m_b, tau_b, slow, fast, pair, m, tau)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n), slow, fast
    type(chain_type), intent(inout) :: pair
    real(dp), intent(inout) :: m(a%n + b%n + 1), tau(a%n + b%n + 1)
    real(dp) :: tau_p, offset, near, gap, value_a, value_b, slope, x

    gap = 1  ! distance of the rates over the faster one
    if (slow > 0) gap = (slow - fast)/slow
    if (sum_at(a, m_a, tau_a, b, m_b, tau_b, fast, -0.5_dp*gap) > 0) then
      tau_p = fast
      near = search(a, m_a, tau_a, b, m_b, tau_b, tau_p, -1.0_dp, gap)
      offset = -near
    else if (slow > 0) then
      tau_p = slow
      near = search(a, m_a, tau_a, b, m_b, tau_b, tau_p, 1.0_dp, (slow - fast)/fast)
      offset = near
    else
      tau_p = search_slow(a, m_a, tau_a, b, m_b, tau_b, fast)
      near = 1
      offset = 0
    end if
    x = (1 + offset)/tau_p
    value_a = near*value_at(a, m_a, tau_a, tau_p, offset)
    value_b = near*value_at(b, m_b, tau_b, tau_p, offset)
    slope = slope_at(a, m_a, tau_a, tau_p, offset, near) + slope_at(b, m_b, tau_b, tau_p, offset, near)
    call add_term((value_a/x)*(-value_b/slope), x, a%n + b%n + 1, pair, m, tau)
  end subroutine add_zero

  !> Offset of the zero from the rate 1/tau_p, up to `reach` above it (side 1) or below it (side
  !> -1).
  pure function search(a, m_a, tau_a, b, m_b, tau_b, tau_p, side, reach) result(offset)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n), tau_p, side, reach
    real(dp) :: offset
    real(dp), parameter :: closest = 1.0e-140_dp  !! of 1e-30 Pa beside 1e60 Pa s over 1e-30 s it is 1e-120
    real(dp) :: near, far
    integer(ip) :: i
    near = closest
    far = reach
    do i = 1, 200
      offset = sqrt(near)*sqrt(far)
      if (offset <= near .or. offset >= far) exit
      if (side*sum_at(a, m_a, tau_a, b, m_b, tau_b, tau_p, side*offset) > 0) then
        near = offset
      else
        far = offset
      end if
    end do
  end function search

  !> 1/x of a zero below half of the slowest rate 1/fast: there x itself is sought, in the
  !> logarithm.
  pure function search_slow(a, m_a, tau_a, b, m_b, tau_b, fast) result(tau_p)
    type(chain_type), intent(in) :: a, b
    real(dp), intent(in) :: m_a(a%n), tau_a(a%n), m_b(b%n), tau_b(b%n), fast
    real(dp) :: tau_p
    real(dp) :: near, far
    integer(ip) :: i
    near = fast
    far = fast*1.0e140_dp
    do i = 1, 200
      tau_p = sqrt(near)*sqrt(far)
      if (tau_p <= near .or. tau_p >= far) exit
      if (sum_at(a, m_a, tau_a, b, m_b, tau_b, tau_p, 0.0_dp) > 0) then
        far = tau_p
      else
        near = tau_p
      end if
    end do
  end function search_slow

  !> If a term is so weak that its zero coincides with a neighbouring rate, its modulus is not
  !> positive, and it is left out.
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
