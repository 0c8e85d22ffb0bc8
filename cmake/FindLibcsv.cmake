# SPDX-License-Identifier: BSD-3-Clause
# Finds libcsv, which brings neither a CMake package nor a pkg-config file.
#   Libcsv_FOUND     whether it was found
#   Libcsv::Libcsv   the target to link
find_path(Libcsv_INCLUDE_DIR NAMES csv.h DOC "Directory of libcsv's csv.h")
find_library(Libcsv_LIBRARY NAMES csv DOC "The library libcsv")
mark_as_advanced(Libcsv_INCLUDE_DIR Libcsv_LIBRARY)

# csv.h is a common name; only libcsv's has this function.
if(Libcsv_INCLUDE_DIR)
  file(STRINGS "${Libcsv_INCLUDE_DIR}/csv.h" libcsv_signature REGEX "csv_parse" LIMIT_COUNT 1)
  file(STRINGS "${Libcsv_INCLUDE_DIR}/csv.h" Libcsv_VERSION REGEX "#define CSV_(MAJOR|MINOR|RELEASE) ")
  list(TRANSFORM Libcsv_VERSION REPLACE "^#define CSV_[A-Z]+ +([0-9]+).*$" "\\1")
  list(JOIN Libcsv_VERSION "." Libcsv_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  Libcsv
  REQUIRED_VARS Libcsv_LIBRARY Libcsv_INCLUDE_DIR libcsv_signature
  VERSION_VAR Libcsv_VERSION)

if(Libcsv_FOUND AND NOT TARGET Libcsv::Libcsv)
  add_library(Libcsv::Libcsv UNKNOWN IMPORTED)
  set_target_properties(Libcsv::Libcsv PROPERTIES IMPORTED_LOCATION "${Libcsv_LIBRARY}" #
                                                  INTERFACE_INCLUDE_DIRECTORIES "${Libcsv_INCLUDE_DIR}")
endif()
