#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The Fortran modules declare what the headers do: functions with their arguments, constants,
# layouts of structs.
#   interface.sh agree       compares
#   interface.sh disagree    compares with spoilt headers, each in one place, which has to show
# From the environment: SOURCE_DIR CC FC, MODULES (where the compiled modules are), COMPONENTS
# (those that are built)
set -eu
if ! python3 -c ''; then
    echo "skipped: python3 is missing"
    exit 77
fi

# compare INCLUDE: the differences
compare() {
    # shellcheck disable=SC2086 # a list of words
    python3 -B "$SOURCE_DIR/tests/consume/interface.py" "$CC" "$1" "$SOURCE_DIR/fortran/public" $COMPONENTS || return 1
    "$CC" -std=c11 -I"$1" -o layout_c layout.c && "$FC" -std=f2018 -I"$MODULES" -o layout_fortran layout.f90 || return 1
    ./layout_c | LC_ALL=C sort >in_c.txt
    ./layout_fortran | LC_ALL=C sort >in_fortran.txt
    diff in_c.txt in_fortran.txt
}

# must_show WHAT EDIT: headers changed by that command of sed
must_show() {
    rm -rf include
    cp -r "$SOURCE_DIR/include" include
    sed -i "$2" include/restitute/*.h
    if diff -r "$SOURCE_DIR/include" include >edit.txt; then
        echo "interface: '$2' changes nothing: the headers have moved on" >&2
        exit 1
    elif compare include >differences.txt 2>&1 || ! grep "$1" differences.txt; then
        cat edit.txt differences.txt
        echo "interface: this change of the headers did not show as '$1'" >&2
        exit 1
    fi
}

if [ "$1" = agree ]; then
    compare "$SOURCE_DIR/include"
else
    must_show "restitute_version: in Fortran alone" '/restitute_version(void)/d'
    must_show "restitute_version_2: in C alone" 's/restitute_version(void)/restitute_version_2(void)/'
    must_show "arguments are .*'ex', 'ez'" 's/double \*ez, double \*ex,$/double *ex, double *ez,/'
    must_show "ez is 'const double \* ez' in C" 's/double \*ez, double \*ex,$/const double *ez, double *ex,/'
    must_show "C returns double, Fortran integer" 's/SINCE_0_1 int restitute_pair/SINCE_0_1 double restitute_pair/'
    must_show "RESTITUTE_OK 5" 's/X(OK, 0,/X(OK, 5,/'
    must_show "RESTITUTE_FLAG_SLOW: in C alone" 's/X(FAST, 1,/X(SLOW, 1,/'
    must_show "restitute_body.radius 88 8" 's/double position\[3\];/double position[4];/'
    must_show "restitute_impact.psi 16 4" 's/double psi; /float psi; /'
    must_show "psi" 's/double psi; /int psi; /'
    must_show "missing_x" 's/double rebound_x,/double missing_x, rebound_x,/'
fi
