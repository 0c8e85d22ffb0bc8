# SPDX-License-Identifier: BSD-3-Clause
"""A notebook as a page: its cells are run, and what they return, print and draw follows them."""
from __future__ import annotations

import ast
import contextlib
import io
import json
import os
import pprint
import warnings

import restitute
from restitute import plot


def _run(source, names, label):
    """What a cell prints, warns and returns, as text."""
    tree, printed, said = ast.parse(source), io.StringIO(), []
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(printed), warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("ignore")
        warnings.simplefilter("always", restitute.ModelLimitWarning)
        exec(compile(tree, label, "exec"), names)
        value = eval(compile(ast.Expression(last.value), label, "eval"), names) if last else None
    said = [f"{type(one.message).__name__}: {one.message}" for one in caught]
    return printed.getvalue() + "\n".join(said + ([_shown(value)] if value is not None else []))


def _shown(value):
    """A value as a notebook shows it, long lists and dictionaries over several lines."""
    return pprint.pformat(value, width=96, sort_dicts=False) if isinstance(value, (list, dict)) else repr(value)


def page_of(path, folder):
    """The page in Markdown; figures go into the folder beside it as STEM-1.svg, ..."""
    import matplotlib

    matplotlib.use("agg")
    from matplotlib import pyplot

    stem, parts, drawn = path.stem, [], 0
    names, before = {"__name__": "__main__"}, os.getcwd()
    pyplot.close("all")
    os.chdir(path.parent)
    try:
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            source = "".join(cell["source"])
            if cell["cell_type"] != "code":
                parts.append(source)
                continue
            parts.append(f"```python\n{source}\n```")
            out = _run(source, names, path.name)
            if out.strip():
                parts.append(f"```none\n{out.rstrip()}\n```")
            for number in pyplot.get_fignums():
                drawn += 1
                plot.save(pyplot.figure(number), folder / f"{stem}-{drawn}.svg")
                parts.append(f"![Figure that the cell above draws]({stem}-{drawn}.svg)")
            pyplot.close("all")
    finally:
        os.chdir(before)
    return "\n\n".join(parts) + "\n"
