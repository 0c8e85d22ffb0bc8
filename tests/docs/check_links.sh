#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Every relative link and figure in a Markdown file of the project leads to a file, and every
# #section to a heading. Links in code (fenced, indented by four or between backticks) and those to
# other hosts are not looked at.
#   SOURCE_DIR=... check_links.sh
set -eu

# Prints "file<TAB>target" for every link of the Markdown files named on standard input.
links() {
    while IFS= read -r file; do
        awk -v file="$file" '
            /^ *```/ { fenced = !fenced; next }
            fenced || /^    / { next }
            {
                gsub(/`[^`]*`/, "")
                while (match($0, /\]\([^)]*\)/)) {
                    target = substr($0, RSTART + 2, RLENGTH - 3)
                    $0 = substr($0, RSTART + RLENGTH)
                    sub(/ +"[^"]*"$/, "", target)
                    print file "\t" target
                }
            }' "$file"
    done
}

# Prints what each heading of a Markdown file is called in a link.
sections() {
    awk '
        /^ *```/ { fenced = !fenced; next }
        !fenced && /^#+ / {
            sub(/^#+ +/, "")
            $0 = tolower($0)
            gsub(/[^a-z0-9 _-]/, "")
            gsub(/ /, "-")
            print
        }' "$1"
}

# check DIRECTORY: prints what is wrong; status 1 if anything is. The count of links is left in the
# file `count`.
check() {
    find "$1" \( -name .git -o -name build -o -name '*-results' -o -type d -exec test -e '{}/CMakeCache.txt' \; \) -prune -o -name '*.md' -print | sort | links >all_links
    wc -l <all_links | tr -d ' ' >count
    wrong=0
    tab=$(printf '\t')
    while IFS="$tab" read -r file target; do
        case $target in
        http://* | https://* | mailto:*) continue ;;
        /*) echo "$file: ($target) is not relative" && wrong=1 && continue ;;
        esac
        path=${target%%#*}
        if [ -n "$path" ]; then path=$(dirname -- "$file")/$path; else path=$file; fi
        if [ ! -e "$path" ]; then
            echo "$file: ($target) does not exist"
            wrong=1
        elif [ "$target" != "${target#*#}" ] && ! sections "$path" | grep -qxF -e "${target#*#}"; then
            echo "$file: ($target): no such section"
            wrong=1
        fi
    done <all_links
    return "$wrong"
}

# First on a tree of which is known what is wrong: what finds nothing there would find nothing
# anywhere.
mkdir -p known
cat >known/a.md <<'END'
# A first section, with marks
[right](b.md) [right](#a-first-section-with-marks) `[code](none.md)` [elsewhere](https://example.org/none)
![wrong](none.svg) [wrong](b.md#none) [wrong](/b.md)
END
echo "# B" >known/b.md
if check known >found; then echo "broken links were not seen" && exit 1; fi
[ "$(wc -l <found)" -eq 3 ] || { echo "three links are broken, but seen were:" && cat found && exit 1; }

check "$SOURCE_DIR" || exit 1
[ "$(cat count)" -gt 0 ] || { echo "no link found in $SOURCE_DIR" && exit 1; }
echo "$(cat count) links lead somewhere"
