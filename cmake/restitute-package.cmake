# SPDX-License-Identifier: BSD-3-Clause
# The Debian package that cpack makes: one .deb with all that the install target installs.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME restitute)
set(CPACK_PACKAGE_CONTACT "The restitute developers <restitute@localhost>" CACHE STRING "Maintainer named in the package")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${RESTITUTE_COMPONENTS})
list(TRANSFORM CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS PREPEND "${PROJECT_BINARY_DIR}/src/")
list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/src")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
if(RESTITUTE_WITH_PYTHON)
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-numpy, python3-cffi")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-matplotlib, python3-h5py, python3-tqdm")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "gfortran, python3-distributed, python3-mpi4py")
set(CPACK_PACKAGE_DESCRIPTION
    "Restitution pairs of viscoelastic spheres that hit obliquely, with
friction, by the Method of Dimensionality Reduction: the command
restitute, the Python package, the libraries for C and C++, the modules
for Fortran.")
include(CPack)
