#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks the object files that a static library of ours is made of:  objects.sh OBJECT...
#   - they define nothing but rst_*, restitute_* and procedures of Fortran modules of such names
#   - a name is of one source: programs may link several static components
#   - those from Fortran take no memory: compilers do not look whether there is any
# NM comes from the environment. What begins with another double underscore is the sanitizers' own;
# clang gives a critical section of OpenMP a lock by its name.
set -eu
wrong=0

complain() {
    echo "symbols: $*" >&2
    wrong=1
}

defined=$("$NM" -g --defined-only "$@")
defined=$(echo "$defined" | awk 'NF == 3 { print $NF }')
[ -n "$defined" ] || complain "nothing is defined in" "$@"
foreign=$(echo "$defined" | grep -v -E '^(rst_|restitute_|\.gomp_critical_user_rst_|(__|_QM)(rst_[a-z0-9_]+|restitute)(_MOD_|P|E))' | grep -v -E '^__[a-z_]*(a|ub)san' || true)
[ -z "$foreign" ] || complain "other names than rst_* and restitute_*:" $foreign

twice=$("$NM" -A -g --defined-only "$@" | sed 's|^.*/||' | awk 'NF == 3 { sub(":.*", "", $1); print $3, $1 }' |
    sort -u | awk '$1 == name { print name, file, $2 } { name = $1; file = $2 }' | grep -v san || true)
[ -z "$twice" ] || complain "defined in two sources:" $twice

for object in "$@"; do
    case $object in
    *.f90.o | *.F90.o) ;;
    *) continue ;;
    esac
    undefined=$("$NM" -u "$object")
    ! echo "$undefined" | grep -q -E ' (malloc|calloc|realloc)$' || complain "$object takes memory"
done
echo "looked into $# objects"
exit $wrong
