#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# An interrupted batch leaves OUT.partial; --resume goes on from it and ends with the bytes of an
# undisturbed run.
. "$(dirname -- "$0")/common.sh"

# Enough work for about a second, so that the signal meets a run under way.
rows=4000
{
    echo psi,delta1,gamma
    awk -v n=$rows 'BEGIN { for (i = 1; i <= n; i++) printf "%.3f,%.4f,%.3f\n", 0.1 + 5 * i / n, 0.01 + i / n, i % 7 / 3 }'
} >cases.csv
run="pair --input cases.csv --tolerance 3e-4"

# start_and_stop: begin a run, wait until rows are in the partial file, stop it.
start_and_stop() {
    "$RESTITUTE" $run --output out.csv >out 2>err &
    process=$!
    tries=0
    while [ ! -f out.csv.partial ] || [ "$(wc -l <out.csv.partial)" -lt 2 ]; do
        tries=$((tries + 1))
        [ $tries -lt 600 ] && kill -0 $process 2>/dev/null || break
        sleep 0.05
    done
    kill -TERM $process 2>/dev/null
    wait $process
}
start_and_stop
status=$?
[ $status -eq 130 ] || fail "exit status $status after a signal, not 130"
has err 'interrupted after' 'continue with --resume'
[ -f out.csv.partial ] || fail "no partial file"
absent out.csv out.csv.meta.json
done_rows=$(($(wc -l <out.csv.partial) - 1))
[ "$done_rows" -ge 1 ] && [ "$done_rows" -lt $rows ] || fail "$done_rows rows are done"

# Without --resume the rows done are not destroyed; with other settings or cases they are not mixed.
cp out.csv.partial kept
refused 'left from an interrupted run' $run --output out.csv
refused 'tolerance of this run differs' pair --input cases.csv --tolerance 1e-3 --output out.csv --resume
sed '$s/^/1/' cases.csv >other.csv
refused 'input of this run differs' pair --input other.csv --tolerance 3e-4 --output out.csv --resume
cmp out.csv.partial kept || fail "a refused run changed the partial file"

# A line that was not written to its end, as after a power failure, is done again.
expect 0 $run --output whole.csv
{ head -20 kept; printf '1.2,0.3'; } >out.csv.partial
expect 0 $run --output out.csv --resume
cmp out.csv whole.csv || fail "the resumed run gives other rows"
absent out.csv.partial out.csv.partial.json
[ -f out.csv.meta.json ] || fail "no record beside the result"

# Rows that do not belong to the cases are noticed.
start_and_stop
[ -f out.csv.partial ] || fail "no partial file"
sed '2s/^/9/' out.csv.partial >changed && mv changed out.csv.partial
refused 'does not belong to these cases' $run --output out.csv --resume

# So are rows that no run writes: test_grid_and_figure.sh has all kinds.
head -3 kept | sed 's/ez,ex/ex,ez/' >out.csv.partial
refused 'out.csv.partial: column 4 is "ex": must be ez' $run --output out.csv --resume
head -3 kept | sed '2s/^\([^,]*,[^,]*,[^,]*\),[^,]*/\1,7/' >out.csv.partial
refused 'out.csv.partial line 2 (row 1): ez = "7": must be in [0, 1]' $run --output out.csv --resume

# --resume without a partial file simply runs.
rm -f out.csv*
head -50 cases.csv >few.csv
expect 0 pair --input few.csv --tolerance 3e-4 --output out.csv --resume
head -50 whole.csv | cmp - out.csv || fail "--resume from nothing gives other rows"

# A material that a column names belongs to the inputs: changed in between, its rows must not be
# mixed.
rm -f out.csv*
sed 's/"poisson_ratio": 0.5/"poisson_ratio": 0.4/' "$materials/polyisobutylene.json" >rubber.json
cp "$materials/polyisobutylene.csv" .
{
    echo material,speed_m_s,angle_deg
    awk 'BEGIN { for (i = 1; i <= 1500; i++) printf "rubber.json,%.4f,30\n", 0.01 + i / 1e4 }'
} >cases.csv
run="pair --input cases.csv --radius 0.005 --density 7800 --friction 0.3"
start_and_stop
[ -f out.csv.partial ] || fail "no partial file"
sed 's/"poisson_ratio": 0.4/"poisson_ratio": 0.1/' rubber.json >changed && mv changed rubber.json
refused 'material of this run differs' $run --output out.csv --resume
