#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The binary interface of the shared library against the recorded one: check.sh LIBRARY INCLUDE_DIRECTORY BASELINE
# Additions pass; what an existing program would trip over fails. A change that is meant is recorded anew by the target
# abi-baseline; before 1.0 it then needs a new minor version, after that a new major one. Skipped without abidiff, or where the
# library carries no debug information.
set -u
command -v abidiff >/dev/null || exit 77
readelf -S "$1" | grep -q debug_info || exit 77
[ "$(uname -m)" = x86_64 ] || exit 77 # where the baseline was recorded
abidiff --headers-dir2 "$2" "$3" "$1"
status=$?
# bits of the status: 1 error, 2 usage, 4 some change, 8 incompatible change
[ $((status & 11)) -eq 0 ] || exit 1

# The check can fail: a function less is incompatible.
sed -e "s/restitute_pair'/restitute_gone'/g" "$3" >changed.abi
abidiff changed.abi "$1" >/dev/null
[ $(($? & 8)) -ne 0 ] || {
    echo "a removed function is not noticed" >&2
    exit 1
}
