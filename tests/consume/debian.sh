#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The Debian packages that cpack makes, unpacked one after the other: what each has and needs, the
# command and a C program from them, and the components that come in packages of their own.
# From the environment: BUILD_DIR CMAKE CC APART (names of those components). The working directory
# is used up.
set -eu

for tool in dpkg-deb dpkg-shlibdeps file readelf pkg-config; do
    if ! command -v $tool >/dev/null; then
        echo "skipped: no $tool here; cmake/install-packages.sh test installs it"
        exit 77
    fi
done

fail() {
    echo "consume/debian: $*" >&2
    exit 1
}

rm -rf packages root plain
"$(dirname -- "$CMAKE")/cpack" --config "$BUILD_DIR/CPackConfig.cmake" -B packages -D CPACK_DEBIAN_COMPRESSION_TYPE=none \
    -D CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS=OFF >cpack.txt 2>&1 || { cat cpack.txt; fail "cpack failed"; }

# unpack NAME: the package into root; its relations are then in $depends.
unpack() {
    echo "== $1"
    set -- "$1" packages/"$1"_*.deb
    [ -f "$2" ] || fail "there is no package $1"
    dpkg-deb -x "$2" root
    depends=$(dpkg-deb -f "$2" Depends)
    echo "depends on $depends"
    copyright=root/usr/share/doc/$1/copyright
    grep -q "BSD 3-Clause License" "$copyright" || fail "$copyright does not name our licence"
}

# wants WORD: $depends has it.
wants() {
    case $depends in *"$1"*) ;; *) fail "the package does not depend on $1" ;; esac
}

unpack librestitute0
wants libc6
wants libjansson
case $depends in *fftw* | *gsl* | *hdf5* | *sundials*) fail "the package wants a library of another one" ;; esac
! grep -E "FFTW|GSL" "$copyright" || fail "$copyright names a library that is not linked"
core=$(dpkg-deb -f packages/librestitute0_*.deb Version)

unpack librestitute-dev
wants "librestitute0 (= $core)"
PKG_CONFIG_PATH=$(dirname "$(find "$PWD/root" -name restitute.pc)")
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH")
export PKG_CONFIG_PATH LD_LIBRARY_PATH
# shellcheck disable=SC2046 # a list of words
"$CC" -o first_impact "$SOURCE_DIR/examples/c/first_impact/first_impact.c" $(pkg-config --cflags --libs restitute)
./first_impact | diff - "$SOURCE_DIR/examples/c/first_impact/expected.txt"
unset LD_LIBRARY_PATH

unpack restitute
for package in "librestitute0 (= $core)" "restitute-data (= $core)" python3-numpy python3-cffi; do
    wants "$package"
done
unpack restitute-data
PYTHONDONTWRITEBYTECODE=1
export PYTHONDONTWRITEBYTECODE
restitute() {
    root/usr/bin/restitute "$@"
}
restitute pair --material polyisobutylene --radius 0.005 --density 7800 --friction 0.3 --speed 0.01
restitute --version
! restitute --version | grep "General Public" || fail "the command alone names the GPL"

for component in $APART; do
    name=librestitute-$(echo "$component" | tr _ -)
    if [ "$component" = bem ]; then
        ! restitute pair --psi 2 --gamma 1 --delta1 1 --method bem 2>missing.txt || fail "bem without its package"
        grep "the component bem is not in this build" missing.txt || { cat missing.txt; fail "the refusal is none"; }
    fi
    unpack "$name"
    wants "librestitute0 (= $core)"
    pkg-config --libs "restitute-$component"
    case $component in
    bem) wants libfftw3 && grep -q "GPL-2+" "$copyright" && restitute pair --psi 2 --gamma 1 --delta1 1 --method bem --tolerance 1e-2 ;;
    cvode) wants libsundials && restitute pair --psi 2 --gamma 1 --delta1 1 --method cvode ;;
    fit) wants libgsl && grep -q "GPL-3+" "$copyright" && restitute --version | grep -q "General Public" ;;
    table_files) wants libhdf5 ;;
    esac || fail "$name is not whole"
done

echo "== together the packages have what is installed"
unpack restitute-doc
"$CMAKE" --install "$BUILD_DIR" --prefix "$PWD/plain/usr" >plain.txt
for tree in root plain; do
    (cd $tree && find . ! -type d ! -path "*/doc/*/copyright" | sort) >$tree.txt
done
diff plain.txt root.txt || fail "< is in no package, > is not installed"
