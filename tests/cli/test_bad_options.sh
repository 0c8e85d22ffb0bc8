#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Every bad value on the command line is refused with exit status 2, its name, its value and the
# allowed range.
. "$(dirname -- "$0")/common.sh"

for bad in nan -nan NaN '' ' 1' '1 ' 1.0x 0x10 1,5 1e 1e999 --psi; do
    refused '--psi' pair --psi "$bad"
done
refused '--chi = 0.2: must be in [1/3, 1000]' pair --psi 1 --chi 0.2
refused '--psi = -1: must be in [0, 1e12]' pair --psi -1
refused '--psi = inf: must be in [0, 1e12]' pair --psi inf
refused '--delta1 = -1: must be in [0, 1e12]' pair --psi 1 --delta1 -1 --gamma 1
refused '--gamma = -1: must be >= 0' pair --psi 1 --delta1 1 --gamma -1
refused '--delta2 = 0: must be in (0, 1e12]' pair --psi 1 --delta1 1 --delta2 0
refused '--gamma = 0: must be finite and > 0 beside delta2' pair --psi 1 --gamma 0 --delta2 1
refused 'two of them determine the third' pair --psi 1 --delta1 1 --gamma 1 --delta2 1
refused '--psi is missing' pair --chi 1.5
refused '--gamma is missing' pair --psi 1 --delta1 1
refused 'no impact is described' pair
refused 'given twice' pair --psi 1 --psi 2
refused 'given twice' pair --radius 1 --radius1 1
refused 'unknown option' pair --psi 1 --no-such-option
refused 'missing argument' pair --psi
refused 'unexpected argument' pair --psi 1 2
refused 'use one kind' pair --psi 1 --radius 1
refused '--delta1 is missing: --gamma needs delta1' pair --psi 1 --gamma 1

# What a number is taken for is named; a fraction is one.
expect 0 pair --psi 1 --chi 7/6 --format csv
[ "$(value out chi)" = 1.16666666666667 ] || [ "$(value out chi)" = 1.1666666666666667 ] || fail "7/6 is $(value out chi)"
refused 'a decimal comma; write 1.5' pair --psi 1,5
refused 'with the unit "mm"' pair --radius 5mm
refused 'with the unit "m/s"' pair $scene --speed 1m/s
refused 'write 0.785398163397448' pair --psi pi/4
refused 'a division by zero' pair --psi 1/0

# What was meant.
refused 'did you mean --speed?' pair $scene --speeed 1
refused 'did you mean --friction?' pair --mu 0.3
refused 'did you mean --radius, half of it?' pair --diameter 0.01
refused 'did you mean sync?' pair --psi 1 --method sinc
refused 'did you mean polyisobutylene?' pair --material polyisobutylen --radius 1 --friction 0 --speed 1
refused 'did you mean pair?' pari
refused 'did you mean csv?' pair --psi 1 --format cvs

base="--material $materials/polyisobutylene.json"
refused '--radius = 0: must be finite and > 0' pair $base --radius 0 --density 7800 --friction 0.3 --velocity 1
refused '--radius = -1: must be finite and > 0' pair $base --radius -1 --density 7800 --friction 0.3 --velocity 1
refused '--radius = inf: must be finite and > 0' pair $base --radius inf --density 7800 --friction 0.3 --velocity 1
refused '--mass1 = 0: must be finite and > 0' pair $base --radius 1 --mass1 0 --friction 0.3 --velocity 1
refused '--density = -5: must be finite and > 0' pair $base --radius 1 --density -5 --friction 0.3 --velocity 1
refused '--density and --mass1 are both given' pair $base --radius 1 --density 1 --mass1 1 --friction 0.3 --velocity 1
# Against a rigid partner the sphere is of the material: a file without density does not tell it.
refused '--density or --mass is missing' pair --material $materials/polyisobutylene.csv --radius 1 --friction 0.3 \
    --velocity 1
refused '--inertia1 = 0: must be finite and > 0' pair $scene --velocity 1 --inertia1 0
refused '--velocity = 0: must be finite and > 0' pair $scene --velocity 0
refused '--velocity = -1: must be finite and > 0' pair $scene --velocity -1
refused '--speed is missing' pair $scene
refused '--angle = 90: must be in [0, 90)' pair $scene --velocity 1 --angle 90
refused '--angle = -1: must be in [0, 90)' pair $scene --velocity 1 --angle -1
refused '--friction = -0.1: must be >= 0' pair $base --radius 1 --density 1 --velocity 1 --friction -0.1
refused '--friction is missing' pair $base --radius 1 --density 1 --velocity 1
refused '--spin = inf: must be finite' pair $scene --velocity 1 --spin inf
refused 'needs a partner sphere' pair $scene --velocity 1 --mass2 1
refused '--density2 or --mass2 is missing' pair $scene --velocity 1 --radius2 1
refused '--partner = "soft": must be rigid, same or a material file' pair $scene --velocity 1 --partner soft
refused '--material is missing' pair --radius 1 --density 1 --friction 0.3 --velocity 1
refused 'no-such-file.json: cannot be read' pair --material no-such-file.json --radius 1 --density 1 --friction 0 --velocity 1
refused 'must end in .json or .csv' pair --material /dev/null --radius 1 --density 1 --friction 0 --velocity 1

