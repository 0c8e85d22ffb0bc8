#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Programs and libraries of a hardened build:  hardened.sh FILE...
#   - all symbols are bound at the start, and what they are bound in is read-only from then on
#   - their C looks after its stack and has calls of the C library checked
# NM and READELF come from the environment.
set -eu
wrong=0
for file in "$@"; do
    "$READELF" -dW "$file" | grep -q BIND_NOW || { echo "$file: symbols are bound late" >&2; wrong=1; }
    "$READELF" -lW "$file" | grep -q GNU_RELRO || { echo "$file: nothing becomes read-only" >&2; wrong=1; }
    for call in __stack_chk_fail '[a-z_]*_chk'; do
        "$NM" -D -u "$file" | grep -Eq " $call(@|\$)" || { echo "$file: no call of $call" >&2; wrong=1; }
    done
done
exit $wrong
