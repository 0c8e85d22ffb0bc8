#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# --grid: all points of the grid, in order, and a figure of them.
. "$(dirname -- "$0")/common.sh"
"$RESTITUTE" pair --psi 1 --figure f.svg >out 2>err
grep -q 'needs matplotlib' err && { echo "skipped: no matplotlib here"; exit 77; }

grid=speed=0.1:10:3:log,angle=0:80:5
expect 0 pair $scene --grid $grid --output grid.csv --figure grid.svg
has err '13 of 15 rows exceed the limit LARGE_CONTACT' # at 1 m/s and more
grep -qv 'rows exceed the limit' err && fail "other messages in a good run"
[ "$(head -1 grid.csv)" = "speed_m_s,angle_deg,ez,ex,contact_time,max_indentation,radius_ratio,error_ez,error_ex,method,status" ] ||
    fail "the header is $(head -1 grid.csv)"
[ "$(wc -l <grid.csv)" -eq 16 ] || fail "not 15 rows"
[ "$(sed 1d grid.csv | cut -d, -f1,2 | tr '\n' ' ')" = "0.1,0 0.1,20 0.1,40 0.1,60 0.1,80 1,0 1,20 1,40 1,60 1,80 \
10,0 10,20 10,40 10,60 10,80 " ] || fail "the points are not those of the grid"
has grid.csv.meta.json "$grid" Polyisobutylene '"speed_m_s": "m/s"'

# One point of the grid is the single impact.
expect 0 pair $scene --velocity 1 --angle 40 --format csv
[ "$(value out ez)" = "$(value grid.csv ez 8)" ] || fail "a grid point differs from the single impact"

# The figure: well-formed, with its labels; a rerun writes the same bytes.
has grid.svg '<svg' '</svg>' Polyisobutylene restitute 'normal speed' 'angle from the normal'
have python3 && python=python3 || python=true
"$python" -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' grid.svg || fail "not XML"
cp grid.svg before.svg && cp grid.csv before.csv && cp grid.csv.meta.json before.json
expect 0 pair $scene --grid $grid --output grid.csv --figure grid.svg
cmp grid.svg before.svg && cmp grid.csv before.csv && cmp grid.csv.meta.json before.json || fail "a rerun writes other bytes"

expect 0 pair $scene --grid $grid --figure grid.png
has out speed_m_s
[ "$(head -c 4 grid.png | od -An -c | tr -d ' ')" = "211PNG" ] || fail "grid.png is no PNG"

# Names that matplotlib, a shell or XML might take for something else are shown and do nothing.
printf '%s\n' '{"name": "a'"'"'; system '"'"'touch hit'"'"' `touch hit` <b> & \u000a $(touch hit)",' \
    '"poisson_ratio": 0.5, "model": "elastic", "modulus_pa": 1e6}' >odd.json
expect 0 pair --material odd.json --radius 0.01 --density 1000 --friction 0.3 --grid speed=1:1:1,angle=0:0:1 \
    --figure "odd '; name.svg" --output odd.csv
absent hit
"$python" -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "odd '; name.svg" || fail "not XML"
[ "$(ls | grep -c '\.svg\.')" -eq 0 ] || fail "a temporary figure was left behind"

# Without matplotlib a figure is refused before the work; one that finds no room leaves the table.
mkdir without
echo 'raise ImportError' >without/matplotlib.py
(PYTHONPATH=$work/without; export PYTHONPATH; "$RESTITUTE" pair $scene --grid $grid --output t.csv --figure t.svg >out 2>err)
[ $? -eq 2 ] || fail "a missing matplotlib is not reported"
has err '--figure: needs matplotlib'
absent t.csv t.svg
(ulimit -f 20; "$RESTITUTE" pair $scene --grid $grid --output t.csv --figure t.svg 2>&1 | cat >err)
has err 't.svg: cannot be written: File too large'
[ -f t.csv ] || fail "the table is lost with the figure"
[ "$(ls | grep -c '^t\.svg')" -eq 0 ] || fail "a temporary figure was left behind"

# Axes of any number, one or two, and of materials.
expect 0 pair --gamma 0.1 --delta1 1 --grid psi=0.1:5:20 --output one.csv --figure one.svg
has one.svg ψ
expect 0 sweep --gamma 0.1 --grid psi=0.1:5:12,delta1=0.01:10:9:log --output two.csv --figure two.svg --contours
[ "$(sed -n '2p;3p' two.csv | cut -d, -f1,2 | tr '\n' ' ')" = "0.1,0.01 0.1,0.02371373706 " ] || fail "other points"
cp "$materials/steel.json" "$materials/aluminium.json" .
expect 0 pair --radius 0.01 --density 7800 --friction 0.3 --velocity 0.01 --method sync \
    --grid angle=0:80:5,material=steel.json:aluminium.json --output metals.csv --figure metals.pdf
[ "$(head -1 metals.csv | cut -d, -f1,2)" = "material,angle_deg" ] || fail "materials are not the curves"
[ "$(head -c 5 metals.pdf)" = "%PDF-" ] || fail "no PDF"

