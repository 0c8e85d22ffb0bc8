# SPDX-License-Identifier: BSD-3-Clause
"""The tree of pages that Sphinx reads: stage.py SOURCE REFERENCE OUT

The pages of the project, in their folders; of each file that a page links, a page that shows it;
the notebooks, run; the page of each material; the Python reference. REFERENCE is the HTML of
Doxygen. Links between pages and to files are those of the repository.
"""
from __future__ import annotations

import fnmatch
import os
import re
import shutil
import sys
from pathlib import Path

import material_pages
import notebook
import python_reference

# Sections of the first page: heading, what it says, patterns of pages. A page belongs to the first
# section that names it; those before the star stand in this order, and what a star finds by name.
SECTIONS = (
    ("Start", "From nothing to the first impact.",
     ("README.md", "docs/install.md", "docs/first_ten_minutes.md", "docs/tutorial.md",
      "docs/which_method.md", "docs/coming_from.md", "docs/questions.md", "docs/README.md")),
    ("Materials", "Solids by name, each with a figure to try radius, speed, angle and friction.",
     ("docs/materials.md", "materials/*")),
    ("Reference", "Every name and every option.",
     ("reference/python.md", "reference/c.md", "docs/manual.md", "docs/fortran.md",
      "docs/conventions.md", "docs/reference_impacts.md", "CHANGELOG.md", "CONTRIBUTING.md")),
    ("Theory", "The equations, and how each method solves them.",
     ("docs/theory.md", "docs/sync.md", "docs/cvode.md", "docs/bem.md")),
    ("Records", "What was measured: errors, run times, comparisons.", ("docs/records/*",)),
    ("Guides", "How to do one thing.", ("docs/python.md", "docs/c_library.md", "docs/fit.md", "docs/soft_contacts.md", "docs/trust.md",
      "docs/dem.md", "docs/contact.md", "docs/table.md", "docs/*", "examples/*", "*")),
)
TITLES = {"README.md": "Overview <{}>", "docs/README.md": "All pages <{}>"}
ORDER = ("Start", "Guides", "Materials", "Reference", "Theory", "Records")
LANGUAGE = {".c": "c", ".h": "c", ".cpp": "cpp", ".f90": "fortran", ".py": "python", ".sh": "sh",
            ".json": "json", ".txt": "text", ".cmake": "cmake"}
FIGURES = (".svg", ".png", ".jpg")
LINK = re.compile(r"(!?)(\[(?:[^\[\]]|\[[^\]]*\])*\])\(([^)\s]+)\)")
SKIPPED = (".git", "build", "__pycache__")


def pages_of(source):
    """The Markdown pages of the project, relative to it."""
    found = []
    for place, folders, names in os.walk(source):
        folders[:] = [name for name in folders if name not in SKIPPED and not name.endswith("-results")
                      and not Path(place, name, "CMakeCache.txt").exists()]
        found += [Path(place, name).relative_to(source) for name in names if name.endswith(".md")]
    return sorted(page for page in found if page.parts[:2] != ("docs", "site"))


