#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The method bem of the command, and the campaign: shards and resumed runs give the rows of one run.
. "$(dirname -- "$0")/common.sh"

"$RESTITUTE" pair --psi 1 --method bem --tolerance 0.1 >out 2>err
if grep -q 'is not in this build' err; then
    refused 'the component bem is not in this build' bench --bem-campaign 1
    echo "skipped: no component bem in this build"
    exit 77
fi

expect 0 pair --chi 1.1666666666666667 --psi 0.7 --delta1 1 --gamma 1 --method bem --format csv
[ "$(value out method)" = bem ] || fail "method is not bem"
near "$(value out ez)" 0.779151 0.001 || fail "ez = $(value out ez)"
near "$(value out ex)" 0.273226 0.001 || fail "ex = $(value out ex)"
expect 0 pair --psi 0.7 --method bem-paper --elements 16 --tolerance 0.1
has out 'bem-paper, tolerance 0.1'
expect 0 history --psi 0.7 --delta1 1 --gamma 1 --method bem --tolerance 0.01 --samples 20 --output history.csv
[ "$(wc -l <history.csv)" -ge 20 ] || fail "rows of the history"
expect 0 history --psi 0.7 --delta1 1 --gamma 1 --method bem --elements 16 --tolerance 0.1 --output h.csv --fields f.png
[ -s f.png ] || fail "no figure of the fields"
"$RESTITUTE" history --psi 0.7 --delta1 1 --gamma 1 --method bem --elements 16 --tolerance 0.1 --output h.csv --fields f.h5 2>err
if ! grep -q 'HDF5 is not in this build' err; then
    [ -s f.h5 ] || fail "no file of the fields"
    if have_h5py; then
        "$python" -c 'import h5py; f = h5py.File("f.h5"); print(f["pressure"].shape, f["stick"].shape)' >dump
        has dump '(9, 36, 36) (9, 36, 36)'
    fi
fi
absent f.h5.tmp
refused 'needs --method bem' history --psi 0.7 --fields f.h5
refused 'must end in .h5, .hdf5, .svg or .png' history --psi 0.7 --method bem --fields f.csv
refused 'no instantaneous modulus' pair --psi 0.7 --delta1 1 --gamma 0 --method bem
expect 0 pair --material "$materials/polyisobutylene.json" --radius 0.005 --density 7800 --friction 0.3 --velocity 1 --angle 30 \
    --method bem --tolerance 0.01 --format csv
cp out bem.csv
expect 0 pair --material "$materials/polyisobutylene.json" --radius 0.005 --density 7800 --friction 0.3 --velocity 1 --angle 30 \
    --method sync --format csv
near "$(value bem.csv ex)" "$(value out ex)" 0.01 || fail "polyisobutylene: ex $(value bem.csv ex), not $(value out ex)"
near "$(value bem.csv ez)" "$(value out ez)" 0.01 || fail "polyisobutylene: ez $(value bem.csv ez), not $(value out ez)"

# Columns of the times differ from run to run, and those of differences, formed again of nine digits
# by --join, in their last.
rows() {
    grep -v '^#' "$1" | cut -d, -f1-12,15,16,19-
}
expect 0 bench --bem-campaign 5 --grid 32 --output whole --figure whole.svg
has out 'all           5        0'
has out 'rebound in one and none in the other: 0'
[ -s whole.svg ] && [ "$(rows whole-bem.csv | wc -l)" -eq 6 ] || fail "not five rows and a figure"
absent whole-bem.csv.partial
awk -F, '/^[0-9]/ { if ($13 > 0.01 || $13 < -0.01 || $14 > 0.01 || $14 < -0.01) exit 1 }' whole-bem.csv || fail "far from sync"
expect 0 bench --bem-campaign 5 --grid 32 --shard 1/2 --output a
expect 0 bench --bem-campaign 5 --grid 32 --shard 2/2 --output b
[ "$(rows a-bem.csv | wc -l)" -eq 4 ] || fail "rows of a shard"
expect 0 bench --bem-campaign 5 --grid 32 --join a-bem.csv,b-bem.csv --output joined
rows whole-bem.csv >1 && rows joined-bem.csv >2 && cmp 1 2 || fail "joined shards differ from one run"
(head -4 whole-bem.csv && printf '4,pro') >again-bem.csv.partial
refused 'left from an interrupted run' bench --bem-campaign 5 --grid 32 --output again
expect 0 bench --bem-campaign 5 --grid 32 --output again --resume
rows again-bem.csv >2 && cmp 1 2 || fail "a resumed run differs from one in one go"
head -4 whole-bem.csv >other-bem.csv.partial
refused 'is of a run with other settings' bench --bem-campaign 5 --grid 32 --seed 3 --output other --resume
for cell in 2:9:ex_sync 3:9:7 3:12:-2 3:15:-1; do
    awk -F, -v OFS=, -v change=$cell '{ split(change, to, ":") } NR == to[1] { $to[2] = to[3] } { print }' a-bem.csv >c-bem.csv
    refused 'c-bem.csv: no row of this campaign' bench --bem-campaign 5 --grid 32 --join c-bem.csv,b-bem.csv
done
refused 'no-such.csv' bench --bem-campaign 5 --grid 32 --join no-such.csv

# A resumed run keeps the rows that are done, even if there is no room for more.
(head -4 whole-bem.csv && printf '4,pro') >kept-bem.csv.partial
cp kept-bem.csv.partial kept
(ulimit -f 0; "$RESTITUTE" bench --bem-campaign 5 --grid 32 --output kept --resume >out 2>err) && fail "wrote without room"
head -4 kept >done && cmp done kept-bem.csv.partial || fail "an interrupted run was lost"

refused 'no/such/x-bem.csv' bench --bem-campaign 5 --output no/such/x
refused '--shard = "5/7": is empty' bench --bem-campaign 2 --shard 5/7
refused '--shard = "3/2"' bench --bem-campaign 5 --shard 3/2
refused '--shard = "1"' bench --bem-campaign 5 --shard 1
refused '--bem-campaign = "0"' bench --bem-campaign 0
refused '--grid = "15"' bench --bem-campaign 5 --grid 15
refused '--grid = 33: must be even' bench --bem-campaign 5 --grid 33
refused '--grid: only with --bem-campaign' bench --quick --grid 64
refused '--bem-campaign: has impacts and methods of its own' bench --bem-campaign 5 --quick
