!> A hollow rubber ball with topspin hits the floor: velocities and spin after the impact, as a DEM
!> code needs them. Mass and moment of inertia are those of a shell; the thick shell is assumed to
!> deform like a solid ball.
program collide_particle
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_value
  use restitute
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  type(restitute_material) :: rubber
  type(restitute_solver) :: solver
  type(restitute_body) :: ball, floor
  type(restitute_collision) :: collision
  type(restitute_result) :: result
  type(restitute_error) :: error
  integer :: status, bit

  status = restitute_material_standard_solid(1e6_rk, 2e6_rk, 50.0_rk, 0.5_rk, rubber) ! G1, G2 (Pa), eta (Pa s), nu
  status = restitute_solver_create(solver=solver)
  floor = restitute_body()
  floor%radius = ieee_value(1.0_rk, ieee_positive_inf) ! a plane
  floor%normal = [0, 0, 1]
  ball = restitute_body()
  ball%radius = 0.01_rk                                ! m
  ball%mass = 3e-3_rk                                  ! kg
  ball%inertia = 0.5_rk*ball%mass*ball%radius**2       ! between solid, 2/5, and thin shell, 2/3
  ball%position = [0.0_rk, 0.0_rk, 0.01_rk]
  ball%velocity = [1.0_rk, 0.5_rk, -2.0_rk]            ! m/s
  ball%spin = [0.0_rk, 150.0_rk, 20.0_rk]              ! rad/s; about z: a twist, which stays
  collision = restitute_collision()
  collision%material = rubber
  collision%friction = 0.4_rk
  result = restitute_result()
  status = restitute_collide(solver, collision, ball, floor, result, error)
  if (status < 0) error stop restitute_message(error)
  print "(2(a, f5.3))", "ez = ", result%ez, ", ex = ", result%ex
  print "(a, 3f8.3)", "velocity", ball%velocity
  print "(a, 3f8.2)", "spin    ", ball%spin
  do bit = 0, 4 ! exceeded limits of the model
    if (btest(result%flags, bit)) print "(2a)", "note: ", restitute_flag_text(2**bit)
  end do
  call restitute_solver_destroy(solver)
  call restitute_material_destroy(rubber)
end program collide_particle
