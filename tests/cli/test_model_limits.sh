#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Unlike materials by --partner FILE, and the model limits in words: text, JSON, and the names in
# the column status.
. "$(dirname -- "$0")/common.sh"

glass="--material $materials/aluminium_oxide.json --partner $materials/soda_lime_glass.json --radius 0.0025
    --density 4000 --friction 0.092"

# Dundurs' constant of the pair, by hand from the moduli in the files: 154 GPa and 0.23, 29.2 GPa
# and 0.2.
expect 0 pair $glass --velocity 3.9 --angle 40
has out "Dundurs' beta          -0.263" 'passed: the bodies are elastically unlike'
expect 0 pair --material "$materials/steel.json" --radius 0.01 --friction 0.2 --velocity 0.1 --angle 30
has out "Dundurs' beta          0.286" 'passed: the bodies are elastically unlike' # with a rigid wall
expect 0 pair $glass --velocity 3.9 --angle 40 --dundurs-limit 0.3
grep -q 'passed:' out && fail "a limit that can be set was passed"
expect 0 pair $glass --velocity 3.9 --angle 40 --format json
has out '"dundurs_beta": -0.26' 'elastically unlike'

expect 0 pair --material "$materials/polyisobutylene.json" --radius 0.005 --density 7800 --friction 0.3 \
    --grid speed=1e-4:10:2:log,angle=0:85:2 --output grid.csv
[ -z "$(value grid.csv status 1)" ] || fail "a gentle impact is flagged: $(value grid.csv status 1)"
[ "$(value grid.csv status 3)" = LARGE_CONTACT ] || fail "10 m/s gives '$(value grid.csv status 3)'"

# history has no place for them but standard error; nothing is said of a gentle impact.
ball="--material $materials/polyisobutylene.json --radius 0.005 --density 7800 --friction 0.3 --angle 30"
expect 0 history $ball --velocity 10 --output history.csv
has err 'restitute: remark: ' 'contact radius/R = 0.' 'exceeds the limit 0.1'
expect 0 history $ball --velocity 1e-4 --output history.csv
[ ! -s err ] || fail "a remark on a gentle impact"
expect 0 pair $ball --velocity 10 --format csv
has err 'restitute: remark: contact radius/R = 0.'

# The slow method names the fast one where it misses its tolerance.
expect 0 pair --psi 0.5 --delta1 1 --gamma 1 --tolerance 1e-6 --max-work 1e-3
has err 'remark: tolerance = 1e-06: ' 'the method sync'
expect 0 pair --psi 0.5 --delta1 1 --gamma 1
[ ! -s err ] || fail "a remark on an easy impact"

printf 'partner,speed_m_s\nrigid,1\n%s,1\nsame,1\n' "$materials/soda_lime_glass.json" >cases.csv
expect 0 pair --input cases.csv --material "$materials/steel.json" --radius 0.01 --density 7850 --friction 0.2 \
    --angle 30 --output out.csv
[ "$(value out.csv ex 1)" != "$(value out.csv ex 2)" ] || fail "the partner's material has no effect"
has out.csv.meta.json 'soda_lime_glass.json' 'Soda-lime'
refused 'must be a number in [0, inf]' pair $glass --velocity 1 --radius-limit -1
refused 'nowhere.json' pair --material "$materials/steel.json" --partner nowhere.json --radius 1 --density 1 \
    --friction 0 --velocity 1
