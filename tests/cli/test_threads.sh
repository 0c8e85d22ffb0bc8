#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The bytes of a batch do not depend on the number of threads, failed rows and remarks included.
. "$(dirname -- "$0")/common.sh"

# The same run with 1, 2, 3 and 64 threads and by default, into a file and to standard output, CSV
# and JSON.
same_for_any_number() {
    wanted=$1
    shift
    expect "$wanted" "$@" --threads 1 --output one.csv
    mv err one.err
    for threads in '--threads 2' '--threads 3' '--threads 64' ''; do
        expect "$wanted" "$@" $threads --output many.csv
        cmp one.csv many.csv || fail "other bytes with '$threads' of: restitute $*"
        cmp one.err err || fail "other messages with '$threads' of: restitute $*"
    done
    expect "$wanted" "$@" --threads 3
    cmp one.csv out || fail "other bytes on standard output of: restitute $*"
    expect "$wanted" "$@" --threads 1 --format json
    sed '/"--threads"/,+1d' out >one.json
    expect "$wanted" "$@" --threads 3 --format json
    sed '/"--threads"/,+1d' out >many.json
    cmp one.json many.json || fail "other JSON of: restitute $*"
    grep -q '"ez"' one.json || fail "no results in the JSON"
}

# Some hundred rows of unlike cost; every seventh is refused, by the command or by the library, one
# in 20 has a remark.
{
    echo psi,delta1,gamma
    awk 'BEGIN { for (i = 1; i <= 400; i++)
        printf "%s,%.4f,%.3f\n", i % 14 == 0 ? "-1" : i % 7 == 0 ? "x" : 0.01 * i, i / 300, i % 20 ? i % 5 / 2 : 1e9 }'
} >cases.csv
same_for_any_number 1 pair --input cases.csv --max-work 1e-4
[ "$(wc -l <one.csv)" -eq 401 ] || fail "not 400 rows"
has one.csv 'psi = -1: must be in [0, 1e12]' 'psi = ""x"" is not a number' 'is above the requested tolerance'
has one.err 'cases.csv line 8 (row 7)' 'rows failed'

# Rows of several materials, each read once, by the one thread that reads.
{
    echo material,partner,speed_m_s,angle_deg
    awk -v m="$materials" 'BEGIN { for (i = 1; i <= 30; i++)
        printf "%s/%s.json,%s,%.3f,%d\n", m, i % 3 ? "steel" : "polyisobutylene",
            i % 4 ? "rigid" : m "/polyisobutylene.json", i / 100, i }'
} >cases.csv
same_for_any_number 0 pair --input cases.csv --radius 0.005 --density 7800 --friction 0.3
same_for_any_number 0 pair $scene --grid speed=0.01:1:5:log,angle=0:80:9

# An interrupted run goes on with another number of threads. Enough work for a second, so that the
# signal meets it.
{
    echo psi,delta1,gamma
    awk 'BEGIN { for (i = 1; i <= 4000; i++) printf "%.3f,%.4f,%.3f\n", i / 800, 0.01 + i / 4000, i % 7 / 3 }'
} >cases.csv
run="pair --input cases.csv --tolerance 3e-4"
"$RESTITUTE" $run --threads 2 --output cut.csv >out 2>err &
process=$!
tries=0
while [ ! -f cut.csv.partial ] || [ "$(wc -l <cut.csv.partial)" -lt 2 ]; do
    tries=$((tries + 1))
    [ $tries -lt 600 ] && kill -0 $process 2>/dev/null || break
    sleep 0.05
done
kill -TERM $process 2>/dev/null
wait $process
status=$?
[ $status -eq 130 ] || fail "exit status $status after a signal, not 130"
done_rows=$(($(wc -l <cut.csv.partial) - 1))
has err "interrupted after $done_rows of 4000 rows"
expect 0 $run --threads 1 --resume --output cut.csv
expect 0 $run --threads 3 --output whole.csv
cmp cut.csv whole.csv || fail "the resumed run gives other rows"

for bad in 0 -1 1.5 1025 many; do
    refused '--threads' pair $scene --grid speed=1:2:2,angle=0:10:2 --threads $bad
done
refused '--threads = 2: needs --input or --grid' pair --psi 1 --threads 2
