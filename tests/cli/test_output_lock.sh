#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The file of an unfinished run belongs to one process; without --resume it is never thrown away,
# and rows that are too few or too many never get the final name.
. "$(dirname -- "$0")/common.sh"
awk 'BEGIN { print "psi,delta1,gamma"; for (i = 1; i <= 1500; i++) printf "%.3f,%.4f,%.3f\n", 0.1 + 5 * i / 1500, 0.01 + i / 1500, i % 7 / 3 }' \
    >cases.csv
run="pair --input cases.csv --tolerance 3e-4 --output out.csv"
other="is being written by another process"

# begin FILE ARGUMENT...: start the command and stop it in its tracks when FILE holds something; for
# `run` rows.
begin() {
    file=$1
    shift
    "$RESTITUTE" "$@" >begun 2>begun.err </dev/null &
    process=$!
    tries=0
    until [ -s "$file" ] && { [ "$file" != out.csv.partial ] || [ "$(wc -l <"$file")" -ge 2 ]; }; do
        tries=$((tries + 1))
        [ $tries -lt 1200 ] && kill -0 $process 2>/dev/null || fail "no $file under way"
        sleep 0.02
    done
    kill -STOP $process
    [ -f "$file" ] || fail "$file was done before the signal came"
}
end() {
    kill -"$1" $process
    kill -CONT $process 2>/dev/null
    wait $process
}

# A second process is refused as long as the first one lives, and changes nothing.
begin out.csv.partial $run
cp out.csv.partial kept
cp out.csv.partial.json kept.json
refused "out.csv.partial $other" $run
refused "out.csv.partial $other" $run --resume
cmp kept out.csv.partial && cmp kept.json out.csv.partial.json || fail "a refused run changed the partial file"
end KILL
refused 'out.csv.partial is left from an interrupted run: continue it with --resume, or remove it' $run
cmp kept out.csv.partial || fail "a refused run changed the partial file"

# Two that go on at once: one does, with every row once.
"$RESTITUTE" $run --resume 2>first &
one=$!
"$RESTITUTE" $run --resume 2>second &
two=$!
wait $one
one=$?
wait $two
two=$?
[ $((one + two)) -eq 2 ] || [ $((one + two)) -eq 0 ] || fail "exit statuses $one and $two"
[ $((one + two)) -eq 0 ] || cat first second | grep -q "$other" || fail "no reason: $(cat first second)"
[ "$(wc -l <out.csv)" -eq 1501 ] || fail "$(wc -l <out.csv) lines of 1500 rows"
absent out.csv.partial out.csv.partial.json
cp out.csv whole.csv
rm -f out.csv out.csv.meta.json

# Something that knows nothing of locks writes into the rows: they do not get the name.
for how in more less; do
    begin out.csv.partial $run
    case $how in
    more) cat whole.csv whole.csv >>out.csv.partial ;;
    less) : >out.csv.partial ;;
    esac
    end CONT
    [ $? -eq 2 ] || fail "$how rows than there are, and exit status $?"
    has begun.err 'lines, not 1501'
    absent out.csv out.csv.meta.json
    rm -f out.csv.partial out.csv.partial.json
done

# A line end within quotes ends no row: neither in the count nor where a last line is cut.
printf 'material,speed_m_s\n"steel\n.json",1\nsteel.json,1\n"steel\n.json",2\nsteel.json,2\n' >lines.csv
cp "$materials/steel.json" .
quoted="pair --input lines.csv --radius 0.01 --density 7800 --friction 0.3 --output q.csv"
expect 1 $quoted
cp q.csv quoted.csv
cp q.csv.meta.json record
expect 1 $quoted --resume
cmp q.csv quoted.csv || fail "a rerun gives other rows"
sed -n '1,4p' quoted.csv >q.csv.partial
printf '"steel\n' >>q.csv.partial
awk '/^  "settings": \{/ { inside = 1; print "{"; next } inside && /^  \}/ { print "}"; exit } inside' record >q.csv.partial.json
expect 1 $quoted --resume
cmp q.csv quoted.csv || fail "resumed within a quoted cell: other rows"

# Left by a process that was killed before it wrote a row: gone on with from nothing.
: >e.csv.partial
refused 'left from an interrupted run' pair --input lines.csv --radius 0.01 --density 7800 --friction 0.3 --output e.csv
expect 1 pair --input lines.csv --radius 0.01 --density 7800 --friction 0.3 --output e.csv --resume
cmp e.csv quoted.csv || fail "resumed from an empty file: other rows"
