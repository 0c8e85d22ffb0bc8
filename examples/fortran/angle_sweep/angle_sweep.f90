!> A steel ball on rubber from steep to grazing: ex changes sign where sliding dominates. One solver
!> serves all impacts.
program angle_sweep
  use restitute
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  real(rk), parameter :: degree = acos(-1.0_rk)/180, speed = 0.03_rk ! m/s
  type(restitute_material) :: rubber
  type(restitute_solver) :: solver
  type(restitute_scene) :: scene
  type(restitute_result) :: result
  type(restitute_error) :: error
  integer :: angle, status

  status = restitute_material_standard_solid(1e6_rk, 3e6_rk, 300.0_rk, 0.5_rk, rubber) ! G1, G2 (Pa), eta (Pa s), nu
  status = restitute_solver_create(solver=solver)
  result = restitute_result()
  scene = restitute_scene()
  scene%material = rubber
  scene%radius1 = 0.005_rk ! m
  scene%mass1 = 0.004_rk   ! kg
  scene%friction = 0.3_rk
  print "(a)", " angle     ez     ex    contact"
  do angle = 10, 80, 10 ! from the normal
    scene%normal_speed = speed*cos(angle*degree)
    scene%tangential_speed = speed*sin(angle*degree)
    status = restitute_solve_scene(solver, scene, result, error=error)
    if (status < 0) error stop restitute_message(error)
    print "(i6, 2f7.3, f8.2, a)", angle, result%ez, result%ex, result%contact_time*1e3_rk, " ms"
  end do
  call restitute_solver_destroy(solver)
  call restitute_material_destroy(rubber)
end program angle_sweep
