#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs a program under valgrind: no memory error, no leak.  valgrind.sh PROGRAM, SANITIZED from the
# environment
set -eu
if [ "$SANITIZED" = ON ]; then
    echo "skipped: valgrind and the address sanitizer do not go together"
    exit 77
fi
if ! command -v valgrind >/dev/null; then
    echo "skipped: no valgrind here"
    exit 77
fi
exec valgrind --quiet --error-exitcode=99 --leak-check=full --show-leak-kinds=all --errors-for-leak-kinds=all \
    --suppressions="$(dirname -- "$0")/openmp.supp" "$1"
