# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx over the tree of pages that stage.py makes."""
import os
import re
import shutil
from pathlib import Path

import restitute

project = "restitute"
author = "the authors of restitute"
copyright = author  # noqa: A001 - Sphinx asks for this name
version = release = restitute.version()
extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc"]
root_doc = "index"
source_suffix = {".md": "markdown"}
smartquotes = False  # u'' is a derivative, and --option an option
highlight_language = "text"  # of indented code, which is commands and formulas
myst_heading_anchors = 4  # sections are linked as on GitHub
numpydoc_show_class_members = False
autodoc_typehints = "none"  # the docstrings have them
autodoc_default_options = {"members": True, "member-order": "bysource"}

html_theme = "furo"
html_title = f"restitute {release}"
html_static_path = [os.environ["RESTITUTE_SITE_STATIC"]]
html_extra_path = [os.environ["RESTITUTE_SITE_EXTRA"]]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {"top_of_page_button": None}


def escape(app, what, name, obj, options, lines):
    """|x| is an absolute value and shift_ a name: neither is markup."""
    lines[:] = [line if "`" in line or ">>>" in line else re.sub(r"\||(?<=\w)_(?!\w)", r"\\\g<0>", line)
                for line in lines]


def stand_alone(app, exception):
    """Debian's furo loads normalize.css from a server and its script as modules, which a page in a
    file cannot do: both become part of the site. And its styles lack the dark page of a dark
    desktop, though the code in it is dark. A furo of PyPI has none of the lines."""
    static = Path(app.outdir, "_static")
    style, script = static / "styles/furo.css", static / "scripts/furo.js"
    served = "/javascript/normalize.css/normalize.css"
    if exception is None and served in (text := style.read_text(encoding="utf-8")):
        shutil.copy(f"/usr/share{served}", static / "styles/normalize.css")
        dark = re.search(r'body\[data-theme="dark"\] (\{[^}]*\})', text)[1]
        dark = f'@media (prefers-color-scheme: dark) {{ body[data-theme="auto"] {dark} }}\n'
        style.write_text(text.replace(served, "normalize.css") + dark, encoding="utf-8")
    imported = 'import Gumshoe from "./gumshoe-patched.js";'
    if exception is None and imported in (text := script.read_text(encoding="utf-8")):
        part = (static / "scripts/gumshoe-patched.js").read_text(encoding="utf-8")
        script.write_text(part + text.replace(imported, ""), encoding="utf-8")


def setup(app):
    """`escape` comes before numpydoc, which has the priority 500."""
    app.connect("autodoc-process-docstring", escape, priority=400)
    app.connect("build-finished", stand_alone)
