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

# One pair goes to a file as well, and what would not be used is refused.
expect 0 table query t.h5 --normal-speed $v --tangential-speed $u --format csv --output one.csv
[ -s out ] && fail "--output is there, and standard output is written"
[ "$(value one.csv ez)" = "$ez" ] || fail "--output gives another pair"
refused '--format = text: not with --input' table query t.h5 --input cases.csv --format text
refused '--normal-speed: not with --input' table query t.h5 --input cases.csv --normal-speed 1
refused '--format = "json"' table query t.h5 --normal-speed 1 --format json

# Beyond the ranges the ends are taken, and that is said.
for outside in '--delta1 0.3' '--chi 1' '--gamma 1'; do
    expect 0 table query r.h5 --psi 1 $outside
    has err "warning: $(expr "$outside" : '--\([a-z0-9]*\)') is outside"
done
expect 0 table query r.h5 --psi 1
[ -s err ] && fail "a warning for what is in the table"

# Cells with commas and quotes come back as they were.
printf 'name,psi,delta1\n"a, ""b""",1,0.3\n' >quoted.csv
expect 0 table query r.h5 --input quoted.csv
has out '"a, ""b""",1,0.3,'
has err 'whose ends are taken: 1'

# Rows beyond the range asked for, up to the seams, hold what is kept there: ez falls with the speed, and on.
expect 0 table build $scene --speed 0.11:0.9 --tolerance 1e-3 --output seams.h5
expect 0 table export seams.h5
cp out seams.csv
awk -F, 'NR > 1 && $1 != last { if (NR > 2 && $5 >= ez) exit 1; last = $1; ez = $5; low = NR == 2 ? $1 : low }
    END { exit !(low < 0.11 && last > 0.9) }' seams.csv || fail "exported ez does not fall with the speed beyond the range"

# A solid that is too strongly damped is named by its numbers.
refused 'lower the upper end of delta1' table build --delta1 1e-6:1e6 --gamma 0 --tolerance 1e-3 --output x.h5
has err 'delta1 = '

# Interrupted as soon as it is at work, then resumed: the same file as without. A build that was done before the signal came is made again
# with a finer tolerance, so that the speed of the machine does not matter.
for tolerance in 3e-4 1e-4 3e-5; do
    set -- table build --delta1 0.1:1 --gamma 0.5:2 --chi 1:1.5 --tolerance $tolerance --threads 1
    "$RESTITUTE" "$@" --output slow.h5 >out 2>err </dev/null &
    build=$!
    sleep 0.2
    kill -TERM $build 2>/dev/null
    wait $build
    [ -f slow.h5.partial ] && break
    rm -f slow.h5
done
[ -f slow.h5.partial ] || fail "an interrupted build leaves no slow.h5.partial"
absent slow.h5
has err 'interrupted; go on with --resume'
refused 'other settings' table build --delta1 0.1:1 --gamma 0.5:2 --tolerance 4e-3 --resume --output slow.h5
expect 0 "$@" --resume --output slow.h5
absent slow.h5.partial
expect 0 "$@" --output straight.h5
cmp slow.h5 straight.h5 || fail "resumed and straight builds differ"

# Such a table from its file: within its tolerance of the impact itself. In the export delta1 goes beyond its range no further than cells do, two
# octaves of w and those of h over an octave of gamma.
expect 0 table info slow.h5
has out 'of ex, ' 'of ez; '
expect 0 table query slow.h5 --chi 1.2 --psi 1.5 --delta1 0.3 --gamma 0.9 --format csv
ez=$(value out ez) ex=$(value out ex)
expect 0 pair --chi 1.2 --psi 1.5 --delta1 0.3 --gamma 0.9 --method sync --tolerance 1e-6 --format csv
near "$ez" "$(value out ez)" 3.1e-4
near "$ex" "$(value out ex)" 3.1e-4
expect 0 table export slow.h5
awk -F, 'NR > 1 && ($1 < 0.1 / 8 || $1 > 8 || $2 < 0.5 || $2 > 2) { exit 1 }' out || fail "exported nodes are beyond the seams"
head -c 5000 slow.h5 >cut.h5
refused 'damaged or cut' table query cut.h5 --psi 1

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
