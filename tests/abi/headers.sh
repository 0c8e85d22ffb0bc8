#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The present headers against the recorded ones: what a program was compiled with stays.
#   headers.sh PRESENT RECORDED LONGER        three include directories; CC from the environment
# Until 0.1 is released the target abi-baseline records any change that is meant; then it only
# grows.
set -eu
here=$(dirname -- "$0")
present=$1 recorded=$2 longer=$3
all=$(cd "$recorded/restitute" && echo *.h)

# stays INCLUDE_DIRECTORY HEADER...: prints recorded facts that do not hold there; false if any
stays() {
    include=$1
    shift
    sh "$here/facts.sh" "$recorded" "$@" >facts.txt || exit 1
    sort -u facts.txt >recorded.txt
    sh "$here/facts.sh" "$include" "$@" >facts.txt || exit 1
    sort -u facts.txt >now.txt
    gone=$(comm -23 recorded.txt now.txt) || exit 1
    [ -z "$gone" ] || { echo "$gone"; false; }
}
# shellcheck disable=SC2086 # a list of words
stays "$present" $all || { echo "gone or changed: the facts above" >&2; exit 1; }
# shellcheck disable=SC2086
stays "$longer" $all || { echo "structs that grow at their end are refused" >&2; exit 1; }

# changed HEADER SED_COMMAND: the check finds a change that a program would trip over
changed() {
    rm -rf changed
    mkdir changed
    cp -r "$recorded/restitute" changed/
    sed "$2" "$recorded/restitute/$1" >"changed/restitute/$1"
    ! cmp -s "$recorded/restitute/$1" "changed/restitute/$1" || { echo "'$2' does nothing to $1" >&2; exit 1; }
    if stays changed "$1" >/dev/null; then
        echo "'$2' in $1 is not noticed" >&2
        exit 1
    fi
}
changed restitute.h 's/^    double element_spacing;/    double more;\n&/'
changed restitute.h 's/^    double element_spacing;/    float element_spacing;/'
changed restitute.h 's/^} restitute_error;/    int more;\n&/'
changed restitute.h 's/restitute_pair(double chi/restitute_pair(float chi/'
changed restitute.h 's/restitute_plan_solve(/restitute_plan_run(/'
changed restitute.h 's/^RESTITUTE_INIT(RESTITUTE_SINCE_0_1, ledger)//'
changed restitute.h 's/X(COUPLED, 8/X(COUPLED, 32/'
changed fit.h 's/RESTITUTE_FIT_NAME = 32/RESTITUTE_FIT_NAME = 64/'
