#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The tables of docs/measurements.md are what the library of this build computes, line by line.
#   SOURCE_DIR=... MEASUREMENTS=/path/of/measurements check_tables.sh
set -eu

for set in kharaz fem; do
    "$MEASUREMENTS" "$set" "$SOURCE_DIR/tests/data/${set}_oblique.csv" >rows
    [ -s rows ] || { echo "no rows for $set" && exit 1; }
    while IFS= read -r row; do
        grep -qxF -e "$row" "$SOURCE_DIR/docs/measurements.md" || { echo "$set: not in the table: $row" && exit 1; }
    done <rows
done
