# SPDX-License-Identifier: BSD-3-Clause
"""The pages of the reference: the Python package by its docstrings, the way to Doxygen's HTML."""
from __future__ import annotations

from importlib import import_module
from pathlib import Path

MODULES = (("impact", "Impacts"), ("scenes", "Scenes"), ("materials", "Materials"),
           ("histories", "Histories"), ("collisions", "Two bodies in space"), ("table", "Tables"),
           ("contact", "The contact law"), ("fitting", "Fits"), ("fits", "What a fit returns"),
           ("solving", "Methods"), ("executor", "Other machines"), ("errors", "Errors and warnings"),
           ("plot", "Figures"), ("paper", "The paper's figures"))

C_REFERENCE = """# C and Fortran

<p>The headers and modules as browsable pages: <a href="c/index.html">start</a>,
<a href="c/files.html">by file</a>, <a href="c/globals_func.html">functions by name</a>,
<a href="c/annotated.html">structs</a>.</p>

The headers themselves are the manual of the library:

"""


def doxygen_page(name):
    """Where Doxygen puts the page of a header, in the site."""
    return Path("reference/c") / (name.replace("_", "__").replace(".", "_8") + ".html")


def _python():
    parts = ["# Python", "How to use it: [The Python package](../docs/python.md)."]
    for name, heading in MODULES:
        module = import_module(f"restitute.{name}")
        lines = [f".. automodule:: restitute.{name}", "   :no-members:", ""]
        for member in getattr(module, "__all__", []):
            value = getattr(module, member)
            kind = ("autoclass" if isinstance(value, type) else
                    "autofunction" if callable(value) else "autodata")
            lines += [f".. {kind}:: restitute.{name}.{member}", ""]
        parts.append(f"## {heading}\n\n```{{eval-rst}}\n" + "\n".join(lines) + "\n```")
    return "\n\n".join(parts) + "\n"


def write_all(stage):
    """The pages, as paths."""
    python, c = Path("reference/python.md"), Path("reference/c.md")
    stage.write(python, _python())
    headers = sorted((stage.source / "include/restitute").glob("*.h"))
    items = "\n".join(f"- [restitute/{h.name}](../include/restitute/{h.name})" for h in headers)
    modules = sorted((stage.source / "fortran/public").glob("*.f90"))
    items += "\n\nThe modules of Fortran:\n\n" + "\n".join(
        f"- [{m.stem}](../fortran/public/{m.name})" for m in modules)
    stage.write(c, stage.linked(C_REFERENCE + items + "\n", c.parent))
    return [python, c]
