# SPDX-License-Identifier: BSD-3-Clause
# Read by cpack before it makes packages: says what it lacks, in words.
if(CPACK_GENERATOR STREQUAL "DEB")
  foreach(tool IN ITEMS file dpkg-shlibdeps readelf)
    find_program(RESTITUTE_TOOL_${tool} ${tool})
    if(NOT RESTITUTE_TOOL_${tool})
      message(FATAL_ERROR "cpack needs the program ${tool} to make Debian packages; "
                          "cmake/install-packages.sh package installs it")
    endif()
  endforeach()
endif()
