# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx over the tree of pages that stage.py makes."""
import os
import re

import restitute

project = "restitute"
author = "the authors of restitute"
copyright = author  # noqa: A001 - Sphinx asks for this name
version = release = restitute.version()
extensions = ["myst_parser", "sphinx.ext.autodoc", "numpydoc"]
root_doc = "index"
source_suffix = {".md": "markdown"}
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


def setup(app):
    """Before numpydoc, which has the priority 500."""
    app.connect("autodoc-process-docstring", escape, priority=400)
