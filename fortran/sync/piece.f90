!> A piece of a panel on which the tangential motion is smooth, and what is known there of the normal one.
module rst_piece
  use rst_precision, only: dp, ip
  use rst_motion_factors, only: mass_factor
  use rst_collocation, only: stages, point, integral, weights_at, integrated, applied, factors_type, &
                             factorize, solution_of
  use rst_arms, only: respond_all, answer_of, advance
  use rst_panel, only: normal_type
  use rst_store, only: contact_type, store_type
  implicit none (type, external)
  private
  public :: ground_type, lay_ground, stick, advance_memory, push_factor, value_on

  !> A piece: its panel, the part of it, whether in the root of what is left; the normal motion at its start and at its points;
  !> span: time per x of the piece; answer: of the stress of an element in stick to U'.
  type :: ground_type
    integer(ip) :: panel
    real(dp) :: from, to
    logical :: rooted, returning
    real(dp), dimension(0:stages) :: place, angle, radius, time, velocity, force, pace
    real(dp) :: span(stages), answer(stages, stages)
  end type ground_type

contains

  !> U'' = -(15/4) chi S
  pure function push_factor(contact) result(push)
    type(contact_type), intent(in) :: contact
    real(dp) :: push
    push = 2*mass_factor*contact%chi
  end function push_factor

  !> The ground of the piece from x = ground%from to x = ground%to of a panel, which are given. In a rooted piece x is
  !> to - (to - from) (1 - y)^2 with y from 0 to 1.
  subroutine lay_ground(normal, store, ground, fails)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(inout) :: store
    type(ground_type), intent(inout) :: ground
    logical, intent(out) :: fails
    real(dp) :: slope(0:stages), width
    logical :: is_whole
    width = ground%to - ground%from
    is_whole = .not. (ground%rooted .or. ground%from > 0 .or. ground%to < 1)
    ground%returning = ground%panel > normal%n_compression
    ground%place = ground%from + width*point
    slope = width
    if (ground%rooted) then
      ground%place = ground%to - width*(1 - point)**2
      slope = 2*width*(1 - point)
    end if
    associate (on => normal%panel(ground%panel))
      ground%angle = on%from + ground%place*(on%to - on%from)
      if (is_whole) then
        call take_panel(normal, store, ground)
        fails = .false.
      else
        call take_part(normal, store, ground)
        ground%span = ground%pace(1:)*(abs(on%to - on%from)*slope(1:))
        call respond_all(normal%rate, ground%span, store%kernel, fails)
      end if
    end associate
    if (.not. fails) call answer_of(normal%eta, normal%g, ground%span, store%kernel, ground%answer)
  end subroutine lay_ground

  !> What is known on the whole panel: the motion, M_k in store%now_z, and the arms' kernels.
  subroutine take_panel(normal, store, ground)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(inout) :: store
    type(ground_type), intent(inout) :: ground
    associate (on => normal%panel(ground%panel))
      ground%radius = on%radius
      ground%time = on%time
      ground%velocity = on%velocity
      ground%force = on%force
      ground%pace = on%pace
      ground%span = on%pace(1:)*abs(on%to - on%from)
    end associate
    store%now_z = normal%memory(:, :, ground%panel)
    store%kernel(1:, 0:, 1:) => normal%kernel(:, :, :, ground%panel)
  end subroutine take_panel

  !> What its polynomials say of the motion and of M_k at ground%place. Kernels are to be found.
  subroutine take_part(normal, store, ground)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(inout) :: store
    type(ground_type), intent(inout) :: ground
    real(dp) :: weight(0:stages)
    integer(ip) :: i, k
    do i = 0, stages
      associate (on => normal%panel(ground%panel))
        weight = weights_at(ground%place(i))
        ground%radius(i) = sum(weight*on%radius)
        ground%time(i) = sum(weight*on%time)
        ground%velocity(i) = sum(weight*on%velocity)
        ground%force(i) = sum(weight*on%force)
        ground%pace(i) = sum(weight*on%pace)
      end associate
      do k = 1, normal%n_arms
        store%now_z(i, k) = sum(weight*normal%memory(:, k, ground%panel))
      end do
    end do
    store%kernel => store%room
  end subroutine take_part

  !> M_k in x at the points, from that at the start and U' = w.
  subroutine advance_memory(normal, ground, w, store)
    type(normal_type), intent(in) :: normal
    type(ground_type), intent(in) :: ground
    real(dp), intent(in) :: w(stages)
    type(store_type), intent(inout) :: store
    call advance(normal%g, ground%span, store%kernel, w, store%now_x)
  end subroutine advance_memory

  !> All sticks: S at the points is linear in U', S = kept + response U'. While the contact grows
  !> P_k' = g_k A U' - P_k/tau_k in x and S = eta A U' + sum_k P_k; while it shrinks without slip,
  !> S = A q(A) + sum_k E_k P_k(t_A) with the stress q of an element at the edge (held: its part of memory and the sum).
  subroutine stick(normal, contact, ground, held, w, force, store, fails)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(ground_type), intent(in) :: ground
    real(dp), intent(in) :: held(stages)      !! of the shrinking contact
    real(dp), intent(inout) :: w(0:stages)    !! U'; (0) is given
    real(dp), intent(inout) :: force(0:stages)
    type(store_type), intent(inout) :: store
    logical, intent(out) :: fails
    real(dp) :: response(stages, stages), matrix(stages, stages), kept(stages), push
    type(factors_type) :: factors
    integer(ip) :: j, k
    push = push_factor(contact)
    kept = held
    response = 0
    do k = 1, normal%n_arms
      if (ground%returning) then
        kept = kept + ground%radius(1:)*store%kernel(:, 0, k)*store%now_x(0, k)
      else
        kept = kept + store%kernel(:, 0, k)*store%now_l(0, k)
        do j = 1, stages
          response(:, j) = response(:, j) + store%kernel(:, j, k)*(normal%g(k)*ground%span(j)*ground%radius(j))
        end do
      end if
    end do
    do j = 1, stages
      if (ground%returning) then
        response(:, j) = ground%radius(1:)*ground%answer(:, j)
      else
        response(j, j) = response(j, j) + normal%eta*ground%radius(j)
      end if
    end do
    do j = 1, stages
      matrix(:, j) = push*applied(integral, ground%span*response(:, j))
      matrix(j, j) = 1 + matrix(j, j)
    end do
    call factorize(matrix, factors, fails)
    if (fails) return
    w(1:) = solution_of(factors, integrated(w(0), -push*ground%span*kept))
    force(1:) = kept + applied(response, w(1:))
    call advance_memory(normal, ground, w(1:), store)
    if (ground%returning) return
    call advance(normal%g, ground%span, store%kernel, ground%radius(1:)*w(1:), store%now_l)
  end subroutine stick

  !> The polynomial through y at the place on the piece, which is between 0 and 1.
  pure function value_on(place, y) result(value)
    real(dp), intent(in) :: place, y(0:stages)
    real(dp) :: value
    value = sum(weights_at(place)*y)
  end function value_on
end module rst_piece
