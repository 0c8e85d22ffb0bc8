#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# --grid: all points of the grid, in order, and a figure of them.
. "$(dirname -- "$0")/common.sh"
command -v gnuplot >/dev/null || { echo "skipped: no gnuplot"; exit 77; }

grid=speed=0.1:10:3:log,angle=0:80:5
expect 0 pair $scene --grid $grid --output grid.csv --figure grid.svg
[ ! -s err ] || fail "messages in a good run"
[ "$(head -1 grid.csv)" = "speed_m_s,angle_deg,ez,ex,contact_time,max_indentation,error_ez,error_ex,method,status" ] ||
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
python=$(command -v python3 || true)
[ -z "$python" ] || "$python" -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' grid.svg || fail "not XML"
cp grid.svg before.svg && cp grid.csv before.csv && cp grid.csv.meta.json before.json
expect 0 pair $scene --grid $grid --output grid.csv --figure grid.svg
cmp grid.svg before.svg && cmp grid.csv before.csv && cmp grid.csv.meta.json before.json || fail "a rerun writes other bytes"

expect 0 pair $scene --grid $grid --figure grid.png
has out speed_m_s
[ "$(head -c 4 grid.png | od -An -c | tr -d ' ')" = "211PNG" ] || fail "grid.png is no PNG"

# Names that gnuplot, a shell or XML might take for something else are shown and do nothing.
printf '%s\n' '{"name": "a'"'"'; system '"'"'touch hit'"'"' `touch hit` <b> & \u000a $(touch hit)",' \
    '"poisson_ratio": 0.5, "model": "elastic", "modulus_pa": 1e6}' >odd.json
expect 0 pair --material odd.json --radius 0.01 --density 1000 --friction 0.3 --grid speed=1:1:1,angle=0:0:1 \
    --figure "odd '; name.svg" --output odd.csv
absent hit
[ -z "$python" ] || "$python" -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "odd '; name.svg" || fail "not XML"
[ "$(ls | grep -c '\.svg\.')" -eq 0 ] || fail "a temporary figure was left behind"

# A gnuplot that fails half way: said so, the table stays, no piece of a figure does.
mkdir bin
printf '#!/bin/sh\n[ "$1" = --version ] && exit 0\nhead -c 20\necho "out of ink" >&2\nexit 1\n' >bin/gnuplot
chmod 755 bin/gnuplot
(PATH=$work/bin:$PATH; export PATH; "$RESTITUTE" pair $scene --grid $grid --output t.csv --figure t.svg >out 2>err)
[ $? -eq 2 ] || fail "a failing gnuplot is not reported"
has err 'gnuplot failed: out of ink'
[ -f t.csv ] || fail "the table is lost with the figure"
absent t.svg
[ "$(ls | grep -c '^t\.svg')" -eq 0 ] || fail "a temporary figure was left behind"
