#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The present headers against the recorded ones: what a program was compiled with stays.
#   headers.sh PRESENT RECORDED LONGER        three include directories; CC from the environment
# A change that is meant is recorded anew by the target abi-baseline; from 1.0 on it needs a new major version.
set -eu
here=$(dirname -- "$0")
recorded=$2
headers=$(cd "$recorded/restitute" && echo *.h)

# shellcheck disable=SC2086 # a list of words
sh "$here/facts.sh" "$recorded" $headers | LC_ALL=C sort -u >recorded.txt
[ "$(grep -c ^function recorded.txt)" -gt 50 ] || { echo "$recorded says nothing" >&2; exit 1; }

# Prints the recorded facts that do not hold for the headers of a directory; false if there are any.
stays() {
    # shellcheck disable=SC2086
    sh "$here/facts.sh" "$1" $headers | LC_ALL=C sort -u >now.txt
    gone=$(LC_ALL=C comm -23 recorded.txt now.txt) || exit 1
    [ -z "$gone" ] || { echo "$gone"; false; }
}
stays "$1" || { echo "gone or changed: the facts above" >&2; exit 1; }
stays "$3" || { echo "structs that grow at their end are refused" >&2; exit 1; }

# The check can fail: HEADER SED_COMMAND, each a change that a program would trip over.
changed() {
    rm -rf changed
    mkdir changed
    cp -r "$1/restitute" changed/
    sed "$3" "$1/restitute/$2" >"changed/restitute/$2"
    ! cmp -s "$1/restitute/$2" "changed/restitute/$2" || { echo "'$3' does nothing to $2" >&2; exit 1; }
    if stays changed >said; then
        echo "'$3' in $2 is not noticed" >&2
        exit 1
    fi
}
changed "$recorded" restitute.h 's/^    double element_spacing;/    double more;\n&/'
changed "$recorded" restitute.h 's/^    double element_spacing;/    float element_spacing;/'
changed "$recorded" restitute.h 's/^} restitute_error;/    int more;\n&/'
changed "$recorded" restitute.h 's/restitute_pair(double chi/restitute_pair(float chi/'
changed "$recorded" restitute.h 's/restitute_plan_solve(/restitute_plan_run(/'
changed "$recorded" restitute.h 's/^RESTITUTE_INIT(RESTITUTE_SINCE_0_1, ledger)//'
changed "$recorded" restitute.h 's/X(COUPLED, 8/X(COUPLED, 16/'
changed "$recorded" fit.h 's/RESTITUTE_FIT_NAME = 32/RESTITUTE_FIT_NAME = 64/'
