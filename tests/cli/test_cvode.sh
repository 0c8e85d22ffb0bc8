#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The method cvode and the event log by the command; in a build without the component both are
# refused by its name.
. "$(dirname -- "$0")/common.sh"

numbers="--chi 1.1667 --psi 2 --delta1 1 --gamma 1"
if ! "$RESTITUTE" pair $numbers --method cvode >/dev/null 2>&1; then
    refused 'component cvode is not in this build' pair $numbers --method cvode
    refused 'component cvode' history $numbers --events e.csv
    echo "skipped: no component cvode in this build"
    exit 0
fi

expect 0 pair $numbers --method sync --tolerance 1e-5 --format csv
cp out sync.csv
for method in cvode cvode-bdf cvode-adams; do
    expect 0 pair $numbers --method $method --tolerance 1e-5 --format csv
    has out $method
    near "$(value out ez)" "$(value sync.csv ez)" 2e-5 # the tolerances of both
    near "$(value out ex)" "$(value sync.csv ex)" 2e-5
done
expect 0 pair $scene --velocity 1 --angle 30 --method cvode
has out 'cvode, tolerance'

expect 0 history $numbers --events e.csv --output h.csv
[ "$(head -1 e.csv)" = "time_T,event,position_a_el,indentation_d0,normal_velocity_v0,tangential_velocity_V0,elements" ] ||
    fail "the header is $(head -1 e.csv)"
for event in entry exit gross-slip-end stick-to-slip turn contact-end; do
    grep -q ",$event," e.csv || fail "no $event in the log"
done
[ "$(grep -c ,gross-slip-end, e.csv)" = 1 ] || fail "gross slip ends more than once"
awk -F, 'NR > 2 && $1 < before { exit 1 } NR > 1 { before = $1 }' e.csv || fail "events are not in order"
# docs/theory.md, section 4; the tolerance is 1e-3
near "$(awk -F, '$2 == "gross-slip-end" { print $5 }' e.csv)" "$(awk 'BEGIN { print (2 * 1.1667 - 2) / (2 * 1.1667 - 1) }')" 1e-3
expect 0 history $scene --velocity 1 --angle 30 --events e.csv --output h.csv
has e.csv time_s position_m normal_velocity_m_s
has h.csv.meta.json '"cvode"' '"contact_radius_m": "m"'
has e.csv.meta.json '"cvode"' '"position_m": "m"' '"tangential_velocity_m_s": "m/s"'
expect 0 history $numbers --events - --output other.csv # the log on standard output, without a record
has out gross-slip-end
absent ./-.meta.json

# As many rows as are wanted, though there are fewer steps.
expect 0 history $numbers --method cvode --samples 500
[ "$(wc -l <out)" = 501 ] || fail "$(wc -l <out) lines"

# Places that are one are refused, by whatever name, before anything is written.
refused '--events and --output are the same file' history $numbers --events x.csv --output x.csv
refused '--events and --output are the same file' history $numbers --events ./x.csv --output "$work/x.csv"
refused '--figure and --output are the same file' history $numbers --figure x.svg --output x.svg
refused 'standard output: at most one' history $numbers --events -
refused 'standard output: at most one' history $numbers --events - --output -
absent x.csv x.svg

# What a file holds is said by its name, in capitals or not.
for name in e.txt e.h5x e .csvx; do
    refused 'must end in .csv, .h5 or .hdf5' history $numbers --events $name --output h.csv
    absent $name
done
expect 0 history $numbers --events capitals.CSV --output h.csv
has capitals.CSV gross-slip-end

if ! "$RESTITUTE" history $numbers --events e.h5 --output h.csv 2>err; then
    has err 'needs h5py'
    absent e.h5
elif have_h5py; then
    events() { # FILE: what happens in it, and the unit of the time
        "$python" -c 'import h5py, sys; e = h5py.File(sys.argv[1])["events"]
print(*e["event"], e["time_T"].attrs["unit"])' "$1"
    }
    events e.h5 >dump
    has dump gross-slip-end contact-end " b'T'"
    has e.h5.meta.json '"cvode"'
    for name in capitals.HDF5 capitals.H5; do
        expect 0 history $numbers --events $name --output h.csv
        events $name >dump
        has dump gross-slip-end
    done
fi

# What max_work allows is given with a remark, and nothing if that is nothing.
expect 0 pair --psi 0.5 --chi 8 --tolerance 1e-6 --method cvode --max-work 0.05 --format csv
has out 'the estimated error is above the requested tolerance'
refused 'max_work = 1e-05:' pair --psi 0.5 --chi 8 --tolerance 1e-6 --method cvode --max-work 1e-5

refused 'the method sync logs none' history $numbers --method sync --events e.csv
refused 'no/such' history $numbers --events no/such/e.csv
refused 'time_step' pair $numbers --method cvode --time-step 0.1
refused 'unknown option' pair $numbers --events e.csv
