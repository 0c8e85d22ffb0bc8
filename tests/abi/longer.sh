#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Headers of a later version: two more members at the end of every struct that grows.
#   longer.sh HEADER... INCLUDE_DIRECTORY
set -eu
for last in "$@"; do :; done
mkdir -p "$last/restitute"
while [ $# -gt 1 ]; do
    awk '/size_t struct_size;/ { grows = 1 }
         grows && /^} restitute_/ { print "    double later_number;\n    const void *later_place;"; grows = 0 }
         { print }' "$1" >"$last/restitute/${1##*/}"
    shift
done
