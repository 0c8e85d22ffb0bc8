#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# restitute fit: constants from a drop test, the material file it writes, DMA curves, remarks and
# exit statuses, refusals.
. "$(dirname -- "$0")/common.sh"

"$RESTITUTE" fit --help >out 2>err
if grep -q 'no component fit' err; then
    refused 'GSL' fit
    echo "skipped: no component fit in this build"
    exit 0
fi
expect 0 fit --help
for option in $(sed -n 's/^  *--\([a-z0-9-]*\).*/\1/p' out); do
    sed 's/\\-/-/g' "$SOURCE_DIR/docs/restitute.1" | grep -Eq "(^\.It Fl|Fl) -$option( |\$)" ||
        fail "the manual page lacks --$option"
done
expect 0 --version
has out 'GSL' 'version 3'

# A drop test made by the command itself: what goes in comes out, as a file that pair reads.
ball="--radius 0.005 --mass 0.004"
solid="--modulus1 1e6 --modulus2 3e6 --viscosity 300"
expect 0 pair $solid $ball --friction 0 --grid speed=0.001:1:12:log --method sync --tolerance 1e-7 --output made.csv
awk -F, 'NR == 1 { print "speed_m_s,ez,contact_time_s" } NR > 1 { print $1 "," $2 "," $4 }' made.csv >drop.csv
head -n 1 made.csv | grep -q '^speed_m_s,ez,ex,contact_time,' || fail "columns of pair have changed"
expect 0 fit --input drop.csv $ball --output solid.json
near "$(sed -n 's/.*"modulus2_pa": \([0-9.]*\).*/\1/p' solid.json)" 3e6 300
has solid.json.meta.json '"fit"' '"name": "modulus2_pa"' '"low"' '"correlation"' '"remarks"' 'drop.csv'
expect 0 pair --material solid.json $ball --friction 0 --velocity 0.1 --method sync --tolerance 1e-6 --format csv
ez=$(value out ez)
expect 0 pair $solid $ball --friction 0 --velocity 0.1 --method sync --tolerance 1e-6 --format csv
near "$ez" "$(value out ez)" 1e-5

# The same command writes the same bytes.
cp solid.json first.json
expect 0 fit --input drop.csv $ball --output solid.json --threads 2
cmp first.json solid.json || fail "two runs give different files"

# A spring behind the dashpot that may as well be rigid has a lower bound alone.
printf '%s\n' 0.589 0.612 0.576 0.546 0.521 0.492 0.572 0.446 0.494 0.413 0.394 0.401 0.369 0.388 0.297 0.370 0.311 0.275 0.273 0.275 |
    awk 'BEGIN { print "speed_m_s,ez" } { print 0.01 * 1000 ^ ((NR - 1) / 19) "," $1 }' >noisy.csv
expect 1 fit --input noisy.csv $ball --known modulus1=1e6
grep -q '^ *modulus2_pa .* above [0-9.e+]*$' out || fail "no lower bound: $(cat out)"
has err 'the data give no upper bound of modulus2_pa'

# A signal is obeyed within a piece: here behind the starts, in the precise fit of all rows, half a
# minute and more.
awk 'BEGIN { print "speed_m_s,angle_deg,ez,ex"; for (i = 0; i < 6000; i++)
    print 0.01 * 1000 ^ (i / 6000) "," 5 + i % 80 "," 0.9 - 0.4 * i / 6000 ",0.1" }' >oblique.csv
"$RESTITUTE" fit --input oblique.csv $ball --friction 0.3 --starts 1 >out 2>err </dev/null &
process=$!
sleep 2
kill -TERM $process
tries=0
while kill -0 $process 2>/dev/null; do
    tries=$((tries + 1))
    [ $tries -lt 200 ] || { kill -KILL $process; fail "still there 10 s behind the signal"; }
    sleep 0.05
done
wait $process
status=$?
[ $status -eq 130 ] || fail "exit status $status behind a signal, not 130"

# The report comes last: where a file has no room, there is neither.
(ulimit -f 0; "$RESTITUTE" fit --input drop.csv $ball --output full.json 2>&1 </dev/null) | cat >said
[ "$(cat said)" = 'restitute: full.json: cannot be written: File too large' ] || fail "no room: $(cat said)"
absent full.json full.json.meta.json

