#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Instructions of one impact by a warm solver, for every method and tolerance on a few scenes of the
# report: a cost that does not depend on the clock of the machine. The first solve warms up; the
# second is what three solves take more than two.
#   instructions.sh PROGRAM OUT.csv [MOST]     a sweep ends with the first tolerance that takes more than MOST, default 3e7
set -eu
program=$1
table=$2
most=${3:-30000000}
scenes="truth-1 truth-2 truth-4 truth-10 two-terms PIB-v=1"
command -v valgrind >/dev/null || { echo "instructions.sh: valgrind is missing (Debian: valgrind)" >&2 && exit 1; }
mkdir -p "$(dirname -- "$table")"

# collected METHOD TOLERANCE SCENE SOLVES: instructions within restitute_solve(); nothing if it is
# refused
collected() {
    valgrind --tool=callgrind --toggle-collect=restitute_solve --callgrind-out-file=/dev/null "$program" "$@" 2>&1 |
        sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}

{
    echo "scene,method,tolerance,instructions"
    for scene in $scenes; do
        for method in $("$program" methods); do
            for tolerance in 1e-2 1e-3 1e-4 1e-5 1e-6 1e-7 1e-8; do
                "$program" "$method" $tolerance "$scene" 1 || break
                two=$(collected "$method" $tolerance "$scene" 2)
                three=$(collected "$method" $tolerance "$scene" 3)
                echo "$scene,$method,$tolerance,$((three - two))"
                [ $((three - two)) -le "$most" ] || break
            done
        done
    done
} >"$table.part"
mv "$table.part" "$table"
