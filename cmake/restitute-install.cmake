# SPDX-License-Identifier: BSD-3-Clause
# Installation: libraries, headers, command, pages, and what CMake and pkg-config need to find them.
# All paths in the installed files are relative to those files, so the tree may be moved. COMPONENT
# says into which package a file goes (restitute-package.cmake).
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/restitute")
string(REGEX MATCH "^[0-9]+" fortran_major "${CMAKE_Fortran_COMPILER_VERSION}")
set(fortran_made_by "${CMAKE_Fortran_COMPILER_ID} ${fortran_major}")

# Components with a package of their own, since they need further libraries or are under the GPL.
set(RESTITUTE_APART bem cvode fit table_files)

# Sets `library` and `development` to the packages of a component.
macro(restitute_find_packages component)
  set(library library)
  set(development development)
  if("${component}" IN_LIST RESTITUTE_APART)
    set(library ${component})
    set(development ${component})
  endif()
endmacro()

# restitute_install_component(<component> <header>...)
function(restitute_install_component component)
  restitute_find_packages(${component})
  install(
    TARGETS restitute_${component}
    EXPORT restitute-${component}
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT ${library}
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${library} NAMELINK_COMPONENT ${development}
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${development})
  install(
    EXPORT restitute-${component}
    FILE restitute-${component}.cmake
    NAMESPACE restitute::
    DESTINATION "${package_dir}"
    COMPONENT ${development})
  install(FILES ${ARGN} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/restitute" COMPONENT ${development})
endfunction()

# restitute_install_pkg_config(<component> <file.pc> [<name.pc>]): from cmake/<file.pc>.in, under
# another name if one is given
function(restitute_install_pkg_config component file)
  restitute_find_packages(${component})
  set(name "${file}" ${ARGN})
  list(GET name -1 name)
  configure_file("${PROJECT_SOURCE_DIR}/cmake/${file}.in" "${PROJECT_BINARY_DIR}/cmake/${name}" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/cmake/${name}" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig"
          COMPONENT ${development})
endfunction()
file(RELATIVE_PATH pc_to_prefix "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
file(RELATIVE_PATH prefix_to_lib "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_LIBDIR}")
file(RELATIVE_PATH prefix_to_include "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_FULL_INCLUDEDIR}")

set(headers "${PROJECT_SOURCE_DIR}/include/restitute")
restitute_install_component(core "${headers}/api.h" "${headers}/restitute.h" "${headers}/status.h")
set(openmp_flags "")
if(RESTITUTE_WITH_OPENMP)
  list(TRANSFORM restitute_openmp_names REPLACE "^([^/].*)" "-l\\1" OUTPUT_VARIABLE openmp_flags)
  list(JOIN openmp_flags " " openmp_flags)
  string(PREPEND openmp_flags " ")
endif()
restitute_install_pkg_config(core restitute.pc)
set(sundials_core "")
if(RESTITUTE_WITH_CVODE AND SUNDIALS_VERSION VERSION_GREATER_EQUAL 7)
  set(sundials_core " -lsundials_core")
endif()
foreach(component IN LISTS RESTITUTE_COMPONENTS)
  restitute_install_component(${component} "${headers}/${component}.h")
  restitute_install_pkg_config(${component} restitute-${component}.pc)
endforeach()
if(RESTITUTE_WITH_FORTRAN)
  set(fortran_dir "${RESTITUTE_INSTALL_FORTRANDIR}")
  file(RELATIVE_PATH prefix_to_fortran "${CMAKE_INSTALL_PREFIX}" "${CMAKE_INSTALL_PREFIX}/${fortran_dir}")

  # restitute_install_module(<component> <target> <name> <module>...): the library restitute_<name>
  # and what its sources define
  function(restitute_install_module component target name)
    restitute_find_packages(${component})
    install(TARGETS ${target} EXPORT restitute-${name} ARCHIVE DESTINATION "${fortran_dir}" COMPONENT ${development})
    install(EXPORT restitute-${name} FILE restitute-${name}.cmake NAMESPACE restitute:: DESTINATION "${package_dir}"
            COMPONENT ${development})
    list(TRANSFORM ARGN PREPEND "$<TARGET_PROPERTY:${target},Fortran_MODULE_DIRECTORY>/")
    list(TRANSFORM ARGN APPEND ".mod")
    install(FILES ${ARGN} DESTINATION "${fortran_dir}" COMPONENT ${development})
    get_target_property(sources ${target} SOURCES)
    list(TRANSFORM sources PREPEND "${PROJECT_SOURCE_DIR}/fortran/public/")
    install(FILES ${sources} DESTINATION "${CMAKE_INSTALL_DATADIR}/restitute/fortran" COMPONENT ${development})
  endfunction()

  restitute_install_module(core restitute_fortran_module fortran restitute_types_module restitute_texts_module
                           restitute_core_module restitute)
  restitute_install_pkg_config(core restitute-fortran.pc)
  foreach(component IN LISTS RESTITUTE_COMPONENTS)
    restitute_install_module(${component} restitute_${component}_module fortran_${component}
                             restitute_${component}_module)
    set(needs "")
    if(component STREQUAL "table_files")
      set(needs ", restitute-fortran_table = ${PROJECT_VERSION}")
    endif()
    restitute_install_pkg_config(${component} restitute-fortran_component.pc restitute-fortran_${component}.pc)
  endforeach()
endif()
if(RESTITUTE_WITH_PYTHON)
  install(FILES "${PROJECT_SOURCE_DIR}/docs/restitute.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT python)
endif()

# The pages with their figures, and the examples, in folders as here: links between them hold.
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_SOURCE_DIR}/CITATION.cff"
        DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc
        FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png" PATTERN "*.jpg")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc
        PATTERN "__pycache__" EXCLUDE)

# With FFTW and GSL the binaries are under their licences. Each package gets a text of its own
# (restitute-package-copyright.cmake).
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" copyright)
foreach(component IN LISTS RESTITUTE_COMPONENTS)
  if(EXISTS "${PROJECT_SOURCE_DIR}/cmake/copyright-${component}")
    file(READ "${PROJECT_SOURCE_DIR}/cmake/copyright-${component}" copyright_of_component)
    string(APPEND copyright "\n${copyright_of_component}")
  endif()
endforeach()
file(WRITE "${PROJECT_BINARY_DIR}/cmake/copyright" "${copyright}")
install(FILES "${PROJECT_BINARY_DIR}/cmake/copyright" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT copyright)

install(FILES "${PROJECT_SOURCE_DIR}/tests/data/reference_impacts.csv"
              "${PROJECT_SOURCE_DIR}/tests/data/reference_impacts.LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/restitute")

configure_package_config_file(cmake/restitute-config.cmake.in cmake/restitute-config.cmake
                              INSTALL_DESTINATION "${package_dir}" NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/cmake/restitute-config-version.cmake"
                                 COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/cmake/restitute-config.cmake"
              "${PROJECT_BINARY_DIR}/cmake/restitute-config-version.cmake" DESTINATION "${package_dir}"
        COMPONENT development)
