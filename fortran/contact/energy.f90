!> Energy in the springs of a contact (docs/contact.md).
module rst_contact_energy
  use, intrinsic :: iso_c_binding, only: c_double
  use rst_precision, only: dp, ip
  use rst_contact_types, only: law_type, at_width, at_overlap, at_arrays, most_nodes
  implicit none (type, external)
  private
  public :: stored_energy

contains

  !> int (1/2) (G_inf u^2 + sum g w^2) dx of all three directions.
  pure function stored_energy(law, radius, state) result(energy) bind(c, name="rst_law_stored")
    type(law_type), intent(in) :: law
    real(c_double), intent(in), value :: radius
    real(dp), intent(in) :: state(*)
    real(c_double) :: energy
    real(dp) :: u(most_nodes), edge, free
    integer(ip) :: n, arms, j, k, d
    energy = 0
    if (.not. state(at_width) > 0) return
    n = law%n
    arms = n*law%n_terms
    edge = sqrt(max(0.0_dp, state(at_overlap))*radius)/state(at_width)
    do j = 1, n
      free = -dot_product(law%g(1:law%n_terms), state(at_arrays + j - 1:at_arrays + arms - 1:n))*law%compliance
      u(j) = max(state(at_overlap) - law%y(j)*state(at_width)**2/radius, free)
    end do
    if (law%surface /= 0) u(1:n) = state(law%at_surface:law%at_surface + n - 1)
    energy = law%normal*law%g_inf*squared(law, edge, u)
    do k = 0, law%n_terms - 1
      energy = energy + law%normal*law%g(k + 1)*squared(law, edge, state(at_arrays + k*n))
    end do
    do d = 0, 2*law%slips - 1
      energy = energy + law%tangential*law%g_inf*squared(law, edge, state(law%at_u + d*n))
      do k = 0, law%n_terms - 1
        energy = energy + law%tangential*law%g(k + 1)*squared(law, edge, state(law%at_w + d*arms + k*n))
      end do
    end do
    energy = energy*state(at_width)
  end function stored_energy

  !> int (1/2) p^2 dx by Simpson's rule, p linear in y between elements; a contact that ends between
  !> two elements ends at its edge.
  pure function squared(law, edge, p) result(integral)
    type(law_type), intent(in) :: law
    real(dp), intent(in) :: edge, p(law%n)
    real(dp) :: integral, last, to, middle
    integer(ip) :: j
    integral = 0
    do j = 1, law%n
      last = 0
      if (j < law%n) last = p(j + 1)
      to = law%x(j + 1)
      if (edge > law%x(j) .and. .not. abs(last) > 0) to = min(edge, to)
      middle = p(j) + (last - p(j))*(3*law%x(j) + to)/(4*(law%x(j) + to))
      integral = integral + (to - law%x(j))*(p(j)**2 + 4*middle**2 + last**2)/12
    end do
  end function squared
end module rst_contact_energy
