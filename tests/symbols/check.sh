#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks a shared library of ours, and a C-only program that links it, if one is named:
#   check.sh LIBRARY [PROGRAM]
#   - it defines what HEADERS declare, all of it, each with a since-tag, and nothing else
#   - it calls nothing of a Fortran run-time library
#   - it neither prints nor ends the program: it needs no function that does so, and no standard
#     stream
#   - it needs librestitute, if it is another one
#   - neither it nor the program lists such a library as needed, nor one of vector mathematics, whose
#     last digits depend on the processor; nor one of OpenMP, unless WITH_OPENMP is ON: then the
#     library may, for batches by several threads; nor one whose name holds WITHOUT, if that is set
# NM, READELF, CC, INCLUDE, HEADERS, WITH_OPENMP and WITHOUT come from the environment. Tools have
# lines of their own: of a pipeline the shell sees the last status alone, and a tool that fails
# would be taken for one that finds nothing.
set -eu
library=$1
wrong=0

complain() {
    echo "symbols: $*" >&2
    wrong=1
}

defined=$("$NM" -D --defined-only "$library")
defined=$(echo "$defined" | awk '{ print $NF }')
[ -n "$defined" ] || complain "$library defines nothing"
# Names that begin with a double underscore are the sanitizers' own.
foreign=$(echo "$defined" | grep -v -e '^restitute_' -e '^__' || true)
[ -z "$foreign" ] || complain "$library defines other names than restitute_*:" $foreign

# shellcheck disable=SC2086 # a list of words
facts=$(sh "$(dirname -- "$0")/../abi/facts.sh" "$INCLUDE" $HEADERS)
untagged=$(echo "$facts" | awk '$1 == "function" && $3 != "exported" { print $2 }')
[ -z "$untagged" ] || complain "$HEADERS: no RESTITUTE_SINCE_x_y before:" $untagged
declared=$(echo "$facts" | awk '$1 == "function" { print $2 }')
for name in $declared; do
    echo "$defined" | grep -qx "$name" || complain "$library does not define $name of $HEADERS"
done
for name in $(echo "$defined" | grep '^restitute_'); do
    echo "$declared" | grep -qx "$name" || complain "$library defines $name, which is not in $HEADERS"
done

undefined=$("$NM" -D --undefined-only "$library")
undefined=$(echo "$undefined" | awk '{ print $NF }')
fortran=$(echo "$undefined" | grep -E '^(_gfortran|_FortranA|for_)|quad' || true)
[ -z "$fortran" ] || complain "$library calls the Fortran run-time library:" $fortran

plain=$(echo "$undefined" | sed 's/@.*//')
loud=$(echo "$plain" | grep -E '^((__)?v?printf(_chk)?|puts|putchar|perror|psignal|v?warnx?|v?errx?|stdout|stderr)$' || true)
[ -z "$loud" ] || complain "$library prints:" $loud
deadly=$(echo "$plain" | grep -E '^(abort|_?exit|_Exit|quick_exit|__assert_fail)$' || true)
[ -z "$deadly" ] || complain "$library ends the program:" $deadly

for file in "$@"; do
    needed=$("$READELF" --dynamic "$file")
    needed=$(echo "$needed" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
    [ -n "$needed" ] || complain "$file needs no library at all: not what this test expects"
    case $file in
    */librestitute.so*) ;;
    *) echo "$needed" | grep -Eq '^librestitute(_table)?\.so' || complain "$file does not need librestitute" ;;
    esac
    runtime=$(echo "$needed" | grep -E 'gfortran|quadmath|flang|FortranRuntime|libifcore' || true)
    [ -z "$runtime" ] || complain "$file needs a Fortran run-time library:" $runtime
    ! echo "$needed" | grep -q mvec || complain "$file needs the vector mathematics library libmvec"
    openmp=$(echo "$needed" | grep -E '^lib(gomp|omp|iomp5)\.' || true)
    [ "$WITH_OPENMP" = ON ] || [ -z "$openmp" ] || complain "$file needs OpenMP in a build without it:" $openmp
    banned=$(echo "$needed" | grep -i "${WITHOUT:-^$}" || true)
    [ -z "$banned" ] || complain "$file needs what it must do without:" $banned
    echo "$file needs:" $needed
done
echo "$library defines:" $defined
exit $wrong
