# SPDX-License-Identifier: BSD-3-Clause
"""Finds circles in the house: circles.py TREE

Looks at four kinds of arrows: includes between files of TREE/src, a .c and its .h being one
file; calls between its .c files; both between its folders; and `use` between files and folders
of TREE/fortran. Prints the members of each circle, and includes that name no file of src. Exit
status 1 if there are any.
"""

import re
import sys
from pathlib import Path

MADE_BY_CMAKE = ("base/version.h",)
# A definition starts at the margin and its body with a brace there.
DEFINITION = re.compile(r"^(?!static)\w[^;{}()=]*\b((?:rst|restitute)_\w+)\([^;{}]*\)\n\{", re.M)


def text_of(path):
    """The file without comments."""
    return re.sub(r"/\*.*?\*/", " ", path.read_text(encoding="utf-8"), flags=re.S)


def includes_of(src):
    """{file: files that it includes}, a file being its path in src without suffix, and a list of
    includes that name no file."""
    paths = sorted(src.rglob("*.[ch]"))
    arrows, astray = {}, []
    for path in paths:
        needed = arrows.setdefault(path.relative_to(src).with_suffix("").as_posix(), set())
        for include in re.findall(r'^#include "([^"]+)"', text_of(path), re.M):
            if (src / include).exists():
                needed.add(Path(include).with_suffix("").as_posix())
            elif include not in MADE_BY_CMAKE:
                astray.append(f"{path.relative_to(src)}: no file {include} in src")
    return arrows, astray


def calls_of(src):
    """{file: files that define what it calls}."""
    texts = {path.relative_to(src).with_suffix("").as_posix(): text_of(path) for path in sorted(src.rglob("*.c"))}
    owner = {name: file for file, text in texts.items() for name in DEFINITION.findall(text)}
    words = {file: re.findall(r"\w+", re.sub(r'"[^"\n]*"', "", text)) for file, text in texts.items()}
    return {file: {owner[name] for name in names if name in owner} for file, names in words.items()}


def uses_of(root):
    """{file: files whose modules it uses}, a file being its path in fortran."""
    texts = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8").lower() for path in sorted(root.rglob("*.f90"))}
    owner = {name: file for file, text in texts.items() for name in re.findall(r"^\s*module +(\w+) *$", text, re.M)}
    return {file: {owner[name] for name in re.findall(r"^\s*use +(\w+)", text, re.M) if name in owner}
            for file, text in texts.items()}


def between_folders(*graphs):
    """The arrows of all graphs between the folders of their files."""
    arrows = {}
    for graph in graphs:
        for file, needed in graph.items():
            arrows.setdefault(file.rpartition("/")[0], set()).update(other.rpartition("/")[0] for other in needed)
    return arrows


def circles_of(arrows):
    """The sets of names that need each other."""

    def reach(start):
        found, left = set(), [start]
        while left:
            new = arrows.get(left.pop(), set()) - found
            found |= new
            left += new
        return found

    reached = {name: reach(name) for name in arrows}
    circles = {frozenset({name} | {other for other in reached[name] if name in reached.get(other, ())}) for name in arrows}
    return sorted(sorted(circle) for circle in circles if len(circle) > 1)


def main(tree):
    includes, complaints = includes_of(tree / "src")
    calls, uses = calls_of(tree / "src"), uses_of(tree / "fortran")
    for what, arrows in (("includes between files", includes), ("calls between files", calls),
                         ("arrows between folders of src", between_folders(includes, calls)),
                         ("uses between files", uses), ("uses between folders of fortran", between_folders(uses))):
        print(f"{sum(len(needed - {name}) for name, needed in arrows.items())} {what}")
        complaints += [f"a circle of {what}: {', '.join(circle)}" for circle in circles_of(arrows)]
    for complaint in complaints:
        print(complaint)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
