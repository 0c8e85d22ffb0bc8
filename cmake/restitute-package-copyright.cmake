# SPDX-License-Identifier: BSD-3-Clause
# Run by cpack when the files of the packages lie side by side: writes the copyright of each. bem
# and fit are under the licences of what they link.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  if(NOT IS_DIRECTORY "${CPACK_TEMPORARY_DIRECTORY}/${component}")
    continue() # an archive of all files has one copyright, that of the installation
  endif()
  string(TOUPPER "${component}" part)
  file(READ "${CPACK_RESTITUTE_SOURCE_DIR}/LICENSE" copyright)
  if(EXISTS "${CPACK_RESTITUTE_SOURCE_DIR}/cmake/copyright-${component}")
    file(READ "${CPACK_RESTITUTE_SOURCE_DIR}/cmake/copyright-${component}" copyright_of_component)
    string(APPEND copyright "\n${copyright_of_component}")
  endif()
  file(WRITE "${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share/doc/${CPACK_DEBIAN_${part}_PACKAGE_NAME}/copyright"
       "${copyright}")
endforeach()
