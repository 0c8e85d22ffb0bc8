! SPDX-License-Identifier: BSD-3-Clause
!> The component fit for Fortran: all that fit.h declares, under the same names. fit.h is the
!> manual, and the rules of the module restitute hold. Link restitute::fortran_fit; it brings GSL,
!> which is under the GPL.
!>
!>     use restitute
!>     use restitute_fit_module
!>     type(restitute_scene), target :: drop     ! points refer to it, so it is a target
!>     type(restitute_fit_point) :: points(20)
!>     type(restitute_fit_result) :: result
!>     result = restitute_fit_result()
!>     do i = 1, 20
!>       points(i) = restitute_fit_point(drop)          ! then points(i)%ez
!>     end do
!>     status = restitute_fit(points, result=result, error=error)
!>     print *, restitute_text(result%name(:, 1)), result%value(1), restitute_text(result%remarks)
module restitute_fit_module
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int, c_int64_t, c_loc, c_null_char, &
    c_null_funptr, c_null_ptr, c_ptr, c_size_t, c_sizeof
  use restitute, only: restitute_error, restitute_material, restitute_scene, RESTITUTE_OK
  use restitute_texts_module, only: check_length
  implicit none (type, external)
  private
  public :: restitute_fit_point, restitute_fit_options, restitute_fit_result, restitute_fit_interrupted
  public :: restitute_dma_options, restitute_dma_result, restitute_fitter
  public :: restitute_fit, restitute_dma_fit, restitute_fit_arrays, restitute_fitter_create, restitute_fitter_run
  public :: restitute_fitter_result, restitute_fitter_values, restitute_fitter_destroy

  !> Lengths of arrays in the results.
  integer, parameter, public :: RESTITUTE_FIT_CONSTANTS = 32, RESTITUTE_FIT_NAME = 32, RESTITUTE_DMA_TERMS = 64, &
    RESTITUTE_DMA_SHIFTS = 32

  !> Which solid.
  integer(c_int), parameter, public :: &
    RESTITUTE_FIT_MODEL_ELASTIC = 1, &
    RESTITUTE_FIT_MODEL_KELVIN_VOIGT = 2, &
    RESTITUTE_FIT_MODEL_STANDARD_SOLID = 3, &
    RESTITUTE_FIT_MODEL_MAXWELL = 4, &
    RESTITUTE_FIT_MODEL_PRONY = 5

  !> What a residual counts.
  integer(c_int), parameter, public :: &
    RESTITUTE_FIT_LOSS_SQUARES = 0, &
    RESTITUTE_FIT_LOSS_HUBER = 1, &
    RESTITUTE_FIT_LOSS_CAUCHY = 2

  !> Bits of the flags of a result.
  integer(c_int), parameter, public :: &
    RESTITUTE_FIT_FLAG_UNDETERMINED = 1, &
    RESTITUTE_FIT_FLAG_SIMPLER = 2, &
    RESTITUTE_FIT_FLAG_MISFIT = 4, &
    RESTITUTE_FIT_FLAG_LIMITS = 8, &
    RESTITUTE_FIT_FLAG_UNFINISHED = 16

  !> One measured impact, made by restitute_fit_point(scene).
  type, bind(c) :: restitute_fit_point
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: scene = c_null_ptr
    real(c_double) :: temperature = 0, ez = 0, ex = 0, contact_time = 0, sigma_ez = 0, sigma_ex = 0, &
      sigma_contact_time = 0
  end type restitute_fit_point

  !> How to fit; relaxation_time and known by restitute_fit_arrays, interrupted = c_funloc(a
  !> restitute_fit_interrupted).
  type, bind(c) :: restitute_fit_options
    integer(c_size_t) :: struct_size = 0
    integer(c_int) :: model = 0
    integer(c_size_t) :: terms = 0
    type(c_ptr) :: relaxation_time = c_null_ptr, known = c_null_ptr
    real(c_double) :: poisson_ratio = 0
    integer(c_int) :: loss = 0, noise_known = 0
    real(c_double) :: confidence = 0, reference_temperature = 0, wlf_c1 = 0, wlf_c2 = 0
    integer(c_int) :: starts = 0
    integer(c_int64_t) :: seed = 0
    integer(c_int) :: threads = 0
    type(c_funptr) :: interrupted = c_null_funptr
    type(c_ptr) :: interrupted_data = c_null_ptr
  end type restitute_fit_options

  !> What came out.
  type, bind(c) :: restitute_fit_result
    integer(c_size_t) :: struct_size = 0, constants = 0
    character(kind=c_char) :: name(RESTITUTE_FIT_NAME, RESTITUTE_FIT_CONSTANTS) = c_null_char
    real(c_double), dimension(RESTITUTE_FIT_CONSTANTS) :: value = 0, low = 0, high = 0
    real(c_double) :: correlation(RESTITUTE_FIT_CONSTANTS, RESTITUTE_FIT_CONSTANTS) = 0
    integer(c_size_t) :: values = 0, rank = 0
    real(c_double) :: rms = 0, noise = 0, condition = 0
    integer(c_int64_t) :: impacts = 0
    integer(c_int) :: flags = 0
    character(kind=c_char) :: remarks(2000) = c_null_char
    type(restitute_material) :: material
  end type restitute_fit_result

  !> How to turn moduli into a series.
  type, bind(c) :: restitute_dma_options
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: poisson_ratio = 0
    integer(c_int) :: tension = 0
    real(c_double) :: noise = 0, reference_temperature = 0, wlf_c1 = 0, wlf_c2 = 0
  end type restitute_dma_options

  !> A series with positive terms.
  type, bind(c) :: restitute_dma_result
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: equilibrium_modulus = 0
    integer(c_size_t) :: terms = 0
    real(c_double), dimension(RESTITUTE_DMA_TERMS) :: relaxation_time = 0, modulus = 0
    integer(c_size_t) :: temperatures = 0
    real(c_double), dimension(RESTITUTE_DMA_SHIFTS) :: temperature = 0, shift = 0
    real(c_double) :: wlf_c1 = 0, wlf_c2 = 0, rms = 0, worst = 0
    integer(c_int) :: flags = 0
    character(kind=c_char) :: remarks(1000) = c_null_char
    type(restitute_material) :: material
  end type restitute_dma_result

  !> A fit in pieces, made by restitute_fitter_create, released by restitute_fitter_destroy.
  type :: restitute_fitter
    private
    type(c_ptr) :: address = c_null_ptr
    integer(c_size_t) :: points = 0 ! so many values has each of them
  end type restitute_fitter

  abstract interface
    !> Nonzero: stop. Data is options%interrupted_data.
    integer(c_int) function restitute_fit_interrupted(data) bind(c)
      import
      type(c_ptr), value :: data
    end function restitute_fit_interrupted
  end interface

  interface restitute_fit_point
    module procedure new_fit_point
  end interface restitute_fit_point
  interface restitute_fit_options
    module procedure new_fit_options
  end interface restitute_fit_options
  interface restitute_fit_result
    module procedure new_fit_result
  end interface restitute_fit_result
  interface restitute_dma_options
    module procedure new_dma_options
  end interface restitute_dma_options
  interface restitute_dma_result
    module procedure new_dma_result
  end interface restitute_dma_result

  interface
    subroutine init_fit_point(value, size) bind(c, name="restitute_fit_point_init_sized")
      import
      type(restitute_fit_point), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_fit_point

    subroutine init_fit_options(value, size) bind(c, name="restitute_fit_options_init_sized")
      import
      type(restitute_fit_options), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_fit_options

    subroutine init_fit_result(value, size) bind(c, name="restitute_fit_result_init_sized")
      import
      type(restitute_fit_result), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_fit_result

    subroutine init_dma_options(value, size) bind(c, name="restitute_dma_options_init_sized")
      import
      type(restitute_dma_options), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_dma_options

    subroutine init_dma_result(value, size) bind(c, name="restitute_dma_result_init_sized")
      import
      type(restitute_dma_result), intent(inout) :: value
      integer(c_size_t), value :: size
    end subroutine init_dma_result

    integer(c_int) function c_fit(n, points, options, result, error) bind(c, name="restitute_fit")
      import
      integer(c_size_t), value :: n
      type(restitute_fit_point), intent(in) :: points(*)
      type(restitute_fit_options), intent(in), optional :: options
      type(restitute_fit_result), intent(inout) :: result
      type(restitute_error), intent(inout), optional :: error
    end function c_fit

    integer(c_int) function c_fitter_create(n, points, options, fitter, error) bind(c, name="restitute_fitter_create")
      import
      integer(c_size_t), value :: n
      type(restitute_fit_point), intent(in) :: points(*)
      type(restitute_fit_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: fitter
      type(restitute_error), intent(inout), optional :: error
    end function c_fitter_create

    integer(c_int) function c_fitter_run(fitter, done, error) bind(c, name="restitute_fitter_run")
      import
      type(c_ptr), value :: fitter
      real(c_double), intent(inout) :: done
      type(restitute_error), intent(inout), optional :: error
    end function c_fitter_run

    integer(c_int) function c_fitter_result(fitter, result, error) bind(c, name="restitute_fitter_result")
      import
      type(c_ptr), value :: fitter
      type(restitute_fit_result), intent(inout) :: result
      type(restitute_error), intent(inout), optional :: error
    end function c_fitter_result

    integer(c_int) function c_fitter_values(fitter, ez, ex, contact_time, error) bind(c, name="restitute_fitter_values")
      import
      type(c_ptr), value :: fitter
      real(c_double), intent(inout), optional :: ez(*), ex(*), contact_time(*)
      type(restitute_error), intent(inout), optional :: error
    end function c_fitter_values

    subroutine c_fitter_destroy(fitter) bind(c, name="restitute_fitter_destroy")
      import
      type(c_ptr), value :: fitter
    end subroutine c_fitter_destroy

    integer(c_int) function c_dma_fit(n, frequency, storage, loss, temperature, options, result, error) &
      bind(c, name="restitute_dma_fit")
      import
      integer(c_size_t), value :: n
      real(c_double), intent(in) :: frequency(*), storage(*), loss(*)
      real(c_double), intent(in), optional :: temperature(*)
      type(restitute_dma_options), intent(in), optional :: options
      type(restitute_dma_result), intent(inout) :: result
      type(restitute_error), intent(inout), optional :: error
    end function c_dma_fit
  end interface

contains

  !> Without scene the point has none yet.
  type(restitute_fit_point) function new_fit_point(scene) result(new)
    type(restitute_scene), pointer, intent(in), optional :: scene
    call init_fit_point(new, c_sizeof(new))
    if (present(scene)) new%scene = c_loc(scene)
  end function new_fit_point

  type(restitute_fit_options) function new_fit_options() result(new)
    call init_fit_options(new, c_sizeof(new))
  end function new_fit_options

  type(restitute_fit_result) function new_fit_result() result(new)
    call init_fit_result(new, c_sizeof(new))
  end function new_fit_result

  type(restitute_dma_options) function new_dma_options() result(new)
    call init_dma_options(new, c_sizeof(new))
  end function new_dma_options

  type(restitute_dma_result) function new_dma_result() result(new)
    call init_dma_result(new, c_sizeof(new))
  end function new_dma_result

  !> Relaxation times and known constants of the options: targets that live until the fit is called.
  subroutine restitute_fit_arrays(options, relaxation_time, known)
    type(restitute_fit_options), intent(inout) :: options
    real(c_double), pointer, contiguous, intent(in), optional :: relaxation_time(:), known(:)
    if (present(relaxation_time)) then
      options%terms = size(relaxation_time, kind=c_size_t)
      if (size(relaxation_time) > 0) options%relaxation_time = c_loc(relaxation_time(1))
    end if
    if (present(known)) then
      if (size(known) > 0) options%known = c_loc(known(1))
    end if
  end subroutine restitute_fit_arrays

  integer(c_int) function restitute_fit(points, options, result, error) result(status)
    type(restitute_fit_point), intent(in) :: points(:)
    type(restitute_fit_options), intent(in), optional :: options
    type(restitute_fit_result), intent(inout) :: result
    type(restitute_error), intent(inout), optional :: error
    status = c_fit(size(points, kind=c_size_t), points, options, result, error)
  end function restitute_fit

  integer(c_int) function restitute_fitter_create(points, options, fitter, error) result(status)
    type(restitute_fit_point), intent(in) :: points(:)
    type(restitute_fit_options), intent(in), optional :: options
    type(restitute_fitter), intent(inout) :: fitter
    type(restitute_error), intent(inout), optional :: error
    status = c_fitter_create(size(points, kind=c_size_t), points, options, fitter%address, error)
    if (status >= 0) fitter%points = size(points, kind=c_size_t)
  end function restitute_fitter_create

  integer(c_int) function restitute_fitter_run(fitter, done, error) result(status)
    type(restitute_fitter), intent(in) :: fitter
    real(c_double), intent(inout) :: done
    type(restitute_error), intent(inout), optional :: error
    status = c_fitter_run(fitter%address, done, error)
  end function restitute_fitter_run

  integer(c_int) function restitute_fitter_result(fitter, result, error) result(status)
    type(restitute_fitter), intent(in) :: fitter
    type(restitute_fit_result), intent(inout) :: result
    type(restitute_error), intent(inout), optional :: error
    status = c_fitter_result(fitter%address, result, error)
  end function restitute_fitter_result

  integer(c_int) function restitute_fitter_values(fitter, ez, ex, contact_time, error) result(status)
    type(restitute_fitter), intent(in) :: fitter
    real(c_double), intent(inout), optional :: ez(:), ex(:), contact_time(:)
    type(restitute_error), intent(inout), optional :: error
    status = RESTITUTE_OK
    call check_length("ez", ez, "there are points", fitter%points, status, error)
    call check_length("ex", ex, "there are points", fitter%points, status, error)
    call check_length("contact_time", contact_time, "there are points", fitter%points, status, error)
    if (status == RESTITUTE_OK) status = c_fitter_values(fitter%address, ez, ex, contact_time, error)
  end function restitute_fitter_values

  subroutine restitute_fitter_destroy(fitter)
    type(restitute_fitter), intent(inout) :: fitter
    call c_fitter_destroy(fitter%address)
    fitter = restitute_fitter()
  end subroutine restitute_fitter_destroy

  integer(c_int) function restitute_dma_fit(frequency, storage, loss, temperature, options, result, error) &
    result(status)
    real(c_double), intent(in) :: frequency(:), storage(:), loss(:)
    real(c_double), intent(in), optional :: temperature(:)
    type(restitute_dma_options), intent(in), optional :: options
    type(restitute_dma_result), intent(inout) :: result
    type(restitute_error), intent(inout), optional :: error
    integer(c_size_t) :: n
    n = size(frequency, kind=c_size_t)
    status = RESTITUTE_OK
    call check_length("storage", storage, "frequency", n, status, error)
    call check_length("loss", loss, "frequency", n, status, error)
    call check_length("temperature", temperature, "frequency", n, status, error)
    if (status == RESTITUTE_OK) status = c_dma_fit(n, frequency, storage, loss, temperature, options, result, error)
  end function restitute_dma_fit
end module restitute_fit_module
