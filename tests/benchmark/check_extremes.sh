#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The extreme campaign in short:  check_extremes.sh DIRECTORY METHOD ...
# The directory has the programs; methods are those that are built.
set -eu
programs=$1
shift
for method; do
    "$programs/extremes" "$method" 128 1 496 0.01 2>&1 # corners and random impacts
done
[ ! -x "$programs/extreme_tables" ] || "$programs/extreme_tables" 100000 1 0 5
