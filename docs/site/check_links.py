# SPDX-License-Identifier: BSD-3-Clause
"""Every link, figure, style and script of the site leads to a file, and every #section to an
element with that id: check_links.py SITE

Links to other hosts are not followed, but nothing may be loaded from there.
"""
from __future__ import annotations

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("object", "data")}
LINKED = LOADED | {("a", "href"), ("area", "href")}
DOXYGEN = "nested-classes"  # Doxygen links it above each Fortran module and does not make it
CSS = re.compile(r"""url\(\s*["']?([^"')]+)""")
NOT_LOADED = {"canonical", "search", "next", "prev", "index", "author", "genindex"}


class Page(HTMLParser):
    """The ids of a page, and (tag, target) of its links."""

    def __init__(self, path):
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[tuple[str, str]] = []
        self.loaded: list[str] = []
        self.feed(path.read_text(encoding="utf-8", errors="replace"))

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.ids.update(value for name, value in attrs if name in ("id", "name") and value)
        for name, value in attrs:
            if value and (tag, name) in LINKED:
                self.links.append((tag, value))
            if value and (tag, name) in LOADED and values.get("rel", "") not in NOT_LOADED:
                self.loaded.append(value)


def wrong_links(site):
    """Pages that were read, links that were followed, and a line for each that is wrong."""
    pages = {path: Page(path) for path in sorted(site.rglob("*.html"))}
    wrong, count = [], 0
    for path in sorted(site.rglob("*.css")):
        for target in CSS.findall(path.read_text(encoding="utf-8")):
            file = path.parent / urlsplit(target).path
            if not target.startswith(("data:", "#")) and (target.startswith("/") or not file.is_file()):
                wrong.append(f"{path.relative_to(site)}: {target} does not exist")
    for path, page in pages.items():
        name = path.relative_to(site)
        wrong += [f"{name}: {target} is loaded from another host" for target in page.loaded
                  if urlsplit(target).netloc]
        for _, target in page.links:
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            count += 1
            other = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not other.is_file():
                wrong.append(f"{name}: {target} does not exist")
            elif parts.fragment not in ("", DOXYGEN) and other in pages and unquote(parts.fragment) not in pages[other].ids:
                wrong.append(f"{name}: {target}: no such section")
    return len(pages), count, wrong


def main(site):
    pages, count, wrong = wrong_links(site.resolve())
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"{count} links of {pages} pages lead somewhere" if not wrong else f"{len(wrong)} links are wrong")
    return 1 if wrong or not count else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
