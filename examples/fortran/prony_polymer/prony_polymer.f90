!> A steel ball on a polymer whose Prony series is in a CSV file (columns tau_s, G_Pa): restitution
!> by speed. The argument is the file, as src/materials/polyisobutylene.csv.
program prony_polymer
  use, intrinsic :: iso_fortran_env, only: iostat_end
  use restitute
  implicit none (type, external)
  integer, parameter :: rk = restitute_real
  real(rk), parameter :: speeds(4) = [1e-4_rk, 1e-3_rk, 0.01_rk, 0.05_rk] ! m/s
  type(restitute_material) :: polymer
  type(restitute_scene) :: scene
  type(restitute_error) :: error
  real(rk), allocatable :: tau(:), modulus(:)
  character(len=256) :: path
  real(rk) :: ez, ex
  integer :: k

  call get_command_argument(1, path)
  call read_series(trim(path), tau, modulus)
  if (restitute_material_prony(0.0_rk, 0.0_rk, tau, modulus, 0.5_rk, polymer, error) < 0) &
    error stop restitute_message(error)
  scene = restitute_scene()
  scene%material = polymer
  scene%radius1 = 0.005_rk   ! m
  scene%mass1 = 0.00408_rk   ! kg
  scene%friction = 0.3_rk
  print "(i0, a)", restitute_material_terms(polymer), " terms"
  do k = 1, size(speeds)
    scene%normal_speed = speeds(k)
    scene%tangential_speed = 0.5_rk*speeds(k)
    if (restitute_scene_pair(scene, ez, ex, error) < 0) error stop restitute_message(error)
    print "(f6.4, 2(a, f6.3))", speeds(k), " m/s: ez = ", ez, ", ex = ", ex
  end do
  call restitute_material_destroy(polymer)
  deallocate (tau, modulus)

contains

  !> Numbers of all lines but comments (#) and the header.
  subroutine read_series(file, tau, modulus)
    character(len=*), intent(in) :: file
    real(rk), allocatable, intent(out) :: tau(:), modulus(:)
    character(len=512) :: line
    real(rk) :: pair(2)
    integer :: unit, status
    tau = [real(rk) ::]
    modulus = tau
    open (newunit=unit, file=file, action="read", status="old")
    do
      read (unit, "(a)", iostat=status) line
      if (status == iostat_end) exit
      if (line(1:1) == "#" .or. index(line, "tau_s") > 0) cycle
      read (line, *) pair
      tau = [tau, pair(1)]
      modulus = [modulus, pair(2)]
    end do
    close (unit)
  end subroutine read_series
end program prony_polymer
