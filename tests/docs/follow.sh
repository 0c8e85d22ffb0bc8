#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Follows pages of docs word for word, with the command and the package of the build:
#   SOURCE_DIR=... BUILD_DIR=... PYTHON=... follow.sh NAME.md... [lammps]
# With the word lammps, LAMMPS and the plugin are those that the test lammps.build has made. Exit
# status 77 where something is missing.
set -eu

rm -rf bin place
mkdir bin place
ln -s "$PYTHON" bin/python3 # what the pages call python3
PATH=$PWD/bin:$BUILD_DIR/python/bin:$PATH
cd place
for word in "$@"; do
    shift
    case $word in
    *.md) word=$SOURCE_DIR/docs/$word ;;
    lammps)
        if [ -f "$BUILD_DIR/lammps/skipped.txt" ]; then
            cat "$BUILD_DIR/lammps/skipped.txt"
            exit 77
        fi
        ln -s "$BUILD_DIR/lammps" lammps
        ;;
    esac
    set -- "$@" "$word"
done
"$PYTHON" -c "import matplotlib" 2>/dev/null || { echo "skipped: no matplotlib for $PYTHON" && exit 77; }
CHECKOUT=$SOURCE_DIR PYTHONPATH=$BUILD_DIR/python PYTHONDONTWRITEBYTECODE=1
export PATH CHECKOUT PYTHONPATH PYTHONDONTWRITEBYTECODE
exec "$PYTHON" -B "$SOURCE_DIR/tests/docs/page.py" "$@"
