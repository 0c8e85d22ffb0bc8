#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# --help suffices, --version tells the version, a wrong or missing subcommand is refused.
. "$(dirname -- "$0")/common.sh"

expect 0 --version
head -n 1 out | grep -Eq '^restitute [0-9]+\.[0-9]+\.[0-9]+$' || fail "--version prints $(cat out)"
has out 'BSD-3-Clause'
cp out version
"$RESTITUTE" pair --psi 1 --method bem --tolerance 0.1 >out 2>err
if grep -q 'is not in this build' err; then
    ! grep GPL version || fail "the GPL is named by a build without FFTW"
else
    has version FFTW 'GNU General Public License, version 2 or'
fi

expect 0 --help
has out pair history

expect 0 pair --help
[ ! -s err ] || fail "--help writes to standard error"
has out --chi --psi --delta1 --gamma --delta2 --material --radius --density --mass1 --inertia1 --radius2 --density2 \
    --mass2 --inertia2 --partner --friction --velocity --angle --spin --spin2 --rotation-blocked --method --tolerance \
    --elements --time-step --format --input --output --grid --figure --resume 'kg/m^3' 'm/s' degrees default \
    'Exit status' 'restitute pair --input cases.csv'

expect 0 history --help
has out --samples --output --figure 'restitute history' time_s

# Every option that --help shows is in the manual page.
sed 's/\\-/-/g' "$SOURCE_DIR/docs/restitute.1" >manual
for command in pair history sweep cite; do
    expect 0 $command --help
    for option in $(sed -n 's/^  *--\([a-z0-9-]*\).*/\1/p' out); do
        grep -Eq "(^\.It Fl|Fl) -$option( |\$)" manual || fail "the manual page lacks --$option"
    done
done

refused 'a command is missing'
refused 'unknown command "pears"' pears
