#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# One impact: text, CSV and JSON, the two kinds of input, defaults and aliases.
. "$(dirname -- "$0")/common.sh"

# 1e-3 is the default tolerance of the command; the reference values are good to 1e-6 or better.
expect 0 pair --chi 1.1666666666666667 --psi 1.38779 --delta1 0.815259 --gamma 1.46172 --format csv
near "$(value out ez)" 0.834789766 1e-3
near "$(value out ex)" 0.472769791 1e-3
near "$(value out max_indentation)" 0.833106905 1e-3
[ "$(value out method)" = euler ] || fail "method is not euler"
[ -z "$(value out status)" ] || fail "a remark on an impact without one"
cp out full.csv

# chi = 7/6 is the default; delta2 = delta1 sqrt(gamma) stands for gamma or for delta1. The product
# is rounded, so the pair agrees only to rounding, amplified over the steps: 1e-9 is far above that
# and far below the tolerance.
delta2=0.9856612802509994
for rest in "--delta1 0.815259 --gamma 1.46172" "--delta1 0.815259 --delta2 $delta2" "--gamma 1.46172 --delta2 $delta2"; do
    expect 0 pair --psi 1.38779 $rest --format csv
    near "$(value out ez)" "$(value full.csv ez)" 1e-9
done

# No slip, elastic: published value 0.10397 at chi = 7/6.
expect 0 pair --psi 0 --format csv
near "$(value out ez)" 1 1e-3
near "$(value out ex)" 0.10397 1e-3

# Text names all that a user needs.
expect 0 pair --psi 2 --delta1 1 --gamma 1
has out 'ez =' 'ex =' '+-' 'contact time' 'largest indentation' 'Energy' 'friction' 'chi = ' 'psi = ' 'elements' 'steps'
expect 0 pair $scene --velocity 1 --angle 30
has out Polyisobutylene ' s ' ' m ' ' N '

# Steel on polyisobutylene at 1 m/s along the normal, psi = 2: the angle follows from psi =
# (2-2nu)/(2-nu) tan(angle)/mu. Reference good to 3e-6; speed = 1/cos(angle), angle = atan(0.9).
expect 0 pair $scene --velocity 1.3453624047073710 --angle 41.987212495816664 --format csv
near "$(value out ez)" 0.280916784 1e-3
near "$(value out ex)" 0.151295099 1e-3
cp out first.csv
expect 0 pair --material $materials/polyisobutylene.csv --radius1 0.005 --density1 7800 --friction 0.3 \
    --speed 1.3453624047073710 --angle 41.987212495816664 --format csv
[ "$(value out ez)" = "$(value first.csv ez)" ] || fail "the .csv material and the aliases give another pair"

# Spin: backspin that cancels the sliding leaves nothing to turn back; sin(30 deg) * 1 m/s = 0.5 m/s
# = 0.005 m * 100/s.
expect 0 pair $scene --velocity 1 --angle 30 --spin -100 --format json
near "$(sed -n 's/.*"psi": \([^,]*\),*/\1/p' out)" 0 1e-12 # rounding in sin(30 deg)
expect 0 pair $scene --velocity 1 --angle 30 --rotation-blocked
has out 'chi = 0.333333'

# Two spheres of the material; its density is the default.
expect 0 pair --material $materials/polyisobutylene.json --radius 0.005 --radius2 0.01 --partner same --friction 0.3 \
    --velocity 1 --format json
if have python3; then python3 -m json.tool out >/dev/null || fail "the output is not JSON"; fi
has out '"version"' '"command"' '"tolerance"' '"ez"' '"residual_z"' '"chi"' '"units"' '"name"'

# The other method, at a tolerance that the default one would need minutes for. Euler is within 1e-3
# of it.
expect 0 pair --chi 1.1666666666666667 --psi 1.38779 --delta1 0.815259 --gamma 1.46172 --method sync --tolerance 1e-7 \
    --format csv
near "$(value out ez)" 0.834789766 1.01e-7 # the reference is printed with nine digits
near "$(value out ex)" 0.472769791 1.01e-7
[ "$(value out method)" = sync ] || fail "method is not sync"
[ -z "$(value out status)" ] || fail "a remark on an impact without one"
expect 0 pair --psi 2 --delta1 1 --gamma 1 --method sync
has out 'ez =' 'ex =' 'sync, tolerance 0.001'

# Number and time step can be set; a step too large to be stable is refused with the largest that
# is.
expect 0 pair --psi 2 --delta1 1 --gamma 1 --elements 50 --time-step 0.002 --format json
has out '"elements": 50' '"time_step": 0.002'
refused 'time_step' pair --psi 2 --delta1 100 --gamma 0 --time-step 1

# A body that never rebounds has its own remark.
cat >sinking.json <<'END'
{"name": "putty", "model": "maxwell", "poisson_ratio": 0.5, "modulus_pa": 1e5, "viscosity_pa_s": 1}
END
expect 0 pair --material sinking.json --radius 0.01 --mass1 0.1 --friction 0.3 --velocity 0.1 --format csv
near "$(value out ez)" 0 0
[ "$(value out contact_time)" = inf ] || fail "the contact time is $(value out contact_time), not inf"
grep -q 'never rebounds' out || fail "no remark on a body that never rebounds"

# To a file: whole, with its record beside it, and the same bytes again.
expect 0 pair --psi 2 --format csv --output one.csv
cp one.csv before && cp one.csv.meta.json before.json
expect 0 pair --psi 2 --format csv --output one.csv
cmp one.csv before && cmp one.csv.meta.json before.json || fail "a rerun writes other bytes"
