#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Nothing that a run reads is what it writes, by whatever name, and no two outputs are one: refused
# before anything is written.
. "$(dirname -- "$0")/common.sh"

cp "$materials/polyisobutylene.json" "$materials/polyisobutylene.csv" "$materials/steel.json" .
cp steel.json out.csv.meta.json
cp steel.json g.csv.partial.json
cp steel.json events.csv.meta.json
cp polyisobutylene.csv m.csv
printf 'psi,delta1,gamma\n1,0.1,1\n' >cases.csv
cat >named.csv <<'END'
material,partner,radius1_m,density1_kg_m3,speed_m_s,angle_deg,friction
m.csv,rigid,0.01,7800,1,30,0.3
polyisobutylene.json,steel.json,0.01,7800,1,30,0.3
m.csv,later.csv,0.01,7800,1,30,0.3
END
mkdir sub
ln -s cases.csv link.csv
ln -s ../steel.json sub/steel.csv
ln -s later.csv sub/later.csv # leads nowhere yet
ln -s ../later.csv sub/other.csv
ln cases.csv hard.csv
body="--radius 0.01 --density 7800 --friction 0.3"
grid="--grid speed=1:2:2,angle=10:20:2"

sums() { find . -type f ! -name out ! -name err ! -name before ! -name after -exec cksum {} + | sort; }

# clash OUTPUT INPUT ARGUMENT...: refused with both names, and no file is another one than before.
clash() {
    output=$1 input=$2
    shift 2
    sums >before
    refused 'is an input of this run' "$@"
    has err "$output" "$input"
    sums >after
    cmp before after || fail "files changed: restitute $*"
}

for name in cases.csv ./cases.csv sub/../cases.csv link.csv hard.csv; do
    clash "--output = $name" '--input cases.csv' pair --input cases.csv --output $name
done
clash '--output = ' 'steel.json' pair --material steel.json $body --velocity 1 --output sub/steel.csv --format csv
cp polyisobutylene.csv p.csv
clash '--output = p.csv' '--partner ./p.csv' pair --material steel.json --partner ./p.csv $body --velocity 1 --output p.csv
clash '--output = p.csv' '--partner ./p.csv' history --material steel.json --partner ./p.csv $body --velocity 1 --output p.csv

# The series that a JSON material names.
series="--material polyisobutylene.json $body"
clash '--output = polyisobutylene.csv' 'prony_csv polyisobutylene.csv' pair $series --velocity 1 --output polyisobutylene.csv
clash '--output = polyisobutylene.csv' 'prony_csv polyisobutylene.csv' pair $series $grid --output polyisobutylene.csv
cp polyisobutylene.json polyisobutylene.csv sub
clash '--output = sub/polyisobutylene.csv' 'prony_csv sub/polyisobutylene.csv' \
    pair --material sub/polyisobutylene.json $body --velocity 1 --output sub/polyisobutylene.csv
clash '--output = polyisobutylene.csv' 'prony_csv' history $series --velocity 1 --output polyisobutylene.csv

# What the cells name, whether it is there or not.
for name in m.csv steel.json polyisobutylene.json polyisobutylene.csv later.csv sub/other.csv; do
    case $name in sub/*) other=later.csv ;; *) other=$name ;; esac
    clash "--output = $name" "$other" pair --input named.csv --output $name
done
absent later.csv

# What is written beside the output.
clash '--output (.meta.json) = out.csv.meta.json' '--material out.csv.meta.json' \
    pair --material out.csv.meta.json $body $grid --output out.csv
clash '--output (.partial.json) = g.csv.partial.json' '--material' pair --material g.csv.partial.json $body $grid --output g.csv
cp cases.csv rows.csv.partial
clash '--output (.partial) = rows.csv.partial' '--input rows.csv.partial' pair --input rows.csv.partial --output rows.csv
if "$RESTITUTE" history --psi 1 --events e.csv --output h.csv 2>err; then
    clash '--events (.meta.json)' '--material events.csv.meta.json' \
        history --material events.csv.meta.json $body --velocity 1 --events events.csv --output h.csv
    refused '--events and --output are the same file' history --psi 1 --events x.csv --output ./x.csv
    ln -s x.csv.meta.json events2.csv
    refused '--events and --output (.meta.json) are the same file' history --psi 1 --events events2.csv --output x.csv
    "$RESTITUTE" history --psi 1 --events - --output same.csv >same.csv 2>err && fail "two outputs in one file"
    has err '--events and --output are the same file'
fi
"$RESTITUTE" history --psi 1 --samples 5 --output h.csv --figure f.svg >out 2>err
if ! grep -q 'needs matplotlib' err; then
    rm -f h.csv h.csv.meta.json f.svg
    cp polyisobutylene.json in.json
    ln -s in.json figure.svg
    clash '--figure = figure.svg' '--material in.json' history --material in.json $body --velocity 1 --figure figure.svg --output h.csv
    refused '--figure and --output are the same file' history --psi 1 --figure ./x.svg --output x.svg
    refused '--figure and --output are the same file' pair --material in.json $body $grid --figure ./x.svg --output x.svg
fi

# Standard input and output that are files.
cp cases.csv in.csv
"$RESTITUTE" pair --input - --output in.csv <in.csv >out 2>err
[ $? -eq 2 ] || fail "standard input is overwritten"
has err '--output = in.csv' '--input -'
"$RESTITUTE" pair --input in.csv >>in.csv 2>err
[ $? -eq 2 ] || fail "the input is written to"
has err 'is an input of this run' '--input in.csv'
cmp in.csv cases.csv || fail "in.csv is another one"

# Tables.
"$RESTITUTE" table --help >out 2>err
if ! grep -q 'no component table_files' err; then
    cp steel.json p.json
    build="table build $body --speed 0.1:1 --tolerance 1e-2"
    clash '--output = p.json' '--partner p.json' $build --material steel.json --partner p.json --output p.json
    clash '--output = steel.json' '--material steel.json' $build --material steel.json --output steel.json
    clash '--output = polyisobutylene.csv' prony_csv $build --material polyisobutylene.json --output polyisobutylene.csv
    expect 0 $build --material steel.json --output t.h5
    ln -s t.h5 t.csv
    printf 'normal_speed_m_s\n1\n' >speeds.csv
    ln -s speeds.csv again.csv
    clash '--output = t.csv' 'the table t.h5' table query t.h5 --normal-speed 1 --output t.csv
    clash '--output = t.csv' 'the table t.h5' table query t.h5 --input speeds.csv --output t.csv
    clash '--output = again.csv' '--input speeds.csv' table query t.h5 --input speeds.csv --output again.csv
fi
