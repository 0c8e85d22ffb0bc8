# SPDX-License-Identifier: BSD-3-Clause
"""Follows pages word for word:  page.py NAME.md... [WORD...]

All commands of the pages run in one shell, in their order; those of each page begin in the current
folder. A block of
commands begins with ```sh. The block without a language that follows it is what comes out, on
standard output and standard error; there "..." is any text, and white space is not compared. A
block of ```python that begins with a comment with the name of a file is written to it first.

A comment in the line before a block says more of it:

  <!-- with WORD -->          only if WORD is given: what needs an installation, or LAMMPS
  <!-- exit status 1 -->      of its last command; else no command may fail

Exit status 1 if a command fails or gives something else.
"""

import doctest
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

OPTIONS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
MARK = "== end of block"
FENCE = re.compile(r"(?:<!-- (?P<about>[^\n]*?) -->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)


class Block(NamedTuple):
    page: str
    line: int
    commands: str
    status: int
    output: str  # or None: it does not matter


def blocks_of(text, words):
    """The commands of a page."""
    found, end = [], 0
    for match in FENCE.finditer(text):
        about, language, inside = match["about"] or "", match["language"], match["text"]
        line = text.count("\n", 0, match.start("text")) + 1
        name = re.match(r"# ([\w.]+\.py)\n", inside)
        left_out = about.startswith("with ") and about[5:] not in words
        if language == "python" and name and not left_out:
            found.append(Block("", line, f"cat >{name[1]} <<'END OF FILE'\n{inside}END OF FILE\n", 0, None))
        elif language == "sh":
            status = int(about[12:]) if about.startswith("exit status ") else 0
            found.append(None if left_out else Block("", line, inside, status, None))
        elif language == "" and found and found[-1] and not text[end:match.start()].strip():
            found[-1] = found[-1]._replace(output=inside)
        end = match.end()
    return [block for block in found if block]


def script_of(blocks):
    """One script of all blocks, which prints a mark and the exit status after each."""
    parts, page = ["exec 2>&1 </dev/null; set -e; begin=$PWD\n"], None
    for block in blocks:
        if block.page != page:
            page = block.page
            parts.append("cd \"$begin\"\n")
        commands = f"set +e\n{block.commands}set -- $?\nset -e\n" if block.status else f"{block.commands}set -- 0\n"
        parts.append(f"{commands}printf '\\n{MARK} %s\\n' $1\n")
    return "".join(parts)


def complaints_of(pages, words=()):
    """(number of blocks, what is wrong) in pages, {name: text}"""
    blocks = [block._replace(page=name) for name, text in pages.items() for block in blocks_of(text, words)]
    run = subprocess.run(["sh", "-c", script_of(blocks)], stdout=subprocess.PIPE, encoding="utf-8", check=False)
    outputs = re.split(rf"\n{MARK} (\d+)\n", run.stdout)
    checker, wrong = doctest.OutputChecker(), []
    for number, block in enumerate(blocks):
        got = outputs[2 * number]
        if 2 * number + 1 >= len(outputs):
            wrong.append(f"{block.page}, line {block.line}: a command fails, exit status {run.returncode}:\n{got}")
            break
        if int(outputs[2 * number + 1]) != block.status:
            wrong.append(f"{block.page}, line {block.line}: exit status {outputs[2 * number + 1]}:\n{got}")
        elif block.output is not None and not checker.check_output(block.output, got, OPTIONS):
            wrong.append(f"{block.page}, line {block.line}: the page shows\n{block.output}what comes out is\n{got}")
    return len(blocks), wrong


KNOWN = """
```sh
here=right
```

```sh
echo $here >&2; echo it is 0.123456
```

```
right
it is 0.1...
```

<!-- exit status 3 -->
```sh
sh -c "exit 3"
```

<!-- with nothing -->
```sh
rm /
```
"""


def main(*words):
    # What finds nothing in a page of which is known what is wrong would find nothing anywhere.
    assert complaints_of({"known": KNOWN}) == (3, [])
    for right, bad in ("0.1...", "0.2..."), ("exit status 3", "exit status 2"), ("here=right", "false"):
        assert len(complaints_of({"known": KNOWN.replace(right, bad)})[1]) == 1, bad
    pages = {word: Path(word).read_text(encoding="utf-8") for word in words if word.endswith(".md")}
    count, wrong = complaints_of(pages, words)
    print("\n".join([*wrong, f"{count} blocks of commands"]))
    return 1 if wrong or not count else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
