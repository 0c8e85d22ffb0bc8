#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Where outputs go: links are followed and stay, modes are kept, what is no regular file is written
# through and never replaced.
. "$(dirname -- "$0")/common.sh"
umask 022
echo psi,delta1,gamma >cases.csv
echo 2,1,1 >>cases.csv
expect 0 pair --input cases.csv --output plain.csv

mode() { ls -l "$1" | cut -c1-10; }
is_link() { [ "$(readlink "$1")" = "$2" ] || fail "$1 is no link to $2 any more"; }

# A link, to what is there and to what is not yet: its target is written, with all that belongs to
# it beside the target.
mkdir there
echo old >there/target.csv
ln -s there/target.csv link.csv
ln -s link.csv twice.csv
for link in link.csv twice.csv; do
    echo old >there/target.csv
    expect 0 pair --input cases.csv --output $link
    cmp plain.csv there/target.csv || fail "the target of $link is not written"
    is_link $link "$([ $link = link.csv ] && echo there/target.csv || echo link.csv)"
done
has there/target.csv.meta.json twice.csv
absent link.csv.meta.json twice.csv.meta.json
ln -s there/new.csv dangling.csv
expect 0 pair --input cases.csv --output dangling.csv
is_link dangling.csv there/new.csv
cmp plain.csv there/new.csv || fail "the new target is not written"
ln -s nowhere/new.csv lost.csv
refused 'lost.csv: cannot be written: No such file' pair --input cases.csv --output lost.csv
ln -s round.csv round.csv
refused 'Too many levels' pair --input cases.csv --output round.csv
echo old >there/history.csv
ln -s there/history.csv history.csv
expect 0 history --psi 1 --samples 5 --output history.csv
is_link history.csv there/history.csv
has there/history.csv time_T

# Modes: that of the file that is replaced, else what the umask leaves of 666; the rows of a private
# result are private from the start.
for mask in 077 027 002; do
    rm -f fresh.csv fresh.csv.meta.json
    (umask $mask; exec "$RESTITUTE" pair --input cases.csv --output fresh.csv) || fail "no result with umask $mask"
    case $mask in
    077) wanted=-rw------- ;;
    027) wanted=-rw-r----- ;;
    002) wanted=-rw-rw-r-- ;;
    esac
    for file in fresh.csv fresh.csv.meta.json; do
        [ "$(mode $file)" = $wanted ] || fail "$file is $(mode $file) with umask $mask"
    done
done
for bits in 600 640 664 604; do
    : >o.csv
    chmod $bits o.csv
    before=$(mode o.csv)
    expect 0 pair --input cases.csv --output o.csv
    [ "$(mode o.csv)" = "$before" ] || fail "a result that was $before is $(mode o.csv)"
    expect 0 pair --psi 1 --format csv --output o.csv
    [ "$(mode o.csv)" = "$before" ] || fail "a single result that was $before is $(mode o.csv)"
done
awk 'BEGIN { print "psi,delta1,gamma"; for (i = 1; i <= 20000; i++) printf "%.4f,0.5,1\n", i / 1e4 }' >many.csv
: >o.csv
chmod 600 o.csv
"$RESTITUTE" pair --input many.csv --tolerance 3e-4 --output o.csv 2>err &
process=$!
while [ ! -s o.csv.partial ] && kill -0 $process 2>/dev/null; do sleep 0.02; done
[ "$(mode o.csv.partial)" = -rw------- ] || fail "the rows of a private result are $(mode o.csv.partial)"
kill -TERM $process
wait $process
rm -f o.csv*

# Standard output by its name in /proc goes on where it stands; nothing of the file is lost, and the
# link stays. Links of our own stand for those in /dev: a test must not need them to survive.
if [ -e /proc/self/fd/1 ]; then
    ln -s /proc/self/fd/1 stdout
    (echo before; "$RESTITUTE" pair --input cases.csv --output stdout; echo after) >redirected 2>err
    (echo before; cat plain.csv; echo after) >wanted
    cmp wanted redirected || fail "--output to standard output by its name gives something else"
    is_link stdout /proc/self/fd/1
    absent stdout.meta.json stdout.partial stdout.partial.json redirected.meta.json
    "$RESTITUTE" pair --psi 1 --format csv --output stdout >redirected 2>err || fail "one impact to standard output by its name"
    expect 0 pair --psi 1 --format csv
    cmp out redirected || fail "one impact to standard output by its name gives something else"
    "$RESTITUTE" pair --input cases.csv --format json --output stdout | cat >redirected
    has redirected '"results"'
    ln -s /proc/self/fd/7 seven
    "$RESTITUTE" pair --input cases.csv --output seven 7>redirected 2>err || fail "an open file by its name"
    cmp plain.csv redirected || fail "an open file by its name gets something else"
    ln -s /proc/self/fd/0 stdin
    refused '--output = stdin: cannot be written: Bad file descriptor' pair --psi 1 --output stdin
    refused '--resume: needs --output FILE' pair --input cases.csv --output stdout --resume
