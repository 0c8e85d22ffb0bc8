#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# No room: work stops at the first write that fails, the message tells the true reason, what was
# there stays, nothing else is left, and rows that are done are kept. A limit on the size of files
# (ulimit -f, blocks of 512 bytes or 1 kB) stands for a full disk.
. "$(dirname -- "$0")/common.sh"

# narrow BLOCKS STATUS ARGUMENT...: run the command where files cannot grow beyond that; what it
# says goes through a pipe.
narrow() {
    blocks=$1 wanted=$2
    shift 2
    (ulimit -f "$blocks"; "$RESTITUTE" "$@" 2>&1 </dev/null; echo "status $?") | cat >said
    sed '/^status /d' said >err
    status=$(sed -n 's/^status //p' said)
    [ "$status" -eq "$wanted" ] || fail "exit status $status, not $wanted, without room: restitute $*"
}
no_temporary() { [ -z "$(find . -name '*.tmp' -o -name '*.XXXXXX')" ] || fail "left: $(find . -name '*.tmp')"; }

# The last row fails: its message tells whether it was solved.
awk 'BEGIN { print "psi,delta1,gamma"; for (i = 1; i < 2000; i++) printf "%.4f,0.5,1\n", i / 1e3; print "-1,0.5,1" }' >cases.csv
run="pair --input cases.csv --method sync --threads 1"
"$RESTITUTE" $run --output whole.csv 2>err
[ $? -eq 1 ] || fail "the last row does not fail"
has err 'row 2000'
narrow 40 2 $run --output out.csv
has err 'out.csv.partial: cannot be written: File too large; continue with --resume'
grep -q 'row 2000' err && fail "goes on solving after the disk is full"
[ "$(wc -l <err)" -eq 1 ] || fail "more than one message"
absent out.csv out.csv.meta.json
[ -s out.csv.partial ] || fail "the rows that are done are lost"
no_temporary
expect 1 $run --output out.csv --resume
cmp out.csv whole.csv || fail "continued with room: other rows"
absent out.csv.partial out.csv.partial.json

# There is room for a part of the first rows.
narrow 4 2 pair --input cases.csv --method sync --threads 100 --output first.csv
has err 'File too large; continue with --resume'
expect 1 $run --output first.csv --resume
cmp first.csv whole.csv || fail "continued from a part of the first rows: other rows"

# Nothing at all can be written; the old result and its record stay.
echo old >out.csv
echo old >out.csv.meta.json
for command in "pair --input cases.csv" "pair --psi 1" "pair --psi 1 --format csv" "pair --psi 1 --format json" "history --psi 1" \
    "pair --input cases.csv --format json"; do
    narrow 0 2 $command --output out.csv
    has err 'cannot be written: File too large'
    [ "$(cat out.csv out.csv.meta.json)" = "old
old" ] || fail "the old result is lost: $command"
    absent out.csv.partial out.csv.partial.json
    no_temporary
done

# The record has room and the result has none: both stay as they were.
narrow 4 2 history --psi 1 --samples 400 --output out.csv
has err 'out.csv: cannot be written: File too large'
[ "$(cat out.csv out.csv.meta.json)" = "old
old" ] || fail "a record without its result"
no_temporary

# Full standard output.
if [ -c /dev/full ]; then
    for command in "pair --psi 1" "pair --psi 1 --format csv" "pair --psi 1 --format json" "pair --input cases.csv" \
        "pair --input cases.csv --format json" "history --psi 1" --version --help "pair --help"; do
        "$RESTITUTE" $command >/dev/full 2>err
        [ $? -eq 2 ] || fail "a full standard output is not noticed: restitute $command"
        has err 'restitute: standard output cannot be written: No space left on device'
    done
    refused '/dev/full: cannot be written: No space left on device' pair --input cases.csv --output /dev/full
    "$RESTITUTE" $run >/dev/full 2>err
    grep -q 'row 2000' err && fail "goes on solving for a full standard output"
fi

# HDF5 does not see the disk: a message, and no crash at the end of the program.
"$RESTITUTE" table --help >out 2>err
if ! grep -q 'no component table_files' err; then
    narrow 2 2 table build $scene --speed 0.1:1 --tolerance 1e-2 --output t.h5
    has err 't.h5: cannot be written: File too large'
    absent t.h5
    no_temporary
fi
for name in events.h5 fields.h5; do
    [ $name = events.h5 ] && set -- --events || set -- --method bem --elements 16 --tolerance 0.1 --fields
    "$RESTITUTE" history --psi 0.7 --delta1 1 --gamma 1 --samples 5 --output h.csv "$@" $name >out 2>err
    grep -q 'not in this build' err && continue
    cp $name old.h5
    rm -f h.csv h.csv.meta.json
    narrow 4 2 history --psi 0.7 --delta1 1 --gamma 1 --samples 5 --output h.csv "$@" $name
    has err "$name: cannot be written: File too large"
    cmp $name old.h5 || fail "the old $name is lost"
    absent h.csv h.csv.meta.json
    no_temporary
done
"$RESTITUTE" history --psi 1 --samples 5 --output h.csv --figure f.png >out 2>err
if ! grep -q 'needs matplotlib' err; then
    rm -f h.csv h.csv.meta.json f.png
    narrow 50 2 history --psi 1 --samples 5 --output h.csv --figure f.png
    has err "f.png: cannot be written: File too large"
    absent f.png
    no_temporary
fi
