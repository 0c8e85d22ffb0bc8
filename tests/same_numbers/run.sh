#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Are the numbers the same whatever compiled the library?  run.sh DIRECTORY [VARIANT ...]
# Builds each variant in DIRECTORY, runs `numbers` and compares with the first one. Variants are
# COMPILER-OPTION, as gcc-O0 (gcc and clang for C; gfortran always), or aarch64 (see aarch64.cmake,
# without ARM_ROOT of the components that need no other library). COMPILER-OPTION+shared has shared
# libraries, COMPILER-OPTION+nofma functions such as exp without FMA.
set -eu
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
source=$(dirname -- "$(dirname -- "$here")")
mkdir -p "$1"
directory=$(cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- gcc-O2 gcc-O0 gcc-O3 gcc-O3-march=x86-64-v3 clang-O2 gcc-O3+shared gcc-O2+nofma aarch64
for variant; do
    place=$directory/$variant optional= shared=OFF tunables= run= set_up=-DCMAKE_C_COMPILER=${variant%%-*}
    [ "$variant" != aarch64 ] || [ -n "${ARM_ROOT:-}" ] || optional="bem cvode files fit"
    if [ ! -s "$place.txt" ]; then
        flags=$(printf '%s' "${variant#*-}" | sed 's/-march/ -march/; s/+.*//')
        case $variant in
        *+shared) shared=ON ;;
        *+nofma) tunables=glibc.cpu.hwcaps=-AVX2,-FMA ;;
        aarch64)
            export ARM_PREFIX="$place/prefix"
            set_up="-DCMAKE_TOOLCHAIN_FILE=$here/aarch64.cmake" flags=O2
            run="qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH=${ARM_ROOT:-}/usr/lib/aarch64-linux-gnu"
            ;;
        esac
        cmake -S "$source" -B "$place/library" --preset release -DRESTITUTE_PYTHON=OFF -DRESTITUTE_FORTRAN=OFF \
            -DRESTITUTE_TABLE_FILES=OFF -DRESTITUTE_EXAMPLES=OFF -DBUILD_SHARED_LIBS=$shared "$set_up" \
            -DCMAKE_C_FLAGS_RELEASE="-$flags" -DCMAKE_Fortran_FLAGS_RELEASE="-$flags" >"$place.log" 2>&1
        cmake --build "$place/library" >>"$place.log" 2>&1
        cmake --install "$place/library" --prefix "$place/prefix" >>"$place.log" 2>&1
        cmake -S "$here" -B "$place/numbers" -G Ninja "$set_up" -DCMAKE_BUILD_TYPE=Release \
            -DCMAKE_PREFIX_PATH="$place/prefix" >>"$place.log" 2>&1
        cmake --build "$place/numbers" >>"$place.log" 2>&1
        GLIBC_TUNABLES=$tunables $run "$place/numbers/numbers" "$source/src/materials/polyisobutylene.json" \
            >"$place.part"
        mv "$place.part" "$place.txt"
    fi
    # shellcheck disable=SC2086 # words
    python3 -B "$here/compare.py" "$directory/$1.txt" "$place.txt" $optional
done
