#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The method bem of the command, and its fields.
. "$(dirname -- "$0")/common.sh"

"$RESTITUTE" pair --psi 1 --method bem --tolerance 0.1 >out 2>err
if grep -q 'is not in this build' err; then
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
if have_module h5py; then
    expect 0 history --psi 0.7 --delta1 1 --gamma 1 --method bem --elements 16 --tolerance 0.1 --output h.csv --fields f.h5
    [ -s f.h5 ] || fail "no file of the fields"
    if have_h5py; then
        "$python" -c 'import h5py; f = h5py.File("f.h5"); print(f["pressure"].shape, f["stick"].shape)' >dump
        has dump '(9, 36, 36) (9, 36, 36)'
    fi
fi
absent f.h5.tmp
refused '--fields: need the method bem' history --psi 0.7 --fields f.h5
refused 'must end in .h5 or .hdf5' history --psi 0.7 --method bem --fields f.csv
refused 'no instantaneous modulus' pair --psi 0.7 --delta1 1 --gamma 0 --method bem
expect 0 pair --material "$materials/polyisobutylene.json" --radius 0.005 --density 7800 --friction 0.3 --velocity 1 --angle 30 \
    --method bem --tolerance 0.01 --format csv
cp out bem.csv
expect 0 pair --material "$materials/polyisobutylene.json" --radius 0.005 --density 7800 --friction 0.3 --velocity 1 --angle 30 \
    --method sync --format csv
near "$(value bem.csv ex)" "$(value out ex)" 0.01 || fail "polyisobutylene: ex $(value bem.csv ex), not $(value out ex)"
near "$(value bem.csv ez)" "$(value out ez)" 0.01 || fail "polyisobutylene: ez $(value bem.csv ez), not $(value out ez)"
