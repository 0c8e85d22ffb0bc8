#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Records the binary interface of the shared library: record.sh LIBRARY INCLUDE_DIRECTORY BASELINE
# The library must have been built with -g. Paths of the machine do not get into the record.
set -eu
abidw --no-comp-dir-path --no-corpus-path --drop-private-types --headers-dir "$2" "$1" |
    sed -E "s#(filepath|path)='[^']*/#\1='#" >"$3.new"
mv "$3.new" "$3"
