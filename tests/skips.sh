#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Prints why tests were skipped:  skips.sh JUNIT, which ctest --output-junit wrote A skipped test
# says why in the last line of its output; a test that leaves a part out, in a line "skipped:
# REASON". Exit status 1 if a skipped test says nothing.
awk '
    function skip(reason) {
        if (!(reason in tests)) order[++count] = reason
        tests[reason] = tests[reason] " " name
    }
    /<testcase name="/ { split($0, part, "\""); name = part[2]; skipped = 0; last = "" }
    /<skipped / { skipped = 1 }
    sub(/.*<system-out>/, "") { inside = 1 }
    inside {
        if (sub(/<\/system-out>.*/, "")) inside = 0
        gsub(/&quot;/, "\""); gsub(/&lt;/, "<"); gsub(/&gt;/, ">"); gsub(/&amp;/, "\\&")
        if (sub(/^skipped: /, "") && !skipped) skip($0)
        if (/[^ ]/) last = $0
    }
    /<\/testcase>/ && skipped { skip(last == "" ? "no reason given" : last); silent += last == "" }
    END {
        for (i = 1; i <= count; i++) print "skipped:" tests[order[i]] ": " order[i]
        exit silent > 0
    }' "$1"
