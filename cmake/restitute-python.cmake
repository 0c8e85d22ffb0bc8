# SPDX-License-Identifier: BSD-3-Clause
# Finds a Python that has NumPy and cffi: Python3_EXECUTABLE if it is given, else the first of two
# that has them. Sets RESTITUTE_PYTHON_FOUND, RESTITUTE_PYTHON_NEEDS (what the first of them lacks)
# and Python3_EXECUTABLE. pip builds wheels in an environment without NumPy, which the build does
# not need.
set(RESTITUTE_PYTHON_FOUND OFF)
set(RESTITUTE_PYTHON_NEEDS "")
set(modules numpy cffi)
if(SKBUILD)
  set(modules cffi)
endif()
set(script [[
import sys
def lacks(module):
    try:
        __import__(module)
    except ImportError:
        return True
print(sys.executable, *filter(lacks, sys.argv[1:]), *["version"] * (sys.version_info < (3, 9)), sep=";")]])
set(candidates python3 /usr/bin/python3)
if(Python3_EXECUTABLE)
  set(candidates "${Python3_EXECUTABLE}")
endif()
foreach(python IN LISTS candidates)
  if(NOT RESTITUTE_PYTHON_FOUND)
    execute_process(COMMAND "${python}" -c "${script}" ${modules}
                    OUTPUT_VARIABLE lacks RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(failed)
      continue()
    endif()
    list(POP_FRONT lacks executable)
    if(NOT lacks)
      set(RESTITUTE_PYTHON_FOUND ON)
      set(Python3_EXECUTABLE "${executable}" CACHE FILEPATH "Python with NumPy and cffi")
    elseif(NOT RESTITUTE_PYTHON_NEEDS)
      set(needs "")
      foreach(module IN LISTS lacks)
        list(APPEND needs "${need_${module}}")
      endforeach()
      list(JOIN needs " and " needs)
      set(RESTITUTE_PYTHON_NEEDS "${needs} for ${executable}")
    endif()
  endif()
endforeach()
if(NOT RESTITUTE_PYTHON_NEEDS)
  set(RESTITUTE_PYTHON_NEEDS "${need_version}, ${need_numpy} and ${need_cffi}")
endif()
# The command in the build tree.
set(RESTITUTE_COMMAND_FILE "${PROJECT_BINARY_DIR}/python/bin/restitute")
