!> Energy of a contact: what is stored in its springs (docs/contact.md).
module rst_contact_energy
  use, intrinsic :: iso_c_binding, only: c_double
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, at_width, at_overlap, at_arrays, most_nodes
  implicit none (type, external)
  private
  public :: stored_energy

contains

  pure function stored_energy(law, radius, state) result(energy) bind(c, name="rst_law_stored")
    type(law_type), intent(in) :: law
    real(c_double), intent(in), value :: radius
    real(dp), intent(in) :: state(*)
    real(c_double) :: energy
    real(dp) :: u(most_nodes), edge
    integer(ip) :: n
    energy = 0
    if (.not. state(at_width) > 0) return
    n = law%n
    edge = sqrt(max(0.0_dp, state(at_overlap))*radius)/state(at_width)
    call normal_displacement(law, state(at_width)**2/radius, state(at_overlap), n, law%n_terms, state(at_arrays), &
                             state(law%at_surface), u)
    energy = law%normal*stored(law, edge, n, law%n_terms, u, state(at_arrays))
    if (law%slips /= 0) &
      energy = energy + law%tangential*(stored(law, edge, n, law%n_terms, state(law%at_u), state(law%at_w)) &
                                        + stored(law, edge, n, law%n_terms, state(law%at_u + n), state(law%at_w + n*law%n_terms)))
    energy = energy*state(at_width)
  end function stored_energy

  pure subroutine normal_displacement(law, scale, overlap, n, n_terms, w, surface, u)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: scale, overlap
    integer(ip), intent(in) :: n, n_terms
    real(dp), intent(in) :: w(n, n_terms), surface(n)
    real(dp), intent(out) :: u(n)
    integer(ip) :: j
    do j = 1, n
      if (law%surface /= 0) then
        u(j) = surface(j)
      else
        u(j) = max(overlap - law%y(j)*scale, -dot_product(law%g(1:n_terms), w(j, :))*law%compliance)
      end if
    end do
  end subroutine normal_displacement

  !> One direction: int (1/2) (G_inf u^2 + sum g w^2) dx, u and w linear in y between elements, by Simpson's rule in x.
  pure function stored(law, edge, n, n_terms, u, w) result(energy)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: edge
    integer(ip), intent(in) :: n, n_terms
    real(dp), intent(in) :: u(n), w(n, n_terms)
    real(dp) :: energy
    integer(ip) :: k
    energy = law%g_inf*squared(law, edge, n, u)
    do k = 1, n_terms
      energy = energy + law%g(k)*squared(law, edge, n, w(:, k))
    end do
  end function stored

  !> int (1/2) p^2 dx; a contact that ends between two elements ends at its edge.
  pure function squared(law, edge, n, p) result(integral)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: edge
    integer(ip), intent(in) :: n
    real(dp), intent(in) :: p(n)
    real(dp) :: integral, last, to, middle
    integer(ip) :: j
    integral = 0
    do j = 1, n
      last = 0
      if (j < n) last = p(j + 1)
      to = law%x(j + 1)
      if (edge > law%x(j) .and. .not. abs(last) > 0) to = min(edge, to)
      middle = 0.5_dp*(law%x(j) + to)
      middle = p(j) + (last - p(j))*(middle**2 - law%y(j))/(to**2 - law%y(j))
      integral = integral + (to - law%x(j))*(p(j)**2 + 4*middle**2 + last**2)/12
    end do
  end function squared
end module rst_contact_energy
