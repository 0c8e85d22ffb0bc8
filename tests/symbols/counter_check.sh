#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Shows that check.sh and objects.sh can fail: all their complaints must come for a library that
# deserves them, and they fail with a tool that fails.
#   counter_check.sh LIBRARY OBJECT GOOD_LIBRARY GOOD_OBJECT...
set -eu
openmp=$WITH_OPENMP # the library has it only where there is one
WITH_OPENMP=OFF WITHOUT=GFORTRAN
export WITH_OPENMP WITHOUT
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
    "needs a Fortran run-time library: libgfortran" "needs what it must do without: libgfortran" "prints: puts" "ends the program: abort"; do
    grep "$complaint" complaints || { cat complaints; echo "no complaint '$complaint'" >&2; exit 1; }
done
[ "$openmp" = OFF ] || grep "needs OpenMP in a build without it: lib" complaints || { cat complaints; exit 1; }

# What is good passes, but not by a tool that fails, even if it tells all.
WITH_OPENMP=$openmp WITHOUT=hdf5
here=$(dirname -- "$0") nm=$NM readelf=$READELF library=$3
shift 3
printf '#!/bin/sh\n"%s" "$@"\nexit 1\n' "$nm" >failing_nm
printf '#!/bin/sh\n"%s" "$@"\nexit 1\n' "$readelf" >failing_readelf
chmod 755 failing_nm failing_readelf
passes() { # NM READELF SCRIPT FILE...
    NM=$1 READELF=$2 script=$here/$3
    export NM READELF
    shift 3
    sh "$script" "$@" >said 2>&1
}
passes "$nm" "$readelf" check.sh "$library" && passes "$nm" "$readelf" objects.sh "$@" || { cat said; exit 1; }
if passes ./failing_nm "$readelf" check.sh "$library" || passes "$nm" ./failing_readelf check.sh "$library" ||
    passes ./failing_nm "$readelf" objects.sh "$@"; then
    echo "a tool that fails is not noticed" >&2
    exit 1
fi
