# SPDX-License-Identifier: BSD-3-Clause
# Finds a Python that has NumPy and cffi: Python3_EXECUTABLE if it is given, else the first of these
# that has them. Sets RESTITUTE_PYTHON_FOUND and Python3_EXECUTABLE. pip builds wheels in an
# environment without NumPy, which the build does not need.
set(RESTITUTE_PYTHON_FOUND OFF)
set(modules numpy,cffi)
if(SKBUILD)
  set(modules cffi)
endif()
foreach(python IN ITEMS "${Python3_EXECUTABLE}" python3 /usr/bin/python3)
  if(python AND NOT RESTITUTE_PYTHON_FOUND)
    execute_process(COMMAND "${python}" -c "import sys, ${modules}; assert sys.version_info >= (3, 9); print(sys.executable)"
                    OUTPUT_VARIABLE executable RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT failed)
      set(RESTITUTE_PYTHON_FOUND ON)
      set(Python3_EXECUTABLE "${executable}" CACHE FILEPATH "Python with NumPy and cffi")
    endif()
  endif()
endforeach()
# The command in the build tree.
set(RESTITUTE_COMMAND_FILE "${PROJECT_BINARY_DIR}/python/bin/restitute")
