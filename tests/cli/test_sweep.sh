#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# `restitute paper`, formerly `restitute sweep`: figures by name with their checks, the solids of
# numbers and shifted times that they are drawn with.
. "$(dirname -- "$0")/common.sh"
have_module matplotlib || exit 77
have python3 && python=python3 || python=true

# A figure: all its files, the scatter below the tolerance, no check failed; a rerun writes the same
# bytes.
mkdir two
for figure in fig4 fig5 fig6 fig11 maxwell tangent friction; do
    expect 0 paper $figure --output one
    has out 'scatter of e_z' 'scatter of e_x' ': ok'
    ! grep -q FAILED out || fail "a check of $figure failed: $(grep FAILED out)"
    for ending in .csv .csv.meta.json .svg .pdf; do
        [ -s one/$figure$ending ] || fail "no $figure$ending"
    done
    "$python" -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' one/$figure.svg || fail "not XML"
    [ "$(wc -c <one/$figure.svg)" -lt 200000 ] || fail "$figure.svg is large"
done
[ "$(head -c 5 one/fig4.pdf)" = "%PDF-" ] || fail "fig4.pdf is no PDF"
[ "$(wc -l <one/fig4.csv)" -eq 121 ] || fail "not 120 impacts"
expect 0 sweep fig4 --output two
for ending in .csv .svg .pdf; do cmp one/fig4$ending two/fig4$ending || fail "a rerun writes other bytes"; done
expect 0 sweep fig4 --output two --seed 1
has two/fig4.csv.meta.json '"seed": 1'
cmp -s one/fig4.csv two/fig4.csv && fail "another seed draws the same impacts"

# The method and the tolerance are those of the options: Euler with 1e-2 scatters more than 1e-5 and
# less than 1e-2.
expect 0 sweep fig4 --output two --method euler --tolerance 1e-2
awk '/scatter of e_z/ { exit !($7 + 0 > 1e-5) }' out || fail "the method is not that of the option: $(cat out)"

# Dimensionless numbers of a drawn impact, formed here again from its SI columns (22)-(24).
"$python" - one/fig6.csv <<'END' || fail "an impact has other numbers than it says"
import csv, math, sys
for r in csv.DictReader(open(sys.argv[1])):
    f = lambda name: float(r[name] or "nan")
    R, m, J, nu, v = f("radius_m"), f("mass_kg"), f("inertia_kg_m2"), f("poisson_ratio"), f("speed_m_s")
    B, g, eta, a = 1/m + R*R/J, f("modulus1_pa"), f("viscosity_pa_s"), math.radians(f("angle_deg"))
    V = v*math.sin(a) + R*f("spin_rad_s")
    if r["radius2_m"] != "inf":
        R2, m2 = f("radius2_m"), f("mass2_kg")
        B += 1/m2 + R2*R2/f("inertia2_kg_m2")
        R, m = 1/(1/R + 1/R2), 1/(1/m + 1/m2)
    if r["partner"] == "same": g, eta = g/2, eta/2
    vz = v*math.cos(a)
    a_el = (15*m*vz*vz*R*R*(1 - nu)/(32*g))**0.2
    got = ((1 - nu)/(2 - nu)*m*B, (2 - 2*nu)/(2 - nu)*V/(f("friction")*vz), eta*math.sqrt(a_el/(g*m*(1 - nu))),
           f("modulus1_pa")/f("modulus2_pa") if r["modulus2_pa"] else 0)
    for name, value in zip(("chi", "psi", "delta1", "gamma"), got):
        assert abs(value - f(name)) <= 1e-9*(abs(value) + 1e-9), (name, value, r[name])
END
has one/fig4.csv.meta.json '"seed": 2017'

# Without rows no figure is lost, and what is wrong is said before anything is drawn.
refused 'must be fig4 to fig11' sweep fig3
touch file
refused 'must be a folder' sweep fig4 --output file
refused 'must be a folder' sweep fig4 --output none/below
absent none
refused '--material is missing' sweep temperature
refused '--psi: unknown option' sweep fig4 --psi 1
refused '--shard: unknown option' sweep fig4 --shard 1/2
refused 'must be at least 1e-6' sweep fig4 --tolerance 1e-7
refused 'is missing' sweep

