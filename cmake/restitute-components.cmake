# SPDX-License-Identifier: BSD-3-Clause
# Decides which optional parts are built, and says which ones are not and which package would bring
# them. Sets RESTITUTE_WITH_<part> for each of RESTITUTE_PARTS.

# What a part needs, with the names of its packages.
function(restitute_name_need variable what debian fedora arch)
  set(${variable} "${what} (Debian ${debian}, Fedora ${fedora}, Arch ${arch})" PARENT_SCOPE)
endfunction()
restitute_name_need(need_pkg_config pkg-config pkg-config pkgconf-pkg-config pkgconf)
restitute_name_need(need_openmp "OpenMP for C" "gcc, for clang libomp-dev" "gcc, for clang libomp-devel"
                    "gcc, for clang openmp")
restitute_name_need(need_jansson Jansson libjansson-dev jansson-devel jansson)
restitute_name_need(need_hdf5 HDF5 libhdf5-dev hdf5-devel hdf5)
restitute_name_need(need_sundials "SUNDIALS 6.4 to 7" libsundials-dev sundials-devel sundials)
restitute_name_need(need_fftw FFTW libfftw3-dev fftw-devel fftw)
restitute_name_need(need_gsl "GSL 2.7" libgsl-dev gsl-devel gsl)
restitute_name_need(need_cmocka cmocka libcmocka-dev libcmocka-devel cmocka)
restitute_name_need(need_numpy NumPy python3-numpy python3-numpy python-numpy)
restitute_name_need(need_version "Python 3.9" python3 python3 python)
restitute_name_need(need_cffi cffi python3-cffi python3-cffi python-cffi)

# The packages that the wanted parts need. Each leaves <name>_FOUND.
macro(restitute_find_pkg_config_library prefix module)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(${prefix} QUIET IMPORTED_TARGET ${module})
  else()
    set(${prefix}_FOUND OFF)
  endif()
endmacro()

# The parts whose libraries pkg-config finds miss it first.
find_package(PkgConfig QUIET)
set(pkg_config PKG_CONFIG_FOUND "${need_pkg_config}")

# restitute_decide(<part> <title> [<found> <what is missing if not found>]...): title says what the
# part gives
function(restitute_decide part title)
  set(option "RESTITUTE_${part}")
  set(result "RESTITUTE_WITH_${part}")
  set(${result} OFF PARENT_SCOPE)
  if(NOT "${${option}}" STREQUAL "AUTO" AND NOT "${${option}}")
    set_property(GLOBAL APPEND PROPERTY RESTITUTE_UNWANTED "${title}")
    return()
  endif()
  set(missing "")
  set(needs ${ARGN})
  while(needs)
    list(POP_FRONT needs found name)
    if(NOT ${found})
      list(APPEND missing "${name}")
    endif()
  endwhile()
  list(JOIN missing " and " missing)
  if(NOT missing)
    set(${result} ON PARENT_SCOPE)
    set_property(GLOBAL APPEND PROPERTY RESTITUTE_BUILT "${title}")
  elseif("${${option}}" STREQUAL "AUTO")
    set_property(GLOBAL APPEND PROPERTY RESTITUTE_LEFT_OUT "${title}, missing: ${missing}")
  else()
    message(FATAL_ERROR "restitute: ${option}=${${option}} is REQUIRED, but cannot be built: ${title}. Missing: ${missing}. "
                        "AUTO builds without it.")
  endif()
endfunction()

foreach(part IN LISTS RESTITUTE_PARTS)
  set(option RESTITUTE_${part})
  if(NOT "${${option}}" MATCHES "^(AUTO|ON|OFF|YES|NO|TRUE|FALSE|1|0)$")
    message(FATAL_ERROR "restitute: ${option}=${${option}}: must be AUTO, ON or OFF")
  endif()
endforeach()

# Without it batches are solved by one thread, with the same results.
if(RESTITUTE_OPENMP)
  find_package(OpenMP QUIET COMPONENTS C)
  set(restitute_openmp_names ${OpenMP_C_LIB_NAMES})
  if(NOT CMAKE_C_COMPILER_ID STREQUAL "GNU") # linkers do not look where LLVM's is
    set(restitute_openmp_names ${OpenMP_C_LIBRARIES})
  endif()
endif()
restitute_decide(OPENMP "openmp (several threads in C)" OpenMP_C_FOUND "${need_openmp}")

if(RESTITUTE_FILES)
  restitute_find_pkg_config_library(JANSSON jansson)
endif()
restitute_decide(FILES "files (material files)" ${pkg_config} JANSSON_FOUND "${need_jansson}")

restitute_decide(CONTACT "contact (the force of soft-sphere DEM)")

restitute_decide(TABLE "table (tables of e_z and e_x)")

