#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A short report on run time:  check_report.sh PROGRAMS [--cvode]
# From the environment: SOURCE_DIR and PYTHON. Exit status 77 without matplotlib.
set -eu
programs=$1
shift
"$PYTHON" -c "import matplotlib" 2>/dev/null || { echo "skipped: no matplotlib for $PYTHON" && exit 77; }
exec "$PYTHON" -B "$SOURCE_DIR/tests/benchmark/check_report.py" "$programs" "$SOURCE_DIR/docs" "$@"