class Stage:
    """What is copied, and what links lead to."""

    def __init__(self, source, out):
        self.source, self.out = source, out
        self.shown: dict[Path, None] = {}

    def write(self, page, text):
        """A page of the tree."""
        path = self.out / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def copy(self, page):
        """A page of the project, with its links."""
        text = (self.source / page).read_text(encoding="utf-8")
        self.write(page, self.linked(text, page.parent))

    def linked(self, text, folder):
        """The text with links to files made links to the pages that show them."""
        parts, code, fenced = [[]], False, False
        for line in text.split("\n"):  # prose and code in turn
            mark = line.lstrip().startswith("```")
            if code != (fenced or mark or line.startswith("    ")):
                code = not code
                parts.append([])
            parts[-1].append(line)
            fenced ^= mark
        joined = ["\n".join(part) for part in parts]
        joined[::2] = [LINK.sub(lambda match: self._link(match, folder), part) for part in joined[::2]]
        return "\n".join(joined)

    def _link(self, match, folder):
        mark, text, target = match.groups()
        path, _, section = target.partition("#")
        if not path or re.match(r"[a-z]+:", path):
            return match[0]
        file = Path(os.path.normpath(folder / path))
        if mark or file.suffix in FIGURES:
            if not (self.out / file).exists():  # a notebook has drawn its own
                (self.out / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(self.source / file, self.out / file)
            return match[0]
        if file.suffix == ".md":
            return match[0]
        if (self.source / file / "README.md").exists():
            page = file / "README.md"
        elif (self.source / file).is_dir():
            page = file / "index.md"
        else:
            page = file.with_suffix(".md") if file.suffix == ".ipynb" else Path(f"{file}.md")
        self.shown[file] = None
        section = f"#{section}" if section else ""
        return f"{mark}{text}({os.path.relpath(page, folder)}{section})"

    def show(self):
        """Pages of the files and folders that are linked."""
        done: set[Path] = set()
        while todo := [file for file in self.shown if file not in done]:
            for file in todo:
                done.add(file)
                if file.suffix == ".ipynb":
                    (self.out / file.parent).mkdir(parents=True, exist_ok=True)
                    text = notebook.page_of(self.source / file, self.out / file.parent)
                    self.write(file.with_suffix(".md"), self.linked(text, file.parent))
                elif (self.source / file).is_dir():
                    self._show_folder(file)
                else:
                    self._show_file(file)

    def _show_folder(self, folder):
        if (self.source / folder / "README.md").exists():
            return
        files = [file.relative_to(self.source) for file in sorted((self.source / folder).rglob("*"))
                 if file.is_file() and "__pycache__" not in file.parts]
        items = "\n".join(f"- [{file.relative_to(folder)}]({file.relative_to(folder)})" for file in files)
        self.write(folder / "index.md", f"---\norphan: true\n---\n# {folder}\n\n"
                   + self.linked(items, folder) + "\n")

    def _show_file(self, file):
        text = (self.source / file).read_text(encoding="utf-8").rstrip()
        fence = "`" * (max(map(len, re.findall("`+", text)), default=2) + 1)
        fence = fence if len(fence) > 2 else "```"
        also = ""
        if file.parts[:2] == ("include", "restitute"):
            page = os.path.relpath(python_reference.doxygen_page(file.name), file.parent)
            also = f'<p>The same by function: <a href="{page}">C reference</a>.</p>\n\n'
        language = LANGUAGE.get(file.suffix, "text")
        self.write(Path(f"{file}.md"), f"---\norphan: true\n---\n# {file.name}\n\n`{file}`\n\n{also}"
                   f"{fence}{language}\n{text}\n{fence}\n")


def first_page(stage, pages):
    """index.md with a list of pages in each section."""
    left, entries = list(pages), {}
    for heading, _, patterns in SECTIONS:
        entries[heading] = []
        for pattern in patterns:
            hits = [page for page in left if fnmatch.fnmatch(page.as_posix(), pattern)]
            entries[heading] += hits
            left = [page for page in left if page not in hits]
    text = (stage.source / "docs/site/index.md").read_text(encoding="utf-8")
    parts = [stage.linked(text.replace("](../", "](docs/"), Path("."))]
    says = {heading: words for heading, words, _ in SECTIONS}
    for heading in ORDER:
        names = "\n".join(TITLES.get(page.as_posix(), "{}").format(page.with_suffix("").as_posix())
                          for page in entries[heading])
        parts.append(f"## {heading}\n\n{says[heading]}\n\n```{{toctree}}\n:maxdepth: 1\n"
                     f":caption: {heading}\n\n{names}\n```\n")
    stage.write(Path("index.md"), "\n".join(parts))


def main(source, reference, out):
    """Everything, from nothing."""
    shutil.rmtree(out, ignore_errors=True)
    tree = out / "pages"
    stage = Stage(source, tree)
    pages = pages_of(source)
    for page in pages:
        stage.copy(page)
    for path in sorted((source / "examples/python").glob("*.ipynb")):
        stage.shown[path.relative_to(source)] = None
    notebooks = [file.with_suffix(".md") for file in stage.shown if file.suffix == ".ipynb"]
    made = material_pages.write_all(stage) + python_reference.write_all(stage)
    first_page(stage, pages + notebooks + made)
    stage.show()
    shutil.copytree(reference, out / "extra/reference/c")
    (out / "static").mkdir()
    for name in ("impact.js", "site.css"):
        shutil.copy(source / "docs/site" / name, out / "static" / name)


if __name__ == "__main__":
    main(*(Path(word).resolve() for word in sys.argv[1:4]))
