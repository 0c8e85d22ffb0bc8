# SPDX-License-Identifier: BSD-3-Clause
"""Finds lines of prose beyond 100 columns: columns.py TREE

Looks at pages and at lines that hold nothing but a comment. What cannot be broken is left:
tables, figures, indented or fenced code, and in comments formulas, which are indented by two
blanks or more. Exit status 1 if there is such a line.
"""

import re
import sys
from pathlib import Path

from tree import files_of, prose_of

MOST = 100
# What is released keeps its form.
NOT_READ = ("CHANGELOG.md",)
UNBROKEN = re.compile(r"\||!\[|    ")
FORMULA = re.compile(r" *(?:/\*+|\*|!>|!!|!|#|//) {2,}|!\$|#!")


def long_lines(tree, path):
    """(number, length) of each."""
    text, fenced, found = prose_of(tree, path), False, []
    whole = Path(tree, path).read_text(encoding="utf-8").splitlines() if text else []
    for number, (line, code) in enumerate(zip(text.splitlines(), whole), 1):
        if path.suffix == ".md":
            fenced ^= line.lstrip().startswith("```")
            prose = not fenced and not UNBROKEN.match(line)
        else:
            prose = line == code and not FORMULA.match(line)
        if prose and len(line) > MOST:
            found.append((number, len(line)))
    return found


def main(tree):
    read, wrong = 0, 0
    for path in files_of(tree):
        if path.as_posix().startswith(NOT_READ):
            continue
        read += 1
        for number, length in long_lines(tree, path):
            print(f"{path}:{number}: {length} columns of prose: at most {MOST}")
            wrong += 1
    print(f"{read} files")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
