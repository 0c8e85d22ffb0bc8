#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests in C do not run of core, contact, table and Fortran.

    cmake --preset coverage && cmake --build --preset coverage && ctest --preset coverage
    tests/coverage/report.py             lines and branches of each room
    tests/coverage/report.py --lines     and every line that did not run
    tests/coverage/report.py --check     exit status 1 if a file has more such lines than
                                         docs/records/coverage.md gives a reason for
"""

import argparse
import collections
import json
import re
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
PAGE = TOP / "docs/records/coverage.md"
ROOMS = "src/(base|contact|euler|materials|solver|sync|table)/|fortran/(common|euler|sync)/"


def files_run(build):
    """Of each file of the rooms: lines, branches, and the lines without a run."""
    command = ["gcovr", "-r", TOP, build, "--filter", ROOMS, "--json", "-", "--gcov-ignore-parse-errors"]
    found = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    files = {}
    for entry in found["files"]:
        source = (TOP / entry["file"]).read_text().splitlines()
        runs = collections.Counter()
        branches = collections.Counter()
        for line in entry["lines"]:
            # gfortran counts the end of a module, which never runs.
            ends = source[line["line_number"] - 1].startswith("end module")
            if not line.get("gcovr/noncode") and not ends:
                runs[line["line_number"]] += line["count"]
                for k, branch in enumerate(line["branches"]):
                    branches[line["line_number"], k] += branch["count"]
        missing = sorted(n for n in runs if not runs[n])
        files[entry["file"]] = {
            "lines": len(runs),
            "missing": missing,
            "branches": len(branches),
            "untaken": sum(not count for count in branches.values()),
        }
    if not files:
        sys.exit(f"coverage: no counts in {build}: configure, build and test the preset coverage first")
    return files


def share(all_of, without):
    return f"{100 * (1 - without / all_of) if all_of else 100:.1f} %"


def print_rooms(files):
    rooms = collections.defaultdict(collections.Counter)
    for name, file in files.items():
        room = rooms["/".join(name.split("/")[:2])]
        room.update(
            lines=file["lines"], missing=len(file["missing"]), branches=file["branches"], untaken=file["untaken"]
        )
    print("| room | lines | run | branches | taken |\n|---|---|---|---|---|")
    for name, r in sorted(rooms.items()):
        lines, branches = share(r["lines"], r["missing"]), share(r["branches"], r["untaken"])
        print(f"| `{name}` | {r['lines']} | {lines} | {r['branches']} | {branches} |")


def print_lines(files):
    for name, file in sorted(files.items()):
        source = (TOP / name).read_text().splitlines()
        for number in file["missing"]:
            print(f"{name}:{number}: {source[number - 1].strip()}")


def unexplained(files):
    """Files with more lines without a run than the page has reasons for."""
    known = {m[1]: int(m[2]) for m in re.finditer(r"^\| `([^`]+)` \| (\d+) \|", PAGE.read_text(), re.M)}
    for name, file in sorted(files.items()):
        if len(file["missing"]) > known.get(name, 0):
            lines = ", ".join(map(str, file["missing"]))
            yield f"{name}: {len(file['missing'])} lines do not run ({lines}), {known.get(name, 0)} are explained in {PAGE.name}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=TOP / "build/coverage")
    parser.add_argument("--lines", action="store_true")
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    files = files_run(args.build)
    print_rooms(files)
    if args.lines:
        print_lines(files)
    faults = list(unexplained(files)) if args.check else []
    print(*faults, sep="\n")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
