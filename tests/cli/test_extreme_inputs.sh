#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Extreme but valid scenes give a pair within its physical limits.
. "$(dirname -- "$0")/common.sh"

printf '%s\n' '{"name": "hard", "poisson_ratio": 0.25, "model": "elastic", "modulus_pa": 1e12}' >hard.json
{
    echo tau_s,G_Pa
    awk 'BEGIN { for (k = -12; k <= 8; k++) printf "1e%d,1e%d\n", k, 7 - k / 4 }'
} >wide.csv # relaxation times over 20 decades
within_limits() {
    awk -v ez="$(value out ez)" -v ex="$(value out ex)" 'BEGIN { exit !(ez >= 0 && ez <= 1 && ex >= -1 && ex <= 1) }' ||
        fail "not a possible pair: $(cat out)"
}
scene_of() { expect 0 pair --format csv "$@" --friction 0.3 --density 2000 --angle 30 && within_limits; }
for file in hard.json wide.csv $materials/polyisobutylene.json; do
    for radius in 1e-9 1e-3 1e3; do
        for speed in 1e-9 1; do
            scene_of --material $file --radius $radius --velocity $speed
        done
    done
done
expect 0 pair --format csv --material hard.json --radius 1e-9 --density 2000 --friction inf --velocity 1e-9 --angle 89.999
within_limits
expect 0 pair --format csv --material hard.json --radius 1 --density 2000 --radius2 1e-6 --mass2 inf --friction 0 --velocity 1
within_limits

# The corners of the dimensionless domain in which the default error is promised.
{
    echo chi,psi,delta1,gamma
    for chi in 0.3333333333333333 4; do
        for psi in 0.05 10; do
            for delta1 in 0 1e-3 100; do
                for gamma in 0 1e-3 1e3 inf; do
                    echo "$chi,$psi,$delta1,$gamma"
                done
            done
        done
    done
} >cases.csv
expect 0 pair --input cases.csv --output out.csv
awk -F, 'NR > 1 && ($5 < 0 || $5 > 1 || $6 < -1 || $6 > 1 || $12 != "") { print; bad = 1 } END { exit bad }' out.csv ||
    fail "a corner of the domain has an impossible pair or a remark"
