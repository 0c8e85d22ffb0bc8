#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs test_tables.py with the built package; from the environment: SOURCE_DIR, PYTHON, PACKAGE.
set -eu
PYTHONPATH=$PACKAGE exec "$PYTHON" -B "$SOURCE_DIR/tests/site/test_tables.py" "$SOURCE_DIR/docs/site"
