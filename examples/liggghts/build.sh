#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Builds librestitute_liggghts.so for the LIGGGHTS that is installed:
#   examples/liggghts/build.sh PREFIX DIRECTORY        PREFIX: where restitute is installed
# Exit status 77: there is no LIGGGHTS here, or not its headers; the reason is printed.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
prefix=${1:?examples/liggghts/build.sh PREFIX DIRECTORY}
target=${2:?examples/liggghts/build.sh PREFIX DIRECTORY}
headers=${LIGGGHTS_HEADERS-/usr/include/liggghts}

skip() {
    echo "no LIGGGHTS: $1"
    exit 77
}

command -v liggghts >/dev/null || skip "the command liggghts is not there; Debian has it in liggghts"
[ -f "$headers/contact_models.h" ] || skip "no headers in $headers; Debian has them in libliggghts-dev"
mkdir -p "$target"
cmake -S "$here" -B "$target/plugin" -G Ninja --log-level=WARNING -DCMAKE_PREFIX_PATH="$prefix" \
    -DLIGGGHTS_HEADERS="$headers"
cmake --build "$target/plugin"
ln -sf plugin/librestitute_liggghts.so "$target/librestitute_liggghts.so"
