#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# read_table.py finds in a file what the command does: one impact that sticks first, one that slips first, one in full slip, one beyond
# the table's speeds. Arguments: the command, the folder examples, a Python. Exit status 77 without h5py.
set -eu
command=$1 examples=$2 python=$3

"$python" -c 'import h5py' 2>/dev/null || {
    echo "h5py is not installed: the table is not read from Python"
    exit 77
}
"$command" table build --material "$examples/materials/polyisobutylene.json" --radius 0.005 --density 7800 --friction 0.3 \
    --speed 0.01:10 --tolerance 1e-3 --output tables_example.h5
for speeds in '1 0.1' '0.3 0.2' '2 5' '50 12'; do
    set -- $speeds
    "$command" table query tables_example.h5 --normal-speed "$1" --tangential-speed "$2" >query.txt
    "$python" "$examples/tables/read_table.py" tables_example.h5 "$1" "$2" | sed 1d >read.txt
    # 1e-11: both add the same cubics in another order
    paste query.txt read.txt | awk -v where="$speeds" '
        { d = $3 - $6; if (d < 0) d = -d; if ($1 != $4 || d > 1e-11) { print where ": " $0; bad = 1 } n++ }
        END { exit bad || n != 2 }'
done
"$python" "$examples/tables/read_table.py" tables_example.h5 | awk -F, 'NR > 1 && ($2 < 0 || $2 > 1) { bad = 1 } END { exit bad || NR != 62 }'
