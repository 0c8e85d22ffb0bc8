#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# restitute table: build, info, query, figure; refusals by name; what is missing in the build.
. "$(dirname -- "$0")/common.sh"

"$RESTITUTE" table --help >out 2>err
if grep -q 'no component table_files' err; then
    refused 'HDF5' table build
    echo "skipped: no component table_files in this build"
    exit 0
fi

expect 0 table --help
has out build info query
for action in build info query; do
    expect 0 table $action --help
    for option in $(sed -n 's/^  *--\([a-z0-9-]*\).*/\1/p' out); do
        sed 's/\\-/-/g' "$SOURCE_DIR/docs/restitute.1" | grep -Eq "(^\.It Fl|Fl) -$option( |\$)" ||
            fail "the manual page lacks --$option"
    done
done

expect 0 table build $scene --speed 0.1:1 --tolerance 1e-3 --output t.h5
has out 'verified at'
expect 0 table info t.h5
has out '0.1 to 1 m/s' 'verified at' 'limits'
expect 0 table info t.h5 --format json
has out '"error_ez"' '"tolerance": 0.001' '"fast_speed_m_s"'

# The table is within its tolerance of the impact itself: 1 m/s at 30 degrees.
v=0.86602540378443865 u=0.5
expect 0 table query t.h5 --normal-speed $v --tangential-speed $u --format csv
ez=$(value out ez) ex=$(value out ex)
expect 0 pair $scene --velocity 1 --angle 30 --method sync --tolerance 1e-5 --format csv
near "$ez" "$(value out ez)" 1.1e-3
near "$ex" "$(value out ex)" 1.1e-3

printf 'name,normal_speed_m_s,tangential_speed_m_s\na,%s,%s\nb,-1,0\n' $v $u >cases.csv
expect 1 table query t.h5 --input cases.csv --output answers.csv
[ "$(value answers.csv ez)" = "$ez" ] || fail "a row gives another pair than an option"
has answers.csv 'out of its range'

# The same command writes the same bytes, with any number of threads.
expect 0 table build $scene --speed 0.1:1 --tolerance 1e-3 --threads 1 --output one.h5
expect 0 table build $scene --speed 0.1:1 --tolerance 1e-3 --threads 2 --output two.h5
cmp one.h5 two.h5 || fail "one and two threads give different files"
cmp t.h5 two.h5 || fail "the same build gives different files"

# One pair goes to a file as well, and what would not be used is refused.
expect 0 table query t.h5 --normal-speed $v --tangential-speed $u --format csv --output one.csv
[ -s out ] && fail "--output is there, and standard output is written"
[ "$(value one.csv ez)" = "$ez" ] || fail "--output gives another pair"
refused '--format = text: not with --input' table query t.h5 --input cases.csv --format text
refused '--normal-speed: not with --input' table query t.h5 --input cases.csv --normal-speed 1
refused '--format = "json"' table query t.h5 --normal-speed 1 --format json

# Beyond the range the ends are taken, and limits that are passed are said.
expect 0 table query t.h5 --normal-speed 2
has err "remark: the normal speed is outside the table's range"
expect 0 table build $scene --speed 1 --tolerance 1e-3 --output one.h5
expect 0 table query one.h5 --normal-speed 2
has err "remark: the normal speed is outside the table's range"
expect 0 table query t.h5 --normal-speed 1 --tangential-speed 1000
has err 'remark: sliding distance above 0.3 of the contact radius'

# Cells with commas and quotes come back as they were.
printf 'name,normal_speed_m_s\n"a, ""b""",3\n' >quoted.csv
expect 0 table query t.h5 --input quoted.csv
has out '"a, ""b""",3,'
has err "the normal speed is outside the table's range, 0.1 to 1 m/s, whose ends are taken"

# The figure.
if have_module matplotlib; then
    expect 0 table build $scene --speed 0.01:10 --tolerance 1e-3 --output f.h5 --figure f.svg
    has f.svg '<svg' 'slide'
fi
refused 'a table is an HDF5 file, not CSV: take .h5' table build $scene --output x.csv
refused '--figure' table build $scene --output x.h5 --figure x.txt
refused 'no curves' table build $scene --speed 1 --output x.h5 --figure x.svg
[ -e x.h5 ] && fail "refused, and written"

refused 'an action is missing' table
refused 'unknown action "sort"' table sort
refused '--output is missing' table build $scene
refused 'no table is described' table build --output x.h5
refused 'unknown option' table build $scene --delta1 1:2 --output x.h5
refused '--speed = "1:x"' table build $scene --speed 1:x --output x.h5
refused 'speed (m/s) = 2 to 1' table build $scene --speed 2:1 --output x.h5
refused '--tolerance = "0"' table build $scene --tolerance 0 --output x.h5
refused 'a table file is missing' table info
refused 'cannot be read' table info none.h5
refused 'is not a table file' table info cases.csv
refused '--normal-speed is missing' table query t.h5
refused '--normal-speed = "nan"' table query t.h5 --normal-speed nan
refused 'is given twice' table query t.h5 --normal-speed 1 --normal-speed 2
head -c 3000 t.h5 >cut.h5
refused 'damaged or cut' table query cut.h5 --normal-speed 1
absent x.h5
