#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Material files: every shipped one works and names its source; every wrong one is refused by line,
# value and range.
. "$(dirname -- "$0")/common.sh"

echo material >all.csv
for file in "$materials"/*.json; do
    has "$file" '"source"' '"name"'
    echo "$file" >>all.csv
done
expect 0 pair --input all.csv --output all-results.csv --radius 0.005 --density 1000 --partner same --friction 0.2 \
    --speed 0.1 --angle 30

# material JSON...: the file m.json of these lines; pair_of_it runs it.
material() { printf '%s\n' "$@" >m.json; }
rest='--radius 0.005 --density 1000 --friction 0.2 --velocity 1'
bad() { refused "$1" pair --material m.json $rest; }
good() { expect 0 pair --material m.json $rest --format csv; }

head='"name": "x", "poisson_ratio": 0.5'
material "{$head, \"model\": \"elastic\", \"modulus_pa\": 1e6}" && good
material "{$head, \"model\": \"standard_solid\", \"modulus1_pa\": 1e6, \"modulus2_pa\": 2e6, \"viscosity_pa_s\": 50}" && good
standard=$(value out ez)
material "{$head, \"model\": \"prony\", \"equilibrium_modulus_pa\": 1e6, \"terms\": [{\"tau_s\": 25e-6, \"modulus_pa\": 2e6}]}"
good
near "$(value out ez)" "$standard" 1e-12 # the same solid said differently: equal but for rounding in 50/2e6
material "{$head, \"model\": \"kelvin_voigt\", \"modulus1_pa\": 1e6, \"viscosity_pa_s\": 50}" && good
material "{$head, \"model\": \"maxwell\", \"modulus_pa\": 1e6, \"viscosity_pa_s\": 1000}" && good
mkdir sub
printf 'tau_s,G_Pa\n1e-3,1e6\n' >sub/p.csv
printf '{"name": "x", "poisson_ratio": 0.5, "model": "prony", "prony_csv": "p.csv", "parallel_viscosity_pa_s": 1}' >sub/m.json
expect 0 pair --material sub/m.json $rest

material '{' "$head," '"model": "elastic",' '"modulus_pa": -1e6}' && bad 'm.json line 4: modulus_pa = -1000000: must be finite and > 0'
material '{"name": "x",' '"poisson_ratio": 0.6,' '"model": "elastic", "modulus_pa": 1}' && bad 'line 2: poisson_ratio = 0.6: must be in [0, 0.5]'
material "{$head," '"model": "jelly"}' && bad 'line 2: model = "jelly": must be elastic'
material "{$head, \"model\": \"elastic\"}" && bad 'no key "modulus_pa"'
material "{$head, \"model\": \"elastic\", \"modulus_pa\": \"soft\"}" && bad '"modulus_pa" must be a number'
material "{$head, \"model\": \"elastic\", \"modulus_pa\": 1," '"colour": 3}' && bad 'line 2: unknown key "colour" for model elastic: must be among name, source, model, poisson_ratio, density_kg_m3, modulus_pa'
material "{$head, \"model\": \"elastic\", \"modulus_pa\": 1, \"viscosity_pa_s\": 1}" && bad 'unknown key "viscosity_pa_s" for model elastic'
material "{$head, \"name\": \"y\", \"model\": \"elastic\", \"modulus_pa\": 1}" && bad 'line 1'
material '{"name": "x"' '"model": "elastic"}' && bad 'm.json line 2 column'
material '[]' && bad 'must be one JSON object'
material '' && bad 'not JSON'
material '{"name": 5, "poisson_ratio": 0.5, "model": "elastic", "modulus_pa": 1}' && bad '"name" must be text'
material "{$head, \"model\": \"elastic\", \"modulus_pa\": 1, \"density_kg_m3\": 0}" && bad 'density_kg_m3 = 0: must be finite and > 0'
material "{$head, \"model\": \"prony\"}" && bad 'needs either "terms" or "prony_csv"'
material "{$head, \"model\": \"prony\", \"terms\": []}" && bad '"terms" must be an array of at least one'
material "{$head, \"model\": \"prony\", \"terms\": [" '{"tau_s": 1, "modulus_pa": 1},' '{"tau_s": 1, "modulus_pa": 2}]}' &&
    bad 'line 3: tau_s = 1 stands in line 2 too'
material "{$head, \"model\": \"prony\", \"terms\": [" '{"tau_s": 0, "modulus_pa": 1}]}' && bad 'line 2: tau_s = 0: must be finite and > 0'
material "{$head, \"model\": \"prony\", \"terms\": [" '{"tau_s": 1}]}' && bad 'line 2: no key "modulus_pa"'
material "{$head, \"model\": \"prony\", \"prony_csv\": \"none.csv\"}" && bad 'none.csv: cannot be read'

csv() { printf "$1" >p.csv; refused "$2" pair --material p.csv $rest; }
csv '' 'is empty'
csv 'tau_s,G_Pa\n' 'no rows'
csv 'tau_s,G_Pa\n1,2\n3\n' 'p.csv line 3: 1 cells, but the header has 2 columns'
csv 'tau_s,G_Pa\n1,2\n1,3\n' 'p.csv line 3: tau_s = 1 stands in line 2 too'
csv '# a comment\ntau_s,G_Pa\n1,-2\n' 'p.csv line 3: G_Pa = -2: must be finite and > 0'
csv 'tau_s,G_Pa\nnan,2\n' 'p.csv line 2: tau_s = "nan"'
csv 'tau_s,E_Pa\n1,2\n' 'unknown column E_Pa'
csv 'tau_s\n1\n' 'no column G_Pa'
csv 'tau_s;G_Pa\n1;2\n' 'separated by semicolons: must be by commas'
csv 'tau_s\tG_Pa\n1\t2\n' 'separated by tabs: must be by commas'
csv 'tau_s,tau_s\n1,2\n' 'appears twice'
csv 'tau_s,G_Pa\n1,"2\n' 'never closed'
csv 'tau_s,G_Pa\n1,2\000\n' 'NUL'

# Line ends and comments as other programs write them.
printf '\357\273\277# x\r\ntau_s,G_Pa\r\n1e-3, 1e6\r\n' >p.csv
expect 0 pair --material p.csv $rest
printf '\357\273\277{"name": "x", "poisson_ratio": 0.5, "model": "elastic",\r\n"modulus_pa": 1e6}' >m.json && good

# By name, listed and shown; what is no name is refused with the names.
expect 0 materials
has out polyisobutylene steel 'EN 572-1' '1e-11 to 2.4e+07' '25 (-70 to 50)'
expect 0 materials show polyisobutylene
has out '920 kg/m^3' tau_s,G_Pa
expect 0 materials silicone
has out 'window            1.6e-07 to 1.5 s' 'temperature       not given'
cp "$materials/silicone.json" own.json
expect 0 materials own.json --figure own.svg
has own.svg 'angular frequency (rad/s)' measured
refused 'own.svg' materials own.svg
refused 'needs the name of a material' materials --figure own.svg
refused 'no shift of times with temperature is known for Structural steel' materials steel --temperature 40
expect 0 pair --material steel $rest --format csv
refused 'did you mean steel?' pair --material steal $rest

# Outside of the window of times: one impact in words, many counted, in the record too.
good_head="{$head, \"model\": \"elastic\", \"modulus_pa\": 1e6"
material "$good_head, \"window_s\": [1, 2]}" && expect 0 pair --material m.json --radius 0.001 --density 1000 \
    --friction 0.2 --speed 0.01
has out '(measured from 1 to 2 s)' 'passed: the contact time is outside the window of times'
printf 'speed_m_s\n0.01\n0.02\n' >rows.csv
expect 0 pair --material m.json --radius 0.001 --density 1000 --friction 0.2 --input rows.csv --output out.csv
has err '2 of 2 rows are flagged UNMEASURED: contact time outside the window in which'
has out.csv.meta.json '"UNMEASURED": 2'
has out.csv UNMEASURED
material "$good_head," '"window_s": [2, 1]}' && bad 'line 2: window_s = [2, 1]: must be finite, > 0 and ascending'
