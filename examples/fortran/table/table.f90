!> A table of restitution pairs: built once, saved, read again and looked up, for its own sphere and
!> for a smaller one.
program table
  use restitute
  use restitute_table_module
  use restitute_table_files_module
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  real(rk), parameter :: normal(4) = [0.001_rk, 0.003_rk, 0.01_rk, 0.03_rk], slide(4) = 0.5_rk*normal ! m/s
  type(restitute_material) :: rubber
  type(restitute_scene) :: scene
  type(restitute_table_options) :: options
  type(restitute_table) :: built, lookup
  type(restitute_table_contact) :: small
  type(restitute_error) :: error
  real(rk) :: ez(4), ex(4), small_ez, small_ex
  integer :: k

  ! G1, G2 (Pa), eta (Pa s), nu
  if (restitute_material_standard_solid(1e6_rk, 3e6_rk, 300.0_rk, 0.5_rk, rubber, error) < 0) call fail()
  scene = restitute_scene() ! ball on wall; one of them is rigid; its speeds are not used
  scene%material = rubber
  scene%radius1 = 0.005_rk  ! m
  scene%mass1 = 0.004_rk    ! kg
  scene%friction = 0.3_rk
  options = restitute_table_options()
  options%speed = [1e-4_rk, 0.1_rk] ! m/s
  options%tolerance = 1e-4_rk
  if (restitute_table_build(scene, options, built, error) < 0) call fail()
  if (restitute_table_write(built, "rubber.h5", error) < 0) call fail()
  call restitute_table_destroy(built)

  if (restitute_table_read("rubber.h5", lookup, error) < 0) call fail()
  ! All places in one call; the table's own contact is left out, so what follows it is named.
  if (restitute_table_pair_many(lookup, normal_speeds=normal, sliding_speeds=slide, ez=ez, ex=ex, error=error) < 0) &
    call fail()
  scene%radius1 = 0.004_rk  ! the same table serves another solid ball of steel
  scene%mass1 = 2.048e-3_rk
  small = restitute_table_contact()
  if (restitute_table_contact_set(lookup, scene, small, error) < 0) call fail()
  print "(a)", " speed     ez     ex   small: ez     ex"
  do k = 1, size(normal)
    if (restitute_table_pair(lookup, small, normal(k), slide(k), small_ez, small_ex, error) < 0) call fail()
    print "(f6.3, 2f7.3, f12.3, f7.3)", normal(k), ez(k), ex(k), small_ez, small_ex
  end do
  call restitute_table_destroy(lookup)
  call restitute_material_destroy(rubber)

contains

  subroutine fail()
    error stop restitute_message(error)
  end subroutine fail
end program table
