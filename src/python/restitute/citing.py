# SPDX-License-Identifier: BSD-3-Clause
"""What to cite: the paper, this software, the sources of materials."""
from __future__ import annotations

import os

__all__ = ["PAPER", "cite"]

#: The paper whose model is solved; CITATION.cff says the same.
PAPER = {"author": ("Willert, Emanuel", "Kusche, Stephan", "Popov, Valentin L."),
         "title": "The influence of viscoelasticity on velocity-dependent restitutions in the "
                  "oblique impact of spheres",
         "journal": "Facta Universitatis, Series: Mechanical Engineering",
         "volume": "15", "number": "2", "year": "2017", "doi": "10.22190/FUME170420006W"}


def cite(*materials: str | os.PathLike, bibtex: bool = False) -> str:
    """What to cite in a text that uses results of this package.

    Parameters
    ----------
    *materials : str or path
        Names or files, as for `restitute.material`: their sources are named, too.
    bibtex : bool
        BibTeX entries; the sources of materials then are comments.

    Examples
    --------
    >>> print(cite("steel"))
    The model:
      E. Willert, S. Kusche and V. L. Popov, The influence of viscoelasticity on velocity-dependent
      restitutions in the oblique impact of spheres, Facta Universitatis, Series: Mechanical
      Engineering 15(2), 2017, doi:10.22190/FUME170420006W
    The software:
      restitute, version ..., by the restitute authors
    The material Structural steel:
      EN 1993-1-1, ...
    """
    from restitute import material, version

    sources = []
    for name in materials:
        solid = material(name)
        known = solid.source or "no source is named in its file"
        sources.append((solid.name or os.fspath(name), known))
    if bibtex:
        about = [f"% The material {name}: {source}" for name, source in sources]
        return "\n".join([_entry("article", "WillertKuschePopov2017", PAPER), _entry(
            "misc", "restitute", {"author": ("{the restitute authors}",), "title": "restitute",
                                  "note": f"version {version()}"}), *about])
    lines = ["The model:", _folded(_in_words(PAPER)), "The software:",
             f"  restitute, version {version()}, by the restitute authors"]
    for name, source in sources:
        lines += [f"The material {name}:", _folded(source)]
    return "\n".join(lines)


def _in_words(paper):
    """A line of a list of references."""
    short = []
    for author in paper["author"]:
        family, given = author.split(", ")
        short.append(" ".join([*(f"{name[0]}." for name in given.split()), family]))
    return (f"{', '.join(short[:-1])} and {short[-1]}, {paper['title']}, {paper['journal']} "
            f"{paper['volume']}({paper['number']}), {paper['year']}, doi:{paper['doi']}")


def _entry(kind, key, fields):
    """An entry of BibTeX."""
    fields = {**fields, "author": " and ".join(fields["author"])}
    lines = [f"  {name} = {{{text}}}," for name, text in fields.items()]
    return "\n".join([f"@{kind}{{{key},", *lines, "}"])


def _folded(text):
    """Lines of at most 100 columns, indented."""
    import textwrap

    return textwrap.fill(text, 100, initial_indent="  ", subsequent_indent="  ",
                         break_long_words=False, break_on_hyphens=False)
