# SPDX-License-Identifier: BSD-3-Clause
# What every target of the project has in common: language standards, warnings, sanitizers, what
# leaves a library.
include(CheckCompilerFlag)
include(CheckLinkerFlag)

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
  message(STATUS "restitute: no build type given, Release taken")
endif()

set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)

# CMake would link every target that holds Fortran objects with the Fortran run-time libraries. The
# kernel calls none of them (a test proves it), and a C program must not come to need them.
set(CMAKE_Fortran_IMPLICIT_LINK_LIBRARIES "")
set(CMAKE_Fortran_IMPLICIT_LINK_DIRECTORIES "")

# Sets `result` to those of the flags that the compiler of `language` accepts.
function(restitute_accepted_flags language result)
  set(accepted "")
  foreach(flag IN LISTS ARGN)
    string(MAKE_C_IDENTIFIER "RESTITUTE_${language}_ACCEPTS${flag}" known)
    check_compiler_flag(${language} ${flag} ${known})
    if(${known})
      list(APPEND accepted ${flag})
    endif()
  endforeach()
  set(${result} ${accepted} PARENT_SCOPE)
endfunction()

# No contraction to fused multiply-add: the same numbers on every machine that has IEEE arithmetic.
# Clang would compute both branches of a selection, and so divide by 0 where the source does not:
# hosts trap that. POSIX for files, clocks and newlocale, by which numbers in texts have a point
# (src/base/report.h).
restitute_accepted_flags(C RESTITUTE_C_FLAGS -Wall -Wextra -ffp-contract=off -ffp-exception-behavior=maytrap)
list(APPEND RESTITUTE_C_FLAGS -D_POSIX_C_SOURCE=200809L)
restitute_accepted_flags(Fortran RESTITUTE_FORTRAN_FLAGS -std=f2018 -Wall -Wextra -ffp-contract=off -fopenmp-simd)

# In a shared library every procedure could be replaced by one of the same name from outside, so
# compilers do not inline them, unless told that nobody will.
restitute_accepted_flags(Fortran interposition_flags -fno-semantic-interposition)
list(APPEND RESTITUTE_FORTRAN_FLAGS ${interposition_flags})

# Programs in Fortran, which may use the system's intrinsic modules and the Fortran run-time
# library. -fimplicit-none holds in interface bodies, too, which do not inherit the implicit none of
# their module.
restitute_accepted_flags(Fortran RESTITUTE_FORTRAN_PROGRAM_FLAGS -std=f2018 -Wall -Wextra -fimplicit-none)

# gfortran reads a header of the C library that lets it take vector versions of exp and the like.
# Those are a library more to link, and their last digits depend on the processor; without the
# system's headers it takes libm's.
if(CMAKE_Fortran_COMPILER_ID STREQUAL "GNU")
  list(APPEND RESTITUTE_FORTRAN_FLAGS -nostdinc)
endif()

if(RESTITUTE_SANITIZE)
  set(sanitizers -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  list(APPEND RESTITUTE_C_FLAGS ${sanitizers})
  # Each family of compilers brings a run-time library of its own: with another one than gfortran's,
  # C alone is watched.
  if(CMAKE_C_COMPILER_ID STREQUAL CMAKE_Fortran_COMPILER_ID)
    list(APPEND RESTITUTE_FORTRAN_FLAGS ${sanitizers})
    list(APPEND RESTITUTE_FORTRAN_PROGRAM_FLAGS ${sanitizers})
  endif()
  add_link_options(${sanitizers})
endif()

if(RESTITUTE_COVERAGE)
  set(counters --coverage -fprofile-update=atomic)
  list(APPEND RESTITUTE_C_FLAGS ${counters})
  list(APPEND RESTITUTE_FORTRAN_FLAGS ${counters})
  add_link_options(--coverage)
endif()

# What Debian asks of programs that read files of others. Fortran calls nothing that could be
# checked.
set(RESTITUTE_HARDENED OFF)
if(RESTITUTE_HARDEN AND NOT RESTITUTE_SANITIZE AND CMAKE_BUILD_TYPE MATCHES "^(Release|RelWithDebInfo|MinSizeRel)$")
  set(RESTITUTE_HARDENED ON)
  restitute_accepted_flags(C hardening_flags -fstack-protector-strong)
  list(APPEND RESTITUTE_C_FLAGS ${hardening_flags} -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2)
  foreach(flag IN ITEMS relro now)
    check_linker_flag(C "-Wl,-z,${flag}" RESTITUTE_LINKER_ACCEPTS_${flag})
    if(RESTITUTE_LINKER_ACCEPTS_${flag})
      add_link_options("-Wl,-z,${flag}")
    endif()
  endforeach()
endif()

# Flags of our own code for a target, whatever its languages.
function(restitute_common_flags target)
  target_compile_options(${target} PRIVATE "$<$<COMPILE_LANGUAGE:C>:${RESTITUTE_C_FLAGS}>"
                                           "$<$<COMPILE_LANGUAGE:Fortran>:${RESTITUTE_FORTRAN_FLAGS}>")
endfunction()

# The same for a Fortran program, or a library for Fortran programs. The Fortran compiler links it
# and thereby adds the run-time library that is kept from the kernel above.
function(restitute_fortran_program target)
  target_compile_options(${target} PRIVATE "$<$<COMPILE_LANGUAGE:C>:${RESTITUTE_C_FLAGS}>"
                                           "$<$<COMPILE_LANGUAGE:Fortran>:${RESTITUTE_FORTRAN_PROGRAM_FLAGS}>")
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE Fortran)
endfunction()

set(RESTITUTE_EXPORT_MAP "${PROJECT_SOURCE_DIR}/cmake/restitute.map")
check_linker_flag(C "-Wl,--version-script=${RESTITUTE_EXPORT_MAP}" RESTITUTE_LINKER_HAS_VERSION_SCRIPTS)

check_linker_flag(C "-Wl,--push-state,--no-as-needed,--pop-state" RESTITUTE_LINKER_HAS_AS_NEEDED)

# Has a component name librestitute among what it needs, though it may call nothing of it: a method
# is of the version of the core that it was built with.
function(restitute_needs_core target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND RESTITUTE_LINKER_HAS_AS_NEEDED)
    target_link_options(${target} PRIVATE
                        "-Wl,--push-state,--no-as-needed,$<TARGET_FILE:restitute_core>,--pop-state")
  endif()
endfunction()

# Lets only restitute_* out of a shared library. Where the linker knows no version scripts, hidden
# visibility still keeps our C helpers in, and the Fortran kernel's rst_* remain visible, which
# harms nobody.
function(restitute_limit_exports target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY" AND RESTITUTE_LINKER_HAS_VERSION_SCRIPTS)
    target_link_options(${target} PRIVATE "-Wl,--version-script=${RESTITUTE_EXPORT_MAP}")
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS "${RESTITUTE_EXPORT_MAP}")
  endif()
endfunction()

# restitute_library(<component>): what the libraries share, after their own links. The Fortran
# compiler would add its run-time libraries.
function(restitute_library component)
  set(target restitute_${component})
  add_library(restitute::${component} ALIAS ${target})
  if(RESTITUTE_MATH_LIBRARY)
    target_link_libraries(${target} PRIVATE m)
  endif()
  set_target_properties(
    ${target}
    PROPERTIES EXPORT_NAME ${component}
               LINKER_LANGUAGE C
               POSITION_INDEPENDENT_CODE ON
               VERSION ${PROJECT_VERSION}
               SOVERSION ${PROJECT_VERSION_MAJOR}
               INSTALL_RPATH "$ORIGIN")
  restitute_limit_exports(${target})
endfunction()
