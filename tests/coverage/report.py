#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the tests in C do not run of core, contact, table and Fortran.

    cmake --preset coverage && cmake --build --preset coverage && ctest --preset coverage
    tests/coverage/report.py

Prints lines and branches of each room, and every line that did not run. Exit status 1 if a file has
more such lines than docs/records/coverage.md gives a reason for.
"""

import collections
import json
import re
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
PAGE = TOP / "docs/records/coverage.md"
ROOMS = "src/(base|contact|euler|materials|solver|sync|table)/|fortran/(common|euler|sync)/"


def main(build=TOP / "build/coverage"):
    command = ["gcovr", "-r", TOP, build, "--filter", ROOMS, "--json", "-", "--gcov-ignore-parse-errors",
               "--exclude-lines-by-pattern", r"\s*end module.*"]  # gfortran counts it, and it never runs
    found = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    if not found["files"]:
        sys.exit(f"coverage: no counts in {build}: build and test the preset coverage first")
    known = dict(re.findall(r"^\| `([^`]+)` \| (\d+) \|", PAGE.read_text(), re.M))
    rooms = collections.defaultdict(collections.Counter)
    faults = []
    for file in sorted(found["files"], key=lambda file: file["file"]):
        name, source = file["file"], (TOP / file["file"]).read_text().splitlines()
        lines = [line for line in file["lines"] if not line.get("gcovr/noncode")]
        missing = [line["line_number"] for line in lines if not line["count"]]
        branches = [branch["count"] > 0 for line in lines for branch in line["branches"]]
        rooms["/".join(name.split("/")[:2])].update(
            lines=len(lines), run=len(lines) - len(missing), branches=len(branches), taken=sum(branches))
        for number in missing:
            print(f"{name}:{number}: {source[number - 1].strip()}")
        explained = int(known.get(name, 0))
        if len(missing) > explained:
            faults.append(f"{name}: {len(missing)} lines do not run, {PAGE.name} explains {explained}")
    print("| room | lines | run | branches | taken |\n|---|---|---|---|---|")
    for name, r in sorted(rooms.items()):
        run, taken = r["run"] / max(r["lines"], 1), r["taken"] / max(r["branches"], 1)
        print(f"| `{name}` | {r['lines']} | {100 * run:.1f} % | {r['branches']} | {100 * taken:.1f} % |")
    print(*faults, sep="\n")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
