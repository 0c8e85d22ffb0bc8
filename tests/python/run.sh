#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests of the Python package:  run.sh pytest|ruff|mypy
# From the environment: SOURCE_DIR, PYTHON, and PACKAGE, the folder of the built package. The
# working directory is used up. Exit status 77 where the tool is missing.
set -eu

settings=$SOURCE_DIR/src/python/pyproject.toml
PYTHONDONTWRITEBYTECODE=1
export PYTHONDONTWRITEBYTECODE

skip() {
    echo "skipped: $*"
    exit 77
}

case $1 in
pytest)
    "$PYTHON" -c "import pytest" 2>/dev/null || skip "no pytest for $PYTHON (Debian: python3-pytest)"
    PYTHONPATH=$PACKAGE exec "$PYTHON" -m pytest -c "$settings" --rootdir "$SOURCE_DIR/tests/python" \
        "$SOURCE_DIR/tests/python"
    ;;
mypy)
    "$PYTHON" -c "import mypy" 2>/dev/null || skip "no mypy for $PYTHON (Debian: mypy)"
    # The built package, since it has the modules that the build makes.
    exec "$PYTHON" -m mypy --config-file "$settings" --cache-dir cache "$PACKAGE/restitute"
    ;;
ruff)
    # The version that requirements.txt pins, from a virtual environment: others have other rules.
    ruff=tools/bin/ruff
    [ -x $ruff ] || { "$PYTHON" -m venv tools && tools/bin/python -m pip install --quiet \
        --disable-pip-version-check "$(grep '^ruff==' "$SOURCE_DIR/tests/python/requirements.txt")"; } ||
        skip "ruff cannot be installed from PyPI"
    exec $ruff check --quiet --output-format concise --no-cache --config "$settings" \
        "$SOURCE_DIR/src/python" "$SOURCE_DIR/tests/python" \
        $(find "$SOURCE_DIR/examples" -name '*.py' -path '*/python/*')
    ;;
esac
