! SPDX-License-Identifier: BSD-3-Clause
!> The component fit of restitute for Fortran: all that fit.h declares but restitute_fitter_values, under the same
!> names. fit.h is the manual. Every struct is prepared by its _init.
!> Arrays know their size, optional arguments are optional; names and remarks come as Fortran texts. A fitter is a
!> type(c_ptr).
!>
!>     use restitute
!>     use restitute_fitting
!>     type(restitute_fit_point) :: points(20)
!>     type(restitute_fit_result) :: result
!>     call restitute_fit_result_init(result)
!>     do i = 1, 20
!>       call restitute_fit_point_init(points(i))   ! then points(i)%scene and points(i)%ez
!>     end do
!>     status = restitute_fit(points, result, error=error)
module restitute_fitting
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int, c_int64_t, c_loc, c_null_char, &
    c_null_funptr, c_null_ptr, c_ptr, c_size_t
  use restitute, only: restitute_error, restitute_material, restitute_scene
  implicit none (type, external)
  private
  public :: restitute_fit_point, restitute_fit_options, restitute_fit_result
  public :: restitute_dma_options, restitute_dma_result
  public :: restitute_fit_point_init, restitute_fit_options_init, restitute_fit_result_init
  public :: restitute_dma_options_init, restitute_dma_result_init
  public :: restitute_fit, restitute_dma_fit, restitute_fit_name, restitute_fit_remarks, restitute_fit_arrays
  public :: restitute_fitter_create, restitute_fitter_run, restitute_fitter_result, restitute_fitter_destroy

  integer, parameter, public :: RESTITUTE_FIT_CONSTANTS = 32, RESTITUTE_FIT_NAME_LENGTH = 32, &
    RESTITUTE_DMA_TERMS = 64, RESTITUTE_DMA_SHIFTS = 32
  integer(c_int), parameter, public :: RESTITUTE_FIT_ELASTIC = 1, RESTITUTE_FIT_KELVIN_VOIGT = 2, &
    RESTITUTE_FIT_STANDARD_SOLID = 3, RESTITUTE_FIT_MAXWELL = 4, RESTITUTE_FIT_PRONY = 5
  integer(c_int), parameter, public :: RESTITUTE_FIT_SQUARES = 0, RESTITUTE_FIT_HUBER = 1, RESTITUTE_FIT_CAUCHY = 2
  integer(c_int), parameter, public :: RESTITUTE_FIT_UNDETERMINED = 1, RESTITUTE_FIT_SIMPLER = 2, &
    RESTITUTE_FIT_MISFIT = 4, RESTITUTE_FIT_LIMITS = 8, RESTITUTE_FIT_UNFINISHED = 16

  !> One measured impact.
  type, bind(c) :: restitute_fit_point
    integer(c_size_t) :: struct_size = 0
    type(restitute_scene) :: scene
    real(c_double) :: temperature = 0, ez = 0, ex = 0, contact_time = 0, sigma_ez = 0, sigma_ex = 0, &
      sigma_contact_time = 0
  end type restitute_fit_point

  !> How to fit; relaxation_time and known by restitute_fit_arrays, interrupted by c_funloc.
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
    character(kind=c_char) :: name(RESTITUTE_FIT_NAME_LENGTH, RESTITUTE_FIT_CONSTANTS) = c_null_char
    real(c_double) :: value(RESTITUTE_FIT_CONSTANTS) = 0, low(RESTITUTE_FIT_CONSTANTS) = 0, &
      high(RESTITUTE_FIT_CONSTANTS) = 0, correlation(RESTITUTE_FIT_CONSTANTS, RESTITUTE_FIT_CONSTANTS) = 0
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
    real(c_double) :: noise = 0
    real(c_double) :: reference_temperature = 0, wlf_c1 = 0, wlf_c2 = 0
  end type restitute_dma_options

  !> A series with positive terms.
  type, bind(c) :: restitute_dma_result
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: equilibrium_modulus = 0
    integer(c_size_t) :: terms = 0
    real(c_double) :: relaxation_time(RESTITUTE_DMA_TERMS) = 0, modulus(RESTITUTE_DMA_TERMS) = 0
    integer(c_size_t) :: temperatures = 0
    real(c_double) :: temperature(RESTITUTE_DMA_SHIFTS) = 0, shift(RESTITUTE_DMA_SHIFTS) = 0, wlf_c1 = 0, wlf_c2 = 0, &
      rms = 0, worst = 0
    integer(c_int) :: flags = 0
    character(kind=c_char) :: remarks(1000) = c_null_char
    type(restitute_material) :: material
  end type restitute_dma_result

  interface
    subroutine restitute_fit_point_init(point) bind(c)
      import :: restitute_fit_point
      implicit none (type, external)
      type(restitute_fit_point), intent(inout) :: point
    end subroutine restitute_fit_point_init
    subroutine restitute_fit_options_init(options) bind(c)
      import :: restitute_fit_options
      implicit none (type, external)
      type(restitute_fit_options), intent(inout) :: options
    end subroutine restitute_fit_options_init
    subroutine restitute_fit_result_init(result) bind(c)
      import :: restitute_fit_result
      implicit none (type, external)
      type(restitute_fit_result), intent(inout) :: result
    end subroutine restitute_fit_result_init
    subroutine restitute_dma_options_init(options) bind(c)
      import :: restitute_dma_options
      implicit none (type, external)
      type(restitute_dma_options), intent(inout) :: options
    end subroutine restitute_dma_options_init
    subroutine restitute_dma_result_init(result) bind(c)
      import :: restitute_dma_result
      implicit none (type, external)
      type(restitute_dma_result), intent(inout) :: result
    end subroutine restitute_dma_result_init
    function c_fit(n, points, options, result, error) result(status) bind(c, name="restitute_fit")
      import :: c_int, c_size_t, restitute_error, restitute_fit_options, restitute_fit_point, restitute_fit_result
      implicit none (type, external)
      integer(c_size_t), intent(in), value :: n
      type(restitute_fit_point), intent(in) :: points(*)
      type(restitute_fit_options), intent(in), optional :: options
      type(restitute_fit_result), intent(inout) :: result
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_fit
    function c_create(n, points, options, fitter, error) result(status) bind(c, name="restitute_fitter_create")
      import :: c_int, c_ptr, c_size_t, restitute_error, restitute_fit_options, restitute_fit_point
      implicit none (type, external)
      integer(c_size_t), intent(in), value :: n
      type(restitute_fit_point), intent(in) :: points(*)
      type(restitute_fit_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: fitter
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_create
    function restitute_fitter_run(fitter, done, error) result(status) bind(c)
      import :: c_double, c_int, c_ptr, restitute_error
      implicit none (type, external)
      type(c_ptr), intent(in), value :: fitter
      real(c_double), intent(inout) :: done
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_fitter_run
    function restitute_fitter_result(fitter, result, error) result(status) bind(c)
      import :: c_int, c_ptr, restitute_error, restitute_fit_result
      implicit none (type, external)
      type(c_ptr), intent(in), value :: fitter
      type(restitute_fit_result), intent(inout) :: result
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function restitute_fitter_result
    subroutine restitute_fitter_destroy(fitter) bind(c)
      import :: c_ptr
      implicit none (type, external)
      type(c_ptr), intent(in), value :: fitter
    end subroutine restitute_fitter_destroy
    function c_dma_fit(n, frequency, storage, loss, temperature, options, result, error) result(status) &
      bind(c, name="restitute_dma_fit")
      import :: c_double, c_int, c_size_t, restitute_dma_options, restitute_dma_result, restitute_error
      implicit none (type, external)
      integer(c_size_t), intent(in), value :: n
      real(c_double), intent(in) :: frequency(*), storage(*), loss(*)
      real(c_double), intent(in), optional :: temperature(*)
      type(restitute_dma_options), intent(in), optional :: options
      type(restitute_dma_result), intent(inout) :: result
      type(restitute_error), intent(inout), optional :: error
      integer(c_int) :: status
    end function c_dma_fit
  end interface

contains

  !> Relaxation times and known constants of the options: targets that live until the fit is called.
  subroutine restitute_fit_arrays(options, relaxation_time, known)
    type(restitute_fit_options), intent(inout) :: options
    real(c_double), intent(in), optional, target, contiguous :: relaxation_time(:), known(:)
    if (present(relaxation_time)) then
      options%terms = size(relaxation_time, kind=c_size_t)
      if (size(relaxation_time) > 0) options%relaxation_time = c_loc(relaxation_time(1))
    end if
    if (present(known)) then
      if (size(known) > 0) options%known = c_loc(known(1))
    end if
  end subroutine restitute_fit_arrays

  function restitute_fit(points, result, options, error) result(status)
    type(restitute_fit_point), intent(in) :: points(:)
    type(restitute_fit_result), intent(inout) :: result
    type(restitute_fit_options), intent(in), optional :: options
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    status = c_fit(size(points, kind=c_size_t), points, options, result, error)
  end function restitute_fit

  function restitute_fitter_create(points, fitter, options, error) result(status)
    type(restitute_fit_point), intent(in) :: points(:)
    type(c_ptr), intent(out) :: fitter
    type(restitute_fit_options), intent(in), optional :: options
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    fitter = c_null_ptr
    status = c_create(size(points, kind=c_size_t), points, options, fitter, error)
  end function restitute_fitter_create

  !> storage and loss as long as frequency; the shortest decides.
  function restitute_dma_fit(frequency, storage, loss, result, temperature, options, error) result(status)
    real(c_double), intent(in) :: frequency(:), storage(:), loss(:)
    type(restitute_dma_result), intent(inout) :: result
    real(c_double), intent(in), optional :: temperature(:)
    type(restitute_dma_options), intent(in), optional :: options
    type(restitute_error), intent(inout), optional :: error
    integer(c_int) :: status
    integer(c_size_t) :: n
    n = min(size(frequency, kind=c_size_t), size(storage, kind=c_size_t), size(loss, kind=c_size_t))
    if (present(temperature)) n = min(n, size(temperature, kind=c_size_t))
    status = c_dma_fit(n, frequency, storage, loss, temperature, options, result, error)
  end function restitute_dma_fit

  !> Name of constant i, from 1.
  function restitute_fit_name(result, i) result(name)
    type(restitute_fit_result), intent(in) :: result
    integer, intent(in) :: i
    character(len=:), allocatable :: name
    name = text_of(result%name(:, i))
  end function restitute_fit_name

  !> All remarks, a line each.
  function restitute_fit_remarks(result) result(remarks)
    type(restitute_fit_result), intent(in) :: result
    character(len=:), allocatable :: remarks
    remarks = text_of(result%remarks)
  end function restitute_fit_remarks

  pure function text_of(characters) result(text)
    character(kind=c_char), intent(in) :: characters(:)
    character(len=:), allocatable :: text
    integer :: i, length
    length = findloc(characters, c_null_char, dim=1) - 1
    if (length < 0) length = size(characters)
    allocate (character(len=length) :: text)
    do i = 1, length
      text(i:i) = characters(i)
    end do
  end function text_of
end module restitute_fitting
