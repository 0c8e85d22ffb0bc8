!> A steel ball on rubber: the restitution pair of one impact.
program one_impact
  use restitute
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_material) :: rubber
  type(restitute_scene) :: scene
  type(restitute_error) :: error
  real(rk) :: ez, ex
  integer :: status

  status = restitute_material_standard_solid(1e6_rk, 3e6_rk, 300.0_rk, 0.5_rk, rubber) ! G1, G2 (Pa), eta (Pa s), nu
  scene = restitute_scene() ! ball on wall; one of them is rigid
  scene%material = rubber
  scene%radius1 = 0.005_rk  ! m
  scene%mass1 = 0.004_rk    ! kg
  scene%friction = 0.3_rk
  scene%normal_speed = 0.03_rk  ! m/s
  scene%tangential_speed = 0.02_rk
  status = restitute_scene_pair(scene, ez, ex, error)
  if (status < 0) error stop restitute_message(error)
  print "(2(a, f5.3))", "ez = ", ez, ", ex = ", ex
  call restitute_material_destroy(rubber)
end program one_impact