# e alone has no scale: remarks and exit status 1; a known constant sets it.
cut -d, -f1,2 drop.csv >only.csv
expect 1 fit --input only.csv $ball
has out 'not determined'
has err 'remark: ' 'measure a contact time'
expect 1 fit --input only.csv $ball --output open.json
has out 'modulus assumed'
has open.json ': modulus assumed; '
grep -Eq 'window_s|measured' open.json && fail "an assumed modulus is called measured: $(cat open.json)"
expect 0 fit --input only.csv $ball --known modulus1=1e6
has out 'known'
expect 1 fit --input drop.csv $ball --known modulus1=1e6,modulus2=3e6,viscosity=400
has err 'the same model with other constants fits better'
expect 1 fit --input drop.csv $ball --model kelvin_voigt
has err 'the data do not follow the model'

# Heights for speed and ez; two partners; a fixed series.
printf 'drop_height_m,rebound_height_m,partner\n0.1,0.05,rigid\n0.2,0.09,rigid\n0.3,0.13,%s\n0.5,0.2,%s\n' \
    "$materials/steel.json" "$materials/steel.json" >heights.csv
# one speed alone does not tell two models of as many constants apart
printf 'speed_m_s,ez,contact_time_s\n1,0.5,.001\n1,0.51,.00101\n1,0.49,.00099\n1,.5,.001\n' >alone.csv
expect 1 fit --input alone.csv $ball --model kelvin_voigt
has err 'do not tell this model from a Maxwell body'
expect 1 fit --input alone.csv $ball --model maxwell
has err 'do not tell this model from a Kelvin-Voigt solid'
expect 0 fit --input heights.csv $ball --model kelvin_voigt --known modulus1=1e6
expect 1 fit --input drop.csv $ball --model prony --terms 1e-5,1e-4,1e-3,1e-2,1e-1
has err 'the data do not'

if have_module matplotlib; then
    expect 0 fit --input drop.csv $ball --figure fit.svg
    has fit.svg 'residuals'
fi

# Only ratios of weights count.
for weight in 1 1e12; do
    awk -F, -v w=$weight '{ print $1 "," $2 + (NR > 1) * 0.01 * (NR % 3 - 1) "," (NR > 1 ? w : "weight") }' only.csv |
        sed '1s/.*/speed_m_s,ez,weight/' >weighted.csv
    expect 0 fit --input weighted.csv $ball --known modulus1=1e6,modulus2=3e6 --output weighted.json
    sed -n '/viscosity/s/ *$//p' out >weight.$weight
done
near "$(awk '{ print $2 }' weight.1)" "$(awk '{ print $2 }' weight.1e12)" 0.05
near "$(awk '{ print $3 }' weight.1)" "$(awk '{ print $3 }' weight.1e12)" 0.05

# A DMA curve of one term, G' = G x^2/(1+x^2), G'' = G x/(1+x^2).
awk 'BEGIN { print "frequency_Hz,storage_Pa,loss_Pa"
             for (i = -12; i <= 12; i++) { f = exp(i / 2); x = 6.283185307 * f * 0.01
                 printf "%.8g,%.8g,%.8g\n", f, 1e6 * x * x / (1 + x * x), 1e6 * x / (1 + x * x) } }' >curve.csv
expect 0 fit --dma curve.csv --output series.json
has out 'Prony series of 1 terms'
near "$(sed -n 's/.*"modulus_pa": \([0-9.]*\).*/\1/p' series.json)" 1e6 10
sed -n '1p;10p;10p;10p' curve.csv >single.csv
expect 1 fit --dma single.csv
has err 'rows within a factor of 1 in frequency do not determine relaxation times'
expect 0 pair --material series.json $ball --friction 0.3 --velocity 1 --angle 30

