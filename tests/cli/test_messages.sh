#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Control characters in cells, options, names and files reach no terminal by a message: they are
# shown as \xNN. Other text stays.
. "$(dirname -- "$0")/common.sh"
escape=$(printf '\033')
csi=$(printf '\302\233') # the same as one character, in UTF-8
bad="${escape}[31mred"

# harmless FILE: no control character but line ends, in any coding.
harmless() {
    LC_ALL=C tr -d '\n' <"$1" | LC_ALL=C grep -q '[[:cntrl:]]' && fail "$1 holds a control character"
    LC_ALL=C grep -q "$(printf '\302')[$(printf '\200')-$(printf '\237')]" "$1" && fail "$1 holds a control character of UTF-8"
    return 0
}

# Cells: the message shows them escaped, the result as they came.
{
    echo psi,delta1
    echo "$bad,0"
    echo "${csi}31m,0"
    printf '"line\nend",0\n'
    printf '\377\376,0\n'
    printf '1\303\033[1m\177,0\n'
} >cases.csv
expect 1 pair --input cases.csv --output out.csv
harmless err
has err '\x1b[31mred' '\xc2\x9b31m' 'line\x0aend' '\xff\xfe' '1\xc3\x1b[1m\x7f'
has out.csv "$bad" "${csi}31m"

# Options, file names, columns, names in material files.
refused '\x1b[31mred' pair --psi "$bad"
harmless err
refused '\x1b[31mred' pair --psi 1 "$bad"
harmless err
refused '\x1b[31mred' pair --psi 1 --output "$bad/x"
harmless err
refused '\x1b[31mred' pair --input "$bad.csv"
harmless err
refused '\x1b[31mred' "$bad"
harmless err
printf 'psi,%s\n1,2\n' "$bad" >columns.csv
expect 0 pair --input columns.csv
has err 'passed through as unknown: \x1b[31mred'
harmless err
mkdir "$bad"
printf 'psi,delta1,gamma\n-1,0,1\n' >"$bad/cases.csv"
expect 1 pair --input "$bad/cases.csv"
has err '\x1b[31mred'
harmless err
sed 's/"name": "[^"]*"/"name": "\\u001b[31mred \\u009b1m"/' "$materials/steel.json" >named.json
expect 0 pair --material named.json --radius 1 --density 1 --friction 0 --velocity 1
has out '\x1b[31mred \xc2\x9b1m'
harmless out

# Letters of other scripts are none of that.
refused 'Gummi_Ω_橡胶_é' pair --input 'Gummi_Ω_橡胶_é'
