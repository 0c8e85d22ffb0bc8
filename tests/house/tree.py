# SPDX-License-Identifier: BSD-3-Clause
"""The files of the source tree, and their comments."""

import io
import os
import re
import tokenize
from pathlib import Path

STRING = r'"(?:\\.|[^"\\\n])*"'
C, FORTRAN, HASH = STRING + r"|(/\*.*?\*/|//[^\n]*)", STRING + r"|'[^'\n]*'|(![^\n]*)", r"(?<!\S)(#[^\n]*)"
COMMENT = {".c": C, ".h": C, ".cpp": C, ".f90": FORTRAN, ".F90": FORTRAN, ".sh": HASH, ".cmake": HASH,
           ".txt": HASH}


def files_of(tree):
    """All files but those of builds and of git, as paths relative to the tree, sorted."""
    found = []
    for place, folders, names in os.walk(tree):
        folders[:] = [name for name in folders
                      if name not in (".git", "build", "__pycache__") and not name.endswith("-results")
                      and not Path(place, name, "CMakeCache.txt").exists()]
        found += [Path(place, name).relative_to(tree) for name in names]
    return sorted(found)


def python_comments(text):
    """(begin, end) of comments and of strings that are statements."""
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    blank = (tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENCODING)
    before, open_brackets = tokenize.ENCODING, 0
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        open_brackets += (token.string in "([{") - (token.string in ")]}") if token.type == tokenize.OP else 0
        if token.type == tokenize.COMMENT or token.type == tokenize.STRING and before in blank and not open_brackets:
            yield starts[token.start[0] - 1] + token.start[1], starts[token.end[0] - 1] + token.end[1]
        elif token.type != tokenize.COMMENT:
            before = token.type


def prose_of(tree, path):
    """A page as it is; of code the comments, all else replaced by blanks."""
    if path.suffix not in COMMENT and path.suffix not in (".md", ".py"):
        return ""
    text = Path(tree, path).read_text(encoding="utf-8")
    if path.suffix == ".md":
        return text
    if path.suffix == ".py":
        places = python_comments(text)
    else:
        places = (m.span(1) for m in re.finditer(COMMENT[path.suffix], text, re.S) if m[1])
    kept, at = [], 0
    for begin, end in places:
        kept += [re.sub(r"[^\n]", " ", text[at:begin]), text[begin:end]]
        at = end
    return "".join(kept)