# Refusals name the row and the value; nothing is written.
bad() { # TEXT HEADER ROW...
    text=$1
    shift
    printf '%s\n' "$@" >bad.csv
    refused "$text" fit --input bad.csv $ball --output never.json
    absent never.json never.json.meta.json
}
bad 'bad.csv line 3 (row 2): ez = 1.2: must be in [0, 1]' speed_m_s,ez 1,0.5 2,1.2 3,0.4
bad 'bad.csv line 2 (row 1): speed_m_s = -1: must be finite and > 0' speed_m_s,ez -1,0.5 2,0.4 3,0.4
bad 'bad.csv line 2 (row 1): ez = "abc" is not a number' speed_m_s,ez 1,abc 2,0.4 3,0.4
bad 'column ez (or' speed_m_s 1 2 3
bad 'column speed_m_s (or drop_height_m) is missing' ez 0.4 0.5 0.6
bad 'unknown column "speed"; known are' speed,ez 1,0.4 2,0.4 3,0.4
bad '2 measured values are fewer than the 3 constants' speed_m_s,ez 1,0.4 2,0.4
bad 'contact times or known constants call for a modulus' speed_m_s,ez,contact_time_s 1,0.5,1e-90 2,0.4,1e-90
bad 'row 2): ez, ex or contact_time must be measured' speed_m_s,ez 1,0.4 2, 3,0.4
bad 'row 1): rebound_height_m = 2' drop_height_m,rebound_height_m 1,2 2,1 2,1
bad 'row 1): column radius1_m and option' speed_m_s,ez,radius1_m 1,0.4,1 2,0.4,1 3,0.3,1
printf 'frequency_Hz,storage_Pa\n1,2\n' >bad.csv
refused 'column loss_Pa is missing' fit --dma bad.csv
printf 'frequency_Hz,storage_Pa,loss_Pa\n1,2,3\n2,3,-4\n3,4,5\n' >bad.csv
refused 'line 3 (row 2): loss_Pa = -4' fit --dma bad.csv
refused 'give --input' fit
refused '--model: not with --dma' fit --dma curve.csv --model elastic
refused '--radius: not with --dma' fit --dma curve.csv --radius 1
refused 'column speed_m_s is one of --input: give --input drop.csv' fit --dma drop.csv
refused 'column frequency_Hz is one of --dma: give --dma curve.csv' fit --input curve.csv $ball
refused 'give --density or --mass of the sphere' fit --input drop.csv --radius 0.005
refused 'give --radius of the sphere' fit --input drop.csv --mass 0.004
refused '--known: "E" is no constant of this model; did you mean youngs_modulus?' fit --input drop.csv $ball --known E=1e6
refused '--noise: need --dma' fit --input drop.csv --noise 0.1
bad 'row 2): sigma_ez is missing' speed_m_s,ez,sigma_ez 1,0.5,0.01 2,0.4, 3,0.3,0.01
bad 'line 3 (row 2): contact_time_s = -1: must be > 0' speed_m_s,ez,contact_time_s 1,0.5,1 2,0.4,-1 3,0.4,1
bad 'line 3 (row 2): weight = 0: must be > 0' speed_m_s,ez,weight 1,0.5,1 2,0.4,0 3,0.4,1
bad 'columns weight and sigma_' speed_m_s,ez,sigma_ez,weight 1,0.5,0.01,1
refused '--model = "rubber"' fit --input drop.csv --model rubber
refused 'must end in .json' fit --input drop.csv $ball --output solid.txt
cp drop.csv clash.json
refused 'is an input of this run' fit --input clash.json $ball --output clash.json
cmp drop.csv clash.json || fail "the input was overwritten"
refused '--known: "modulus7"' fit --input drop.csv $ball --known modulus7=1
refused '--known: modulus1 is given twice' fit --input drop.csv $ball --known modulus1=1,modulus1=2
refused 'drop.csv has no column temperature_C' fit --input drop.csv $ball --wlf 17:51
refused 'curve.csv has no column temperature_C' fit --dma curve.csv --reference-temperature 20
awk -F, '{ print $0 "," (NR == 1 ? "temperature_C" : NR < 9 ? 20 : -40) }' curve.csv >cold.csv
refused 'cold.csv line 9 (row 8): temperature_C = -40: must be above the pole' fit --dma cold.csv --wlf 17:51
refused '--terms and --model prony' fit --input drop.csv $ball --model prony
