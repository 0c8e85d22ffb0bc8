#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Shows that check.sh and objects.sh can fail: all their complaints must come for a library that deserves them.
#   counter_check.sh LIBRARY OBJECT
set -eu
openmp=$WITH_OPENMP # the library has it only where there is one
WITH_OPENMP=OFF
export WITH_OPENMP
if sh "$(dirname -- "$0")/check.sh" "$1" >complaints 2>&1; then
    echo "check.sh finds nothing wrong with $1" >&2
    exit 1
fi
if sh "$(dirname -- "$0")/objects.sh" "$2" >>complaints 2>&1; then
    echo "objects.sh finds nothing wrong with $2" >&2
    exit 1
fi
for complaint in "other names than rst_\* and restitute_\*: leaky_name" "$2 takes memory" \
    "other names than restitute_\*: leaky_name" "calls the Fortran run-time library: _gfortran" \
    "needs a Fortran run-time library: libgfortran" "prints: puts" "ends the program: abort"; do
    grep "$complaint" complaints || { cat complaints; echo "no complaint '$complaint'" >&2; exit 1; }
done
[ "$openmp" = OFF ] || grep "needs OpenMP in a build without it: lib" complaints || { cat complaints; exit 1; }