# The serial HDF5 goes before whatever stands under the plain name, which may want MPI.
if(RESTITUTE_TABLE_FILES)
  set(RESTITUTE_HDF5_MODULE hdf5-serial)
  restitute_find_pkg_config_library(HDF5 hdf5-serial)
  if(NOT HDF5_FOUND)
    set(RESTITUTE_HDF5_MODULE hdf5)
    restitute_find_pkg_config_library(HDF5 hdf5)
  endif()
endif()
restitute_decide(TABLE_FILES "table_files (HDF5 files of tables)" ${pkg_config} #
                 RESTITUTE_WITH_TABLE "the component table" HDF5_FOUND "${need_hdf5}")

# Only the version is looked at here: from 6.4 on the interface is the same but for what
# src/cvode/integrator.c knows.
if(RESTITUTE_CVODE)
  # Packages made with OpenMP ask for it, though the two libraries taken here do not use it; clang
  # often has none.
  if(NOT TARGET OpenMP::OpenMP_C)
    add_library(OpenMP::OpenMP_C INTERFACE IMPORTED)
  endif()
  find_package(SUNDIALS QUIET COMPONENTS cvode nvecserial)
  set(RESTITUTE_SUNDIALS_FITS OFF)
  if(SUNDIALS_FOUND AND SUNDIALS_VERSION VERSION_GREATER_EQUAL 6.4 AND SUNDIALS_VERSION VERSION_LESS 8)
    set(RESTITUTE_SUNDIALS_FITS ON)
  endif()
endif()
restitute_decide(CVODE "cvode (the method cvode)" RESTITUTE_SUNDIALS_FITS "${need_sundials}")

if(RESTITUTE_BEM)
  restitute_find_pkg_config_library(FFTW fftw3)
  find_package(Threads QUIET)
endif()
restitute_decide(BEM "bem (boundary elements, under the GPL)" ${pkg_config} #
                 FFTW_FOUND "${need_fftw}" Threads_FOUND "POSIX threads")

if(RESTITUTE_FIT)
  restitute_find_pkg_config_library(GSL "gsl>=2.7")
  find_package(Threads QUIET)
endif()
restitute_decide(FIT "fit (constants from measurements, under the GPL)" ${pkg_config} #
                 GSL_FOUND "${need_gsl}" Threads_FOUND "POSIX threads")

# The first Python that has what the package needs: that of the path may be another than Debian's.
if(RESTITUTE_PYTHON)
  include(restitute-python)
endif()
restitute_decide(PYTHON "python (the Python package and the command)" #
                 BUILD_SHARED_LIBS "shared libraries (BUILD_SHARED_LIBS=ON)" #
                 RESTITUTE_WITH_FILES "the component files" #
                 RESTITUTE_PYTHON_FOUND "${RESTITUTE_PYTHON_NEEDS}")

# The kernel needs a Fortran compiler and no more; the module is for programs that need its run-time
# library.
if(RESTITUTE_FORTRAN)
  include(CheckSourceCompiles)
  check_source_compiles(Fortran "program hello\n  print '(a)', 'hello'\nend program hello\n"
                        RESTITUTE_FORTRAN_PROGRAMS_LINK SRC_EXT f90)
endif()
restitute_decide(FORTRAN "fortran (the Fortran modules)" RESTITUTE_FORTRAN_PROGRAMS_LINK "the Fortran run-time library")

# The components that are built, besides core; each has a folder of src, a header, a package file
# and a Fortran module. table comes before table_files, which uses it.
set(RESTITUTE_COMPONENTS "")
foreach(component IN ITEMS bem contact cvode files fit table table_files)
  string(TOUPPER "RESTITUTE_WITH_${component}" with)
  if(${with})
    list(APPEND RESTITUTE_COMPONENTS ${component})
  endif()
endforeach()

if(RESTITUTE_TESTS)
  restitute_find_pkg_config_library(CMOCKA cmocka)
  if(NOT CMOCKA_FOUND)
    message(FATAL_ERROR "restitute: RESTITUTE_TESTS=${RESTITUTE_TESTS}, but the tests cannot be built; missing: "
                        "${need_cmocka}, found by pkg-config")
  endif()
endif()

# What was built and what not, in words; for other projects that add this one, quietly.
get_property(built GLOBAL PROPERTY RESTITUTE_BUILT)
list(JOIN built ", " built)
message(STATUS "restitute ${PROJECT_VERSION}: core, ${built}; tests ${RESTITUTE_TESTS}, sanitizers ${RESTITUTE_SANITIZE}")
get_property(unwanted GLOBAL PROPERTY RESTITUTE_UNWANTED)
if(unwanted)
  list(JOIN unwanted ", " unwanted)
  message(STATUS "restitute: not wanted (OFF): ${unwanted}")
endif()
set(level STATUS)
if(PROJECT_IS_TOP_LEVEL)
  set(level NOTICE)
endif()
get_property(left_out GLOBAL PROPERTY RESTITUTE_LEFT_OUT)
foreach(part IN LISTS left_out)
  message(${level} "restitute: left out: ${part}")
endforeach()
