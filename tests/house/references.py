# SPDX-License-Identifier: BSD-3-Clause
"""Finds references that lead nowhere: references.py TREE

Looks into the pages and into the comments of the code for five kinds: paths that begin with a
folder of the tree, names of pages, their numbered sections, names of tests, and targets of
CMake. Exit status 1 if one does not exist.
"""

import re
import sys
from pathlib import Path

from tree import files_of, prose_of

NOT_READ = ("CHANGELOG.md",)  # it names what was
PLACEHOLDER = re.compile(r".*/file\.f90|.*NAME.*")


def sections_of(page):
    """The numbers of its headings."""
    return set(re.findall(r"^#+ (\d+)\. ", page.read_text(encoding="utf-8"), re.M))


def complaints_of(tree):
    """(number of references, a line for each that leads nowhere)"""
    files = files_of(tree)
    folders = "|".join(sorted({re.escape(path.parts[0]) for path in files if len(path.parts) > 1}))
    tests = {path.stem for path in files if path.name.startswith("test_")}
    cmake = "".join(Path(tree, path).read_text(encoding="utf-8") for path in files
                    if path.name == "CMakeLists.txt" or path.suffix == ".cmake")
    targets = set(re.findall(r"add_(?:custom_target|executable|library)\(\s*([\w-]+)", cmake))
    count, wrong = 0, []

    def page_named(name, place):
        """A page is named by its path in the tree, from the folder of the file, or by its name
        in docs."""
        return next((found for found in (Path(tree, name), Path(tree, place, name), Path(tree, "docs", name)) if found.exists()), None)

    for path in files:
        if path.name in NOT_READ:
            continue
        text = prose_of(tree, path)
        found = [(m, Path(tree, m[0]).exists()) for m in re.finditer(rf"(?<![\w./-])(?:{folders})/[\w./-]*\w", text)]
        for m in re.finditer(r"(?<![\w./-])([\w./-]+\.md)(?:\)?, sections? (\d+)(?: and (\d+))?)?", text):
            page = page_named(m[1], path.parent)
            found.append((m, page is not None and {m[2], m[3]} - {None} <= sections_of(page)))
        found += [(m, m[0] in tests) for m in re.finditer(r"\btest_\w+", text)]
        found += [(m, m[1] in targets) for m in re.finditer(r"--target ([\w-]+)", text)]
        count += len(found)
        wrong += [f"{path}:{text.count(chr(10), 0, m.start()) + 1}: {m[0]}" for m, good in found if not good and not PLACEHOLDER.fullmatch(m[0])]
    return count, wrong


def main(tree):
    count, wrong = complaints_of(tree)
    print(f"{count} references")
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
