# SPDX-License-Identifier: BSD-3-Clause
# For Debian's gcc-aarch64-linux-gnu, gfortran-aarch64-linux-gnu and qemu-user. ARM_ROOT in the
# environment: where packages of arm64 were unpacked (SUNDIALS, FFTW, GSL, Jansson), or nothing.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_Fortran_COMPILER aarch64-linux-gnu-gfortran)
set(CMAKE_FIND_ROOT_PATH "$ENV{ARM_ROOT}" /usr/aarch64-linux-gnu "$ENV{ARM_PREFIX}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
set(ENV{PKG_CONFIG_LIBDIR} "$ENV{ARM_ROOT}/usr/lib/aarch64-linux-gnu/pkgconfig")
set(ENV{PKG_CONFIG_SYSROOT_DIR} "$ENV{ARM_ROOT}")