fi

# A device and a pipe are written through.
node=/dev/null
if [ "$(id -u)" -eq 0 ]; then
    mknod node c 1 3 2>/dev/null && (echo >node) 2>/dev/null && node=node || node=
fi
if [ -n "$node" ]; then
    for command in "pair --input cases.csv" "pair --input cases.csv --format json" "pair --psi 1" "history --psi 1"; do
        expect 0 $command --output $node
        [ -c $node ] || fail "$node is replaced by: $command"
    done
    absent node.meta.json node.partial
    refused 'needs --output FILE' pair --input cases.csv --output $node --resume
else
    echo "not tried: a device"
fi
mkfifo pipe.csv
cat pipe.csv >piped &
expect 0 pair --input cases.csv --output pipe.csv
wait $!
cmp plain.csv piped || fail "a pipe gets something else"
[ -p pipe.csv ] || fail "the pipe is replaced"
absent pipe.csv.meta.json pipe.csv.partial

# Folders, and what is closed to us, are refused; so is a file that may not be written.
ln -s there folder.csv
refused 'is not a regular file' pair --psi 1 --output folder.csv
refused 'is not a regular file' history --psi 1 --output there
if [ "$(id -u)" -ne 0 ]; then
    : >closed.csv
    chmod 444 closed.csv
    refused 'Permission denied' pair --psi 1 --output closed.csv
fi

# A table, an event log and fields follow the same rule, and so do figures.
"$RESTITUTE" table --help >out 2>err
if ! grep -q 'no component table_files' err; then
    ln -s there/t.h5 t.h5
    : >there/t.h5
    chmod 600 there/t.h5
    expect 0 table build $scene --speed 0.1:1 --tolerance 1e-2 --output t.h5
    is_link t.h5 there/t.h5
    ln -s pipe.csv through.h5
    refused 'a table needs a file' table build $scene --speed 0.1:1 --tolerance 1e-2 --output through.h5
    [ "$(mode there/t.h5)" = -rw------- ] || fail "the table is $(mode there/t.h5)"
    expect 0 table info t.h5
    : >there/pair.csv
    ln -s there/pair.csv pair.csv
    expect 0 table query t.h5 --normal-speed 1 --format csv --output pair.csv
    is_link pair.csv there/pair.csv
    has there/pair.csv ez,ex
fi
for name in events.csv events.h5 fields.h5 figure.svg; do
    case $name in
    events.*) set -- --events ;;
    fields.*) set -- --method bem --elements 16 --tolerance 0.1 --fields ;;
    *) set -- --figure ;;
    esac
    ln -s there/$name $name
    : >there/$name
    chmod 600 there/$name
    "$RESTITUTE" history --psi 0.7 --delta1 1 --gamma 1 --samples 5 --output history.csv "$@" $name 2>err </dev/null
    if [ $? -ne 0 ]; then
        grep -Eq 'not in this build|needs (h5py|matplotlib)' err || fail "$name is not written"
        continue
    fi
    is_link $name there/$name
    [ -s there/$name ] || fail "there/$name is empty"
    [ "$(mode there/$name)" = -rw------- ] || fail "there/$name is $(mode there/$name)"
done

# What a killed process left of a file is removed by the next that writes there.
echo half >plain.csv.meta.json.restitute-0.tmp
echo half >single.csv.restitute-0.tmp
expect 0 pair --input cases.csv --output plain.csv
expect 0 pair --psi 1 --format csv --output single.csv
[ -z "$(find . -name '*.tmp')" ] || fail "left: $(find . -name '*.tmp')"
