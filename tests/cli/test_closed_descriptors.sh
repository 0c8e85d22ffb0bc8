#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Standard descriptors closed by whoever starts the command: no output file gets their numbers, so
# nothing that is printed lands in a file. A result that cannot be printed is an error, as with a
# full disk.
. "$(dirname -- "$0")/common.sh"

printf 'chi,psi,delta1,gamma\n1.1667,2,1,1\n1.1667,-1,1,1\n' >cases.csv # the second row fails: a message
printf 'speed_m_s,ez\n0.1,0.9\n1,0.75\n5,0.6\n' >drops.csv
impact="--chi 1.1667 --psi 0.7 --delta1 1 --gamma 1"

# run DIRECTORY REDIRECTION ARGUMENT...: the command there; its exit status is in `status`.
run() {
    mkdir "$1"
    closed=$2
    (cd "$1" && shift 2 && eval '"$RESTITUTE" "$@" </dev/null >../out 2>../err '"$closed")
    status=$?
}

# same ARGUMENT...: whatever is closed, the files are those of a run in which nothing is; a PDF
# holds its date.
same() {
    rm -rf open shut
    run open '' "$@"
    usual=$status
    grep -q 'not in this build\|no component' err && return
    [ "$usual" -le 1 ] && [ -n "$(ls open)" ] || fail "exit status $usual of: restitute $*"
    prints=$(wc -c <out)
    for closed in '<&-' '>&-' '2>&-' '<&- >&- 2>&-'; do
        run shut "$closed" "$@"
        wanted=$usual
        case $closed in *'>&- '* | '>&-') [ "$prints" -eq 0 ] || wanted=2 ;; esac
        [ "$status" -eq "$wanted" ] || fail "exit status $status, not $wanted, with $closed of: restitute $*"
        [ "$wanted" -ne 2 ] || cp -n open/* shut # a run that fails may leave files out
        diff -r -x '*.pdf' open shut >differences || fail "$(cat differences) with $closed of: restitute $*"
        rm -r shut
    done
}
same pair $impact --output one.txt
same pair --input ../cases.csv --output rows.csv
same history --method cvode $impact --samples 5 --events events.h5 --output history.csv
same history --method bem --elements 16 --tolerance 0.1 $impact --samples 5 --fields fields.h5 --output history.csv
same table build $scene --speed 0.1:1 --tolerance 3e-2 --output table.h5
same fit --input ../drops.csv --radius 0.01 --density 7800 --output fit.json
if have_module matplotlib; then
    same sweep fig4 --output .
    same pair --grid psi=0:1:3 --gamma 1 --delta1 1 --output grid.csv --figure grid.svg
fi
