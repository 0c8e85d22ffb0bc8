#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Reference impacts through --input: the pair, the contact time and the indentation of each row.
. "$(dirname -- "$0")/common.sh"

# chi, psi, delta1, gamma, then ez, ex, D_max, contact time, good to 1e-6 or better.
cat >truth <<'END'
1.1666666666666667,1.61024,0.297421,0.00189351,0.515970297702,0.2528355288,0.764112477887,2.7896802334
2.26,2.73024,7.12413,0,0.015102848360,0.0039478924,0.175558939693,2.0561031515
1.1666666666666667,0.864392,0.446919,50.9936,0.999273654442,0.3890445556,0.992344239428,2.9203447302
1.168,5.35045,0,1,1.000000000000,-0.1268024185,1.000000000000,2.9432751843
0.543,0.902883,0,1,1.000000000000,0.9957489223,1.000000000000,2.9432751843
1.1666666666666667,1.38021,43.5968,0,0.000830904356,0.0004198167,0.053905718225,1.5802854747
2.397,0.0554072,16.3653,0.0306157,0.662078621933,-0.1648365917,0.257212929987,0.7057382398
1.1666666666666667,9.62831,0.0116863,0.0736531,0.968574900738,-0.5229337822,0.987297415260,2.9357378882
0.586,0.064759,2.65281,0.119131,0.411354023705,0.4158498545,0.460122196761,1.2214331290
END
{ echo chi,psi,delta1,gamma; cut -d, -f1-4 truth; } >cases.csv
expect 0 pair --input cases.csv --output out.csv
[ ! -s err ] || fail "messages in a run without a terminal and without failures"
[ "$(head -1 out.csv)" = "chi,psi,delta1,gamma,ez,ex,contact_time,max_indentation,error_ez,error_ex,method,status" ] ||
    fail "the header is $(head -1 out.csv)"
# ez and ex within the default tolerance 1e-3. The tolerance is one of the pair only: the contact
# time and the indentation come from a first-order method at that step, for which 1 % is ample.
tail -n +2 out.csv | paste -d, truth - | awk -F, '
    function off(a, b) { return a > b ? a - b : b - a }
    off($5, $13) > 1e-3 || off($6, $14) > 1e-3 { print "pair of row " NR ": " $0; bad = 1 }
    off($7, $16) > 0.01 * $7 || off($8, $15) > 0.01 * $8 { print "time or depth of row " NR ": " $0; bad = 1 }
    $1 != $9 || $2 != $10 || $3 != $11 || $4 != $12 { print "input of row " NR " not as given"; bad = 1 }
    END { exit bad }' || fail "the results differ from the reference"
[ "$(wc -l <out.csv)" -eq 10 ] || fail "not 9 rows"

# The record beside it; no other file; the same bytes again.
has out.csv.meta.json '"version"' '"command"' '"tolerance": 0.001' '"fingerprint"' '"contact_time": "T"' '"failed": 0'
absent out.csv.partial out.csv.partial.json
cp out.csv before && cp out.csv.meta.json before.json
expect 0 pair --input cases.csv --output out.csv
cmp out.csv before && cmp out.csv.meta.json before.json || fail "a rerun writes other bytes"

# Standard input and output, another order of the columns, quotes, CRLF, options for what is no
# column.
awk -F, '{ printf "\"%s\",%s,%s\r\n", $3, $2, $4 }' cases.csv | head -2 | "$RESTITUTE" pair --input - --output - \
    --chi 1.1666666666666667 >piped.csv || fail "standard input is not read"
[ "$(value piped.csv ez)" = "$(value out.csv ez)" ] || fail "another order of columns gives another pair"

# JSON holds the same, and its own record.
expect 0 pair --input cases.csv --format json --output out.json
has out.json '"meta"' '"results"' '"version"' '"ez"' '"status": ""'
absent out.json.partial out.json.partial.json out.json.meta.json
