#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs a program that was compiled with recorded headers, with the libraries of today and of a later
# version:
#   old_program.sh PROGRAM DIRECTORIES LONGER RECORDED HEADER...
# DIRECTORIES, with colons between them, hold the libraries of the build. LONGER/lib holds those
# whose structs are longer, LONGER/spoilt a core that ignores how long the caller's structs are. CC
# and NM come from the environment.
set -eu
ulimit -c 0
here=$(dirname -- "$0")
program=$1 directories=$2 longer=$3 recorded=$4
shift 4

echo "== it calls all that the recorded headers have"
facts=$(sh "$here/facts.sh" "$recorded" "$@")
symbols=$("$NM" -D --undefined-only "$program")
echo "$facts" | awk '$1 == "function" { print $2 }' | sort >public.txt
echo "$symbols" | awk '$NF ~ /^restitute_/ { print $NF }' | sort >called.txt
[ -s called.txt ] && diff public.txt called.txt || { echo "the lists differ" >&2; exit 1; }

# run DIRECTORIES OUTPUT
run() {
    LD_LIBRARY_PATH=$1 "$program" >"$2" 2>errors.txt || { tail -n 3 "$2" errors.txt; false; }
}
echo "== with the libraries of the build"
run "$directories" now.txt || exit 1
echo "== with longer structs, and the same results"
run "$longer/lib" later.txt || exit 1
diff now.txt later.txt

echo "== the test can fail: with a core that copies whole structs"
status=0
LD_LIBRARY_PATH=$longer/spoilt:$longer/lib "$program" >spoilt.txt 2>errors.txt || status=$?
# SIGSEGV, SIGBUS, or a struct_size that was overwritten; the loader would end it with 127
case $status in
139 | 135) ;;
1) grep -h "not .* any more\|Sanitizer" spoilt.txt errors.txt ;;
*)
    echo "it ends with $status" >&2
    tail -n 3 spoilt.txt errors.txt >&2
    exit 1
    ;;
esac
