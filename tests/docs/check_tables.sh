#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The tables of docs/records/measurements.md are what the library of this build computes: these rows
# in this order, no more.
#   SOURCE_DIR=... MEASUREMENTS=/path/of/measurements check_tables.sh
set -eu

"$MEASUREMENTS" kharaz "$SOURCE_DIR/tests/data/kharaz_oblique.csv" >rows
"$MEASUREMENTS" fem "$SOURCE_DIR/tests/data/fem_oblique.csv" >>rows
[ -s rows ] || { echo "no rows are computed" && exit 1; }
grep '^| [0-9]' "$SOURCE_DIR/docs/records/measurements.md" >recorded
diff recorded rows
