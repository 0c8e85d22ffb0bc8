#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Spoils the kernels one place at a time and looks whether their tests see it.

    tests/mutation/run.py [-n 50] [--room contact ...] [--folder build/mutation]

A copy of the tree is changed, built and tested; yours is not touched. The result of every mutant is
a line of build/mutation/mutants.jsonl, so that a run that was stopped goes on where it was. Mutants
that do not compile, or give the same object code, are drawn anew. Needs what the tests need.
"""

import argparse
import collections
import hashlib
import json
import random
import re
import subprocess
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]

# Room: its files, and tests that are there for it: quick ones first, what they miss is left to the
# others. Not those that take minutes.
ROOMS = {
    "contact": (
        "src/contact/*.h src/contact/*.c",
        "api.test_contact|unit.test_contact|physics.test_contact_(cycles|impacts)|symbols.contact",
        "physics.test_contact",
    ),
    "sync": (
        "src/sync/*.c src/sync/*.h fortran/sync/*.f90 fortran/sync/walk/*",
        "unit.test_sync|api.test_sync$|physics.test_sync_(truth|ledger|corners|convergence)",
        "unit.test_allocation|api.test_(sync_order|many|solver)$|physics.test_sync_(history|limits|random)",
    ),
    "table": (
        "src/table/*.c src/table/*.h",
        "api.test_table_(collide|limits|lookup)$",
        "api.test_table_(build|random|traps|allocation_failures)$",
    ),
    "euler": (
        "fortran/euler/*.f90 fortran/common/*.f90 src/euler/*.c",
        "unit.test_(kernels|twins|allocation)|physics.test_(si_euler|ledger|slip|prony)$|api.test_(collide|history)$",
        "unit.test_sync|physics.test_(truth|limits|convergence|kelvin_voigt|traps|unlike_materials)$|api.test_(solver|many)$",
    ),
}

# What is replaced by what. Words stand between blanks, as the formatters leave them.
REPLACEMENTS = [
    (" + ", " - "), (" - ", " + "), (" * ", " / "), ("*", "/"), (" / ", " * "), ("/", "*"),
    (" < ", " <= "), (" <= ", " < "), (" > ", " >= "), (" >= ", " > "), (" < ", " > "), (" > ", " < "),
    (" == ", " != "), (" != ", " == "), (" && ", " || "), (" || ", " && "),
    (" .and. ", " .or. "), (" .or. ", " .and. "), ("smaller(", "larger("), ("larger(", "smaller("),
    ("min(", "max("), ("max(", "min("), (" += ", " -= "), ("if (", "if (!"),
]
FORTRAN = {" != ": " /= ", "if (!": "if (.not. "}
NUMBER = re.compile(r"(?<![\w.])(\d+\.?\d*(?:e-?\d+)?)(?![\w.\]])")
STATEMENT = re.compile(r"^\s+[\w>.\[\]-]+(\([^)]*\))? [-+*/]?= .*;$|^\s+[\w%]+(\(.*\))? = [^&]*$")


def mutations(line, fortran):
    """All ways to spoil a line."""
    code = re.split(r"!|//|/\*", line)[0] if fortran or "/*" in line or "//" in line else line
    for old, new in REPLACEMENTS:
        new = FORTRAN.get(new, new) if fortran else new
        for match in re.finditer(re.escape(old), code):
            yield line[: match.start()] + new + line[match.end() :]
    for match in NUMBER.finditer(code):
        text = match.group(1)
        other = str(int(text) + 1) if text.isdigit() else repr(float(text) * 1.1 or 1.0)
        yield line[: match.start()] + other + line[match.end() :]
    if STATEMENT.match(code.rstrip()) and "const" not in code:
        yield ""


def candidates(source, room):
    """(file, number of a line, line, text in its place) of a room, without comments."""
    for path in [path for pattern in ROOMS[room][0].split() for path in sorted(source.glob(pattern))]:
        comment = False
        for number, line in enumerate(path.read_text().splitlines()):
            text = line.strip()
            comment = comment or text.startswith("/*")
            skip = comment or not text or text.startswith(("#", "!", "*", "//", "use", "module"))
            comment = comment and "*/" not in text
            if not skip and not re.match(r"(real|integer|type|static const char)\b", text):
                for new in mutations(line, path.suffix.lower() == ".f90"):
                    yield path.relative_to(source), number, line, new


class Copy:
    """A copy of what is committed, which is changed, built and tested."""

    def __init__(self, folder):
        self.source, self.build, self.log = folder / "source", folder / "build", folder / "log"
        self.source.mkdir(exist_ok=True)
        for words in ("init", f"fetch {TOP} HEAD", "reset --hard FETCH_HEAD"):
            subprocess.run(["git", "-C", self.source, *words.split()], check=True, capture_output=True)
        configure = ["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DRESTITUTE_TESTS=ON",
                     "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_C_FLAGS=-DRST_ONE_SHAPE=1"]
        configure += [f"-DRESTITUTE_{part}=OFF" for part in ("PYTHON", "BEM", "FIT", "CVODE")]
        if not self.succeeds(configure) or not self.builds():
            sys.exit(f"mutation: the tree does not build, see {self.log}")
        self.objects = self.code()

    def succeeds(self, command):
        with open(self.log, "w") as log:
            return subprocess.run(command, stdout=log, stderr=log).returncode == 0

    def builds(self):
        return self.succeeds(["cmake", "--build", self.build])

    def code(self):
        return [hashlib.sha256(path.read_bytes()).digest() for path in sorted(self.build.rglob("*.o"))]

    def passes(self, tests):
        command = ["ctest", "--test-dir", self.build, "-R", tests, "--stop-on-failure", "--timeout", "300", "-j2"]
        return self.succeeds([*command, "--no-tests=error"])

    def verdict(self, path, number, new, tests):
        """What becomes of a mutant: invalid, same, killed or survived."""
        target = self.source / path
        whole = target.read_text()
        lines = whole.splitlines(keepends=True)
        lines[number] = new + "\n"
        target.write_text("".join(lines))
        try:
            if not self.builds():
                return "invalid"
            if self.code() == self.objects:
                return "same"
            return "survived" if all(map(self.passes, tests)) else "killed"
        finally:
            target.write_text(whole)


def show(results):
    """The table of what became of the mutants, and the survivors."""
    for room in ROOMS:
        count = collections.Counter(r["verdict"] for r in results if r["room"] == room)
        tried = count["killed"] + count["survived"]
        print(f"{room:8} {tried} mutants, {count['survived']} survived; no code {count['invalid']}, same {count['same']}")
    for r in results:
        if r["verdict"] == "survived":
            print(f"\n{r['file']}:{r['line']}\n- {r['old'].strip()}\n+ {r['new'].strip() or '(nothing)'}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-n", type=int, default=50, help="mutants of each room (50)")
    parser.add_argument("--room", choices=ROOMS, action="append", help="default: all")
    parser.add_argument("--folder", type=Path, default=TOP / "build/mutation")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    record = args.folder / "mutants.jsonl"
    record.touch()
    results = [json.loads(line) for line in record.read_text().splitlines()]
    copy = Copy(args.folder)
    for room in args.room or ROOMS:
        tests = ROOMS[room][1:]
        if not (copy.builds() and all(map(copy.passes, tests))):
            sys.exit(f"mutation: the tests of {room} fail without a mutant, see {copy.log}")
        known = {(r["file"], r["line"], r["new"]) for r in results}
        tried = sum(r["room"] == room and r["verdict"] in ("killed", "survived") for r in results)
        choices = list(candidates(copy.source, room))
        random.Random(1).shuffle(choices)
        for path, number, old, new in choices:
            if tried >= args.n:
                break
            if (str(path), number + 1, new) in known:
                continue
            verdict = copy.verdict(path, number, new, tests)
            tried += verdict in ("killed", "survived")
            results.append({"room": room, "file": str(path), "line": number + 1, "old": old, "new": new, "verdict": verdict})
            with record.open("a") as lines:
                print(json.dumps(results[-1]), file=lines)
            print(f"{room} {tried}/{args.n} {verdict} {path}:{number + 1}", flush=True)
    show(results)


if __name__ == "__main__":
    main()
