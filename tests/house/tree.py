# SPDX-License-Identifier: BSD-3-Clause
"""The files of the source tree, and their comments."""

import os
import re
from pathlib import Path

C, FORTRAN, HASH = r"/\*.*?\*/|//[^\n]*", r"![^\n]*", r"(?<!\S)#[^\n]*"
COMMENT = {".c": C, ".h": C, ".cpp": C, ".f90": FORTRAN, ".F90": FORTRAN, ".py": HASH + r'|^ *""".*?"""',
           ".sh": HASH, ".cmake": HASH, ".txt": HASH, ".gp": HASH}


def files_of(tree):
    """All files but those of builds and of git, as paths relative to the tree, sorted."""
    found = []
    for place, folders, names in os.walk(tree):
        folders[:] = [name for name in folders if name not in (".git", "build", "__pycache__") and not name.endswith("-results")
                      and not Path(place, name, "CMakeCache.txt").exists()]
        found += [Path(place, name).relative_to(tree) for name in names]
    return sorted(found)


def prose_of(tree, path):
    """A page as it is; of code the comments, each character of the rest a blank, so that lines and columns stay."""
    if path.suffix not in COMMENT and path.suffix != ".md":
        return ""
    text = Path(tree, path).read_text(encoding="utf-8")
    if path.suffix == ".md":
        return text
    kept, at = [], 0
    for comment in re.finditer(COMMENT[path.suffix], text, re.S | re.M):
        kept += [re.sub(r"[^\n]", " ", text[at:comment.start()]), comment.group()]
        at = comment.end()
    return "".join(kept)
