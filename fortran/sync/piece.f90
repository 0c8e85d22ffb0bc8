!> A piece of a panel on which the tangential motion is smooth, and what is known there of the
!> normal one.
module rst_piece
  use rst_precision, only: dp, ip
  use rst_motion_factors, only: shear_factor
  use rst_collocation, only: stages, point, integral, weights_at, integrated, applied, factors_type, &
                             factorize, solution_of
  use rst_arms, only: respond_all, answer_of, advance
  use rst_panel, only: normal_type
  use rst_store, only: contact_type, store_type
  implicit none (type, external)
  private
  public :: interval_type, set_interval, stick, advance_memory

  !> A piece: its panel, the part of it, whether in the root of what is left; the normal motion at
  !> its start and at its points; span: time per x of the piece; answer: of the stress of an element
  !> in stick to U'.
  type :: interval_type
    integer(ip) :: panel
    real(dp) :: from, to
    logical :: rooted, returning
    real(dp), dimension(0:stages) :: x, angle, radius, time, velocity, force, pace
    real(dp) :: span(stages), answer(stages, stages)
  end type interval_type

contains

  !> The interval of the piece from x = interval%from to x = interval%to of a panel, which are
  !> given. In a rooted piece x is to - (to - from) (1 - y)^2 with y from 0 to 1.
  subroutine set_interval(normal, store, interval, fails)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(inout) :: store
    type(interval_type), intent(inout) :: interval
    logical, intent(out) :: fails
    real(dp) :: slope(0:stages), width
    logical :: is_whole
    width = interval%to - interval%from
    is_whole = .not. (interval%rooted .or. interval%from > 0 .or. interval%to < 1)
    interval%returning = interval%panel > normal%n_compression
    interval%x = interval%from + width*point
    slope = width
    if (interval%rooted) then
      interval%x = interval%to - width*(1 - point)**2
      slope = 2*width*(1 - point)
    end if
    associate (on => normal%panel(interval%panel))
      interval%angle = on%from + interval%x*(on%to - on%from)
      if (is_whole) then
        call take_panel(normal, store, interval)
        fails = .false.
      else
        call take_part(normal, store, interval)
        interval%span = interval%pace(1:)*(abs(on%to - on%from)*slope(1:))
        call respond_all(normal%rate, interval%span, store%kernel, fails)
      end if
    end associate
    if (.not. fails) call answer_of(normal%eta, normal%g, interval%span, store%kernel, interval%answer)
  end subroutine set_interval

  !> What is known on the whole panel: the motion, M_k in store%memory_z, and the arms' kernels.
  subroutine take_panel(normal, store, interval)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(inout) :: store
    type(interval_type), intent(inout) :: interval
    associate (on => normal%panel(interval%panel))
      interval%radius = on%radius
      interval%time = on%time
      interval%velocity = on%velocity
      interval%force = on%force
      interval%pace = on%pace
      interval%span = on%pace(1:)*abs(on%to - on%from)
    end associate
    store%memory_z = normal%memory(:, :, interval%panel)
    store%kernel(1:, 0:, 1:) => normal%kernel(:, :, :, interval%panel)
  end subroutine take_panel

  !> What its polynomials say of the motion and of M_k at interval%x. Kernels are to be found.
  subroutine take_part(normal, store, interval)
    type(normal_type), intent(in) :: normal
    type(store_type), intent(inout) :: store
    type(interval_type), intent(inout) :: interval
    real(dp) :: weight(0:stages)
    integer(ip) :: i, k
    do i = 0, stages
      associate (on => normal%panel(interval%panel))
        weight = weights_at(interval%x(i))
        interval%radius(i) = sum(weight*on%radius)
        interval%time(i) = sum(weight*on%time)
        interval%velocity(i) = sum(weight*on%velocity)
        interval%force(i) = sum(weight*on%force)
        interval%pace(i) = sum(weight*on%pace)
      end associate
      do k = 1, normal%n_arms
        store%memory_z(i, k) = sum(weight*normal%memory(:, k, interval%panel))
      end do
    end do
    store%kernel => store%kernel_room
  end subroutine take_part

  !> M_k in x at the points, from that at the start and U' = shear_velocity.
  subroutine advance_memory(normal, interval, shear_velocity, store)
    type(normal_type), intent(in) :: normal
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: shear_velocity(stages)
    type(store_type), intent(inout) :: store
    call advance(normal%g, interval%span, store%kernel, shear_velocity, store%memory_x)
  end subroutine advance_memory

  !> All sticks: S at the points is linear in U', S = known_force + response U'. While the contact
  !> grows P_k' = g_k A U' - P_k/tau_k in x and S = eta A U' + sum_k P_k; while it shrinks without
  !> slip, S = A q(A) + sum_k E_k P_k(t_A) with the stress q of an element at the edge
  !> (memory_force: its part of memory and the sum).
  subroutine stick(normal, contact, interval, memory_force, shear_velocity, shear_force, store, fails)
    type(normal_type), intent(in) :: normal
    type(contact_type), intent(in) :: contact
    type(interval_type), intent(in) :: interval
    real(dp), intent(in) :: memory_force(stages)      !! of the shrinking contact
    real(dp), intent(inout) :: shear_velocity(0:stages)    !! U'; (0) is given
    real(dp), intent(inout) :: shear_force(0:stages)
    type(store_type), intent(inout) :: store
    logical, intent(out) :: fails
    real(dp) :: response(stages, stages), matrix(stages, stages), known_force(stages), push
    type(factors_type) :: factors
    integer(ip) :: j, k
    push = shear_factor*contact%chi ! U'' = -push S
    known_force = memory_force
    response = 0
    do k = 1, normal%n_arms
      if (interval%returning) then
        known_force = known_force + interval%radius(1:)*store%kernel(:, 0, k)*store%memory_x(0, k)
      else
        known_force = known_force + store%kernel(:, 0, k)*store%loading_x(0, k)
        do j = 1, stages
          response(:, j) = response(:, j) + store%kernel(:, j, k)*(normal%g(k)*interval%span(j)*interval%radius(j))
        end do
      end if
    end do
    do j = 1, stages
      if (interval%returning) then
        response(:, j) = interval%radius(1:)*interval%answer(:, j)
      else
        response(j, j) = response(j, j) + normal%eta*interval%radius(j)
      end if
    end do
    do j = 1, stages
      matrix(:, j) = push*applied(integral, interval%span*response(:, j))
      matrix(j, j) = 1 + matrix(j, j)
    end do
    call factorize(matrix, factors, fails)
    if (fails) return
    shear_velocity(1:) = solution_of(factors, integrated(shear_velocity(0), -push*interval%span*known_force))
    shear_force(1:) = known_force + applied(response, shear_velocity(1:))
    call advance_memory(normal, interval, shear_velocity(1:), store)
    if (interval%returning) return
    call advance(normal%g, interval%span, store%kernel, interval%radius(1:)*shear_velocity(1:), store%loading_x)
  end subroutine stick
end module rst_piece
