#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# read_table.py finds in a file what the command does: impacts that stick first, that slip first, in
# full slip, beyond the table's ranges. Arguments: the command, the folder examples, a Python. Exit
# status 77 without h5py.
set -eu
command=$1 examples=$2 python=$3

# Debian's h5py belongs to this Python, which another one may hide.
"$python" -c 'import h5py' 2>/dev/null || python=/usr/bin/python3
"$python" -c 'import h5py' 2>/dev/null || {
    echo "skipped: h5py is not installed: the table is not read from Python"
    exit 77
}
"$command" table build --material "$examples/../src/materials/polyisobutylene.json" --radius 0.005 --density 7800 --friction 0.3 \
    --speed 0.01:10 --tolerance 1e-3 --output tables_example.h5
# Where in read.txt and query.txt ez and ex differ by more than $2
compare() {
    paste query.txt read.txt | awk -v where="$1" -v most="$2" '
        { d = $3 - $6; if (d < 0) d = -d; if ($1 != $4 || d > most) { print where ": " $0; bad = 1 } n++ }
        END { exit bad || n != 2 }'
}
for speeds in '1 0.1' '0.3 0.2' '2 5' '50 12'; do
    set -- $speeds
    "$command" table query tables_example.h5 --normal-speed "$1" --tangential-speed "$2" >query.txt 2>warning.txt
    "$python" "$examples/tables/read_table.py" tables_example.h5 "$1" "$2" | sed 1d >read.txt
    compare "$speeds" 1e-11 # both add the same cubics in another order
done
"$python" "$examples/tables/read_table.py" tables_example.h5 | awk -F, 'NR > 1 && ($2 < 0 || $2 > 1) { bad = 1 } END { exit bad || NR != 62 }'
