#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The first hours of a user, word for word: the commands under "Try it" of README.md, then those of
# docs/first_ten_minutes.md and docs/tutorial.md.
#   tests/first_hours.sh       on a bare Debian 12, as root: installs, builds, runs all tests
# The pages make their folders beside that of the checkout. With BUILD_DIR and PYTHON in the
# environment, as in the test lammps.first_hours, what is built there is used: the first command of
# README.md only runs, and nothing is installed.
set -eu

source_dir=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# The first block of commands of README.md.
commands=$(awk '/^```$/ && c { exit } c; /^```sh$/ { c = 1 }' "$source_dir/README.md")
case $commands in
*/run*tests/run*) ;;
*) echo "first_hours: README.md begins with other commands: $commands" >&2 && exit 1 ;;
esac

if [ -n "${BUILD_DIR-}" ]; then
    RESTITUTE=$BUILD_DIR/python/bin/restitute
    export RESTITUTE
    commands=$(echo "$commands" | sed "1s|^|$source_dir/|;1q")
    sh -eu -c "$commands"
    exec sh "$source_dir/tests/docs/follow.sh" first_ten_minutes.md tutorial.md lammps
fi
cd "$source_dir"
date
sh -eux -c "$commands"
date
python3 -B tests/docs/page.py docs/first_ten_minutes.md docs/tutorial.md installing lammps
date
