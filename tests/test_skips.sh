#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# skips.sh finds in what this ctest writes why tests were skipped, and those that do not say why.
#   SOURCE_DIR=... CTEST=/path/of/ctest test_skips.sh
set -eu
cat >CTestTestfile.cmake <<'END'
add_test(a sh -c "echo nothing is skipped: here")
add_test(b sh b.sh)
add_test(c sh -c "echo first; echo skipped: no such program; exit 77")
add_test(d sh d.sh)
set_tests_properties(c d PROPERTIES SKIP_RETURN_CODE 77)
END
cat >b.sh <<'END'
seq 9999
echo 'skipped: no <traps> & "more"'
seq 9
END

# skips SCRIPT: those of a run in which this is the test d
skips() {
    echo "$1" >d.sh
    "$CTEST" --output-junit junit.xml --test-output-size-passed 100000 >ctest.txt
    sh "$SOURCE_DIR/tests/skips.sh" junit.xml >found
}
skips 'echo no such program; exit 77'
cat >wanted <<'END'
skipped: b: no <traps> & "more"
skipped: c d: no such program
END
diff wanted found
if skips 'exit 77'; then echo "a skip without a reason passes" && exit 1; fi
grep -qx 'skipped: d: no reason given' found || { cat found && exit 1; }
skips 'exit 0'
