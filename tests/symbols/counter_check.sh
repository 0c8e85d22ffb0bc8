#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Shows that check.sh and objects.sh can fail: all their complaints must come for a library that
# deserves them, and they fail with a tool that fails.
#   counter_check.sh LIBRARY OBJECT GOOD_LIBRARY GOOD_OBJECT...
set -eu
openmp=$WITH_OPENMP # the library has it only where there is one
headers=$HEADERS include=$INCLUDE
mkdir -p include/restitute
echo "int restitute_absent(int value);" >include/restitute/leaky.h
WITH_OPENMP=OFF WITHOUT=GFORTRAN HEADERS=leaky.h INCLUDE=include
export WITH_OPENMP WITHOUT HEADERS INCLUDE
if sh "$(dirname -- "$0")/check.sh" "$1" >complaints 2>&1; then
    echo "check.sh finds nothing wrong with $1" >&2
    exit 1
fi
if sh "$(dirname -- "$0")/objects.sh" "$2" >>complaints 2>&1; then
    echo "objects.sh finds nothing wrong with $2" >&2
    exit 1
fi
for complaint in "other names than rst_\* and restitute_\*: leaky_name" "$2 takes memory" \
    "other names than restitute_\*: leaky_name" "leaky.h: no RESTITUTE_SINCE_x_y before: restitute_absent" \
    "does not define restitute_absent" "defines restitute_private_name, which is not in leaky.h" \
    "does not need librestitute" "calls the Fortran run-time library: _gfortran" \
    "needs a Fortran run-time library: libgfortran" "needs what it must do without: libgfortran" \
    "prints: puts" "ends the program: abort"; do
    grep "$complaint" complaints || { cat complaints; echo "no complaint '$complaint'" >&2; exit 1; }
done
[ "$openmp" = OFF ] || grep "needs OpenMP in a build without it: lib" complaints || { cat complaints; exit 1; }

# What is good passes, but not by a tool that fails, even if it tells all.
WITH_OPENMP=$openmp WITHOUT=hdf5 HEADERS=$headers INCLUDE=$include
here=$(dirname -- "$0") nm=$NM readelf=$READELF cc=$CC library=$3
shift 3
printf '#!/bin/sh\n"%s" "$@"\nexit 1\n' "$nm" >failing_nm
printf '#!/bin/sh\n"%s" "$@"\nexit 1\n' "$readelf" >failing_readelf
printf '#!/bin/sh\n"%s" "$@"\nexit 1\n' "$cc" >failing_cc
chmod 755 failing_nm failing_readelf failing_cc
passes() { # NM READELF CC SCRIPT FILE...
    NM=$1 READELF=$2 CC=$3 script=$here/$4
    export NM READELF CC
    shift 4
    sh "$script" "$@" >said 2>&1
}
passes "$nm" "$readelf" "$cc" check.sh "$library" && passes "$nm" "$readelf" "$cc" objects.sh "$@" ||
    { cat said; exit 1; }
if passes ./failing_nm "$readelf" "$cc" check.sh "$library" ||
    passes "$nm" ./failing_readelf "$cc" check.sh "$library" ||
    passes "$nm" "$readelf" ./failing_cc check.sh "$library" ||
    passes ./failing_nm "$readelf" "$cc" objects.sh "$@"; then
    echo "a tool that fails is not noticed" >&2
    exit 1
fi