# Seeds that put Maxwell impacts close to the limit of rebound.
for seed in 3 6 13; do expect 0 sweep tangent --seed $seed --output one; done

# A figure does not write over the material that it reads.
mkdir own
cp "$materials/polyisobutylene.json" own/m.json
for ending in .pdf .svg .csv; do
    cp "$materials/polyisobutylene.csv" own/temperature$ending
    sed -i 's/"prony_csv": ".*"/"prony_csv": "temperature'$ending'"/' own/m.json
    refused 'would be overwritten' sweep temperature --material own/m.json --output own
    cmp -s "$materials/polyisobutylene.csv" own/temperature$ending || fail "an input is lost"
done
refused 'none.json' sweep all --material none.json --output one
refused 'only with the figure temperature' sweep fig4 --material own/m.json --output one

# A solid of numbers is the same as its file; a shift of times as a file with other times.
cat >solid.json <<'END'
{"name": "s", "poisson_ratio": 0.4, "model": "standard_solid", "modulus1_pa": 1e6, "modulus2_pa": 3e6, "viscosity_pa_s": 300}
END
sed 's/"viscosity_pa_s": 300/"viscosity_pa_s": 3000/' solid.json >slow.json
body="--radius 0.005 --density 7800 --friction 0.3 --velocity 1 --angle 30 --format csv --method sync"
expect 0 pair --material solid.json $body
file=$(value out ez),$(value out ex)
expect 0 pair --modulus1 1e6 --modulus2 3e6 --viscosity 300 --poisson 0.4 $body
[ "$(value out ez),$(value out ex)" = "$file" ] || fail "numbers and file differ"
expect 0 pair --material slow.json $body
slow=$(value out ez)
expect 0 pair --material solid.json --time-shift 10 $body
near "$(value out ez)" "$slow" 1e-7
[ "$slow" != "${file%,*}" ] || fail "the shift changes nothing"
expect 0 pair --modulus1 1e6 --viscosity 500 --time-shift 4 $body
shifted=$(value out ez)
expect 0 pair --modulus1 1e6 --viscosity 2000 $body
[ "$(value out ez)" = "$shifted" ] || fail "a shift of a Kelvin-Voigt solid is not one of its viscosity"
refused 'are both given' pair --material solid.json --modulus1 1e6 $body
refused '--viscosity is missing' pair --modulus1 1e6 --modulus2 1e6 $body
refused '--modulus2 is missing' pair --modulus1 0 --viscosity 300 $body
refused 'must be a file without --time-shift' pair --material solid.json --partner slow.json --time-shift 2 $body
refused 'must be in [0, 0.5]' pair --modulus1 1e6 --poisson 0.6 $body

# An interrupted figure is continued, and is the same as one that was not.
slow="sweep fig5 --method euler --tolerance 1e-3 --threads 1 --output two"
expect 0 sweep fig5 --method euler --tolerance 1e-3 --output one
"$RESTITUTE" $slow >out 2>err &
process=$!
tries=0
while [ ! -f two/fig5.csv.partial ] || [ "$(wc -l <two/fig5.csv.partial)" -lt 2 ]; do
    tries=$((tries + 1))
    [ $tries -lt 600 ] && kill -0 $process 2>/dev/null || break
    sleep 0.05
done
kill -TERM $process 2>/dev/null
wait $process
[ $? -eq 130 ] || fail "the figure was not interrupted"
has err 'continue with --resume'
absent two/fig5.csv two/fig5.svg
refused 'left from an interrupted run' $slow
expect 0 $slow --resume
cmp one/fig5.csv two/fig5.csv && cmp one/fig5.svg two/fig5.svg || fail "a resumed figure is another"
# While it is drawn, too.
"$RESTITUTE" sweep fig10 --output two >out 2>err &
process=$!
tries=0
while [ ! -f two/fig10.csv.meta.json ] && [ $tries -lt 600 ]; do
    tries=$((tries + 1))
    sleep 0.05
done
kill -TERM $process 2>/dev/null
wait $process
[ $? -eq 130 ] || fail "the drawing was not interrupted"
has err 'interrupted after 64 of 64 rows, all in two/fig10.csv'
absent two/fig10.svg
refused '--seed: unknown option' sweep --grid psi=1:2:3 --seed 1
refused '--contours: unknown option' sweep fig4 --contours
