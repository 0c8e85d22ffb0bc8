#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What configuring says where libraries are missing: it names each part that is left out with its
# packages, which docs/install.md has, too; a part that is wanted (ON) fails. From the environment:
# CMAKE GENERATOR CC FC. The working directory is used up.
set -eu

fail() {
    echo "consume/missing: $*" >&2
    exit 1
}

rm -rf build nothing
mkdir nothing
PKG_CONFIG_LIBDIR=$PWD/nothing PKG_CONFIG_PATH=
export PKG_CONFIG_LIBDIR PKG_CONFIG_PATH
configure() {
    "$CMAKE" -S "$SOURCE_DIR" -B build -G "$GENERATOR" -DCMAKE_C_COMPILER="$CC" -DCMAKE_Fortran_COMPILER="$FC" \
        -DCMAKE_DISABLE_FIND_PACKAGE_SUNDIALS=ON -DRESTITUTE_EXAMPLES=OFF --log-level=NOTICE "$@" >said.txt 2>&1
}

configure || { cat said.txt; fail "without libraries the core cannot be configured"; }
cat said.txt
for part in "files .*libjansson-dev" "table_files .*libhdf5-dev" "cvode .*libsundials-dev" "bem .*libfftw3-dev" \
    "fit .*libgsl-dev" "python .*the component files"; do
    grep -q "left out: $part" said.txt || fail "it does not say '$part'"
done
for package in $(grep -o '([DF][^()]*)' said.txt | tr -d '(),' | sed 's/Debian\|Fedora\|Arch//g'); do
    grep -q "^|.*[| ]$package " "$SOURCE_DIR/docs/install.md" || fail "docs/install.md does not have $package"
done

! configure -DRESTITUTE_FIT=ON || fail "a part that is wanted and missing is no error"
tr '\n' ' ' <said.txt | tr -s ' ' | grep "RESTITUTE_FIT=ON is REQUIRED.*libgsl-dev" || fail "the error does not say what is missing"
