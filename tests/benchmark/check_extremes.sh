#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The extreme campaign in short:  check_extremes.sh DIRECTORY METHOD ...
# The directory has the programs; methods are those that are built.
set -eu
programs=$1
shift
for method; do
    # Corners and random impacts; 1024 is the first of a block that goes in batches, too.
    "$programs/extremes" "$method" 96 1 512 0.01 2>&1
    said=$("$programs/extremes" "$method" 64 1 1024 0.01 2>&1) || { echo "$said" && exit 1; }
    echo "$said"
    echo "$said" | grep -q "ledgers [1-9].*in batches [1-9]" || { echo "no ledgers or no batches" && exit 1; }
done
[ ! -x "$programs/extreme_tables" ] || "$programs/extreme_tables" 100000 1 0 5
