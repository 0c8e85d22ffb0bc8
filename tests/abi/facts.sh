#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# What programs are compiled against, a line a fact:  facts.sh INCLUDE_DIRECTORY HEADER...
#   function NAME exported|hidden TYPES        parameters have no names here
#   struct NAME N MEMBER                       of a struct that grows; with those before, its offset
#   enum NAME ENUMERATOR = VALUE
#   other DECLARATION                          a struct that never changes, a typedef
# A program keeps working as long as no fact goes. CC comes from the environment.
set -eu
include=$1
shift
[ $# -gt 0 ] || exit 2
for header in "$@"; do
    preprocessed=$(echo "#include <restitute/$header>" | "$CC" -E -x c -I "$include" -)
    printf '%s\n' "$preprocessed" | awk -v "end=/restitute/$header\"" '
    function fail(why) { print end ": " why >"/dev/stderr"; failed = 1; exit 1 }
    function trim(s) { gsub(/^ +| +$/, "", s); return s }
    function parts(kind, text, separator,    i, n, part, name) { # typedef struct NAME { ... } NAME
        name = text
        sub(/^[^{]*[{]/, "", text)
        sub(/[}][^}]*$/, "", text)
        sub(/ *[{].*/, "", name)
        sub(/.* /, "", name)
        n = split(text, part, separator)
        for (i = 1; i <= n; i++) {
            part[i] = trim(part[i])
            if (part[i] == "") continue
            if (kind == "enum" && part[i] !~ / = /) fail("an enumerator without a value: " part[i])
            print kind, name, (kind == "struct" ? i " " : "") part[i]
        }
    }
    function fact(text,    tag, name) {
        tag = gsub(/__attribute__ *\(\(visibility\("default"\)\)\)/, "", text) ? "exported" : "hidden"
        gsub(/ +/, " ", text)
        text = trim(text)
        if (text ~ /^(typedef )?enum/) parts("enum", text, ",")
        else if (text ~ /^typedef struct [a-z_]+ [{] size_t struct_size;/) parts("struct", text, ";")
        else if (text ~ /^typedef / || text !~ /[(]/) print "other", text
        else {
            name = text
            sub(/ ?[(].*/, "", name)
            sub(/.*[ *]/, "", name)
            gsub(/[a-z_0-9]+,/, ",", text)
            gsub(/[a-z_0-9]+[)]/, ")", text)
            gsub(/[a-z_0-9]+\[/, "[", text)
            print "function", name, tag, text
        }
    }
    /^# [0-9]+ "/ { ours = index($0, end); next }
    ours { all = all " " $0 }
    END {
        if (failed) exit 1
        gsub(/static inline [^{]*[{][^}]*[}]/, "", all)
        while (match(all, /^[^;{]*([{][^}]*[}][^;{]*)?;/)) {
            fact(substr(all, 1, RLENGTH - 1))
            all = substr(all, RLENGTH + 1)
        }
        if (all ~ /[^ ]/) fail("not understood: " all)
    }'
done
