#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The binary interface of the shared library against the recorded one: check.sh LIBRARY
# INCLUDE_DIRECTORY BASELINE Additions pass; what an existing program would trip over fails. A
# change that is meant is recorded anew by the target abi-baseline; before 1.0 it then needs a new
# minor version, after that a new major one. Skipped without abidiff.
set -u
skip() {
    echo "skipped: $1"
    exit 77
}
command -v abidiff >/dev/null || skip "no abidiff here; Debian has it in abigail-tools"
[ "$(uname -m)" = x86_64 ] || skip "the baseline was recorded on x86_64, this is $(uname -m)"
readelf -S "$1" | grep -q debug_info || {
    echo "$1 carries no debug information: nothing to compare" >&2
    exit 1
}
abidiff --no-added-syms --headers-dir2 "$2" "$3" "$1" || exit 1

# The check can fail: a function less, or a member less in a struct, is a change.
sed -e "s/restitute_pair'/restitute_gone'/g" "$3" >function.abi
awk '/name=.restitute_result. size/ { inside = 1 } inside && /<data-member/ && ++n == 2 { gone = 3 } gone-- <= 0' "$3" >member.abi
for changed in function member; do
    ! cmp -s "$3" $changed.abi || exit 1
    if abidiff --no-added-syms --headers-dir2 "$2" $changed.abi "$1" >said; then
        echo "a removed $changed is not noticed" >&2
        exit 1
    fi
done
