# SPDX-License-Identifier: BSD-3-Clause
# Decides which optional parts are built, and says by name and package what is missing for those
# that are not. Sets RESTITUTE_WITH_<part> for each of RESTITUTE_PARTS.

# The packages that the wanted parts need. Each leaves <name>_FOUND.
macro(restitute_find_pkg_config_library prefix module)
  find_package(PkgConfig QUIET)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(${prefix} QUIET IMPORTED_TARGET ${module})
  endif()
endmacro()

# restitute_decide(<option> <title> <result> [<found> <what is missing if not found>]...)
function(restitute_decide option title result)
  set(${result} OFF PARENT_SCOPE)
  if(NOT "${${option}}" STREQUAL "AUTO" AND NOT "${${option}}")
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
  list(JOIN missing ", " missing)
  if(NOT missing)
    set(${result} ON PARENT_SCOPE)
  elseif("${${option}}" STREQUAL "AUTO")
    message(STATUS "restitute: not built: ${title}; missing: ${missing}")
  else()
    message(FATAL_ERROR "restitute: ${option}=${${option}}, but ${title} cannot be built; missing: ${missing}")
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
endif()
restitute_decide(RESTITUTE_OPENMP "batches by several threads" RESTITUTE_WITH_OPENMP #
                 OpenMP_C_FOUND "OpenMP for C (Debian: gcc has it, clang wants libomp-dev)")

if(RESTITUTE_FILES)
  restitute_find_pkg_config_library(JANSSON jansson)
endif()
restitute_decide(RESTITUTE_FILES "the component files" RESTITUTE_WITH_FILES #
                 JANSSON_FOUND "Jansson (Debian: libjansson-dev, found by pkg-config)")

restitute_decide(RESTITUTE_CONTACT "the component contact" RESTITUTE_WITH_CONTACT)

restitute_decide(RESTITUTE_TABLE "the component table" RESTITUTE_WITH_TABLE)

# The serial HDF5 goes before whatever stands under the plain name, which may want MPI.
if(RESTITUTE_TABLE_FILES)
  set(RESTITUTE_HDF5_MODULE hdf5-serial)
  restitute_find_pkg_config_library(HDF5 hdf5-serial)
  if(NOT HDF5_FOUND)
    set(RESTITUTE_HDF5_MODULE hdf5)
    restitute_find_pkg_config_library(HDF5 hdf5)
  endif()
endif()
restitute_decide(RESTITUTE_TABLE_FILES "the component table_files" RESTITUTE_WITH_TABLE_FILES #
                 RESTITUTE_WITH_TABLE "the component table (RESTITUTE_TABLE)" #
                 HDF5_FOUND "HDF5 (Debian: libhdf5-dev, found by pkg-config)")

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
restitute_decide(RESTITUTE_CVODE "the component cvode" RESTITUTE_WITH_CVODE #
                 RESTITUTE_SUNDIALS_FITS "SUNDIALS 6.4 to 7 (Debian: libsundials-dev)")

if(RESTITUTE_BEM)
  restitute_find_pkg_config_library(FFTW fftw3)
  find_package(Threads QUIET)
endif()
restitute_decide(RESTITUTE_BEM "the component bem" RESTITUTE_WITH_BEM #
                 FFTW_FOUND "FFTW (Debian: libfftw3-dev, found by pkg-config)" #
                 Threads_FOUND "POSIX threads")

if(RESTITUTE_FIT)
  restitute_find_pkg_config_library(GSL "gsl>=2.7")
  find_package(Threads QUIET)
endif()
restitute_decide(RESTITUTE_FIT "the component fit" RESTITUTE_WITH_FIT #
                 GSL_FOUND "GSL 2.7 (Debian: libgsl-dev, found by pkg-config)" #
                 Threads_FOUND "POSIX threads")

# The first Python that has what the package needs: that of the path may be another than Debian's.
if(RESTITUTE_PYTHON)
  include(restitute-python)
endif()
restitute_decide(RESTITUTE_PYTHON "the Python package" RESTITUTE_WITH_PYTHON #
                 BUILD_SHARED_LIBS "shared libraries (BUILD_SHARED_LIBS)" #
                 RESTITUTE_WITH_FILES "the component files (RESTITUTE_FILES)" #
                 RESTITUTE_PYTHON_FOUND "Python 3.9 with NumPy and cffi (Debian: python3-numpy, python3-cffi)")

# The kernel needs a Fortran compiler and no more; the module is for programs that need its run-time
# library.
if(RESTITUTE_FORTRAN)
  include(CheckSourceCompiles)
  check_source_compiles(Fortran "program hello\n  print '(a)', 'hello'\nend program hello\n"
                        RESTITUTE_FORTRAN_PROGRAMS_LINK SRC_EXT f90)
endif()
restitute_decide(RESTITUTE_FORTRAN "the Fortran modules" RESTITUTE_WITH_FORTRAN #
                 RESTITUTE_FORTRAN_PROGRAMS_LINK "the Fortran run-time library")

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
    message(FATAL_ERROR "restitute: RESTITUTE_TESTS=${RESTITUTE_TESTS}, but the tests cannot be built; missing: cmocka "
                        "(Debian: libcmocka-dev, found by pkg-config)")
  endif()
endif()

set(summary "restitute ${PROJECT_VERSION}:")
foreach(part IN LISTS RESTITUTE_PARTS)
  string(TOLOWER "${part}" name)
  string(APPEND summary " ${name} ${RESTITUTE_WITH_${part}},")
endforeach()
message(STATUS "${summary} tests ${RESTITUTE_TESTS}, sanitizers ${RESTITUTE_SANITIZE}")
