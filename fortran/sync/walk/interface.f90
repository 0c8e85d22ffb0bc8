!> What C calls of the walk over the elements.
module rst_sync_walk_interface
  use, intrinsic :: iso_c_binding, only: c_double
  use rst_ledger, only: ledger_type
  use rst_sync_walk, only: walk_type, walk_level_type, walk_shear_type, walk_term_type, columns, follow_elements
  implicit none (type, external)
  private
  public :: rst_follow_elements

contains

  pure subroutine rst_follow_elements(walk, g, tau, level, memory, shear, term, body, stress, ledger) &
    bind(c, name="rst_follow_elements")
    type(walk_type), intent(in) :: walk
    real(c_double), intent(in) :: g(walk%n_terms), tau(walk%n_terms)
    type(walk_level_type), intent(in) :: level(0:2*walk%n)
    real(c_double), intent(in) :: memory(walk%n_terms, 0:2*walk%n)
    type(walk_shear_type), intent(inout) :: shear(0:2*walk%n)
    type(walk_term_type), intent(out) :: term(0:walk%n_terms)
    real(c_double), intent(out) :: body(0:walk%capacity - 1, columns)
    real(c_double), intent(out) :: stress(0:walk%capacity - 1, 0:walk%n_terms, 2)
    type(ledger_type), intent(out) :: ledger
    call follow_elements(walk, g, tau, level, memory, shear, term, body, stress, ledger)
  end subroutine rst_follow_elements
end module rst_sync_walk_interface
