#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian packages that are missing: cmake/install-packages.sh
# [run|all|lammps|test|ci|package|docs|site-check]
#   run      for the Python package, the command and its figures (the default)
#   all      run, and the libraries of the components cvode, table_files, bem and fit
#   lammps   all, and what building the adapter for LAMMPS needs
#   test     all, and what the tests need
#   ci       test, make, what counts lines, and a second compiler with its sanitizers
#   package  all, and what cpack needs to make Debian packages
#   docs     all, and what building the reference and the site, checking the man page and converting figures needs
#   site-check  docs, and the browser of the target site-check (0.4 GB)
# OpenMP comes with gcc; clang builds without it, unless libomp-dev is there. Debian 12's clang is
# clang-14. Runs as root or by sudo; where nothing is missing it does nothing and needs neither.
set -eu

run_packages="cmake ninja-build gcc gfortran libc6-dev pkg-config libjansson-dev python3 python3-cffi
    python3-matplotlib python3-numpy python3-tqdm"
all_packages="$run_packages libsundials-dev libhdf5-dev libfftw3-dev libgsl-dev python3-h5py"
package_tools="dpkg-dev file"
test_packages="$all_packages $package_tools g++ libcmocka-dev liggghts libliggghts-dev locales mandoc mpi-default-dev mypy
    python3-distributed python3-hypothesis python3-mpi4py python3-pytest python3-venv valgrind"
docs_packages="$all_packages doxygen furo librsvg2-bin mandoc python3-myst-parser python3-numpydoc python3-sphinx"
case "${1-run}" in
run) packages=$run_packages ;;
all) packages=$all_packages ;;
lammps) packages="$all_packages g++ python3-venv" ;;
test) packages=$test_packages ;;
ci) packages="$test_packages make clang gcovr libclang-rt-14-dev llvm" ;;
package) packages="$all_packages $package_tools" ;;
docs) packages=$docs_packages ;;
site-check) packages="$docs_packages chromium chromium-driver fonts-dejavu-core python3-selenium" ;;
*)
    echo "install-packages: unknown kind '$1': must be run, all, lammps, test, ci, package, docs or site-check" >&2
    exit 2
    ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "install-packages: no dpkg and apt-get here; what Debian calls these is needed: $packages;" \
        "docs/install.md has the names of Fedora and Arch" >&2
    exit 0 # they may be there under other names; if not, CMake says what is missing
fi

missing=""
for package in $packages; do
    state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || state=none
    [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
    as_root="env"
elif command -v sudo >/dev/null; then
    as_root="sudo env"
else
    echo "install-packages: neither root nor sudo here; let root run: apt-get install$missing" >&2
    exit 1
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Runs apt-get quietly; its output is shown only if it fails.
apt_get() {
    if ! $as_root DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Dpkg::Use-Pty=0 -o Acquire::Retries=3 "$@" \
        >"$log" 2>&1; then
        cat "$log" >&2
        echo "install-packages: apt-get $* failed, see above" >&2
        exit 1
    fi
}

echo "== Installing packages:$missing"
apt_get update
# shellcheck disable=SC2086 # a list of words
apt_get install --no-install-recommends $missing
echo "== Packages installed"