# A file with one or two columns that vary; whatever its order.
{ echo delta1,psi,gamma; for d in 2 0.5 1; do for p in 3 1 2 4; do echo $d,$p,1; done; done; } >cases.csv
expect 0 pair --input cases.csv --output rows.csv --figure rows.svg
has rows.svg ψ
expect 0 pair --input cases.csv --output rows.csv --figure rows.svg --contours
{ cat cases.csv; echo 1,2,2; } >three.csv
refused 'more than two columns' pair --input three.csv --figure rows.svg
{ echo psi; echo 1; } >none.csv
refused 'no columns' pair --input none.csv --figure rows.svg
sed '$d' cases.csv >hole.csv
refused 'no full grid' pair --input hole.csv --figure rows.svg --contours
sed '$s/4,1$/2.0,1/' cases.csv >twice.csv # as many rows as nodes: one twice, one never
refused 'no full grid' pair --input twice.csv --figure rows.svg --contours
sed '$s/^1,4/1.0,4e0/' cases.csv >written.csv
expect 0 pair --input written.csv --figure rows.svg --contours
refused 'needs two columns or axes' pair --grid psi=1:2:3 --figure rows.svg --contours
refused 'no numbers to be an axis' pair --radius 0.01 --density 7800 --friction 0.3 --velocity 1 \
    --grid material=steel.json:aluminium.json --figure rows.svg
refused '--contours: needs --figure' pair --grid psi=1:2:3 --contours
refused 'curves of psi: must be at most 15' pair --delta1 1 --gamma 1 --grid psi=0:5:16,chi=1:2:16 --figure rows.svg

# Rows that no run writes are not gone on with, nor are other columns; what is there stays.
expect 0 pair --input cases.csv --output whole.csv
awk '/^  "settings": \{/ { inside = 1; print "{"; next } inside && /^  \}/ { print "}"; exit } inside' whole.csv.meta.json >settings.json
edited() { # TEXT SCRIPT: the first four rows edited so are refused with that text
    sed -n '1,5p' whole.csv | sed "$2" >edited.csv
    cp edited.csv again.csv.partial
    cp settings.json again.csv.partial.json
    refused "$1" pair --input cases.csv --output again.csv --resume
    absent again.csv
    cmp edited.csv again.csv.partial || fail "a refused run changed the partial file"
}
row=$(sed -n 3p whole.csv | cut -d, -f1-3)
while read -r cells text; do
    edited "again.csv.partial line 3 (row 2): $text" "3s/.*/$row,$cells/"
done <<END
7,0.2,3,1,0,0,euler, ez = "7": must be in [0, 1]
-0.1,0.2,3,1,0,0,euler, ez = "-0.1": must be in [0, 1]
nan,0.2,3,1,0,0,euler, ez = "nan": must be in [0, 1]
0.7,-1.01,3,1,0,0,euler, ex = "-1.01": must be in [-1, 1]
0.7,0.2,-3,1,0,0,euler, contact_time = "-3": must be >= 0
0.7,0.2,3,,0,0,euler, max_indentation = "": must be >= 0
0.7,0.2,3,1,-5,0,euler, error_ez = "-5": must be >= 0
0.7,0.2,3,1,0,1x,euler, error_ex = "1x": must be >= 0
0.7,0.2,3,1,0,0,sync, method = "sync": must be euler
0.7,,,,,,,failed ez = "0.7": must be empty, since method is empty
,,,,,,, method and status are empty
END
edited 'again.csv.partial: column 4 is "ex": must be ez' '1s/ez,ex/ex,ez/'
edited 'again.csv.partial: has 10 columns: must be 11' 's/,[^,]*$//'

# What is rare is no reason to refuse a row: no rebound, no sliding, a failed row.
printf 'psi,delta1,gamma\n0,1,0\n1,1e12,0\n-1,1,0\n1e12,0,0\n' >rare.csv
expect 1 pair --input rare.csv --method sync --output rare.out
has rare.out ,inf,
cp rare.out wanted
sed -n '1,4p' wanted >rare.out.partial
awk '/^  "settings": \{/ { inside = 1; print "{"; next } inside && /^  \}/ { print "}"; exit } inside' rare.out.meta.json >rare.out.partial.json
expect 1 pair --input rare.csv --method sync --output rare.out --resume
cmp wanted rare.out || fail "rare rows are changed"

# Contours of what hardly varies or not at all: an elastic solid, a narrow range, an e_z that psi
# does not change.
contours() { # TEXT ARGUMENT...: the text stands in the figure
    text=$1
    shift
    expect 0 pair "$@" --method sync --output narrow.csv --figure narrow.svg --contours
    has narrow.svg "$text"
}
contours ' = 1 everywhere' --delta1 0 --gamma 0 --grid chi=1:2:6,psi=1:5:6
contours '>0.555<' --gamma 1 --grid delta1=2:3:6,psi=1.5:2:6
contours ' = 0.7792 everywhere' --gamma 1 --delta1 1 --grid chi=1:2:6,psi=1:5:6
