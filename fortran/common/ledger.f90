!> Where the impact energy goes (docs/theory.md, section 8), one account for z and one for x, kept
!> only on request.
!>
!> In z the unit is the normal impact energy: 1 = D'(end)^2 + viscous + left_behind. In x it is that
!> energy too, with U in place of D: psi^2 = U'(end)^2 + friction + viscous + left_behind.
!> `left_behind` is the energy in elements when they leave the contact; it relaxes later and is
!> lost.
module rst_ledger
  use rst_precision, only: dp
  implicit none (type, external)
  private
  public :: ledger_type

  !> Twin of `struct rst_ledger` in C.
  type, bind(c) :: ledger_type
    real(dp) :: viscous_z, left_z
    real(dp) :: friction_x, viscous_x, left_x
  end type ledger_type
end module rst_ledger
