# SPDX-License-Identifier: BSD-3-Clause
# The Debian packages that cpack makes, each of the files of one COMPONENT of the installation. bem
# and fit, which are under the GPL, are apart, and so are the components that need large libraries.
find_program(RESTITUTE_DPKG dpkg DOC "dpkg, for Debian packages")
mark_as_advanced(RESTITUTE_DPKG)
set(CPACK_GENERATOR TGZ)
if(RESTITUTE_DPKG)
  set(CPACK_GENERATOR DEB)
endif()
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_LIST_DIR}/restitute-package-options.cmake")
set(CPACK_PACKAGE_NAME restitute)
set(CPACK_PACKAGE_CONTACT "The restitute developers <restitute@localhost>" CACHE STRING "Maintainer named in the packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL "")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${RESTITUTE_COMPONENTS})
list(TRANSFORM CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS PREPEND "${PROJECT_BINARY_DIR}/src/")
list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/src")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/restitute-package-copyright.cmake")
set(CPACK_RESTITUTE_SOURCE_DIR "${PROJECT_SOURCE_DIR}")

# restitute_describe_package(<component> <name> SECTION <section> ABOUT <title> <text> [DEPENDS
# <package>...] [RECOMMENDS <package>...] [SUGGESTS <package>...] [NO_BINARIES] [ANY_MACHINE])
macro(restitute_describe_package component name)
  cmake_parse_arguments(package "NO_BINARIES;ANY_MACHINE" "SECTION" "ABOUT;DEPENDS;RECOMMENDS;SUGGESTS" ${ARGN})
  string(TOUPPER "${component}" part)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  list(JOIN package_ABOUT "\n" CPACK_COMPONENT_${part}_DESCRIPTION)
  set(CPACK_DEBIAN_${part}_PACKAGE_NAME "${name}")
  set(CPACK_DEBIAN_${part}_PACKAGE_SECTION "${package_SECTION}")
  foreach(relation IN ITEMS DEPENDS RECOMMENDS SUGGESTS)
    list(JOIN package_${relation} ", " CPACK_DEBIAN_${part}_PACKAGE_${relation})
  endforeach()
  if(package_ANY_MACHINE)
    set(CPACK_DEBIAN_${part}_PACKAGE_ARCHITECTURE all)
  endif()
  if(package_NO_BINARIES)
    set(CPACK_DEBIAN_${part}_PACKAGE_SHLIBDEPS OFF)
  endif()
endmacro()

set(this_version "(= ${PROJECT_VERSION})")
set(library "librestitute${PROJECT_VERSION_MAJOR}")
restitute_describe_package(
  library ${library} SECTION libs
  ABOUT "oblique impact of viscoelastic spheres: libraries"
        "Normal and tangential restitution of viscoelastic spheres that hit obliquely, with friction."
        "This package has the shared libraries."
  RECOMMENDS "restitute-data ${this_version}")
restitute_describe_package(
  development librestitute-dev NO_BINARIES SECTION libdevel
  ABOUT "oblique impact of viscoelastic spheres: for C, C++ and Fortran"
        "Headers and Fortran modules of librestitute, and what CMake and pkg-config need to find it."
  DEPENDS "${library} ${this_version}"
  SUGGESTS "gfortran" "pkg-config" "restitute-doc")
set(about_bem "boundary elements (GPL)" "The method bem of librestitute, on FFTW: under the GPL, version 2 or later.")
set(about_cvode "the method cvode" "The method cvode of librestitute, on SUNDIALS: impacts with their events.")
set(about_fit "constants from measurements (GPL)"
              "Material constants from drop tests and DMA, on GSL: under the GPL, version 3 or later.")
set(about_table_files "HDF5 files of tables" "Tables of restitution coefficients in HDF5 files, from C and Fortran.")
set(apart "")
foreach(component IN LISTS RESTITUTE_APART)
  if(component IN_LIST RESTITUTE_COMPONENTS)
    string(REPLACE "_" "-" name "librestitute-${component}")
    list(APPEND apart ${name})
    list(TRANSFORM about_${component} PREPEND "oblique impact of viscoelastic spheres: " AT 0)
    restitute_describe_package(
      ${component} ${name} SECTION libs
      ABOUT ${about_${component}} "The headers and the Fortran module want librestitute-dev."
      DEPENDS "${library} ${this_version}"
      SUGGESTS "librestitute-dev")
  endif()
endforeach()
if(RESTITUTE_WITH_PYTHON)
  restitute_describe_package(
    python restitute NO_BINARIES SECTION science
    ABOUT "oblique impact of viscoelastic spheres: command and Python package"
          "The command restitute and the Python package restitute: restitution coefficients, tables,"
          "maps and figures of viscoelastic spheres that hit obliquely, with friction."
    DEPENDS "${library} ${this_version}" "restitute-data ${this_version}" "python3 (>= 3.9)" python3-numpy python3-cffi
    RECOMMENDS python3-matplotlib python3-h5py python3-tqdm
    SUGGESTS ${apart} restitute-doc python3-distributed python3-mpi4py)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_PROVIDES "python3-restitute ${this_version}")
  # The byte code of the Python package comes and goes with it.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/debian/postinst"
                                                "${CMAKE_CURRENT_LIST_DIR}/debian/prerm")
endif()
restitute_describe_package(
  data restitute-data ANY_MACHINE NO_BINARIES SECTION science
  ABOUT "oblique impact of viscoelastic spheres: materials and reference impacts"
        "Material constants with their sources, which restitute finds by name, and reference impacts"
        "to test other programs with.")
restitute_describe_package(
  doc restitute-doc ANY_MACHINE NO_BINARIES SECTION doc
  ABOUT "oblique impact of viscoelastic spheres: pages and examples"
        "Manual, theory, records of accuracy and run time, examples in Python, C and Fortran.")
include(CPack)