for method in cvod boundary Euler synch ''; do
    refused "--method = \"$method\": is not in this build; must be among euler, sync" pair --psi 1 --method "$method"
done
refused '--method is given twice' pair --psi 1 --method euler --method sync
refused 'time_step = 0.01: must be 0 with the method sync' pair --psi 1 --method sync --time-step 0.01
refused '--tolerance = "0": must be a number in [1e-08, 0.1]' pair --psi 1 --tolerance 0
refused '--tolerance = "nan"' pair --psi 1 --tolerance nan
refused '--elements = "3": must be a whole number in [4, 1e+06]' pair --psi 1 --elements 3
refused '--elements = "10.5"' pair --psi 1 --elements 10.5
refused '--time-step = "0"' pair --psi 1 --time-step 0
refused '--format = "yaml": must be text, csv or json' pair --psi 1 --format yaml
refused '--samples = "1": must be a whole number in [2, 1e+06]' history --psi 1 --samples 1

# Places that cannot be written: refused, and nothing appears.
mkdir folder
refused 'cannot be written' pair --psi 1 --output missing/out.csv
refused 'is not a regular file' pair --psi 1 --output folder
refused '--output is empty' pair --psi 1 --output ''
if [ "$(id -u)" -ne 0 ]; then
    chmod 500 folder
    refused 'cannot be written' pair --psi 1 --output folder/out.csv
    chmod 700 folder
fi
absent missing folder/out.csv

# Options that do not go together.
echo psi,delta1 >cases.csv
echo 1,0 >>cases.csv
grid=speed=1:2:2,angle=0:10:2
refused 'use one' pair --input cases.csv $scene --grid $grid
refused 'use one kind' pair --psi 1 --grid $grid
refused 'needs --grid' pair --psi 1 --figure a.svg
refused 'needs --output' pair --input cases.csv --resume
refused 'must be csv or json' pair --input cases.csv --format text
refused 'both give the value' pair --input cases.csv --psi 2
refused 'both give the value' pair $scene --grid $grid --velocity 1
for bad in speed=1:2:2,speed=1:2:2 speed=1:2:2,angle=0:10:2,friction=0:1:2 friction=0:inf:2 material= speed speed=1:2,angle=0:10:2 speed=0:2:2,angle=0:10:2 speed=2:1:2,angle=0:10:2 \
    speed=1:2:0,angle=0:10:2 speed=1:2:2,angle=0:90:2 speed=1:2:2,angle=0:80:3:log speed=1:2:2x,angle=0:10:2 \
    speed=1:2:2:lin,angle=0:10:2 height=1:2:2,angle=0:10:2 ''; do
    refused '--grid' pair $scene --grid "$bad"
done
refused 'must end in .svg, .png or .pdf' pair $scene --grid $grid --figure a.gif
mkdir none
echo 'raise ImportError' >none/matplotlib.py
PYTHONPATH=$work/none "$RESTITUTE" pair $scene --grid $grid --figure a.svg --output a.csv >out 2>err
[ $? -eq 2 ] || fail "a missing matplotlib is not refused"
has err 'matplotlib'
absent a.gif a.svg a.csv a.csv.partial a.csv.partial.json a.csv.meta.json

# Inputs are never replaced by outputs, by whatever name.
cp "$materials/steel.json" steel.json
printf 'psi,delta1,gamma\n1,0.1,1\n' >cases.csv
cp cases.csv kept.csv
ln -s cases.csv link.csv
refused 'is an input of this run' pair --input cases.csv --output ./cases.csv
refused 'is an input of this run' pair --input cases.csv --output link.csv
refused 'is an input of this run' pair --material steel.json --radius 1 --density 1 --friction 0 --velocity 1 \
    --output steel.json
cmp cases.csv kept.csv && cmp steel.json "$materials/steel.json" || fail "an input was changed"
refused 'impacts: must be at most 1000000' pair --material steel.json --radius 1 --density 1 --friction 0 \
    --grid speed=1:2:10000,angle=0:80:10000
