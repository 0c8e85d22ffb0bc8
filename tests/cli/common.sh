# SPDX-License-Identifier: BSD-3-Clause
# What the scripts share; read with `. "$(dirname -- "$0")/common.sh"`. RESTITUTE is the command,
# SOURCE_DIR the project. A script works in a directory of its own, which is removed at the end, and
# stops at the first thing that is wrong.
set -u
case $RESTITUTE in /*) ;; *) RESTITUTE=$PWD/$RESTITUTE ;; esac
SOURCE_DIR=$(cd "$SOURCE_DIR" && pwd)
materials=$SOURCE_DIR/src/materials
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

fail() {
    echo "FAILED: $*" >&2
    [ -f err ] && sed 's/^/  stderr: /' err >&2
    exit 1
}

# expect STATUS ARGUMENT...: run the command; its output is in `out`, its messages in `err`.
expect() {
    wanted=$1
    shift
    "$RESTITUTE" "$@" >out 2>err </dev/null
    status=$?
    [ "$status" -eq "$wanted" ] || fail "exit status $status, not $wanted, of: restitute $*"
}

# refused TEXT ARGUMENT...: exit status 2, nothing on standard output, and a message that holds
# TEXT.
refused() {
    text=$1
    shift
    expect 2 "$@"
    [ ! -s out ] || fail "output in spite of a refusal: restitute $*"
    grep -q '^restitute: ' err || fail "no message: restitute $*"
    grep -qF -- "$text" err || fail "the message does not say '$text': restitute $*"
}

# has FILE TEXT...: the file holds each of the texts.
has() {
    file=$1
    shift
    for text in "$@"; do
        grep -qF -- "$text" "$file" || fail "$file does not hold '$text'"
    done
}

# absent FILE...: none of the files exists.
absent() {
    for file in "$@"; do
        [ ! -e "$file" ] || fail "$file was left behind"
    done
}

# value FILE COLUMN [ROW]: a cell of a CSV without quoted cells.
value() {
    awk -F, -v name="$2" -v row="${3:-1}" '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) column = i }
        NR == row + 1 { print $column }' "$1"
}

# near A B TOLERANCE
near() {
    awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(a != "" && b != "" && d <= t) }' ||
        fail "$1 is not within $3 of $2"
}

# have PROGRAM: it is here. Else the part of the script that needs it is left out, which tests/run
# repeats.
have() {
    command -v "$1" >/dev/null || { echo "skipped: no $1 here"; return 1; }
}

# have_module MODULE: the Python of the command has it.
have_module() {
    "$(sed -n '1s/^#! *//p' "$RESTITUTE")" -c "import $1" 2>/dev/null || { echo "skipped: no Python module $1 here"; return 1; }
}

# have_h5py: likewise; `python` has it. Debian's belongs to /usr/bin/python3, which another Python
# may hide.
have_h5py() {
    for python in python3 /usr/bin/python3; do
        ! "$python" -c 'import h5py' 2>/dev/null || return 0
    done
    echo "skipped: no python3 with h5py here"
    return 1
}

# Options of the scene that most scripts use: a steel ball of 10 mm on polyisobutylene.
scene="--material $materials/polyisobutylene.json --radius 0.005 --density 7800 --friction 0.3"
