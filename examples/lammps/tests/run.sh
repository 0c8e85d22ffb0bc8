#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Runs a test of the adapter for LAMMPS:  run.sh build|NAME of a test_NAME.py From the environment:
# CMAKE BUILD_DIR RESTITUTE SANITIZED. All is kept in BUILD_DIR/lammps, with the virtual
# environment.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
place=$BUILD_DIR/lammps
mkdir -p "$place/$1"
cd "$place/$1"

if [ "$1" = build ]; then
    rm -f "$place/restituteplugin.so" "$place/skipped.txt"
    if [ "$SANITIZED" = ON ]; then
        echo "no LAMMPS: an instrumented library binds its users to the sanitizers" >"$place/skipped.txt"
    else
        "$CMAKE" --install "$BUILD_DIR" --prefix "$place/prefix" >install.txt
        status=0
        "$here/../build.sh" "$place/prefix" "$place" >build.txt || status=$?
        cat build.txt
        [ $status -ne 77 ] || tail -n 1 build.txt >"$place/skipped.txt"
        [ $status -eq 0 ] || exit $status
    fi
fi
if [ -f "$place/skipped.txt" ]; then
    cat "$place/skipped.txt"
    exit 77
fi
[ "$1" != build ] || exit 0
PYTHONPATH=$here/..
PLUGIN=$place/restituteplugin.so
export PLUGIN PYTHONPATH
exec "$place/venv/bin/python" -B "$here/test_$1.py"
