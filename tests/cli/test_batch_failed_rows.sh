#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A bad row does not stop the others: its numbers stay empty, the column status says why, the exit
# status is 1.
. "$(dirname -- "$0")/common.sh"

cat >cases.csv <<'END'
chi,psi,delta1,gamma
1.2,1,1,1
1.2,-1,1,1
1.2,nan,1,1
1.2,,1,1
0.1,1,1,1
1.2,1,1,inf
END
expect 1 pair --input cases.csv --output out.csv
[ "$(wc -l <out.csv)" -eq 7 ] || fail "not 6 rows"
has err 'cases.csv line 3 (row 2): psi = -1: must be in [0, 1e12]' '4 of 6 rows failed'
has out.csv '1.2,-1,1,1,,,,,,,,"psi = -1: must be in [0, 1e12]"' '1.2,nan,1,1,,,,,,,,"psi = ""nan"" is not a number' \
    'psi is empty' 'chi = 0.1: must be in [1/3, 1000]'
[ -n "$(value out.csv ez 1)" ] && [ -n "$(value out.csv ez 6)" ] || fail "good rows have no result"
has out.csv.meta.json '"failed": 4'

# Physical rows, with every column.
cat >cases.csv <<END
radius1_m,density1_kg_m3,mass1_kg,inertia1_kg_m2,radius2_m,density2_kg_m3,mass2_kg,inertia2_kg_m2,speed_m_s,angle_deg,spin_rad_s,spin2_rad_s,friction,material,partner,rotation_blocked
0.005,7800,,,,,,,1,30,,,0.3,$materials/polyisobutylene.json,rigid,0
0.005,,0.004,,0.01,,0.03,,1,30,5,-5,inf,$materials/polyisobutylene.json,rigid,0
0.005,,0.004,4e-8,0.01,1000,,5e-7,1,30,,,0.3,$materials/polyisobutylene.json,same,0
0.005,,,,0.01,,,,1,30,,,0,$materials/polyisobutylene.json,same,1
0.005,7800,,,inf,,,,1,90,,,0.3,$materials/polyisobutylene.json,rigid,0
0.005,7800,0.004,,inf,,,,1,9,,,0.3,$materials/polyisobutylene.json,rigid,0
0.005,7800,,,inf,,,,0,9,,,0.3,$materials/polyisobutylene.json,rigid,0
0.005,7800,,,inf,,,,1,9,,,0.3,none.json,rigid,0
0.005,7800,,,inf,,,,1,9,,,0.3,$materials/polyisobutylene.json,soft,0
0.005,7800,,,inf,,,,1,9,,,0.3,$materials/polyisobutylene.json,rigid,2
END
expect 1 pair --input cases.csv --output out.csv
for row in 1 2 3 4; do
    [ -n "$(value out.csv ez $row)" ] || fail "row $row has no result"
done
near "$(value out.csv ex 4)" -1 1e-12 # frictionless: exact by definition
for row in 5 6 7 8 9 10; do
    [ -z "$(value out.csv ez $row)" ] || fail "row $row has a result"
done
has out.csv 'angle_deg = 90: must be in [0, 90)' 'density1_kg_m3 and mass1_kg are both given' 'speed_m_s = 0: must be' \
    'none.json: cannot be read' 'partner = ""soft"": must be rigid, same or a material file' 'rotation_blocked = ""2"": must be 0 or 1'
has out.csv.meta.json '"contact_time": "s"' '"max_indentation": "m"'
absent out.csv.partial out.csv.partial.json
