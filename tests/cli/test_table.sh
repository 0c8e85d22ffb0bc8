#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# restitute table: build, info, query, export; interrupted and resumed; refusals by name; what is missing in the build.
. "$(dirname -- "$0")/common.sh"

"$RESTITUTE" table --help >out 2>err
if grep -q 'no component table_files' err; then
    refused 'HDF5' table build
    exit 0
fi

expect 0 table --help
has out build info query export
for action in build info query export; do
    expect 0 table $action --help
    for option in $(sed -n 's/^  *--\([a-z0-9-]*\).*/\1/p' out); do
        sed 's/\\-/-/g' "$SOURCE_DIR/docs/restitute.1" | grep -Eq "(^\.It Fl|Fl) -$option( |\$)" ||
            fail "the manual page lacks --$option"
    done
done

expect 0 table build $scene --speed 0.1:1 --tolerance 1e-3 --output t.h5
has out 'verified at'
absent t.h5.partial
expect 0 table info t.h5
has out 'one contact' '0.1 to 1 m/s' 'verified at'
expect 0 table info t.h5 --format json
has out '"error_ez"' '"tolerance": 0.001'

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

expect 0 table export t.h5 --output all.csv
head -n 1 all.csv >head
has head 'speed_m_s,gamma,chi,psi,ez,ex'

# The same command writes the same bytes, with any number of threads.
expect 0 table build $scene --speed 0.1:1 --tolerance 1e-3 --threads 1 --output one.h5
expect 0 table build $scene --speed 0.1:1 --tolerance 1e-3 --threads 2 --output two.h5
cmp one.h5 two.h5 || fail "one and two threads give different files"
cmp t.h5 two.h5 || fail "the same build gives different files"

# Ranges.
expect 0 table build --delta1 0.1:0.2 --gamma 0 --tolerance 1e-2 --output r.h5
expect 0 table query r.h5 --psi 2 --delta1 0.15
has out 'ez = 0.' 'ex = '
refused 'not for a table of ranges' table query r.h5 --normal-speed 1
refused 'not for a table of one contact' table query t.h5 --psi 1

# Interrupted after a second, then resumed: the same file as without.
if command -v timeout >/dev/null; then
    set -- table build --delta1 0.1:1 --gamma 0.5:2 --tolerance 3e-3 --threads 1
    timeout -s INT 1 "$RESTITUTE" "$@" --output slow.h5 >out 2>err </dev/null
    if [ -f slow.h5.partial ]; then # a fast machine may be done by then
        absent slow.h5
        has err 'interrupted; go on with --resume'
        refused 'other settings' table build --delta1 0.1:1 --gamma 0.5:2 --tolerance 4e-3 --resume --output slow.h5
        expect 0 "$@" --resume --output slow.h5
        absent slow.h5.partial
        expect 0 "$@" --output straight.h5
        cmp slow.h5 straight.h5 || fail "resumed and straight builds differ"
    fi
fi

refused 'an action is missing' table
refused 'unknown action "sort"' table sort
refused '--output is missing' table build $scene
refused 'no table is described' table build --output x.h5
refused 'not with a contact' table build $scene --delta1 1:2 --output x.h5
refused '--speed: needs a contact' table build --delta1 1:2 --speed 1:2 --output x.h5
refused '--speed = "1:x"' table build $scene --speed 1:x --output x.h5
refused 'speed (m/s) = 2 to 1' table build $scene --speed 2:1 --output x.h5
refused 'delta1 = -1' table build --delta1 -1:1 --output x.h5
refused '--tolerance = "0"' table build $scene --tolerance 0 --output x.h5
refused 'a table file is missing' table info
refused 'cannot be read' table info none.h5
refused 'is not a table file' table info cases.csv
refused '--normal-speed is missing' table query t.h5
refused '--normal-speed = "nan"' table query t.h5 --normal-speed nan
refused 'is given twice' table query t.h5 --normal-speed 1 --normal-speed 2
head -c 3000 t.h5 >cut.h5
refused 'damaged or cut' table query cut.h5 --normal-speed 1
absent x.h5 x.h5.partial
